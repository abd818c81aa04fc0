//! What the parts of the derivation share while it is read off.

use super::formula::Formula;
use super::names::Names;
use super::readable::Reader;
use super::shown::{UnknownMode, shown};
use super::switches::switches;
use super::{Derivation, Meaning};
use crate::ast::Declaration;
use crate::derive::OutputId;
use crate::model::System;
use crate::plan::Program;
use crate::symbolic::{ExprId, Pool};

/// Of more modes none is solved in closed form, unless it is asked for alone.
const MOST_SOLVED: usize = 8;

/// Branches that are told of.
const MOST_BRANCHES: usize = 12;

/// A derivation on its way.
pub(super) struct Work<'a> {
    pub program: &'a Program,
    pub names: &'a Names,
    pub reader: Reader<'a>,
    /// Whether modes are solved: not where there are many.
    pub solves: bool,
}

impl Work<'_> {
    /// The system, without its pool.
    pub fn system(&self) -> &System {
        &self.program.equations.system
    }

    /// The pool.
    pub fn pool(&mut self) -> &mut Pool {
        self.reader.pool()
    }

    /// An output as one expression.
    pub fn output(&mut self, output: OutputId) -> ExprId {
        self.program.equations.total(self.reader.pool(), output)
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
                "Piecewise: {} has two sides; each side is smooth, and changing sides is an event.",
                branch.text
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
    let system = &program.equations.system;
    let names = Names::of(declaration, system);
    let guards = system.branches.iter().map(|branch| branch.guard).collect();
    let mut work = Work {
        program,
        names: &names,
        reader: Reader::new(pool, &names, guards),
        solves: true,
    };
    let (shown, mode_count) = shown(system, mode)?;
    work.solves = shown.len() <= MOST_SOLVED;
    let structure = &program.equations.structure;
    let kinetic = work.kinetic();
    let potential = work.formula_of(structure.energy.1);
    let motion = work.motion();
    let rows = work.rows();
    let impacts = work.impacts();
    let conserved = work.conserved();
    let costs = work.costs();
    let modes: Vec<_> = shown.iter().map(|mode| work.mode(mode)).collect();
    let switches = switches(system, &shown);
    let mut notes = Vec::new();
    if mode.is_none() && (modes.len() as u128) < mode_count {
        notes.push(format!(
            "{} of {} modes are shown: all contacts open, one of them closed, and all of them closed and sticking.",
            modes.len(),
            mode_count
        ));
    }
    notes.extend(work.notes(motion.len()));
    Ok(Derivation {
        name: declaration.name.to_string(),
        summary: summary(&declaration.documentation),
        symbols: meanings(declaration, &names),
        declared: super::declared::items(declaration, &names),
        kinetic,
        potential,
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
        hints: system.hints.iter().map(|hint| hint.text.clone()).collect(),
        notes,
    })
}

/// The first paragraph in one line.
fn summary(documentation: &str) -> String {
    let lines = documentation
        .lines()
        .take_while(|line| !line.trim().is_empty());
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

fn meanings(declaration: &Declaration, names: &Names) -> Vec<Meaning> {
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
