//! Random declarations: every item of the language with random expressions, with and without units; all of one follows from its
//! number.
//!
//! What is drawn is right: it has units that fit, constraints that can be fulfilled, inertia everywhere. Its expressions
//! ([`term`]) are known by a second way, so that what is derived from the text can be compared with them.

mod items;
pub mod term;

use crate::Random;
use items::Draft;
use lagrange_core::arithmetic::{Dual, Scalar};
use lagrange_core::trajectory::Instant;
use term::{Jet, Leaf, Term};

/// A declaration, and what is known of it.
pub struct Declared {
    /// The text of a file.
    pub text: String,
    /// Outputs by name, each a factor times an expression.
    pub observed: Vec<(String, f64, Term)>,
    /// Values that the first start sets: whether a velocity, coordinate, factor and expression.
    pub started: Vec<(bool, usize, f64, Term)>,
    leaves: Vec<(Leaf, Source)>,
}

/// Where the value of a leaf comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// A number.
    Parameter(f64),
    /// The time times a factor.
    Time(f64),
    /// A position times a factor.
    Position(usize, f64),
    /// A velocity times a factor.
    Velocity(usize, f64),
    /// Component `component` of axis `axis` of the body whose quaternion begins at coordinate `quaternion`.
    Axis {
        quaternion: usize,
        axis: usize,
        component: usize,
    },
    /// Angular velocity times a factor along an axis of that body.
    BodyRate {
        quaternion: usize,
        axis: usize,
        factor: f64,
    },
}

/// Declaration `number`; even ones have units.
pub fn declaration(number: u64) -> Declared {
    let random = Random::new(number.wrapping_mul(0x9e6c_63d0_676a_9a99));
    Draft::new(random, number.is_multiple_of(2)).finish()
}

impl Declared {
    /// Values of the leaves at an instant.
    pub fn leaves(&self, now: &Instant<f64>) -> Vec<Jet> {
        let value = |(_, source): &(Leaf, Source)| {
            source.at(now.time, &now.state.q, &now.state.v, &now.acceleration)
        };
        self.leaves.iter().map(value).collect()
    }

    /// Values of the leaves at a time, where only those that do not move are used.
    pub fn leaves_at_start(&self, time: f64) -> Vec<Jet> {
        let value = |(_, source): &(Leaf, Source)| match source {
            Source::Parameter(_) | Source::Time(_) => source.at(time, &[], &[], &[]),
            _ => Jet::constant(f64::NAN),
        };
        self.leaves.iter().map(value).collect()
    }
}

impl Source {
    fn at(self, time: f64, q: &[f64], v: &[f64], acceleration: &[f64]) -> Jet {
        let jet = |value: f64, rate: f64| Dual {
            value,
            derivative: [rate],
        };
        let quaternion = |first: usize| core::array::from_fn(|k| jet(q[first + k], v[first + k]));
        match self {
            Source::Parameter(value) => jet(value, 0.0),
            Source::Time(factor) => jet(factor * time, factor),
            Source::Position(i, factor) => jet(factor * q[i], factor * v[i]),
            Source::Velocity(i, factor) => jet(factor * v[i], factor * acceleration[i]),
            Source::Axis {
                quaternion: first,
                axis,
                component,
            } => axes(quaternion(first))[axis][component],
            Source::BodyRate {
                quaternion: first,
                axis,
                factor,
            } => {
                // 2 q̄ q̇, the product of quaternions.
                let [w, x, y, z] = quaternion(first).map(|e: Jet| e.value);
                let [dw, dx, dy, dz] = quaternion(first).map(|e| e.derivative[0]);
                let rate = [
                    w * dx - x * dw - y * dz + z * dy,
                    w * dy - y * dw - z * dx + x * dz,
                    w * dz - z * dw - x * dy + y * dx,
                ];
                // Nothing is differentiated that depends on velocities.
                jet(2.0 * factor * rate[axis], f64::NAN)
            }
        }
    }
}

/// The axes of a body whose quaternion is (w, x, y, z): columns of its matrix of rotation.
fn axes([w, x, y, z]: [Jet; 4]) -> [[Jet; 3]; 3] {
    let two = Jet::from_f64(2.0);
    [
        [
            w * w + x * x - y * y - z * z,
            two * (x * y + w * z),
            two * (x * z - w * y),
        ],
        [
            two * (x * y - w * z),
            w * w - x * x + y * y - z * z,
            two * (y * z + w * x),
        ],
        [
            two * (x * z + w * y),
            two * (y * z - w * x),
            w * w - x * x - y * y + z * z,
        ],
    ]
}
