//! A picture in space, as plain data: solids in metres, and where each force acts.
//!
//! A run has the same solids in the same order at every instant, only their numbers differ. Nothing here knows of pages or pixels.

use crate::drawing::Arrow;

pub use nalgebra::{UnitQuaternion, Vector3};

/// A place or a direction, z upward, m.
pub type Vector = Vector3<f64>;

/// A scene in space at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Space {
    /// In any order.
    pub solids: Vec<Solid>,
    /// Forces.
    pub arrows: Vec<Arrow<3>>,
}

/// Where a body is, and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The body's origin.
    pub at: Vector,
    /// The rotation that takes the axes of space to those of the body.
    pub turn: UnitQuaternion<f64>,
}

/// Something with a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// Ground that does not move: the plane through a place, across the third axis. At most one.
    Ground(Pose),
    /// A ball, striped so that its turning shows.
    Ball(f64, Pose),
    /// A ball of which only the integrals of its angular velocity about the axes of space are known, rad.
    RolledBall(f64, Vector, Vector),
    /// The half of an ellipsoid with these semi-axes that lies below its centre.
    HalfEllipsoid([f64; 3], Pose),
    /// A box with these edges around its centre.
    Box([f64; 3], Pose),
    /// A cylinder of a radius and a height around its centre, along the third axis; a spoke shows how far it has turned.
    Disc(f64, f64, Pose),
    /// The surface of a fixed sphere.
    Shell(f64, Vector),
    /// The lower half of the surface of a fixed sphere, open above.
    Bowl(f64, Vector),
    /// A rod, a string or a chain, from joint to joint.
    Rod(Vec<Vector>),
    /// A point mass.
    Mass(Vector),
    /// A fixed point from which something hangs.
    Pivot(Vector),
    /// Where the body before it has been: its path is drawn through this point.
    Trace(Vector),
}

impl Pose {
    /// At a place, not turned.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self {
            at: Vector::new(x, y, z),
            turn: UnitQuaternion::identity(),
        }
    }

    /// The same turned by an attitude's four numbers, scalar part first; they need not have length 1.
    #[must_use]
    pub fn attitude(self, q: &[f64]) -> Self {
        let turn = nalgebra::Quaternion::new(q[0], q[1], q[2], q[3]);
        Self {
            turn: UnitQuaternion::from_quaternion(turn),
            ..self
        }
    }

    /// The same turned about one of its own axes, by an angle that is the length of the vector, rad.
    #[must_use]
    pub fn turned(self, by: Vector) -> Self {
        Self {
            turn: self.turn * UnitQuaternion::from_scaled_axis(by),
            ..self
        }
    }
}

