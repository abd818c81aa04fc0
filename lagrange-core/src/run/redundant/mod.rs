//! Undetermined forces along a run: which guards decide, and what is reported.
//!
//! Guards of single undetermined forces mean nothing; in their place stand composite guards, found where a step ends in a state
//! that no admissible forces allow. The root of such a guard is the end of the mode. Where the dependence of the rows
//! changes along the motion, the weights of the guard are taken again at its root until both agree. Where the directions of friction turn so fast
//! that they never do, the instant at which forces cease to keep all bounds is located by the forces themselves.

mod margins;
mod watched;
mod within;

use super::Run;
use super::hit::Hit;
use crate::arithmetic::Scalar;
use crate::arithmetic::products::ROW;
use crate::error::Error;
use crate::modes::composite::CompositeGuard;
use crate::modes::guard::Guard;
use crate::modes::reading::Reading;

/// A composite guard above this (relative) is not about to fall.
const BORDER: f64 = 1e-3;

/// So far may the root of a composite guard be from the border, relative: beyond, its weights were those of another state.
const ROOT: f64 = 1e-9;

/// So often are the composite guards of one step found anew.
const MOST_CORRECTIONS: usize = 12;

/// After so many the forces themselves are asked where they cease to keep all bounds.
const CORRECTIONS: usize = 4;

/// The last terms of forces in a step are no larger than this share of the first ones.
const LAST_TERMS: f64 = 1e-6;
/// The terms of this order are no larger than this share, where directions turn: what turns by a radian is looked at four times.
const TURNING: (usize, f64) = (8, 1e-2);

/// Bounds that are all this small, relative, are those of no load.
const NO_LOAD: f64 = 1e-6;

/// Where loads turn as a step begins one is tried that is shorter by this.
const SHORTER: f64 = 0.25;

/// So many steps later it is seen whether forces are allowed that are not at the instant.
const LATER: [f64; 3] = [1e-6, 1e-4, 1e-2];

impl<T: Scalar> Run<T> {
    /// Looks at the forces at the last value of the dynamics, in the mode of the run; whether other guards decide than before.
    fn look_at_redundant_forces(&mut self) -> bool {
        let was_open = self.switcher.redundant.has_open();
        self.switcher.redundant.follow(&mut self.dynamics);
        (was_open || self.switcher.redundant.has_open()) && self.list_guards()
    }

    /// How long a step may be for what is looked at within it to tell how undetermined forces change, by the series at hand: their guards do
    /// not bound it as long as none is near.
    pub(super) fn longest_of_shared_loads(&mut self, order: usize) -> f64 {
        if !self.switcher.redundant.has_open() {
            return f64::INFINITY;
        }
        let mut sizes = [0.0_f64; ROW];
        for &row in self.dynamics.acting_rows() {
            for (size, force) in sizes.iter_mut().zip(self.dynamics.force_series(row)) {
                *size = size.max(force.value().abs());
            }
        }
        // Loads that are nothing now may be large again.
        sizes[0] = self.switcher.redundant.largest_force(sizes[0]);
        let until = |last: usize, terms: f64| {
            let share = |first: usize| terms * sizes[first] / sizes[last];
            let times = (0..=last / 2).map(|first| share(first).powf(1.0 / (last - first) as f64));
            times.fold(0.0, f64::max)
        };
        // Every other term of a vibration is zero.
        let both = |order: usize, terms| until(order, terms).min(until(order - 1, terms));
        let mut longest = both(order, LAST_TERMS);
        if self.directions_turn() {
            let (turning, terms) = TURNING;
            longest = longest.min(both(turning.min(order), terms));
        }
        if longest > 0.0 {
            longest
        } else {
            f64::INFINITY
        }
    }

    /// Whether forces act in directions that change with the motion, so that what is open in them cancels otherwise from instant to instant.
    fn directions_turn(&self) -> bool {
        let rows = self.description().rows;
        let mut acting = self.dynamics.acting_rows().iter();
        acting.any(|&row| !rows[row].is_constant())
    }

    /// After a switch: guards, and the forces to be logged.
    pub(super) fn note_redundant_forces(&mut self) {
        let mut forces = core::mem::take(&mut self.recorder.forces_after);
        let mut undetermined = core::mem::take(&mut self.recorder.undetermined_after);
        self.reported_forces(&mut forces, &mut undetermined);
        (self.recorder.forces_after, self.recorder.undetermined_after) = (forces, undetermined);
        self.list_guards();
    }

