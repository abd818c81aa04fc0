//! A system on its way from a declaration.

use super::System;
use super::depth::{Context, Depth};
use super::meaning::Names;
use super::value::Value;
use crate::ast::{Expr, Head, Home};
use crate::diagnostics::Diagnostics;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Symbol};

/// A system on its way.
pub(super) struct Elaboration<'a> {
    pub system: System,
    pub sink: &'a mut Diagnostics,
    pub names: Names,
    /// Bound indices, innermost last.
    pub indices: Vec<(String, i64)>,
    /// What `slip` stands for: the slip of the friction whose coefficients are read.
    pub slip: Option<Value>,
    /// Branches by their guards.
    pub branches: SortedMap<ExprId, usize>,
    /// Kind of each symbol, by its index.
    pub depths: Vec<Depth>,
    /// q → v, v → v̇, t → 1.
    pub directions: Vec<(Symbol, ExprId)>,
    /// Expressions under `der`, and the symbols that stand for their rates; `None` where rates are worked out.
    pub rates: Option<SortedMap<ExprId, Symbol>>,
    /// What `define` and `observe` name.
    pub definitions: Vec<Pending>,
    /// First coordinate of each name, and the length of an array.
    pub coordinate_names: SortedMap<String, (usize, Option<usize>)>,
    /// First coordinate of each body of `attitude`.
    pub bodies: SortedMap<String, usize>,
    /// Whether the rates of those bodies are velocities, in place of those of their quaternions.
    pub in_body_rates: bool,
    /// Names of the outputs so far.
    pub outputs: Vec<String>,
    /// Whether something could not be read; the sink says why.
    pub dropped: bool,
    /// Whether it has been reported that something has outgrown what is kept exactly.
    pub overflowed: bool,
    /// Elements that arrays, sums and indexed items have been unrolled to.
    pub unrolled: i64,
    /// Where the declaration stands, for messages.
    pub home: Home,
}

/// A definition or output.
#[derive(Clone)]
pub(super) struct Pending {
    pub head: Head,
    pub value: Expr,
    pub context: Context,
}

/// What the names of a declaration mean, kept for what is read once everything is derived.
pub struct Scope {
    names: Names,
    depths: Vec<Depth>,
    directions: Vec<(Symbol, ExprId)>,
    definitions: Vec<Pending>,
    coordinate_names: SortedMap<String, (usize, Option<usize>)>,
    bodies: SortedMap<String, usize>,
    home: Home,
}

impl<'a> Elaboration<'a> {
    /// Goes on with a system that has been closed.
    pub fn reopen(system: System, scope: Scope, sink: &'a mut Diagnostics) -> Elaboration<'a> {
        Elaboration {
            overflowed: system.pool.outgrown().is_some(),
            branches: (system.branches.iter().map(|branch| branch.guard))
                .zip(0..)
                .collect(),
            system,
            sink,
            names: scope.names,
            indices: Vec::new(),
            slip: None,
            depths: scope.depths,
            directions: scope.directions,
            rates: None,
            definitions: scope.definitions,
            coordinate_names: scope.coordinate_names,
            bodies: scope.bodies,
            in_body_rates: false,
            outputs: Vec::new(),
            dropped: false,
            unrolled: 0,
            home: scope.home,
        }
    }

    /// The system, and what its names mean.
    pub fn close(self) -> (System, Scope) {
        let scope = Scope {
            names: self.names,
            depths: self.depths,
            directions: self.directions,
            definitions: self.definitions,
            coordinate_names: self.coordinate_names,
            bodies: self.bodies,
            home: self.home,
        };
        (self.system, scope)
    }
}
