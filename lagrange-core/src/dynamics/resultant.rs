//! Frictions that several constraints press together: N = √Σλ², the load of a bearing.
//!
//! That is not linear in the forces. With the unit vector u along λ
//!
//! ```text
//! N = u·λ + ρ
//! ```
//!
//! is, and where u has the direction of the λ that follows from it, ρ = 0 ([`crate::linear::direction`] looks for it). In a Taylor series u is that of the beginning, and
//!
//! ```text
//! 2 N₀ ρₖ = Σ_{j=1..k−1} (λⱼ·λₖ₋ⱼ − Nⱼ Nₖ₋ⱼ)
//! ```
//!
//! follows from N² = λ·λ by lower coefficients alone. Where λ vanishes, u is the direction in which it begins, that of its first coefficient λₘ,
//! and the same holds of the coefficients from there on.

use super::shape::{Extent, ResultantRegisters};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::Scalar;
use crate::linear::direction::{Vector, dot, length, settle};
use crate::program::{MAX_ORDER, Register};

/// Forces below this part of the largest there have been may vanish, see [`VANISHING`].
const SMALL: f64 = 1e-6;

/// Small forces vanish if they are smaller by this than a coefficient of a higher order, over the time in which the series changes. As the force is small for
/// no longer than it takes to grow, the motion misses the square of it.
const VANISHING: f64 = 1e-8;

/// So many coefficients at least say when a series changes.
const FEWEST: usize = 8;

/// The directions of resultants, one for each of a description.
#[derive(Clone, Debug)]
pub(super) struct Resultants<T> {
    of: Vec<Resultant<T>>,
}

#[derive(Clone, Debug)]
struct Resultant<T> {
    /// u
    along: Vector<T>,
    /// The same at the start of the step.
    held: Vector<T>,
    /// |λ| at the last value, and the largest at the start of a step so far.
    size: f64,
    largest: f64,
    /// The order in which λ begins; none if it stays zero.
    leading: Option<usize>,
    /// Coefficients of λ and N in the series under way.
    forces: [Vector<T>; MAX_ORDER + 1],
    normal: [T; MAX_ORDER + 1],
}

impl<T: Scalar> Resultants<T> {
    pub(super) fn new(count: usize) -> Self {
        let zero = T::zero();
        let one = Resultant {
            along: [zero; 3],
            held: [zero; 3],
            size: 0.0,
            largest: 0.0,
            leading: Some(0),
            forces: [[zero; 3]; MAX_ORDER + 1],
            normal: [zero; MAX_ORDER + 1],
        };
        Self {
            of: vec![one; count],
        }
    }

    /// Forgets where forces pointed.
    pub(super) fn restart(&mut self) {
        for resultant in &mut self.of {
            (resultant.along, resultant.held) = ([T::zero(); 3], [T::zero(); 3]);
            resultant.leading = Some(0);
            (resultant.size, resultant.largest) = (0.0, 0.0);
        }
    }

    /// Keeps the directions that there are as those at the start of a step.
    pub(super) fn hold(&mut self) {
        for resultant in &mut self.of {
            resultant.held = resultant.along;
        }
    }

    /// Begins a series, from values in the registers.
    pub(super) fn begin(
        &mut self,
        given: &ResultantRegisters,
        unknowns: &[Register],
        registers: &mut [T],
    ) {
        registers[given.rest.1.index()] = T::zero();
        let unknown = |i: usize| registers[unknowns[i].index()];
        self.of[given.resultant].take(0, forces(given, unknown), T::zero());
    }

    /// Takes coefficient `k` of what has been solved for; returns coefficient k + 1 of ρ.
    #[inline]
    pub(super) fn follow(
        &mut self,
        given: &ResultantRegisters,
        k: usize,
        solution: &[T],
        now: &[T],
    ) -> T {
        let of = &mut self.of[given.resultant];
        of.take(k, forces(given, |i| solution[i]), now[given.rest.0.index()]);
        of.rest(k + 1)
    }
}

/// λ from the unknowns.
fn forces<T: Scalar>(given: &ResultantRegisters, unknown: impl Fn(usize) -> T) -> Vector<T> {
    let mut forces = [T::zero(); 3];
    for (force, place) in forces.iter_mut().zip(&given.forces) {
        *force = place.map_or(T::zero(), |i| -unknown(i));
    }
    forces
}

