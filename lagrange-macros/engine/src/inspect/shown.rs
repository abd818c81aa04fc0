//! Which modes are shown: all, or a choice where there are many, or the one that is asked for.

use super::excerpt::excerpt;
use crate::model::System;
use crate::modes::{self, Mode, Modes};
use std::fmt;

/// Of more modes only some with no contact closed, one, or all are shown.
const MOST_SHOWN: u128 = 24;

/// Of more modes a refusal names the first.
const MOST_NAMED: usize = 8;

/// No mode is called so.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownMode {
    /// As asked for.
    pub name: String,
    /// What it says, one item after the other.
    pub said: Vec<String>,
    /// Modes that exist; not all if there are many.
    pub known: Vec<String>,
    /// How many there are.
    pub count: u128,
}

impl fmt::Display for UnknownMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no mode is called `{}`; there are", self.name)?;
        let named = &self.known[..self.known.len().min(MOST_NAMED)];
        if (named.len() as u128) < self.count {
            write!(f, " {}, among them", self.count)?;
        }
        let named: Vec<String> = named.iter().map(|k| format!("`{k}`")).collect();
        write!(f, ": {}", named.join(", "))
    }
}

impl std::error::Error for UnknownMode {}

/// The modes to show, and how many there are.
pub(super) fn shown(
    system: &System,
    asked: Option<&str>,
) -> Result<(Vec<Mode>, u128), UnknownMode> {
    let count = modes::all(system).count();
    let Some(name) = asked else {
        return Ok((chosen(system), count));
    };
    match Mode::named(system, name) {
        Some(mode) => Ok((vec![mode], count)),
        None => Err(UnknownMode {
            name: name.to_owned(),
            said: modes::clauses(system, name),
            known: chosen(system)
                .iter()
                .map(|mode| mode.name(system))
                .collect(),
            count,
        }),
    }
}

/// All modes or, where they are many, some.
fn chosen(system: &System) -> Vec<Mode> {
    let all = modes::all(system);
    if all.count() <= MOST_SHOWN {
        return all.iter().collect();
    }
    let contacts = system.contacts.len();
    let mut chosen = at_most_one_slips(&all, vec![false; contacts]);
    for one in excerpt(contacts) {
        let closed = (0..contacts).map(|i| i == one).collect();
        chosen.extend(at_most_one_slips(&all, closed));
    }
    if contacts > 1 {
        chosen.extend(all.beside(vec![true; contacts]).take(1));
    }
    chosen
}

/// The mode with these contacts closed in which every friction sticks, and those in which one of them slips.
fn at_most_one_slips(all: &Modes, contacts: Vec<bool>) -> Vec<Mode> {
    let mut modes: Vec<Mode> = all.beside(contacts.clone()).take(1).collect();
    let Some(stick) = modes.first().cloned() else {
        return modes;
    };
    for friction in excerpt(stick.frictions.len()) {
        let slips = all.states(friction, &contacts).iter().skip(1);
        modes.extend(slips.map(|&state| {
            let mut mode = stick.clone();
            mode.frictions[friction] = state;
            mode
        }));
    }
    modes
}