impl Solid {
    /// One word.
    pub fn kind(&self) -> &'static str {
        match self {
            Solid::Ground(_) => "ground",
            Solid::Ball(..) => "ball",
            Solid::RolledBall(..) => "rolled ball",
            Solid::HalfEllipsoid(..) => "half ellipsoid",
            Solid::Box(..) => "box",
            Solid::Disc(..) => "disc",
            Solid::Shell(..) => "shell",
            Solid::Bowl(..) => "bowl",
            Solid::Rod(_) => "rod",
            Solid::Mass(_) => "mass",
            Solid::Pivot(_) => "pivot",
            Solid::Trace(_) => "trace",
        }
    }

    /// What does not change of it, m: its radius, its edges.
    pub fn size(&self) -> Vec<f64> {
        match self {
            Solid::Ball(radius, _)
            | Solid::RolledBall(radius, ..)
            | Solid::Shell(radius, _)
            | Solid::Bowl(radius, _) => vec![*radius],
            Solid::HalfEllipsoid(edges, _) | Solid::Box(edges, _) => edges.to_vec(),
            Solid::Disc(radius, height, _) => vec![*radius, *height],
            _ => Vec::new(),
        }
    }

    /// Where it is: its origin, or its joints.
    pub fn places(&self) -> Vec<Vector> {
        match self {
            Solid::Ground(pose)
            | Solid::Ball(_, pose)
            | Solid::HalfEllipsoid(_, pose)
            | Solid::Box(_, pose)
            | Solid::Disc(_, _, pose) => vec![pose.at],
            Solid::RolledBall(_, at, _)
            | Solid::Shell(_, at)
            | Solid::Bowl(_, at)
            | Solid::Mass(at)
            | Solid::Pivot(at)
            | Solid::Trace(at) => vec![*at],
            Solid::Rod(joints) => joints.clone(),
        }
    }

    /// How it is turned, if that shows.
    pub fn turn(&self) -> Option<UnitQuaternion<f64>> {
        match self {
            Solid::Ground(pose)
            | Solid::Ball(_, pose)
            | Solid::HalfEllipsoid(_, pose)
            | Solid::Box(_, pose)
            | Solid::Disc(_, _, pose) => Some(pose.turn),
            _ => None,
        }
    }

    /// How far it reaches from its places along x, y and z, m.
    pub fn reach(&self) -> Vector {
        // Lengths of the rows of a matrix whose columns are the body's axes.
        let rows = |pose: &Pose, axes: [f64; 3], length: fn([f64; 3]) -> f64| {
            let turn = pose.turn.to_rotation_matrix();
            Vector::from_fn(|row, _| length([0, 1, 2].map(|k| axes[k] * turn[(row, k)])))
        };
        match self {
            Solid::Ball(radius, _)
            | Solid::RolledBall(radius, ..)
            | Solid::Shell(radius, _)
            | Solid::Bowl(radius, _) => Vector::repeat(*radius),
            Solid::HalfEllipsoid(axes, pose) => rows(pose, *axes, |[x, y, z]| x.hypot(y).hypot(z)),
            Solid::Box(edges, pose) => rows(pose, edges.map(|edge| edge / 2.0), |[x, y, z]| {
                x.abs() + y.abs() + z.abs()
            }),
            Solid::Disc(radius, height, pose) => {
                rows(pose, [*radius, *radius, height / 2.0], |[x, y, z]| {
                    x.hypot(y) + z.abs()
                })
            }
            _ => Vector::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::FRAC_PI_2;

    #[test]
    fn bodies_turn_about_their_own_axes() {
        let quarter = Pose::at(1.0, 0.0, 0.0).turned(FRAC_PI_2 * Vector::z());
        assert!((quarter.turn * Vector::x() - Vector::y()).norm() < 1e-15);
        let half = (0.5 * FRAC_PI_2).sin_cos();
        let same = Pose::at(1.0, 0.0, 0.0).attitude(&[2.0 * half.1, 0.0, 0.0, 2.0 * half.0]);
        assert!(same.turn.angle_to(&quarter.turn) < 1e-15);
        let tipped = quarter.turned(FRAC_PI_2 * Vector::x());
        let up = tipped.turn * Vector::z();
        assert!((up - Vector::x()).norm() < 1e-15, "{up}");
    }

    #[test]
    fn boxes_hold_what_is_there() {
        let eighth = Pose::at(5.0, 0.0, 0.0).turned(FRAC_PI_2 / 2.0 * Vector::z());
        let reach = |solid: Solid, expected: [f64; 3]| {
            let error = (solid.reach() - Vector::from(expected)).norm();
            assert!(error < 1e-15, "{solid:?}: {error}");
        };
        let diagonal = 0.5_f64.sqrt();
        reach(
            Solid::Box([2.0, 2.0, 1.0], eighth),
            [2.0 * diagonal, 2.0 * diagonal, 0.5],
        );
        reach(
            Solid::HalfEllipsoid([1.0, 1.0, 3.0], eighth),
            [1.0, 1.0, 3.0],
        );
        let upright = Pose::at(0.0, 0.0, 0.0).turned(FRAC_PI_2 * Vector::x());
        reach(Solid::Disc(1.0, 0.5, upright), [1.0, 0.25, 1.0]);
        reach(Solid::Mass(Vector::x()), [0.0; 3]);
    }
}
