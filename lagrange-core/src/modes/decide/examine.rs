//! Whether one candidate mode is feasible: its guards just after the instant.

use super::Decider;
use super::questions::{concerns, leading, list_questions, unit_of_order};
use crate::arithmetic::Scalar;
use crate::arithmetic::products::ROW;
use crate::dynamics::{Dynamics, EvaluationError, OutputMask};
use crate::integrate::Tolerance;
use crate::integrate::taylor;
use crate::mode::{FrictionMode, Mode};
use crate::modes::composite::{self, CompositeGuard};
use crate::modes::facts::{EvaluationPoint, SwitchContext, SwitchFacts};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::scale::AT_REST;
use crate::modes::table::Table;
use crate::system::ValueRef;

/// Order of the series that are looked at first. Leading coefficients beyond it vanish rarely.
const LOW_ORDER: usize = 4;

/// A composite guard above this (relative) is not about to fall.
const BORDER: f64 = 1e-3;

/// How far ahead guards at their border are looked at, in parts of the step.
const AHEAD: f64 = 1e-2;

/// What is no larger than so many times a residue is one.
const RESIDUES: f64 = 10.0;

/// So many composite guards at most begin at their border.
const MOST_JOINTS: usize = 20;

/// A row that acts and whose rate grows beyond this share of what it is made of, over a step, does not follow from the others.
const APART: f64 = 1e-6;

/// A force that takes away no more than this of the momentum in a second may be what rounding of the state leaves of zero,
const NOTHING: f64 = 1e-12;

/// as shows in how it changes with the state, when that changes by so much, relative.
const SHAKE: f64 = 1e-8;

/// What a guard does just after the instant, with the number of leading coefficients that vanish.
enum Leading {
    Rises(usize),
    Falls,
    /// Identically zero, as far as the series goes: the boundary is not left.
    Stays,
}

/// What happens after the moment, by a series of the order `order`, over times up to about `h`.
struct Ahead<'a, T: Scalar> {
    dynamics: &'a Dynamics<T>,
    here: SwitchContext<'a, T>,
    order: usize,
    h: f64,
    /// Error of a series over such a time.
    allowed: Tolerance<'a>,
}

impl<T: Scalar> Clone for Ahead<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Scalar> Copy for Ahead<'_, T> {}

impl<T: Scalar> Decider<T> {
    /// Whether `mode` is feasible; if so, `zeros` says which guards begin with how many vanishing coefficients, and if not,
    /// `violated` which guards forbid it.
    pub(super) fn examine(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        mode: &Mode,
    ) -> Result<bool, EvaluationError> {
        let SwitchContext { moment, facts, .. } = here;
        let EvaluationPoint { t, q, v, .. } = moment;
        self.posed.clone_from(mode);
        self.forks = false;
        if mode.has_incipient_slip() && !self.find_directions(dynamics, table, here)? {
            return Ok(false);
        }
        dynamics.set_mode(&self.posed);
        self.held.clear();
        if facts.balanced.contains(&true) {
            self.held.look(dynamics, &self.rows, moment);
        }
        let mode = &self.posed;
        let watched = table.of(dynamics);
        let serves = watched.deciding == watched.needs;
        if serves {
            dynamics.set_guard_needs(&watched.deciding);
        } else {
            dynamics.set_extra_needs(&watched.deciding);
        }
        list_questions(
            dynamics.description(),
            mode,
            facts,
            &watched.deciding,
            &mut self.questions,
        );
        // A branch that stays at its border is the one that is declared for equality.
        self.violated.clear();
        let held = self.held.held();
        let is_held = |guard| matches!(guard, Guard::Branch(b) if held.get(b) == Some(&true));
        for (guard, _) in self.questions.extract_if(.., |(guard, _)| is_held(*guard)) {
            if let Guard::Branch(b) = guard
                && !mode.branch(b)
            {
                self.violated.push(guard);
            }
        }
        if !self.violated.is_empty() {
            return Ok(false);
        }
        // Most candidates are refused, and many accepted, by their values already.
        dynamics.value(t, q, v)?;
        // Inertia and forcing are the same in all modes, but for branches.
        if !self.sized || facts.balanced.contains(&true) {
            dynamics.complete_outputs();
            self.sizes.take(dynamics);
            self.sized = true;
        } else {
            self.sizes.take_rows(dynamics);
        }
        self.share(dynamics);
        self.ask_values(dynamics, here);
        if !self.violated.is_empty() {
            return Ok(false);
        }
        if dynamics.has_rows_aside() && self.comes_apart(dynamics, &watched.deciding, here)? {
            return Ok(false);
        }
        if self.questions.is_empty() {
            return Ok(true);
        }
        self.shake(dynamics, moment)?;
        let settled = self.zeros.len();
        for order in [LOW_ORDER.min(moment.order), moment.order] {
            dynamics.series(t, q, v, order)?;
            self.decision.expanded = serves && order == moment.order;
            match self.judge(dynamics, here, order) {
                Some(feasible) => return Ok(feasible),
                None => {
                    self.zeros.truncate(settled);
                    self.at_limit.clear();
                }
            }
        }
        Ok(true)
    }

