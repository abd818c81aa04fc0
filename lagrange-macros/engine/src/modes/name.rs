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

    /// The mode of this name, in the words of [`Self::name`] or as stories and plots shorten them; open contacts need not be named.
    pub fn named(system: &System, name: &str) -> Option<Mode> {
        let mut clauses = clauses(system, name);
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

/// What a name says of one item after the other, `a open`, `b open`: also where it says them together, `a and b open`, or counts them,
/// `all 3 contacts open`. Sides of branches are left out, since the equations of a mode show all of them.
pub fn clauses(system: &System, name: &str) -> Vec<String> {
    let is_side = |part: &String| {
        let mut branches = system.branches.iter();
        branches.any(|branch| *part == branch.then || *part == branch.otherwise)
            || part.ends_with(" more conditions")
    };
    let mut clauses: Vec<String> = Vec::new();
    // Names before the verb that they share.
    let mut waiting: Vec<String> = Vec::new();
    for part in parts(name).into_iter().filter(|part| !is_side(part)) {
        let words: Vec<&str> = part.split(' ').collect();
        let (names, verb) = match words.as_slice() {
            ["all", count, kind @ ("contacts" | "frictions"), verb @ ..] => {
                let closed = |name: &str| clauses.contains(&format!("{name} closed"));
                let all = match *kind {
                    "contacts" => contacts(system),
                    _ => frictions(system, closed),
                };
                match *count == all.len().to_string() {
                    true => (all, verb),
                    false => (vec![part.clone()], &[][..]),
                }
            }
            [one, "and", other, verb @ ..] => (vec![(*one).to_owned(), (*other).to_owned()], verb),
            [one, verb @ ..] => (vec![(*one).to_owned()], verb),
            [] => continue,
        };
        waiting.extend(names);
        let verb = match verb {
            [] => continue,
            ["stick"] => "sticks".to_owned(),
            ["slip", way @ ..] => [&["slips"], way].concat().join(" "),
            verb => verb.join(" "),
        };
        clauses.extend(waiting.drain(..).map(|name| format!("{name} {verb}")));
    }
    clauses.extend(waiting);
    clauses
}

/// What stands between commas that are in no brackets.
fn parts(name: &str) -> Vec<String> {
    let mut depth = 0;
    let parts = name.split(|c| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0
    });
    let parts = parts.map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    parts
        .filter(|part| !part.is_empty() && part != "smooth")
        .collect()
}

/// Names of all contacts.
fn contacts(system: &System) -> Vec<String> {
    let contacts = system.contacts.iter();
    contacts.map(|contact| contact.name.text.clone()).collect()
}

/// Names of the frictions that act while these contacts are closed.
fn frictions(system: &System, closed: impl Fn(&str) -> bool) -> Vec<String> {
    let acts = |f: &usize| {
        let contact = system.contact_under(*f);
        contact.is_none_or(|contact| closed(&system.contacts[contact].name.text))
    };
    let acting = (0..system.frictions.len()).filter(acts);
    acting
        .map(|f| system.frictions[f].name.text.clone())
        .collect()
}
