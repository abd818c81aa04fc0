//! The units of contacts and frictions.

use super::check::Checker;
use super::dimension::Dimension;
use super::quantity::Quantity;
use super::shape::{Role, Shape};
use crate::ast::{Contact, Expr, ExprKind, Friction, FrictionLaw, Reference, Restitution};
use crate::diagnostics::Code;
use crate::model::Normal;
use crate::model::frictions::slip_as_value;
use crate::model::meaning::Kind;
use crate::symbolic::Rational;

impl Checker<'_, '_> {
    pub(super) fn contact(&mut self, contact: &Contact, element: usize) -> Option<()> {
        let gap = self.comparison(&contact.gap);
        let restitution = match &contact.restitution {
            None => Some(()),
            Some(Restitution::Newton(e) | Restitution::Poisson(e)) => {
                self.plain(e, "a restitution")
            }
        };
        let region = match &contact.region {
            None => Some(()),
            Some(region) => self.loosely(region).map(|_| ()),
        };
        let gap = gap?;
        let force = self.unknowns.times(&self.energy, &gap, Rational::MINUS_ONE);
        self.forces.contacts.insert(element, force);
        self.gaps.insert(element, gap);
        if let Some(point) = &contact.at {
            let mut components = self.shape(point, None)?.quantities().into_iter();
            let first = components.next()?;
            for component in components {
                self.equal(
                    &first,
                    &component,
                    "the first coordinate of this point",
                    point,
                )?;
            }
            let normal = self
                .unknowns
                .times(&self.energy, &first, Rational::MINUS_ONE);
            self.forces.normals.insert(element, normal);
        }
        restitution.and(region)
    }

    pub(super) fn friction(&mut self, friction: &Friction, element: usize) -> Option<()> {
        let power = self.times_time(&self.energy.clone(), -1);
        let slip = self.shape(&friction.slip, None)?;
        let components = slip.quantities();
        let forces: Vec<Quantity> = components
            .iter()
            .map(|slip| self.unknowns.times(&power, slip, Rational::MINUS_ONE))
            .collect();
        self.slips.insert(element, slip);
        self.forces.frictions.insert(element, forces.clone());
        self.one_force(&forces, &friction.slip)?;
        let normal = self.elaboration.system.frictions.get(element)?.normal;
        let pressing = match normal {
            Normal::Contact(contact) => vec![(Kind::Contact, contact)],
            _ => {
                let constraints = self.elaboration.system.pressing(normal);
                constraints.map(|i| (Kind::Constraint, i)).collect()
            }
        };
        for ((kind, item), on) in pressing.iter().zip(&friction.on) {
            self.pressed(*kind, *item, on)?;
        }
        if !pressing.is_empty() {
            let speed: Quantity = Dimension::mechanical(0, 1, -1).into();
            for slip in components {
                self.equal(&speed, &slip, "a slip", &friction.slip)?;
            }
        }
        let slip = self.slips.get(&element).cloned();
        self.names.insert("slip".to_owned(), slip);
        let components = &self.elaboration.system.frictions.get(element)?.slip;
        self.elaboration.slip = Some(slip_as_value(components));
        let law = self.friction_law(&friction.law, forces.first()?);
        self.elaboration.slip = None;
        self.names.remove("slip");
        law
    }

    /// The forces along the components of a slip have one unit.
    fn one_force(&mut self, forces: &[Quantity], slip: &Expr) -> Option<()> {
        let first = forces.first()?;
        for other in forces {
            let (one, another) = (self.unknowns.read(first)?, self.unknowns.read(other)?);
            if self.unknowns.conflict(&one, &another).is_some() {
                let what = "the force along the first component";
                let (one, another) = (self.phrase(&one, true), self.phrase(&another, true));
                let hint = "both components of a slip are velocities, in m/s";
                let arguments: [&dyn std::fmt::Display; 4] = [&what, &one, &another, &hint];
                self.mistake(Code::UnitExpected, slip.extent, &arguments);
                return None;
            }
        }
        Some(())
    }

    /// Limits are forces; coefficients are plain numbers.
    fn friction_law(&mut self, law: &FrictionLaw, force: &Quantity) -> Option<()> {
        match law {
            FrictionLaw::Limit(limit) => {
                let limits = match &limit.kind {
                    ExprKind::List(limits) => limits.as_slice(),
                    _ => std::slice::from_ref(limit),
                };
                let role = Role::force("the friction force along this slip");
                limits
                    .iter()
                    .try_for_each(|limit| self.expect(limit, force, role))
            }
            FrictionLaw::Coefficients {
                normal,
                stick,
                slide,
            } => {
                let what = "a coefficient of friction";
                let stick = self.plain(stick, what);
                let slide = slide
                    .as_ref()
                    .map_or(Some(()), |slide| self.plain(slide, what));
                let normal = normal.as_ref().map_or(Some(()), |normal| {
                    self.expect(normal, force, Role::force("the normal force for this slip"))
                });
                stick.and(slide).and(normal)
            }
        }
    }

    /// What presses is a force: the gap or the constraint is a distance.
    fn pressed(&mut self, kind: Kind, item: usize, on: &Reference) -> Option<()> {
        let Some(Shape::One(force)) = self.forces.of(kind, item) else {
            return None;
        };
        let newton =
            self.unknowns
                .times(&self.energy, &Dimension::LENGTH.into(), Rational::MINUS_ONE);
        let Some((newton, force)) = self.unknowns.conflict(&newton, &force) else {
            return Some(());
        };
        let hint = match kind {
            Kind::Contact => {
                "write the gap as a distance, in m; or say where it acts: `contact(… at (px, py))`"
            }
            _ => "write both sides of the constraint as distances, in m, or as velocities, in m/s",
        };
        let (force, newton) = (self.phrase(&force, true), self.phrase(&newton, true));
        self.mistake(
            Code::PressedBy,
            &on.name,
            &[&on.name.text, &force, &newton, &hint],
        );
        None
    }
}
