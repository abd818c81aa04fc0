//! The size of what cancels in a guard: rounding leaves about 1e-16 of it, a located root about the tolerance.
//!
//! With a the row, f the forcing and m the diagonal of the mass matrix, the compliance of the row is Σaⱼ²/mⱼ, the
//! acceleration along it at most √(Σaⱼ²/mⱼ · D), and the multiplier that over the compliance: all independent of
//! the units of the coordinates, and not small where the force along the row happens to cancel. What drives is
//! D = Σfⱼ²/mⱼ + Σγᵢ²/(Σaᵢⱼ²/mⱼ): the forcing, and the rows i that act, of which a wall that is driven has γᵢ ≠ 0 where nothing
//! else drives. Of a quaternion what would change its length is no part of a: in that direction a body has no inertia.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::mode::FrictionMode;
use crate::modes::exact;
use crate::modes::guard::{self, Guard};
use crate::system::{Normal, ValueRef};

/// Coordinates of an attitude.
const QUATERNION: usize = 4;
/// Forces on one of them are measured with no more than so many times the mobility of the heaviest.
const LIGHTEST: f64 = 1e3;
/// One of them has no inertia if it has less than this share of the largest.
const NO_INERTIA: f64 = 1e-24;

/// What all guards of a state share.
#[derive(Clone, Debug, Default)]
pub struct Sizes {
    /// 1/mⱼ, of a coordinate without inertia of its own that of what it is tied to; 0 where there is none.
    mobility: Vec<f64>,
    /// The first coordinate of each quaternion, and the row that keeps its length.
    quaternions: Vec<[usize; 2]>,
    /// √D of the forcing, m/s² times √kg: squares of forces of 1e160 N are no numbers.
    forced: f64,
    /// √D of the forcing and of the rows that act; or more: loads that cancel do not make forces small that they are shared among.
    pub drive: f64,
    /// Per row that acts its compliance; not a number where it is not known.
    compliances: Vec<f64>,
}

