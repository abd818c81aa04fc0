//! A switch: forces just before, impact if something is hit, the next mode, the log.

use super::accumulation::{Impacts, Train};
use super::hidden::Hidden;
use super::{Progress, Run};
use crate::arithmetic::{Scalar, epsilon, rounding};
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::decide::Decider;
use crate::modes::domain;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard};
use crate::modes::held::HeldBranches;
use crate::modes::impact::{Collider, Impact};
use crate::modes::redundant::RedundantForces;
use crate::modes::scale::AT_REST;
use crate::modes::status::ConstraintStatus;
use crate::modes::table::Table;
use crate::pool::Pool;
use crate::system::{Description, Normal};
use crate::trajectory::State;

/// A gap that changes by no more than so many tolerances per second where its region begins neither closes nor opens there.
const ENTERS: f64 = 10.0;

/// A body that is closed at some points may be off by so many times more at others.
const LEVER: f64 = 4.0;

/// Sums of the terms of a step are off by no more than so many units of rounding.
const UNITS: f64 = 8.0;

/// What is no larger than this beside the terms that make it is what rounding has left of zero.
const ROUNDING: f64 = 1e-13;

/// What decides how the motion goes on.
#[derive(Debug)]
pub(super) struct Switcher<T> {
    pub(super) status: ConstraintStatus,
    pub(super) collider: Collider<T>,
    /// Branches that what touches holds at their border.
    pub(super) held: HeldBranches<T>,
    /// Guards that the mode up to the switch watches,
    pub(super) watched: Vec<Guard>,
    /// and the conditions of branches before an impact.
    pub(super) conditions: Vec<f64>,
    /// Contacts whose gap vanishes at an impact.
    pub(super) near: Vec<usize>,
    /// Per contact: its impacts so far.
    pub(super) impacts: Vec<Impacts<T>>,
    /// All impacts so far.
    pub(super) train: Train,
    /// The state before contacts are closed whose impacts have died out, or what comes to rest is held.
    pub(super) before_holding: State<T>,
    /// Frictions whose slips may end with others.
    ending: Vec<usize>,
    /// The mode of a flight through impacts that accumulate.
    pub(super) scratch_mode: Mode,
    pub(super) decider: Decider<T>,
    pub(super) table: Table,
    /// Of undetermined forces at the present state.
    pub(super) redundant: RedundantForces<T>,
    /// Modes of the switches since time last advanced.
    pub(super) stuck: Pool<Mode>,
}

impl<T: Scalar> Switcher<T> {
    pub(super) fn new(d: &'static Description, state: &State<T>, mode: &Mode) -> Self {
        let contacts = d.contacts.len();
        Switcher {
            status: ConstraintStatus::new(d),
            collider: Collider::default(),
            held: HeldBranches::default(),
            watched: Vec::new(),
            conditions: Vec::new(),
            near: Vec::with_capacity(contacts),
            impacts: vec![Impacts::default(); contacts],
            train: Train::default(),
            before_holding: state.clone(),
            ending: Vec::with_capacity(d.frictions.len()),
            scratch_mode: mode.clone(),
            decider: Decider::new(d),
            table: Table::default(),
            redundant: RedundantForces::default(),
            stuck: Pool::default(),
        }
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        self.impacts.iter_mut().for_each(Impacts::restart);
        self.train.restart();
        self.redundant.restart();
        self.stuck.clear();
        self.decider.restart();
    }
}

