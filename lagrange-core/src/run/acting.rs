//! What acts in a run: what is declared, less what is left out.

use crate::arithmetic::Scalar;
use crate::declaration::{Operations, Worked};
use crate::effects::{Effects, Item};
use crate::system::Erased;

/// The operations of what acts.
pub(super) fn acting<T: Scalar>(system: &Erased<T>, effects: &Effects) -> Operations {
    let values = acting_values(system, effects);
    Operations::of(
        system.declaration(),
        values.into_iter().map(|(_, value)| value),
    )
}

/// The values of what acts, each with the item that it is of.
pub(super) fn acting_values<T: Scalar>(
    system: &Erased<T>,
    effects: &Effects,
) -> Vec<(Item, usize)> {
    let (d, declaration) = (system.description(), system.declaration());
    let mut values = Vec::new();
    let mut put = |item: Item, list: &[usize]| {
        if effects.includes(d, item) {
            values.extend(list.iter().map(|&value| (item, value)));
        }
    };
    for (i, &value) in declaration.kinetic.iter().enumerate() {
        put(Item::Kinetic(i), &[value]);
    }
    for (i, &value) in declaration.potential.iter().enumerate() {
        put(Item::Potential(i), &[value]);
    }
    for (i, &value) in declaration.constraints.iter().enumerate() {
        put(Item::Constraint(i), &[value]);
    }
    for (i, contact) in declaration.contacts.iter().enumerate() {
        put(Item::Contact(i), &[contact.gap]);
        put(Item::Contact(i), contact.region.as_slice());
    }
    for (i, friction) in declaration.frictions.iter().enumerate() {
        put(Item::Friction(i), friction.slip);
        put(Item::Friction(i), friction.normal.as_slice());
        let coefficients = [friction.static_coefficient, friction.kinetic_coefficient];
        put(Item::Friction(i), &coefficients);
    }
    for (i, force) in declaration.forces.iter().enumerate() {
        for &(component, worked) in force.components {
            put(Item::Force(i), &[component]);
            if let Worked::Point(value) | Worked::Speed(value) = worked {
                put(Item::Force(i), &[value]);
            }
        }
    }
    for (i, &value) in declaration.dissipations.iter().enumerate() {
        put(Item::Dissipation(i), &[value]);
    }
    for (i, terms) in declaration.stops.iter().enumerate() {
        put(Item::Stop(i), terms.unwrap_or_default());
    }
    for (i, terms) in declaration.marks.iter().enumerate() {
        put(Item::Mark(i), terms.unwrap_or_default());
    }
    values
}