    /// Whether rows that depend on others at the instant do so at the instant only, and a friction that sticks is one of them: a slider in
    /// its dead centre, which is at rest however the crank turns. No force keeps it there; the frictions that would have to are blamed.
    fn comes_apart(
        &mut self,
        dynamics: &mut Dynamics<T>,
        needs: &OutputMask,
        here: SwitchContext<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let d = dynamics.description();
        let moment = here.moment;
        let frictions = self.posed.frictions.iter().enumerate();
        let sticking = frictions.filter(|(_, friction)| **friction == FrictionMode::Stick);
        let sticking: Vec<usize> = sticking.map(|(f, _)| f).collect();
        if sticking.is_empty() {
            return Ok(false);
        }
        dynamics.set_extra_needs(&guard::all_row_needs(d, needs));
        dynamics.series(moment.t, moment.q, moment.v, moment.order)?;
        self.decision.expanded = false;
        let allowed = Tolerance::both(moment.tolerance);
        let step = taylor::step_size(dynamics.state_series(), moment.order, allowed);
        let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
        let largest = |series: &[T]| {
            let powers = core::iter::successors(Some(1.0), |power| Some(power * h));
            let terms = series.iter().zip(powers);
            terms.fold(0.0_f64, |largest, (c, power)| {
                largest.max(c.value().abs() * power)
            })
        };
        let reading = Reading::Series(dynamics);
        let size = |place: ValueRef| largest(reading.motion(place).as_slice());
        // Of accelerations that forces keep at zero while they grow rounding is left.
        let pushed = dynamics.acting_rows().iter().map(|&index| {
            self.sizes.compliance(index, dynamics) * largest(dynamics.force_series(index))
        });
        let pushed = pushed.fold(0.0, f64::max);
        let apart = dynamics.acting_rows().iter().any(|&index| {
            let row = &d.rows[index];
            let speeds = row.jacobian.iter();
            // A velocity that is zero is so only to rounding of the unit.
            let speeds = speeds
                .map(|&(j, place)| size(place) * (largest(dynamics.velocity_series(j)) + AT_REST));
            let whole =
                speeds.sum::<f64>() + (self.sizes.acceleration(index, dynamics) + pushed) * h;
            size(row.velocity) > APART * whole
        });
        if apart {
            let guard = |&f: &usize| match d.frictions[f].components {
                1 => Guard::StickUpper(f),
                _ => Guard::StickCone(f),
            };
            self.violated.extend(sticking.iter().map(guard));
        }
        Ok(apart)
    }

