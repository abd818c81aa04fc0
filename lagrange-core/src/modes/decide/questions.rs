//! The questions that a candidate must answer, and what is known of the answers beforehand.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, OutputMask};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::composite::{self, CompositeGuard};
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::system::{Description, Normal};

/// A guard that may be rounding.
#[derive(Clone, Debug)]
pub(super) struct Doubt {
    pub(super) guard: Guard,
    /// How many of its coefficients are known to vanish.
    pub(super) order_known: usize,
    /// The first that is not, times its factorial,
    pub(super) value: f64,
    /// and what it would be if the state changed by its own size.
    pub(super) size: f64,
}

/// The first coefficient of a guard that is not known to vanish, times its factorial, as far as values tell.
pub(super) fn leading<T: Scalar>(
    guard: Guard,
    order_known: usize,
    composites: &[CompositeGuard],
    mode: &Mode,
    dynamics: &Dynamics<T>,
) -> Option<f64> {
    let d = dynamics.description();
    let acceleration = |row: usize| row_acceleration(row, dynamics);
    match (guard, order_known) {
        (_, 0) => Some(composite::value(
            guard,
            composites,
            mode,
            &Reading::Values(dynamics),
        )),
        (Guard::Gap(c), 2) => Some(acceleration(d.contacts[c].row)),
        (Guard::Slip(f), 1) => match mode.frictions[f] {
            FrictionMode::Slip(Sliding {
                direction: Direction::Fixed([sign, 0.0]),
                ..
            }) => Some(sign * acceleration(d.frictions[f].row)),
            FrictionMode::Slip(Sliding {
                direction: Direction::Incipient([x, y]),
                ..
            }) => {
                let row = d.frictions[f].row;
                Some(x * acceleration(row) + y * acceleration(row + 1))
            }
            _ => None,
        },
        _ => None,
    }
}

/// a v̇ + γ of a row at the last value.
pub(super) fn row_acceleration<T: Scalar>(row: usize, dynamics: &Dynamics<T>) -> f64 {
    let row = &dynamics.description().rows[row];
    let products = row.jacobian.iter().map(|&(j, place)| {
        let a = dynamics.motion(place) * dynamics.acceleration()[j];
        a.value()
    });
    dynamics.motion(row.bias).value() + products.sum::<f64>()
}

/// The guards that can be violated just after the instant, with the number of coefficients known to vanish; `held` are
/// the needs that are evaluated.
pub(super) fn list_questions(
    d: &Description,
    mode: &Mode,
    facts: &SwitchFacts,
    held: &OutputMask,
    list: &mut Vec<(Guard, usize)>,
) {
    list.clear();
    for c in 0..d.contacts.len() {
        if mode.contacts[c] {
            list.push((Guard::Normal(c), 0));
        } else if facts.touching[c] {
            list.push((Guard::Gap(c), 2));
        } else if facts.parting[c] {
            list.push((Guard::Gap(c), 1));
        }
    }
    for f in 0..d.frictions.len() {
        match mode.frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => {
                list.extend(guard::stick_guards(f, &d.frictions[f]).map(|g| (g, 0)));
            }
            FrictionMode::Slip(_) => {
                if facts.resting[f] {
                    list.push((Guard::Slip(f), 1));
                }
                if let Normal::Constraint(_) = d.frictions[f].normal {
                    list.push((Guard::NormalForceSign(f), 0));
                }
            }
        }
    }
    for b in 0..d.branches.len() {
        // What nothing in this mode uses decides nothing.
        if facts.balanced[b] && held.contains(d.branches[b].need) {
            list.push((Guard::Branch(b), if facts.lying[b] { 2 } else { 1 }));
        }
    }
}

/// Whether a guard's leading coefficients carry the error of a located root: it is that root, or belongs to the
/// same contact (in the mode after, gap and slip accelerations vanish with the force that was located).
pub(super) fn concerns(guard: Guard, composites: &[CompositeGuard], facts: &SwitchFacts) -> bool {
    if let Guard::Composite(index) = guard {
        let mut parts = composites[index].parts.iter();
        return parts.any(|part| concerns(part.guard, &[], facts));
    }
    let mut roots = facts.located.iter().chain(&facts.touched);
    roots.any(|root| {
        *root == guard
            || match (*root, guard) {
                (Guard::Normal(c), Guard::Gap(g)) | (Guard::Gap(c), Guard::Normal(g)) => c == g,
                (Guard::Normal(_), Guard::Branch(b)) => facts.lying[b],
                (
                    Guard::StickUpper(_) | Guard::StickLower(_) | Guard::StickCone(_),
                    Guard::Branch(b),
                ) => facts.held[b],
                (
                    Guard::StickUpper(f)
                    | Guard::StickLower(f)
                    | Guard::StickCone(f)
                    | Guard::Slip(f)
                    | Guard::NormalForceSign(f),
                    Guard::Slip(g)
                    | Guard::StickUpper(g)
                    | Guard::StickLower(g)
                    | Guard::StickCone(g)
                    | Guard::NormalForceSign(g),
                ) => f == g,
                _ => false,
            }
    })
}

/// Powers of h that turn an acceleration or force scale into the unit of the guard.
pub(super) fn unit_of_order(guard: Guard, h: f64) -> f64 {
    match guard {
        Guard::Gap(_) => h * h,
        Guard::Slip(_) => h,
        _ => 1.0,
    }
}

/// Books what forbids a mode: of a composite guard, its parts.
pub(super) fn blame(guard: Guard, composites: &[CompositeGuard], violated: &mut Vec<Guard>) {
    match guard {
        Guard::Composite(index) => violated.extend(composites[index].parts.iter().map(|p| p.guard)),
        single => violated.push(single),
    }
}
