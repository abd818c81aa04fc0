//! Parts of a system whose modes do not depend on one another: bodies that have nothing in common but the floor. What several of them may do
//! together is a product of what each may do alone, and nobody need look at all of it.

use crate::effects::{Effects, Item};
use crate::mode::{FrictionMode, Mode};
use crate::modes::disjoint;
use crate::modes::facts::{SwitchContext, SwitchFacts};
use crate::modes::guard::Guard;
use crate::system::Description;

/// Which part every contact and friction belongs to: the accelerations of a part depend on the mode of no other one.
#[derive(Clone, Debug)]
pub struct Parts {
    /// Per contact.
    pub contacts: Vec<usize>,
    /// Per friction.
    pub frictions: Vec<usize>,
    /// How many there are.
    pub count: usize,
}

impl Parts {
    /// The parts of a system at an instant: inertia, rows that may act and what they press hold coordinates together.
    pub fn of(d: &Description, effects: &Effects, facts: &SwitchFacts) -> Self {
        let mut sets = Vec::new();
        disjoint::separate(&mut sets, d.coordinates.len() + d.rows.len());
        let mut join = |a: usize, b: usize| disjoint::join(&mut sets, a, b);
        let row = |index: usize| d.coordinates.len() + index;
        for &(i, j, _) in d.mass {
            join(i, j);
        }
        let contacts = d
            .contacts
            .iter()
            .enumerate()
            .filter(|&(c, _)| facts.touching[c] || facts.arriving[c] || facts.parting[c]);
        let constraints = d.constraints.iter().enumerate();
        let constraints = constraints.filter(|&(i, _)| effects.includes(d, Item::Constraint(i)));
        let frictions = d.frictions.iter().enumerate();
        let frictions = frictions.filter(|&(f, _)| facts.may_act(f, d, effects));
        let acting = contacts.map(|(_, contact)| contact.row);
        let acting = acting.chain(constraints.map(|(_, constraint)| constraint.row));
        for index in acting.chain(frictions.clone().flat_map(|(_, friction)| friction.rows())) {
            for &(j, _) in d.rows[index].jacobian {
                join(row(index), j);
            }
            for coupling in d.couplings.iter().filter(|coupling| coupling.row == index) {
                join(row(index), coupling.coordinate);
            }
        }
        for (_, friction) in frictions {
            for tied in friction.rows().chain(friction.normal.rows(d)) {
                join(row(friction.row), row(tied));
            }
        }
        let mut names: Vec<usize> = Vec::new();
        let mut part = |index: usize| {
            let root = disjoint::first(&sets, row(index));
            names
                .iter()
                .position(|&name| name == root)
                .unwrap_or_else(|| {
                    names.push(root);
                    names.len() - 1
                })
        };
        let contacts = d.contacts.iter().map(|contact| part(contact.row)).collect();
        let frictions = d
            .frictions
            .iter()
            .map(|friction| part(friction.row))
            .collect();
        let count = names.len();
        Self {
            contacts,
            frictions,
            count,
        }
    }

    /// Whether a guard is one of a part.
    pub fn has(&self, part: usize, guard: Guard) -> bool {
        match guard {
            Guard::Gap(c) | Guard::Normal(c) | Guard::Region(c) => self.contacts[c] == part,
            Guard::StickUpper(f)
            | Guard::StickLower(f)
            | Guard::StickCone(f)
            | Guard::Slip(f)
            | Guard::NormalForceSign(f) => self.frictions[f] == part,
            Guard::Branch(_) | Guard::Stop(..) | Guard::Mark(..) | Guard::Composite(_) => false,
        }
    }

    /// Whether something has happened to a part of which its present mode does not know, or nothing has been decided yet.
    pub fn is_concerned(
        &self,
        part: usize,
        here: SwitchContext<'_, impl Copy>,
        d: &Description,
    ) -> bool {
        let SwitchContext { present, facts, .. } = here;
        let mut roots = facts.located.iter().chain(&facts.touched);
        let mut contacts = (0..self.contacts.len()).filter(|&c| self.contacts[c] == part);
        let mut frictions = (0..self.frictions.len()).filter(|&f| self.frictions[f] == part);
        facts.begins()
            || roots.any(|&guard| self.has(part, guard))
            || contacts.any(|c| {
                facts.touching[c] != present.contacts[c] || facts.arriving[c] || facts.parting[c]
            })
            || frictions.any(|f| {
                let idle = present.frictions[f] == FrictionMode::Inactive;
                let acts = d.frictions[f].normal.presses(d, |c| facts.touching[c]);
                idle && acts || !idle && facts.resting[f] != present.frictions[f].rests()
            })
    }

    /// Takes everything of a part out of a mode.
    pub fn release(&self, part: usize, mode: &mut Mode) {
        let contacts = mode.contacts.iter_mut().zip(&self.contacts);
        contacts
            .filter(|(_, of)| **of == part)
            .for_each(|(closed, _)| *closed = false);
        let frictions = mode.frictions.iter_mut().zip(&self.frictions);
        frictions
            .filter(|(_, of)| **of == part)
            .for_each(|(state, _)| *state = FrictionMode::Inactive);
    }
}
