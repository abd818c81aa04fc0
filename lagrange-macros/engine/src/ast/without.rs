//! A declaration without some of its items: what a run has that leaves them out.

use super::{Declaration, Item, ItemKind, Name, Reference};

impl Declaration {
    /// Takes out the items of these names, and the frictions and constraints that act only together with them. Outputs,
    /// stops, marks and checks go too: they may speak of what is gone, and do not change the motion. Nothing happens if no
    /// name is given; an element of an indexed item stays.
    pub fn leave_out(&mut self, names: &[&str]) {
        if names.is_empty() {
            return;
        }
        let is_gone = |name: &Name| names.contains(&name.text.as_str());
        self.items.retain(|item| {
            let (name, carrier) = identity(item);
            let watches = matches!(
                item.kind,
                ItemKind::Observe(_) | ItemKind::Stop(_) | ItemKind::Mark(_) | ItemKind::Check(_)
            );
            !watches
                && !name.is_some_and(is_gone)
                && !carrier.is_some_and(|carrier| is_gone(&carrier.name))
        });
    }
}

/// The name of an item that can be left out, and what it acts together with.
fn identity(item: &Item) -> (Option<&Name>, Option<&Reference>) {
    match &item.kind {
        ItemKind::Kinetic(energy) | ItemKind::Potential(energy) => {
            (energy.head.as_ref().map(|head| &head.name), None)
        }
        ItemKind::Constraint(constraint) => {
            let contact = constraint.while_contact.as_ref();
            (Some(&constraint.head.name), contact.map(|(_, contact)| contact))
        }
        ItemKind::Contact(contact) => (Some(&contact.head.name), None),
        ItemKind::Friction(friction) => (Some(&friction.head.name), friction.on.as_ref()),
        ItemKind::Force(force) => (Some(&force.head.name), None),
        ItemKind::Dissipation(dissipation) => (Some(&dissipation.head.name), None),
        _ => (None, None),
    }
}
