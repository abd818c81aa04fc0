//! What a run knows of every mode that it has met: the guards, and what they ask of the tapes.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, OutputMask, add_branch_guards, add_guards};
use crate::effects::Item;
use crate::modes::guard::{self, Guard};
use crate::system::ValueRef;

/// One mode as a run sees it.
#[derive(Clone, Debug)]
pub struct Watched {
    /// See [`Dynamics::mode_number`].
    number: usize,
    /// Its guards, without those of stops and marks.
    pub guards: Vec<Guard>,
    /// Needs of the motion, the guards and the report.
    pub needs: OutputMask,
    /// All needs and what the accelerations of all gaps and slips are made of, as far as it changes.
    pub deciding: OutputMask,
    /// Whether a step can leave the rows that act by more than rounding: one of them is not linear with constant coefficients.
    pub drifts: bool,
}

/// The modes met so far, by their index in the dynamics.
#[derive(Clone, Debug, Default)]
pub struct Table {
    known: Vec<Option<Watched>>,
}

impl Table {
    /// The present mode of `dynamics`.
    pub fn of<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> &Watched {
        let index = dynamics.mode_index();
        if index >= self.known.len() {
            self.known.resize(index + 1, None);
        }
        let entry = &mut self.known[index];
        // The dynamics give the place of a mode that they no longer keep to another.
        let is_other = |known: &Watched| known.number != dynamics.mode_number();
        if entry.as_ref().is_some_and(is_other) {
            *entry = None;
        }
        entry.get_or_insert_with(|| watched(dynamics))
    }
}

fn watched<T: Scalar>(dynamics: &Dynamics<T>) -> Watched {
    let d = dynamics.description();
    let (mode, effects) = (dynamics.mode(), dynamics.effects());
    let mut needs = dynamics.motion_needs().clone();
    needs.extend(dynamics.report_needs());
    add_guards(d, effects, mode, &mut needs);
    // A surface may bend where no acceleration tells: a floor that rises evenly and stops.
    let mut bends = needs.clone();
    for &row in dynamics.acting_rows() {
        bends.insert(d.rows[row].needs.position);
        bends.insert(d.rows[row].needs.velocity);
    }
    add_branch_guards(d, &mut bends);
    let bending = d.branches.iter().map(|branch| branch.need);
    bending
        .filter(|&need| bends.contains(need))
        .for_each(|need| needs.insert(need));
    let mut guards = Vec::new();
    guard::guards_of_mode(mode, dynamics, &needs, &mut guards);
    let mut deciding = needs.clone();
    let contacts = d.contacts.iter().enumerate();
    let contacts = contacts.filter(|(c, _)| effects.includes(d, Item::Contact(*c)));
    let frictions = d.frictions.iter().enumerate();
    let frictions = frictions.filter(|(f, _)| effects.includes(d, Item::Friction(*f)));
    let rows = contacts
        .map(|(_, contact)| contact.row..contact.row + 1)
        .chain(frictions.map(|(_, friction)| friction.rows()))
        .flatten();
    for row in rows.map(|row| &d.rows[row]) {
        if !row.is_constant() {
            deciding.insert(row.needs.jacobian);
        }
        if row.bias.varies() {
            deciding.insert(row.needs.bias);
        }
    }
    let acting = dynamics.acting_rows().iter().map(|&row| &d.rows[row]);
    let drifts = acting
        .into_iter()
        .any(|row| !row.is_constant() || row.bias != ValueRef::Zero);
    Watched {
        number: dynamics.mode_number(),
        guards,
        needs,
        deciding,
        drifts,
    }
}