impl<T: Scalar> Run<T> {
    /// Leaves the present mode because the guards in `self.locator.fallen` fell through zero.
    pub(super) fn switch(&mut self) -> Result<(), Error> {
        let d = self.description();
        if !self.locator.rests.is_empty() {
            self.come_to_rest()?;
        }
        let roots = self.hidden.as_ref().is_some_and(Hidden::has_roots);
        let mut fallen = self.locator.fallen.iter();
        if roots && fallen.any(|guard| matches!(guard, Guard::Slip(_))) {
            self.drop_rounding_of_velocities();
        }
        if !self.now.valued {
            self.evaluate()?;
        }
        // What decides reads other numbers, and leaves them.
        let of_composites = self.residue_of_composites();
        let facts = &mut self.switcher.status.facts;
        facts.clear(d);
        facts.residue = self
            .switcher
            .decider
            .residue(&mut self.dynamics, &self.now.mode, &self.locator.fallen)
            .max(of_composites);
        facts.touching.copy_from_slice(&self.now.mode.contacts);
        for (resting, friction) in facts.resting.iter_mut().zip(&self.now.mode.frictions) {
            *resting = friction.rests();
        }
        for &guard in &self.locator.fallen {
            match guard {
                Guard::Gap(c) => (facts.touching[c], facts.arriving[c]) = (true, true),
                Guard::Slip(f) => facts.resting[f] = true,
                Guard::Branch(b) => facts.balanced[b] = true,
                Guard::Region(c) => facts.touching[c] = false,
                _ => {}
            }
        }
        // Slips that were zero at this very instant still are.
        for &(guard, _) in &self.locator.zeros {
            if let Guard::Slip(f) = guard {
                facts.resting[f] = true;
            }
        }
        self.hand_over();
        let facts = &mut self.switcher.status.facts;
        // A force of several constraints that has turned ends no mode: its friction slips on, pressed in another direction.
        let turned = |guard: &Guard| match *guard {
            Guard::NormalForceSign(f) => matches!(d.frictions[f].normal, Normal::Resultant(_)),
            _ => false,
        };
        let ending = self.locator.fallen.iter().filter(|guard| !turned(guard));
        facts.located.extend(ending);
        facts.again = self.switcher.stuck.len() > 1;
        for guard in &self.locator.fallen {
            if let Guard::Composite(k) = *guard {
                let parts = self.locator.polynomials.composites[k]
                    .parts
                    .iter()
                    .map(|part| part.guard);
                self.switcher.status.facts.located.extend(parts);
            }
        }
        self.settle()
    }

    /// Where a slip has come to zero, what rounding leaves of the velocities in the step is zero too: along a curved path a drag by |v| would
    /// begin anew from it, at another angle.
    fn drop_rounding_of_velocities(&mut self) {
        let step = &self.stepper.step;
        for (j, v) in self.now.state.v.iter_mut().enumerate() {
            let row = step.velocity_row(j);
            let size = row[0].value().abs() + row[1].value().abs();
            let rest = v.value();
            if rest != 0.0 && rest.abs() <= UNITS * epsilon::<T>() * size {
                *v -= T::from_f64(rest);
                self.now.valued = false;
            }
        }
    }