impl<T: Scalar> Resultant<T> {
    /// Takes coefficient `k`: those before the first are errors.
    #[inline]
    fn take(&mut self, k: usize, forces: Vector<T>, rest: T) {
        self.forces[k] = forces;
        self.normal[k] = dot(self.along, forces) + rest;
    }

    /// Coefficient `k` of ρ.
    fn rest(&self, k: usize) -> T {
        let Some(first) = self.leading.filter(|&first| k >= first + 2) else {
            return T::zero();
        };
        let mut sum = T::zero();
        for j in first + 1..k {
            let other = k + first - j;
            sum += dot(self.forces[j], self.forces[other]) - self.normal[j] * self.normal[other];
        }
        sum / (self.normal[first] + self.normal[first])
    }

    /// Turns u to where λₘ points, m its first order, if that is larger than the `least`. Returns what was across, as a part of it.
    fn turn(&mut self, forces: Vector<T>, least: f64) -> f64 {
        let along = self.along;
        let length = length(forces);
        if !(length.value() > least) {
            return 0.0;
        }
        self.along = forces.map(|force| force / length);
        let change = [0, 1, 2].map(|i| (self.along[i] - along[i]).value());
        self::length(change)
    }
}

impl<T: Scalar> Dynamics<T> {
    /// Whether a friction slips that several constraints press together.
    pub(super) fn presses_by_resultants(&self) -> bool {
        !self.compiled().pattern.sliding.resultants.is_empty()
    }

    /// The direction of resultant `i`, a unit vector, at the start of the step.
    pub(crate) fn resultant_direction(&self, i: usize) -> [T; 3] {
        self.resultants.of[i].held
    }

    /// Forgets where forces that press together have pointed: directions are found to within what settles, and from where they are looked for shows
    /// in the last digits.
    pub(crate) fn forget_load_directions(&mut self) {
        self.resultants.restart();
    }

    /// The order of the first coefficient of resultant `i` in the last series; none if it stays zero.
    pub(crate) fn resultant_order(&self, i: usize) -> Option<usize> {
        self.resultants.of[i].leading
    }

    /// Takes the forces at the last value, at the start of a step, for the size of those to come.
    pub(crate) fn note_loads(&mut self) {
        let d = self.description();
        for (i, constraints) in d.resultants.iter().enumerate() {
            let force = |&c: &usize| self.force(d.constraints[c].row).value();
            let size = constraints.iter().map(force).fold(0.0, f64::hypot);
            let of = &mut self.resultants.of[i];
            of.largest = of.largest.max(size);
        }
    }

    /// Solves the equations of a mode in which frictions slip that several constraints press together.
    pub(super) fn solve_pressed(
        &mut self,
        extent: Extent,
        refined: bool,
    ) -> Result<(), EvaluationError> {
        self.turn_until_settled(|dynamics| {
            dynamics.place_directions();
            dynamics.solve_system(extent, refined)?;
            Ok(dynamics.turn_to_forces())
        })
    }

    /// Turns directions until they settle; `turn` solves with those there are, and says what has been across of what it found.
    fn turn_until_settled(
        &mut self,
        mut turn: impl FnMut(&mut Self) -> Result<f64, EvaluationError>,
    ) -> Result<(), EvaluationError> {
        if settle::<T, _>(|| turn(self))? {
            return Ok(());
        }
        let d = self.description();
        let first = self.compiled().pattern.sliding.resultants.first();
        let first = first.map(|given| d.constraints[d.resultants[given.resultant][0]].row);
        let row = first.unwrap_or(0);
        Err(EvaluationError::Undetermined { row })
    }

    /// Writes the directions into the registers.
    fn place_directions(&mut self) {
        let (_, _, interpreted) = self.modes[self.current].parts();
        let shape = interpreted.shape.clone();
        for given in &shape.resultants {
            let along = self.resultants.of[given.resultant].along;
            for (register, along) in given.along.into_iter().zip(along) {
                interpreted.registers[register.index()] = along;
            }
            interpreted.registers[given.rest.0.index()] = T::zero();
        }
    }

