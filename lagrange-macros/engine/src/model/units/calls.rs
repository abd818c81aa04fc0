//! The units of calls.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use super::shape::Shape;
use crate::ast::{Expr, Name};
use crate::diagnostics::Code;
use crate::model::meaning::Kind;
use crate::symbolic::{Function, Rational};

impl Checker<'_, '_> {
    pub(super) fn call(
        &mut self,
        name: &Name,
        arguments: &[Expr],
        hint: Option<&Quantity>,
    ) -> Option<Shape> {
        let text = name.text.as_str();
        let plain = Some(Shape::One(Dimension::ONE.into()));
        let per_time = |this: &mut Self, quantity: &Quantity| {
            this.unknowns
                .times(quantity, &Dimension::TIME.into(), Rational::MINUS_ONE)
        };
        match (text, arguments) {
            ("atan2", [a, b]) => {
                self.sides(a, b)?;
                plain
            }
            ("der", [inner]) => {
                let inner = self.shape(inner, None)?;
                Some(inner.map(&mut |quantity| per_time(self, quantity)))
            }
            ("sqrt", [inner]) => {
                let inner = self.one(inner, None)?;
                Some(Shape::One(self.unknowns.power(&inner, Rational::HALF)))
            }
            ("abs", [inner]) => self.shape(inner, hint),
            ("sign", [inner]) => {
                self.one(inner, None)?;
                plain
            }
            ("min" | "max", several) => {
                let terms: Vec<&Expr> = several.iter().collect();
                self.terms(Code::UnitsChosen, &terms, hint)
            }
            ("dot" | "cross" | "norm", lists) => self.of_lists(name, lists),
            ("gap" | "slip" | "momentum", [inner]) => {
                let reference = self.elaboration.reference(inner)?;
                if text == "momentum" {
                    let coordinate = self.coordinate(&reference)?;
                    let action = self.times_time(&self.energy.clone(), 1);
                    let momentum = self
                        .unknowns
                        .times(&action, &coordinate, Rational::MINUS_ONE);
                    return Some(Shape::One(momentum));
                }
                let kinds = [Kind::Contact, Kind::Friction];
                match self.elaboration.item(&reference, &kinds)? {
                    (Kind::Contact, contact) => self.gaps.get(&contact).cloned().map(Shape::One),
                    (_, friction) => self.slips.get(&friction).cloned(),
                }
            }
            (function, several) if Function::from_name(function).is_some() => {
                let what = format!("the argument of `{function}`");
                for argument in several {
                    self.plain(argument, what.as_str())?;
                }
                plain
            }
            _ => None,
        }
    }

    /// `dot(a, b)`, `cross(a, b)`, `norm(a)`
    fn of_lists(&mut self, name: &Name, lists: &[Expr]) -> Option<Shape> {
        let shapes: Vec<Option<Shape>> = lists.iter().map(|list| self.shape(list, None)).collect();
        let shapes: Vec<Shape> = shapes.into_iter().collect::<Option<_>>()?;
        let lists: Vec<Vec<Quantity>> = shapes.iter().map(Shape::quantities).collect();
        let (a, b) = match lists.as_slice() {
            [a, b] => (a, b),
            [a] => (a, a),
            _ => return None,
        };
        let mut terms: Vec<Vec<(usize, usize)>> = Vec::new();
        match (name.text.as_str(), a.len()) {
            ("cross", 3) => {
                terms.extend([(1, 2), (2, 0), (0, 1)].map(|(i, j)| vec![(i, j), (j, i)]));
            }
            ("cross", _) => terms.push(vec![(0, 1), (1, 0)]),
            (_, count) => terms.push((0..count).map(|k| (k, k)).collect()),
        }
        let mut components = Vec::new();
        for products in terms {
            let mut component: Option<Quantity> = None;
            for (i, j) in products {
                let product = self.unknowns.times(&a[i], &b[j], Rational::ONE);
                let first = component.get_or_insert_with(|| product.clone()).clone();
                if let Some((first, second)) = self.unknowns.conflict(&first, &product) {
                    let (first, second) = (self.noun(&first), self.noun(&second));
                    let hint = "the components of a vector have one unit";
                    self.sink
                        .report(Code::UnitsAdded, name, &[&second, &first, &hint]);
                    return None;
                }
            }
            components.push(component?);
        }
        let component = |quantity: Quantity| Shape::One(quantity);
        if components.len() > 1 {
            return Some(Shape::List(components.into_iter().map(component).collect()));
        }
        let only = components.pop()?;
        Some(component(match name.text.as_str() {
            "norm" => self.unknowns.power(&only, Rational::HALF),
            _ => only,
        }))
    }

    /// quantity · sⁿ
    pub fn times_time(&mut self, quantity: &Quantity, n: i64) -> Quantity {
        self.unknowns
            .times(quantity, &Dimension::TIME.into(), Rational::integer(n))
    }
}
