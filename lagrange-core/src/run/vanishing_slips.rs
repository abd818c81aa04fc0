//! Slips that vanish with what a switch has brought: with the contact that carries them, with other slips, or after an impact.

use super::Run;
use super::spatial_slip::ERRORS;
use super::touching::ROUNDING;
use crate::arithmetic::{Scalar, rounding};
use crate::error::Error;
use crate::mode::{Direction, FrictionMode};
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard};
use crate::trajectory::State;

impl<T: Scalar> Run<T> {
    /// A contact that closes without impact carries frictions whose slip nobody has looked at, and may end slips that its rate is
    /// part of: a stop that carries what rubs against it. So may the end of a piece of a law that drives what rubs: a follower comes to rest on its cam as
    /// smoothly as (1 − t)³, and its slip does not pass zero.
    pub(super) fn rest_where_slip_vanishes(&mut self, facts: &mut SwitchFacts) {
        let d = self.description();
        let ends = facts.arriving.contains(&true) || facts.balanced.contains(&true);
        let wakes = |run: &Self, facts: &SwitchFacts, f: usize| {
            !facts.resting[f]
                && (ends || run.now.mode.frictions[f] == FrictionMode::Inactive)
                && facts.may_act(f, d, run.dynamics.effects())
        };
        if !(0..d.frictions.len()).any(|f| wakes(self, facts, f)) {
            return;
        }
        self.hold_velocities();
        self.tape_of_all_rows();
        for f in 0..d.frictions.len() {
            if wakes(self, facts, f) {
                facts.resting[f] = self.slip_vanishes(f);
            }
        }
    }

    /// What comes to rest may end other slips of which it leaves nothing: the brake of one axle stops the car, and with it the locked wheels
    /// of the other one. Their zeros are one instant, which drift from the rows that act tears apart.
    pub(super) fn rest_with_what_comes_to_rest(&mut self, facts: &mut SwitchFacts) {
        let comes = |guard: &&Guard| matches!(guard, Guard::Slip(_));
        let slips = |f: &usize| {
            matches!(self.now.mode.frictions[*f], FrictionMode::Slip(_)) && !facts.resting[*f]
        };
        let coming = self.locator.fallen.iter().filter(comes).count();
        let mut ending = core::mem::take(&mut self.switcher.ending);
        ending.clear();
        if coming > 0 {
            ending.extend((0..facts.resting.len()).filter(slips));
        }
        self.rest_among(ending, coming > 1, facts);
    }

    /// Slips of two components no larger than the errors of velocities begin anew with what lets go, and with one of them that comes to rest: of a plate whose
    /// pads let go shortly one after the other errors would choose how the first one rubs, and whether the second one holds.
    pub(super) fn slips_begin_anew(&mut self, facts: &mut SwitchFacts) {
        // An instant that errors choose has no derivatives.
        if T::DERIVATIVES > 0 || !self.now.mode.has_turning_slip() {
            return;
        }
        let was_lost = self.stepper.astray * ERRORS >= 1.0;
        let sticks = |f: usize| self.now.mode.frictions[f] == FrictionMode::Stick;
        let lets_go = |guard: &Guard| guard.holding().is_some_and(sticks);
        let rests = |guard: &Guard| matches!(*guard, Guard::Slip(f) if self.turns(f));
        let come_to_rest = was_lost && facts.located.iter().any(rests);
        if !come_to_rest && !facts.located.iter().any(lets_go) {
            return;
        }
        self.tape_of_all_rows();
        self.now.valued = false;
        let lost = |run: &Self, f: usize| {
            let rests = facts.resting[f] && come_to_rest;
            run.turns(f)
                && (rests || run.error_of_direction(f) * ERRORS >= 1.0)
                && !guard::fades(f, &run.dynamics)
        };
        let mut ending = core::mem::take(&mut self.switcher.ending);
        ending.clear();
        ending.extend((0..facts.resting.len()).filter(|&f| lost(self, f)));
        if !ending.is_empty() && self.begin_anew(&ending, facts) {
            facts.lost = come_to_rest;
        }
        self.switcher.ending = ending;
    }

