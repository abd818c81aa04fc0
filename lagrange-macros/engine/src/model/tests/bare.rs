//! Systems without items, for tests of what comes later.

use crate::model::{Coordinate, ItemName, Parameter, System};
use crate::symbolic::Pool;
use proc_macro2::{Ident, Span};

/// A name as written; an empty one is none.
pub(crate) fn item(text: &str) -> ItemName {
    let span = Span::call_site();
    ItemName {
        text: text.to_owned(),
        ident: (!text.is_empty()).then(|| Ident::new(text, span)),
        element: None,
        span,
    }
}

/// Parameters, and coordinates x with velocities `v_x` and accelerations `a_x`.
pub(crate) fn bare<'a>(
    parameters: impl IntoIterator<Item = &'a str>,
    coordinates: impl IntoIterator<Item = &'a str>,
) -> System {
    let mut pool = Pool::new();
    let time = pool.symbol("t");
    let parameters = parameters
        .into_iter()
        .map(|name| Parameter {
            field: Ident::new(name, Span::call_site()),
            element: None,
            name: name.to_owned(),
            symbol: pool.symbol(name),
            documentation: String::new(),
            unit: String::new(),
            tex: String::new(),
            letter: String::new(),
            domain: None,
        })
        .collect();
    let coordinates = coordinates
        .into_iter()
        .map(|name| Coordinate {
            name: item(name),
            position: pool.symbol(name),
            velocity: pool.symbol(&format!("v_{name}")),
            acceleration: pool.symbol(&format!("a_{name}")),
            unit: String::new(),
        })
        .collect();
    System {
        parameters,
        coordinates,
        ..System::empty(Ident::new("Bare", Span::call_site()), pool, time)
    }
}
