//! What the letters of bodies in space mean: their rates and axes by the quaternion q = (q₀, u).
//!
//! ```text
//! ω = 2 (q₀ u̇ − q̇₀ u − u × u̇)        eᵢ = (q₀² − u·u) iᵢ + 2 uᵢ u + 2 q₀ u × iᵢ
//! ```
//!
//! with the axes iᵢ of space (Whittaker 1904, sections 9 to 16). Formulas hold ω and e; these lines say once what they are.

use super::Body;
use super::formula::{Formula, Statement};
use super::letter::Letter;
use super::print;
use super::work::Work;
use crate::ast::{Declaration, ItemKind};
use crate::sorted::SortedSet;
use crate::symbolic::{Rational, Symbol};

impl Work<'_> {
    /// The bodies whose rates are velocities, with those of their axes that an equation contains.
    pub fn bodies(&mut self, declaration: &Declaration) -> Vec<Body> {
        let equations = self.equations;
        let terms = equations.outputs.iter().flat_map(|output| &output.terms);
        let present: SortedSet<Symbol> = terms
            .flat_map(|&(_, e)| self.reader.peek().symbols(e))
            .collect();
        let mut bodies = Vec::new();
        for item in &declaration.items {
            let ItemKind::Attitude(attitude) = &item.kind else {
                continue;
            };
            let name = &attitude.body.text;
            let mut of_system = equations.system.bodies.iter();
            let Some(body) = of_system.find(|body| body.name == *name) else {
                continue;
            };
            let quaternion = Letter::new(&attitude.coordinates.text);
            let q = |k: usize| quaternion.clone().element(&k.to_string());
            let letter = |symbol| Formula::Letter(self.names.letter(symbol));
            let mut definitions = Vec::new();
            for k in 0..3 {
                let turn = &equations.system.coordinates[body.first + k];
                definitions.push(Statement::equal(letter(turn.velocity), rate(&q, k)));
            }
            for (i, axis) in body.axes.iter().enumerate() {
                for (j, &component) in axis.iter().enumerate() {
                    if present.contains(&component) {
                        definitions.push(Statement::equal(
                            letter(component),
                            axis_component(&q, i, j),
                        ));
                    }
                }
            }
            let said = |symbol| print::text::formula(&letter(symbol));
            let rates =
                [0, 1, 2].map(|k| said(equations.system.coordinates[body.first + k].velocity));
            let [component, _, _] = body.axes.map(|axis| said(axis[1]));
            bodies.push(Body {
                name: name.clone(),
                text: format!(
                    "{name}: {} are its rates about its own axes, of which {component} is component 1 of axis 0 in space. \
                     Their equations are balances of moments about these axes, after Euler.",
                    rates.join(", ")
                ),
                definitions,
            });
        }
        bodies
    }
}

/// 2 (q₀ u̇ₖ − q̇₀ uₖ − (u × u̇)ₖ)
fn rate(q: &dyn Fn(usize) -> Letter, k: usize) -> Formula {
    let [next, last] = [(k + 1) % 3, (k + 2) % 3].map(|i| i + 1);
    let term = |minus: bool, still: usize, moving: usize| {
        let factors = [q(still), q(moving).rate(1)].map(Formula::Letter);
        let product = Formula::Product(factors.into());
        if minus { product.negated() } else { product }
    };
    let sum = Formula::sum([
        term(false, 0, k + 1),
        term(true, k + 1, 0),
        term(true, next, last),
        term(false, last, next),
    ]);
    Formula::Product(vec![Formula::number(Rational::integer(2)), sum])
}

/// Component j of axis i.
fn axis_component(q: &dyn Fn(usize) -> Letter, i: usize, j: usize) -> Formula {
    let two = || Formula::number(Rational::integer(2));
    let letter = |k| Formula::Letter(q(k));
    if i == j {
        let square = |k: usize| Formula::Power(Box::new(letter(k)), Box::new(two()));
        return Formula::sum((0..4).map(|k| match k == 0 || k == i + 1 {
            true => square(k),
            false => square(k).negated(),
        }));
    }
    // (u × iᵢ)ⱼ is +uₖ where (i, j, k) follow each other, else −uₖ.
    let third = Formula::Product(vec![letter(0), letter(4 - i - j)]);
    let turned = match (i + 1) % 3 == j {
        true => third,
        false => third.negated(),
    };
    let outer = Formula::Product(vec![letter(i + 1), letter(j + 1)]);
    Formula::Product(vec![two(), Formula::sum([outer, turned])])
}
