//! Systems built by hand.

use super::notation::parse;
use super::numbers::Derived;
use crate::derive::equations;
use crate::diagnostics::Diagnostics;
use crate::model::tests::{bare, item};
use crate::model::*;
use crate::symbolic::{ExprId, Symbol};
use std::collections::BTreeMap;

/// A system under construction: names → expressions, in the notation of the language.
pub struct Build {
    pub system: System,
    names: BTreeMap<String, ExprId>,
}

impl Build {
    /// Coordinates and parameters, separated by blanks.
    pub fn new(coordinates: &str, parameters: &str) -> Self {
        let mut system = bare(
            parameters.split_whitespace(),
            coordinates.split_whitespace(),
        );
        let mut symbols = vec![system.time];
        symbols.extend(system.parameters.iter().map(|p| p.symbol));
        for c in &system.coordinates {
            symbols.extend([c.position, c.velocity, c.acceleration]);
        }
        let pool = &mut system.pool;
        let names = symbols
            .into_iter()
            .map(|symbol| (pool.name(symbol).to_owned(), pool.leaf(symbol)))
            .collect();
        Self { system, names }
    }

    /// Parses an expression; `der(e)` is the total time derivative, `v_x`, `a_x` are der(x), der(der(x)),
    /// `if(g, a, b)` is a where g ≥ 0.
    pub fn e(&mut self, text: &str) -> ExprId {
        parse(&mut self.system, &self.names, text)
    }

    fn force(&mut self, text: &str) -> Symbol {
        let force = self.system.pool.symbol(text);
        self.names
            .insert(text.to_owned(), self.system.pool.leaf(force));
        force
    }

    pub fn define(mut self, text: &str, value: &str) -> Self {
        let value = self.e(value);
        self.names.insert(text.to_owned(), value);
        self
    }

    /// An empty name makes an unnamed term.
    pub fn kinetic(mut self, text: &str, energy: &str) -> Self {
        let energy = self.e(energy);
        self.system.kinetic.push(EnergyTerm {
            name: item(text),
            energy,
        });
        self
    }

    pub fn potential(mut self, text: &str, energy: &str) -> Self {
        let energy = self.e(energy);
        self.system.potential.push(EnergyTerm {
            name: item(text),
            energy,
        });
        self
    }

    pub fn lagrangian(mut self, lagrangian: &str) -> Self {
        let lagrangian = self.e(lagrangian);
        let zero = self.system.pool.integer(0);
        let rest: Vec<_> = self
            .system
            .coordinates
            .iter()
            .map(|c| (c.velocity, zero))
            .collect();
        let pool = &mut self.system.pool;
        let at_rest = pool.substitute(lagrangian, &rest);
        let kinetic = pool.sub(lagrangian, at_rest);
        let potential = pool.neg(at_rest);
        self.system.kinetic.push(EnergyTerm {
            name: item(""),
            energy: kinetic,
        });
        self.system.potential.push(EnergyTerm {
            name: item(""),
            energy: potential,
        });
        self.system.from_lagrangian = true;
        self
    }

    pub fn constraint(mut self, text: &str, level: Level, residual: &str) -> Self {
        let (residual, force) = (self.e(residual), self.force(text));
        self.system.constraints.push(Constraint {
            name: item(text),
            level,
            residual,
            while_contact: None,
            attitude: None,
            force,
        });
        self
    }

    pub fn contact(mut self, text: &str, gap: &str) -> Self {
        let (gap, force) = (self.e(gap), self.force(text));
        let restitution = Restitution::Newton(self.e("0"));
        self.system.contacts.push(Contact {
            name: item(text),
            gap,
            normal_factor: None,
            restitution,
            region: None,
            force,
        });
        self
    }

    pub fn friction(
        mut self,
        text: &str,
        normal: Normal,
        slip: &[&str],
        coefficient: &str,
    ) -> Self {
        let mut components = Vec::new();
        for (k, slip) in slip.iter().enumerate() {
            let label = if k == 0 {
                text.to_owned()
            } else {
                format!("{text}{k}")
            };
            components.push((self.e(slip), self.force(&label)));
        }
        let coefficient = self.e(coefficient);
        self.system.frictions.push(Friction {
            name: item(text),
            slip: components,
            normal,
            static_coefficient: coefficient,
            kinetic_coefficient: coefficient,
        });
        self
    }

    pub fn load(mut self, text: &str, value: &str, generalized: &[(usize, &str)]) -> Self {
        let value = self.e(value);
        let generalized = generalized.iter().map(|&(i, q)| (i, self.e(q))).collect();
        let force = self.force(text);
        self.system.forces.push(Force {
            name: item(text),
            value,
            generalized,
            components: Vec::new(),
            force,
        });
        self
    }

    pub fn dissipation(mut self, text: &str, rayleigh: &str) -> Self {
        let rayleigh = self.e(rayleigh);
        self.system.dissipations.push(Dissipation {
            name: item(text),
            rayleigh,
        });
        self
    }

    pub fn observe(mut self, text: &str, value: &str) -> Self {
        let value = self.e(value);
        self.system.observes.push(Observe {
            name: item(text),
            value,
        });
        self
    }

    pub fn stop(mut self, text: &str, terms: &[&str]) -> Self {
        let terms = terms.iter().map(|term| self.e(term)).collect();
        self.system.stops.push(Watch {
            name: item(text),
            terms,
            conditions: vec![],
            zeros: false,
        });
        self
    }

    /// The equations, or what is wrong with the system.
    pub fn try_derive(self) -> Result<Derived, String> {
        let mut sink = Diagnostics::new();
        match equations(self.system, &mut sink) {
            Some(equations) => Ok(Derived {
                equations,
                names: self.names,
            }),
            None => Err(sink.to_string()),
        }
    }

    pub fn derive(self) -> Derived {
        self.try_derive()
            .unwrap_or_else(|message| panic!("{message}"))
    }
}
