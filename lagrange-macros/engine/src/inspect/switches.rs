//! Which mode can follow which: one item changes at a time.

use super::Switch;
use crate::model::System;
use crate::modes::{FrictionState, Mode};

/// Switches between modes that are shown, in their order.
pub(super) fn switches(system: &System, shown: &[Mode]) -> Vec<Switch> {
    let mut switches = Vec::new();
    for (from, before) in shown.iter().enumerate() {
        for (to, after) in shown.iter().enumerate() {
            if let Some(label) = label(system, before, after) {
                switches.push(Switch { from, to, label });
            }
        }
    }
    switches
}

/// What leads from one mode to another, if one event can.
fn label(system: &System, before: &Mode, after: &Mode) -> Option<String> {
    let contacts = 0..system.contacts.len();
    let changed: Vec<usize> = contacts
        .filter(|&i| before.contacts[i] != after.contacts[i])
        .collect();
    let frictions = 0..system.frictions.len();
    let other: Vec<usize> = frictions
        .filter(|&i| before.frictions[i] != after.frictions[i])
        .collect();
    match (changed.as_slice(), other.as_slice()) {
        (&[contact], _) => {
            // Frictions of other contacts go on as they were.
            let mut frictions = other.iter();
            let own = frictions.all(|&f| system.contact_under(f) == Some(contact));
            let name = &system.contacts[contact].name.text;
            own.then(|| match after.contacts[contact] {
                true => format!("impact at {name}"),
                false => format!("{name} lost"),
            })
        }
        (&[], &[friction]) => {
            let name = &system.frictions[friction].name.text;
            let (was, is) = (before.frictions[friction], after.frictions[friction]);
            Some(match (was, is) {
                (_, FrictionState::Stick) => format!("{name} sticks"),
                (FrictionState::Stick, _) => format!("{name} slips"),
                _ => format!("{name} reverses"),
            })
        }
        _ => None,
    }
}
