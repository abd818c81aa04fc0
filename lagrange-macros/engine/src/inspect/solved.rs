//! The unknowns of a mode in closed form, where that is short enough to be read.
//!
//! The equations are linear in accelerations and multipliers. They are eliminated one by one, those whose coefficient is a
//! single term first, so that nothing is divided by a sum before it has to be. Every result is tried out in numbers before
//! it is told; what fails, or is long, is left out.

use super::formula::{Formula, Statement};
use super::work::Work;
use crate::symbolic::{ExprId, Node, Symbol};

/// More unknowns are not solved for.
const MOST_UNKNOWNS: usize = 9;

/// Solutions with more to read are left out.
const LONGEST: usize = 44;

/// A solution is put into the others if they stay as short as this.
const SHORT: usize = 26;

/// Entries with more parts end the attempt.
const MOST_PARTS: usize = 80;

/// So many unknowns that are tied by sums are solved for.
const MOST_TIED: usize = 2;

/// From here on a coefficient is a sum, or may vanish.
const SUMS: u8 = 3;

/// Σ coefficients · unknowns + rest = 0
struct Line {
    coefficients: Vec<ExprId>,
    rest: ExprId,
}

impl Work<'_> {
    /// Unknowns in closed form, in their order; `residuals` vanish, and `known` symbols are what a mode leaves free.
    pub fn solved(&mut self, residuals: &[ExprId], unknowns: &[Symbol]) -> Vec<Statement> {
        let Some(solutions) = self.solutions(residuals, unknowns) else {
            return Vec::new();
        };
        let mut statements = Vec::new();
        for &unknown in unknowns {
            let Some(&(_, value)) = solutions.iter().find(|&&(symbol, _)| symbol == unknown) else {
                continue;
            };
            let right = self.reader.formula(value);
            if right.size() <= LONGEST {
                let left = Formula::Letter(self.names.letter(unknown));
                statements.push(Statement::equal(left, right));
            }
        }
        statements
    }

    /// Each unknown with its value, which may contain other unknowns.
    fn solutions(
        &mut self,
        residuals: &[ExprId],
        unknowns: &[Symbol],
    ) -> Option<Vec<(Symbol, ExprId)>> {
        if unknowns.len() > MOST_UNKNOWNS || residuals.len() != unknowns.len() {
            return None;
        }
        let numbers = self.in_numbers(residuals, unknowns)?;
        let mut lines = Vec::new();
        for &residual in residuals {
            let (coefficients, rest) = self.pool().coefficients_linear(residual, unknowns)?;
            lines.push(Line { coefficients, rest });
        }
        let mut solutions: Vec<(Symbol, ExprId)> = Vec::new();
        let mut left: Vec<usize> = (0..unknowns.len()).collect();
        while !left.is_empty() {
            let (doubt, row, at) = self.pivot(&lines, &left)?;
            // Several unknowns that are tied by sums have no solution that anybody would read.
            if doubt >= SUMS && left.len() > MOST_TIED {
                break;
            }
            let line = lines.swap_remove(row);
            let value = self.value(&line, at, unknowns)?;
            for other in &mut lines {
                self.eliminate(other, &line, at)?;
            }
            solutions.push((unknowns[at], value));
            left.retain(|&unknown| unknown != at);
        }
        // The last one stands alone; the others become so one after the other.
        for i in (0..solutions.len()).rev() {
            let (symbol, value) = solutions[i];
            if !self.agrees(value, symbol, unknowns, &numbers) {
                return None;
            }
            for earlier in solutions[..i].iter_mut() {
                if self.pool().depends_on(earlier.1, symbol) {
                    let put = self.pool().substitute(earlier.1, &[(symbol, value)]);
                    let put = self.tidy(put);
                    if self.reader.formula(put).size() <= SHORT {
                        earlier.1 = put;
                    }
                }
            }
        }
        Some(solutions)
    }

    /// The entry to eliminate by: a single term if there is one, with the least to do.
    fn pivot(&mut self, lines: &[Line], left: &[usize]) -> Option<(u8, usize, usize)> {
        let mut best = None;
        let entries: Vec<ExprId> = lines
            .iter()
            .flat_map(|line| left.iter().map(|&at| line.coefficients[at]))
            .collect();
        let mut numbers = self.evaluate(&entries, &sample).into_iter();
        for (row, line) in lines.iter().enumerate() {
            for &at in left {
                let entry = line.coefficients[at];
                if !numbers.next().is_some_and(|number| number.abs() > 1e-9) {
                    continue;
                }
                let filled = |line: &&Line| !self.names_zero(line.coefficients[at]);
                let column = lines.iter().filter(filled).count();
                let across = left
                    .iter()
                    .filter(|&&j| !self.names_zero(line.coefficients[j]));
                let work = (across.count() - 1) * column.saturating_sub(1);
                let key = (self.doubt(entry), work, row, at);
                if best.is_none_or(|best| key < best) {
                    best = Some(key);
                }
            }
        }
        best.map(|(doubt, _, row, at)| (doubt, row, at))
    }

    /// How well it can be divided by: numbers, then parameters, then positions, then sums, then functions, which vanish.
    fn doubt(&mut self, e: ExprId) -> u8 {
        let moving = !self.reader.is_still(e);
        let pool = self.reader.peek();
        let single = |e: ExprId| !matches!(pool.node(e), Node::Sum { .. } | Node::Call(..));
        match pool.node(e) {
            Node::Number(_) | Node::Pi => 0,
            Node::Symbol(_) => 1 + u8::from(moving),
            Node::Product(factors) if factors.iter().all(|&(base, _)| single(base)) => {
                1 + u8::from(moving)
            }
            Node::Sum { terms, constant } if terms.len() == 1 && constant.is_zero() => {
                let inner = terms[0].0;
                self.doubt(inner).max(1)
            }
            Node::Product(factors)
                if factors
                    .iter()
                    .any(|&(base, _)| matches!(pool.node(base), Node::Call(..))) =>
            {
                4
            }
            Node::Call(..) => 4,
            _ => SUMS,
        }
    }

    fn names_zero(&self, e: ExprId) -> bool {
        self.reader.peek().is_zero(e)
    }

    /// −(rest + Σ others)/coefficient
    fn value(&mut self, line: &Line, at: usize, unknowns: &[Symbol]) -> Option<ExprId> {
        let pool = self.reader.pool();
        let mut terms = vec![line.rest];
        for (j, &c) in line.coefficients.iter().enumerate() {
            if j != at {
                let unknown = pool.leaf(unknowns[j]);
                terms.push(pool.mul(c, unknown));
            }
        }
        let sum = pool.sum(&terms);
        let sum = self.tidy(sum);
        self.quotient(sum, line.coefficients[at])
            .map(|q| self.reader.pool().neg(q))
    }

    /// a/b with what both share cancelled.
    fn quotient(&mut self, a: ExprId, b: ExprId) -> Option<ExprId> {
        let b = self.tidy(b);
        let pool = self.reader.pool();
        let (a, b) = (pool.factor(a), pool.factor(b));
        pool.div(a, b)
    }

    /// Takes an unknown out of a line.
    fn eliminate(&mut self, line: &mut Line, by: &Line, at: usize) -> Option<()> {
        if self.names_zero(line.coefficients[at]) {
            return Some(());
        }
        let factor = self.quotient(line.coefficients[at], by.coefficients[at])?;
        for j in 0..line.coefficients.len() {
            line.coefficients[j] = match j == at {
                true => self.reader.pool().integer(0),
                false => self.less(line.coefficients[j], factor, by.coefficients[j])?,
            };
        }
        line.rest = self.less(line.rest, factor, by.rest)?;
        Some(())
    }

    /// a − factor · b
    fn less(&mut self, a: ExprId, factor: ExprId, b: ExprId) -> Option<ExprId> {
        let pool = self.reader.pool();
        let product = pool.mul(factor, b);
        let difference = pool.sub(a, product);
        let tidy = self.tidy(difference);
        self.is_small(tidy).then_some(tidy)
    }

    /// Whether it has few parts.
    fn is_small(&self, e: ExprId) -> bool {
        let pool = self.reader.peek();
        let mut stack = vec![e];
        let mut parts = 0;
        while let Some(e) = stack.pop() {
            parts += 1;
            if parts > MOST_PARTS {
                return false;
            }
            pool.node(e).for_each_child(|child| stack.push(child));
        }
        true
    }

    /// Multiplied out where that is possible, so that terms cancel.
    fn tidy(&mut self, e: ExprId) -> ExprId {
        self.reader.multiplied_out(e).unwrap_or(e)
    }

    /// Whether a value is what elimination in numbers gives.
    fn agrees(&self, value: ExprId, symbol: Symbol, unknowns: &[Symbol], numbers: &[f64]) -> bool {
        let at = |s: Symbol| match unknowns.iter().position(|&u| u == s) {
            Some(i) => numbers[i],
            None => sample(s),
        };
        let (expected, found) = (at(symbol), self.evaluate(&[value], &at)[0]);
        (found - expected).abs() <= 1e-7 * (1.0 + expected.abs())
    }

    /// The unknowns at the sample point, by elimination with pivoting.
    fn in_numbers(&mut self, residuals: &[ExprId], unknowns: &[Symbol]) -> Option<Vec<f64>> {
        let n = unknowns.len();
        let mut entries = Vec::new();
        for &residual in residuals {
            let (coefficients, rest) = self.pool().coefficients_linear(residual, unknowns)?;
            entries.extend(coefficients);
            entries.push(self.pool().neg(rest));
        }
        let values = self.evaluate(&entries, &sample);
        let mut rows: Vec<Vec<f64>> = values.chunks(n + 1).map(<[f64]>::to_vec).collect();
        for column in 0..n {
            let largest = (column..n)
                .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
            rows.swap(column, largest);
            let pivot = rows[column].clone();
            if pivot[column].abs() < 1e-12 {
                return None;
            }
            for (i, row) in rows.iter_mut().enumerate() {
                if i != column {
                    let factor = row[column] / pivot[column];
                    for (entry, own) in row.iter_mut().zip(&pivot) {
                        *entry -= factor * own;
                    }
                }
            }
        }
        Some((0..n).map(|i| rows[i][n] / rows[i][i]).collect())
    }

    fn evaluate(&self, list: &[ExprId], at: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        self.reader.peek().evaluate(list, at, &|_| true)
    }
}

/// Some number for each symbol.
fn sample(symbol: Symbol) -> f64 {
    0.4 + (0.618_033_988_7 * (symbol.index() + 1) as f64).fract()
}
