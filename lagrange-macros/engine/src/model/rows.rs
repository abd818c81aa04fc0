//! The rows a v̇ + γ = 0 of a system by number: constraints, contacts, then slip components, each as declared.

use super::{Normal, System};
use crate::sorted::SortedSet;
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

    /// Rows whose forces stops, marks and branches read, and of frictions among them those that press.
    pub fn watched_rows(&self) -> Vec<usize> {
        let terms = self.stops.iter().chain(&self.marks).flat_map(|w| &w.terms);
        let guards = self.branches.iter().map(|branch| &branch.guard);
        let symbols = terms.chain(guards).flat_map(|&e| self.pool.symbols(e));
        let read: SortedSet<Symbol> = symbols.collect();
        let mut rows: SortedSet<usize> = SortedSet::new();
        for (row, force) in self.multipliers().into_iter().enumerate() {
            if read.contains(&force) {
                rows.insert(row);
            }
        }
        for (f, friction) in self.frictions.iter().enumerate() {
            if self.slip_rows(f).any(|row| rows.contains(&row)) {
                rows.extend(self.pressing(friction.normal));
                if let Normal::Contact(contact) = friction.normal {
                    rows.insert(self.contact_row(contact));
                }
            }
        }
        rows.into_iter().collect()
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