    /// Puts composite guards in the place of those of undetermined forces.
    fn share(&mut self, dynamics: &mut Dynamics<T>) {
        self.redundant.look(dynamics);
        self.composites.clear();
        let Self {
            redundant,
            composites,
            questions,
            ..
        } = self;
        if !redundant.has_open() {
            return;
        }
        questions.retain(|&(guard, _)| !redundant.is_open(guard));
        if let Some(composite) = redundant.critical(BORDER) {
            composites.push(composite);
            questions.push((Guard::Composite(0), 0));
        }
    }

    /// Answers the questions that values answer: what remains is asked of the series.
    fn ask_values(&mut self, dynamics: &Dynamics<T>, here: SwitchContext<'_, T>) {
        let facts = here.facts;
        let exactly = here.moment.tolerance == 0.0;
        // A force that was located as zero has nothing that it could be compared with.
        let all_vanish = RESIDUES * facts.residue >= 1.0;
        let speeds = here.moment.v.iter().map(|v| v.value().abs() + AT_REST);
        let nothing = NOTHING * self.sizes.momentum(speeds);
        let Self {
            sizes,
            questions,
            zeros,
            at_limit,
            doubtful,
            violated,
            composites,
            posed: mode,
            ..
        } = self;
        zeros.clear();
        at_limit.clear();
        doubtful.clear();
        violated.clear();
        questions.retain(|&(guard, order_known)| {
            if matches!((guard, order_known), (Guard::Gap(_), 1)) {
                // It parts: that is known.
                zeros.push((guard, 1));
                return false;
            }
            let Some(value) = leading(guard, order_known, composites, mode, dynamics) else {
                return true;
            };
            let noise = if concerns(guard, composites, facts) {
                1e3 * here.blur()
            } else if guard.is_single_force() && value.abs() <= nothing {
                doubtful.push((guard, value, 0.0));
                return true;
            } else {
                1e-6
            };
            let size = sizes.of(guard, dynamics);
            let incomparable = match guard {
                Guard::NormalForceSign(_) => {
                    size <= value.abs() || value.abs() <= RESIDUES * facts.residue * size
                }
                _ => (exactly || all_vanish) && size <= RESIDUES * value.abs(),
            };
            if incomparable && concerns(guard, composites, facts) {
                // All forces may vanish at this instant.
                return true;
            }
            let clear = noise.max(1e-6) * size;
            if value < -clear {
                blame(guard, composites, violated);
            }
            let settled = clear > 0.0 && value > clear;
            if settled && order_known > 0 {
                zeros.push((guard, order_known));
            }
            !settled
        });
    }

