//! Declaration → [`System`]: names resolved, arrays and sums unrolled, constraints typed by level.
//!
//! Everything is an expression of one [`Pool`]. Piecewise functions (`abs sign min max if`) have become
//! selections on numbered branches; `at` and `along` have become generalized forces; `gap(c)`, `slip(f)`,
//! `momentum(x)`, `energy` in outputs have become expressions, and the name of a contact, constraint, friction
//! or force in an output the symbol of its force. Not mutable after this point, but for the pool.

mod attitude;
mod calls;
mod checks;
mod constraints;
mod contacts;
mod declare;
mod declared;
mod defaults;
mod degree;
mod depth;
mod draws;
mod elaborate;
mod elaboration;
mod energies;
mod evaluate;
mod forces;
mod frictions;
mod indices;
mod inverse;
mod lookup;
mod meaning;
mod names;
mod oriented;
mod outputs;
mod piecewise;
mod reach;
mod rows;
mod seen;
mod sided;
mod starts;
mod structure;
#[cfg(test)]
pub(crate) mod tests;
mod units;
mod value;

use crate::ast::{Domain, Emit, Impacts};
use crate::diagnostics::Extent;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};
use proc_macro2::{Ident, Span, TokenStream};

pub use checks::{Check, Premise, checks};
pub use declared::{Declared, declared};
pub use defaults::{defaults, number};
pub use draws::{Draw, Turn};
pub use elaborate::{in_body_rates, scoped, system};
pub use elaboration::Scope;
pub(crate) use names::shouting;

/// A mechanical system with all names resolved.
pub struct System {
    /// The struct.
    pub name: Ident,
    /// Doc comment of the struct.
    pub documentation: String,
    /// The scalar: `None` for plain `f64` fields, or the struct's one type parameter.
    pub scalar: Option<Ident>,
    /// Tokens of the path to lagrange-core (`::lagrange_core` unless `crate = …` is given).
    pub core: proc_macro2::TokenStream,
    /// All expressions.
    pub pool: Pool,
    /// Time t.
    pub time: Symbol,
    /// Fields, arrays flattened.
    pub parameters: Vec<Parameter>,
    /// Coordinates, arrays flattened.
    pub coordinates: Vec<Coordinate>,
    /// Bodies of `attitude` whose rates are velocities; in a system [to be read](in_body_rates) only.
    pub bodies: Vec<Body>,
    /// What scalar definitions are worth; in a system [to be read](in_body_rates) only.
    pub defined: Vec<(String, ExprId)>,
    /// Kinetic energy terms. With `lagrangian = L`: the single term L − L(v=0).
    pub kinetic: Vec<EnergyTerm>,
    /// Potential energy terms. With `lagrangian = L`: the single term −L(v=0).
    pub potential: Vec<EnergyTerm>,
    /// Whether the user gave `lagrangian`; then the energy is v·∂L/∂v − L.
    pub from_lagrangian: bool,
    /// Equality constraints.
    pub constraints: Vec<Constraint>,
    /// One-sided contacts.
    pub contacts: Vec<Contact>,
    /// Frictions.
    pub frictions: Vec<Friction>,
    /// Constraints whose forces press frictions together, as those of a bearing.
    pub resultants: Vec<Vec<usize>>,
    /// Applied forces.
    pub forces: Vec<Force>,
    /// Rayleigh dissipations.
    pub dissipations: Vec<Dissipation>,
    /// Guards of the piecewise branches: ≥ 0 selects `then`.
    pub branches: Vec<Branch>,
    /// Named starts.
    pub starts: Vec<Start>,
    /// Extra outputs.
    pub observes: Vec<Observe>,
    /// What ends a run.
    pub stops: Vec<Watch>,
    /// What is logged.
    pub marks: Vec<Watch>,
    /// What a picture shows, from the back to the front; of a system [as declared](declared) only, since no equation needs it.
    pub draws: Vec<Draw>,
    /// How simultaneous impacts are resolved.
    pub impacts: Impacts,
    /// What the equations of its modes are written as.
    pub emit: Emit,
    /// Units of what a run reports.
    pub units: Units,
    /// What is right but may not be meant.
    pub hints: Vec<Hint>,
}

impl System {
    /// What changes with coordinate i, and how fast: its position by 1, or the axes of a body with a turn.
    pub fn moved(&mut self, i: usize) -> Vec<(Symbol, ExprId)> {
        let turning = |body: &&Body| (body.first..body.first + 3).contains(&i);
        match self.bodies.iter().find(turning) {
            Some(body) => body.turned(&mut self.pool, i - body.first),
            None => vec![(self.coordinates[i].position, self.pool.integer(1))],
        }
    }