    /// Takes away these slips, and others that vanish with them, if that is no more than what velocities may be off; whether it is.
    fn begin_anew(&mut self, lost: &[usize], facts: &mut SwitchFacts) -> bool {
        let turning = (0..facts.resting.len()).filter(|&f| self.turns(f));
        let along = |f: usize| {
            let slip = self.slip(f);
            let length = slip[0].hypot(slip[1]);
            // What has come to rest has its last direction.
            match !facts.resting[f] && length > 0.0 {
                true => slip.map(|s| s / length),
                false => self.dynamics.slip_direction(f).map(T::value),
            }
        };
        let turning: Vec<(usize, [f64; 2])> = turning.map(|f| (f, along(f))).collect();
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.now.mode);
        for &f in lost {
            mode.frictions[f] = FrictionMode::Stick;
        }
        self.dynamics.set_mode(mode);
        let stops = self.stop_within_errors();
        if stops {
            self.now.state.v.copy_from_slice(&self.locator.earlier);
            self.tape_of_all_rows();
            for (f, along) in turning {
                if lost.contains(&f) || self.slip_vanishes(f) {
                    facts.resting[f] = true;
                    // That it goes on along itself is no event.
                    let before = &mut self.recorder.before.mode;
                    before.turn(f, Direction::Incipient(along));
                }
            }
        }
        self.dynamics.set_mode(&self.now.mode);
        stops
    }

    /// A slip after an impact may be the error of rows that hold on: of a box that lands in the corner of a floor and a wall that move together, or on both
    /// of its feet.
    pub(super) fn rest_where_impact_leaves_nothing(&mut self, facts: &mut SwitchFacts) {
        let d = self.description();
        let effects = self.dynamics.effects();
        let acts = |f: &usize| !facts.resting[*f] && facts.may_act(*f, d, effects);
        let mut ending = core::mem::take(&mut self.switcher.ending);
        ending.clear();
        if facts.touching.contains(&true) {
            ending.extend((0..d.frictions.len()).filter(acts));
        }
        self.rest_among(ending, false, facts);
    }

    /// Which of these slips are the errors of rows, and rest; whether several others do that are errors of rows to one another.
    fn rest_among(&mut self, mut ending: Vec<usize>, several: bool, facts: &mut SwitchFacts) {
        if !ending.is_empty() {
            // In no mode: velocities that have jumped may contradict the present one.
            self.tape_of_all_rows();
            self.now.valued = false;
        }
        ending.retain(|&f| {
            self.rates_of_slip(f)
                .all(|(slip, size)| slip.abs() <= self.settings.tolerance * size.max(1.0))
        });
        if several || !ending.is_empty() {
            self.rest_if_nothing_is_left(&ending, several, facts);
        }
        self.switcher.ending = ending;
    }

    /// Which of these slips vanish once all that rests sticks, and what touches stays closed. If one does, or `several` others do, the velocities
    /// become those at which all vanish, if errors tell them apart: what is left of them would contradict that all stick. They do not in the
    /// dead centre of a crank, which rests for an instant while its slider moves on.
    fn rest_if_nothing_is_left(
        &mut self,
        ending: &[usize],
        several: bool,
        facts: &mut SwitchFacts,
    ) {
        self.switcher.before_holding.clone_from(&self.now.state);
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.now.mode);
        mode.contacts.copy_from_slice(&facts.touching);
        mode.release_sticking();
        for f in 0..facts.resting.len() {
            // In a dead centre a slip is zero however fast the motion is: it does not hold what moves on.
            if facts.resting[f] && !self.acts_by_rounding(f) {
                self.switcher.scratch_mode.frictions[f] = FrictionMode::Stick;
            }
        }
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        let mut hold = false;
        // Where no velocity satisfies all rows together, none of the slips has ended.
        if self.hold_all_rows().is_ok() {
            hold = several;
            for &f in ending {
                facts.resting[f] = self.slip_vanishes(f);
                hold |= facts.resting[f];
            }
        }
        let State { q, v, .. } = &self.switcher.before_holding;
        let mut velocities = v.iter().zip(&self.now.state.v);
        let hold = hold
            && velocities.all(|(before, held)| {
                let (before, held) = (before.value(), held.value());
                (held - before).abs() <= self.settings.tolerance * before.abs().max(1.0)
            });
        self.now.state.q.copy_from_slice(q);
        if !hold {
            self.now.state.v.copy_from_slice(v);
        }
        self.dynamics.set_mode(&self.now.mode);
        self.now.valued = false;
    }

    /// Takes away what the run has left of the rates of rows that hold, where it can be: of a wheel that has rolled along one surface it would be
    /// its slip on the next.
    pub(super) fn hold_velocities(&mut self) {
        let State { q, v, .. } = &mut self.now.state;
        let before = &mut self.switcher.before_holding.v;
        before.copy_from_slice(v);
        let held = self.dynamics.project_velocities(self.now.t, q, v, &[], 0.0);
        if held.is_err() {
            v.copy_from_slice(before);
        }
        self.now.valued = false;
    }

    /// The same of the gaps: it would be the gap of the next surface.
    pub(super) fn hold_rows(&mut self) {
        self.switcher.before_holding.clone_from(&self.now.state);
        if self.project(true).is_err() {
            self.now.state.clone_from(&self.switcher.before_holding);
            self.now.valued = false;
        }
    }

    /// Moves the state onto the rows of the mode of the dynamics, velocities to their last digit, and evaluates all rows there.
    fn hold_all_rows(&mut self) -> Result<(), Error> {
        self.project(true)?;
        let State { q, v, .. } = &mut self.now.state;
        let held = self.dynamics.project_velocities(self.now.t, q, v, &[], 0.0);
        held.map_err(|e| self.error(e))?;
        self.tape_of_all_rows();
        Ok(())
    }

    /// Whether the slip of friction `f` is zero beside the terms that make it.
    pub(super) fn slip_vanishes(&self, f: usize) -> bool {
        let sizes = self.rates_of_slip(f).map(|(_, size)| size);
        let size = sizes.fold(0.0, f64::max);
        let mut rates = self.rates_of_slip(f);
        rates.all(|(rate, _)| rate.abs() <= rounding::<T>(ROUNDING) * size)
    }

    /// [`Self::rate`] of every component of the slip of friction `f`.
    pub(super) fn rates_of_slip(&self, f: usize) -> impl Iterator<Item = (f64, f64)> {
        let friction = &self.description().frictions[f];
        let rows = friction.rows();
        rows.map(|row| self.rate(row))
    }

    /// Rate of a row (slip, rate of a gap) and the size of the terms that make it; a velocity that is zero is so only to some
    /// 1e-16 of the unit, as projections leave it.
    pub(super) fn rate(&self, row: usize) -> (f64, f64) {
        let rate = self.description().rows[row].velocity;
        let size = |j: usize| self.now.state.v[j].value().abs() + self.dynamics.at_rest(j);
        let size = self.dynamics.size_of_row(row, size);
        (self.dynamics.motion(rate).value(), size)
    }
}
