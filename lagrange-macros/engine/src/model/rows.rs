//! The rows a v̇ + γ = 0 of a system by number: constraints, contacts, then slip components, each as declared.

use super::{Normal, System};
use crate::symbolic::Symbol;
use std::ops::Range;

impl System {
    /// Row of a contact.
    pub fn contact_row(&self, contact: usize) -> usize {
        self.constraints.len() + contact
    }

    /// Rows of the slip components of a friction.
    pub fn slip_rows(&self, friction: usize) -> Range<usize> {
        let before = self.frictions[..friction].iter().map(|f| f.slip.len());
        let first = self.contact_row(self.contacts.len()) + before.sum::<usize>();
        first..first + self.frictions[friction].slip.len()
    }

    /// Symbols of the multipliers, row by row.
    pub fn multipliers(&self) -> Vec<Symbol> {
        let constraints = self.constraints.iter().map(|c| c.force);
        let contacts = self.contacts.iter().map(|c| c.force);
        let slips = self.frictions.iter().flat_map(|f| &f.slip);
        let slips = slips.map(|&(_, force)| force);
        constraints.chain(contacts).chain(slips).collect()
    }

    /// The contact that must be closed for a friction to act, if there is one.
    pub fn contact_under(&self, friction: usize) -> Option<usize> {
        match self.frictions[friction].normal {
            Normal::Contact(contact) => Some(contact),
            normal => {
                (self.pressing(normal).next()).and_then(|i| self.constraints[i].while_contact)
            }
        }
    }

    /// The constraints whose forces press a friction.
    pub fn pressing(&self, normal: Normal) -> impl Iterator<Item = usize> {
        let (one, together): (_, &[usize]) = match normal {
            Normal::Constraint(constraint) => (Some(constraint), &[]),
            Normal::Resultant(resultant) => (None, &self.resultants[resultant]),
            Normal::Contact(_) | Normal::Given(_) => (None, &[]),
        };
        one.into_iter().chain(together.iter().copied())
    }
}
