//! The equations of motion with all multipliers, rows on the level of accelerations, and the balance of an impact.

use super::formula::{Formula, Relation, Statement};
use super::letter::{Letter, Mark};
use super::work::Work;
use super::{Equation, Impact, Row};
use crate::model::{Level, Normal, Restitution};
use crate::symbolic::{ExprId, Rational, Symbol};

/// Of more items of one kind only the first few and the last one are shown.
const MOST_SHOWN: usize = 12;
const FIRST_SHOWN: usize = 4;

/// Sides of equations with more to read are shortened.
const MOST_READ: usize = 240;

/// Momenta that are shown.
pub(super) const MOST_CYCLIC: usize = 12;

/// What stands for symbols.
pub(super) type Known = [(Symbol, ExprId)];

impl Work<'_> {
    /// Which of so many items are shown.
    pub fn shown(count: usize) -> Vec<usize> {
        match count {
            0..=MOST_SHOWN => (0..count).collect(),
            _ => (0..FIRST_SHOWN).chain([count - 1]).collect(),
        }
    }

    /// M v̇ = f + Σ aᵀλ, one per coordinate.
    pub fn motion(&mut self) -> Vec<Equation> {
        let rows: Vec<usize> = (0..self.program.equations.structure.rows.len()).collect();
        let count = self.system().coordinates.len();
        Work::shown(count)
            .into_iter()
            .map(|i| {
                let left = self.inertia(i, &[]);
                let right = self.load(i, &rows, &[]);
                let label = self.names.letter(self.system().coordinates[i].position);
                Equation {
                    label,
                    statement: Statement::equal(left, right),
                }
            })
            .collect()
    }

    /// T: as it is computed, or by velocities, ½ vᵀM v, where that is all of it and reads better.
    pub fn kinetic(&mut self) -> Formula {
        let structure = &self.program.equations.structure;
        let declared = self.output(structure.energy.0);
        let as_is = self.reader.formula(declared);
        match self.quadratic_form(declared) {
            Some(quadratic) => {
                let by_velocities = self.reader.formula(quadratic);
                // The form of the textbook, if it is not much longer.
                match 3 * by_velocities.effort() <= 4 * as_is.effort() {
                    true => by_velocities,
                    false => as_is,
                }
            }
            None => as_is,
        }
    }

    /// ½ vᵀM v if that is T: it is, if M is free of v, and T and ∂T/∂v vanish with v.
    fn quadratic_form(&mut self, kinetic: ExprId) -> Option<ExprId> {
        let coordinates = &self.program.equations.system.coordinates;
        let velocities: Vec<Symbol> = coordinates.iter().map(|c| c.velocity).collect();
        if velocities.len() > MOST_SHOWN {
            return None;
        }
        let zero = self.pool().integer(0);
        let rest: Vec<_> = velocities.iter().map(|&v| (v, zero)).collect();
        let mut vanishing = vec![kinetic];
        for &velocity in &velocities {
            vanishing.push(self.pool().differentiate(kinetic, velocity));
        }
        for e in vanishing {
            let pool = self.pool();
            let at_rest = pool.substitute(e, &rest);
            if !pool.is_zero(at_rest) {
                return None;
            }
        }
        let mut terms = Vec::new();
        for &(i, j, entry) in &self.program.equations.structure.mass {
            let entry = self.output(entry);
            let pool = self.pool();
            if pool.depends_on_any(entry, &velocities) {
                return None;
            }
            let (a, b) = (pool.leaf(velocities[i]), pool.leaf(velocities[j]));
            let term = pool.product(&[entry, a, b]);
            let half = pool.scale(term, Rational::HALF);
            terms.push(if i == j { half } else { term });
        }
        Some(self.pool().sum(&terms))
    }

    /// Terms of row i of M v̇, its own acceleration first.
    pub fn inertia_terms(&mut self, i: usize, known: &Known) -> Vec<ExprId> {
        let mass = &self.program.equations.structure.mass;
        let mut entries: Vec<(usize, _)> = mass
            .iter()
            .filter(|(row, column, _)| *row == i || *column == i)
            .map(|&(row, column, entry)| (if row == i { column } else { row }, entry))
            .collect();
        entries.sort_by_key(|&(j, _)| (j != i, j));
        let mut terms = Vec::new();
        for (j, entry) in entries {
            let acceleration = self.system().coordinates[j].acceleration;
            let entry = self.output(entry);
            let pool = self.pool();
            let acceleration = pool.leaf(acceleration);
            let term = pool.mul(entry, acceleration);
            let term = pool.substitute(term, known);
            if !pool.is_zero(term) {
                terms.push(term);
            }
        }
        terms
    }

    /// Row i of M v̇.
    pub fn inertia(&mut self, i: usize, known: &Known) -> Formula {
        let terms = self.inertia_terms(i, known);
        self.side_by_side(&terms)
    }

    /// A sum whose terms keep their order.
    pub fn side_by_side(&mut self, terms: &[ExprId]) -> Formula {
        let mut formulas = Vec::new();
        for &term in terms {
            formulas.push(self.reader.formula(term));
        }
        Formula::sum(formulas).shortened(MOST_READ)
    }

    /// Terms of f + Σ aᵀλ over these rows: applied forces first, then multiplier by multiplier.
    pub fn load_terms(&mut self, i: usize, rows: &[usize], known: &Known) -> Vec<ExprId> {
        let structure = &self.program.equations.structure;
        let forcing = self.output(structure.forcing[i]);
        let multipliers = self.multipliers();
        let mut terms = vec![self.pool().substitute(forcing, known)];
        for &row in rows {
            let entries = structure.rows[row].jacobian.iter();
            let own = entries.filter(|&&(j, _)| j == i).map(|&(_, entry)| entry);
            let couplings = structure.couplings.iter();
            let coupled = couplings
                .filter(|c| c.coordinate == i && c.row == row)
                .map(|c| c.factor);
            let factors: Vec<_> = own.chain(coupled).collect();
            let mut sum = Vec::new();
            for factor in factors {
                sum.push(self.output(factor));
            }
            let pool = self.pool();
            let factor = pool.sum(&sum);
            let multiplier = pool.leaf(multipliers[row]);
            let term = pool.mul(factor, multiplier);
            terms.push(pool.substitute(term, known));
        }
        let pool = self.pool();
        terms.retain(|&term| !pool.is_zero(term));
        terms
    }

    /// Row i of f + Σ aᵀλ.
    pub fn load(&mut self, i: usize, rows: &[usize], known: &Known) -> Formula {
        let terms = self.load_terms(i, rows, known);
        self.side_by_side(&terms)
    }

    /// a v̇ + γ
    pub fn acceleration_residual(&mut self, row: usize, known: &Known) -> ExprId {
        let (left, bias) = self.acceleration_sides(row);
        let pool = self.pool();
        let residual = pool.add(left, bias);
        pool.substitute(residual, known)
    }

    /// a v̇, and γ.
    fn acceleration_sides(&mut self, row: usize) -> (ExprId, ExprId) {
        let numbers = &self.program.equations.structure.rows[row];
        let mut terms = Vec::new();
        for &(j, entry) in &numbers.jacobian {
            let symbol = self.system().coordinates[j].acceleration;
            let entry = self.output(entry);
            let pool = self.pool();
            let acceleration = pool.leaf(symbol);
            terms.push(pool.mul(entry, acceleration));
        }
        let bias = self.output(numbers.bias);
        (self.pool().sum(&terms), bias)
    }

    /// a v̇ = −γ
    pub fn acceleration(&mut self, row: usize, known: &Known) -> Statement {
        let (left, bias) = self.acceleration_sides(row);
        let pool = self.pool();
        let left = pool.substitute(left, known);
        let right = pool.neg(bias);
        let right = pool.substitute(right, known);
        let (left, right) = (self.reader.formula(left), self.reader.formula(right));
        Statement::equal(left, right)
    }

    /// The slip, or the rate of a constraint or gap.
    pub fn rate(&mut self, row: usize, known: &Known) -> Formula {
        let velocity = self.output(self.program.equations.structure.rows[row].velocity);
        let velocity = self.pool().substitute(velocity, known);
        self.reader.formula(velocity)
    }

    /// All rows.
    pub fn rows(&mut self) -> Vec<Row> {
        let multipliers = self.multipliers();
        let mut rows = Vec::new();
        for (i, c) in self.system().constraints.iter().enumerate() {
            let when = match c.while_contact {
                Some(contact) => format!("{} closed", self.system().contacts[contact].name.text),
                None => "always".to_owned(),
            };
            let relation = match c.level {
                Level::Position | Level::Velocity => Relation::Equal,
            };
            rows.push((
                i,
                c.name.text.clone(),
                "constraint",
                c.residual,
                relation,
                when,
            ));
        }
        for (i, c) in self.system().contacts.iter().enumerate() {
            let (row, when) = (self.contact_row(i), format!("{} closed", c.name.text));
            let name = c.name.text.clone();
            rows.push((row, name, "contact", c.gap, Relation::AtLeast, when));
        }
        let mut row = self.contact_row(self.system().contacts.len());
        for f in &self.system().frictions {
            for &(slip, _) in &f.slip {
                let when = format!("{} sticks", f.name.text);
                rows.push((
                    row,
                    f.name.text.clone(),
                    "friction",
                    slip,
                    Relation::Equal,
                    when,
                ));
                row += 1;
            }
        }
        let shown = Work::shown(rows.len());
        shown
            .into_iter()
            .map(|at| {
                let (row, name, kind, declared, relation, when) = rows[at].clone();
                let declared = self.reader.formula(declared);
                Row {
                    name,
                    kind,
                    declared: Statement::new(declared, relation, Formula::ZERO),
                    acceleration: self.acceleration(row, &[]),
                    multiplier: self.names.letter(multipliers[row]),
                    when,
                }
            })
            .collect()
    }

    /// What happens at an impact of each contact alone.
    pub fn impacts(&mut self) -> Vec<Impact> {
        let shown = Work::shown(self.system().contacts.len());
        shown
            .into_iter()
            .map(|contact| self.impact(contact))
            .collect()
    }

    fn impact(&mut self, contact: usize) -> Impact {
        let system = &self.program.equations.system;
        let item = &system.contacts[contact];
        let row = self.contact_row(contact);
        let mut rows: Vec<usize> = (0..system.constraints.len())
            .filter(|&i| {
                system.constraints[i]
                    .while_contact
                    .is_none_or(|c| c == contact)
            })
            .collect();
        let bilateral = rows.clone();
        rows.push(row);
        let mut note = String::new();
        let mut slip_row = self.contact_row(system.contacts.len());
        for friction in &system.frictions {
            let own = matches!(friction.normal, Normal::Contact(c) if c == contact);
            if own {
                rows.extend(slip_row..slip_row + friction.slip.len());
                note = format!(
                    "The impulse of {} makes its slip zero if that takes no more than static friction allows, \
                     else it is kinetic friction against the slip.",
                    friction.name.text
                );
            }
            slip_row += friction.slip.len();
        }
        let mut equations = Vec::new();
        for i in Work::shown(system.coordinates.len()) {
            let left = self.inertia(i, &[]).with_jumps();
            let zero = self.impulses(i, &rows);
            equations.push(Statement::equal(left, zero));
        }
        for &row in &bilateral {
            let after = self.rate(row, &[]).with_velocities(Mark::After);
            equations.push(Statement::equal(after, Formula::ZERO));
        }
        let rate = self.rate(row, &[]);
        let (Restitution::Newton(e) | Restitution::Poisson(e)) = item.restitution;
        let after = rate.with_velocities(Mark::After);
        match item.restitution {
            Restitution::Newton(_) => {
                let back = self.restituted(e, &rate);
                equations.push(Statement::equal(after, back));
            }
            Restitution::Poisson(_) => {
                note = format!(
                    "Poisson: the impulse of restitution is {} times that of compression. {note}",
                    super::print::text::formula(&self.reader.formula(e))
                );
            }
        }
        let gap = self.reader.formula(item.gap);
        Impact {
            contact: item.name.text.clone(),
            when: [
                Statement::equal(gap, Formula::ZERO),
                Statement::new(
                    rate.with_velocities(Mark::Before),
                    Relation::Below,
                    Formula::ZERO,
                ),
            ],
            equations,
            note: note.trim().to_owned(),
        }
    }

    /// −e ṡ⁻
    fn restituted(&mut self, e: ExprId, rate: &Formula) -> Formula {
        let before = rate.with_velocities(Mark::Before);
        match (self.pool().is_zero(e), self.pool().is_one(e)) {
            (true, _) => Formula::ZERO,
            (_, true) => before.negated(),
            _ => {
                let (minus, before) = before.signed();
                let product = Formula::Product(vec![self.reader.formula(e), before]);
                if minus { product } else { product.negated() }
            }
        }
    }

    /// Row i of Σ aᵀΛ.
    fn impulses(&mut self, i: usize, rows: &[usize]) -> Formula {
        let multipliers = self.multipliers();
        let structure = &self.program.equations.structure;
        let mut terms = Vec::new();
        for &row in rows {
            for &(j, entry) in &structure.rows[row].jacobian {
                if j == i {
                    let entry = self.output(entry);
                    let pool = self.pool();
                    let multiplier = pool.leaf(multipliers[row]);
                    terms.push(pool.mul(entry, multiplier));
                }
            }
        }
        let impulse = |letter: &Letter| match letter.base.as_str() {
            "λ" | "N" | "F" if letter.rate == 0 && !letter.subscript.is_empty() => Letter {
                base: "Λ".to_owned(),
                ..letter.clone()
            },
            _ => letter.clone(),
        };
        let forces: Vec<Letter> = rows
            .iter()
            .map(|&r| self.names.letter(multipliers[r]))
            .collect();
        self.side_by_side(&terms)
            .with_letters(&|letter| match forces.contains(letter) {
                true => impulse(letter),
                false => letter.clone(),
            })
    }

    /// Whether e is a number of size 1.
    pub fn is_unit(&mut self, e: ExprId) -> Option<Rational> {
        self.pool().as_number(e).filter(|n| n.is_unit())
    }
}
