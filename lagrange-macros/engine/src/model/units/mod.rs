//! Units: read from their texts, inferred where they are not given, checked in every item, and told for every output.
//!
//! * As soon as one field or coordinate has a unit other than a plain number or angle, everything is checked. Without
//!   any, nothing is.
//! * A field or coordinate without a unit is an unknown, and found from what it is added to, compared with, or an energy
//!   of; what stays free fits everything.
//! * Numbers are plain numbers, `0` fits everything, `t` is in s, angles are plain numbers. In starts, stops, marks and
//!   regions, which describe a run, a value that is nothing but a number is in the unit that belongs there.
//! * Energies are in J. Where no given unit contains kg, they may all be per unit of mass instead (a hint says so); of two readings with mistakes
//!   the one with fewer is told.
//! * Units are coherent: a multiple like `mm` is refused, since numbers are never converted.

mod agree;
mod calls;
mod check;
mod contacts;
mod dimension;
mod draws;
mod grammar;
mod infer;
mod names;
mod quantity;
mod refusal;
mod remedy;
mod shape;
mod table;
#[cfg(test)]
mod tests;

use super::elaboration::Elaboration;
use super::{Hint, Units};
use crate::ast::{self, Declaration, ItemKind, Name};
use crate::diagnostics::{Code, Diagnostics};
use crate::sorted::SortedMap;
use crate::symbolic::Function::{Acos, Asin, Atan, Atan2};
use crate::symbolic::{ExprId, Node};
use check::{Checker, Forces};
use dimension::Dimension;
use grammar::Unit;
use quantity::{Quantity, Unknowns};
use refusal::Refusal;
use shape::Shape;

/// A name with its number of elements and its unit.
struct Given<'a> {
    name: &'a Name,
    length: Option<usize>,
    unit: Option<Unit>,
}

/// The texts of units by name, where there are any.
fn texts<'a>(
    given: &[Given<'a>],
    text: impl Fn(&Given) -> Option<String>,
) -> SortedMap<&'a str, String> {
    let named = |one: &Given<'a>| Some((one.name.text.as_str(), text(one)?));
    given.iter().filter_map(named).collect()
}

