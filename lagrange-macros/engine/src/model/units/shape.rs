//! Units in the shape of a value, and what they are expected of.

use super::quantity::Quantity;

/// Units in the shape of a value.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    One(Quantity),
    List(Vec<Shape>),
}

impl Shape {
    /// All quantities in it, in order.
    pub fn quantities(&self) -> Vec<Quantity> {
        match self {
            Shape::One(quantity) => vec![quantity.clone()],
            Shape::List(elements) => elements.iter().flat_map(Shape::quantities).collect(),
        }
    }

    pub fn map(&self, f: &mut impl FnMut(&Quantity) -> Quantity) -> Shape {
        match self {
            Shape::One(quantity) => Shape::One(f(quantity)),
            Shape::List(elements) => Shape::List(elements.iter().map(|e| e.map(f)).collect()),
        }
    }
}

/// What a unit is expected of, for messages.
#[derive(Clone, Copy)]
pub(super) struct Role<'a> {
    /// `a slip`
    pub what: &'a str,
    /// Whether J is read as N m.
    pub is_force: bool,
}

impl<'a> From<&'a str> for Role<'a> {
    fn from(what: &'a str) -> Role<'a> {
        Role {
            what,
            is_force: false,
        }
    }
}

impl Role<'_> {
    pub fn force(what: &str) -> Role<'_> {
        Role {
            what,
            is_force: true,
        }
    }
}
