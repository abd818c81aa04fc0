//! The units of all items of a declaration.
//!
//! ```text
//! energies            E (J)                 dissipation   E/s
//! gap of a contact    any unit u            its force     E/u
//! constraint          any unit u            its force     E/u on positions, E s⁻¹/u on velocities
//! slip                u                     its force     E s⁻¹/u; on a contact: gap in m, slip in m/s
//! force along x       E/x                   (fx, fy) at (px, py): fᵢ in E/pᵢ; f along s: E s⁻¹/s
//! ```

use super::dimension::Dimension;
use super::quantity::{Quantity, Unknowns};
use super::shape::{Role, Shape};
use crate::ast::{
    self, Action, Clause, Declaration, Expr, Head, ItemKind, Observe, Reference, Trigger,
};
use crate::diagnostics::Diagnostics;
use crate::model::Level;
use crate::model::elaboration::Elaboration;
use crate::model::meaning::{Kind, Meaning};
use crate::sorted::SortedMap;
use crate::symbolic::Rational;

/// Units of the forces of items, by their place in the system's lists.
#[derive(Default)]
pub(super) struct Forces {
    /// Of a multiplier.
    pub constraints: SortedMap<usize, Quantity>,
    /// Of a multiplier.
    pub contacts: SortedMap<usize, Quantity>,
    /// Of the normal force, if it is not the multiplier.
    pub normals: SortedMap<usize, Quantity>,
    /// Per component.
    pub frictions: SortedMap<usize, Vec<Quantity>>,
    pub forces: SortedMap<usize, Quantity>,
    /// R
    pub dissipations: SortedMap<usize, Quantity>,
}

impl Forces {
    /// What the name of an item stands for.
    pub fn of(&self, kind: Kind, element: usize) -> Option<Shape> {
        let one = |quantity: Option<&Quantity>| quantity.cloned().map(Shape::One);
        match kind {
            Kind::Constraint => one(self.constraints.get(&element)),
            Kind::Contact => {
                let normal = self.normals.get(&element);
                one(normal.or(self.contacts.get(&element)))
            }
            Kind::Force => one(self.forces.get(&element)),
            _ => {
                let mut components = self.frictions.get(&element)?.clone();
                Some(match components.len() {
                    1 => Shape::One(components.pop()?),
                    _ => Shape::List(components.into_iter().map(Shape::One).collect()),
                })
            }
        }
    }
}

/// Units on their way.
pub(super) struct Checker<'a, 'b> {
    pub elaboration: &'a mut Elaboration<'b>,
    pub sink: Diagnostics,
    pub unknowns: Unknowns,
    /// Of fields, coordinates and definitions; `None` after a mistake.
    pub names: SortedMap<String, Option<Shape>>,
    /// Of fields and coordinates without a unit.
    pub inferred: SortedMap<String, Quantity>,
    /// E
    pub energy: Quantity,
    pub forces: Forces,
    /// Of gaps, by contact.
    pub gaps: SortedMap<usize, Quantity>,
    /// Of slips, by friction.
    pub slips: SortedMap<usize, Shape>,
}

impl Checker<'_, '_> {
    /// All items, in the order in which they need each other.
    pub fn items(&mut self, declaration: &Declaration) {
        for pass in 0..9 {
            for item in &declaration.items {
                self.item(&item.kind, pass);
            }
        }
        for definition in self.elaboration.definitions.clone() {
            let name = &definition.head.name.text;
            if !self.names.contains_key(name) {
                self.definition(name);
            }
        }
    }

