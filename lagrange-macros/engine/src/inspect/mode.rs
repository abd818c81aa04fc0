//! A mode in full: its unknowns, equations, solution and guards.

use super::Mode;
use super::excerpt::excerpt;
use super::formula::{Formula, Statement};
use super::work::Work;
use crate::modes::{self, Pin};
use crate::symbolic::{ExprId, Symbol};

/// Systems with more coordinates are not solved.
const MOST_SOLVED: usize = 6;

/// What the equations of a mode are made of.
struct Parts<'a> {
    mode: &'a modes::Mode,
    /// Rows whose accelerations are zero.
    acting: Vec<usize>,
    /// Rows with a force: those that act, and slips.
    loaded: Vec<usize>,
    pins: Vec<Pin>,
    /// What the pins say of positions, velocities and accelerations.
    known: Vec<(Symbol, ExprId)>,
}

impl Parts<'_> {
    fn pin(&self, coordinate: usize) -> Option<&Pin> {
        self.pins.iter().find(|pin| pin.coordinate == coordinate)
    }

    /// Rows that act and are not pins.
    fn rows(&self) -> Vec<usize> {
        let is_pin = |row: &usize| self.pins.iter().any(|pin| pin.row == *row);
        let acting = self.acting.iter().copied();
        acting.filter(|row| !is_pin(row)).collect()
    }
}

impl Work<'_> {
    /// A mode in full.
    pub fn mode(&mut self, mode: &modes::Mode) -> Mode {
        let parts = self.parts(mode);
        let known = self.pinned(&parts);
        let unknowns = self.unknowns(&parts);
        let equations = self.equations(&parts);
        let solution = self
            .solves
            .then(|| self.solution(&parts, &unknowns).unwrap_or_default());
        let guards = self.guards(mode, &parts.known);
        Mode {
            name: mode.name(self.system()),
            known,
            unknowns: unknowns
                .into_iter()
                .map(|symbol| self.names.letter(symbol))
                .collect(),
            equations,
            solution,
            guards,
            work: self.counts.of_mode(mode),
        }
    }

    fn parts<'m>(&mut self, mode: &'m modes::Mode) -> Parts<'m> {
        let equations = self.equations;
        let acting = mode.acting_rows(&equations.system);
        let pins = modes::pins(equations, self.reader.pool(), &acting);
        Parts {
            mode,
            loaded: mode.loaded_rows(&equations.system),
            known: modes::pinned(equations, self.reader.pool(), &pins),
            acting,
            pins,
        }
    }

    /// Coordinates that are held fixed.
    fn pinned(&mut self, parts: &Parts) -> Vec<Statement> {
        let mut statements = Vec::new();
        for pin in &parts.pins {
            let position = self.system().coordinates[pin.coordinate].position;
            let letter = Formula::Letter(self.names.letter(position));
            statements.push(Statement::equal(letter, self.reader.formula(pin.value)));
        }
        statements
    }

    /// Accelerations and multipliers.
    fn unknowns(&self, parts: &Parts) -> Vec<Symbol> {
        let coordinates = self.system().coordinates.iter().enumerate();
        let free = coordinates.filter(|&(i, _)| parts.pin(i).is_none());
        let multipliers = self.system().multipliers();
        free.map(|(_, coordinate)| coordinate.acceleration)
            .chain(parts.loaded.iter().map(|&row| multipliers[row]))
            .collect()
    }

    /// What determines the unknowns.
    fn equations(&mut self, parts: &Parts) -> Vec<Statement> {
        let mut equations = Vec::new();
        for i in excerpt(self.system().coordinates.len()) {
            equations.push(self.balance(i, parts));
        }
        let rows = parts.rows();
        for at in excerpt(rows.len()) {
            equations.push(self.acceleration(rows[at], &parts.known));
        }
        for (i, state) in parts.mode.frictions.iter().enumerate() {
            equations.extend(self.sliding(i, *state));
        }
        equations
    }

    /// The balance of coordinate i; of a pinned one solved for the force that holds it.
    fn balance(&mut self, i: usize, parts: &Parts) -> Statement {
        let Some(pin) = parts.pin(i) else {
            let inertia = self.inertia_terms(i, &parts.known);
            let load = self.load_terms(i, &parts.loaded, &parts.known);
            return Statement::equal(self.side_by_side(&inertia), self.side_by_side(&load));
        };
        let rest = self.balance_residual(i, parts);
        let multiplier = self.system().multipliers()[pin.row];
        let pool = self.pool();
        let factor = pool.differentiate(rest, multiplier);
        let Some(sign) = pool.as_number(factor).filter(|n| n.is_unit()) else {
            return Statement::equal(self.reader.formula(rest), Formula::ZERO);
        };
        let leaf = pool.leaf(multiplier);
        let scaled = pool.scale(rest, sign);
        // ±λ + rest = 0
        let value = pool.sub(leaf, scaled);
        let left = Formula::Letter(self.names.letter(multiplier));
        Statement::equal(left, self.reader.formula(value))
    }

    /// Row i of f + Σ aᵀλ − M v̇.
    fn balance_residual(&mut self, i: usize, parts: &Parts) -> ExprId {
        let mut terms = self.load_terms(i, &parts.loaded, &parts.known);
        for term in self.inertia_terms(i, &parts.known) {
            terms.push(self.pool().neg(term));
        }
        self.pool().sum(&terms)
    }

    /// Accelerations and multipliers in closed form; nothing for friction that makes the equations nonlinear.
    fn solution(&mut self, parts: &Parts, unknowns: &[Symbol]) -> Option<Vec<Statement>> {
        let coordinates = self.system().coordinates.len();
        if coordinates > MOST_SOLVED {
            return None;
        }
        let mut residuals = Vec::new();
        for i in 0..coordinates {
            residuals.push(self.balance_residual(i, parts));
        }
        for row in parts.rows() {
            residuals.push(self.acceleration_residual(row, &parts.known));
        }
        for (i, state) in parts.mode.frictions.iter().enumerate() {
            if state.slips() {
                let law = self.sliding_residual(i, *state)?;
                residuals.push(self.pool().substitute(law, &parts.known));
            }
        }
        Some(self.solved(&residuals, unknowns))
    }
}
