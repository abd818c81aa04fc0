//! Declaration → the system as declared: `der(e)` stays an operation on e, and nothing is differentiated.
//!
//! What checks a finished run evaluates this, so that it uses nothing of what was derived. The exceptions are the gradient of
//! a gap by the point that it acts at, and the canonical form that the pool gives to sums and products.

use super::System;
use super::depth::Depth;
use super::draws::drawn;
use super::elaboration::Elaboration;
use crate::ast::Declaration;
use crate::diagnostics::Diagnostics;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Symbol};

/// A system in which symbols stand for rates.
pub struct Declared {
    /// The system. Stops and marks that contain generalized momenta, or the energy of a Lagrangian, are not in it.
    pub system: System,
    /// Symbols and the expressions whose rates they are.
    pub rates: SortedMap<Symbol, ExprId>,
}

/// The system as declared, of a declaration without mistakes.
pub fn declared(declaration: &Declaration) -> Declared {
    // What has mistakes has been reported by who derived it.
    let mut sink = Diagnostics::new();
    let mut elaboration = Elaboration::new(declaration, &mut sink);
    elaboration.rates = Some(SortedMap::new());
    elaboration.read_all(declaration);
    match drawn(declaration).next() {
        Some(_) => elaboration.draws(declaration),
        None => {
            elaboration.units(declaration);
            elaboration.seen();
        }
    }
    let rates = elaboration.rates.take().unwrap_or_default();
    Declared {
        rates: rates.into_iter().map(|(e, symbol)| (symbol, e)).collect(),
        system: elaboration.close().0,
    }
}

impl Elaboration<'_> {
    /// d/dt of an expression along q̇ = v, v̇ = a, ṫ = 1; where rates are kept, a symbol for it.
    pub fn time_rate(&mut self, e: ExprId) -> ExprId {
        let Some(rates) = &self.rates else {
            let directions = std::mem::take(&mut self.directions);
            let rate = self.system.pool.derivative_along(e, &directions);
            self.directions = directions;
            return rate;
        };
        let known = rates.get(&e).copied();
        let symbol = known.unwrap_or_else(|| {
            let depth = match self.depth(&[e]) {
                Depth::Parameter => Depth::Parameter,
                Depth::Position => Depth::Velocity,
                _ => Depth::Acceleration,
            };
            self.symbol("der", depth)
        });
        self.rates.get_or_insert_default().insert(e, symbol);
        self.system.pool.leaf(symbol)
    }
}
