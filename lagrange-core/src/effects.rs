//! Which named items of a system a scene leaves out.

use crate::system::{Description, Normal};
use std::collections::BTreeSet;

/// A named item that can be left out; the number is its index in the description's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item {
    /// A term of the kinetic energy.
    Kinetic(usize),
    /// A term of the potential energy.
    Potential(usize),
    /// An equality constraint.
    Constraint(usize),
    /// A one-sided contact; its frictions and `while` constraints go with it.
    Contact(usize),
    /// A friction.
    Friction(usize),
    /// An applied force.
    Force(usize),
    /// A Rayleigh dissipation.
    Dissipation(usize),
    /// An extra output.
    Observe(usize),
    /// What ends a run.
    Stop(usize),
    /// What is logged.
    Mark(usize),
}

impl Item {
    /// All items that a scene can leave out, in order of declaration within each kind: not the unit length of an attitude's quaternion,
    /// without which there is no orientation.
    pub fn all(description: &Description) -> impl Iterator<Item = Item> + '_ {
        let d = description;
        let optional = |list: &'static [crate::system::Effect], item: fn(usize) -> Item| {
            let named = list.iter().enumerate().filter(|(_, e)| e.optional);
            named.map(move |(i, _)| item(i))
        };
        let constraints = d.constraints.iter().enumerate();
        let constraints = constraints.filter(|(_, constraint)| constraint.attitude.is_none());
        optional(d.kinetic, Item::Kinetic)
            .chain(optional(d.potential, Item::Potential))
            .chain(constraints.map(|(i, _)| Item::Constraint(i)))
            .chain((0..d.contacts.len()).map(Item::Contact))
            .chain((0..d.frictions.len()).map(Item::Friction))
            .chain((0..d.forces.len()).map(Item::Force))
            .chain((0..d.dissipations.len()).map(Item::Dissipation))
            .chain((0..d.observes.len()).map(Item::Observe))
            .chain((0..d.stops.len()).map(Item::Stop))
            .chain((0..d.marks.len()).map(Item::Mark))
    }

    /// Its name in the declaration.
    pub fn name(self, description: &Description) -> &'static str {
        let d = description;
        match self {
            Item::Kinetic(i) => d.kinetic[i].name,
            Item::Potential(i) => d.potential[i].name,
            Item::Constraint(i) => d.constraints[i].name,
            Item::Contact(i) => d.contacts[i].name,
            Item::Friction(i) => d.frictions[i].name,
            Item::Force(i) => d.forces[i].name,
            Item::Dissipation(i) => d.dissipations[i].name,
            Item::Observe(i) => d.observes[i].name,
            Item::Stop(i) => d.stops[i].name,
            Item::Mark(i) => d.marks[i].name,
        }
    }

    /// Its index, and how many of its kind there are; the system has no such item if the first is not below the second.
    pub(crate) fn place(self, description: &Description) -> (usize, usize) {
        let d = description;
        match self {
            Item::Kinetic(i) => (i, d.kinetic.len()),
            Item::Potential(i) => (i, d.potential.len()),
            Item::Constraint(i) => (i, d.constraints.len()),
            Item::Contact(i) => (i, d.contacts.len()),
            Item::Friction(i) => (i, d.frictions.len()),
            Item::Force(i) => (i, d.forces.len()),
            Item::Dissipation(i) => (i, d.dissipations.len()),
            Item::Observe(i) => (i, d.observes.len()),
            Item::Stop(i) => (i, d.stops.len()),
            Item::Mark(i) => (i, d.marks.len()),
        }
    }

    /// What it is, in a word.
    pub fn kind(self) -> &'static str {
        match self {
            Item::Kinetic(_) => "kinetic energy",
            Item::Potential(_) => "potential",
            Item::Constraint(_) => "constraint",
            Item::Contact(_) => "contact",
            Item::Friction(_) => "friction",
            Item::Force(_) => "force",
            Item::Dissipation(_) => "dissipation",
            Item::Observe(_) => "output",
            Item::Stop(_) => "stop",
            Item::Mark(_) => "mark",
        }
    }
}

/// The effects of a scene: all items of the declaration but those left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Effects {
    left_out: BTreeSet<Item>,
}

impl Effects {
    /// Everything that is declared.
    pub fn all() -> Self {
        Self::default()
    }

    /// The same without this item. It costs nothing from then on.
    #[must_use]
    pub fn without(mut self, item: impl Into<Item>) -> Self {
        self.left_out.insert(item.into());
        self
    }

    /// The items left out by name, in order.
    pub fn left_out(&self) -> impl Iterator<Item = Item> + '_ {
        self.left_out.iter().copied()
    }

    /// Whether an item takes part: neither it nor the item that it hangs on is left out.
    pub fn includes(&self, description: &Description, item: impl Into<Item>) -> bool {
        let item = item.into();
        if self.left_out.contains(&item) {
            return false;
        }
        match item {
            Item::Constraint(i) => match description.constraints[i].while_contact {
                Some(contact) => self.includes(description, Item::Contact(contact)),
                None => true,
            },
            Item::Friction(i) => match description.frictions[i].normal {
                Normal::Contact(contact) => self.includes(description, Item::Contact(contact)),
                normal => normal
                    .constraints(description)
                    .all(|constraint| self.includes(description, Item::Constraint(constraint))),
            },
            _ => true,
        }
    }
}
