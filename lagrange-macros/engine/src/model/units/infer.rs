//! The unit of an expression, bottom up; an expectation from above only decides which term of a sum is to blame.
//!
//! Runs when names, shapes and ranges are known to be right. `None`: a mistake of units, which has been reported.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use crate::ast::{Comparison, Expr, ExprKind, Factor, Index, Name};
use crate::diagnostics::{Code, Extent};
use crate::model::names::{Kind, Meaning};
use crate::model::reach::{Context, Reach};
use crate::symbolic::{Function, Rational};

const ANY: Context = Context::new(Reach::Outputs, "a unit");

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
                self.terms(&terms, hint)
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
                self.terms(&[then, otherwise], hint)
            }
            ExprKind::SumOver(index, body) => self.sum_over(index, body, hint),
            ExprKind::List(elements) => {
                let shapes: Vec<Option<Shape>> = elements
                    .iter()
                    .map(|element| self.shape(element, None))
                    .collect();
                shapes.into_iter().collect::<Option<_>>().map(Shape::List)
            }
            ExprKind::Element(base, index) => {
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
            ExprKind::Member(_, member) => {
                let list = |of: Shape| Shape::List(vec![of; 3]);
                Some(match member.text.as_str() {
                    "axes" => list(list(Shape::One(Dimension::ONE.into()))),
                    _ => list(Shape::One(Dimension::mechanical(0, 0, -1).into())),
                })
            }
        }
    }

    /// Values of one unit. Those that can be read are compared even if others cannot.
    fn terms(&mut self, terms: &[&Expr], hint: Option<&Quantity>) -> Option<Shape> {
        let found: Vec<(&Expr, Option<Shape>)> = terms
            .iter()
            .map(|&term| (term, self.shape(term, hint)))
            .collect();
        let complete = found.iter().all(|(_, shape)| shape.is_some());
        let (terms, shapes): (Vec<&Expr>, Vec<Shape>) = found
            .into_iter()
            .filter_map(|(term, shape)| Some((term, shape?)))
            .unzip();
        self.sum(&terms, shapes, hint).filter(|_| complete)
    }

    /// Units that must agree: of terms, or of the sides of a condition.
    fn sum(
        &mut self,
        terms: &[&Expr],
        shapes: Vec<Shape>,
        hint: Option<&Quantity>,
    ) -> Option<Shape> {
        let quantities: Vec<Vec<Quantity>> = shapes.iter().map(Shape::quantities).collect();
        let (mut fine, count) = (true, quantities.first().map_or(0, Vec::len));
        for component in 0..count {
            let column: Vec<&Quantity> = quantities
                .iter()
                .filter_map(|row| row.get(component))
                .collect();
            let reference = self.reference(&column, hint);
            for (term, quantity) in terms.iter().zip(&column) {
                if let Some((reference, found)) = self.unknowns.conflict(&reference, quantity) {
                    let remedy = self.remedy(&reference, &found, term);
                    let (found, reference) = (self.noun(&found), self.noun(&reference));
                    self.sink.report(
                        Code::UnitsAdded,
                        term.extent,
                        &[&found, &reference, &remedy],
                    );
                    fine = false;
                    break;
                }
            }
        }
        let first = shapes.into_iter().next()?;
        fine.then_some(first)
    }

    /// What the others are measured by: what is expected if some term has it, else the unit that most terms have.
    fn reference(&self, column: &[&Quantity], hint: Option<&Quantity>) -> Quantity {
        let known: Vec<Option<Dimension>> = column
            .iter()
            .map(|quantity| self.unknowns.dimension(quantity))
            .collect();
        let expected = hint.and_then(|hint| self.unknowns.dimension(hint));
        if let Some(expected) = expected.filter(|_| known.contains(&expected)) {
            return expected.into();
        }
        let votes = |dimension: &Option<Dimension>| {
            let same = known.iter().filter(|other| *other == dimension);
            dimension.map_or(0, |_| same.count())
        };
        let most = known.iter().map(votes).max().unwrap_or(0);
        let winner = known.iter().find(|dimension| votes(dimension) == most);
        match (winner, column.first()) {
            (Some(Some(dimension)), _) => (*dimension).into(),
            (_, Some(first)) => (*first).clone(),
            _ => Dimension::ONE.into(),
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

    fn sum_over(&mut self, index: &Index, body: &Expr, hint: Option<&Quantity>) -> Option<Shape> {
        let (from, to) = self.elaboration.bounds(&index.range)?;
        let mut shapes = Vec::new();
        for k in from..to {
            shapes.push(self.with_index(&index.name, k, |this| this.shape(body, hint))?);
        }
        if shapes.is_empty() {
            return Some(Shape::One(self.unknowns.fresh("0")));
        }
        let bodies = vec![body; shapes.len()];
        self.sum(&bodies, shapes, hint)
    }

    pub fn with_index<R>(&mut self, name: &Name, k: i64, body: impl FnOnce(&mut Self) -> R) -> R {
        self.elaboration.indices.push((name.text.clone(), k));
        let result = body(self);
        self.elaboration.indices.pop();
        result
    }

    /// The difference of the sides, where it is a number.
    fn decided(&mut self, condition: &Comparison) -> Option<Rational> {
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
        let (blamed, found, other) = match is_number(left) {
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
        match [&comparison.left, &comparison.right].map(is_number) {
            [true, false] => self.one(&comparison.right, None),
            [false, true] => self.one(&comparison.left, None),
            _ => self.comparison(comparison),
        }
    }

    /// What a name stands for.
    fn name(&mut self, name: &Name) -> Option<Shape> {
        let text = name.text.as_str();
        match text {
            "pi" => return Some(Shape::One(Dimension::ONE.into())),
            "t" => return Some(Shape::One(Dimension::TIME.into())),
            "energy" => return Some(Shape::One(self.energy.clone())),
            _ => {}
        }
        if self
            .elaboration
            .indices
            .iter()
            .any(|(known, _)| known == text)
        {
            return Some(Shape::One(Dimension::ONE.into()));
        }
        if let Some(shape) = self.names.get(text) {
            return shape.clone();
        }
        let entry = self.elaboration.names.get(text)?;
        if let Meaning::Item { elements, lower } = &entry.meaning {
            let (kind, lower) = (entry.kind, *lower);
            let mut shapes: Vec<Shape> = elements
                .clone()
                .into_iter()
                .map(|element| self.forces.of(kind, element))
                .collect::<Option<_>>()?;
            return match lower {
                None => shapes.pop(),
                Some(_) => Some(Shape::List(shapes)),
            };
        }
        self.definition(text)
    }

    /// A definition or output, read once.
    pub fn definition(&mut self, text: &str) -> Option<Shape> {
        let pending = self
            .elaboration
            .definitions
            .iter()
            .find(|pending| pending.head.name.text == text)?
            .clone();
        let indices = std::mem::take(&mut self.elaboration.indices);
        let found = match &pending.head.index {
            None => self.shape(&pending.value, None),
            Some(index) => self
                .elaboration
                .bounds(&index.range)
                .and_then(|(from, to)| {
                    let elements = (from..to).map(|k| {
                        self.with_index(&index.name, k, |this| this.shape(&pending.value, None))
                    });
                    elements.collect::<Option<_>>().map(Shape::List)
                }),
        };
        self.elaboration.indices = indices;
        self.names.insert(text.to_string(), found.clone());
        found
    }

    /// Where the indices of a list begin.
    fn lower(&self, base: &Expr) -> i64 {
        let ExprKind::Name(name) = &base.kind else {
            return 0;
        };
        match self
            .elaboration
            .names
            .get(&name.text)
            .map(|entry| &entry.meaning)
        {
            Some(Meaning::Value { lower, .. }) => *lower,
            Some(Meaning::Item { lower, .. }) => lower.unwrap_or(0),
            _ => 0,
        }
    }

    fn call(&mut self, name: &Name, arguments: &[Expr], hint: Option<&Quantity>) -> Option<Shape> {
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
                self.terms(&terms, hint)
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
    fn noun(&self, quantity: &Quantity) -> String {
        match self.unknowns.text(quantity) {
            plain if plain.is_empty() => "a plain number".to_string(),
            unit => unit,
        }
    }

    /// What to do about an expression that has another unit than the wanted one.
    pub fn remedy(&mut self, wanted: &Quantity, found: &Quantity, expr: &Expr) -> String {
        let mut names = Vec::new();
        names_in(expr, &mut names);
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
        if is_number(expr) {
            let unit = self.unknowns.text(&factor);
            return format!(
                "a number has no unit: make it a field with `#[lagrange(unit = \"{unit}\")]`"
            );
        }
        let Some(factor) = self.unknowns.dimension(&factor) else {
            return "units are `#[lagrange(unit = \"…\")]` on fields, and `coordinates(x: \"m\")`"
                .to_string();
        };
        if let Some(number) = constant(expr) {
            return format!(
                "`{number}` is a plain number: make it a field with `#[lagrange(unit = \"{}\")]`",
                factor.text()
            );
        }
        let is_plain = wanted.known().is_some_and(Dimension::is_one);
        match factor.as_time().filter(|_| !is_plain) {
            Some(power) if power == Rational::MINUS_ONE => "is a `der(…)` missing?".to_string(),
            Some(power) if power.is_one() => "is there a `der(…)` too many?".to_string(),
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

/// Whether an expression is made of numbers only.
pub(super) fn is_number(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) => true,
        ExprKind::Name(name) => name.text == "pi",
        ExprKind::Negative(inner) => is_number(inner),
        ExprKind::Sum(terms) => terms.iter().all(|(_, term)| is_number(term)),
        ExprKind::Product(factors) => factors.iter().all(|(_, factor)| is_number(factor)),
        ExprKind::Power(base, exponent) => is_number(base) && is_number(exponent),
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

/// The names that an expression uses, in order.
fn names_in<'a>(expr: &'a Expr, names: &mut Vec<&'a str>) {
    match &expr.kind {
        ExprKind::Number(_) => {}
        ExprKind::Name(name) => names.push(&name.text),
        ExprKind::Sum(terms) => terms.iter().for_each(|(_, term)| names_in(term, names)),
        ExprKind::Product(factors) => factors
            .iter()
            .for_each(|(_, factor)| names_in(factor, names)),
        ExprKind::Negative(inner) | ExprKind::SumOver(_, inner) => names_in(inner, names),
        ExprKind::Member(inner, _) | ExprKind::Element(inner, _) => names_in(inner, names),
        ExprKind::Power(base, exponent) => [base, exponent]
            .into_iter()
            .for_each(|part| names_in(part, names)),
        ExprKind::Call(_, parts) | ExprKind::List(parts) => {
            parts.iter().for_each(|part| names_in(part, names));
        }
        ExprKind::If(condition, then, otherwise) => {
            for part in [&condition.left, &condition.right, then, otherwise] {
                names_in(part, names);
            }
        }
    }
}
