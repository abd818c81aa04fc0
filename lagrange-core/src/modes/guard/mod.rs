//! Guards: what must stay ≥ 0 for a mode to go on.
//!
//! | state | guard |
//! |---|---|
//! | contact open | gap g ≥ 0 |
//! | contact closed | normal multiplier λ ≥ 0 |
//! | contact limited to a region | region ≥ 0 while closed; where its gap closes while open |
//! | friction sticks | μs N − F ≥ 0 and μs N + F ≥ 0 |
//! | friction slips in direction d | d·s ≥ 0 (two components: d as at the start of the step; arrest where \|s\| vanishes with it) |
//! | branch of a piecewise function | ± its guard ≥ 0 |
//!
//! N = λ·|∂g/∂p|. A guard is read from a [`Reading`] as Taylor coefficients; a plain value is a series of length one.

mod coefficients;
mod linear;
mod products;

pub use coefficients::scale;
pub use linear::{Linear, Sums};
pub use products::{ConePlane, cone_side, cone_unit};

use crate::arithmetic::Scalar;
use crate::arithmetic::quad::Memory;
use crate::dynamics::{Dynamics, OutputMask};
use crate::effects::Item;
use crate::mode::{FrictionMode, Mode};
use crate::modes::reading::Reading;
use crate::system::{Description, Friction, Normal};
use products::of_products;

/// Longest series of a guard.
pub const LENGTH: usize = 48;

/// One guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// Gap of an open contact.
    Gap(usize),
    /// Multiplier of a closed contact.
    Normal(usize),
    /// Region of a contact that is limited to one.
    Region(usize),
    /// μs N − F of a sticking friction.
    StickUpper(usize),
    /// μs N + F of a sticking friction.
    StickLower(usize),
    /// (μs N)² − |F|² of a sticking friction whose N has no known sign, or that has two components, in units of [`cone_unit`].
    StickCone(usize),
    /// Slip of a sliding friction, along its direction (of two components, that at the start of the step).
    Slip(usize),
    /// Multiplier of the constraint that carries a friction, times its held sign; of several their part along the force at the start of the step.
    NormalForceSign(usize),
    /// Guard of a branch, times its held side.
    Branch(usize),
    /// Term of a stop: becomes true when it rises through zero.
    Stop(usize, usize),
    /// Term of a mark.
    Mark(usize, usize),
    /// A sum of guards of undetermined forces: index into a list of [`CompositeGuard`](crate::modes::composite::CompositeGuard)s.
    Composite(usize),
}

impl Guard {
    /// Whether it is made of forces.
    pub fn is_force(self) -> bool {
        matches!(
            self,
            Guard::Normal(_)
                | Guard::StickUpper(_)
                | Guard::StickLower(_)
                | Guard::StickCone(_)
                | Guard::NormalForceSign(_)
                | Guard::Composite(_)
        )
    }

    /// Whether it is made of the forces of one item, which the mode determines.
    pub fn is_single_force(self) -> bool {
        self.is_force() && !matches!(self, Guard::Composite(_))
    }

    /// Whether it is a condition of accelerations or forces, on which outputs depend and no motion.
    pub fn is_of_outputs(self, d: &Description) -> bool {
        matches!(self, Guard::Branch(b) if d.branches[b].after_solve)
    }

    /// The friction that it says how much holds.
    pub fn holding(self) -> Option<usize> {
        match self {
            Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) => Some(f),
            _ => None,
        }
    }

    /// The name of the item whose guard it is; a composite guard has several.
    pub fn name(self, d: &'static Description) -> Option<&'static str> {
        match self {
            Guard::Gap(c) | Guard::Normal(c) | Guard::Region(c) => Some(d.contacts[c].name),
            Guard::StickUpper(f)
            | Guard::StickLower(f)
            | Guard::StickCone(f)
            | Guard::Slip(f)
            | Guard::NormalForceSign(f) => Some(d.frictions[f].name),
            Guard::Branch(b) => Some(d.branches[b].then),
            Guard::Stop(i, _) => Some(d.stops[i].name),
            Guard::Mark(i, _) => Some(d.marks[i].name),
            Guard::Composite(_) => None,
        }
    }
}