impl Sizes {
    /// Takes mass, forcing and the rows that act from the last value.
    pub fn take<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let number = |place: ValueRef| dynamics.motion(place).value();
        self.mobility.clear();
        self.mobility.resize(d.coordinates.len(), 0.0);
        for &(i, j, place) in d.mass {
            let mass = if i == j { number(place) } else { 0.0 };
            if mass > 0.0 {
                self.mobility[i] = 1.0 / mass;
            }
        }
        self.quaternions.clear();
        let kept = d.constraints.iter();
        let kept = kept.filter_map(|constraint| Some([constraint.attitude?, constraint.row]));
        self.quaternions.extend(kept);
        for &[first, _] in &self.quaternions {
            let turns = &mut self.mobility[first..first + QUATERNION];
            let least = turns
                .iter()
                .filter(|m| **m > 0.0)
                .fold(f64::INFINITY, |a, b| a.min(*b));
            for mobility in turns.iter_mut().filter(|m| NO_INERTIA * **m > least) {
                *mobility = 0.0;
            }
        }
        self.take_followers(dynamics);
        let forcing = self.mobility.iter().zip(d.forcing).enumerate();
        let forced = forcing.map(|(j, (m, &f))| m.min(self.most_moved(j)).sqrt() * number(f));
        self.forced = forced.fold(0.0, f64::hypot);
        self.take_rows(dynamics);
    }

    /// Gives coordinates without inertia of their own the mobility of those that constraints tie them to: at the dead centre of a crank it is the piston that
    /// tells how heavy a place is that it is told to be at.
    fn take_followers<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let mut idle: Vec<usize> = (0..self.mobility.len())
            .filter(|&j| self.mobility[j] == 0.0 && self.attitude_of(j).is_none())
            .collect();
        let number = |place: ValueRef| dynamics.motion(place).value();
        while !idle.is_empty() {
            let tied = |j: usize| {
                let rows = d
                    .constraints
                    .iter()
                    .map(|constraint| &d.rows[constraint.row]);
                let mobilities = rows.map(|row| {
                    let own = row.jacobian.iter().find(|(k, _)| *k == j);
                    let own = own.map_or(0.0, |&(_, place)| number(place).powi(2));
                    let others = row.jacobian.iter().filter(|(k, _)| *k != j);
                    let moved = others.map(|&(k, place)| number(place).powi(2) * self.mobility[k]);
                    if own > 0.0 {
                        moved.sum::<f64>() / own
                    } else {
                        0.0
                    }
                });
                mobilities.fold(0.0, f64::max)
            };
            let found: Vec<(usize, f64)> = idle
                .iter()
                .map(|&j| (j, tied(j)))
                .filter(|(_, mobility)| *mobility > 0.0)
                .collect();
            if found.is_empty() {
                return;
            }
            for (j, mobility) in found {
                self.mobility[j] = mobility;
                idle.retain(|other| *other != j);
            }
        }
    }

    /// Takes the rows that act from the last value, in another mode at the same state: a friction that slips drives nothing beyond a normal force that
    /// is given, and where its row nearly vanishes it would have to drive without bound to hold.
    pub fn take_rows<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        self.compliances.clear();
        self.compliances.resize(d.rows.len(), f64::NAN);
        let mut drive = self.forced;
        for &row in dynamics.acting_rows() {
            let compliance = self.compliance(row, dynamics);
            self.compliances[row] = compliance;
            let driven = dynamics.motion(d.rows[row].bias).value();
            if compliance > 0.0 && driven != 0.0 {
                drive = drive.hypot(driven / compliance.sqrt());
            }
        }
        let given = d.frictions.iter().enumerate().filter(|(f, friction)| {
            let slides = matches!(dynamics.mode().frictions[*f], FrictionMode::Slip(_));
            slides && matches!(friction.normal, Normal::Given(_))
        });
        self.drive = given.fold(drive, |drive, (f, friction)| {
            let force = self.friction(f, friction.kinetic_coefficient, dynamics);
            let rows = friction.rows();
            let rubbed = rows.map(|row| force * self.compliance(row, dynamics).sqrt());
            rubbed.fold(drive, f64::hypot)
        });
    }

    /// Momentum of all coordinates with these speeds.
    pub fn momentum(&self, speeds: impl Iterator<Item = f64>) -> f64 {
        let parts = self.mobility.iter().zip(speeds);
        let parts = parts.filter(|(mobility, _)| **mobility > 0.0);
        parts.map(|(mobility, speed)| speed / mobility).sum()
    }

    /// Size of the terms that make a guard: an acceleration for gaps and slips, a force for the others.
    pub fn of<T: Scalar>(&self, guard: Guard, dynamics: &Dynamics<T>) -> f64 {
        let d = dynamics.description();
        match guard {
            Guard::Gap(c) => self.row(d.contacts[c].row, dynamics).acceleration,
            Guard::Normal(c) => self.row(d.contacts[c].row, dynamics).force,
            Guard::Slip(f) => {
                let friction = &d.frictions[f];
                let force = self.friction(f, friction.kinetic_coefficient, dynamics);
                let rows = friction.rows();
                let sizes = rows.map(|row| {
                    let row = self.row(row, dynamics);
                    row.acceleration + row.compliance * force
                });
                sizes.fold(0.0, f64::max)
            }
            Guard::StickUpper(f) | Guard::StickLower(f) => self.limit(f, dynamics),
            Guard::StickCone(f) => self.of_cone(f, 0.0, dynamics),
            Guard::NormalForceSign(f) => self.normal(f, dynamics),
            Guard::Region(_) | Guard::Branch(_) | Guard::Stop(..) | Guard::Mark(..) => 0.0,
            // It is relative already.
            Guard::Composite(_) => 1.0,
        }
    }

    /// The same of the cone of friction `f`, a difference of squares: those of forces are off by as much as these, times what they are, or will be where they
    /// grow to `forces`, in the unit of the cone.
    pub fn of_cone<T: Scalar>(&self, f: usize, forces: f64, dynamics: &Dynamics<T>) -> f64 {
        let (unit, sum) = cone(f, dynamics);
        unit * self.limit(f, dynamics) * sum.max(forces)
    }

    /// What the cone of friction `f` changes by with forces of this size, beside those that there are, or of `least` where these vanish.
    pub fn change_of_cone<T: Scalar>(
        f: usize,
        force: f64,
        least: f64,
        dynamics: &Dynamics<T>,
    ) -> f64 {
        let (unit, sum) = cone(f, dynamics);
        unit * force * sum.max(unit * least)
    }

    /// Size of the accelerations of coordinate `j`.
    pub fn of_coordinate(&self, j: usize) -> f64 {
        self.mobility[j].sqrt() * self.drive
    }

    /// Size of the forces along the rows that act, the largest of them.
    pub fn of_forces(&self) -> f64 {
        let known = self
            .compliances
            .iter()
            .filter(|compliance| **compliance > 0.0);
        let stiffest = known.fold(f64::INFINITY, |least, x| x.min(least));
        self.drive / stiffest.sqrt()
    }

    /// Size of the accelerations along a row.
    pub fn acceleration<T: Scalar>(&self, row: usize, dynamics: &Dynamics<T>) -> f64 {
        self.row(row, dynamics).acceleration
    }

    fn row<T: Scalar>(&self, row: usize, dynamics: &Dynamics<T>) -> Row {
        let compliance = self.compliance(row, dynamics);
        let bias = dynamics.motion(dynamics.description().rows[row].bias);
        let acceleration = (compliance.sqrt() * self.drive).max(bias.value().abs());
        let needed = if compliance > 0.0 {
            acceleration / compliance
        } else {
            0.0
        };
        Row {
            acceleration,
            compliance,
            force: needed.max(dynamics.force(row).value().abs()),
        }
    }

    /// The largest mobility that forces on coordinate `j` are measured with: what would change the length of a quaternion moves nothing, though the real part
    /// of one near its unit has hardly any inertia.
    fn most_moved(&self, j: usize) -> f64 {
        let Some(first) = self.attitude_of(j) else {
            return f64::INFINITY;
        };
        let turns = self.mobility[first..first + QUATERNION].iter();
        let heaviest = turns.filter(|m| **m > 0.0);
        LIGHTEST * heaviest.fold(f64::INFINITY, |least, m| m.min(least))
    }

    /// The first coordinate of the quaternion that coordinate `j` is of.
    fn attitude_of(&self, j: usize) -> Option<usize> {
        let mut firsts = self.quaternions.iter().map(|&[first, _]| first);
        firsts.find(|first| j.wrapping_sub(*first) < QUATERNION)
    }

    /// Compliance of a row: its acceleration by a force of 1 along it.
    pub fn compliance<T: Scalar>(&self, row: usize, dynamics: &Dynamics<T>) -> f64 {
        let known = self.compliances[row];
        if !known.is_nan() {
            return known;
        }
        let rows = dynamics.description().rows;
        let number = |place: ValueRef| dynamics.motion(place).value();
        let parts = rows[row]
            .jacobian
            .iter()
            .filter(|&&(j, _)| self.attitude_of(j).is_none());
        let parts = parts.map(|&(j, place)| number(place).powi(2) * self.mobility[j]);
        let mut compliance: f64 = parts.sum();
        for &[first, length] in &self.quaternions {
            let turns = turning(row, [first, length], dynamics);
            for (k, along) in turns.into_iter().enumerate() {
                compliance += along * along * self.mobility[first + k];
            }
        }
        compliance
    }

    /// Size of the normal force of friction `f`.
    fn normal<T: Scalar>(&self, f: usize, dynamics: &Dynamics<T>) -> f64 {
        let d = dynamics.description();
        match d.frictions[f].normal {
            Normal::Contact(c) => {
                let factor = d.contacts[c]
                    .normal_factor
                    .map_or(1.0, |place| dynamics.motion(place).value());
                self.row(d.contacts[c].row, dynamics).force * factor
            }
            Normal::Constraint(i) => self.row(d.constraints[i].row, dynamics).force,
            normal @ Normal::Resultant(_) => {
                let squares = normal
                    .rows(d)
                    .map(|row| self.row(row, dynamics).force.powi(2));
                squares.sum::<f64>().sqrt()
            }
            Normal::Given(place) => dynamics.motion(place).value().abs(),
        }
    }

    fn friction<T: Scalar>(&self, f: usize, coefficient: ValueRef, dynamics: &Dynamics<T>) -> f64 {
        dynamics.motion(coefficient).value().abs() * self.normal(f, dynamics)
    }

    /// Size of the forces that keep friction `f` from slipping.
    pub fn limit<T: Scalar>(&self, f: usize, dynamics: &Dynamics<T>) -> f64 {
        let friction = &dynamics.description().frictions[f];
        let rows = friction.rows();
        let force = rows.map(|row| self.row(row, dynamics).force);
        force.fold(0.0, f64::max) + self.friction(f, friction.static_coefficient, dynamics)
    }
}

