//! Systems built by hand.

use super::notation::parse;
use super::numbers::Derived;
use crate::derive::equations;
use crate::diagnostics::Diagnostics;
use crate::model::*;
use crate::symbolic::{ExprId, Pool, Symbol};
use proc_macro2::{Ident, Span, TokenStream};
use std::collections::BTreeMap;

/// A system under construction: names → expressions, in the notation of the language.
pub struct Build {
    pub system: System,
    names: BTreeMap<String, ExprId>,
}

fn name(text: &str) -> ItemName {
    let ident = (!text.is_empty()).then(|| Ident::new(text, Span::call_site()));
    ItemName {
        text: text.to_owned(),
        ident,
        element: None,
        span: Span::call_site(),
    }
}

impl Build {
    /// Coordinates and parameters, separated by blanks.
    pub fn new(coordinates: &str, parameters: &str) -> Self {
        let mut pool = Pool::new();
        let mut names = BTreeMap::new();
        let mut symbol = |pool: &mut Pool, text: &str| {
            let symbol = pool.symbol(text);
            names.insert(text.to_owned(), pool.leaf(symbol));
            symbol
        };
        let time = symbol(&mut pool, "t");
        let parameters = parameters
            .split_whitespace()
            .map(|text| Parameter {
                field: Ident::new(text, Span::call_site()),
                element: None,
                name: text.to_owned(),
                symbol: symbol(&mut pool, text),
                documentation: String::new(),
                unit: String::new(),
                tex: String::new(),
                letter: String::new(),
            })
            .collect();
        let coordinates = coordinates
            .split_whitespace()
            .map(|text| Coordinate {
                name: name(text),
                position: symbol(&mut pool, text),
                velocity: symbol(&mut pool, &format!("v_{text}")),
                acceleration: symbol(&mut pool, &format!("a_{text}")),
                unit: String::new(),
            })
            .collect();
        let system = System {
            name: Ident::new("Scene", Span::call_site()),
            documentation: String::new(),
            scalar: None,
            core: TokenStream::new(),
            pool,
            time,
            parameters,
            coordinates,
            kinetic: vec![],
            potential: vec![],
            from_lagrangian: false,
            constraints: vec![],
            contacts: vec![],
            frictions: vec![],
            forces: vec![],
            dissipations: vec![],
            branches: vec![],
            starts: vec![],
            observes: vec![],
            stops: vec![],
            marks: vec![],
            impacts: crate::ast::Impacts::default(),
            units: crate::model::Units::default(),
            hints: Vec::new(),
        };
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
            name: name(text),
            energy,
        });
        self
    }

    pub fn potential(mut self, text: &str, energy: &str) -> Self {
        let energy = self.e(energy);
        self.system.potential.push(EnergyTerm {
            name: name(text),
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
            name: name(""),
            energy: kinetic,
        });
        self.system.potential.push(EnergyTerm {
            name: name(""),
            energy: potential,
        });
        self.system.from_lagrangian = true;
        self
    }

    pub fn constraint(mut self, text: &str, level: Level, residual: &str) -> Self {
        let (residual, force) = (self.e(residual), self.force(text));
        self.system.constraints.push(Constraint {
            name: name(text),
            level,
            residual,
            while_contact: None,
            force,
        });
        self
    }

    pub fn contact(mut self, text: &str, gap: &str) -> Self {
        let (gap, force) = (self.e(gap), self.force(text));
        let restitution = Restitution::Newton(self.e("0"));
        let name = name(text);
        self.system.contacts.push(Contact {
            name,
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
            name: name(text),
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
            name: name(text),
            value,
            generalized,
            force,
        });
        self
    }

    pub fn dissipation(mut self, text: &str, rayleigh: &str) -> Self {
        let rayleigh = self.e(rayleigh);
        self.system.dissipations.push(Dissipation {
            name: name(text),
            rayleigh,
        });
        self
    }

    pub fn observe(mut self, text: &str, value: &str) -> Self {
        let value = self.e(value);
        self.system.observes.push(Observe {
            name: name(text),
            value,
        });
        self
    }

    pub fn stop(mut self, text: &str, terms: &[&str]) -> Self {
        let terms = terms.iter().map(|term| self.e(term)).collect();
        self.system.stops.push(Watch {
            name: name(text),
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
