//! Applied forces by virtual work: Q·δq = f·δp at a point p, or Q = f ∂s/∂v along a velocity s; dissipation.

use super::depth::{Context, Depth, NORMAL_FORCE, Reach};
use super::elaboration::Elaboration;
use super::meaning::Kind;
use super::value::{Value, norm};
use super::{Dissipation, Force, Worked};
use crate::ast::{self, Action, Expr, Name};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::{ExprId, Symbol};

const FORCE: Context = Context::new(Reach::Loads, "a force");
const POINT: Context = Context::new(Reach::Positions, "a point");
const SPEED: Context = Context::new(Reach::Motion, "a velocity");
const DISSIPATION: Context = Context::new(Reach::Loads, "a dissipation");

/// Where the names of items stand for their forces.
pub const FORCES_STAND: &str = "`force`, `dissipation` and a `define` for them may contain contacts and constraints; every output may contain all";

/// What is said of a force that is one number where its place is a list.
pub(super) const AS_ITS_PLACE: &str =
    "a force has as many components as the place where it acts: `(f, 0) at (x, y)`";

impl Elaboration<'_> {
    pub fn force(&mut self, declared: &ast::Force) {
        self.each(&declared.head, |this, name| {
            let (components, at) = match &declared.action {
                Action::Generalized(coordinate, value) => {
                    let (index, force) = (this.coordinate(coordinate), this.scalar(value, FORCE));
                    let (index, force) = (index?, force?);
                    (vec![(force, Worked::Coordinate(index))], value.extent)
                }
                Action::At(force, point) => (this.at_point(force, point)?, force.extent),
                Action::Along(force, speed) => (vec![this.along(force, speed)?], force.extent),
            };
            let generalized = this.project(&components);
            let value = match components.as_slice() {
                &[(only, _)] => only,
                components => {
                    let f: Vec<ExprId> = components.iter().map(|&(f, _)| f).collect();
                    norm(&mut this.system.pool, &f)
                }
            };
            let along: Vec<ExprId> = generalized.iter().map(|&(_, q)| q).collect();
            this.linear_in_forces(&along, at)?;
            let force = this.symbol(&name.text, Depth::Force);
            this.system.forces.push(Force {
                name,
                value,
                generalized,
                components,
                force,
            });
            Some(this.system.forces.len() - 1)
        });
    }

    /// Each component with that of its point.
    fn at_point(&mut self, force: &Expr, point: &Expr) -> Option<Vec<(ExprId, Worked)>> {
        let (f, p) = (self.value(force, FORCE), self.value(point, POINT));
        let (f, p) = (f?, p?);
        if f.length().is_none() && p.length().is_some() {
            self.sink
                .report(Code::ScalarForList, force.extent, &[&AS_ITS_PLACE]);
            return None;
        }
        if f.length() != p.length() {
            let count = |value: &Value| value.length().unwrap_or(1);
            self.sink
                .report(Code::Lengths, point.extent, &[&count(&f), &count(&p)]);
            return None;
        }
        let (f, p) = (f.scalars(), p.scalars());
        if self.depth(&p) < Depth::Position {
            let hint =
                "a fixed point does no work: write the point where the force acts in coordinates";
            self.sink.report(
                Code::ConstrainsNothing,
                point.extent,
                &[&"point", &"coordinate", &hint],
            );
            return None;
        }
        let components = f.iter().zip(&p);
        Some(components.map(|(&f, &p)| (f, Worked::Point(p))).collect())
    }

    /// The force and the velocity along which it acts.
    fn along(&mut self, force: &Expr, speed: &Expr) -> Option<(ExprId, Worked)> {
        let (f, s) = (self.scalar(force, FORCE), self.scalar(speed, SPEED));
        let (f, s) = (f?, s?);
        if self.depth(&[s]) < Depth::Velocity {
            let hint = "`along` takes a velocity: write it with `der(…)`";
            self.sink.report(
                Code::ConstrainsNothing,
                speed.extent,
                &[&"direction", &"velocity", &hint],
            );
            return None;
        }
        Some((f, Worked::Speed(s)))
    }

    /// Qⱼ = Σ fᵢ ∂pᵢ/∂qⱼ, or f ∂s/∂vⱼ along a velocity; zeros left out.
    fn project(&mut self, components: &[(ExprId, Worked)]) -> Vec<(usize, ExprId)> {
        if let &[(force, Worked::Coordinate(index))] = components {
            return vec![(index, force)];
        }
        let mut generalized = Vec::new();
        for j in 0..self.system.coordinates.len() {
            let moved = self.system.moved(j);
            let velocity = self.system.coordinates[j].velocity;
            let pool = &mut self.system.pool;
            let terms: Vec<ExprId> = components
                .iter()
                .map(|&(f, worked)| {
                    let slope = match worked {
                        Worked::Point(p) => pool.derivative_along(p, &moved),
                        Worked::Speed(s) => pool.differentiate(s, velocity),
                        Worked::Coordinate(index) => pool.integer(i64::from(index == j)),
                    };
                    pool.mul(f, slope)
                })
                .collect();
            let component = pool.sum(&terms);
            if !pool.is_zero(component) {
                generalized.push((j, component));
            }
        }
        generalized
    }

    fn linear_in_forces(&mut self, components: &[ExprId], at: Extent) -> Option<()> {
        let constraints = self
            .system
            .constraints
            .iter()
            .map(|constraint| constraint.force);
        let forces: Vec<Symbol> = self
            .system
            .contacts
            .iter()
            .map(|contact| contact.force)
            .chain(constraints)
            .collect();
        for &component in components {
            if let Some(force) = self.nonlinear_in(component, &forces) {
                let force = self.system.pool.name(force).to_string();
                self.sink.report(Code::ForceNotLinear, at, &[&force]);
                return None;
            }
        }
        Some(())
    }

    pub fn dissipation(&mut self, declared: &ast::Dissipation) {
        self.each(&declared.head, |this, name| {
            let rayleigh = this.scalar(&declared.value, DISSIPATION)?;
            let symbols = this.system.pool.symbols(rayleigh);
            let is_velocity = |symbol: &Symbol| this.depths[symbol.index()] == Depth::Velocity;
            if !symbols.iter().any(is_velocity) {
                let hint = "a dissipation is half a power: `c/2 * der(x)^2`";
                let at = declared.value.extent;
                this.sink.report(
                    Code::ConstrainsNothing,
                    at,
                    &[&"dissipation", &"velocity", &hint],
                );
                return None;
            }
            this.linear_in_forces(&[rayleigh], declared.value.extent)?;
            this.system
                .dissipations
                .push(Dissipation { name, rayleigh });
            Some(this.system.dissipations.len() - 1)
        });
    }

    /// Whether an item's name may stand for its force here.
    pub fn admit_item(&mut self, name: &Name, kind: Kind, context: Context) -> Option<()> {
        // Where a definition is used decides whether a force may stand there.
        let in_load = matches!(context.reach, Reach::Loads | Reach::Definition)
            && matches!(kind, Kind::Contact | Kind::Constraint);
        if !kind.has_force() {
            let hint = "its name is for the run and its report; write the expression itself, or a `define`";
            self.sink
                .report(Code::Unusable, name, &[&name.text, &kind.text(), &hint]);
            return None;
        }
        if !in_load && !matches!(context.reach, Reach::Forces | Reach::Outputs) {
            let hint = match (context.what, kind) {
                (NORMAL_FORCE, Kind::Contact | Kind::Constraint) => format!(
                    "friction names what presses: `friction(… on {}: slip = …, static = …)`",
                    name.text
                ),
                _ => FORCES_STAND.to_owned(),
            };
            self.sink
                .report(Code::ForceHere, name, &[&name.text, &kind.text(), &hint]);
            return None;
        }
        Some(())
    }

    /// What the name of an item that has been admitted stands for.
    pub fn force_of(&mut self, kind: Kind, element: usize) -> Value {
        let system = &mut self.system;
        let pool = &mut system.pool;
        Value::Scalar(match kind {
            Kind::Constraint => pool.leaf(system.constraints[element].force),
            Kind::Force => pool.leaf(system.forces[element].force),
            Kind::Contact => {
                let contact = &system.contacts[element];
                let multiplier = pool.leaf(contact.force);
                match contact.normal_factor {
                    None => multiplier,
                    Some(factor) => pool.mul(multiplier, factor),
                }
            }
            _ => match system.frictions[element].slip.as_slice() {
                [(_, force)] => pool.leaf(*force),
                components => {
                    let forces = components
                        .iter()
                        .map(|(_, force)| Value::Scalar(pool.leaf(*force)));
                    return Value::List(forces.collect());
                }
            },
        })
    }
}