/// Lists the guards of a mode (not those of stops and marks) into `out`; `needs` are held.
pub fn guards_of_mode<T: Scalar>(
    mode: &Mode,
    dynamics: &Dynamics<T>,
    needs: &OutputMask,
    out: &mut Vec<Guard>,
) {
    let d = dynamics.description();
    out.clear();
    for c in 0..d.contacts.len() {
        if dynamics.effects().includes(d, Item::Contact(c)) {
            out.push(if mode.contacts[c] {
                Guard::Normal(c)
            } else {
                Guard::Gap(c)
            });
            if d.contacts[c].region.is_some() {
                out.push(Guard::Region(c));
            }
        }
    }
    for (f, friction) in d.frictions.iter().enumerate() {
        match mode.frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => out.extend(stick_guards(f, friction)),
            FrictionMode::Slip(_) => {
                out.push(Guard::Slip(f));
                if pressed_by_constraints(friction) {
                    out.push(Guard::NormalForceSign(f));
                }
            }
        }
    }
    for (b, branch) in d.branches.iter().enumerate() {
        if needs.contains(branch.need) {
            out.push(Guard::Branch(b));
        }
    }
}

/// Whether friction `f` cannot hold: its static coefficient is 0.
pub fn fades<T: Scalar>(f: usize, dynamics: &Dynamics<T>) -> bool {
    let place = dynamics.description().frictions[f].static_coefficient;
    !place.varies() && dynamics.motion(place).value() == 0.0
}

/// Whether constraints press a friction, whose N has no known sign.
pub fn pressed_by_constraints(friction: &Friction) -> bool {
    matches!(
        friction.normal,
        Normal::Constraint(_) | Normal::Resultant(_)
    )
}

/// The guards of friction `f` while it sticks.
pub fn stick_guards(f: usize, friction: &Friction) -> impl Iterator<Item = Guard> {
    let cone = friction.components > 1 || pressed_by_constraints(friction);
    let pair = [Guard::StickUpper(f), Guard::StickLower(f)];
    cone.then_some(Guard::StickCone(f))
        .into_iter()
        .chain(pair.into_iter().filter(move |_| !cone))
}

/// Coefficients of a guard in powers of the time since the start of the reading, at most [`LENGTH`], each times its factor in
/// `powers`; what a reading does not have is 0.
pub fn series<T: Scalar>(
    guard: Guard,
    mode: &Mode,
    reading: &Reading<'_, T>,
    powers: &[f64],
    out: &mut [f64],
) {
    match Linear::of(guard, mode, reading.dynamics()) {
        Some(linear) => _ = linear.series(Memory, reading, powers, out),
        None => {
            out.fill(0.0);
            of_products(guard, mode, reading, out);
            scale(out, powers);
        }
    }
}

/// The guard itself, at the start of the reading.
pub fn value<T: Scalar>(guard: Guard, mode: &Mode, reading: &Reading<'_, T>) -> f64 {
    match Linear::of(guard, mode, reading.dynamics()) {
        Some(linear) => linear.value(reading),
        None => {
            let mut value = [0.0];
            of_products(guard, mode, reading, &mut value);
            value[0]
        }
    }
}

/// `needs` and everything about every row: Jacobian, residuals, coefficients, restitution, branch guards.
pub fn all_row_needs(d: &Description, needs: &OutputMask) -> OutputMask {
    let mut all = needs.clone();
    for row in d.rows {
        for need in [row.needs.jacobian, row.needs.position, row.needs.velocity] {
            all.insert(need);
        }
    }
    d.contacts
        .iter()
        .for_each(|c| all.insert(c.restitution_need));
    d.frictions
        .iter()
        .for_each(|f| all.insert(f.coefficients_need));
    d.branches
        .iter()
        .filter(|b| !b.after_solve)
        .for_each(|b| all.insert(b.need));
    all
}
