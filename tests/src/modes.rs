//! Modes by hand.

use lagrange_core::__private::places::Normal;
use lagrange_core::mode::{FrictionMode, Mode, Sliding};
use lagrange_core::system::{Derived, Description};

/// Everything open.
pub fn flight<S: Derived>() -> Mode {
    Mode::open(S::DESCRIPTION)
}

/// Every contact closed, every friction sticks.
pub fn stuck<S: Derived>() -> Mode {
    let mut mode = flight::<S>();
    mode.contacts.fill(true);
    mode.frictions.fill(FrictionMode::Stick);
    mode
}

/// Every contact closed, every friction slips in this direction.
pub fn slipping<S: Derived>(sign: f64) -> Mode {
    let mut mode = stuck::<S>();
    mode.frictions.fill(FrictionMode::Slip(Sliding::sign(sign)));
    mode
}

/// All modes: contacts open or closed, frictions that can act sticking or slipping either way, or along their slip.
pub fn all(description: &Description) -> Vec<Mode> {
    let mut modes = vec![Mode::open(description)];
    for contact in 0..description.contacts.len() {
        let closed = modes.clone().into_iter().map(|mut mode| {
            mode.contacts[contact] = true;
            mode
        });
        modes.extend(closed.collect::<Vec<_>>());
    }
    for (i, friction) in description.frictions.iter().enumerate() {
        let slips = match friction.components {
            1 => vec![Sliding::sign(1.0), Sliding::sign(-1.0)],
            _ => vec![Sliding::along_slip()],
        };
        let states = core::iter::once(FrictionMode::Stick);
        let states: Vec<_> = states
            .chain(slips.into_iter().map(FrictionMode::Slip))
            .collect();
        let with_states = |mode: Mode| -> Vec<Mode> {
            let acts = match friction.normal {
                Normal::Contact(contact) => mode.contacts[contact],
                _ => true,
            };
            if !acts {
                return vec![mode];
            }
            let with = |state: &FrictionMode| {
                let mut mode = mode.clone();
                mode.frictions[i] = *state;
                mode
            };
            states.iter().map(with).collect()
        };
        modes = modes.into_iter().flat_map(with_states).collect();
    }
    modes
}
