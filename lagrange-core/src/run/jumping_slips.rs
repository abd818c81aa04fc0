//! Slips that jump where a piecewise expression changes: a block is carried from one belt to another that runs the other way, or its belt is reversed.
//!
//! The force of a friction is finite, so that velocities do not jump with the slip: what has stuck slips in the direction that the slip has then, what
//! has slipped the other way slips on in that, and what a belt that stops has caught up with rests.

use super::Run;
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::mode::{Direction, FrictionMode, Sliding};
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;

/// A slip at an instant: its components, and how large they may be and yet nothing.
type Slip = Vec<(f64, f64)>;

/// What a slip that has jumped makes of its friction.
#[derive(Clone, Copy, Debug)]
enum Jumped {
    /// It slips in this direction.
    Slips(Sliding),
    /// It rests.
    Rests,
}

impl<T: Scalar> Run<T> {
    /// Finds the mode in which the motion goes on, into the decision, from what is known.
    ///
    /// # Errors
    /// [`Error::NoMode`], or why equations cannot be evaluated.
    pub(super) fn decide(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        self.decide_from(facts)?;
        let decision = &self.switcher.decider.decision;
        if decision.mode.branches == self.now.mode.branches || decision.mode.frictions.is_empty() {
            return Ok(());
        }
        let zeros = decision.zeros.clone();
        let before = self.now.mode.clone();
        if !self.take_slips_that_jumped(facts) {
            return Ok(());
        }
        self.decide_from(facts)?;
        // Conditions that change vanish at the instant, although nobody asks for their sides again.
        let changed = zeros.into_iter().filter(|(guard, _)| match *guard {
            Guard::Branch(b) => before.branch(b) != self.now.mode.branch(b),
            _ => false,
        });
        self.switcher.decider.decision.zeros.extend(changed);
        Ok(())
    }

    fn decide_from(&mut self, facts: &SwitchFacts) -> Result<(), Error> {
        let here = self
            .now
            .context(self.stepper.order, self.settings.tolerance, facts);
        (self.switcher.decider).decide(&mut self.dynamics, &mut self.switcher.table, here)
    }

    /// Puts the present mode on the sides that the decision has chosen, and frictions into the slips that they have there, if one of these is not as
    /// decided; whether one is.
    fn take_slips_that_jumped(&mut self, facts: &mut SwitchFacts) -> bool {
        let decided = self.switcher.decider.decision.mode.clone();
        // The values of all rows take the place of what the decision has left.
        self.switcher.decider.decision.expanded = false;
        self.now.valued = false;
        let mode = self.now.mode.clone();
        let [before, after] = self.on_both_sides([&mode, &decided], Self::slips);
        let frictions = decided.frictions.iter().enumerate();
        let jumped = frictions.filter_map(|(f, acts)| {
            let jumped = after_jump(*acts, &before[f], &after[f])?;
            Some((f, jumped))
        });
        let jumped: Vec<(usize, Jumped)> = jumped.collect();
        if jumped.is_empty() {
            return false;
        }
        for &(f, jump) in &jumped {
            facts.resting[f] = matches!(jump, Jumped::Rests);
            if let Jumped::Slips(sliding) = jump {
                self.now.mode.frictions[f] = FrictionMode::Slip(sliding);
            }
        }
        let branches = 0..self.description().branches.len();
        let changes = |b: &usize| decided.branch(*b) != self.now.mode.branch(*b);
        let changed: Vec<usize> = branches.filter(changes).collect();
        for &b in &changed {
            self.now.mode.set_branch(b, decided.branch(b));
            facts.balanced[b] = false;
        }
        self.dynamics.set_mode(&self.now.mode);
        let is_past = |guard: &Guard| match *guard {
            Guard::Branch(b) => changed.contains(&b),
            Guard::Slip(f) | Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) => {
                jumped.iter().any(|(g, _)| *g == f)
            }
            _ => false,
        };
        facts.located.retain(|guard| !is_past(guard));
        true
    }

    /// The slips at the present state, on the sides that `dynamics` is on.
    fn slips(&self) -> Vec<Slip> {
        let component = |row: usize| {
            let (rate, size) = self.rate(row);
            (rate, self.settings.tolerance * size.max(1.0))
        };
        let frictions = self.description().frictions.iter();
        let slips = frictions.map(|friction| friction.rows().map(component).collect());
        slips.collect()
    }
}

/// What a friction that is to act in this way does instead, where its slip has jumped, if anything.
fn after_jump(acts: FrictionMode, before: &Slip, after: &Slip) -> Option<Jumped> {
    let mut pairs = before.iter().zip(after);
    let jumps = pairs.any(|((before, _), (after, nothing))| (after - before).abs() > *nothing);
    let rests = after.iter().all(|(rate, nothing)| rate.abs() <= *nothing);
    let normal_sign = match acts {
        FrictionMode::Inactive => return None,
        FrictionMode::Stick => 1.0,
        FrictionMode::Slip(sliding) => sliding.normal_sign,
    };
    match acts {
        _ if !jumps => return None,
        FrictionMode::Stick if rests => return None,
        _ if rests => return Some(Jumped::Rests),
        _ => {}
    }
    let sliding = Sliding {
        direction: Direction::of_slip(after.iter().map(|(rate, _)| *rate)),
        normal_sign,
    };
    (acts != FrictionMode::Slip(sliding)).then_some(Jumped::Slips(sliding))
}