    /// One item in its pass. What is wrong has been reported, so the result does not matter.
    fn item(&mut self, item: &ItemKind, pass: usize) -> Option<()> {
        let energy = self.energy.clone();
        match (pass, item) {
            (0, ItemKind::Lagrangian(value)) => self.expect(value, &energy, "a Lagrangian"),
            (0, ItemKind::Kinetic(term)) => self.energy_term(term, "a kinetic energy"),
            (0, ItemKind::Potential(term)) => self.energy_term(term, "a potential energy"),
            (1, ItemKind::Contact(contact)) => self.each(&contact.head, |this, element| {
                this.contact(contact, element)
            }),
            (2, ItemKind::Attitude(attitude)) => {
                for element in self.elements(&attitude.body.text) {
                    self.forces.constraints.insert(element, energy.clone());
                }
                Some(())
            }
            (2, ItemKind::Constraint(item)) => {
                self.each(&item.head, |this, element| this.constraint(item, element))
            }
            (3, ItemKind::Friction(friction)) => self.each(&friction.head, |this, element| {
                this.friction(friction, element)
            }),
            (4, ItemKind::Force(force)) => {
                self.each(&force.head, |this, element| this.force(force, element))
            }
            (4, ItemKind::Dissipation(item)) => {
                let power = self.times_time(&energy, -1);
                self.each(&item.head, |this, element| {
                    this.forces.dissipations.insert(element, power.clone());
                    this.expect(&item.value, &power, "a dissipation")
                })
            }
            (5, ItemKind::Start(start)) => self.each(&start.head, |this, _| {
                for value in &start.values {
                    this.start_value(value)?;
                }
                Some(())
            }),
            (6, ItemKind::Observe(observes)) => {
                for observe in observes {
                    if let Observe::New(head, _) = observe
                        && !self.names.contains_key(&head.name.text)
                    {
                        self.definition(&head.name.text);
                    }
                }
                Some(())
            }
            (7, ItemKind::Stop(watch) | ItemKind::Mark(watch)) => {
                self.each(&watch.head, |this, _| this.trigger(&watch.trigger))
            }
            (8, ItemKind::Check(check)) => self.check(check),
            (8, ItemKind::Draw(draw)) => self.indexed(draw.index.as_ref(), |this| this.draw(draw)),
            _ => Some(()),
        }
    }

    fn constraint(&mut self, constraint: &ast::Constraint, element: usize) -> Option<()> {
        let residual = self.sides(&constraint.left, &constraint.right)?;
        let energy = self.energy.clone();
        let work = match self.elaboration.system.constraints.get(element)?.level {
            Level::Position => energy,
            Level::Velocity => self.times_time(&energy, -1),
        };
        let force = self.unknowns.times(&work, &residual, Rational::MINUS_ONE);
        self.forces.constraints.insert(element, force);
        Some(())
    }

    fn trigger(&mut self, trigger: &Trigger) -> Option<()> {
        match trigger {
            Trigger::Zero(value) => self.one(value, None).map(|_| ()),
            Trigger::All(clauses) => clauses.iter().try_for_each(|clause| match clause {
                Clause::Comparison(comparison) => self.loosely(comparison).map(|_| ()),
                _ => Some(()),
            }),
        }
    }

    /// Both sides of a claim and of its premises.
    fn check(&mut self, check: &ast::Check) -> Option<()> {
        let index = check.head.as_ref().and_then(|head| head.index.as_ref());
        self.indexed(index, |this| this.claim(check))
    }

    /// Runs `body` for every value of an index, if there is one.
    fn indexed(
        &mut self,
        index: Option<&ast::Index>,
        mut body: impl FnMut(&mut Self) -> Option<()>,
    ) -> Option<()> {
        let Some(index) = index else {
            return body(self);
        };
        let (from, to) = self.elaboration.bounds(&index.range)?;
        (from..to).try_for_each(|k| self.with_index(&index.name, k, |this| body(this)))
    }

    fn claim(&mut self, check: &ast::Check) -> Option<()> {
        match &check.claim {
            ast::Claim::Equal(left, right) => self.sides(left, right).map(|_| ())?,
            ast::Claim::Conserved(value) => self.one(value, None).map(|_| ())?,
        }
        check.premises.iter().try_for_each(|premise| match premise {
            ast::Premise::Mode(..) => Some(()),
            ast::Premise::AtLeast(comparison) => self.loosely(comparison).map(|_| ()),
            ast::Premise::Equal(left, right) => self.sides(left, right).map(|_| ()),
        })
    }

    /// The places of a name's elements in the system's list.
    fn elements(&self, name: &str) -> Vec<usize> {
        match self.elaboration.names.get(name).map(|entry| &entry.meaning) {
            Some(Meaning::Item { elements, .. }) => elements.clone(),
            _ => Vec::new(),
        }
    }