    /// A system without parameters, coordinates and items.
    pub(crate) fn empty(name: Ident, pool: Pool, time: Symbol) -> System {
        System {
            name,
            documentation: String::new(),
            scalar: None,
            core: TokenStream::new(),
            pool,
            time,
            parameters: Vec::new(),
            coordinates: Vec::new(),
            bodies: Vec::new(),
            defined: Vec::new(),
            kinetic: Vec::new(),
            potential: Vec::new(),
            from_lagrangian: false,
            constraints: Vec::new(),
            contacts: Vec::new(),
            frictions: Vec::new(),
            resultants: Vec::new(),
            forces: Vec::new(),
            dissipations: Vec::new(),
            branches: Vec::new(),
            starts: Vec::new(),
            observes: Vec::new(),
            stops: Vec::new(),
            marks: Vec::new(),
            draws: Vec::new(),
            impacts: Impacts::default(),
            emit: Emit::default(),
            units: Units::default(),
            hints: Vec::new(),
        }
    }
}

/// Units of what a run reports, beside those of parameters and coordinates; in the order of the system's lists. Empty
/// lists if no units are declared, empty texts for plain numbers and for what does not follow.
#[derive(Clone, Default, Debug)]
pub struct Units {
    /// `J`, but for energies per unit of mass.
    pub energy: String,
    /// Of multipliers.
    pub constraints: Vec<String>,
    /// Of multipliers.
    pub contacts: Vec<String>,
    /// Of the force along each slip component.
    pub frictions: Vec<String>,
    /// Of values.
    pub forces: Vec<String>,
    /// Of Rayleigh's function.
    pub dissipations: Vec<String>,
    /// Of values.
    pub observes: Vec<String>,
}

/// A remark on a declaration that is not wrong: shown with what was derived, never an error.
#[derive(Clone, Debug)]
pub struct Hint {
    /// What is to be said.
    pub text: String,
    /// What it is about.
    pub extent: Extent,
}

/// Name of an item, `rim` or `ball[3]`.
#[derive(Clone, Debug)]
pub struct ItemName {
    /// Full name with its index.
    pub text: String,
    /// Name without index, as the user wrote it (`None` for the unnamed kinetic or potential).
    pub ident: Option<Ident>,
    /// Index and number of elements of an indexed item: (k − lower bound, count).
    pub element: Option<(usize, usize)>,
    /// Where it is declared.
    pub span: Span,
}

/// A field of the struct, or one element of an array field.
pub struct Parameter {
    /// Field.
    pub field: Ident,
    /// Element of an array field.
    pub element: Option<usize>,
    /// `mass` or `length[2]`.
    pub name: String,
    /// Its symbol.
    pub symbol: Symbol,
    /// Doc comment.
    pub documentation: String,
    /// As declared or inferred; empty for a plain number and where nothing is known.
    pub unit: String,
    /// `#[lagrange(tex = …)]`, or empty.
    pub tex: String,
    /// `#[lagrange(symbol = …)]`, or empty: how printers name it.
    pub letter: String,
    /// `#[lagrange(domain = …)]`
    pub domain: Option<Domain>,
}

/// A generalized coordinate.
pub struct Coordinate {
    /// Name (with index).
    pub name: ItemName,
    /// q
    pub position: Symbol,
    /// v = dq/dt
    pub velocity: Symbol,
    /// dv/dt, in outputs after the solve only.
    pub acceleration: Symbol,
    /// As declared or inferred; empty for a plain number and where nothing is known.
    pub unit: String,
}

/// A body whose orientation is known by its axes, and whose velocities are the rates ωₖ about them. They are the rates of
/// no coordinates; three coordinates of the system, the turns of the body, have them as velocities all the same.
pub struct Body {
    /// Its name in `attitude`.
    pub name: String,
    /// The first of its three turns.
    pub first: usize,
    /// Component j in space of axis i.
    pub axes: [[Symbol; 3]; 3],
}

impl Body {
    /// What a turn about axis k changes: ėᵢ = ω × eᵢ, so that e₁ turns to e₂ about e₀.
    pub fn turned(&self, pool: &mut Pool, k: usize) -> Vec<(Symbol, ExprId)> {
        let [next, last] = [(k + 1) % 3, (k + 2) % 3];
        let mut turned = Vec::new();
        for j in 0..3 {
            let [towards, away] = [self.axes[last][j], self.axes[next][j]].map(|e| pool.leaf(e));
            turned.push((self.axes[next][j], towards));
            turned.push((self.axes[last][j], pool.neg(away)));
        }
        turned
    }

    /// Rates of the axes: ėᵢ = ω × eᵢ.
    pub fn rates(&self, pool: &mut Pool, rates: [Symbol; 3]) -> Vec<(Symbol, ExprId)> {
        let mut terms: SortedMap<Symbol, Vec<ExprId>> = SortedMap::new();
        for (k, rate) in rates.into_iter().enumerate() {
            for (axis, slope) in self.turned(pool, k) {
                let rate = pool.leaf(rate);
                let term = pool.mul(slope, rate);
                terms.get_or_default(axis).push(term);
            }
        }
        let sums = terms.into_iter();
        sums.map(|(axis, terms)| (axis, pool.sum(&terms))).collect()
    }
}

