//! The end of infinitely many impacts in finite time: what those do together that are not followed.
//!
//! A flight of that length and an impact without restitution at its end do the same: momentum does not see how impulses are distributed, and neither does
//! friction that slips all the while. Whatever else would happen in that time happens first, and impacts are followed until then.

use super::Run;
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;
use crate::modes::impact::Impact;
use crate::trajectory::{EventKind, State, Subject};

/// A guard that has fallen to this share of itself has come to rest.
const AT_REST: f64 = 1e-6;

impl<T: Scalar> Run<T> {
    /// Whether nothing else happens before all impacts that are left have ended. Intervals that shrink to nothing at once may do so because others strike what
    /// contact `c` touches: what is left of them must close it.
    pub(super) fn ends_undisturbed(
        &mut self,
        c: usize,
        lasts: T,
        outcome: &Impact<T>,
        facts: &SwitchFacts,
    ) -> bool {
        if lasts.is_zero() {
            return true;
        }
        let time = self.now.t;
        let mut near = core::mem::take(&mut self.switcher.near);
        near.clear();
        let ends = |&other: &usize| {
            facts.touching[other] || other == c || self.ends_together(other, outcome)
        };
        near.extend((0..facts.touching.len()).filter(ends));
        self.switcher.before_holding.clone_from(&self.now.state);
        let flies = self.fly_to_rest(&near, lasts, outcome).is_ok();
        let closes = flies
            && (self.switcher.collider.rest.stays[c] || !self.switcher.impacts[c].collapses());
        let disturbed = closes && !self.flew_low(c) && self.is_disturbed(time, lasts, &near);
        // What is asked next is asked of the state before the impact.
        self.now.t = time;
        self.now.state.clone_from(&self.recorder.before.state);
        self.dynamics.set_mode(&self.now.mode);
        let evaluated = self.evaluate_all_rows().is_ok();
        self.now.state.clone_from(&self.switcher.before_holding);
        self.switcher.near = near;
        evaluated && closes && !disturbed
    }

