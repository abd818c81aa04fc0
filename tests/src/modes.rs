//! Modes by hand.

use lagrange_core::mode::{FrictionMode, Mode, Sliding};
use lagrange_core::system::System;

/// Everything open.
pub fn flight<S: System>() -> Mode {
    Mode::open(S::DESCRIPTION)
}

/// Every contact closed, every friction sticks.
pub fn stuck<S: System>() -> Mode {
    let mut mode = flight::<S>();
    mode.contacts.fill(true);
    mode.frictions.fill(FrictionMode::Stick);
    mode
}

/// Every contact closed, every friction slips in this direction.
pub fn slipping<S: System>(sign: f64) -> Mode {
    let mut mode = stuck::<S>();
    mode.frictions.fill(FrictionMode::Slip(Sliding::sign(sign)));
    mode
}
