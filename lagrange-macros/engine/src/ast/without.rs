//! A declaration without some of its items: what a run has that leaves them out.

use super::{Declaration, Item, ItemKind, Name, Reference};
use std::slice;

impl Declaration {
    /// Takes out the items of these names, and the frictions and constraints that act only together with them. Outputs,
    /// stops, marks, checks and pictures go too: they may speak of what is gone, and do not change the motion. Nothing happens if no
    /// name is given; an element of an indexed item stays.
    pub fn leave_out(&mut self, names: &[&str]) {
        if names.is_empty() {
            return;
        }
        let is_gone = |name: &Name| names.contains(&name.text.as_str());
        self.items.retain(|item| {
            let (name, carriers) = identity(item);
            let watches = matches!(
                item.kind,
                ItemKind::Observe(_)
                    | ItemKind::Stop(_)
                    | ItemKind::Mark(_)
                    | ItemKind::Check(_)
                    | ItemKind::Draw(_)
            );
            !watches
                && !name.is_some_and(is_gone)
                && !carriers.iter().any(|carrier| is_gone(&carrier.name))
        });
    }
}

impl Item {
    /// Its name, if it can be left out.
    pub fn name(&self) -> Option<&Name> {
        identity(self).0
    }
}

/// The name of an item that can be left out, and what it acts together with.
fn identity(item: &Item) -> (Option<&Name>, &[Reference]) {
    match &item.kind {
        ItemKind::Kinetic(energy) | ItemKind::Potential(energy) => {
            (energy.head.as_ref().map(|head| &head.name), &[])
        }
        ItemKind::Constraint(constraint) => {
            let contact = constraint.while_contact.as_ref();
            (
                Some(&constraint.head.name),
                contact.map_or(&[], |(_, contact)| slice::from_ref(contact)),
            )
        }
        ItemKind::Contact(contact) => (Some(&contact.head.name), &[]),
        ItemKind::Friction(friction) => (Some(&friction.head.name), &friction.on),
        ItemKind::Force(force) => (Some(&force.head.name), &[]),
        ItemKind::Dissipation(dissipation) => (Some(&dissipation.head.name), &[]),
        _ => (None, &[]),
    }
}

#[cfg(test)]
mod tests {
    use crate::{inspect, inspect_without};
    use quote::quote;

    #[test]
    fn what_hangs_on_an_item_goes_with_it() {
        let cart = |items| {
            quote! {
                #[lagrange(coordinates(x, y), kinetic = m/2 * (der(x)^2 + der(y)^2), #items)]
                struct Cart { m: f64, g: f64, k: f64 }
            }
        };
        let all = cart(quote! {
            potential(weight: m * g * y),
            potential(spring: k/2 * x^2),
            contact(floor: y >= 0),
            friction(grip on floor: slip = der(x), static = 1/2),
            constraint(track while floor: der(x) == 0),
            stop(slow: slip(grip) <= 0),
        });
        let few = cart(quote! { potential(weight: m * g * y) });
        let left = inspect_without(all, &["floor", "spring"], None).expect("a derivation");
        let few = inspect(few, None).expect("a derivation");
        assert_eq!(format!("{left:?}"), format!("{few:?}"));
    }
}
