//! Units in words, and what to do about one that is wrong.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use crate::ast::{Expr, ExprKind, Home};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::Rational;

impl Checker<'_, '_> {
    /// `in m/s`, `a plain number`
    pub fn phrase(&self, quantity: &Quantity, is_force: bool) -> String {
        let known = self.unknowns.dimension(quantity);
        let unit = match known.filter(|_| is_force) {
            Some(dimension) => dimension.as_force(),
            None => self.unknowns.text(quantity),
        };
        match unit.as_str() {
            "" => "a plain number".to_string(),
            unit => format!("in {unit}"),
        }
    }

    /// `m/s`, `a plain number`
    pub(super) fn noun(&self, quantity: &Quantity) -> String {
        match self.unknowns.text(quantity) {
            plain if plain.is_empty() => "a plain number".to_string(),
            unit => unit,
        }
    }

    /// What to do about an expression that has another unit than the wanted one.
    pub fn remedy(&mut self, wanted: &Quantity, found: &Quantity, expr: &Expr) -> String {
        if constant(expr).is_some() {
            return self.missing(wanted, found, expr);
        }
        let mut names = Vec::new();
        expr.names_into(&mut names);
        let inferred = names.into_iter().find_map(|name| {
            let quantity = self.inferred.get(name)?;
            Some(format!(
                "`{name}` must be {} elsewhere: give it a unit, or another name here",
                self.phrase(quantity, false)
            ))
            .filter(|_| self.unknowns.dimension(quantity).is_some())
        });
        inferred.unwrap_or_else(|| self.missing(wanted, found, expr))
    }

    /// The factor that is missing.
    fn missing(&mut self, wanted: &Quantity, found: &Quantity, expr: &Expr) -> String {
        let factor = self.unknowns.times(wanted, found, Rational::MINUS_ONE);
        if expr.is_number() {
            let unit = self.unknowns.text(&factor);
            let field = self.elaboration.home.with_unit(&unit);
            return format!("a number has no unit: make it {field}");
        }
        let Some(factor) = self.unknowns.dimension(&factor) else {
            let units = match self.elaboration.home {
                Home::Struct => "`#[lagrange(unit = \"…\")]` on fields",
                Home::File | Home::Line => "`parameters(mass: \"kg\" = 1)`",
            };
            return format!("units are {units}, and `coordinates(x: \"m\")`");
        };
        if let Some(number) = constant(expr) {
            let field = self.elaboration.home.with_unit(&factor.text());
            return format!("`{number}` is a plain number: make it {field}");
        }
        let is_plain = wanted.known().is_some_and(Dimension::is_one);
        // In a square a rate has the time twice.
        let is_rate = |power: Rational| power.is_one() || is_square(expr) && power == TWO;
        match factor.as_time().filter(|_| !is_plain) {
            Some(power) if power.checked_neg().is_some_and(is_rate) => {
                "is a `der(…)` missing?".to_string()
            }
            Some(power) if is_rate(power) => "is there a `der(…)` too many?".to_string(),
            _ => format!("a factor in {} is missing", factor.text()),
        }
    }

    /// Reports a mistake at tokens.
    pub fn mistake(
        &mut self,
        code: Code,
        at: impl Into<Extent>,
        arguments: &[&dyn std::fmt::Display],
    ) {
        self.sink.report(code, at, arguments);
    }
}

const TWO: Rational = Rational::integer(2);

/// Whether something is squared in a product.
fn is_square(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Power(_, exponent) => {
            matches!(&exponent.kind, ExprKind::Number(n) if (n.digits, n.exponent) == (2, 0))
        }
        ExprKind::Negative(inner) => is_square(inner),
        ExprKind::Product(factors) => factors.iter().any(|(_, factor)| is_square(factor)),
        _ => false,
    }
}

/// A number in a product that looks like a constant of nature: one with decimals, or above ten.
fn constant(expr: &Expr) -> Option<&Expr> {
    match &expr.kind {
        ExprKind::Number(number) if number.exponent < 0 || number.digits > 10 => Some(expr),
        ExprKind::Negative(inner) => constant(inner),
        ExprKind::Product(factors) => factors.iter().find_map(|(_, factor)| constant(factor)),
        _ => None,
    }
}