    /// Impact if needed, then the next mode; logs what changed. `self.switcher.status.facts` says what vanishes at this instant.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        self.knowing(Self::settle_knowing)
    }

    /// Does something with the facts of this instant, which are then put back, whatever came of it.
    pub(super) fn knowing<R>(&mut self, act: impl FnOnce(&mut Self, &mut SwitchFacts) -> R) -> R {
        let mut facts = core::mem::take(&mut self.switcher.status.facts);
        let outcome = act(self, &mut facts);
        self.switcher.status.facts = facts;
        outcome
    }

    fn settle_knowing(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        let hit = self.meet(facts)?;
        let here = self
            .now
            .context(self.stepper.order, self.settings.tolerance, facts);
        self.switcher
            .decider
            .decide(&mut self.dynamics, &mut self.switcher.table, here)?;
        self.locator
            .zeros
            .clone_from(&self.switcher.decider.decision.zeros);
        let edges = self
            .locator
            .fallen
            .iter()
            .filter(|g| matches!(g, Guard::Region(_)));
        self.locator.zeros.extend(edges.map(|&edge| (edge, 1)));
        self.set_mode_decided();
        self.let_lie();
        if self.switcher.decider.decision.expanded {
            self.now.series = Progress::Complete;
        }
        if !hit {
            self.refuse_corners()?;
        }
        if hit || self.rows_have_joined() {
            self.project(true)?;
        }
        self.begin_series().map_err(|e| self.error(e))?;
        self.note_forces_that_begin();
        if self.dynamics.has_dependent_rows() {
            let valued = self.now.valued;
            self.evaluate_all_rows()?;
            self.switcher.decider.decision.ambiguous |= self.dynamics.leaves_motion_open();
            self.ask_for_guards();
            self.now.series = Progress::None;
            self.expand()?;
            self.evaluate()?;
            self.now.valued = valued;
            self.note_redundant_forces();
        } else {
            self.switcher.redundant.clear();
        }
        let outcome = core::mem::take(&mut self.switcher.collider.outcome);
        let impulses = if hit { &outcome.impulses[..] } else { &[] };
        self.log_changes(impulses, self.switcher.decider.decision.ambiguous);
        self.switcher.collider.outcome = outcome;
        self.stops_of_the_mode()
    }

    /// Forces of several constraints that vanish at this instant begin in the direction in which their frictions are pressed.
    fn note_forces_that_begin(&mut self) {
        for (f, friction) in self.description().frictions.iter().enumerate() {
            if let Normal::Resultant(i) = friction.normal
                && let Some(order) = self.dynamics.resultant_order(i).filter(|&order| order > 0)
            {
                let guard = Guard::NormalForceSign(f);
                self.locator.zeros.push((guard, order));
            }
        }
    }

    /// A gap that stays zero because other contacts are closed is off by the error of positions, on either side.
    fn let_lie(&mut self) {
        let zeros = self.locator.zeros.iter();
        let lying = zeros
            .filter(|(guard, order)| matches!(guard, Guard::Gap(_)) && *order >= guard::LENGTH);
        self.locator.lies = false;
        for &(gap, _) in lying {
            self.locator.lies = true;
            let margin = self.settings.tolerance;
            self.locator.polynomials.lower(gap, margin);
        }
    }

    /// The forces just before, and the impact if something is hit; whether one was.
    pub(super) fn meet(&mut self, facts: &mut SwitchFacts) -> Result<bool, Error> {
        self.take_sides_not_watched();
        if !self.now.valued {
            self.evaluate()?;
        }
        self.remember_before();
        let arrives = facts.arriving.contains(&true);
        let hit = arrives && self.hit(facts)?;
        if hit {
            self.rest_where_impact_leaves_nothing(facts)?;
            self.take_sides_after_impact(facts);
        }
        let leaves_an_edge = |guard: &Guard| matches!(guard, Guard::Region(_));
        // A gap that has just begun to open may still be as good as closed, where something else changes at once; and what lies on a surface without
        // a load may be loaded again.
        let near_surfaces = arrives || self.locator.opened || self.locator.lies;
        if near_surfaces || facts.located.iter().any(leaves_an_edge) {
            self.take_what_touches(facts);
        }
        if !hit {
            self.rest_where_slip_vanishes(facts)?;
            self.rest_with_what_comes_to_rest(facts)?;
        }
        self.balance_what_is_held(facts);
        Ok(hit)
    }

    /// The impact of the contacts whose gaps close, if there is one.
    fn hit(&mut self, facts: &mut SwitchFacts) -> Result<bool, Error> {
        let d = self.description();
        self.evaluate_all_rows()?;
        self.note_conditions();
        for c in (0..d.contacts.len()).filter(|&c| !self.now.mode.contacts[c]) {
            if !facts.arriving[c] {
                continue;
            }
            let (rate, size) = self.rate(d.contacts[c].row);
            let enters = facts.located.contains(&Guard::Region(c));
            if enters && rate.abs() <= ENTERS * self.settings.tolerance * size {
                // It rolls onto the surface.
                facts.arriving[c] = false;
            } else if rate > rounding::<T>(1e-12) * size {
                // A gap that rounding has left below zero may be growing.
                (facts.touching[c], facts.arriving[c], facts.parting[c]) = (false, false, true);
                let of_contact = [Guard::Gap(c), Guard::Region(c)];
                facts.located.retain(|guard| !of_contact.contains(guard));
            }
        }
        if !(0..d.contacts.len()).any(|c| facts.arriving[c] && self.approaching(c)) {
            return Ok(false);
        }
        // What has just parted may be pushed back, and so may what is away by no more than rounding.
        let mut near = core::mem::take(&mut self.switcher.near);
        near.clear();
        let vanish = (0..d.contacts.len()).filter(|&c| facts.touching[c]);
        let off = vanish.map(|c| self.gap(c).abs()).fold(0.0, f64::max);
        for c in 0..d.contacts.len() {
            if facts.touching[c] || facts.parting[c] {
                near.push(c);
            } else if self.may_touch(c, facts) && self.is_within_rounding(c, off) {
                near.push(c);
                facts.arriving[c] |= self.approaching(c);
            }
        }
        let impacts = self.settings.impacts.unwrap_or(d.impacts);
        let time = self.now.t.value();
        let mut solved =
            (near.iter()).try_for_each(|&c| domain::check_restitution(&self.dynamics, time, c));
        if solved.is_ok() {
            solved = self.switcher.collider.solve(
                &self.dynamics,
                time,
                &self.now.state.v,
                &near,
                impacts,
            );
        }
        self.switcher.near = near;
        solved?;
        let mut outcome = core::mem::take(&mut self.switcher.collider.outcome);
        self.now.state.v.copy_from_slice(&outcome.v);
        self.log_impacts(&outcome, facts);
        self.after_impact(&outcome, facts);
        let accumulated = self.close_accumulated(&outcome, facts);
        if let Ok(true) = accumulated {
            let rest = &self.switcher.collider.rest;
            outcome.impulses.clone_from(&rest.impulses);
        }
        self.switcher.collider.outcome = outcome;
        accumulated?;
        Ok(true)
    }

    /// Contacts that have closed may bring others with them: a beam on two of its four supports lies on all. What comes to the edge of a surface may touch
    /// another there: a wheel rolls about the edge of a table. Their gaps and rates vanish, and nothing but rounding would tell later which of them closes when. What an impact has thrown off is among them where the impacts
    /// of the others end with it.
    fn take_what_touches(&mut self, facts: &mut SwitchFacts) {
        let d = self.description();
        let contacts = 0..d.contacts.len();
        if !contacts.clone().any(|c| self.may_touch(c, facts)) {
            return;
        }
        self.tape_of_all_rows();
        self.now.valued = false;
        let closed = contacts.clone().filter(|&c| facts.touching[c]);
        let off = closed.map(|c| self.gap(c).abs()).fold(0.0, f64::max);
        for c in contacts {
            if self.may_touch(c, facts) && self.touches(c, off) {
                self.end(c, facts);
                let rubs = |f: &usize| d.frictions[*f].normal.is_of(c);
                for f in (0..d.frictions.len()).filter(rubs) {
                    facts.resting[f] = self.slip_vanishes(f);
                }
            }
        }
    }

    /// The gap of contact `c`.
    pub(super) fn gap(&self, c: usize) -> f64 {
        let d = self.description();
        let place = d.rows[d.contacts[c].row].position;
        place.map_or(0.0, |place| self.dynamics.motion(place).value())
    }

    /// Whether contact `c` is none that is known to touch, to be below its surface or at the edge of it.
    fn may_touch(&self, c: usize, facts: &SwitchFacts) -> bool {
        let takes_part = self
            .dynamics
            .effects()
            .includes(self.description(), Item::Contact(c));
        let is_at_edge = facts.located.contains(&Guard::Region(c));
        takes_part && !(facts.touching[c] || self.now.below[c] || is_at_edge)
    }

    /// Whether rounding explains the gap of contact `c`, or what the run has left of the gaps that vanish, which are `off` by so much: a table that
    /// falls back from two of its feet lands on the others at once.
    fn is_within_rounding(&self, c: usize, off: f64) -> bool {
        self.is_in_region(c) && self.gap(c).abs() <= self.rounding_of_gap(c).max(LEVER * off)
    }

    /// Whether the gap of contact `c` and its rate vanish beside the terms that make them; gaps that vanish are `off` by so much.
    fn touches(&self, c: usize, off: f64) -> bool {
        let contact = &self.description().contacts[c];
        let number = |place| self.dynamics.motion(place).value();
        let row = &self.description().rows[contact.row];
        let gap = self.gap(c);
        let terms = row.jacobian.iter();
        let extent: f64 = terms
            .map(|&(j, place)| number(place).abs() * self.now.state.q[j].value().abs().max(1.0))
            .sum();
        let (rate, size) = self.rate(contact.row);
        self.is_in_region(c)
            && gap.abs() <= rounding::<T>(ROUNDING) * extent + off
            && rate.abs() <= rounding::<T>(ROUNDING) * size
    }

    /// Whether the switch has brought rows that the state need not satisfy to rounding.
    fn rows_have_joined(&self) -> bool {
        let (before, after) = (&self.recorder.before.mode, &self.now.mode);
        let mut contacts = before.contacts.iter().zip(&after.contacts);
        let mut frictions = before.frictions.iter().zip(&after.frictions);
        contacts.any(|(before, after)| !before & after)
            || frictions.any(|(before, after)| before != after && *after == FrictionMode::Stick)
            || before.branches != after.branches
    }

    /// Whether the gap of contact `c` closes at the present state: faster than rounding does.
    fn approaching(&self, c: usize) -> bool {
        let d = self.description();
        let (rate, size) = self.rate(d.contacts[c].row);
        self.dynamics.effects().includes(d, Item::Contact(c))
            && rate < -rounding::<T>(ROUNDING) * size
    }

    /// What is known after an impact; `dynamics` still holds the state before.
    fn after_impact(&self, outcome: &Impact<T>, facts: &mut SwitchFacts) {
        let d = self.description();
        for &c in &self.switcher.near {
            facts.touching[c] = outcome.stays[c];
            facts.parting[c] = !outcome.stays[c];
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            // A body that falls flat on its face while a corner of it sticks pushes that corner by the error of its angle.
            let sticks_on = self.now.mode.frictions[f] == FrictionMode::Stick
                && outcome.slips[f] <= self.settings.tolerance;
            facts.resting[f] = match friction.normal {
                Normal::Contact(c) if !self.switcher.near.contains(&c) => facts.resting[f],
                // Others that stick may have ended its slip.
                Normal::Contact(_) | Normal::Constraint(_) | Normal::Resultant(_) => {
                    outcome.sticks[f] || sticks_on || self.rests_after(outcome, f)
                }
                // No impulse acts there, but the impact may have begun or ended its slip.
                Normal::Given(_) => self.rests_after(outcome, f),
            };
        }
        // Velocities have jumped: what was located for the old ones says nothing about the new.
        facts.jumped = true;
        facts.located.clear();
    }

    /// Whether the slip of friction `f` vanishes after an impact.
    fn rests_after(&self, outcome: &Impact<T>, f: usize) -> bool {
        let friction = &self.description().frictions[f];
        friction.rows().all(|row| {
            let (mut slip, mut size) = self.rate(row);
            let jacobian = self.description().rows[row].jacobian.iter();
            for &(j, place) in jacobian {
                let jump = (outcome.v[j] - self.recorder.before.state.v[j]).value();
                let part = self.dynamics.motion(place).value() * jump;
                slip += part;
                size += part.abs();
            }
            slip.abs() <= rounding::<T>(ROUNDING) * size
        })
    }

    /// A contact that closes without impact carries frictions whose slip nobody has looked at, and may end slips that its rate is
    /// part of: a stop that carries what rubs against it.
    fn rest_where_slip_vanishes(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        let d = self.description();
        let closes = facts.arriving.contains(&true);
        let wakes = |run: &Self, facts: &SwitchFacts, f: usize| {
            d.frictions[f].normal.presses(|c| facts.touching[c])
                && !facts.resting[f]
                && (closes || run.now.mode.frictions[f] == FrictionMode::Inactive)
                && run.dynamics.effects().includes(d, Item::Friction(f))
        };
        if !(0..d.frictions.len()).any(|f| wakes(self, facts, f)) {
            return Ok(());
        }
        self.evaluate_all_rows()?;
        for f in 0..d.frictions.len() {
            if wakes(self, facts, f) {
                facts.resting[f] = self.slip_vanishes(f);
            }
        }
        Ok(())
    }

    /// What comes to rest may end other slips of which it leaves nothing: the brake of one axle stops the car, and with it the locked wheels
    /// of the other one. Their zeros are one instant, which drift from the rows that act tears apart.
    fn rest_with_what_comes_to_rest(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        let comes = |guard: &Guard| matches!(guard, Guard::Slip(_));
        let slips = |f: &usize| {
            matches!(self.now.mode.frictions[*f], FrictionMode::Slip(_)) && !facts.resting[*f]
        };
        let mut ending = core::mem::take(&mut self.switcher.ending);
        ending.clear();
        if self.locator.fallen.iter().any(comes) {
            ending.extend((0..facts.resting.len()).filter(slips));
        }
        self.rest_among(ending, facts)
    }

    /// A slip after an impact may be the error of rows that hold on: of a box that lands in the corner of a floor and a wall that move together.
    fn rest_where_impact_leaves_nothing(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        let d = self.description();
        let rubs = |f: &usize| {
            let friction = &d.frictions[*f];
            d.rows[friction.row].rheonomic
                && friction.normal.presses(|c| facts.touching[c])
                && !facts.resting[*f]
                && self.dynamics.effects().includes(d, Item::Friction(*f))
        };
        let mut ending = core::mem::take(&mut self.switcher.ending);
        ending.clear();
        if facts.touching.contains(&true) {
            ending.extend((0..d.frictions.len()).filter(rubs));
        }
        self.rest_among(ending, facts)
    }

    /// Which of these slips are the errors of rows, and rest.
    fn rest_among(&mut self, mut ending: Vec<usize>, facts: &mut SwitchFacts) -> Result<(), Error> {
        if !ending.is_empty() {
            self.evaluate_all_rows()?;
        }
        ending.retain(|&f| {
            self.rates_of_slip(f)
                .all(|(slip, size)| slip.abs() <= self.settings.tolerance * size.max(1.0))
        });
        if !ending.is_empty() {
            self.rest_if_nothing_is_left(&ending, facts);
        }
        self.switcher.ending = ending;
        Ok(())
    }

    /// Which of these slips vanish once all that rests sticks, and what touches stays closed.
    fn rest_if_nothing_is_left(&mut self, ending: &[usize], facts: &mut SwitchFacts) {
        self.switcher.before_holding.clone_from(&self.now.state);
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.now.mode);
        mode.contacts.copy_from_slice(&facts.touching);
        mode.release_sticking();
        for (friction, resting) in mode.frictions.iter_mut().zip(&facts.resting) {
            if *resting {
                *friction = FrictionMode::Stick;
            }
        }
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        // Where no velocity satisfies all rows together, none of the slips has ended.
        if self.project(true).is_ok() && self.evaluate_all_rows().is_ok() {
            for &f in ending {
                facts.resting[f] = self.slip_vanishes(f);
            }
        }
        self.now.state.clone_from(&self.switcher.before_holding);
        self.dynamics.set_mode(&self.now.mode);
        self.now.valued = false;
    }

    /// Whether the slip of friction `f` is zero beside the terms that make it.
    pub(super) fn slip_vanishes(&self, f: usize) -> bool {
        let sizes = self.rates_of_slip(f).map(|(_, size)| size);
        let size = sizes.fold(0.0, f64::max);
        let mut rates = self.rates_of_slip(f);
        rates.all(|(rate, _)| rate.abs() <= rounding::<T>(ROUNDING) * size)
    }

    /// [`Self::rate`] of every component of the slip of friction `f`.
    fn rates_of_slip(&self, f: usize) -> impl Iterator<Item = (f64, f64)> {
        let friction = &self.description().frictions[f];
        let rows = friction.rows();
        rows.map(|row| self.rate(row))
    }

    /// Rate of a row (slip, rate of a gap) and the size of the terms that make it; a velocity that is zero is so only to some
    /// 1e-16 of the unit, as projections leave it.
    pub(super) fn rate(&self, row: usize) -> (f64, f64) {
        let row = &self.description().rows[row];
        let number = |place| self.dynamics.motion(place).value();
        let size = |j: usize| self.now.state.v[j].value().abs() + AT_REST;
        let terms = row.jacobian.iter();
        let sizes = terms.map(|&(j, place)| number(place).abs() * size(j));
        (number(row.velocity), sizes.sum())
    }
}
