//! The equations of motion with all multipliers, and rows on the level of accelerations.

use super::excerpt::excerpt;
use super::formula::{Formula, Relation, Statement};
use super::work::Work;
use super::{Equation, Row};
use crate::symbolic::{ExprId, Symbol};

/// Sides of equations with more to read are shortened.
const MOST_READ: usize = 240;

/// What stands for symbols.
pub(super) type Known = [(Symbol, ExprId)];

impl Work<'_> {
    /// M v̇ = f + Σ aᵀλ, one per coordinate.
    pub fn motion(&mut self) -> Vec<Equation> {
        let rows: Vec<usize> = (0..self.equations.structure.rows.len()).collect();
        let count = self.system().coordinates.len();
        excerpt(count)
            .into_iter()
            .map(|i| {
                let left = self.inertia(i, &[]);
                let right = self.load(i, &rows, &[]);
                let label = self.names.coordinate(&self.system().coordinates[i]);
                Equation {
                    label,
                    statement: Statement::equal(left, right),
                }
            })
            .collect()
    }

    /// Terms of row i of M v̇, its own acceleration first.
    pub fn inertia_terms(&mut self, i: usize, known: &Known) -> Vec<ExprId> {
        let mass = &self.equations.structure.mass;
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
        let structure = &self.equations.structure;
        let forcing = self.output(structure.forcing[i]);
        let multipliers = self.system().multipliers();
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
        let numbers = &self.equations.structure.rows[row];
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
        let velocity = self.output(self.equations.structure.rows[row].velocity);
        let velocity = self.pool().substitute(velocity, known);
        self.reader.formula(velocity)
    }

    /// All rows.
    pub fn rows(&mut self) -> Vec<Row> {
        let multipliers = self.system().multipliers();
        let mut rows = Vec::new();
        for (i, c) in self.system().constraints.iter().enumerate() {
            let when = match c.while_contact {
                Some(contact) => format!("{} closed", self.system().contacts[contact].name.text),
                None => "always".to_owned(),
            };
            let name = c.name.text.clone();
            rows.push((i, name, "constraint", c.residual, Relation::Equal, when));
        }
        for (i, c) in self.system().contacts.iter().enumerate() {
            let (row, when) = (
                self.system().contact_row(i),
                format!("{} closed", c.name.text),
            );
            let name = c.name.text.clone();
            rows.push((row, name, "contact", c.gap, Relation::AtLeast, when));
        }
        for (i, f) in self.system().frictions.iter().enumerate() {
            for (row, &(slip, _)) in self.system().slip_rows(i).zip(&f.slip) {
                let (name, when) = (f.name.text.clone(), format!("{} sticks", f.name.text));
                rows.push((row, name, "friction", slip, Relation::Equal, when));
            }
        }
        let shown = excerpt(rows.len());
        shown
            .into_iter()
            .map(|at| {
                let (row, name, kind, declared, relation, when) = rows[at].clone();
                let declared = self.reader.formula(declared);
                let contact = (0..self.system().contacts.len())
                    .find(|&contact| self.system().contact_row(contact) == row);
                Row {
                    name,
                    kind,
                    declared: Statement::new(declared, relation, Formula::ZERO),
                    region: contact.and_then(|contact| self.region(contact, &[])),
                    acceleration: self.acceleration(row, &[]),
                    multiplier: self.names.letter(multipliers[row]),
                    when,
                }
            })
            .collect()
    }
}