    /// Lists the guards that decide; whether they are others than before.
    pub(super) fn list_guards(&mut self) -> bool {
        let watched = self.switcher.table.of(&self.dynamics);
        let redundant = &self.switcher.redundant;
        let single = watched.guards.iter().copied();
        let single = single.filter(|&guard| !redundant.is_open(guard));
        let curves = &mut self.locator.polynomials;
        curves.rearm(single, &self.now.mode, &self.dynamics)
    }

    /// At part `looked` of a step, its end or just before it, which the dynamics have evaluated, after `corrections` others:
    /// whether composite guards must be looked at again, because that state allows no forces, because one before it does not or
    /// comes near to it, or because the root of one was none.
    pub(super) fn corrects_composites(
        &mut self,
        hit: &Hit,
        looked: f64,
        corrections: &mut usize,
    ) -> bool {
        if !self.dynamics.has_dependent_rows() && !self.switcher.redundant.has_open() {
            return false;
        }
        let others = self.look_at_redundant_forces();
        // A step that ends with one too many gets somewhere at least.
        let most = match looked > 0.0 {
            true => MOST_CORRECTIONS,
            false => 2 * MOST_CORRECTIONS,
        };
        if *corrections >= most {
            return false;
        }
        if *corrections == 0 {
            self.locator.refuted.clear();
        }
        let critical = self.critical();
        let mut guards = self.locator.fallen.iter();
        let fallen = guards.find_map(|guard| match (hit, guard) {
            (Hit::Guards(_), Guard::Composite(k)) => Some(*k),
            _ => None,
        });
        let composites = &mut self.locator.polynomials.composites;
        // Located by the forces themselves: roots of others before it are those of weights that belong to another instant. Forces that grow beyond all bounds
        // there keep theirs until then.
        if let Some(k) = fallen
            && composites[k].falls_after.is_some()
            && critical.as_ref().is_none_or(|(_, value)| *value <= ROOT)
        {
            if let Some((composite, _)) = critical {
                composites[k].parts = composite.parts;
            }
            return false;
        }
        let within = looked > 0.0 && self.switcher.redundant.has_open();
        let (mut last_kept, asks_forces) = (0.0, *corrections >= CORRECTIONS);
        let within = within && self.finds_joints_within(looked, asks_forces, &mut last_kept);
        let mut again = within || others;
        // The weights of an instant may be none of another.
        let asks_forces = asks_forces && last_kept > 0.0;
        let composites = &mut self.locator.polynomials.composites;
        match (fallen, critical) {
            (None, Some((composite, value))) if value < -ROOT => {
                let refuted = is_like_one_of(&self.locator.refuted, &composite);
                match looked > 0.0 && (refuted || asks_forces) {
                    true => again |= self.locates_a_joint([last_kept, looked], looked),
                    false => {
                        composites.push(composite);
                        again = true;
                    }
                }
            }
            (Some(k), Some((composite, value))) => {
                let is_root = value.abs() <= ROOT;
                let falls_after = composites[k].falls_after.filter(|_| is_root);
                composites[k] = CompositeGuard {
                    falls_after,
                    ..composite
                };
                again |= !is_root;
                if value < -ROOT && asks_forces {
                    composites.remove(k);
                    again |= self.locates_a_joint([last_kept, looked], looked);
                }
            }
            (Some(k), None) => {
                self.locator.refuted.push(composites.remove(k));
                again = true;
            }
            _ => {}
        }
        if again {
            *corrections += 1;
            self.list_guards();
        }
        again
    }

    /// The same where composite guards are below zero as the step begins: their weights may be those of a state that the motion has left.
    pub(super) fn corrects_composites_at_start(
        &mut self,
        hit: &Hit,
        corrections: &mut usize,
    ) -> bool {
        let joint = |guard: &Guard| matches!(guard, Guard::Composite(_));
        self.locator.fallen.iter().any(joint)
            && self.evaluate_end(0.0).is_ok()
            && self.corrects_composites(hit, 0.0, corrections)
    }

