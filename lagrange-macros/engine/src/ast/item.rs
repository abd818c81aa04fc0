//! Items of a declaration.

use super::{Comparison, Draw, Expr, Head, Index, Name, Reference, Unit};
use crate::diagnostics::Extent;
use proc_macro2::Span;

/// An item of a declaration.
#[derive(Clone, Debug)]
pub struct Item {
    /// Its keyword.
    pub keyword: Span,
    /// What it says.
    pub kind: ItemKind,
}

/// What an item says.
#[derive(Clone, Debug)]
pub enum ItemKind {
    /// `coordinates(x, r: "m", theta[8])`
    Coordinates(Vec<Coordinate>),
    /// `define(px = …, e = […])`
    Define(Vec<Definition>),
    /// `kinetic = …` or `kinetic(name: …)`
    Kinetic(Energy),
    /// `potential = …` or `potential(name: …)`
    Potential(Energy),
    /// `lagrangian = …`
    Lagrangian(Expr),
    /// `constraint(name while contact: a == b)`
    Constraint(Box<Constraint>),
    /// `contact(name: a >= b at p, restitution = e, where c >= d)`
    Contact(Box<Contact>),
    /// `friction(name on item: slip = …, …)`
    Friction(Box<Friction>),
    /// `force(name: …)`
    Force(Box<Force>),
    /// `dissipation(name: …)`
    Dissipation(Dissipation),
    /// `start(name: x = …, der(x) = …)`
    Start(Start),
    /// `observe(name = …)` or `observe(name)`
    Observe(Vec<Observe>),
    /// `stop(name: …)`
    Stop(Watch),
    /// `mark(name: …)`
    Mark(Watch),
    /// `check(name: a == b when …)`
    Check(Box<Check>),
    /// `draw(disc: (x, y), radius = r)`
    Draw(Box<Draw>),
    /// `attitude(body: q)`
    Attitude(Attitude),
    /// `impacts = together | in_turn`
    Impacts(Impacts),
    /// `emit = unrolled | loops | data`
    Emit(Emit),
}

/// A coordinate, or an array of them.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Name.
    pub name: Name,
    /// Number of elements.
    pub length: Option<Expr>,
    /// Unit.
    pub unit: Option<Unit>,
}

/// A named expression.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Name.
    pub head: Head,
    /// What it stands for.
    pub value: Expr,
}

/// A term of the kinetic or potential energy.
#[derive(Clone, Debug)]
pub struct Energy {
    /// Name, if it has one.
    pub head: Option<Head>,
    /// J
    pub value: Expr,
}

/// An equality constraint.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Name.
    pub head: Head,
    /// The `while` keyword and the contact.
    pub while_contact: Option<(Span, Reference)>,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

/// A one-sided contact.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Name.
    pub head: Head,
    /// The gap.
    pub gap: Comparison,
    /// `at p`
    pub at: Option<Expr>,
    /// `restitution = …`
    pub restitution: Option<Restitution>,
    /// `where c >= d`
    pub region: Option<Comparison>,
}

/// A law of impact.
#[derive(Clone, Debug)]
pub enum Restitution {
    /// `e`
    Newton(Expr),
    /// `poisson(e)`
    Poisson(Expr),
}

/// Coulomb friction.
#[derive(Clone, Debug)]
pub struct Friction {
    /// Name.
    pub head: Head,
    /// The contact or the constraint whose force presses, or the constraints whose forces do together.
    pub on: Vec<Reference>,
    /// One slip velocity, or a list of two.
    pub slip: Expr,
    /// How strong it is.
    pub law: FrictionLaw,
}

/// Strength of a friction.
#[derive(Clone, Debug)]
pub enum FrictionLaw {
    /// Coefficients times a normal force: that of the item it is on, or the one given.
    Coefficients {
        /// `normal = …`
        normal: Option<Box<Expr>>,
        /// `static = …`
        stick: Box<Expr>,
        /// `kinetic = …`; as static if left out
        slide: Option<Box<Expr>>,
    },
    /// `limit = F` or `limit = (Fs, Fk)`
    Limit(Expr),
}

/// An applied force.
#[derive(Clone, Debug)]
pub struct Force {
    /// Name.
    pub head: Head,
    /// How it acts.
    pub action: Action,
}

/// How a force acts.
#[derive(Clone, Debug)]
pub enum Action {
    /// `theta = τ`
    Generalized(Reference, Expr),
    /// `(fx, fy) at (px, py)`
    At(Expr, Expr),
    /// `f along s`
    Along(Expr, Expr),
}

