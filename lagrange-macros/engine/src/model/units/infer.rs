//! The unit of an expression, bottom up; an expectation from above only decides which term of a sum is to blame.
//!
//! Runs when names, shapes and ranges are known to be right. `None`: a mistake of units, which has been reported.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use super::shape::{Role, Shape};
use crate::ast::{Expr, ExprKind, Factor, Index};
use crate::diagnostics::Code;
use crate::model::depth::{Context, Reach};
use crate::symbolic::Rational;

/// Where values are only read for their numbers.
pub(super) const ANY: Context = Context::new(Reach::Outputs, "a unit");

impl Checker<'_, '_> {
    /// The unit of a single value.
    pub fn one(&mut self, expr: &Expr, hint: Option<&Quantity>) -> Option<Quantity> {
        match self.shape(expr, hint)? {
            Shape::One(quantity) => Some(quantity),
            Shape::List(_) => None,
        }
    }

    /// Whether an expression has the unit that is wanted; if not, says so.
    pub fn expect<'a>(
        &mut self,
        expr: &Expr,
        wanted: &Quantity,
        role: impl Into<Role<'a>>,
    ) -> Option<()> {
        let found = self.one(expr, Some(wanted))?;
        self.equal(wanted, &found, role, expr)
    }

    /// Whether an expression is a plain number.
    pub fn plain(&mut self, expr: &Expr, what: &str) -> Option<()> {
        self.expect(expr, &Dimension::ONE.into(), what)
    }

    /// Units of any shape.
    pub fn shape(&mut self, expr: &Expr, hint: Option<&Quantity>) -> Option<Shape> {
        let one = |dimension: Dimension| Some(Shape::One(dimension.into()));
        match &expr.kind {
            ExprKind::Number(number) if number.digits == 0 => {
                Some(Shape::One(self.unknowns.fresh("0")))
            }
            ExprKind::Number(_) => one(Dimension::ONE),
            ExprKind::Name(name) => self.name(name),
            ExprKind::Sum(terms) => {
                let terms: Vec<&Expr> = terms.iter().map(|(_, term)| term).collect();
                self.terms(Code::UnitsAdded, &terms, hint)
            }
            ExprKind::Product(factors) => self.product(factors, hint),
            ExprKind::Negative(inner) => self.shape(inner, hint),
            ExprKind::Power(base, exponent) => self.raised(base, exponent),
            ExprKind::Call(name, arguments) => self.call(name, arguments, hint),
            ExprKind::If(condition, then, otherwise) => {
                if let Some(number) = self.decided(condition) {
                    return self.shape(
                        if number.is_negative() {
                            otherwise
                        } else {
                            then
                        },
                        hint,
                    );
                }
                self.comparison(condition)?;
                self.terms(Code::UnitsChosen, &[then, otherwise], hint)
            }
            ExprKind::SumOver(index, body) => self.sum_over(index, body, hint),
            ExprKind::ListOver(index, body) => self.each_of(index, body, hint).map(Shape::List),
            ExprKind::List(elements) => {
                let shapes: Vec<Option<Shape>> = elements
                    .iter()
                    .map(|element| self.shape(element, None))
                    .collect();
                shapes.into_iter().collect::<Option<_>>().map(Shape::List)
            }
            ExprKind::Element(base, index) => self.element(base, index),
            ExprKind::Member(_, member) => {
                let list = |of: Shape| Shape::List(vec![of; 3]);
                Some(match member.text.as_str() {
                    "axes" => list(list(Shape::One(Dimension::ONE.into()))),
                    _ => list(Shape::One(Dimension::mechanical(0, 0, -1).into())),
                })
            }
        }
    }

    /// `base[index]`
    fn element(&mut self, base: &Expr, index: &Expr) -> Option<Shape> {
        let at = self
            .elaboration
            .integer(index)?
            .checked_sub(self.lower(base))?;
        let at = usize::try_from(at).ok()?;
        if let ExprKind::Name(name) = &base.kind
            && let Some(Some(Shape::List(elements))) = self.names.get(&name.text)
        {
            return elements.get(at).cloned();
        }
        match self.shape(base, None)? {
            Shape::List(elements) => elements.get(at).cloned(),
            Shape::One(_) => None,
        }
    }

    fn product(&mut self, factors: &[(Factor, Expr)], hint: Option<&Quantity>) -> Option<Shape> {
        let is_sum = |expr: &Expr| matches!(expr.kind, ExprKind::Sum(_) | ExprKind::SumOver(..));
        let mut shapes: Vec<Option<Shape>> = vec![None; factors.len()];
        let mut total: Option<Quantity> = hint.cloned();
        let mut failed = false;
        // Sums last: the other factors say what is expected of their terms.
        for sums in [false, true] {
            for (slot, (side, factor)) in shapes.iter_mut().zip(factors) {
                if is_sum(factor) != sums {
                    continue;
                }
                let hint = total.clone().filter(|_| sums && *side == Factor::Times);
                *slot = self.shape(factor, hint.as_ref());
                failed |= slot.is_none();
                let power = match side {
                    Factor::Times => Rational::MINUS_ONE,
                    Factor::Over => Rational::ONE,
                };
                total = match (total, slot) {
                    (Some(total), Some(Shape::One(quantity))) => {
                        Some(self.unknowns.times(&total, quantity, power))
                    }
                    _ => None,
                };
            }
        }
        if failed {
            return None;
        }
        let mut product = Quantity::from(Dimension::ONE);
        let mut list = None;
        for ((side, _), shape) in factors.iter().zip(shapes) {
            let power = match side {
                Factor::Times => Rational::ONE,
                Factor::Over => Rational::MINUS_ONE,
            };
            match shape? {
                Shape::One(quantity) => product = self.unknowns.times(&product, &quantity, power),
                shape => list = Some(shape),
            }
        }
        Some(match list {
            None => Shape::One(product),
            Some(list) => {
                let unknowns = &mut self.unknowns;
                list.map(&mut |quantity| unknowns.times(quantity, &product, Rational::ONE))
            }
        })
    }

    /// A power that is a number multiplies exponents; any other is a plain number, and so is its base.
    fn raised(&mut self, base: &Expr, exponent: &Expr) -> Option<Shape> {
        let value = self.elaboration.scalar(exponent, ANY)?;
        if let Some(power) = self.elaboration.system.pool.as_number(value) {
            let base = self.one(base, None)?;
            return Some(Shape::One(self.unknowns.power(&base, power)));
        }
        let power = self.plain(exponent, "an exponent");
        self.plain(base, "the base of a power whose exponent is no number")?;
        power?;
        Some(Shape::One(Dimension::ONE.into()))
    }

    /// The units of a body for every value of its index.
    fn each_of(
        &mut self,
        index: &Index,
        body: &Expr,
        hint: Option<&Quantity>,
    ) -> Option<Vec<Shape>> {
        let (from, to) = self.elaboration.bounds(&index.range)?;
        (from..to)
            .map(|k| self.with_index(&index.name, k, |this| this.shape(body, hint)))
            .collect()
    }

    fn sum_over(&mut self, index: &Index, body: &Expr, hint: Option<&Quantity>) -> Option<Shape> {
        let shapes = self.each_of(index, body, hint)?;
        if shapes.is_empty() {
            return Some(Shape::One(self.unknowns.fresh("0")));
        }
        let bodies = vec![body; shapes.len()];
        self.alike(Code::UnitsAdded, &bodies, shapes, hint)
    }
}