    /// Whether nothing has fallen but composite guards, and the mode goes on. Forces may keep all bounds where the motion is now, because the
    /// weights of such a guard turn with directions of friction as fast as they are found anew. Or those of constraints kept them with one sign,
    /// and others with another sign do: nothing changes but how the load is shared.
    ///
    /// # Errors
    /// The end of the step cannot be evaluated.
    pub(super) fn only_shares_otherwise(&mut self) -> Result<bool, Error> {
        let joint = |guard: &Guard| matches!(guard, Guard::Composite(_));
        if !self.locator.fallen.iter().all(joint) {
            return Ok(false);
        }
        if !self.now.valued {
            self.evaluate()?;
        }
        // What is nearer to its border than roots are may be what has just ended.
        self.switcher.redundant.follow(&mut self.dynamics);
        // Its value, which has been located, is known to less than the margin of the programme.
        let composites = &self.locator.polynomials.composites;
        let mut guards = self.locator.fallen.iter();
        let located = guards.any(
            |guard| matches!(guard, Guard::Composite(k) if composites[*k].falls_after.is_some()),
        );
        let falls = located || self.critical().is_some_and(|(_, value)| value < ROOT);
        let keeps = self.switcher.redundant.has_open() && !falls;
        let turns =
            keeps || self.switcher.redundant.turn(&mut self.dynamics, ROOT) || self.turns_soon()?;
        if turns {
            self.locator.polynomials.composites.clear();
            self.list_guards();
        }
        Ok(turns)
    }

    /// Whether forces are allowed from here on of which none but zero are at this instant, where what presses a friction turns; signs of constraint forces that
    /// allow them are then taken.
    fn turns_soon(&mut self) -> Result<bool, Error> {
        let step = &self.stepper.step;
        let part = ((self.now.t - step.t) / step.h).value();
        let turns = |run: &mut Self, later: &f64| {
            run.evaluate_end(part + later).is_ok()
                && run.switcher.redundant.turn(&mut run.dynamics, ROOT)
        };
        let mut loads = self.switcher.redundant.values().iter();
        let vanish = loads.all(|value| value.abs() <= NO_LOAD);
        // Signs that have just been taken, at an instant that is known to rounding, are those of the motion from here on.
        let begins = (vanish || part == 0.0) && self.keeps_bounds_soon(part);
        let found = begins || LATER.iter().any(|later| turns(self, later));
        self.evaluate()?;
        self.switcher.redundant.follow(&mut self.dynamics);
        let found = found && self.critical().is_none_or(|(_, value)| value >= -ROOT);
        if found && begins {
            self.begin_at_borders(part);
        }
        Ok(found)
    }

    /// Whichever guards decide from here on, at part `part` of the step, begin at zero. Where the step begins here it may have been so long that loads turn
    /// again in it, and with guards that mean nothing here: the next one is shorter.
    fn begin_at_borders(&mut self, part: f64) {
        let begin = (0..2 * MOST_CORRECTIONS).map(|k| (Guard::Composite(k), 1));
        self.locator.zeros.extend(begin);
        if part == 0.0 {
            let shorter = Some(SHORTER * self.stepper.step.h.value());
            (self.stepper.guarded, self.stepper.wanted) = (shorter, shorter);
        }
    }

    /// Whether forces keep all bounds behind part `part` of the step, with the signs of constraint forces that there are.
    fn keeps_bounds_soon(&mut self, part: f64) -> bool {
        let mut clear = false;
        let keeps = LATER.iter().all(|later| {
            self.follows_forces_to(part + later) && {
                let redundant = &self.switcher.redundant;
                clear |= redundant.critical(ROOT).is_none();
                redundant.critical(-ROOT).is_none()
            }
        });
        keeps && clear
    }

    /// Whether undetermined forces keep all bounds up to part `end` of the step, wherever in it there are forces: what locates where they cease to does not know
    /// of a leap. `dynamics` holds other values afterwards.
    pub(super) fn keeps_bounds_until(&mut self, end: f64) -> bool {
        const PLACES: u32 = 16;
        let mut parts = (1..=PLACES).map(|place| end * f64::from(place) / f64::from(PLACES));
        !self.switcher.redundant.has_open()
            || parts.all(|part| {
                !self.follows_forces_to(part) || self.switcher.redundant.critical(-ROOT).is_none()
            })
    }

