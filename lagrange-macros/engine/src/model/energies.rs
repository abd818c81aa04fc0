//! Kinetic and potential energies, or a Lagrangian split at v = 0: V = −L(q, 0, t), T = L + V.

use super::depth::{Context, Depth, Reach};
use super::elaboration::Elaboration;
use super::meaning::Kind;
use super::{EnergyTerm, ItemName};
use crate::ast::{Declaration, Energy, Expr, ItemKind, Name};
use crate::diagnostics::Code;
use crate::symbolic::{ExprId, Symbol};
use proc_macro2::Span;

const KINETIC: Context = Context::new(Reach::Motion, "a kinetic energy");
const POTENTIAL: Context = Context::new(Reach::Positions, "a potential energy");
const LAGRANGIAN: Context = Context::new(Reach::Motion, "a Lagrangian");

impl Elaboration<'_> {
    /// What is said of a whole system is said once.
    pub fn check_single_items(&mut self, declaration: &Declaration) {
        let mut known = Vec::new();
        for item in &declaration.items {
            let word = match &item.kind {
                ItemKind::Lagrangian(_) => "lagrangian",
                ItemKind::Impacts(_) => "impacts",
                ItemKind::Emit(_) => "emit",
                _ => continue,
            };
            if known.contains(&word) {
                self.sink.report(Code::SameTwice, item.keyword, &[&word]);
            }
            known.push(word);
        }
    }

    /// Either a Lagrangian, or kinetic energies.
    pub fn check_energies(&mut self, declaration: &Declaration) {
        let is_there = |kind: fn(&ItemKind) -> bool| {
            let mut items = declaration.items.iter();
            items.any(|item| kind(&item.kind))
        };
        let lagrangian = is_there(|kind| matches!(kind, ItemKind::Lagrangian(_)));
        let kinetic = is_there(|kind| matches!(kind, ItemKind::Kinetic(_)));
        let [mut first_kinetic, mut first_potential] = [true, true];
        for item in &declaration.items {
            let (word, head, first) = match &item.kind {
                ItemKind::Kinetic(energy) => ("kinetic", &energy.head, &mut first_kinetic),
                ItemKind::Potential(energy) => ("potential", &energy.head, &mut first_potential),
                _ => continue,
            };
            if lagrangian {
                self.sink
                    .report(Code::LagrangianExcludes, item.keyword, &[&word]);
            }
            if head.is_none() && !std::mem::replace(first, false) {
                self.sink.report(Code::UnnamedTwice, item.keyword, &[&word]);
            }
        }
        if !lagrangian && !kinetic {
            self.sink.report(Code::NoKinetic, &declaration.name, &[]);
        }
    }

    pub fn energy_term(&mut self, kind: Kind, energy: &Energy, keyword: Span) {
        let context = match kind {
            Kind::Kinetic => KINETIC,
            _ => POTENTIAL,
        };
        let add = |this: &mut Self, name: ItemName| {
            let value = &energy.value;
            let energy = this.scalar(value, context)?;
            if kind == Kind::Kinetic {
                this.check_at_rest(energy, value)?;
            }
            let terms = match kind {
                Kind::Kinetic => &mut this.system.kinetic,
                _ => &mut this.system.potential,
            };
            terms.push(EnergyTerm { name, energy });
            Some(terms.len() - 1)
        };
        match &energy.head {
            Some(head) => self.each(head, add),
            None => {
                let name = unnamed(
                    if kind == Kind::Kinetic {
                        "kinetic"
                    } else {
                        "potential"
                    },
                    keyword,
                );
                self.dropped |= add(self, name).is_none();
            }
        }
    }

    /// What is left of a kinetic energy where nothing moves comes from moving frames, and is not negative. A term without
    /// velocities that is negative somewhere belongs elsewhere.
    fn check_at_rest(&mut self, energy: ExprId, written: &Expr) -> Option<()> {
        /// Number of states that are looked at.
        const STATES: u32 = 16;
        let mistaken = self.sink.count() > 0 || self.system.coordinates.is_empty();
        if mistaken || self.rates.is_some() || !self.system.pool.branches(energy).is_empty() {
            return Some(());
        }
        let moves = self.depth(&[energy]) >= Depth::Velocity;
        let zero = self.system.pool.integer(0);
        let rest: Vec<_> = self.velocities().into_iter().map(|v| (v, zero)).collect();
        let left = self.system.pool.substitute(energy, &rest);
        if self.system.pool.is_zero(left) {
            return Some(());
        }
        let changes = |&symbol: &Symbol| {
            symbol == self.system.time || self.depths[symbol.index()] >= Depth::Position
        };
        let negative = (0..STATES).any(|state| {
            let value = |symbol: Symbol| {
                let number = arbitrary(state, symbol);
                if changes(&symbol) {
                    number
                } else {
                    number.abs()
                }
            };
            self.system.pool.evaluate(&[left], &value, &|_| true)[0] < 0.0
        });
        let what = match moves {
            false => format!("`{written}` has no velocity"),
            true if negative => {
                "this kinetic energy is negative in some states of rest".to_string()
            }
            true => return Some(()),
        };
        self.sink
            .report(Code::KineticAtRest, written.extent, &[&what]);
        None
    }

    pub fn split_lagrangian(&mut self, value: &Expr, keyword: Span) {
        let Some(lagrangian) = self.scalar(value, LAGRANGIAN) else {
            return;
        };
        let rest: Vec<(Symbol, ExprId)> = self
            .velocities()
            .into_iter()
            .map(|velocity| (velocity, self.system.pool.integer(0)))
            .collect();
        let at_rest = match self.rates {
            None => self.system.pool.substitute(lagrangian, &rest),
            // Where rates are symbols L stays whole.
            Some(_) => self.system.pool.integer(0),
        };
        if self.system.pool.has_pole(at_rest) {
            return self.sink.report(Code::NoRest, value.extent, &[]);
        }
        let kinetic = self.system.pool.sub(lagrangian, at_rest);
        let potential = self.system.pool.neg(at_rest);
        self.system.from_lagrangian = true;
        self.system.kinetic.push(EnergyTerm {
            name: unnamed("kinetic", keyword),
            energy: kinetic,
        });
        self.system.potential.push(EnergyTerm {
            name: unnamed("potential", keyword),
            energy: potential,
        });
    }

    /// Symbols of all velocities.
    pub fn velocities(&self) -> Vec<Symbol> {
        self.system
            .coordinates
            .iter()
            .map(|coordinate| coordinate.velocity)
            .collect()
    }

    /// L = ΣT − ΣV
    pub fn lagrangian(&mut self) -> ExprId {
        let (kinetic, potential) = self.energies();
        self.system.pool.sub(kinetic, potential)
    }

    /// (ΣT, ΣV)
    fn energies(&mut self) -> (ExprId, ExprId) {
        let total = |terms: &[EnergyTerm]| {
            terms
                .iter()
                .map(|term| term.energy)
                .collect::<Vec<ExprId>>()
        };
        let (kinetic, potential) = (total(&self.system.kinetic), total(&self.system.potential));
        (
            self.system.pool.sum(&kinetic),
            self.system.pool.sum(&potential),
        )
    }

    /// `energy`: T + V as declared, or v·∂L/∂v − L for a Lagrangian.
    pub fn energy(&mut self, name: &Name, context: Context) -> Option<ExprId> {
        if context.reach != Reach::Outputs {
            self.sink.report(Code::OutputOnly, name, &[&"energy"]);
            return None;
        }
        if !self.system.from_lagrangian {
            let (kinetic, potential) = self.energies();
            return Some(self.system.pool.add(kinetic, potential));
        }
        if self.rates.is_some() {
            return None;
        }
        let lagrangian = self.lagrangian();
        let mut terms = vec![self.system.pool.neg(lagrangian)];
        for velocity in self.velocities() {
            let momentum = self.system.pool.differentiate(lagrangian, velocity);
            let v = self.system.pool.leaf(velocity);
            terms.push(self.system.pool.mul(momentum, v));
        }
        Some(self.system.pool.sum(&terms))
    }

    /// Impacts need ∂²L/∂v² without v.
    pub fn check_quadratic(&mut self, declaration: &Declaration) {
        if self.system.contacts.is_empty() {
            return;
        }
        let velocities = self.velocities();
        let (kinetic, _) = self.energies();
        let Some(velocity) = self.not_quadratic_in(kinetic, &velocities) else {
            return;
        };
        let from_lagrangian = self.system.from_lagrangian;
        let what = if from_lagrangian {
            "Lagrangian"
        } else {
            "kinetic energy"
        };
        let item = declaration.items.iter().find(|item| match item.kind {
            ItemKind::Lagrangian(_) => from_lagrangian,
            ItemKind::Kinetic(_) => !from_lagrangian,
            _ => false,
        });
        if let Some(item) = item {
            let velocity = self.system.pool.name(velocity).to_string();
            self.sink
                .report(Code::NotQuadratic, item.keyword, &[&what, &velocity]);
        }
    }
}

/// A number between −1 and 1 for a symbol in a state (the golden ratio spreads them).
pub(super) fn arbitrary(state: u32, symbol: Symbol) -> f64 {
    let k = f64::from(state + 1) + 7.31 * (symbol.index() + 1) as f64;
    2.0 * (k * 0.618_033_988_749_894_9).fract() - 1.0
}

fn unnamed(text: &str, span: Span) -> ItemName {
    ItemName {
        text: text.to_string(),
        ident: None,
        element: None,
        span,
    }
}