    /// Turns every direction to where its forces point at this value, unless they vanish. Returns how far it did not.
    fn turn_to_forces(&mut self) -> f64 {
        let (_, _, interpreted) = self.modes[self.current].parts();
        let (shape, registers, _) = interpreted.parts();
        let mut across = 0.0_f64;
        for given in &shape.resultants {
            let of = &mut self.resultants.of[given.resultant];
            let forces = forces(given, |i| registers[shape.unknowns[i].index()]);
            of.size = length(forces).value();
            across = across.max(of.turn(forces, VANISHING * of.largest));
        }
        across
    }

    /// Coefficients up to `order` in such a mode, from values in the registers.
    pub(super) fn expand_pressed(&mut self, order: usize) -> Result<(), EvaluationError> {
        let expand = match self.compiled().pattern.sliding.slip_directions.is_empty() {
            true => Self::expand_anew,
            false => Self::expand_from_rest,
        };
        self.find_leading(order.max(FEWEST), expand)?;
        self.with_roots(order, expand)
    }

    /// Finds with which order forces begin that may vanish here, and where they point.
    fn find_leading(
        &mut self,
        order: usize,
        expand: fn(&mut Self, usize) -> Result<(), EvaluationError>,
    ) -> Result<(), EvaluationError> {
        let suspects = self.nearly_without_load();
        for of in &mut self.resultants.of {
            of.leading = Some(0);
        }
        if suspects.is_empty() {
            return Ok(());
        }
        let held: Vec<Vector<T>> = self.resultants.of.iter().map(|of| of.along).collect();
        for &i in &suspects {
            let of = &mut self.resultants.of[i];
            (of.along, of.leading) = ([T::zero(); 3], None);
        }
        self.place_directions();
        self.solve_system(Extent::Series, true)?;
        self.with_roots(order, expand)?;
        let mut highest = 0;
        for &i in &suspects {
            let of = &mut self.resultants.of[i];
            of.leading = first_order(&of.forces[..=order]);
            if of.leading == Some(0) {
                of.along = held[i];
            }
            highest = highest.max(of.leading.unwrap_or(0));
        }
        self.turn_until_settled(|dynamics| {
            dynamics.place_directions();
            dynamics.solve_system(Extent::Series, true)?;
            dynamics.with_roots(highest.max(1), expand)?;
            let mut across = 0.0_f64;
            for of in &mut dynamics.resultants.of {
                if let Some(first) = of.leading {
                    across = across.max(of.turn(of.forces[first], 0.0));
                }
            }
            Ok(across)
        })
    }

    /// Resultants that are small beside what they have been or, where a run begins, beside what moves the system.
    fn nearly_without_load(&self) -> Vec<usize> {
        let pattern = &self.compiled().pattern;
        let pressing = pattern.sliding.resultants.iter();
        let drives = self.right[..pattern.size()].iter();
        let driven = drives.fold(0.0_f64, |most, drive| most.max(drive.value().abs()));
        let small = |i: &usize| {
            let of = &self.resultants.of[*i];
            let before = if of.largest > 0.0 { of.largest } else { driven };
            !(before > 0.0 && of.size > SMALL * before)
        };
        pressing
            .map(|given| given.resultant)
            .filter(small)
            .collect()
    }
}

/// The order of the first coefficient that is there beside those of higher order, over the time in which the last ones of them change.
fn first_order<T: Scalar>(coefficients: &[Vector<T>]) -> Option<usize> {
    let sizes = coefficients.iter().map(|&c| length(c).value());
    let sizes: Vec<f64> = sizes.collect();
    let largest = sizes.iter().fold(0.0_f64, |m, &x| m.max(x));
    if !(largest > 0.0) {
        return None;
    }
    // The last coefficients shrink or grow by the time in which the series changes; every other one may vanish.
    let (last, middle) = (sizes.len() - 1, sizes.len() / 2);
    let near = |k: usize| sizes[k].max(sizes[k - 1]);
    let time = (near(middle) / near(last)).powf(1.0 / (last - middle) as f64);
    let time = if time.is_normal() { time } else { 1.0 };
    let scaled: Vec<f64> = (0..).zip(&sizes).map(|(k, x)| x * time.powi(k)).collect();
    let largest = scaled.iter().fold(0.0_f64, |m, &x| m.max(x));
    scaled.iter().position(|&x| x > VANISHING * largest)
}
