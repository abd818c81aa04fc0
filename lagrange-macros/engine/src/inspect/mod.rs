//! Declaration, equations and program → [`Derivation`]: all that was derived, as a person would write it down.
//!
//! A derivation is plain data; [`mod@print`] has the languages in which it can be said. It is read off the finished program:
//! forms that are made for reading never reach the emitted code.

mod bodies;
mod conserved;
mod costs;
mod declared;
mod document;
mod excerpt;
mod formula;
mod friction;
mod guards;
mod impacts;
mod kinetic;
mod letter;
mod mode;
mod motion;
mod names;
mod orthonormal;
pub mod print;
mod readable;
mod shown;
mod solved;
mod switches;
#[cfg(test)]
mod tests;
mod work;
mod written;

use crate::ast::Declaration;
use crate::check::{Outcome, Verdict};
use crate::model::System;
use crate::plan::Program;
use names::Names;

pub use formula::{Formula, Relation, Statement};
pub use letter::{Letter, Mark};
pub use shown::UnknownMode;

/// Everything that was derived from one declaration.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// Name of the struct.
    pub name: String,
    /// First paragraph of its documentation, in one line.
    pub summary: String,
    /// What the letters mean: coordinates, then fields.
    pub symbols: Vec<Meaning>,
    /// Items as written.
    pub declared: Vec<Item>,
    /// T = …
    pub kinetic: Statement,
    /// V = …
    pub potential: Statement,
    /// L = T − V + what is linear in the velocities, where a declared Lagrangian has such.
    pub lagrangian: Option<Statement>,
    /// Rates and axes of the bodies in space that formulas speak of.
    pub bodies: Vec<Body>,
    /// One per coordinate: inertia = forces.
    pub motion: Vec<Equation>,
    /// Constraints, contacts and slips on the level of accelerations.
    pub rows: Vec<Row>,
    /// The modes, all of them or those that are chosen.
    pub modes: Vec<Mode>,
    /// How many modes there are in all.
    pub mode_count: u128,
    /// Whether one mode was asked for.
    pub single_mode: bool,
    /// Switches between the modes that are shown.
    pub switches: Vec<Switch>,
    /// What happens at an impact, contact by contact.
    pub impacts: Vec<Impact>,
    /// What does not change, or why it changes.
    pub conserved: Vec<Conserved>,
    /// What the user's checks came to.
    pub checks: Vec<Checked>,
    /// Number of operations of the equations of motion.
    pub costs: Vec<Cost>,
    /// What may be meant otherwise than it is written.
    pub hints: Vec<String>,
    /// What was left out for length, and the like.
    pub notes: Vec<String>,
}

impl Derivation {
    /// T, V and, where it has more than these, L.
    pub fn energies(&self) -> impl Iterator<Item = &Statement> {
        [&self.kinetic, &self.potential]
            .into_iter()
            .chain(&self.lagrangian)
    }
}

/// A body in space whose rates are velocities.
#[derive(Clone, Debug)]
pub struct Body {
    /// As declared.
    pub name: String,
    /// What its letters mean, in words.
    pub text: String,
    /// Rates and axes by its quaternion.
    pub definitions: Vec<Statement>,
}

/// A check and how far it is known to hold.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Its name, or empty.
    pub name: String,
    /// What is claimed, and when.
    pub claim: String,
    /// `proven in 2 modes`, or how it was tested.
    pub outcome: String,
}

/// What a letter means.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// On paper.
    pub letter: Letter,
    /// In the declaration.
    pub name: String,
    /// First line of its documentation, or what it is.
    pub text: String,
    /// Unit, or empty.
    pub unit: String,
}

/// An item of the declaration.
#[derive(Clone, Debug)]
pub struct Item {
    /// `kinetic`, `contact`, …
    pub keyword: &'static str,
    /// Its name with `on` or `while`, or empty.
    pub name: String,
    /// What it says.
    pub parts: Vec<Part>,
}

/// A part of an item: `static = μ`.
#[derive(Clone, Debug)]
pub enum Part {
    /// A word.
    Word(String),
    /// A formula.
    Formula(Formula),
    /// An equation or inequality.
    Statement(Statement),
}

/// An equation with its name.
#[derive(Clone, Debug)]
pub struct Equation {
    /// Whose it is.
    pub label: Letter,
    /// What it says.
    pub statement: Statement,
}

/// A row of the constrained system.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name of the item.
    pub name: String,
    /// `constraint`, `contact` or `friction`.
    pub kind: &'static str,
    /// On the level on which it is declared, = 0 or ≥ 0.
    pub declared: Statement,
    /// The region of a contact that has one.
    pub region: Option<Statement>,
    /// On the level of accelerations.
    pub acceleration: Statement,
    /// Its multiplier.
    pub multiplier: Letter,
    /// When it acts: `always`, `rim closed`, `grip sticks`.
    pub when: String,
}

