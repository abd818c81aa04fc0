//! Units that must be one: of terms, of the sides of a comparison, of a value and what is expected of it.

use super::check::Checker;
use super::dimension::Dimension;
use super::infer::ANY;
use super::quantity::Quantity;
use super::shape::{Role, Shape};
use crate::ast::{Comparison, Expr};
use crate::diagnostics::Code;
use crate::sorted::SortedMap;
use crate::symbolic::Rational;

impl Checker<'_, '_> {
    /// Whether the unit found for an expression is the wanted one; if not, says so.
    pub fn equal<'a>(
        &mut self,
        wanted: &Quantity,
        found: &Quantity,
        role: impl Into<Role<'a>>,
        expr: &Expr,
    ) -> Option<()> {
        let Some((wanted, found)) = self.unknowns.conflict(wanted, found) else {
            return Some(());
        };
        let Role { what, is_force } = role.into();
        let hint = self.remedy(&wanted, &found, expr);
        let (wanted, found) = (
            self.phrase(&wanted, is_force),
            self.phrase(&found, is_force),
        );
        self.sink.report(
            Code::UnitExpected,
            expr.extent,
            &[&what, &wanted, &found, &hint],
        );
        None
    }

    /// Values of one unit; `code` says what is done with them. Those that can be read are compared even if others cannot.
    pub(super) fn terms(
        &mut self,
        code: Code,
        terms: &[&Expr],
        hint: Option<&Quantity>,
    ) -> Option<Shape> {
        let found: Vec<(&Expr, Option<Shape>)> = terms
            .iter()
            .map(|&term| (term, self.shape(term, hint)))
            .collect();
        let complete = found.iter().all(|(_, shape)| shape.is_some());
        let (terms, shapes): (Vec<&Expr>, Vec<Shape>) = found
            .into_iter()
            .filter_map(|(term, shape)| Some((term, shape?)))
            .unzip();
        self.alike(code, &terms, shapes, hint).filter(|_| complete)
    }

    /// Units that must agree: of terms, or of values of which one is chosen.
    pub(super) fn alike(
        &mut self,
        code: Code,
        terms: &[&Expr],
        shapes: Vec<Shape>,
        hint: Option<&Quantity>,
    ) -> Option<Shape> {
        let quantities: Vec<Vec<Quantity>> = shapes.iter().map(Shape::quantities).collect();
        let count = quantities.first().map_or(0, Vec::len);
        // A term is told once, however many of its components disagree.
        let mut told = vec![false; terms.len()];
        for component in 0..count {
            let column: Vec<&Quantity> = quantities
                .iter()
                .filter_map(|row| row.get(component))
                .collect();
            let reference = self.reference(terms, &column, hint);
            for (i, (term, quantity)) in terms.iter().zip(&column).enumerate() {
                if let Some((reference, found)) = self.unknowns.conflict(&reference, quantity) {
                    if std::mem::replace(&mut told[i], true) {
                        break;
                    }
                    let remedy = self.remedy(&reference, &found, term);
                    let (found, reference) = (self.noun(&found), self.noun(&reference));
                    self.sink
                        .report(code, term.extent, &[&found, &reference, &remedy]);
                    break;
                }
            }
        }
        let first = shapes.into_iter().next()?;
        (!told.contains(&true)).then_some(first)
    }

    /// What the others are measured by: what is expected if some term has it, else the unit that most terms have. A bare number has no
    /// say beside what has a unit: in `1 - R*phi` it is the 1 that lacks one.
    fn reference(
        &self,
        terms: &[&Expr],
        column: &[&Quantity],
        hint: Option<&Quantity>,
    ) -> Quantity {
        let known: Vec<Option<Dimension>> = column
            .iter()
            .map(|quantity| self.unknowns.dimension(quantity))
            .collect();
        let expected = hint.and_then(|hint| self.unknowns.dimension(hint));
        if let Some(expected) = expected.filter(|_| known.contains(&expected)) {
            return expected.into();
        }
        let mut votes: SortedMap<Dimension, usize> = SortedMap::new();
        let bare = |term: &&Expr| term.is_number();
        let all_bare = terms.iter().all(bare);
        for (_, dimension) in terms
            .iter()
            .zip(&known)
            .filter(|(t, _)| all_bare || !bare(t))
        {
            if let Some(dimension) = dimension {
                *votes.get_or_default(*dimension) += 1;
            }
        }
        let most = votes.values().max();
        let winner = (known.iter().flatten())
            .find(|dimension| most.is_some() && votes.get(dimension) == most);
        match (winner, column.first()) {
            (Some(dimension), _) => (*dimension).into(),
            (None, Some(first)) => (*first).clone(),
            (None, None) => Dimension::ONE.into(),
        }
    }

    /// The difference of the sides, where it is a number.
    pub(super) fn decided(&mut self, condition: &Comparison) -> Option<Rational> {
        let difference = self.elaboration.difference(condition, ANY)?;
        self.elaboration.system.pool.as_number(difference)
    }

    /// The unit of both sides of a comparison.
    pub fn comparison(&mut self, comparison: &Comparison) -> Option<Quantity> {
        self.sides(&comparison.left, &comparison.right)
    }

    /// The unit of two values that are compared.
    pub fn sides(&mut self, left: &Expr, right: &Expr) -> Option<Quantity> {
        let (a, b) = (self.one(left, None), self.one(right, None));
        let (a, b) = (a?, b?);
        let Some((first, second)) = self.unknowns.conflict(&a, &b) else {
            return Some(a);
        };
        // A bare number is what is wrong, on whichever side it stands.
        let (blamed, found, other) = match left.is_number() {
            true => (left, first, second),
            false => (right, second, first),
        };
        let remedy = self.remedy(&other, &found, blamed);
        let (found, other) = (self.noun(&found), self.noun(&other));
        self.sink.report(
            Code::UnitsCompared,
            blamed.extent,
            &[&found, &other, &remedy],
        );
        None
    }

    /// The unit of both sides where runs are described (starts, stops, marks): there a side that is nothing but a
    /// number is in the unit of the other.
    pub fn loosely(&mut self, comparison: &Comparison) -> Option<Quantity> {
        match [&comparison.left, &comparison.right].map(Expr::is_number) {
            [true, false] => self.one(&comparison.right, None),
            [false, true] => self.one(&comparison.left, None),
            _ => self.comparison(comparison),
        }
    }
}
