//! Velocity constraints that are constraints on positions.
//!
//! ω = a·dq + b dt = 0 restricts positions if ω ∧ dω = 0 (Frobenius 1877): dω(u, w) = 0 for all u, w with ω(u) = ω(w) = 0.
//! Several rows do it together if every dωᵢ vanishes on what all rows leave free. Where `der` can be taken away from
//! the declaration, leaving an equation whose rate is the constraint, the hint says so.

use super::{Pfaffian, STATES, ZERO, is_plain};
use crate::ast::{self, Declaration, Expr, ExprKind, ItemKind};
use crate::model::depth::{Context, Reach};
use crate::model::elaboration::Elaboration;
use crate::model::meaning::Meaning;
use crate::model::{Hint, Level};

const CONSTRAINT: Context = Context::new(Reach::Motion, "a constraint");

/// More second derivatives than this are not taken.
const MOST_DERIVATIVES: usize = 5_000;

impl Elaboration<'_> {
    /// Remarks on velocity constraints that could be written on positions.
    pub(super) fn integrable(&mut self, declaration: &Declaration, rows: &[Pfaffian]) {
        let mut written = Vec::new();
        for item in &declaration.items {
            if let ItemKind::Constraint(constraint) = &item.kind
                && constraint.while_contact.is_none()
                && let Some(found) = self.written(constraint)
            {
                written.push(found);
            }
        }
        let mut open = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let constraint = &self.system.constraints[i];
            let name = constraint.name.clone();
            if constraint.level == Level::Position
                || !is_plain(&self.system.pool, constraint)
                || written.contains(&i)
            {
                continue;
            }
            if self.frobenius(&[row], &[row]) {
                let text = format!(
                    "`{}` restricts positions, not only velocities: write it on positions if you can, then it does not drift",
                    name.text
                );
                let extent = name.span.into();
                self.system.hints.push(Hint { text, extent });
            } else {
                open.push(i);
            }
        }
        let plain = |i: &usize| is_plain(&self.system.pool, &self.system.constraints[*i]);
        let all: Vec<&Pfaffian> = (0..rows.len()).filter(plain).map(|i| &rows[i]).collect();
        let those: Vec<&Pfaffian> = open.iter().map(|&i| &rows[i]).collect();
        if open.len() > 1 && self.frobenius(&those, &all) {
            let names = open
                .iter()
                .map(|&i| format!("`{}`", self.system.constraints[i].name.text));
            let names: Vec<String> = names.collect();
            let text = format!(
                "{} together restrict positions, not only velocities: write them on positions if you can",
                names.join(", ")
            );
            let extent = self.system.constraints[open[0]].name.span.into();
            self.system.hints.push(Hint { text, extent });
        }
    }

    /// The first element of a velocity constraint that is the rate of itself without `der`, after a remark.
    fn written(&mut self, constraint: &ast::Constraint) -> Option<usize> {
        let name = &constraint.head.name;
        let elements = match &self.names.get(&name.text)?.meaning {
            Meaning::Item { elements, .. } => elements.clone(),
            _ => return None,
        };
        let &first = elements.first()?;
        if self.system.constraints[first].level == Level::Position {
            return None;
        }
        let (left, right) = (
            without_der(&constraint.left)?,
            without_der(&constraint.right)?,
        );
        let read = |this: &mut Self| {
            Some((
                this.scalar(&left, CONSTRAINT)?,
                this.scalar(&right, CONSTRAINT)?,
            ))
        };
        let (a, b) = match &constraint.head.index {
            None => read(self)?,
            Some(index) => {
                let (from, _) = self.bounds(&index.range)?;
                self.with_index(&index.name, from, read)?
            }
        };
        let position = self.system.pool.sub(a, b);
        let rate = self.time_rate(position);
        let difference = self
            .system
            .pool
            .sub(rate, self.system.constraints[first].residual);
        let zero = (1..=STATES).all(|state| {
            let values = self.values(&[difference, rate], state);
            values.is_some_and(|v| v[0].abs() <= ZERO * v[1].abs().max(1e-3))
        });
        if !zero || self.depth(&[position]) >= crate::model::depth::Depth::Velocity {
            return None;
        }
        let text = format!(
            "`{}` restricts positions, not only velocities: `{left} == {right}`, but for a constant, holds at every time and does not drift",
            name.text
        );
        let extent = name.into();
        self.system.hints.push(Hint { text, extent });
        Some(first)
    }

    /// Whether every dωᵢ of some rows vanishes on what `all` leave free.
    fn frobenius(&mut self, rows: &[&Pfaffian], all: &[&Pfaffian]) -> bool {
        let mut symbols = self.positions();
        symbols.push(self.system.time);
        let occurring = |this: &Self, rows: &[&Pfaffian]| -> Vec<usize> {
            let occurs = |j: &usize| {
                rows.iter().any(|row| {
                    let coefficient = row.slope.get(*j).unwrap_or(&row.bias);
                    let pool = &this.system.pool;
                    !pool.is_zero(*coefficient)
                        || row
                            .slope
                            .iter()
                            .chain([&row.bias])
                            .any(|e| pool.depends_on(*e, symbols[*j]))
                })
            };
            (0..symbols.len()).filter(occurs).collect()
        };
        let columns = occurring(self, all);
        if rows.len() * columns.len() * columns.len() > MOST_DERIVATIVES {
            return false;
        }
        let coefficient = |row: &Pfaffian, j: usize| *row.slope.get(j).unwrap_or(&row.bias);
        // The coefficients of all rows, then dωᵢ(eⱼ, eₖ) = ∂aₖ/∂xⱼ − ∂aⱼ/∂xₖ of the rows that are asked for.
        let mut expressions: Vec<_> = all
            .iter()
            .flat_map(|row| columns.iter().map(|&j| coefficient(row, j)))
            .collect();
        for row in rows {
            for &j in &columns {
                for &k in &columns {
                    let (a, b) = (coefficient(row, k), coefficient(row, j));
                    let pool = &mut self.system.pool;
                    let (a, b) = (
                        pool.differentiate(a, symbols[j]),
                        pool.differentiate(b, symbols[k]),
                    );
                    expressions.push(pool.sub(a, b));
                }
            }
        }
        let n = columns.len();
        (1..=STATES).all(|state| {
            let Some(values) = self.values(&expressions, state) else {
                return false;
            };
            let (coefficients, curls) = values.split_at(all.len() * n);
            let free = kernel(coefficients.chunks(n.max(1)), n);
            let size = curls.iter().fold(1e-3, |size: f64, c| size.max(c.abs()));
            curls.chunks((n * n).max(1)).all(|curl| {
                free.iter().all(|u| {
                    free.iter().all(|w| {
                        let value: f64 =
                            (0..n * n).map(|jk| curl[jk] * u[jk / n] * w[jk % n]).sum();
                        value.abs() <= 1e-7 * size
                    })
                })
            })
        })
    }
}

