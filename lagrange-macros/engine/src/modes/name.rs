//! Modes in words, as a run says them: `rim closed, grip sticks`.

use super::Direction::{AlongSlip, Fixed, Incipient};
use super::FrictionState::{self, Inactive, Slip, Stick};
use super::{Mode, Sign, all};
use crate::model::System;

impl FrictionState {
    /// What the friction does; nothing if it is inactive.
    pub fn verb(self) -> &'static str {
        match self {
            Inactive => "",
            Stick => "sticks",
            Slip(Fixed(Sign::Positive)) => "slips forward",
            Slip(Fixed(Sign::Negative)) => "slips backward",
            Slip(Fixed(Sign::Undecided) | AlongSlip) => "slips",
            Slip(Incipient) => "begins to slip",
        }
    }
}

impl Mode {
    /// The mode in words.
    pub fn name(&self, system: &System) -> String {
        let contacts = system.contacts.iter().zip(&self.contacts);
        let contacts = contacts.map(|(contact, closed)| {
            let verb = if *closed { "closed" } else { "open" };
            format!("{} {verb}", contact.name.text)
        });
        let frictions = system.frictions.iter().zip(&self.frictions);
        let frictions = frictions
            .filter(|(_, state)| **state != Inactive)
            .map(|(friction, state)| format!("{} {}", friction.name.text, state.verb()));
        let without = self.left_out.map(|i| {
            let constraint = &system.constraints[i];
            format!("without {}", constraint.name.text)
        });
        let words: Vec<String> = contacts.chain(frictions).chain(without).collect();
        match words.is_empty() {
            true => "smooth".to_owned(),
            false => words.join(", "),
        }
    }

    /// The mode of this name; open contacts need not be named.
    pub fn named(system: &System, name: &str) -> Option<Mode> {
        let clauses = name
            .split(',')
            .map(|clause| clause.split_whitespace().collect::<Vec<_>>().join(" "));
        let mut clauses: Vec<String> = clauses
            .filter(|clause| !clause.is_empty() && clause != "smooth")
            .collect();
        let mut says = |item: &str, verb: &str| {
            let clause = format!("{item} {verb}");
            let at = clauses.iter().position(|said| *said == clause);
            at.map(|at| clauses.swap_remove(at)).is_some()
        };
        let mut mode = Mode::open(system);
        for (contact, closed) in system.contacts.iter().zip(&mut mode.contacts) {
            *closed = says(&contact.name.text, "closed");
            if says(&contact.name.text, "open") && *closed {
                return None;
            }
        }
        let modes = all(system);
        for (f, friction) in system.frictions.iter().enumerate() {
            let states = modes.states(f, &mode.contacts).iter();
            let mut said =
                states.filter(|s| **s == Inactive || says(&friction.name.text, s.verb()));
            mode.frictions[f] = *said.next()?;
            if said.next().is_some() {
                return None;
            }
        }
        clauses.is_empty().then_some(mode)
    }
}
