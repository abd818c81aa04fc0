//! Where a slip of two components begins: ṡ ∥ u, for the friction that points against u.
//!
//! ṡ(u) × u = 0 with ṡ·u > 0. Where the slip begins smoothly (equal coefficients of friction) ṡ vanishes at the answer, but
//! ṡ × u still changes its sign there, unless the slip can have one direction only: then what it grows by next, s̈ × u, decides. So it does where all
//! forces vanish at the instant, as under a load that grows from zero: there the first coefficient of s that does not vanish takes the place of ṡ.

use super::Decider;
use super::questions::{concerns, row_acceleration};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::linear::{VanishingCombinations, solve_small};
use crate::mode::{Direction, FrictionMode};
use crate::modes::exact;
use crate::modes::facts::{EvaluationPoint, SwitchContext};
use crate::modes::guard::Guard;
use crate::modes::redundant::RedundantForces;
use crate::modes::table::Table;
use core::f64::consts::TAU;

/// A slip that begins with no coefficient up to this one is not looked for.
const LATEST: usize = 4;
/// Directions that are tried for one slip.
const TRIES: usize = 16;
/// Step of differences between angles.
const SMALL: f64 = 1e-6;
/// Changes as small as this shrink fast in Newton's method, until rounding is left: what is
const SETTLED: f64 = 1e-5;
/// more than this share of the change before it changes no more.
const STEADY: f64 = 0.9;
/// Combinations of ṡ that should not change with the directions do, relative, by so many times the last change of these,
const OFF: f64 = 10.0;
/// at most.
const UNCLEAR: f64 = 1e-2;
/// Iterations that make a direction exact.
const MOST_ITERATIONS: usize = 60;
/// ṡ·u below this share of the largest ṡ, or of what frictions do to it, is not positive, nor negative,
const NOTHING: f64 = 1e-6;
/// and where a force was located at its limit, below so many times what it is from it.
const RESIDUES: f64 = 10.0;
/// Of what makes ṡ, rounding leaves no more than this share.
const ROUNDING: f64 = 1e-12;

/// ṡ, or a later coefficient of the slip, in the frame of u: along it and across.
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

/// What is found among all directions of one slip.
enum Around {
    /// None in which it begins.
    Nothing,
    /// That nearest to its angle.
    Direction,
    /// One where ṡ × u hardly changes with the direction, and does not tell it exactly.
    Flat,
}

/// Memory of the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Beginning {
    /// Frictions whose slips begin, and their angles.
    frictions: Vec<usize>,
    angles: Vec<f64>,
    /// Other angles at which one slip may begin, the nearest last.
    others: Vec<f64>,
    /// Share below which ṡ·u is not positive, nor negative.
    nothing: f64,
}

