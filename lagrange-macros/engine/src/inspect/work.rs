//! What the parts of the derivation share while it is read off.

use super::costs::Counts;
use super::formula::{Formula, Statement};
use super::letter::Letter;
use super::names::Names;
use super::orthonormal;
use super::readable::Reader;
use super::shown::{UnknownMode, shown};
use super::switches::switches;
use super::{Derivation, Meaning};
use crate::ast::Declaration;
use crate::derive::{self, Equations, OutputId};
use crate::diagnostics::Diagnostics;
use crate::model::{self, System};
use crate::plan::Program;
use crate::symbolic::{ExprId, Pool};

/// Of more modes none is solved in closed form, unless it is asked for alone.
const MOST_SOLVED: usize = 8;

/// Branches that are told of.
const MOST_BRANCHES: usize = 12;

/// A derivation on its way.
pub(super) struct Work<'a> {
    /// What is read: of bodies in space their rates are the velocities.
    pub equations: &'a Equations,
    pub names: &'a Names,
    pub reader: Reader<'a>,
    /// Whether modes are solved: not where there are many.
    pub solves: bool,
    /// What runs costs this much.
    pub counts: &'a Counts<'a>,
}

impl Work<'_> {
    /// The system, without its pool.
    pub fn system(&self) -> &System {
        &self.equations.system
    }

    /// The pool.
    pub fn pool(&mut self) -> &mut Pool {
        self.reader.pool()
    }

    /// An output as one expression.
    pub fn output(&mut self, output: OutputId) -> ExprId {
        self.equations.total(self.reader.pool(), output)
    }

    /// An output on paper.
    pub fn formula_of(&mut self, output: OutputId) -> Formula {
        let e = self.output(output);
        self.reader.formula(e)
    }

    /// What is left out where so many equations of motion are shown, and what is piecewise.
    fn notes(&self, equations: usize) -> Vec<String> {
        let mut notes = Vec::new();
        let coordinates = self.system().coordinates.len();
        if equations < coordinates {
            notes.push(format!(
                "{equations} of {coordinates} equations of motion are shown: the first ones and the last one."
            ));
        }
        if !self.solves {
            notes.push("Closed forms are shown for one mode at a time.".to_owned());
        }
        for branch in self.system().branches.iter().take(MOST_BRANCHES) {
            notes.push(format!(
                "Piecewise: the sides {} and {} are smooth each, and to change from one to the other is an event.",
                branch.then, branch.otherwise
            ));
        }
        notes
    }
}

/// The whole derivation.
pub(super) fn derivation(
    declaration: &Declaration,
    program: &Program,
    pool: &mut Pool,
    mode: Option<&str>,
) -> Result<Derivation, UnknownMode> {
    let counts = Counts { program };
    let costs = counts.costs(pool);
    let mut in_rates = in_body_rates(declaration);
    let read = in_rates.as_ref().unwrap_or(&program.equations);
    let names = Names::of(declaration, &read.system);
    let mut own = in_rates
        .as_mut()
        .map(|equations| std::mem::take(&mut equations.system.pool));
    if let (Some(equations), Some(own)) = (&mut in_rates, &mut own) {
        let guards = guards(&equations.system);
        orthonormal::reduce(equations, &mut Reader::new(own, &names, guards));
    }
    let (equations, pool) = match (&in_rates, &mut own) {
        (Some(equations), Some(own)) => (equations, own),
        _ => (&program.equations, pool),
    };
    let system = &equations.system;
    let mut work = Work {
        equations,
        names: &names,
        reader: Reader::new(pool, &names, guards(system)),
        solves: true,
        counts: &counts,
    };
    let (shown, mode_count) = shown(system, mode)?;
    work.solves = shown.len() <= MOST_SOLVED;
    let equal = |letter: &Letter, value| Statement::equal(Formula::Letter(letter.clone()), value);
    let kinetic = equal(&names.energies.kinetic, work.kinetic());
    let potential = work.formula_of(equations.structure.energy.1);
    let potential = equal(&names.energies.potential, potential);
    let lagrangian = work
        .linear()
        .map(|linear| names.energies.lagrangian(linear));
    let bodies = work.bodies(declaration);
    let motion = work.motion();
    let rows = work.rows();
    let impacts = work.impacts();
    let conserved = work.conserved();
    let modes: Vec<_> = shown.iter().map(|mode| work.mode(mode)).collect();
    let switches = switches(system, &shown);
    let mut notes = Vec::new();
    if mode.is_none() && (modes.len() as u128) < mode_count {
        notes.push(format!(
            "{} of {mode_count} modes are shown: {}. Any other is shown when it is asked for by its name.",
            modes.len(),
            match system.contacts.is_empty() {
                true => "those in which at most one friction slips",
                false =>
                    "all contacts open or one closed, where at most one friction slips, and all closed and sticking",
            }
        ));
    }
    notes.extend(work.notes(motion.len()));
    let hints = program.equations.system.hints.iter();
    Ok(Derivation {
        name: declaration.name.to_string(),
        summary: summary(&declaration.documentation),
        symbols: meanings(declaration, &names),
        declared: super::declared::items(declaration, &names),
        kinetic,
        potential,
        lagrangian,
        bodies,
        motion,
        rows,
        modes,
        mode_count,
        single_mode: mode.is_some(),
        switches,
        impacts,
        conserved,
        checks: Vec::new(),
        costs,
        hints: hints.map(|hint| hint.text.clone()).collect(),
        notes,
    })
}

/// What decides the branches, as declared.
fn guards(system: &System) -> Vec<ExprId> {
    let branches = system.branches.iter();
    branches.map(|branch| branch.declared).collect()
}

/// The equations with the rates of bodies as velocities, where there are bodies.
fn in_body_rates(declaration: &Declaration) -> Option<Equations> {
    let system = model::in_body_rates(declaration)?;
    // The declaration has no mistakes: what this finds is not for its author.
    let equations = derive::equations(system, &mut Diagnostics::new())?;
    (!equations.system.pool.is_full()).then_some(equations)
}

/// The first paragraph in one line.
fn summary(documentation: &str) -> String {
    let lines = documentation
        .lines()
        .take_while(|line| !line.trim().is_empty());
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

pub(super) fn meanings(declaration: &Declaration, names: &Names) -> Vec<Meaning> {
    let mut meanings = Vec::new();
    for field in &declaration.fields {
        let name = match field.length {
            Some(length) => format!("{}[{length}]", field.name.text),
            None => field.name.text.clone(),
        };
        meanings.push(Meaning {
            letter: names.declared(&field.name.text),
            name,
            text: summary(&field.documentation),
            unit: field
                .unit
                .as_ref()
                .map(|unit| unit.text.clone())
                .unwrap_or_default(),
        });
    }
    meanings
}