    /// Whether anything happens in a flight that began at `time`, and at the end of which the motion is now, but in the moment before the end that the tolerance
    /// leaves. Where gaps and slips of the contacts that are `near` come to rest nothing happens.
    fn is_disturbed(&mut self, time: T, lasted: T, near: &[usize]) -> bool {
        let moment = T::from_f64(self.settings.tolerance.min(lasted.value()));
        self.now.t -= moment;
        let State { q, v, .. } = &mut self.now.state;
        (q.iter_mut().zip(v)).for_each(|(q, v)| *q -= moment * *v);
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        let mut after = core::mem::take(&mut self.switcher.guards);
        let mut evaluated = self.evaluate_all_rows().is_ok();
        self.value_guards(&mut after);
        self.now.t = time;
        core::mem::swap(&mut self.now.state, &mut self.switcher.before_holding);
        evaluated &= self.evaluate_all_rows().is_ok();
        core::mem::swap(&mut self.now.state, &mut self.switcher.before_holding);
        self.dynamics.report_value();
        let d = self.description();
        let is_near = |c: usize| near.contains(&c);
        let of_impacts = |guard: Guard| match guard {
            Guard::Gap(c) | Guard::Normal(c) => is_near(c),
            Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) => {
                d.frictions[f].normal.presses(d, is_near)
            }
            // What rubs by a force of its own comes to rest by itself.
            Guard::Slip(f) => d.frictions[f].normal.contact(d).is_some_and(is_near),
            // How forces are shared is no event.
            Guard::Composite(_) | Guard::NormalForceSign(_) => true,
            Guard::Region(_) | Guard::Branch(_) | Guard::Stop(..) | Guard::Mark(..) => false,
        };
        let changes = |(index, after): (usize, &f64)| {
            let polynomials = &self.locator.polynomials;
            let before = polynomials.value(index, &self.now.mode, &self.dynamics);
            let guard = polynomials.get(index).map(|(guard, _)| guard);
            let changes = before * after < 0.0 && after.abs() > AT_REST * before.abs();
            // A condition becomes true where it rises.
            let told = match guard {
                Some(Guard::Stop(i, _)) => *after > 0.0 || d.stops[i].zeros,
                Some(Guard::Mark(i, _)) => *after > 0.0 || d.marks[i].zeros,
                Some(guard) => !of_impacts(guard),
                None => false,
            };
            changes && told
        };
        let disturbed = evaluated && after.iter().enumerate().any(changes);
        self.switcher.guards = after;
        disturbed
    }

    /// The values of all guards that are watched at the last value of the dynamics.
    fn value_guards(&mut self, values: &mut Vec<f64>) {
        self.dynamics.report_value();
        values.clear();
        let polynomials = &self.locator.polynomials;
        let watched = (0..).take_while(|&index| polynomials.get(index).is_some());
        values
            .extend(watched.map(|index| polynomials.value(index, &self.now.mode, &self.dynamics)));
    }

    /// Makes the impacts that are left of contact `c`: after so many, in so long a time. A motion that cannot go on ends where it was.
    pub(super) fn close_contacts(
        &mut self,
        c: usize,
        last: (usize, T),
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Result<(), Error> {
        let time = self.now.t;
        self.switcher.before_holding.clone_from(&self.now.state);
        let closed = self.make_last_impacts(c, last, outcome, facts);
        if closed.is_err() {
            self.now.t = time;
            self.now.state.clone_from(&self.switcher.before_holding);
        }
        closed
    }

    /// The same, with what it leaves where it fails.
    fn make_last_impacts(
        &mut self,
        c: usize,
        (count, remaining): (usize, T),
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Result<(), Error> {
        let d = self.description();
        let mut near = core::mem::take(&mut self.switcher.near);
        near.clear();
        near.extend((0..d.contacts.len()).filter(|&c| facts.touching[c]));
        if !remaining.is_zero() {
            self.begin_flight(outcome, facts)?;
        }
        self.fly_to_rest(&near, remaining, outcome)?;
        let rest = core::mem::take(&mut self.switcher.collider.rest);
        // What comes to rest here does so together with what it lifts. A slip that is zero however fast the motion is does not hold what moves on.
        for f in near.iter().flat_map(|&c| d.frictions_on(c)) {
            if rest.sticks[f] && !self.acts_by_rounding(f) {
                self.switcher.scratch_mode.frictions[f] = FrictionMode::Stick;
            }
        }
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        self.project(true)?;
        self.evaluate_all_rows()?;
        for (f, friction) in d.frictions.iter().enumerate() {
            // A friction with a force of its own has slipped at the last impact and sticks again before the next one.
            if friction.normal.presses(d, |c| near.contains(&c)) {
                facts.resting[f] = rest.sticks[f] || self.slip_vanishes(f);
            }
        }
        (self.switcher.near, self.switcher.collider.rest) = (near, rest);
        // The mode is still that of the flights, and so are the forces; what changes with the last one does so from here.
        self.dynamics.set_mode(&self.now.mode);
        self.evaluate_all_rows()?;
        let kind = EventKind::Accumulates { impacts: count };
        self.log_here(Subject::Contact(c), kind);
        self.remember_before();
        Ok(())
    }

    /// Begins the flight after the last impact that is followed, in the mode that is decided on as after any other.
    fn begin_flight(&mut self, outcome: &Impact<T>, facts: &SwitchFacts) -> Result<(), Error> {
        let mut flying = core::mem::take(&mut self.switcher.flying);
        flying.clone_from(facts);
        for (c, stays) in outcome.stays.iter().enumerate() {
            // What is to end closed flies now.
            flying.parting[c] |= flying.touching[c] && !stays;
            flying.touching[c] &= stays;
        }
        self.take_what_impact_leaves(&mut flying);
        self.balance_what_is_held(&mut flying);
        self.decide(&mut flying)?;
        self.switcher.flying = flying;
        let decision = &self.switcher.decider.decision;
        self.now.mode.clone_from(&decision.mode);
        let ambiguous = decision.ambiguous;
        self.dynamics.set_mode(&self.now.mode);
        self.evaluate_all_rows()?;
        self.note_conditions();
        self.log_after_impacts(&outcome.impulses, ambiguous);
        Ok(())
    }

    /// Moves the state through a flight of this length, or to where it meets another surface, and what the impacts in it leave of velocities; `near` close in it.
    fn fly_to_rest(
        &mut self,
        near: &[usize],
        mut lasts: T,
        outcome: &Impact<T>,
    ) -> Result<(), Error> {
        self.fly_off(lasts, outcome)?;
        let beyond = self.time_beyond(near);
        if beyond.value() > 0.0 && beyond.value() <= lasts.value() {
            self.fly(-beyond);
            self.evaluate_all_rows()?;
            lasts -= beyond;
        }
        let time = self.now.t.value();
        (self.switcher.collider).bring_to_rest(&self.dynamics, time, &self.now.state.v, near)?;
        let half = T::from_f64(0.5) * lasts;
        let State { q, v, .. } = &mut self.now.state;
        for ((q, v), &after) in q.iter_mut().zip(v).zip(&self.switcher.collider.rest.v) {
            *q += half * (after - *v);
            *v = after;
        }
        near.iter()
            .for_each(|&c| self.switcher.scratch_mode.contacts[c] = true);
        Ok(())
    }

    /// A flight after an impact, with the contacts open that it strikes.
    fn fly_off(&mut self, lasts: T, outcome: &Impact<T>) -> Result<(), Error> {
        let d = self.description();
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.recorder.before.mode);
        // What lies where nothing strikes goes on as it did.
        for c in (0..d.contacts.len()).filter(|&c| outcome.struck[c]) {
            mode.contacts[c] = false;
            d.frictions_on(c)
                .for_each(|f| mode.frictions[f] = FrictionMode::Inactive);
        }
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        self.evaluate_all_rows()?;
        self.fly(lasts);
        self.evaluate_all_rows()
    }

    /// Moves the state by a flight so short that the accelerations at hand do not change.
    fn fly(&mut self, lasts: T) {
        let half = T::from_f64(0.5) * lasts;
        let State { q, v, .. } = &mut self.now.state;
        let motion = self.dynamics.acceleration().iter();
        for ((q, v), &acceleration) in q.iter_mut().zip(v).zip(motion) {
            let change = lasts * acceleration;
            *q += lasts * *v + half * change;
            *v += change;
        }
        self.now.t += lasts;
    }

    /// How long such a flight has been beyond the surfaces of other contacts than those that are `near`: impacts with one side of a groove end where the
    /// other one begins.
    fn time_beyond(&self, near: &[usize]) -> T {
        let d = self.description();
        let others = (0..d.contacts.len()).filter(|&c| {
            let takes_part = self.dynamics.effects().includes(d, Item::Contact(c));
            let open = !(near.contains(&c) || self.now.below[c]);
            takes_part && open && self.is_in_region(c)
        });
        let since = |c: usize| {
            let row = &d.rows[d.contacts[c].row];
            let gap = row
                .position
                .map_or(T::zero(), |place| self.dynamics.motion(place));
            let (rate, _) = self.rate(d.contacts[c].row);
            let beyond = gap.value() < 0.0 && rate < 0.0;
            if beyond {
                gap / T::from_f64(rate)
            } else {
                T::zero()
            }
        };
        others.map(since).fold(T::zero(), |most, since| {
            if since.value() > most.value() {
                since
            } else {
                most
            }
        })
    }
}