    /// Looks at undetermined forces at part `part` of the step, with the signs that there are. False: the state there cannot be evaluated.
    fn follows_forces_to(&mut self, part: f64) -> bool {
        let known = self.evaluate_end(part).is_ok();
        if known {
            self.switcher.redundant.follow(&mut self.dynamics);
        }
        known
    }

    /// Locates where between these parts of the step forces cease to keep all bounds, and adds the composite guard that says so; `dynamics` and
    /// `scratch` end at part `end` again. Not found: they do not keep them at the first part either.
    fn locates_a_joint(&mut self, [mut before, mut after]: [f64; 2], end: f64) -> bool {
        let critical_at = |run: &mut Self, part: f64| {
            let known = run.follows_forces_to(part);
            known.then(|| run.critical()).flatten()
        };
        let mut located = None;
        if critical_at(self, before).is_none_or(|(_, value)| value >= -ROOT) {
            while after - before > 2.0 * f64::EPSILON * after {
                let middle = 0.5 * (before + after);
                if middle <= before || middle >= after {
                    break;
                }
                match critical_at(self, middle) {
                    Some((composite, value)) if value < 0.0 => {
                        (after, located) = (middle, Some(composite));
                    }
                    _ => before = middle,
                }
            }
        }
        let located = located.or_else(|| Some(critical_at(self, after)?.0));
        let falls_after = Some(after * self.stepper.step.h.value());
        let located = located.map(|composite| CompositeGuard {
            falls_after,
            ..composite
        });
        let found = located.is_some() && before > 0.0;
        if found {
            self.locator.polynomials.composites.extend(located);
        }
        // What could be evaluated before.
        _ = self.evaluate_end(end);
        self.look_at_redundant_forces();
        found
    }

    /// The forces of all rows at the last value of the dynamics, to be reported; and which are undetermined (none: all
    /// are determined).
    pub(super) fn reported_forces(&mut self, forces: &mut Vec<T>, undetermined: &mut Vec<bool>) {
        if self.dynamics.has_dependent_rows() {
            *forces = self
                .switcher
                .redundant
                .report(&mut self.dynamics, undetermined);
        } else {
            undetermined.clear();
            forces.clear();
            let rows = 0..self.description().rows.len();
            forces.extend(rows.map(|row| self.dynamics.force(row)));
        }
        if self.is_undecided() {
            undetermined.clear();
            undetermined.resize(forces.len(), false);
            for &row in self.dynamics.acting_rows() {
                undetermined[row] = true;
            }
        }
    }

    /// Puts forces that keep their bounds in the place of those of the last value of the dynamics. What is open in forces cancels in the value of a
    /// composite guard, but not in its derivatives: coefficients and directions change as well. They are those of the margin that admissible
    /// forces leave (the envelope theorem).
    pub(super) fn take_admissible_forces(&mut self) {
        let redundant = &mut self.switcher.redundant;
        redundant.follow(&mut self.dynamics);
        let forces = redundant.forces(&self.dynamics);
        self.dynamics.replace_forces(&forces);
    }

    /// How far the composite guards that have fallen are from the zeros that they were located as, beside what drives now.
    pub(super) fn residue_of_composites(&mut self) -> f64 {
        let composites = &self.locator.polynomials.composites;
        let values = self.locator.fallen.iter().map(|guard| match *guard {
            Guard::Composite(k) => self.joint_value(&composites[k]).abs(),
            _ => 0.0,
        });
        let largest = values.fold(0.0, f64::max);
        if largest > 0.0 {
            largest * self.switcher.redundant.raised(&mut self.dynamics)
        } else {
            0.0
        }
    }

    /// The composite guard nearest to its border at the forces looked at last, if one is near, and its value.
    fn critical(&self) -> Option<(CompositeGuard, f64)> {
        let composite = self.switcher.redundant.critical(BORDER)?;
        let value = self.joint_value(&composite);
        Some((composite, value))
    }

    /// A composite guard at the last value of the dynamics.
    fn joint_value(&self, composite: &CompositeGuard) -> f64 {
        composite.value(&self.now.mode, &Reading::Values(&self.dynamics))
    }
}

fn is_like_one_of(known: &[CompositeGuard], composite: &CompositeGuard) -> bool {
    known.iter().any(|known| known.is_like(composite))
}
