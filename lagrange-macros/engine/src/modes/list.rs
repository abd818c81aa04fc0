//! Which modes there are: every combination of what the contacts and frictions may be.
//!
//! The order is stable: no contact closed comes first, then one, and so on; sets of as many contacts, and the states of
//! the frictions beside them, in lexicographic order.

use super::Direction::{AlongSlip, Fixed, Incipient};
use super::FrictionState::{self, Inactive, Slip, Stick};
use super::{Mode, Sign};
use crate::model::{Condition, System};
use std::iter::successors;

/// Modes of a system. They are listed lazily: there may be astronomically many.
pub struct Modes<'a> {
    system: &'a System,
    /// Whether each contact may be open, and closed.
    contacts: Vec<Vec<bool>>,
    /// What each friction may be while it can act.
    frictions: Vec<Vec<FrictionState>>,
}

/// All modes: every friction that can act sticks, or slips to either side.
pub fn all(system: &System) -> Modes<'_> {
    let one = [Stick, FrictionState::FORWARD, FrictionState::BACKWARD];
    Modes::of(system, &one, &[Stick, Slip(AlongSlip)])
}

/// The modes with equations of their own: the sign of a slip of one component is left to an argument, and a friction that
/// could act may be left out. At most so many, and whether these are all; if so, also as many with one constraint left out.
pub fn structures(system: &System, most: usize) -> (Vec<Mode>, bool) {
    let one = [Stick, Slip(Fixed(Sign::Undecided)), Inactive];
    let two = [Stick, Slip(AlongSlip), Slip(Incipient), Inactive];
    let modes = Modes::of(system, &one, &two);
    let complete = modes.count() <= most as u128;
    let mut list: Vec<Mode> = modes.iter().take(most).collect();
    if complete {
        let without = |i| list.iter().filter_map(move |mode| mode.without(system, i));
        let constraints = 0..system.constraints.len();
        let fewer: Vec<Mode> = constraints.flat_map(without).take(most).collect();
        list.extend(fewer);
    }
    (list, complete)
}

impl<'a> Modes<'a> {
    /// All combinations, where frictions of one component and of two may be these.
    fn of(system: &'a System, one: &[FrictionState], two: &[FrictionState]) -> Self {
        let frictions = system.frictions.iter();
        Modes {
            system,
            contacts: vec![vec![false, true]; system.contacts.len()],
            frictions: frictions
                .map(|f| if f.slip.len() == 1 { one } else { two }.to_vec())
                .collect(),
        }
    }

    /// Those in which these conditions hold; that a friction sticks or slips says that its contact is closed.
    #[must_use]
    pub fn under(mut self, conditions: &[Condition]) -> Self {
        for &condition in conditions {
            let closed = match condition {
                Condition::Closed(contact) => Some(contact),
                Condition::Open(contact) => {
                    self.contacts[contact].retain(|closed| !closed);
                    None
                }
                Condition::Sticks(f) | Condition::Slips(f) => {
                    let sticks = condition == Condition::Sticks(f);
                    self.frictions[f].retain(|&state| (state == Stick) == sticks);
                    self.system.contact_under(f)
                }
            };
            if let Some(contact) = closed {
                self.contacts[contact].retain(|&closed| closed);
            }
        }
        self
    }

    /// What a friction may be beside these contacts.
    pub fn states(&self, friction: usize, contacts: &[bool]) -> &[FrictionState] {
        match self.system.contact_under(friction) {
            Some(contact) if !contacts[contact] => &[Inactive],
            _ => &self.frictions[friction],
        }
    }

    /// How many modes there are.
    pub fn count(&self) -> u128 {
        let states_on = |contact: Option<usize>| {
            let frictions = 0..self.frictions.len();
            let own = frictions.filter(|&f| self.system.contact_under(f) == contact);
            product(own.map(|f| self.frictions[f].len()))
        };
        let contacts = self.contacts.iter().enumerate();
        contacts.fold(states_on(None), |count, (i, may_be)| {
            let states = may_be.iter().map(|&closed| match closed {
                true => states_on(Some(i)),
                false => 1,
            });
            count.saturating_mul(states.fold(0, u128::saturating_add))
        })
    }

    /// The modes, in order.
    pub fn iter(&self) -> impl Iterator<Item = Mode> {
        let is_possible = self.contacts.iter().all(|may_be| !may_be.is_empty());
        let decided = self.contacts.iter().map(|may_be| *may_be == [true]);
        let decided: Vec<bool> = decided.collect();
        let mut undecided: Vec<usize> = (0..decided.len()).collect();
        undecided.retain(|&i| self.contacts[i].len() == 2);
        let sets = is_possible.then(|| subsets(undecided.len()));
        sets.into_iter().flatten().flat_map(move |closed| {
            let mut contacts = decided.clone();
            closed.iter().for_each(|&i| contacts[undecided[i]] = true);
            self.beside(contacts)
        })
    }

    /// The modes with these contacts closed, in order.
    pub fn beside(&self, contacts: Vec<bool>) -> impl Iterator<Item = Mode> {
        let frictions = 0..self.frictions.len();
        let states: Vec<_> = frictions.map(|f| self.states(f, &contacts)).collect();
        let open = Mode::open(self.system);
        (0..product(states.iter().map(|states| states.len()))).map(move |mut number| {
            let mut mode = Mode {
                contacts: contacts.clone(),
                ..open.clone()
            };
            // The number in mixed radix, the last friction as its last digit.
            for (state, states) in mode.frictions.iter_mut().zip(&states).rev() {
                let radix = states.len() as u128;
                *state = states[(number % radix) as usize];
                number /= radix;
            }
            mode
        })
    }
}

fn product(counts: impl Iterator<Item = usize>) -> u128 {
    counts.fold(1, |product, n| product.saturating_mul(n as u128))
}

/// Subsets of 0..n, ascending in size, then in lexicographic order.
fn subsets(n: usize) -> impl Iterator<Item = Vec<usize>> {
    successors(Some(Vec::new()), move |set: &Vec<usize>| {
        let size = set.len();
        // The last element that can grow does; those behind it follow on its heels.
        match (0..size).rfind(|&i| set[i] + size < n + i) {
            Some(i) => {
                let rest = (set[i] + 1..).take(size - i);
                Some(set[..i].iter().copied().chain(rest).collect())
            }
            None => (size < n).then(|| (0..=size).collect()),
        }
    })
}
