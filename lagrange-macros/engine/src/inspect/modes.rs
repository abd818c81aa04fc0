//! A mode in full: its unknowns, equations, solution and guards.

use super::Mode;
use super::choice::{self, Choice, State};
use super::formula::{Formula, Statement};
use super::work::Work;
use crate::model::Level;
use crate::symbolic::{ExprId, Symbol};

/// Systems with more coordinates are not solved.
const MOST_SOLVED: usize = 6;

/// A row that says coordinate = value.
struct Pin {
    row: usize,
    coordinate: usize,
    value: ExprId,
}

/// What the equations of a mode are made of.
struct Parts<'a> {
    choice: &'a Choice,
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
    /// Rows whose accelerations are zero in a mode.
    pub fn acting(&self, choice: &Choice) -> Vec<usize> {
        let system = self.system();
        let mut rows = Vec::new();
        for (i, c) in system.constraints.iter().enumerate() {
            if c.while_contact
                .is_none_or(|contact| choice.contacts[contact])
            {
                rows.push(i);
            }
        }
        let closed = choice
            .contacts
            .iter()
            .enumerate()
            .filter(|(_, closed)| **closed);
        rows.extend(closed.map(|(i, _)| self.contact_row(i)));
        for (i, state) in choice.frictions.iter().enumerate() {
            if *state == State::Sticks {
                rows.extend(self.slip_rows(i));
            }
        }
        rows
    }

    /// A mode in full.
    pub fn mode(&mut self, choice: &Choice) -> Mode {
        let parts = self.parts(choice);
        let known = self.pinned(&parts);
        let unknowns = self.unknowns(&parts);
        let equations = self.equations(&parts);
        let solution = self.solution(&parts, &unknowns).unwrap_or_default();
        let guards = self.guards(choice, &parts.known);
        let [operations, with_guards] = self.operations(choice);
        Mode {
            name: choice::name(self.system(), choice),
            known,
            unknowns: unknowns
                .into_iter()
                .map(|symbol| self.names.letter(symbol))
                .collect(),
            equations,
            solution,
            guards,
            operations,
            with_guards,
        }
    }

    fn parts<'c>(&mut self, choice: &'c Choice) -> Parts<'c> {
        let acting = self.acting(choice);
        let mut loaded = acting.clone();
        for (i, state) in choice.frictions.iter().enumerate() {
            if !matches!(state, State::Inactive | State::Sticks) {
                loaded.extend(self.slip_rows(i));
            }
        }
        loaded.sort_unstable();
        let pins = self.pins(&acting);
        let zero = self.pool().integer(0);
        let mut known = Vec::new();
        for pin in &pins {
            let item = &self.system().coordinates[pin.coordinate];
            known.push((item.position, pin.value));
            known.push((item.velocity, zero));
            known.push((item.acceleration, zero));
        }
        Parts {
            choice,
            acting,
            loaded,
            pins,
            known,
        }
    }

    /// Acting rows that say coordinate = value; one for each coordinate.
    fn pins(&mut self, acting: &[usize]) -> Vec<Pin> {
        let system = &self.program.equations.system;
        let structure = &self.program.equations.structure;
        let parameters: Vec<Symbol> = system.parameters.iter().map(|p| p.symbol).collect();
        let mut pins: Vec<Pin> = Vec::new();
        for &row in acting {
            let held = system
                .constraints
                .get(row)
                .is_none_or(|c| c.level == Level::Position);
            let (Some(position), &[(coordinate, entry)]) = (
                structure.rows[row].position,
                structure.rows[row].jacobian.as_slice(),
            ) else {
                continue;
            };
            let (gap, entry) = (self.output(position), self.output(entry));
            let pool = self.pool();
            let Some(sign) = pool.as_number(entry).filter(|n| held && n.is_unit()) else {
                continue;
            };
            let leaf = pool.leaf(system.coordinates[coordinate].position);
            // g = ±(q − value)
            let scaled = pool.scale(gap, sign);
            let value = pool.sub(leaf, scaled);
            let fixed = pool.symbols(value).iter().all(|s| parameters.contains(s));
            if fixed && !pins.iter().any(|pin| pin.coordinate == coordinate) {
                pins.push(Pin {
                    row,
                    coordinate,
                    value,
                });
            }
        }
        pins
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
        let multipliers = self.multipliers();
        free.map(|(_, coordinate)| coordinate.acceleration)
            .chain(parts.loaded.iter().map(|&row| multipliers[row]))
            .collect()
    }

    /// What determines the unknowns.
    fn equations(&mut self, parts: &Parts) -> Vec<Statement> {
        let mut equations = Vec::new();
        for i in Work::shown(self.system().coordinates.len()) {
            equations.push(self.balance(i, parts));
        }
        let rows = parts.rows();
        for at in Work::shown(rows.len()) {
            equations.push(self.acceleration(rows[at], &parts.known));
        }
        for (i, state) in parts.choice.frictions.iter().enumerate() {
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
        let multiplier = self.multipliers()[pin.row];
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
        if !self.solves || coordinates > MOST_SOLVED {
            return None;
        }
        let mut residuals = Vec::new();
        for i in 0..coordinates {
            residuals.push(self.balance_residual(i, parts));
        }
        for row in parts.rows() {
            residuals.push(self.acceleration_residual(row, &parts.known));
        }
        for (i, state) in parts.choice.frictions.iter().enumerate() {
            if !matches!(state, State::Inactive | State::Sticks) {
                let law = self.sliding_residual(i, *state)?;
                residuals.push(self.pool().substitute(law, &parts.known));
            }
        }
        Some(self.solved(&residuals, unknowns))
    }
}
