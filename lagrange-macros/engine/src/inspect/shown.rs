//! Which modes are shown: all, or a choice where there are many, or the one that is asked for.

use super::work::Work;
use crate::model::System;
use crate::modes::{self, Mode};
use std::fmt;

/// Of more modes only some with no contact closed, one, or all are shown.
const MOST_SHOWN: u128 = 24;

/// So many modes are shown with one contact closed: one friction sticks, and slips to either side.
const WITH_ONE_CLOSED: usize = 3;

/// No mode is called so.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownMode {
    /// As asked for.
    pub name: String,
    /// Modes that exist; not all if there are many.
    pub known: Vec<String>,
}

impl fmt::Display for UnknownMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no mode is called `{}`; there are: ", self.name)?;
        let known: Vec<String> = self.known.iter().map(|k| format!("`{k}`")).collect();
        f.write_str(&known.join(", "))
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
            known: chosen(system)
                .iter()
                .map(|mode| mode.name(system))
                .collect(),
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
    let mut chosen: Vec<Mode> = all.iter().take(1).collect();
    for one in Work::shown(contacts) {
        let closed = (0..contacts).map(|i| i == one).collect();
        chosen.extend(all.beside(closed).take(WITH_ONE_CLOSED));
    }
    if contacts > 1 {
        chosen.extend(all.beside(vec![true; contacts]).take(1));
    }
    chosen
}
