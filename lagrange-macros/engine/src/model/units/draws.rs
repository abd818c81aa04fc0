//! The units of pictures: places and sizes in m, angles as plain numbers, forces in N.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use super::shape::Role;
use crate::ast::{self, Detail, Expr, Form};
use crate::symbolic::Rational;

impl Checker<'_, '_> {
    /// One `draw`, for the value that its index has.
    pub(super) fn draw(&mut self, draw: &ast::Draw) -> Option<()> {
        let metre: Quantity = Dimension::LENGTH.into();
        let per_metre = Rational::MINUS_ONE;
        let newton = self.unknowns.times(&self.energy.clone(), &metre, per_metre);
        let places = match (draw.form, &draw.at) {
            (Form::Arrow, None) => &[],
            (Form::Arrow, Some(_)) => {
                let role = Role::force("the force of an arrow");
                self.all(&draw.places[0], &newton, role)?;
                draw.at.as_slice()
            }
            _ => &draw.places,
        };
        for place in places {
            self.all(place, &metre, "a place in a picture".into())?;
        }
        for (detail, key, value) in &draw.details {
            let unit = match detail {
                Detail::Radius | Detail::Height | Detail::Size => metre.clone(),
                Detail::Angle | Detail::Turn | Detail::Rolled => Dimension::ONE.into(),
                Detail::Attitude => continue,
            };
            let what = format!("`{}`", key.text);
            self.all(value, &unit, what.as_str().into())?;
        }
        Some(())
    }

    /// Whether all elements of a value have this unit, or are plain numbers, which are read in it. A list that is written out is
    /// blamed by element.
    pub(super) fn all(&mut self, value: &Expr, wanted: &Quantity, role: Role) -> Option<()> {
        if let ast::ExprKind::List(elements) = &value.kind {
            return elements
                .iter()
                .try_for_each(|element| self.all(element, wanted, role));
        }
        if value.is_number() {
            return Some(());
        }
        let found = self.shape(value, Some(wanted))?.quantities();
        found
            .iter()
            .try_for_each(|found| self.equal(wanted, found, role, value))
    }
}