    /// Runs `body` for every element of an item, up to the first mistake.
    fn each(
        &mut self,
        head: &Head,
        mut body: impl FnMut(&mut Self, usize) -> Option<()>,
    ) -> Option<()> {
        let elements = self.elements(&head.name.text);
        match &head.index {
            None => elements
                .into_iter()
                .try_for_each(|element| body(self, element)),
            Some(index) => {
                let (from, _) = self.elaboration.bounds(&index.range)?;
                (from..).zip(elements).try_for_each(|(k, element)| {
                    self.with_index(&index.name, k, |this| body(this, element))
                })
            }
        }
    }

    fn energy_term(&mut self, term: &ast::Energy, what: &str) -> Option<()> {
        let energy = self.energy.clone();
        match &term.head {
            None => self.expect(&term.value, &energy, what),
            Some(head) => self.each(head, |this, _| this.expect(&term.value, &energy, what)),
        }
    }

    fn force(&mut self, force: &ast::Force, element: usize) -> Option<()> {
        let energy = self.energy.clone();
        let per = |this: &mut Self, work: &Quantity, along: &Quantity| {
            this.unknowns.times(work, along, Rational::MINUS_ONE)
        };
        let unit = match &force.action {
            Action::Generalized(reference, value) => {
                let coordinate = self.coordinate(reference)?;
                let unit = per(self, &energy, &coordinate);
                let what = format!("a force along `{}`", reference.name.text);
                self.forces.forces.insert(element, unit.clone());
                return self.expect(value, &unit, Role::force(&what));
            }
            Action::Along(value, speed) => {
                let speed = self.one(speed, None)?;
                let power = self.times_time(&energy, -1);
                let unit = per(self, &power, &speed);
                self.expect(value, &unit, Role::force("a force along this velocity"))?;
                unit
            }
            Action::At(value, point) => {
                let points = self.shape(point, None)?.quantities();
                let values: Vec<&Expr> = match &value.kind {
                    ast::ExprKind::List(values) => values.iter().collect(),
                    _ => vec![value],
                };
                let units: Vec<Quantity> = points
                    .iter()
                    .map(|point| per(self, &energy, point))
                    .collect();
                let what = Role::force("a force at this point");
                if values.len() == units.len() {
                    for (value, unit) in values.into_iter().zip(&units) {
                        self.expect(value, unit, what)?;
                    }
                } else {
                    let found = self.shape(value, None)?.quantities();
                    for (found, unit) in found.iter().zip(&units) {
                        self.equal(unit, found, what, value)?;
                    }
                }
                units.into_iter().next()?
            }
        };
        self.forces.forces.insert(element, unit);
        Some(())
    }

    /// The unit of a coordinate.
    pub fn coordinate(&mut self, reference: &Reference) -> Option<Quantity> {
        let shape = self.names.get(&reference.name.text)?.as_ref()?;
        shape.quantities().into_iter().next()
    }

    fn start_value(&mut self, value: &ast::StartValue) -> Option<()> {
        let name = &value.name.text;
        let coordinate = |this: &Self| {
            let shape = this.names.get(name)?.as_ref()?;
            shape.quantities().into_iter().next()
        };
        let (unit, what) = match &value.quantity {
            ast::StartQuantity::Position => (coordinate(self)?, format!("`{name}`")),
            ast::StartQuantity::Velocity => {
                let unit = coordinate(self)?;
                (self.times_time(&unit, -1), format!("`der({name})`"))
            }
            ast::StartQuantity::Member(member) => {
                let angle = Dimension::ONE.into();
                let unit = match member.text.as_str() {
                    "turn" => angle,
                    _ => self.times_time(&angle, -1),
                };
                (unit, format!("`{}`", value.place()))
            }
        };
        let expect = |this: &mut Self| this.all(&value.value, &unit, what.as_str().into());
        match &value.element {
            ast::Element::Each(index) => {
                let (from, to) = self.elaboration.bounds(&index.range)?;
                (from..to).try_for_each(|k| self.with_index(&index.name, k, expect))
            }
            _ => expect(self),
        }
    }
}