/// A basis of what rows leave free: unit vectors of the free columns, continued to the others (Gauss–Jordan).
fn kernel<'a>(rows: impl Iterator<Item = &'a [f64]>, n: usize) -> Vec<Vec<f64>> {
    let mut reduced: Vec<(usize, Vec<f64>)> = Vec::new();
    for row in rows {
        let size = row.iter().fold(0.0, |size: f64, a| size.max(a.abs()));
        let mut left = row.to_vec();
        for (pivot, other) in &reduced {
            let factor = left[*pivot];
            left.iter_mut()
                .zip(other)
                .for_each(|(a, b)| *a -= factor * b);
        }
        let largest = (0..n).max_by(|&i, &j| left[i].abs().total_cmp(&left[j].abs()));
        let Some(pivot) = largest.filter(|&i| left[i].abs() > ZERO * size) else {
            continue;
        };
        let scale = left[pivot];
        left.iter_mut().for_each(|a| *a /= scale);
        for (_, other) in &mut reduced {
            let factor = other[pivot];
            other
                .iter_mut()
                .zip(&left)
                .for_each(|(a, b)| *a -= factor * b);
        }
        reduced.push((pivot, left));
    }
    let bound = |j: &usize| reduced.iter().any(|(pivot, _)| pivot == j);
    (0..n)
        .filter(|j| !bound(j))
        .map(|j| {
            let mut vector = vec![0.0; n];
            vector[j] = 1.0;
            for (pivot, row) in &reduced {
                vector[*pivot] = -row[j];
            }
            vector
        })
        .collect()
}

/// The expression with `der(e)` replaced by e; nothing if a power or function contains one.
fn without_der(expr: &Expr) -> Option<Expr> {
    let with = |kind: ExprKind| {
        Some(Expr {
            kind,
            extent: expr.extent,
        })
    };
    match &expr.kind {
        ExprKind::Call(name, arguments) if name.text == "der" => arguments.first().cloned(),
        ExprKind::Sum(terms) => {
            let terms: Option<Vec<_>> = terms
                .iter()
                .map(|(sign, term)| Some((*sign, without_der(term)?)))
                .collect();
            with(ExprKind::Sum(terms?))
        }
        ExprKind::Product(factors) => {
            let factors: Option<Vec<_>> = factors
                .iter()
                .map(|(side, factor)| Some((*side, without_der(factor)?)))
                .collect();
            with(ExprKind::Product(factors?))
        }
        ExprKind::Negative(inner) => with(ExprKind::Negative(Box::new(without_der(inner)?))),
        ExprKind::SumOver(index, body) => with(ExprKind::SumOver(
            index.clone(),
            Box::new(without_der(body)?),
        )),
        _ => Some(expr.clone()),
    }
}
