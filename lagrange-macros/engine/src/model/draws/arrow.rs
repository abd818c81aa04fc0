//! Arrows: a force as a sum over the multipliers, its place and its name.
//!
//! A force f(λ) that is linear in the multipliers is Σ λᵢ ∂f/∂λᵢ + f(0): the parts give the arrow of an impulse as well, whose
//! multipliers are others.

use super::{Draw, PLACE};
use crate::ast::{self, Expr};
use crate::diagnostics::Code;
use crate::model::depth::{Context, Reach};
use crate::model::elaborate::item_name;
use crate::model::elaboration::Elaboration;
use crate::model::forces::AS_ITS_PLACE;
use crate::model::meaning::Kind;
use crate::model::value::Value;
use crate::model::{System, Worked};
use crate::symbolic::{ExprId, Symbol};

const FORCE: Context = Context::new(Reach::Forces, "the force of an arrow");

impl Elaboration<'_> {
    /// `f at p`, or the name of a force that has a place.
    pub(super) fn arrow(
        &mut self,
        declared: &ast::Draw,
        index: Option<i64>,
        draw: &mut Draw,
    ) -> Option<()> {
        let force = &declared.places[0];
        let components = match &declared.at {
            Some(place) => {
                let value = self.value(place, PLACE)?;
                self.places(&value, place.extent, &mut draw.places)?;
                let found = self.value(force, FORCE)?;
                let components = found
                    .vector()
                    .filter(|components| components.len() == draw.places[0].len());
                if found.length().is_none() {
                    self.sink
                        .report(Code::ScalarForList, force.extent, &[&AS_ITS_PLACE]);
                } else if components.is_none() {
                    let (given, needed) = (found.length().unwrap_or(1), draw.places[0].len());
                    self.sink
                        .report(Code::Lengths, force.extent, &[&given, &needed]);
                }
                components?
            }
            None => {
                let load = self.placed(force)?;
                let (components, place) = placed_force(&self.system, load).unzip();
                draw.loads.push(load);
                let place: Vec<Value> = place.into_iter().flatten().map(Value::Scalar).collect();
                self.places(&Value::List(place), force.extent, &mut draw.places)?;
                components?
            }
        };
        self.parts(&components, force, draw)?;
        draw.name = match (&declared.name, index) {
            (Some(name), None) => name.text.clone(),
            (Some(name), Some(k)) => item_name(name, Some((k, 0, 0))).text,
            (None, _) => self.named_after(draw),
        };
        if draw.name.is_empty() {
            let word = &declared.word;
            self.sink
                .report(Code::MissingPart, word, &[&word.text, &"name", &"name = …"]);
            return None;
        }
        Some(())
    }

    /// The force of this name, if it acts at a place.
    fn placed(&mut self, force: &Expr) -> Option<usize> {
        let named = force.as_reference().filter(|reference| {
            let entry = self.names.get(&reference.name.text);
            entry.is_none_or(|entry| entry.kind == Kind::Force)
        });
        let found = match named {
            Some(reference) => Some(self.item(&reference, &[Kind::Force])?.1),
            None => None,
        };
        let placed = found.filter(|load| placed_force(&self.system, *load).is_some());
        if placed.is_none() {
            let add = "at (x, y)";
            self.sink
                .report(Code::MissingPart, force.extent, &[&"arrow", &"place", &add]);
        }
        placed
    }

    /// A force as a sum over the multipliers.
    fn parts(&mut self, components: &[ExprId], force: &Expr, draw: &mut Draw) -> Option<()> {
        let pool = &self.system.pool;
        let contained: Vec<Symbol> = components.iter().flat_map(|&e| pool.symbols(e)).collect();
        let multipliers = self.system.multipliers();
        let (rows, acting): (Vec<usize>, Vec<Symbol>) = (multipliers.iter().copied())
            .enumerate()
            .filter(|(_, multiplier)| contained.contains(multiplier))
            .unzip();
        let mut columns: Vec<Vec<ExprId>> = vec![Vec::new(); rows.len()];
        for &component in components {
            let nonlinear = self.nonlinear_in(component, &multipliers);
            let split = self
                .system
                .pool
                .coefficients_linear(component, &acting)
                .filter(|_| nonlinear.is_none());
            let Some((slopes, rest)) = split else {
                let name = nonlinear.map(|symbol| self.system.pool.name(symbol).to_owned());
                let name = name.unwrap_or_default();
                self.sink
                    .report(Code::ForceNotLinear, force.extent, &[&name]);
                return None;
            };
            for (column, slope) in columns.iter_mut().zip(slopes) {
                column.push(slope);
            }
            draw.applied.push(rest);
        }
        draw.parts = rows.into_iter().zip(columns).collect();
        for (load, force) in self.system.forces.iter().enumerate() {
            if contained.contains(&force.force) && !draw.loads.contains(&load) {
                draw.loads.push(load);
            }
        }
        Some(())
    }

    /// The names of the items whose forces an arrow shows.
    fn named_after(&self, draw: &Draw) -> String {
        let system = &self.system;
        let constraints = system.constraints.iter().map(|constraint| &constraint.name);
        let contacts = system.contacts.iter().map(|contact| &contact.name);
        let frictions = system.frictions.iter().flat_map(|friction| {
            let components = friction.slip.iter();
            components.map(|_| &friction.name)
        });
        let rows: Vec<_> = constraints.chain(contacts).chain(frictions).collect();
        let loads = draw.loads.iter().map(|load| &system.forces[*load].name);
        let rows = draw.parts.iter().map(|(row, _)| rows[*row]);
        let mut names: Vec<&str> = rows.chain(loads).map(|name| name.text.as_str()).collect();
        names.dedup();
        // Several elements of one item are together called as the item.
        let stem = |name: &str| name.split('[').next().unwrap_or_default().to_string();
        let mut called: Vec<String> = names
            .iter()
            .map(|name| {
                match names
                    .iter()
                    .filter(|other| stem(other) == stem(name))
                    .count()
                {
                    1 => name.to_string(),
                    _ => stem(name),
                }
            })
            .collect();
        called.dedup();
        called.join(" + ")
    }
}

/// The components of a force, and of the place at which it acts.
pub(in crate::model) fn placed_force(
    system: &System,
    load: usize,
) -> Option<(Vec<ExprId>, Vec<ExprId>)> {
    let components = &system.forces[load].components;
    let placed = components.iter().map(|&(f, worked)| match worked {
        Worked::Point(p) => Some((f, p)),
        _ => None,
    });
    placed
        .collect::<Option<Vec<_>>>()
        .map(|all| all.into_iter().unzip())
}
