//! The sheet that the theorems write their outputs on.

use super::forms::Variables;
use super::needs::{Needs, allocate};
use super::{NeedId, Output, OutputId, Stage};
use crate::model::{ItemName, System};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Symbol};

/// A system with its variables and needs, and the outputs found so far.
pub(super) struct Sheet {
    pub system: System,
    pub x: Variables,
    pub needs: Needs,
    pub outputs: Vec<Output>,
    /// The first item whose exact numbers have outgrown the digits that are kept.
    pub outgrown: Option<ItemName>,
}

impl Sheet {
    /// A sheet without outputs.
    pub fn new(mut system: System) -> Self {
        Self {
            x: Variables::of(&mut system),
            needs: allocate(&system),
            system,
            outputs: Vec::new(),
            outgrown: None,
        }
    }

    /// Notes whether exact numbers have outgrown their digits in what has just been derived of this item.
    pub fn derived_of(&mut self, item: ItemName) {
        if self.outgrown.is_none() && self.system.pool.outgrown().is_some() {
            self.outgrown = Some(item);
        }
    }

    /// The same of the energies, which are told by the first.
    pub fn derived_of_energies(&mut self) {
        let first = self.system.kinetic.first().map(|term| term.name.clone());
        first.into_iter().for_each(|item| self.derived_of(item));
    }

    /// Adds an output; terms of one need are added up, zeros left out.
    pub fn output(&mut self, stage: Stage, label: String, terms: &[(NeedId, ExprId)]) -> OutputId {
        let mut by_need: SortedMap<NeedId, Vec<ExprId>> = SortedMap::new();
        for &(need, term) in terms {
            by_need.get_or_default(need).push(term);
        }
        let pool = &mut self.system.pool;
        let mut terms: Vec<(NeedId, ExprId)> = by_need
            .into_iter()
            .map(|(need, terms)| (need, pool.sum(&terms)))
            .collect();
        terms.retain(|&(_, term)| !pool.is_zero(term));
        self.outputs.push(Output {
            stage,
            label,
            terms,
        });
        OutputId(self.outputs.len() - 1)
    }

    /// Adds an output of the motion tape with one term.
    pub fn motion(&mut self, label: String, need: NeedId, e: ExprId) -> OutputId {
        self.output(Stage::Motion, label, &[(need, e)])
    }

    /// Adds an output of the report tape with one term.
    pub fn report(&mut self, label: String, need: NeedId, e: ExprId) -> OutputId {
        self.output(Stage::Report, label, &[(need, e)])
    }

    /// Name of coordinate `i`.
    pub fn coordinate(&self, i: usize) -> &str {
        &self.system.coordinates[i].name.text
    }

    /// An expression of the report: names of applied forces become their values, then simplified.
    pub fn reported(&mut self, e: ExprId) -> ExprId {
        let values: Vec<(Symbol, ExprId)> = self
            .system
            .forces
            .iter()
            .map(|f| (f.force, f.value))
            .collect();
        let e = self.system.pool.substitute(e, &values);
        self.system.pool.simplify(e)
    }
}
