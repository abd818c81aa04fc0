//! Coulomb friction: coefficients and normal force.
//!
//! ```text
//! stick   s = 0, |λ| ≤ μs N            slip   λ = −μk N s/|s|
//! ```
//!
//! The slip components are rows like any other ([`super::rows`]): the force that acts along them is the row's
//! multiplier, whichever law decides it (Brogliato 2016, section 5.3; Glocker 2001, chapter 7). What is left to
//! derive are the numbers that the law needs: μs, μk and, where no contact or constraint supplies it, N.

use super::sheet::Sheet;
use super::{Friction, OutputId};
use crate::model::Normal;
use crate::symbolic::ExprId;

/// The numbers of the frictions beside their rows.
pub(super) fn frictions(sheet: &mut Sheet) -> Vec<Friction<OutputId>> {
    let mut row = sheet.system.constraints.len() + sheet.system.contacts.len();
    let mut frictions = Vec::new();
    for i in 0..sheet.system.frictions.len() {
        let need = sheet.needs.coefficients[i];
        let friction = &sheet.system.frictions[i];
        let name = friction.name.text.clone();
        let components = friction.slip.len();
        let given = match friction.normal {
            Normal::Given(e) => Some(e),
            Normal::Contact(_) | Normal::Constraint(_) | Normal::Resultant(_) => None,
        };
        let (at_rest, sliding) = (friction.static_coefficient, friction.kinetic_coefficient);
        let mut simple = |kind: &str, e: ExprId| {
            let e = sheet.system.pool.simplify(e);
            sheet.motion(format!("{kind}[{name}]"), need, e)
        };
        frictions.push(Friction {
            row,
            given_normal: given.map(|e| simple("normal", e)),
            static_coefficient: simple("static", at_rest),
            kinetic_coefficient: simple("kinetic", sliding),
            coefficients_need: need,
        });
        row += components;
        sheet.derived_of(sheet.system.frictions[i].name.clone());
    }
    frictions
}