/// A term of the kinetic or potential energy.
pub struct EnergyTerm {
    /// Name; unnamed terms cannot be left out.
    pub name: ItemName,
    /// The energy, J.
    pub energy: ExprId,
}

/// Level at which a constraint is given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Level {
    /// g(q,t) = 0
    Position,
    /// a(q,t) v + b(q,t) = 0; linearity has been checked.
    Velocity,
}

/// An equality constraint `residual = 0`, residual = left − right.
pub struct Constraint {
    /// Name.
    pub name: ItemName,
    /// Level.
    pub level: Level,
    /// left − right
    pub residual: ExprId,
    /// Index of the contact without which it does not hold (velocity level then).
    pub while_contact: Option<usize>,
    /// The first of four coordinates, if it keeps the quaternion of an attitude at unit length.
    pub attitude: Option<usize>,
    /// Symbol of its multiplier in outputs and forces.
    pub force: Symbol,
}

/// A one-sided contact gap ≥ 0.
pub struct Contact {
    /// Name.
    pub name: ItemName,
    /// left − right (of `>=`)
    pub gap: ExprId,
    /// |∂gap/∂p| where `at p` is declared.
    pub normal_factor: Option<ExprId>,
    /// Law of impact.
    pub restitution: Restitution,
    /// `where c >= d`: c − d.
    pub region: Option<ExprId>,
    /// Symbol of its multiplier.
    pub force: Symbol,
}

/// Law of impact.
#[derive(Clone, Copy)]
pub enum Restitution {
    /// Newton's: v⁺ = −e v⁻.
    Newton(ExprId),
    /// Poisson's.
    Poisson(ExprId),
}

/// Coulomb friction.
pub struct Friction {
    /// Name.
    pub name: ItemName,
    /// Slip velocity, one or two components, linear in the velocities (checked), with the symbol of the force along each.
    pub slip: Vec<(ExprId, Symbol)>,
    /// Where the normal force comes from.
    pub normal: Normal,
    /// μs (or the static limit)
    pub static_coefficient: ExprId,
    /// μk (or the kinetic limit)
    pub kinetic_coefficient: ExprId,
}

/// Source of the normal force.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Normal {
    /// Of contact i.
    Contact(usize),
    /// |λ| of constraint i.
    Constraint(usize),
    /// √Σλ² of resultant i.
    Resultant(usize),
    /// An expression in q, v, t; 1 for `limit`.
    Given(ExprId),
}

/// An applied force; its generalized forces may contain force symbols of rows linearly (checked).
pub struct Force {
    /// Name.
    pub name: ItemName,
    /// What is reported: the scalar, or the norm of the vector.
    pub value: ExprId,
    /// Q per coordinate (index, Qᵢ).
    pub generalized: Vec<(usize, ExprId)>,
    /// As declared: each component with what it does work on.
    pub components: Vec<(ExprId, Worked)>,
    /// Symbol that stands for its value in outputs.
    pub force: Symbol,
}

/// What a component of a force does work on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Worked {
    /// This coordinate.
    Coordinate(usize),
    /// A component of the point at which it acts: Q = f ∂p/∂q.
    Point(ExprId),
    /// The velocity along which it acts: Q = f ∂s/∂v.
    Speed(ExprId),
}

/// Rayleigh dissipation: Q = −∂R/∂v.
pub struct Dissipation {
    /// Name.
    pub name: ItemName,
    /// R, W.
    pub rayleigh: ExprId,
}

/// Guard of a piecewise branch.
#[derive(Clone)]
pub struct Branch {
    /// ≥ 0 selects `then`.
    pub guard: ExprId,
    /// The same as it is declared: for the reader, and to be compared with what is declared to vanish with it.
    pub declared: ExprId,
    /// What holds on the `then` side, in the words of the user: `x - y >= 0`.
    pub then: String,
    /// What holds on the other side, `x - y < 0`.
    pub otherwise: String,
    /// Where.
    pub span: Span,
}

/// A named start; coordinates and velocities that are not in it are 0.
pub struct Start {
    /// Name.
    pub name: ItemName,
    /// (coordinate, position), expressions in parameters and t.
    pub positions: Vec<(usize, ExprId)>,
    /// (coordinate, velocity)
    pub velocities: Vec<(usize, ExprId)>,
}

/// An extra output.
pub struct Observe {
    /// Name.
    pub name: ItemName,
    /// Value; may contain accelerations and forces.
    pub value: ExprId,
}

/// A stop or mark: all terms ≥ 0 and all conditions.
pub struct Watch {
    /// Name.
    pub name: ItemName,
    /// left − right of each `>=`.
    pub terms: Vec<ExprId>,
    /// Conditions on the mode.
    pub conditions: Vec<Condition>,
    /// `mark(name: e)`: every zero of the one term.
    pub zeros: bool,
}

/// A condition on the mode; indices of contacts and frictions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Condition {
    /// Contact i is closed.
    Closed(usize),
    /// Contact i is open.
    Open(usize),
    /// Friction i sticks.
    Sticks(usize),
    /// Friction i slips.
    Slips(usize),
}
