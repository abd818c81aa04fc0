//! Many contacts: principal pivoting in the place of enumeration.
//!
//! What is feasible just after an instant is a linear complementarity problem whose numbers are power series in time,
//! ordered by their leading coefficients (van der Schaft & Schumacher 1998, IEEE Trans. Automatic Control 43, 483).
//! Principal pivoting asks for signs alone: it takes a mode, sees which guards fall, and exchanges those. All at once as
//! long as they become fewer (Kostreva 1978; Júdice & Pires 1994, Computers & Operations Research 21, 587), else the last
//! one only, which cannot come back to a mode where contacts are independent and frictionless (Murty 1974).
//!
//! The search begins at the mode nearest to the present one, then where Lemke's method ends on the values at the instant.
//! Frictions begin by sticking where they can, and what slips in the mode that is found is asked whether it could stick as well, so that stick comes before
//! slip as in the enumeration; whether yet another mode would do is not asked.

use super::Decider;
use super::candidates::{Choices, look_at_slips, slide};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::facts::SwitchContext;
use crate::modes::guard::Guard;
use crate::modes::table::Table;
use crate::system::Normal;

/// Exchanges that do not make the violated guards fewer, before they are made one by one.
const PATIENCE: usize = 8;

impl<T: Scalar> Decider<T> {
    /// Looks for a feasible mode near the present one, into `self.best`. False: none was found.
    ///
    /// # Errors
    /// A mode on the way could not be evaluated.
    pub(super) fn pivot(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<bool, EvaluationError> {
        self.decision.ambiguous = false;
        look_at_slips(dynamics, here, &self.rows);
        let mut near = here.present.clone();
        Choices { dynamics, here }.begin(&mut near, false);
        // Frictions at their limits may hold on, of a load that does not grow on.
        let mut located = here.facts.located.iter();
        if !here.facts.again && located.any(|guard| guard.holding().is_some()) {
            let mut holds = here.present.clone();
            Choices { dynamics, here }.begin(&mut holds, true);
            if self.takes(dynamics, table, here, &holds) {
                return Ok(true);
            }
        }
        if self.one_lets_go(dynamics, table, here, &near) {
            return Ok(true);
        }
        // A slip that has come to zero ends or turns round, if nothing else need change.
        if let [Guard::Slip(f)] = here.facts.located[..] {
            let mut turns = near.clone();
            turns.frictions[f] = turned_round(here.present.frictions[f]);
            if self.takes_first_of(dynamics, table, here, [near.clone(), turns]) {
                return Ok(true);
            }
        }
        let mut outcome = Ok(false);
        for (guesses, sticks_first) in [(false, true), (true, true), (false, false), (true, false)]
        {
            let mut mode = near.clone();
            if guesses {
                self.guess(dynamics, here, &mut mode);
            }
            self.sticks_first = sticks_first;
            outcome = self.pivot_from(dynamics, table, here, mode);
            self.sticks_first = false;
            if let Ok(true) = outcome {
                self.hold_what_can(dynamics, table, here);
                break;
            }
        }
        outcome
    }

    /// Takes a mode in which the friction that has been overcome lets go, or else another one of one component alone in its place.
    fn one_lets_go(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        near: &Mode,
    ) -> bool {
        let [located] = here.facts.located[..] else {
            return false;
        };
        let Some(overcome) = located.holding() else {
            return false;
        };
        let mut holds = near.clone();
        holds.frictions[overcome] = FrictionMode::Stick;
        let frictions = dynamics.description().frictions.iter().enumerate();
        let others = frictions.filter(|&(f, friction)| {
            f != overcome && friction.components == 1 && holds.frictions[f] == FrictionMode::Stick
        });
        let slides = others.flat_map(|(f, _)| [(f, 1.0), (f, -1.0)]);
        let modes = slides.map(|(f, direction)| {
            let mut mode = holds.clone();
            mode.frictions[f] = slide(direction, 1.0);
            mode
        });
        let modes = core::iter::once(near.clone()).chain(modes);
        self.takes_first_of(dynamics, table, here, modes)
    }

    /// Takes the first of these modes that is feasible, if one is. What would slip in it and yet stay at rest must stick.
    fn takes_first_of(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        modes: impl IntoIterator<Item = Mode>,
    ) -> bool {
        self.sticks_first = true;
        let mut modes = modes.into_iter();
        let found = modes.any(|mode| self.takes(dynamics, table, here, &mode));
        self.sticks_first = false;
        found
    }

    /// Lets frictions stick that slip in the mode found and need not, but for those that have been overcome.
    fn hold_what_can(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) {
        for f in 0..self.best.frictions.len() {
            let slips = matches!(self.best.frictions[f], FrictionMode::Slip(_));
            let begins = here.facts.resting[f] && slips;
            let mut located = here.facts.located.iter();
            if !begins || located.any(|guard| guard.holding() == Some(f)) {
                continue;
            }
            let mut holds = self.best.clone();
            holds.frictions[f] = FrictionMode::Stick;
            self.takes(dynamics, table, here, &holds);
        }
    }

    /// Takes a mode for the one that goes on, if it is feasible, which one that cannot be evaluated is not.
    fn takes(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        mode: &Mode,
    ) -> bool {
        self.decision.expanded = false;
        let feasible =
            !here.ends(mode) && matches!(self.examine(dynamics, table, here, mode), Ok(true));
        if feasible {
            self.decision.ambiguous = self.forks;
            self.keep(dynamics);
        } else {
            self.decision.expanded = false;
        }
        feasible
    }

    fn pivot_from(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        mut mode: Mode,
    ) -> Result<bool, EvaluationError> {
        let facts = here.facts;
        let flags = [&facts.touching, &facts.resting, &facts.balanced];
        let open: usize = flags
            .iter()
            .map(|list| list.iter().filter(|f| **f).count())
            .sum();
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        for _ in 0..20 + 4 * open {
            self.tried += 1;
            self.decision.expanded = false;
            if here.ends(&mode) {
                self.violated.clone_from(&facts.located);
            } else if self.examine(dynamics, table, here, &mode)? {
                self.decision.ambiguous = self.forks;
                self.keep(dynamics);
                return Ok(true);
            }
            let all = self.violated.len() < fewest || patience > 0;
            if self.violated.len() < fewest {
                (fewest, patience) = (self.violated.len(), PATIENCE);
            } else {
                patience = patience.saturating_sub(1);
            }
            let mut violated = core::mem::take(&mut self.violated);
            if !all {
                let last = violated.iter().copied().max_by_key(order);
                violated.clear();
                violated.extend(last);
            }
            Choices { dynamics, here }.exchange(&violated, &mut mode);
            self.violated = violated;
        }
        Ok(false)
    }
}

/// A friction that slips the other way.
fn turned_round(mut friction: FrictionMode) -> FrictionMode {
    if let FrictionMode::Slip(Sliding {
        direction: Direction::Fixed(direction),
        ..
    }) = &mut friction
    {
        *direction = direction.map(|part| -part);
    }
    friction
}

/// A fixed order of the guards.
fn order(guard: &Guard) -> (usize, usize) {
    match *guard {
        Guard::Gap(c) | Guard::Normal(c) | Guard::Region(c) => (0, c),
        Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) | Guard::Slip(f) => {
            (1, f)
        }
        Guard::NormalForceSign(f) => (2, f),
        Guard::Branch(b) => (3, b),
        Guard::Stop(..) | Guard::Mark(..) | Guard::Composite(_) => (4, 0),
    }
}

