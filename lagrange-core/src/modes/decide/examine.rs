//! Whether one candidate mode is feasible: its guards at the instant and, of those that vanish, just after it.

use super::Decider;
use super::just_after::{AHEAD, terms, unclear_part};
use super::questions::{Doubt, blame, concerns, leading, list_questions};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, OutputMask};
use crate::integrate::horner;
use crate::mode::{FrictionMode, Mode};
use crate::modes::composite::CompositeGuard;
use crate::modes::facts::{EvaluationPoint, SwitchContext, SwitchFacts};
use crate::modes::guard::{self, Guard};
use crate::modes::held::conditions;
use crate::modes::reading::Reading;
use crate::modes::scale::Sizes;
use crate::modes::table::Table;
use crate::system::{Description, ValueRef};

/// Order of the series that are looked at first. Leading coefficients beyond it vanish rarely.
const LOW_ORDER: usize = 4;

/// A composite guard above this (relative) is not about to fall.
const BORDER: f64 = 1e-3;

/// One that is not below zero by more than this (relative) has not fallen.
const KEPT: f64 = 1e-9;

/// What is no larger than so many times a residue is one.
const RESIDUES: f64 = 10.0;

/// A force is all that there is of what makes it where that is no more than so many times as large: rounding tells them apart.
const ALONE: f64 = 1.0 + 1e-9;

/// A row that acts and whose rate grows beyond this share of what it is made of, over a step, does not follow from the others.
const APART: f64 = 1e-6;

/// and of what forces could make of it beyond this one: rounding of forces that cancel is left.
const CANCELLED: f64 = 1e-12;

/// A force that takes away no more than this of the momentum in a second, or an acceleration of the speeds, may be what rounding of the state leaves of zero,
const NOTHING: f64 = 1e-12;

/// also if it was located, where what drives is no more than so many times that;
const IDLE: f64 = 1e6;

/// as shows in how it changes with the state, when that changes by so much, relative.
const SHAKE: f64 = 1e-8;

/// A friction that would move its row by so many times what drives may hold by rounding alone:
const HUGE: f64 = 1e6;

/// positions are known to so many units of it.
const ROUNDING_UNITS: f64 = 8.0;