    /// Where nothing makes forces but what is known to rounding only, as at the lowest point of a pendulum: how large forces in doubt would be if the
    /// state changed by its own size.
    ///
    /// # Errors
    /// The state itself, which is what `dynamics` holds afterwards, cannot be evaluated.
    fn shake(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<(), EvaluationError> {
        if self.doubtful.is_empty() {
            return Ok(());
        }
        // Of coordinates moved by cosines and sines no combination vanishes by symmetry.
        for phase in [0.0, core::f64::consts::FRAC_PI_2] {
            let moved = |(j, x): (usize, &T)| {
                let part = SHAKE * (j as f64 - phase).cos();
                *x + T::from_f64(part * x.value().abs().max(1.0))
            };
            let [q, v] = [moment.q, moment.v].map(|x| x.iter().enumerate().map(moved));
            let [q, v]: [Vec<T>; 2] = [q.collect(), v.collect()];
            if dynamics.value(moment.t, &q, &v).is_err() {
                continue;
            }
            let reading = Reading::Values(dynamics);
            for (guard, value, size) in &mut self.doubtful {
                let change = guard::value(*guard, &self.posed, &reading) - *value;
                *size = size.max((change / SHAKE).abs());
            }
        }
        dynamics.value(moment.t, moment.q, moment.v)
    }

    /// Size of the terms that make a guard.
    fn size(&self, guard: Guard, dynamics: &Dynamics<T>) -> f64 {
        let mut doubtful = self.doubtful.iter();
        let shaken = doubtful.find_map(|(other, _, size)| (*other == guard).then_some(*size));
        self.sizes.of(guard, dynamics).max(shaken.unwrap_or(0.0))
    }

    /// Looks at the guards in question just after the moment. `None`: one of them vanishes to this order, and more is to
    /// be had.
    fn judge(
        &mut self,
        dynamics: &Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Option<bool> {
        let SwitchContext { moment, facts, .. } = here;
        let last = order == moment.order;
        // A low order's last coefficient is small enough at the same step for a loose tolerance only.
        let allowed = if last {
            moment.tolerance.max(f64::EPSILON)
        } else {
            1e-3
        };
        let allowed = Tolerance::both(allowed);
        let step = taylor::step_size(dynamics.state_series(), order, allowed);
        let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
        let ahead = Ahead {
            dynamics,
            here,
            order,
            h,
            allowed,
        };
        let mut unclear = false;
        let questions = core::mem::take(&mut self.questions);
        for &(guard, order_known) in &questions {
            let mut series = [0.0; guard::LENGTH];
            let series = &mut series[..=order];
            match self.just_after(guard, order_known, ahead, series) {
                Leading::Falls => blame(guard, &self.composites, &mut self.violated),
                Leading::Rises(0) => {}
                Leading::Rises(k) => self.zeros.push((guard, k)),
                Leading::Stays if !last => unclear = true,
                Leading::Stays
                    if self.sticks_first && matches!(guard, Guard::Slip(_))
                        || !self.lies_loosely && is_held::<T>(guard, facts, dynamics) =>
                {
                    self.violated.push(guard);
                }
                // Whatever sign rounding has given it.
                Leading::Stays => {
                    self.zeros.push((guard, guard::LENGTH));
                    if guard.is_single_force() {
                        self.at_limit.push((guard, self.size(guard, dynamics)));
                    }
                }
            }
        }
        if self.violated.is_empty() && !unclear && !self.composites.is_empty() {
            self.look_ahead(ahead);
        }
        self.questions = questions;
        if self.violated.is_empty() && unclear {
            return None;
        }
        Some(self.violated.is_empty())
    }

    /// At the border several composite guards may vanish together: a little later those that fall show.
    fn look_ahead(&mut self, ahead: Ahead<'_, T>) {
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=ahead.order];
        let (reading, later) = (Reading::Series(ahead.dynamics), AHEAD * ahead.h);
        for _ in 0..MOST_JOINTS {
            let found = self.redundant.critical_at(|guard, plane| {
                composite::side(guard, plane, &self.posed, &reading, series);
                crate::integrate::horner(series, later)
            });
            let Some(composite) = found else {
                return;
            };
            let index = self.composites.len();
            self.composites.push(composite);
            match self.just_after(Guard::Composite(index), 0, ahead, series) {
                Leading::Falls => {
                    return blame(
                        Guard::Composite(index),
                        &self.composites,
                        &mut self.violated,
                    );
                }
                Leading::Rises(0) => {}
                Leading::Rises(k) => self.zeros.push((Guard::Composite(index), k)),
                Leading::Stays => return self.zeros.push((Guard::Composite(index), guard::LENGTH)),
            }
        }
    }

    /// What a guard does just after the moment; its series, scaled onto the reach, is left in `series`.
    fn just_after(
        &self,
        guard: Guard,
        order_known: usize,
        ahead: Ahead<'_, T>,
        series: &mut [f64],
    ) -> Leading {
        let Ahead {
            dynamics,
            here,
            order,
            h,
            allowed,
        } = ahead;
        let tolerance = here.moment.tolerance;
        let reading = Reading::Series(dynamics);
        composite::series(
            guard,
            &self.composites,
            &self.posed,
            &reading,
            &composite::ONES,
            series,
        );
        series[..order_known].fill(0.0);
        // In free flight the motion has a series that ends, and reaches everywhere; that of the wall that it has left does not.
        let mut row = [0.0; ROW];
        row[..series.len()].copy_from_slice(series);
        let own = taylor::step_size([&[row], &[]], order, allowed);
        let h = own.map_or(h, |own| own.min(h));
        let mut power = 1.0;
        for c in &mut *series {
            *c *= power;
            power *= h;
        }
        let size = series.iter().fold(0.0_f64, |size, c| size.max(c.abs()));
        // The residue of a located root, and what follows from it, has the size of the integration error.
        let (relative, absolute) = if concerns(guard, &self.composites, here.facts) {
            ((100.0 * tolerance).clamp(1e-11, 1e-3), here.blur())
        } else {
            (1e-13, 1e-14)
        };
        let cancelling = match guard {
            Guard::Branch(b) if here.facts.held[b] => self.size_as_of_rows(size, ahead, h),
            _ => self.size(guard, dynamics) * unit_of_order(guard, h),
        };
        let noise = (relative * size).max(absolute * cancelling);
        match series.iter().position(|c| c.abs() > noise) {
            None => Leading::Stays,
            Some(k) if series[k] < 0.0 => Leading::Falls,
            Some(k) => Leading::Rises(k),
        }
    }

    /// Size of what makes the guard of a branch that contacts or frictions have held at its border until now, and which changes by `size` over a
    /// time `h`: that of the gaps or slips of those, by which it changes.
    fn size_as_of_rows(&self, size: f64, ahead: Ahead<'_, T>, h: f64) -> f64 {
        let Ahead {
            dynamics,
            here,
            order,
            ..
        } = ahead;
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=order];
        let slips = |f: usize| matches!(self.posed.frictions[f], FrictionMode::Slip(_));
        let left = here.facts.located.iter().filter_map(|guard| match *guard {
            Guard::Normal(c) if !self.posed.contacts[c] => Some((Guard::Gap(c), 2)),
            Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) if slips(f) => {
                Some((Guard::Slip(f), 1))
            }
            _ => None,
        });
        let sizes = left.map(|(row, known)| {
            let reading = Reading::Series(dynamics);
            guard::series(row, &self.posed, &reading, &composite::ONES, series);
            let powers = core::iter::successors(Some(1.0), |power| Some(power * h));
            let terms = series.iter().zip(powers).skip(known);
            let grows = terms.fold(0.0_f64, |largest, (c, power)| {
                largest.max((c * power).abs())
            });
            if grows > 0.0 {
                self.sizes.of(row, dynamics) * unit_of_order(row, h) * size / grows
            } else {
                0.0
            }
        });
        sizes.fold(0.0, f64::max)
    }
}

/// Whether a contact cannot open because others are closed, or a friction cannot slip because others stick: then the mode
/// in which it is closed, or sticks, has the same motion, and more forces to choose from. Not so a contact that a force has left which
/// was determined, because the sliding friction of the others depends on it.
fn is_held<T: Scalar>(guard: Guard, facts: &SwitchFacts, dynamics: &Dynamics<T>) -> bool {
    let d = dynamics.description();
    let mut rows = match guard {
        Guard::Gap(c) if facts.located.contains(&Guard::Normal(c)) => return false,
        Guard::Gap(c) => d.contacts[c].row..d.contacts[c].row + 1,
        Guard::Slip(f) => d.frictions[f].rows(),
        _ => return false,
    };
    rows.all(|row| dynamics.follows(row))
}

/// Books what forbids a mode: of a composite guard, its parts.
fn blame(guard: Guard, composites: &[CompositeGuard], violated: &mut Vec<Guard>) {
    match guard {
        Guard::Composite(index) => violated.extend(composites[index].parts.iter().map(|p| p.guard)),
        single => violated.push(single),
    }
}