/// The part of a row's Jacobian that is of the quaternion with this `first` coordinate.
fn part_of_quaternion<T: Scalar>(
    row: usize,
    first: usize,
    dynamics: &Dynamics<T>,
) -> [f64; QUATERNION] {
    let mut part = [0.0; QUATERNION];
    for &(j, place) in dynamics.description().rows[row].jacobian {
        if let Some(x) = j.checked_sub(first).and_then(|k| part.get_mut(k)) {
            *x = dynamics.motion(place).value();
        }
    }
    part
}

/// What of a row's Jacobian turns a body: what would change the length of its quaternion, which another row keeps, is no part of it.
fn turning<T: Scalar>(
    row: usize,
    [first, length]: [usize; 2],
    dynamics: &Dynamics<T>,
) -> [f64; QUATERNION] {
    let [own, grows] = [row, length].map(|row| part_of_quaternion(row, first, dynamics));
    let dot = |a: [f64; QUATERNION], b: [f64; QUATERNION]| -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    };
    let share = dot(own, grows) / dot(grows, grows).max(f64::MIN_POSITIVE);
    [0, 1, 2, 3].map(|k| own[k] - share * grows[k])
}

/// Size of what the force of each row that acts holds in balance in the equation that says it best: forcing, inertia and other forces; of a
/// friction also what it is a part of, and of one that slips that alone, for no balance says how large it is.
pub fn held<T: Scalar>(dynamics: &Dynamics<T>) -> Vec<f64> {
    let d = dynamics.description();
    let number = |place: ValueRef| dynamics.motion(place).value().abs();
    let forcing = d.forcing.iter();
    let mut terms: Vec<f64> = forcing.map(|&place| number(place)).collect();
    let mut inert = |i: usize, j: usize, mass: f64| {
        terms[i] += mass * dynamics.acceleration()[j].value().abs();
    };
    for &(i, j, place) in d.mass {
        inert(i, j, number(place));
        if i != j {
            inert(j, i, number(place));
        }
    }
    let force = |row: usize| dynamics.force(row).value().abs();
    for (row, declared) in d.rows.iter().enumerate() {
        for &(j, place) in declared.jacobian {
            terms[j] += number(place) * force(row);
        }
    }
    let mut held = vec![0.0; d.rows.len()];
    for &row in dynamics.acting_rows() {
        let equations = d.rows[row].jacobian.iter();
        let others = equations.filter_map(|&(j, place)| {
            let share = number(place);
            (share > 0.0).then(|| terms[j] / share - force(row))
        });
        let least = others.fold(f64::INFINITY, f64::min);
        held[row] = if least.is_finite() {
            least.max(0.0)
        } else {
            0.0
        };
    }
    for (friction, mode) in d.frictions.iter().zip(&dynamics.mode().frictions) {
        let normal = friction.normal.rows(d).map(|row| held[row]);
        let part = number(friction.kinetic_coefficient) * normal.sum::<f64>();
        for size in &mut held[friction.rows()] {
            *size = match mode {
                FrictionMode::Slip(_) => part,
                FrictionMode::Stick | FrictionMode::Inactive => *size + part,
            };
        }
    }
    held
}

/// The unit of the cone of friction `f` as a factor, and in it the sum of the force and of its limit.
fn cone<T: Scalar>(f: usize, dynamics: &Dynamics<T>) -> (f64, f64) {
    let friction = &dynamics.description().frictions[f];
    let rows = friction.rows();
    let values = rows.map(|row| dynamics.force(row).value());
    let limit = exact::limit(f, dynamics.mode(), dynamics).value();
    let unit = 1.0 / guard::cone_unit(values.clone().chain([limit]));
    let force = values.fold(0.0, f64::hypot);
    (unit, unit * (force + limit.abs()))
}

/// Sizes along one row.
struct Row {
    acceleration: f64,
    compliance: f64,
    force: f64,
}