impl Elaboration<'_> {
    /// Checks the units of a declaration without mistakes, and writes down those of all quantities.
    pub fn units(&mut self, declaration: &Declaration) {
        let before = self.sink.count();
        let given = self.given(declaration);
        if self.sink.count() > before {
            return;
        }
        // Units in the words of the declaration.
        let words = |one: &Given| Some(one.unit.as_ref()?.text.clone());
        self.write(&texts(&given, words));
        let dimensions = || {
            given
                .iter()
                .filter_map(|one| Some(one.unit.as_ref()?.dimension))
        };
        if dimensions().all(Dimension::is_one) {
            return;
        }
        let per_mass = !dimensions().any(Dimension::has_mass);
        let mut mistakes = self.check_units(declaration, &given, false);
        if mistakes.is_empty() {
            return;
        }
        if per_mass {
            let others = self.check_units(declaration, &given, true);
            if others.is_empty() {
                let text = format!(
                    "energies are in {}, not in J; forces are in units that follow from that",
                    self.system.units.energy
                );
                let extent = (&declaration.name).into();
                self.system.hints.push(Hint { text, extent });
                return;
            }
            // What is meant is the reading with fewer mistakes: a single one elsewhere does not make the energies wrong.
            if others.count() < mistakes.count() {
                mistakes = others;
            }
        }
        self.sink.append(mistakes);
    }

    /// The units as declared.
    fn given<'a>(&mut self, declaration: &'a Declaration) -> Vec<Given<'a>> {
        let mut given = Vec::new();
        for field in &declaration.fields {
            let (name, length) = (&field.name, field.length);
            let unit = self.unit(field.unit.as_ref());
            given.push(Given { name, length, unit });
        }
        for item in &declaration.items {
            match &item.kind {
                ItemKind::Coordinates(coordinates) => {
                    for coordinate in coordinates {
                        let name = &coordinate.name;
                        let length = self.coordinate_names.get(&name.text);
                        let length = length.and_then(|(_, length)| *length);
                        let unit = self.unit(coordinate.unit.as_ref());
                        given.push(Given { name, length, unit });
                    }
                }
                ItemKind::Attitude(attitude) => given.push(Given {
                    name: &attitude.coordinates,
                    length: Some(4),
                    unit: Some(Unit {
                        dimension: Dimension::ONE,
                        text: String::new(),
                    }),
                }),
                _ => {}
            }
        }
        given
    }

    fn unit(&mut self, written: Option<&ast::Unit>) -> Option<Unit> {
        let ast::Unit { text, extent } = written?;
        match grammar::unit(text) {
            Ok(unit) => return Some(unit),
            Err(Refusal::Unknown(symbol, hint)) => {
                self.sink
                    .report(Code::UnknownUnit, *extent, &[&symbol, &hint]);
            }
            Err(Refusal::Multiple(coherent)) => {
                self.sink
                    .report(Code::UnitMultiple, *extent, &[text, &coherent]);
            }
            Err(Refusal::Form(what, hint)) => {
                self.sink.report(Code::UnitForm, *extent, &[&what, &hint]);
            }
        }
        None
    }

    /// The units of fields and coordinates become these texts, by name.
    fn write(&mut self, texts: &SortedMap<&str, String>) {
        let system = &mut self.system;
        for parameter in &mut system.parameters {
            if let Some(text) = texts.get(super::names::plain(&parameter.field).as_str()) {
                parameter.unit.clone_from(text);
            }
        }
        for (name, text) in texts {
            if let Some(&(first, length)) = self.coordinate_names.get(*name) {
                let coordinates = system.coordinates.iter_mut().skip(first);
                for coordinate in coordinates.take(length.unwrap_or(1)) {
                    coordinate.unit.clone_from(text);
                }
            }
        }
    }

    /// Checks all items; if nothing is wrong, writes down what follows.
    fn check_units(
        &mut self,
        declaration: &Declaration,
        given: &[Given],
        per_mass: bool,
    ) -> Diagnostics {
        let mut unknowns = Unknowns::default();
        let (mut names, mut inferred) = (SortedMap::new(), SortedMap::new());
        for one in given {
            let quantity: Quantity = match &one.unit {
                Some(unit) => unit.dimension.into(),
                None => {
                    let unknown = unknowns.fresh(&one.name.text);
                    inferred.insert(one.name.text.clone(), unknown.clone());
                    unknown
                }
            };
            let shape = match one.length {
                None => Shape::One(quantity),
                Some(length) => Shape::List(vec![Shape::One(quantity); length]),
            };
            names.insert(one.name.text.clone(), Some(shape));
        }
        let energy = match per_mass {
            false => Dimension::ENERGY.into(),
            true => unknowns.fresh("energy"),
        };
        let before = self.sink.count();
        let mut checker = Checker {
            elaboration: self,
            sink: Diagnostics::new(),
            unknowns,
            names,
            inferred,
            energy,
            forces: Forces::default(),
            gaps: SortedMap::new(),
            slips: SortedMap::new(),
        };
        checker.items(declaration);
        let Checker {
            sink,
            unknowns,
            names,
            energy,
            forces,
            ..
        } = checker;
        if sink.is_empty() && self.sink.count() == before {
            let found = |one: &Given| {
                let shape = names.get(&one.name.text)?.as_ref()?;
                Some(unknowns.dimension(shape.quantities().first()?)?.text())
            };
            self.write(&texts(given, |one| match one.unit {
                None => found(one),
                Some(_) => None,
            }));
            self.system.units = self.outputs(&unknowns, &names, &energy, &forces);
        }
        sink
    }

    /// Units of everything that a run reports.
    fn outputs(
        &mut self,
        unknowns: &Unknowns,
        names: &SortedMap<String, Option<Shape>>,
        energy: &Quantity,
        forces: &Forces,
    ) -> Units {
        let text = |quantity: &Quantity| unknowns.dimension(quantity).map(Dimension::text);
        let force = |quantity: Option<&Quantity>| {
            let dimension = quantity.and_then(|quantity| unknowns.dimension(quantity));
            dimension.map(Dimension::as_force).unwrap_or_default()
        };
        let system = &self.system;
        let all = |found: &SortedMap<usize, Quantity>, count: usize| -> Vec<String> {
            (0..count).map(|k| force(found.get(&k))).collect()
        };
        let frictions = (0..system.frictions.len()).map(|k| {
            let components = forces.frictions.get(&k);
            force(components.and_then(|components| components.first()))
        });
        let observes = system.observes.iter().map(|observe| {
            let name = observe.name.ident.as_ref().map(super::names::plain)?;
            let position = observe.name.element.map_or(0, |(position, _)| position);
            let declared = self.declared(&name, position);
            if declared.is_some() {
                return declared;
            }
            let shape = match names.get(&name) {
                Some(shape) => shape.clone()?,
                None => {
                    let Some(super::meaning::Entry {
                        kind,
                        meaning: super::meaning::Meaning::Item { elements, .. },
                    }) = self.names.get(&name)
                    else {
                        return None;
                    };
                    let shape = forces.of(*kind, *elements.get(position).or(elements.first())?)?;
                    return Some(force(
                        shape
                            .quantities()
                            .get(position)
                            .or(shape.quantities().first()),
                    ));
                }
            };
            let angle = self.angle(observe.value).map(str::to_owned);
            angle.or_else(|| text(shape.quantities().get(position)?))
        });
        Units {
            energy: text(energy).unwrap_or_default(),
            constraints: all(&forces.constraints, system.constraints.len()),
            contacts: all(&forces.contacts, system.contacts.len()),
            frictions: frictions.collect(),
            forces: all(&forces.forces, system.forces.len()),
            dissipations: all(&forces.dissipations, system.dissipations.len()),
            observes: observes.map(Option::unwrap_or_default).collect(),
        }
    }

    /// The unit of an angle, which is a coordinate or what `atan2` and its like give, of its velocity or of its acceleration, and of sums and
    /// differences of several: `rad`, `rad/s`, `rad/s²`.
    /// What is multiplied by a number may be no angle any more, but an arc or degrees.
    fn angle(&self, value: ExprId) -> Option<&'static str> {
        let pool = &self.system.pool;
        let unit = |term: ExprId| {
            let symbol = match pool.node(term) {
                Node::Symbol(symbol) => symbol,
                Node::Call(Asin | Acos | Atan | Atan2, _) => return Some("rad"),
                _ => return None,
            };
            let mut angles = self.system.coordinates.iter().filter(|c| c.unit == "rad");
            angles.find_map(|c| {
                let all = [
                    (c.position, "rad"),
                    (c.velocity, "rad/s"),
                    (c.acceleration, "rad/s²"),
                ];
                all.iter()
                    .find(|(of, _)| of == symbol)
                    .map(|(_, unit)| *unit)
            })
        };
        let Node::Sum { terms, .. } = pool.node(value) else {
            return unit(value);
        };
        let moving = (terms.iter()).filter(|(term, _)| pool.as_multiple_of_pi(*term).is_none());
        let mut units = moving.map(|&(term, c)| if c.is_unit() { unit(term) } else { None });
        let first = units.next()??;
        units.all(|other| other == Some(first)).then_some(first)
    }

    /// The unit of a field or coordinate as it has been written down.
    fn declared(&self, name: &str, position: usize) -> Option<String> {
        if let Some(&(first, _)) = self.coordinate_names.get(name) {
            let coordinate = self.system.coordinates.get(first + position)?;
            return Some(coordinate.unit.clone());
        }
        let parameters = &self.system.parameters;
        let found = parameters
            .iter()
            .find(|parameter| super::names::plain(&parameter.field) == name)?;
        Some(found.unit.clone())
    }
}
