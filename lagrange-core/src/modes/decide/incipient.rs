//! Where a slip of two components begins: ṡ ∥ u, for the friction that points against u.
//!
//! ṡ(u) × u = 0 with ṡ·u > 0. Where the slip begins smoothly (equal coefficients of friction) ṡ vanishes at the answer, but
//! ṡ × u still changes its sign there.

use super::questions::row_acceleration;
use super::{Decider, EvaluationPoint};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, solve_small};
use crate::mode::{Direction, FrictionMode};
use crate::modes::redundant::RedundantForces;
use crate::modes::table::Table;
use core::f64::consts::TAU;

/// Directions that are tried for one slip.
const TRIES: usize = 16;
/// Iterations that make a direction exact.
const MOST_ITERATIONS: usize = 60;
/// ṡ·u below this share of the largest ṡ is not positive, nor negative.
const NOTHING: f64 = 1e-6;

/// ṡ in the frame of u: along it and across.
#[derive(Clone, Copy, Debug)]
struct Turn {
    along: f64,
    across: f64,
}

/// ṡ where the equations have no solution.
const NO_TURN: Turn = Turn {
    along: f64::NAN,
    across: f64::NAN,
};

/// Memory of the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Beginning {
    /// Frictions whose slips begin, and their angles.
    frictions: Vec<usize>,
    angles: Vec<f64>,
    /// ṡ × u of each, its change with each angle by rows, and what is to be taken from the angles.
    across: Vec<f64>,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl<T: Scalar> Decider<T> {
    /// Finds the directions in which the slips of `self.posed` begin, and writes them there. False: there are none.
    ///
    /// Of several the one nearest to that of what made it stick is taken.
    pub(super) fn find_directions(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let frictions = &mut self.beginning.frictions;
        frictions.clear();
        frictions.extend(self.posed.incipient().map(|(f, _)| f));
        for shared in [false, true] {
            self.against_sticking(dynamics, moment, shared);
            self.point();
            dynamics.set_mode(&self.posed);
            dynamics.set_extra_needs(&table.of(dynamics).deciding);
            let found = if self.beginning.frictions.len() == 1 {
                self.look_around(dynamics, moment)?
            } else {
                self.beginning.settle(dynamics, moment)?
                    || shared && {
                        self.beginning.drift(dynamics, moment)?;
                        self.beginning.settle(dynamics, moment)?
                    }
            };
            self.point();
            if found {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Angles against the forces that would keep the slips at zero; of forces that the motion leaves open the least if they are
    /// to be `shared`, else those of some rows.
    fn against_sticking(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
        shared: bool,
    ) {
        let EvaluationPoint { t, q, v, .. } = moment;
        let sticking = &mut self.decision.mode;
        sticking.clone_from(&self.posed);
        let Beginning {
            frictions, angles, ..
        } = &mut self.beginning;
        for &f in &*frictions {
            sticking.frictions[f] = FrictionMode::Stick;
        }
        dynamics.set_mode(sticking);
        let facts = dynamics.value(t, q, v).is_ok();
        let shared = facts && shared && dynamics.has_dependent_rows();
        let least = shared.then(|| RedundantForces::default().report(dynamics, &mut Vec::new()));
        let force = |row: usize| match &least {
            Some(forces) => forces[row].value(),
            None => dynamics.force(row).value(),
        };
        let angle = |&f: &usize| {
            let row = dynamics.description().frictions[f].row;
            let [x, y] = [row, row + 1].map(force);
            let angle = (-y).atan2(-x);
            if facts && angle.is_finite() {
                angle
            } else {
                0.0
            }
        };
        angles.clear();
        angles.extend(frictions.iter().map(angle));
    }

    /// Writes the directions into the candidate.
    fn point(&mut self) {
        let Beginning {
            frictions, angles, ..
        } = &self.beginning;
        for (&f, angle) in frictions.iter().zip(angles) {
            let along = [angle.cos(), angle.sin()];
            self.posed.turn(f, Direction::Incipient(along));
        }
    }

    /// All directions of one slip: that nearest to its angle.
    fn look_around(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let (f, guess) = (self.beginning.frictions[0], self.beginning.angles[0]);
        let mut failure = None;
        // In some directions friction may lock itself.
        let mut turn = |angle: f64| {
            turn_of(dynamics, moment, f, angle).unwrap_or_else(|error| {
                failure = Some(error);
                NO_TURN
            })
        };
        let step = TAU / TRIES as f64;
        // The guess lies within the first interval.
        let first = guess - 0.5 * step;
        let mut roots = [(0.0, f64::NEG_INFINITY); TRIES];
        let mut largest = 0.0_f64;
        let mut low = turn(first);
        for (k, root) in roots.iter_mut().enumerate() {
            let from = first + step * k as f64;
            let high = turn(from + step);
            largest = largest.max(high.along.abs()).max(high.across.abs());
            if low.across * high.across <= 0.0 {
                let at = sharpen(&mut turn, (from, low), (from + step, high));
                *root = (at, turn(at).along);
            }
            low = high;
        }
        let far = |at: f64| (at - guess - TAU * ((at - guess) / TAU).round()).abs();
        let begins = |least: f64| {
            let roots = roots.iter();
            roots.filter(move |(_, along)| *along > least * largest)
        };
        let nearest = begins(-NOTHING).min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
        let Some(&(nearest, _)) = nearest else {
            return failure.map_or(Ok(false), Err);
        };
        self.forks = begins(NOTHING).count() > 1;
        self.beginning.angles[0] = nearest;
        Ok(true)
    }
}

impl Beginning {
    /// ṡ × u of all.
    fn turn<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<(), EvaluationError> {
        for (&f, angle) in self.frictions.iter().zip(&self.angles) {
            let (y, x) = angle.sin_cos();
            dynamics.set_slip_direction(f, [x, y].map(T::from_f64));
        }
        dynamics.value(moment.t, moment.q, moment.v)?;
        let across = |&f: &usize| frame_of(dynamics, f).across;
        self.across.clear();
        self.across.extend(self.frictions.iter().map(across));
        Ok(())
    }

    /// Turns all directions towards the slips that they bring about, u + τ ṡ(u): with given normal forces the greatest dissipation is
    /// found so, by projected gradients (Moreau 1974, in New Variational Techniques in Mathematical Physics, Edizioni Cremonese, 175).
    fn drift<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<(), EvaluationError> {
        let begins = |dynamics: &mut Dynamics<T>, frictions: &[usize], along: &[[f64; 2]]| {
            for (&f, along) in frictions.iter().zip(along) {
                dynamics.set_slip_direction(f, along.map(T::from_f64));
            }
            dynamics.value(moment.t, moment.q, moment.v)?;
            let of = |&f: &usize| {
                let row = dynamics.description().frictions[f].row;
                [row, row + 1].map(|row| row_acceleration(row, dynamics))
            };
            Ok(frictions.iter().map(of).collect::<Vec<_>>())
        };
        let frictions = &self.frictions;
        let free = begins(dynamics, frictions, &vec![[0.0; 2]; frictions.len()])?;
        for _ in 0..MOST_ITERATIONS {
            let along: Vec<_> = (self.angles.iter())
                .map(|angle| [angle.cos(), angle.sin()])
                .collect();
            let held = begins(dynamics, frictions, &along)?;
            let changes = free.iter().zip(&held);
            let changes = changes.map(|(x, y)| (x[0] - y[0]).hypot(x[1] - y[1]));
            let part = 0.5 / changes.fold(0.0, f64::max);
            if !part.is_finite() {
                break;
            }
            for ((angle, along), slip) in self.angles.iter_mut().zip(along).zip(held) {
                *angle = (along[1] + part * slip[1]).atan2(along[0] + part * slip[0]);
            }
        }
        Ok(())
    }

    /// The directions of several slips that begin together, by Newton's method from their angles.
    fn settle<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        /// Step of the differences.
        const SMALL: f64 = 1e-6;
        let m = self.frictions.len();
        for _ in 0..MOST_ITERATIONS {
            self.turn(dynamics, moment)?;
            // Right at once, as by symmetry: forces that the motion leaves open may make what follows singular.
            let across = self.across.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let along = self.frictions.iter().map(|&f| frame_of(dynamics, f).along);
            if across <= 8.0 * f64::EPSILON * along.fold(0.0_f64, |m, x| m.max(x.abs())) {
                break;
            }
            self.right.clone_from(&self.across);
            self.matrix.clear();
            self.matrix.resize(m * m, 0.0);
            for j in 0..m {
                let held = self.angles[j];
                self.angles[j] = held + SMALL;
                self.turn(dynamics, moment)?;
                self.angles[j] = held;
                for i in 0..m {
                    self.matrix[i * m + j] = (self.across[i] - self.right[i]) / SMALL;
                }
            }
            if !solve_small(&mut self.matrix, &mut self.right) {
                return Ok(false);
            }
            let mut largest = 0.0_f64;
            for (angle, by) in self.angles.iter_mut().zip(&self.right) {
                *angle -= by.clamp(-1.0, 1.0);
                largest = largest.max(by.abs());
            }
            if largest <= 4.0 * f64::EPSILON {
                break;
            }
        }
        self.turn(dynamics, moment)?;
        let turns = || self.frictions.iter().map(|&f| frame_of(dynamics, f));
        let largest = turns().fold(0.0_f64, |m, turn| m.max(turn.along.abs()));
        let mut turns = turns();
        Ok(turns.all(|turn| turn.along >= -NOTHING * largest && turn.across.is_finite()))
    }
}

/// ṡ of friction `f` if it begins to slip at an angle.
fn turn_of<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    moment: EvaluationPoint<'_, T>,
    f: usize,
    angle: f64,
) -> Result<Turn, EvaluationError> {
    let (y, x) = angle.sin_cos();
    dynamics.set_slip_direction(f, [x, y].map(T::from_f64));
    dynamics.value(moment.t, moment.q, moment.v)?;
    Ok(frame_of(dynamics, f))
}

/// ṡ of friction `f` in the frame of its slip direction, at the last value.
fn frame_of<T: Scalar>(dynamics: &Dynamics<T>, f: usize) -> Turn {
    let row = dynamics.description().frictions[f].row;
    let [x, y] = dynamics.slip_direction(f).map(|x| x.value());
    let [a, b] = [row, row + 1].map(|row| row_acceleration(row, dynamics));
    Turn {
        along: a * x + b * y,
        across: a * y - b * x,
    }
}

/// Where `across` vanishes between two angles at which it has different signs (Illinois' variant of regula falsi).
fn sharpen(turn: &mut impl FnMut(f64) -> Turn, low: (f64, Turn), high: (f64, Turn)) -> f64 {
    let ((mut a, fa), (mut b, fb)) = (low, high);
    let (mut fa, mut fb) = (fa.across, fb.across);
    for _ in 0..MOST_ITERATIONS {
        let c = b - fb * (b - a) / (fb - fa);
        let c = if c.is_finite() { c } else { 0.5 * (a + b) };
        let fc = turn(c).across;
        if fc == 0.0 {
            return c;
        }
        if (fc < 0.0) == (fb < 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
        if (b - a).abs() <= f64::EPSILON * (1.0 + b.abs()) {
            break;
        }
    }
    b
}
