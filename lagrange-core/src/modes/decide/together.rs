//! Where no mode goes on: what vanishes with the guards that were located, as far as the state is known, counts as zero with them.
//!
//! What is mirrored happens at once. Errors of a step and the projection after it set its instants apart, by as much as the tolerance allows,
//! and in a mode between them rigid friction may have no answer, or none that rounding lets see.

use super::{Decider, SwitchContext, SwitchFacts};
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::table::Table;

/// Slips of two components that come to rest with another one are still so many tolerances large when that one has come as near as its direction can be told.
const TURNING: f64 = 1e3;

impl<T: Scalar> Decider<T> {
    /// The facts with all forces and slips of the present mode that are no larger than their errors; `None` if there are no more of them.
    pub(super) fn together(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Option<SwitchFacts> {
        let SwitchContext { moment, facts, .. } = here;
        if facts.located.is_empty() {
            return None;
        }
        let mut joined = facts.clone();
        dynamics.set_mode(here.present);
        let watched = table.of(dynamics);
        let needs = guard::all_row_needs(dynamics.description(), &watched.deciding);
        dynamics.set_extra_needs(&needs);
        dynamics.value(moment.t, moment.q, moment.v).ok()?;
        dynamics.complete_outputs();
        self.sizes.take(dynamics);
        let reading = Reading::Values(dynamics);
        for &guard in &watched.guards {
            let (value, error) = match guard {
                Guard::Slip(f) => {
                    let error = moment.tolerance * dynamics.slip_size(f, moment.v);
                    if dynamics.description().frictions[f].components > 1 {
                        let [along, across] = dynamics.slip(f).map(|s| s.value());
                        (along.hypot(across), TURNING * error)
                    } else {
                        (guard::value(guard, here.present, &reading), error)
                    }
                }
                force if force.is_single_force() => {
                    let error = here.blur() * self.sizes.of(force, dynamics);
                    (guard::value(force, here.present, &reading), error)
                }
                _ => continue,
            };
            let vanishes = value.abs() <= error;
            if vanishes && !facts.located.contains(&guard) {
                joined.located.push(guard);
                if let Guard::Slip(f) = guard {
                    joined.resting[f] = true;
                }
            }
        }
        (joined.located.len() > facts.located.len()).then_some(joined)
    }
}