/// Rayleigh dissipation.
#[derive(Clone, Debug)]
pub struct Dissipation {
    /// Name.
    pub head: Head,
    /// W
    pub value: Expr,
}

/// A named start.
#[derive(Clone, Debug)]
pub struct Start {
    /// Name.
    pub head: Head,
    /// What is not zero.
    pub values: Vec<StartValue>,
}

/// The quantity that a start sets.
#[derive(Clone, Debug)]
pub enum StartQuantity {
    /// `x = …`
    Position,
    /// `der(x) = …`
    Velocity,
    /// `body.turn = …`, `body.body_rate = …`, `body.space_rate = …`
    Member(Name),
}

/// One value of a start.
#[derive(Clone, Debug)]
pub struct StartValue {
    /// What of it.
    pub quantity: StartQuantity,
    /// Coordinate, or body.
    pub name: Name,
    /// Which elements of an array.
    pub element: Element,
    /// Its value.
    pub value: Expr,
}

impl StartValue {
    /// What is set, without its index and `der`: `theta`, `body.turn`.
    pub fn place(&self) -> String {
        match &self.quantity {
            StartQuantity::Member(member) => format!("{}.{}", self.name.text, member.text),
            StartQuantity::Position | StartQuantity::Velocity => self.name.text.clone(),
        }
    }
}

/// Which elements of an array.
#[derive(Clone, Debug)]
pub enum Element {
    /// The coordinate, or a list for the array.
    Whole,
    /// `x[2]`
    One(Expr),
    /// `x[k in 0..8]`
    Each(Index),
}

/// An extra output.
#[derive(Clone, Debug)]
pub enum Observe {
    /// `px`, as defined elsewhere
    Known(Name),
    /// `name = …`
    New(Box<Head>, Expr),
}

/// A stop or mark.
#[derive(Clone, Debug)]
pub struct Watch {
    /// Name.
    pub head: Head,
    /// What it waits for.
    pub trigger: Trigger,
}

/// What a stop or mark waits for.
#[derive(Clone, Debug)]
pub enum Trigger {
    /// All of these become true.
    All(Vec<Clause>),
    /// Every zero of a value (`mark` only).
    Zero(Expr),
}

/// One of the terms joined by `and`.
#[derive(Clone, Debug)]
pub enum Clause {
    /// `a >= b` or `a <= b`
    Comparison(Comparison),
    /// `closed(c)` and the like
    Mode(ModeWord, Reference),
}

/// A condition on the mode.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ModeWord {
    /// `closed(contact)`
    Closed,
    /// `open(contact)`
    Open,
    /// `sticks(friction)`
    Sticks,
    /// `slips(friction)`
    Slips,
}

impl ModeWord {
    /// All words with their text.
    pub const ALL: [(&'static str, ModeWord); 4] = [
        ("closed", ModeWord::Closed),
        ("open", ModeWord::Open),
        ("sticks", ModeWord::Sticks),
        ("slips", ModeWord::Slips),
    ];
}

/// The user's own derivation, to be proven or refuted.
#[derive(Clone, Debug)]
pub struct Check {
    /// Name, if it has one.
    pub head: Option<Head>,
    /// What is said to hold.
    pub claim: Claim,
    /// Where that is written.
    pub claimed: Extent,
    /// When it holds: all of these.
    pub premises: Vec<Premise>,
}

/// What a check says.
#[derive(Clone, Debug)]
pub enum Claim {
    /// `a == b`
    Equal(Expr, Expr),
    /// `conserved e`: der(e) == 0
    Conserved(Expr),
}

/// A condition of a check.
#[derive(Clone, Debug)]
pub enum Premise {
    /// `closed(c)` and the like
    Mode(ModeWord, Reference),
    /// `a >= b` or `a <= b`
    AtLeast(Comparison),
    /// `a == b`
    Equal(Expr, Expr),
}

/// `attitude(body: q)`
#[derive(Clone, Debug)]
pub struct Attitude {
    /// The body.
    pub body: Name,
    /// Its four coordinates.
    pub coordinates: Name,
}

/// How simultaneous impacts are resolved.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Impacts {
    /// In one solution.
    #[default]
    Together,
    /// One after the other, in order of declaration, again and again, until none approaches.
    InTurn,
}

/// What the equations of the modes are written as.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Emit {
    /// Functions for systems that are small enough, with loops over the coefficients of a series; data for others.
    #[default]
    BySize,
    /// Functions without such loops: long code, which takes long to compile.
    Unrolled,
    /// Functions with loops.
    Loops,
    /// Data for the interpreter.
    Data,
}