/// A mode with its equations.
#[derive(Clone, Debug)]
pub struct Mode {
    /// `rim closed, grip sticks`
    pub name: String,
    /// Coordinates that contacts and constraints hold fixed.
    pub known: Vec<Statement>,
    /// Accelerations and multipliers.
    pub unknowns: Vec<Letter>,
    /// What determines them.
    pub equations: Vec<Statement>,
    /// Unknowns in closed form, those for which it is short; none where it was not sought, which a note says.
    pub solution: Option<Vec<Statement>>,
    /// What must hold, and what happens if it does not.
    pub guards: Vec<Guard>,
    /// What it costs.
    pub work: ModeWork,
}

/// What a mode costs.
#[derive(Clone, Copy, Debug)]
pub struct ModeWork {
    /// Operations of its equations of motion in the program that serves all modes.
    pub operations: usize,
    /// The same with its guards.
    pub with_guards: usize,
    /// Of the functions that are written for it alone, where there are any.
    pub emitted: Option<Emitted>,
}

/// What the functions of a mode cost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Emitted {
    /// Numbers that depend on parameters alone: computed once for each choice of them.
    pub constants: usize,
    /// Unknowns of the linear system, which is factorized once a step.
    pub unknowns: usize,
    /// Operations of the accelerations at a state.
    pub accelerations: usize,
    /// Operations with forces and all that guards read.
    pub whole: usize,
    /// Sums over earlier coefficients for each new one of the Taylor series.
    pub convolutions: usize,
}

impl Mode {
    /// Unknowns that the solution leaves out: theirs would be too long. None where no solution was sought.
    pub fn unsolved(&self) -> Vec<&Letter> {
        let Some(solution) = &self.solution else {
            return Vec::new();
        };
        let solved = |unknown: &Letter| {
            let mut lefts = solution.iter().map(|statement| &statement.left);
            lefts.any(|left| matches!(left, Formula::Letter(letter) if letter == unknown))
        };
        let unknowns = self.unknowns.iter();
        unknowns.filter(|unknown| !solved(unknown)).collect()
    }
}

/// What must hold in a mode.
#[derive(Clone, Debug)]
pub struct Guard {
    /// What must hold, in words: `rim presses`.
    pub meaning: String,
    /// What must hold.
    pub statement: Statement,
    /// The region in which it must hold, of a contact that is open and has one.
    pub region: Option<Statement>,
    /// What happens where it ceases to hold.
    pub otherwise: String,
}

/// A switch between two modes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Switch {
    /// Index of a mode.
    pub from: usize,
    /// Index of a mode.
    pub to: usize,
    /// What causes it.
    pub label: String,
}

/// The reset at an impact.
#[derive(Clone, Debug)]
pub struct Impact {
    /// Name of the contact.
    pub contact: String,
    /// When it takes place: gap = 0, approaching.
    pub when: [Statement; 2],
    /// The region in which it takes place, of a contact that has one.
    pub region: Option<Statement>,
    /// Momentum balances and the laws of impact.
    pub equations: Vec<Statement>,
    /// In words: what friction does.
    pub note: String,
}

/// A conserved quantity.
#[derive(Clone, Debug)]
pub struct Conserved {
    /// `momentum of x`, `energy`
    pub name: String,
    /// What it is.
    pub quantity: Statement,
    /// Its rate, where it is not always conserved.
    pub rate: Option<Statement>,
    /// When it is conserved.
    pub when: String,
}

/// Operations of one effect or of all.
#[derive(Clone, Debug)]
pub struct Cost {
    /// `energies`, `rim closed`, `grip slips`, …
    pub name: String,
    /// As a tree: every formula on its own.
    pub before: u64,
    /// After sharing, alone or beside what it needs.
    pub after: usize,
}

/// Reads off what was derived. With a mode, only that one is looked at, and numerous ones too.
///
/// # Errors
/// There is no such mode.
pub fn derivation(
    declaration: &Declaration,
    program: &mut Program,
    verdicts: &[Verdict],
    mode: Option<&str>,
) -> Result<Derivation, UnknownMode> {
    // Reading needs the pool for itself; it is put back as it was, but for forms that nothing refers to.
    let mut pool = std::mem::take(&mut program.equations.system.pool);
    let result = work::derivation(declaration, program, &mut pool, mode);
    program.equations.system.pool = pool;
    let mut derivation = result?;
    derivation.checks = verdicts.iter().map(checked).collect();
    Ok(derivation)
}

/// What the letters of a declaration mean.
pub(crate) fn meanings(declaration: &Declaration, system: &System) -> Vec<Meaning> {
    work::meanings(declaration, &Names::of(declaration, system))
}

fn checked(verdict: &Verdict) -> Checked {
    let outcome = match &verdict.outcome {
        Outcome::Proven { modes: 1 } => "proven in one mode".to_owned(),
        Outcome::Proven { modes } => format!("proven in {modes} modes"),
        Outcome::Tested { states, because } => {
            format!("tested at {states} random states, not proven: {because}")
        }
    };
    Checked {
        name: verdict.name.clone(),
        claim: verdict.claim.clone(),
        outcome,
    }
}