/// A condition jumps if it changes by more than this, relative, with the sides of others.
const JUMP: f64 = 1e-6;

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
        self.posed.clone_from(mode);
        self.forks = false;
        self.take_sides_that_follow(dynamics, here);
        if !mode.has_incipient_slip() {
            return self.examine_posed(dynamics, table, here);
        }
        if !self.find_directions(dynamics, table, here)? {
            return Ok(false);
        }
        if self.examine_posed(dynamics, table, here)? {
            return Ok(true);
        }
        // What forbids the direction that is nearest to that of the force that held may not forbid another one.
        let violated = core::mem::take(&mut self.violated);
        while self.turn_to_another() {
            if self.examine_posed(dynamics, table, here)? {
                return Ok(true);
            }
        }
        if self.turn_back(dynamics, &violated) && self.examine_posed(dynamics, table, here)? {
            return Ok(true);
        }
        self.violated = violated;
        Ok(false)
    }

    /// Puts branches on their sides whose conditions jump with the sides that the candidate has of others: |u| where u = if(c, 1, −1) changes with c.
    fn take_sides_that_follow(&mut self, dynamics: &mut Dynamics<T>, here: SwitchContext<'_, T>) {
        let d = dynamics.description();
        let is_asked = |b: usize| here.facts.balanced[b] || d.branches[b].after_solve;
        if self.posed.branches == here.present.branches || (0..d.branches.len()).all(is_asked) {
            return;
        }
        let before = self.conditions(dynamics, here, here.present);
        for _ in 0..d.branches.len() {
            let after = self.conditions(dynamics, here, &self.posed);
            let mut settled = true;
            for b in (0..d.branches.len()).filter(|&b| !is_asked(b)) {
                let jumps =
                    (after[b] - before[b]).abs() > JUMP * (after[b].abs() + before[b].abs());
                let side = after[b] >= 0.0;
                if jumps && side != self.posed.branch(b) {
                    self.posed.set_branch(b, side);
                    settled = false;
                }
            }
            if settled {
                return;
            }
        }
    }

    /// The conditions of all branches at the moment, on the sides that a mode has.
    fn conditions(
        &self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        mode: &Mode,
    ) -> Vec<f64> {
        let EvaluationPoint { t, q, v, .. } = here.moment;
        dynamics.set_mode(mode);
        dynamics.set_extra_needs(&self.rows);
        dynamics.tape(t, q, v);
        conditions(dynamics).collect()
    }

    /// The same for the mode that is posed, with the directions in which slips begin.
    fn examine_posed(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let SwitchContext { moment, facts, .. } = here;
        let EvaluationPoint { t, q, v, .. } = moment;
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
        let later = |guard| matches!(guard, Guard::Gap(c) if self.undecided[c]);
        self.questions.retain(|(guard, _)| !later(*guard));
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
        let measured = !self.questions.is_empty() || dynamics.has_rows_aside();
        if measured {
            self.measure(dynamics, facts);
        }
        self.share(dynamics);
        self.ask_values(dynamics, here);
        if !self.violated.is_empty() || measured && self.sticks_by_rounding(dynamics, moment)? {
            return Ok(false);
        }
        if dynamics.has_rows_aside() && self.comes_apart(dynamics, &watched.deciding, here)? {
            return Ok(false);
        }
        if self.questions.is_empty() {
            return Ok(true);
        }
        if !self.doubtful.is_empty() {
            let size = |x: &T| x.value().abs().max(1.0);
            let sizes = [moment.q, moment.v].map(|x| x.iter().map(size).collect());
            self.shake(dynamics, moment, &sizes, 0)?;
        }
        let settled = self.zeros.len();
        for order in [LOW_ORDER.min(moment.order), moment.order] {
            dynamics.series(t, q, v, order)?;
            self.decision.expanded = serves && order == moment.order;
            self.press_as_forces_begin(dynamics, here, order)?;
            let mut goes_on = self.judge(dynamics, here, order);
            if goes_on == Some(false) && self.doubts_branches(dynamics, here, order)? {
                self.zeros.truncate(settled);
                self.at_limit.clear();
                goes_on = self.judge(dynamics, here, order);
            }
            match goes_on {
                Some(true) => return self.keeps_bounds_later(dynamics, here, order),
                Some(false) => return Ok(false),
                None => {
                    self.zeros.truncate(settled);
                    self.at_limit.clear();
                }
            }
        }
        self.keeps_bounds_later(dynamics, here, moment.order)
    }

    /// Has bounds of undetermined forces read those of constraints that vanish at the instant as they begin, by the series that `dynamics` holds, also afterwards.
    fn press_as_forces_begin(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Result<(), EvaluationError> {
        if self.composites.is_empty() {
            return Ok(());
        }
        let reach = self.reach(dynamics, order, here.moment.allowed());
        let unclear = unclear_part(here.moment.tolerance);
        let nothing = |sizes: &Sizes, dynamics: &Dynamics<T>, f: usize| {
            1e3 * here.blur() * sizes.of(Guard::NormalForceSign(f), dynamics)
        };
        let zero = |f: usize| nothing(&self.sizes, dynamics, f);
        if self.redundant.has_unknown_signs(dynamics, zero) {
            self.take_signs_that_begin(dynamics, here, order)?;
        }
        let Self {
            redundant,
            composites,
            sizes,
            ..
        } = self;
        let zero = |f: usize| nothing(sizes, dynamics, f);
        redundant.press_as_forces_begin(composites, dynamics, reach, unclear, zero);
        Ok(())
    }

    /// Where the force of a constraint that presses a friction vanishes at the instant, and is not determined, it presses with the sign that it has a little
    /// later: how forces can share what comes follows from that. `dynamics` holds the series of the moment, and its values, also afterwards.
    fn take_signs_that_begin(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Result<(), EvaluationError> {
        let EvaluationPoint { t, q, v, .. } = here.moment;
        let expanded = self.decision.expanded;
        let known = self.look_later(dynamics, here, order);
        let turns = known && self.redundant.take_signs_of_later(dynamics);
        dynamics.value(t, q, v)?;
        self.redundant.follow(dynamics);
        if turns {
            self.composites.clear();
            let composite = |&(guard, _): &(Guard, usize)| guard == Guard::Composite(0);
            self.questions.retain(|question| !composite(question));
            if let Some(composite) = self.redundant.critical(BORDER) {
                self.composites.push(composite);
                self.questions.push((Guard::Composite(0), 0));
            }
        }
        dynamics.series(t, q, v, order)?;
        self.decision.expanded = expanded;
        Ok(())
    }

    /// Evaluates the equations a little after the moment, whose series `dynamics` holds up to `order`; whether they can be.
    fn look_later(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> bool {
        let EvaluationPoint { t, q, .. } = here.moment;
        let later = T::from_f64(AHEAD * self.reach(dynamics, order, here.moment.allowed()));
        let series = |row: &[T]| horner(&row[..=order], later);
        let coordinates = 0..q.len();
        let place = coordinates
            .clone()
            .map(|j| series(dynamics.position_series(j)));
        let place: Vec<T> = place.collect();
        let speed: Vec<T> = coordinates
            .map(|j| series(dynamics.velocity_series(j)))
            .collect();
        self.decision.expanded = false;
        dynamics.value(t + later, &place, &speed).is_ok()
    }

    /// Whether undetermined forces keep all bounds a little later as well, where their rows change: how they can share a load is then another
    /// matter than at the instant. `dynamics` holds the series of the moment, and its values afterwards.
    fn keeps_bounds_later(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Result<bool, EvaluationError> {
        let rows = dynamics.description().rows;
        let mut acting = dynamics.acting_rows().iter();
        let turn = acting.any(|&row| !rows[row].is_constant());
        if self.composites.is_empty() || !turn {
            return Ok(true);
        }
        let EvaluationPoint { t, q, v, .. } = here.moment;
        if self.look_later(dynamics, here, order) {
            self.redundant.look(dynamics);
            let fallen = |composite: &CompositeGuard| {
                composite.value(&self.posed, &Reading::Values(dynamics)) < -KEPT
            };
            // What the load alone takes away by then is an event to come.
            let by_load = self.composites.iter().any(fallen);
            if let Some(composite) = self.redundant.critical(BORDER).filter(|_| !by_load)
                && fallen(&composite)
            {
                let composites = core::slice::from_ref(&composite);
                blame(Guard::Composite(0), composites, &mut self.violated);
            }
        }
        dynamics.value(t, q, v)?;
        Ok(self.violated.is_empty())
    }

    /// Whether rows that depend on others at the instant do so at the instant only: a slider in its dead centre, which is at rest however the
    /// crank turns, and two lifts that hand a load over. No force keeps them together; the frictions that would have to are blamed, or else the contacts.
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
        let closed = (0..d.contacts.len()).filter(|&c| self.posed.contacts[c]);
        let closed: Vec<usize> = closed.collect();
        if sticking.is_empty() && closed.len() < 2 {
            return Ok(false);
        }
        dynamics.set_extra_needs(&guard::all_row_needs(d, needs));
        dynamics.series(moment.t, moment.q, moment.v, moment.order)?;
        self.decision.expanded = false;
        let h = self.reach(dynamics, moment.order, moment.allowed());
        let largest = |series: &[T]| terms(series.iter().map(|c| c.value()), h).fold(0.0, f64::max);
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
            let speeds = speeds.map(|&(j, place)| {
                // A velocity that is zero is so only to rounding of the unit.
                let rest = f64::EPSILON * dynamics.at_rest(j);
                size(place) * (APART * largest(dynamics.velocity_series(j)) + rest)
            });
            let pushed = (self.sizes.acceleration(index, dynamics) + pushed) * h;
            // What is left of a rate at the instant does not grow.
            let rate = reading.motion(row.velocity);
            let grown = terms(rate.as_slice().iter().map(|c| c.value()), h).skip(1);
            grown.fold(0.0, f64::max) > speeds.sum::<f64>() + CANCELLED * pushed
        });
        if apart {
            let stuck = sticking.iter().map(|&f| blamed(f, d));
            self.violated.extend(stuck);
            if sticking.is_empty() {
                self.violated
                    .extend(closed.iter().map(|&c| Guard::Normal(c)));
            }
        }
        Ok(apart)
    }

    /// Whether a friction sticks by rounding alone, as on the slider of a crank that has come to its dead centre to within 1e-20: forces that are so much
    /// larger than what drives are others where positions are off by rounding. Such frictions are blamed.
    ///
    /// # Errors
    /// The state itself, which is what `dynamics` holds afterwards, cannot be evaluated.
    fn sticks_by_rounding(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let d = dynamics.description();
        let frictions = self.posed.frictions.iter().enumerate();
        let sticking = frictions.filter(|(_, friction)| **friction == FrictionMode::Stick);
        let mut rows = sticking.flat_map(|(f, _)| d.frictions[f].rows().map(move |row| (f, row)));
        let is_huge = |&(_, row): &(usize, usize)| {
            let pushed = self.sizes.compliance(row, dynamics) * dynamics.force(row).value().abs();
            pushed > HUGE * self.sizes.acceleration(row, dynamics)
        };
        let Some((f, row)) = rows.find(is_huge) else {
            return Ok(false);
        };
        let EvaluationPoint { t, q, v, .. } = moment;
        let force = dynamics.force(row).value();
        let extent = q.iter().fold(1.0, |size, x| x.value().abs().max(size));
        let mut changes = false;
        for units in [-ROUNDING_UNITS, ROUNDING_UNITS] {
            let by = units * f64::EPSILON * extent;
            // No two positions are off by the same, so that differences of them are off as well.
            let beside = q.iter().enumerate();
            let beside = beside.map(|(j, &x)| x + T::from_f64(by * (1.0 + j as f64).sqrt()));
            let beside: Vec<T> = beside.collect();
            let known = dynamics.value(t, &beside, v).is_ok();
            changes |= !known || (dynamics.force(row).value() - force).abs() > 0.5 * force.abs();
        }
        dynamics.value(t, q, v)?;
        if changes {
            self.violated.push(blamed(f, d));
        }
        Ok(changes)
    }

    /// Takes the sizes of what guards are made of. Inertia and forcing are the same in all modes, but for branches.
    pub(super) fn measure(&mut self, dynamics: &mut Dynamics<T>, facts: &SwitchFacts) {
        if !self.sized || facts.balanced.contains(&true) {
            dynamics.complete_outputs();
            self.take_sizes(dynamics);
        } else {
            self.sizes.take_rows(dynamics);
        }
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
        let speed = |j: usize| here.moment.v[j].value().abs() + dynamics.at_rest(j);
        let speeds = (0..here.moment.v.len()).map(speed);
        let momentum = self.sizes.momentum(speeds);
        let no_force = NOTHING * momentum;
        let d = dynamics.description();
        let nothing = |guard: Guard| match guard {
            Guard::Gap(c) => Some(NOTHING * dynamics.size_of_row(d.contacts[c].row, speed)),
            Guard::Slip(f) => {
                let rows = d.frictions[f].rows();
                let sizes = rows.map(|row| dynamics.size_of_row(row, speed));
                Some(NOTHING * sizes.fold(0.0, f64::max))
            }
            Guard::StickCone(f) => Some(Sizes::change_of_cone(f, no_force, momentum, dynamics)),
            guard => guard.is_single_force().then_some(no_force),
        };
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
            let size = sizes.of(guard, dynamics);
            let concerned = concerns(guard, composites, facts);
            let in_doubt = nothing(guard).is_some_and(|nothing| {
                let idle = !concerned || size <= IDLE * nothing;
                idle && value.abs() <= nothing
            });
            if in_doubt {
                doubtful.push(Doubt {
                    guard,
                    order_known,
                    value,
                    size: 0.0,
                });
                return true;
            }
            let noise = if concerned { 1e3 * here.blur() } else { 1e-6 };
            let incomparable = match guard {
                Guard::NormalForceSign(_) => {
                    size <= ALONE * value.abs() || value.abs() <= RESIDUES * facts.residue * size
                }
                _ => (exactly || all_vanish) && size <= RESIDUES * value.abs(),
            };
            if incomparable && concerned {
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

    /// Finds how large the guards in doubt, but for the first ones, would be if positions and velocities changed by these sizes: where nothing makes forces
    /// but what is known to rounding only, as at the lowest point of a pendulum, and of conditions.
    ///
    /// # Errors
    /// The state itself, which is what `dynamics` holds afterwards, cannot be evaluated.
    pub(super) fn shake(
        &mut self,
        dynamics: &mut Dynamics<T>,
        moment: EvaluationPoint<'_, T>,
        sizes: &[Vec<f64>; 2],
        first: usize,
    ) -> Result<(), EvaluationError> {
        let [positions, velocities] = sizes;
        // Of coordinates moved by cosines and sines no combination vanishes by symmetry.
        for phase in [0.0, core::f64::consts::FRAC_PI_2] {
            let moved = |(j, (x, size)): (usize, (&T, &f64))| {
                let part = SHAKE * (j as f64 - phase).cos();
                *x + T::from_f64(part * size)
            };
            let moved = [(moment.q, positions), (moment.v, velocities)]
                .map(|(x, sizes)| x.iter().zip(sizes).enumerate().map(moved));
            let [q, v]: [Vec<T>; 2] = moved.map(Iterator::collect);
            if dynamics.value(moment.t, &q, &v).is_err() {
                continue;
            }
            for doubt in &mut self.doubtful[first..] {
                let moved = leading(doubt.guard, doubt.order_known, &[], &self.posed, dynamics);
                let change = moved.map_or(0.0, |moved| moved - doubt.value);
                doubt.size = doubt.size.max((change / SHAKE).abs());
            }
        }
        dynamics.value(moment.t, moment.q, moment.v)
    }

    /// Size of the terms that make a guard.
    pub(super) fn size(&self, guard: Guard, dynamics: &Dynamics<T>) -> f64 {
        let mut doubtful = self.doubtful.iter();
        let shaken = doubtful.find_map(|doubt| (doubt.guard == guard).then_some(doubt.size));
        self.sizes.of(guard, dynamics).max(shaken.unwrap_or(0.0))
    }
}

/// The guard that is blamed where friction `f` cannot stick, on whichever side.
fn blamed(f: usize, d: &Description) -> Guard {
    match d.frictions[f].components {
        1 => Guard::StickUpper(f),
        _ => Guard::StickCone(f),
    }
}