impl<T: Scalar> Decider<T> {
    /// Finds the directions in which the slips of `self.posed` begin, and writes them there. False: there are none.
    ///
    /// Of several the one nearest to that of what made it stick is taken, and the others are remembered.
    pub(super) fn find_directions(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let moment = here.moment;
        let frictions = &mut self.beginning.frictions;
        frictions.clear();
        frictions.extend(self.posed.incipient().map(|(f, _)| f));
        let located = |&f: &usize| concerns(Guard::Slip(f), &[], here.facts);
        self.beginning.nothing = match self.beginning.frictions.iter().any(located) {
            true => NOTHING.max(RESIDUES * here.blur()),
            false => NOTHING,
        };
        for shared in [false, true] {
            self.beginning.others.clear();
            self.against_sticking(dynamics, moment, shared);
            self.point();
            dynamics.set_mode(&self.posed);
            dynamics.set_extra_needs(&table.of(dynamics).deciding);
            let alone = self.beginning.frictions.len() == 1;
            let found = match alone {
                true => self.look_all_around(dynamics, moment)?,
                false => Around::Flat,
            };
            let found = match found {
                Around::Nothing => false,
                Around::Direction => true,
                Around::Flat => {
                    self.beginning.settle_along(dynamics, moment)?
                        || shared && {
                            self.beginning.drift(dynamics, moment)?;
                            self.beginning.settle_along(dynamics, moment)?
                        }
                }
            };
            self.point();
            if found {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Turns the one slip that begins to the next of the directions that were found. False: there is none.
    pub(super) fn turn_to_another(&mut self) -> bool {
        let next = self.beginning.others.pop();
        if let Some(angle) = next {
            self.beginning.angles[0] = angle;
            self.point();
        }
        next.is_some()
    }

    /// Turns the directions round against which slips begin although the friction has no force there, which would tell them. False: there are none.
    pub(super) fn turn_back(&mut self, dynamics: &Dynamics<T>, violated: &[Guard]) -> bool {
        let Beginning {
            frictions, angles, ..
        } = &mut self.beginning;
        let mut turned = false;
        for (&f, angle) in frictions.iter().zip(angles) {
            let limit = exact::kinetic_limit(f, &self.posed, dynamics);
            if limit.value() == 0.0 && violated.contains(&Guard::Slip(f)) {
                *angle += 0.5 * TAU;
                turned = true;
            }
        }
        self.point();
        turned
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

    /// All directions of one slip: that nearest to its angle, by the first coefficient that does not vanish.
    fn look_all_around(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<Around, EvaluationError> {
        if let Some(around) = self.look_around(dynamics, moment, 1)? {
            return Ok(around);
        }
        let (f, guess) = (self.beginning.frictions[0], self.beginning.angles[0]);
        for order in 2..=LATEST {
            let Turn { along, across } = turn_of(dynamics, moment, f, guess, order)?;
            if (along, across) != (0.0, 0.0) {
                let around = self.look_around(dynamics, moment, order)?;
                return Ok(around.unwrap_or(Around::Nothing));
            }
        }
        Ok(Around::Nothing)
    }

    /// The same by coefficient `order`; nothing if ṡ vanishes in all directions.
    fn look_around(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
        order: usize,
    ) -> Result<Option<Around>, EvaluationError> {
        let (f, guess) = (self.beginning.frictions[0], self.beginning.angles[0]);
        let mut failure = None;
        // In some directions friction may lock itself.
        let mut turn = |dynamics: &mut Dynamics<T>, angle: f64| {
            turn_of(dynamics, moment, f, angle, order).unwrap_or_else(|error| {
                failure = Some(error);
                NO_TURN
            })
        };
        let step = TAU / TRIES as f64;
        // The guess lies within the first interval.
        let first = guess - 0.5 * step;
        let mut roots = [(0.0, f64::NEG_INFINITY); TRIES + 2];
        let (between, only) = roots.split_at_mut(TRIES);
        let (mut largest, mut fastest) = (0.0_f64, (0.0, 0.0));
        let mut low = turn(dynamics, first);
        for (k, root) in between.iter_mut().enumerate() {
            let from = first + step * k as f64;
            let high = turn(dynamics, from + step);
            largest = largest.max(high.along.abs()).max(high.across.abs());
            let speed = high.along.hypot(high.across);
            if speed > fastest.0 {
                fastest = (speed, from + step - high.across.atan2(high.along));
            }
            if low.across * high.across <= 0.0 {
                let mut turn = |angle| turn(dynamics, angle);
                let at = sharpen(&mut turn, (from, low), (from + step, high));
                *root = (at, turn(at).along);
            }
            low = high;
        }
        // A later coefficient is looked at only where it does not.
        if order == 1 && largest <= ROUNDING * size_of(dynamics, f) {
            return failure.map_or(Ok(None), Err);
        }
        // A slip that can have one direction only, forth and back, may have two roots between two tries.
        for (root, back) in only.iter_mut().zip([0.0, 0.5]) {
            let at = fastest.1 + TAU * back;
            let Turn { along, across } = turn(dynamics, at);
            if across.abs() <= ROUNDING * largest {
                *root = (at, along);
            }
        }
        let far = |at: f64| (at - guess - TAU * ((at - guess) / TAU).round()).abs();
        let begins = |least: f64| {
            let roots = roots.iter();
            roots.filter(move |(_, along)| *along > least * largest)
        };
        let others = &mut self.beginning.others;
        others.extend(begins(-self.beginning.nothing).map(|(at, _)| *at));
        others.sort_by(|a, b| far(*b).total_cmp(&far(*a)));
        let Some(nearest) = others.pop() else {
            return failure.map_or(Ok(Some(Around::Nothing)), Err);
        };
        self.forks = begins(NOTHING).count() > 1;
        self.beginning.angles[0] = nearest;
        let [here, beside] = [nearest, nearest + SMALL].map(|at| turn(dynamics, at).across);
        let change = (beside - here) / SMALL;
        let flat = order == 1 && change.abs() <= NOTHING * largest;
        Ok(Some(match flat {
            true => Around::Flat,
            false => Around::Direction,
        }))
    }
}

impl Beginning {
    /// The directions.
    fn along(&self) -> Vec<[f64; 2]> {
        let angles = self.angles.iter();
        angles.map(|angle| [angle.cos(), angle.sin()]).collect()
    }

    /// Numbers that depend on the directions, and their changes with each angle, by rows.
    fn with_changes(
        &self,
        mut numbers: impl FnMut(&Self) -> Result<Vec<f64>, EvaluationError>,
    ) -> Result<(Vec<f64>, Vec<f64>), EvaluationError> {
        let m = self.angles.len();
        let here = numbers(self)?;
        let mut changes = vec![0.0; m * m];
        let mut turned = self.clone();
        for j in 0..m {
            turned.angles[j] += SMALL;
            let there = numbers(&turned)?;
            turned.angles[j] = self.angles[j];
            for i in 0..m {
                changes[i * m + j] = (there[i] - here[i]) / SMALL;
            }
        }
        Ok((here, changes))
    }

    /// Turns all directions towards the slips that they bring about, u + τ ṡ(u): with given normal forces the greatest dissipation is
    /// found so, by projected gradients (Moreau 1974, in New Variational Techniques in Mathematical Physics, Edizioni Cremonese, 175).
    fn drift<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<(), EvaluationError> {
        let frictions = &self.frictions;
        let free = begin(
            dynamics,
            moment,
            frictions,
            &vec![[0.0; 2]; frictions.len()],
        )?;
        for _ in 0..MOST_ITERATIONS {
            let along = self.along();
            let held = begin(dynamics, moment, frictions, &along)?;
            let changes = differences(&free, &held);
            let part = 0.5 / changes.into_iter().fold(0.0, f64::max);
            if !part.is_finite() {
                break;
            }
            for ((angle, along), slip) in self.angles.iter_mut().zip(along).zip(held) {
                *angle = (along[1] + part * slip[1]).atan2(along[0] + part * slip[0]);
            }
        }
        Ok(())
    }

    /// The directions of slips that begin together, by Newton's method from their angles. Where it ends in directions against which slips begin, once
    /// more from those turned round.
    fn settle_along<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        for _ in 0..=self.frictions.len() {
            if self.settle(dynamics, moment)? {
                return Ok(true);
            }
            let mut turned = false;
            for (angle, &f) in self.angles.iter_mut().zip(&self.frictions) {
                if frame_of(dynamics, f).along < 0.0 {
                    *angle += 0.5 * TAU;
                    turned = true;
                }
            }
            if !turned {
                break;
            }
        }
        Ok(false)
    }

    /// The same, whether slips begin along these directions or against them; whether they do so along them.
    fn settle<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let m = self.frictions.len();
        let free = begin(dynamics, moment, &self.frictions, &vec![[0.0; 2]; m])?;
        let held = begin(dynamics, moment, &self.frictions, &self.along())?;
        let sizes: Vec<f64> = (self.frictions.iter())
            .map(|&f| size_of(dynamics, f))
            .collect();
        let mut strengths = differences(&free, &held);
        for (strength, size) in strengths.iter_mut().zip(&sizes) {
            if *strength <= ROUNDING * size {
                *strength = 0.0;
            }
        }
        let mut open = VanishingCombinations::default();
        let (mut before, mut unclear) = (f64::INFINITY, UNCLEAR);
        for _ in 0..MOST_ITERATIONS {
            let (mut right, mut matrix) = self.with_changes(|beginning| {
                let slips = begin(dynamics, moment, &beginning.frictions, &beginning.along())?;
                let pairs = slips.into_iter().zip(beginning.along());
                Ok(pairs.map(|([a, b], [x, y])| a * y - b * x).collect())
            })?;
            // As long as angles are off, so is what would vanish; what does not once they are known never does, or both answers would take turns.
            let off = if before.is_finite() {
                unclear = unclear.min(OFF * before).max(SMALL);
                unclear
            } else {
                SMALL
            };
            open.find(&matrix, &strengths, off);
            // Right at once, as by symmetry: forces that the motion leaves open may make what follows singular.
            let mut across = right.iter().zip(strengths.iter().zip(&sizes));
            let vanish = across
                .all(|(x, (strength, size))| x.abs() <= 8.0 * f64::EPSILON * (strength + size));
            if vanish && open.is_empty() {
                break;
            }
            if !open.is_empty() {
                let (next, changes) =
                    self.with_changes(|beginning| beginning.bends(dynamics, moment))?;
                for (row, weights) in open.iter() {
                    let weighted = |term: &dyn Fn(usize) -> f64| {
                        let terms = weights.iter().enumerate();
                        terms.map(|(i, weight)| weight * term(i)).sum::<f64>()
                    };
                    right[row] = weighted(&|i| next[i]);
                    for j in 0..m {
                        matrix[row * m + j] = weighted(&|i| changes[i * m + j]);
                    }
                }
            }
            if !solve_small(&mut matrix, &mut right) {
                if vanish {
                    break;
                }
                return Ok(false);
            }
            let mut largest = 0.0_f64;
            for (angle, by) in self.angles.iter_mut().zip(&right) {
                *angle -= by.clamp(-1.0, 1.0);
                largest = largest.max(by.abs());
            }
            let settled = largest <= SETTLED && largest > STEADY * before;
            if settled || largest <= 4.0 * f64::EPSILON {
                break;
            }
            before = largest;
        }
        begin(dynamics, moment, &self.frictions, &self.along())?;
        let turns = || self.frictions.iter().map(|&f| frame_of(dynamics, f));
        let largest = turns().fold(0.0_f64, |m, turn| m.max(turn.along.abs()));
        let mut turns = turns().zip(strengths);
        Ok(turns.all(|(turn, strength)| {
            turn.along >= -self.nothing * largest.max(strength) && turn.across.is_finite()
        }))
    }

    /// Coefficient 2 of s × u of all.
    fn bends<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<Vec<f64>, EvaluationError> {
        for (&f, along) in self.frictions.iter().zip(self.along()) {
            dynamics.set_slip_direction(f, along.map(T::from_f64));
        }
        let bends = dynamics.bends(moment.t, moment.q, moment.v)?;
        Ok(bends.iter().map(|x| x.value()).collect())
    }
}

/// ṡ of frictions that begin to slip in these directions, whose values `dynamics` then holds.
fn begin<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    moment: EvaluationPoint<'_, T>,
    frictions: &[usize],
    along: &[[f64; 2]],
) -> Result<Vec<[f64; 2]>, EvaluationError> {
    for (&f, along) in frictions.iter().zip(along) {
        dynamics.set_slip_direction(f, along.map(T::from_f64));
    }
    dynamics.value(moment.t, moment.q, moment.v)?;
    let of = |&f: &usize| {
        let row = dynamics.description().frictions[f].row;
        [row, row + 1].map(|row| row_acceleration(row, dynamics))
    };
    Ok(frictions.iter().map(of).collect())
}

/// The size of what makes ṡ of friction `f` at the last value.
fn size_of<T: Scalar>(dynamics: &Dynamics<T>, f: usize) -> f64 {
    let d = dynamics.description();
    let row = d.frictions[f].row;
    let terms = (row..row + 2).map(|row| {
        let size = |j: usize| dynamics.acceleration()[j].value().abs();
        let bias = dynamics.motion(d.rows[row].bias).value().abs();
        dynamics.size_of_row(row, size) + bias
    });
    terms.sum()
}

/// The distance of each ṡ from another one.
fn differences(a: &[[f64; 2]], b: &[[f64; 2]]) -> Vec<f64> {
    let pairs = a.iter().zip(b);
    pairs
        .map(|(x, y)| (x[0] - y[0]).hypot(x[1] - y[1]))
        .collect()
}

/// Coefficient `order` of the slip of friction `f` if it begins at an angle.
fn turn_of<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    moment: EvaluationPoint<'_, T>,
    f: usize,
    angle: f64,
    order: usize,
) -> Result<Turn, EvaluationError> {
    let EvaluationPoint { t, q, v, .. } = moment;
    let (y, x) = angle.sin_cos();
    dynamics.set_slip_direction(f, [x, y].map(T::from_f64));
    if order == 1 {
        dynamics.value(t, q, v)?;
        return Ok(frame_of(dynamics, f));
    }
    let slip = dynamics.slip_ahead(f, order, t, q, v)?;
    Ok(in_frame(slip.map(|s| s.value()), [x, y]))
}

/// ṡ of friction `f` in the frame of its slip direction, at the last value.
fn frame_of<T: Scalar>(dynamics: &Dynamics<T>, f: usize) -> Turn {
    let row = dynamics.description().frictions[f].row;
    let slip = [row, row + 1].map(|row| row_acceleration(row, dynamics));
    in_frame(slip, dynamics.slip_direction(f).map(|x| x.value()))
}

/// A coefficient of a slip in the frame of its direction.
fn in_frame([a, b]: [f64; 2], [x, y]: [f64; 2]) -> Turn {
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