impl<T: Scalar> Choices<'_, T> {
    /// From the present mode to the nearest that is not over: what was located is exchanged, unless it `holds`, and what touches is closed.
    fn begin(&self, mode: &mut Mode, holds: bool) {
        let facts = self.here.facts;
        for (closed, touching) in mode.contacts.iter_mut().zip(&facts.touching) {
            *closed = *touching;
        }
        for f in 0..mode.frictions.len() {
            self.set_first(mode, f);
        }
        let stays = |guard: &Guard| {
            matches!(guard, Guard::Gap(_) | Guard::Slip(_)) || holds && guard.holding().is_some()
        };
        let located: Vec<Guard> = facts
            .located
            .iter()
            .filter(|guard| !stays(guard))
            .copied()
            .collect();
        self.exchange(&located, mode);
    }

    /// The first choice of friction `f`.
    pub(super) fn set_first(&self, mode: &mut Mode, f: usize) {
        let mut first = None;
        self.of_friction(mode, f, |state| first = first.or(Some(state)));
        mode.frictions[f] = first.unwrap_or(FrictionMode::Inactive);
    }

    /// Exchanges what violated guards forbid for its complement.
    fn exchange(&self, violated: &[Guard], mode: &mut Mode) {
        for &guard in violated {
            match guard {
                Guard::StickUpper(f) => mode.frictions[f] = slide(-1.0, 1.0),
                Guard::StickLower(f) => mode.frictions[f] = slide(1.0, 1.0),
                Guard::StickCone(f) => mode.frictions[f] = self.leaves_its_cone(f),
                Guard::Slip(f) => mode.frictions[f] = FrictionMode::Stick,
                Guard::NormalForceSign(f) => {
                    // What several constraints press has a direction, and no sign.
                    if let Normal::Constraint(_) = self.description().frictions[f].normal
                        && let FrictionMode::Slip(sliding) = &mut mode.frictions[f]
                    {
                        sliding.normal_sign = -sliding.normal_sign;
                    }
                }
                Guard::Branch(b) => mode.set_branch(b, !mode.branch(b)),
                Guard::Gap(_)
                | Guard::Normal(_)
                | Guard::Stop(..)
                | Guard::Mark(..)
                | Guard::Region(_)
                | Guard::Composite(_) => {}
            }
        }
        // A contact that opens takes its friction with it, whatever that did.
        for &guard in violated {
            let (c, closed) = match guard {
                Guard::Normal(c) => (c, false),
                Guard::Gap(c) => (c, true),
                _ => continue,
            };
            mode.contacts[c] = closed;
            for f in self.description().frictions_on(c) {
                self.set_first(mode, f);
            }
        }
    }

    /// How friction `f` slips when its force, at the last value, is too large.
    fn leaves_its_cone(&self, f: usize) -> FrictionMode {
        let friction = &self.description().frictions[f];
        let sign = |row: usize| {
            let force = self.dynamics.force(row).value();
            if force < 0.0 { -1.0 } else { 1.0 }
        };
        let normal_sign = match friction.normal {
            Normal::Constraint(i) => sign(self.description().constraints[i].row),
            _ => 1.0,
        };
        if friction.components == 1 {
            return slide(-sign(friction.row), normal_sign);
        }
        FrictionMode::Slip(Sliding {
            direction: Direction::Incipient([0.0; 2]),
            normal_sign,
        })
    }
}
