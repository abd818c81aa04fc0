//! Forces that are not determined, and cones that bound them: contacts push, sticking frictions stay in their friction cones.
//!
//! With λ₀ of least norm and a basis B of the forces without effect that bounds depend on, all λ₀ + B y have the same effect. The shares of least
//! norm within the bounds are a quadratic programme over cones for y.

mod slopes;

use super::conic::{Cone, ConicPoint, ConicProgram};
use super::least_norm::Freedom;
use crate::arithmetic::Scalar;
use nalgebra::{DMatrix, DVector};

/// A bound depends on forces that are open if one of them changes it by more than this, relative.
const OPEN: f64 = 1e-9;

/// Bounds are compared with this share of the largest at least: the size of one may be that of a coordinate that hardly has any inertia.
const SMALLEST: f64 = 1e-12;

/// What is left of an open part that cancels, relative.
const CANCELLED: f64 = 1e-12;

/// Where bounds allow one share only, they are widened by this, relative: what rounding may have taken.
const BORDER: f64 = 1e-13;

/// A linear function of the forces: (index of a force, factor) of what it is the sum of, and a constant.
pub(crate) type Linear<'a, T> = (&'a [(usize, T)], T);

/// Bounds with a part that is open, each linear in the forces and relative to its size.
#[derive(Clone, Debug, Default)]
pub(crate) struct ForceBounds<T> {
    /// Their rows in the lists of all.
    pub(crate) cones: Vec<Cone>,
    /// Per bound: size of the terms that make it.
    pub(crate) sizes: Vec<f64>,
    /// Per row: at the forces of least norm.
    pub(crate) values: Vec<f64>,
    /// What each row is the sum of: (index of a force, factor).
    pub(crate) terms: Vec<Vec<(usize, f64)>>,
    /// The largest factor of each row.
    factors: Vec<f64>,
    /// How each row depends on the forces, without what has an effect, as parts of its largest factor.
    changes: Vec<DVector<f64>>,
    /// Of numbers with derivatives, per row: the change by the forces and the value, neither relative.
    exact: Vec<(DVector<T>, T)>,
    /// B, an orthogonal basis of the changes, of vectors that are equally long.
    basis: DMatrix<f64>,
    /// How long.
    unit: f64,
    /// How each row depends on the basis.
    open: DMatrix<f64>,
}

impl<T: Scalar> ForceBounds<T> {
    pub(crate) fn clear(&mut self) {
        self.cones.clear();
        self.sizes.clear();
        self.values.clear();
        self.terms.clear();
        self.factors.clear();
        self.changes.clear();
        self.exact.clear();
    }

    /// Adds s ≥ 0, or s₀ ≥ √(s₁² + s₂²), of `forces` of least norm. False, and nothing happens, if no part of it is open, or was before forces were
    /// chosen; its size is that of its terms, and `least_size` at least.
    pub(crate) fn add<const N: usize>(
        &mut self,
        rows: [Linear<'_, T>; N],
        forces: &[T],
        freedom: &Freedom<T>,
        least_size: impl FnOnce() -> f64,
    ) -> bool {
        let changes = rows.map(|(terms, _)| change(terms, |i| freedom.row(i)));
        let is_open = |(change, _): &(DVector<f64>, f64)| change.amax() > OPEN;
        let was_open =
            |(terms, _): &Linear<'_, T>| is_open(&change(terms, |i| freedom.whole_row(i)));
        if !changes.iter().any(is_open) && !rows.iter().any(was_open) {
            return false;
        }
        let made_of = rows.iter().map(|(terms, constant)| {
            let terms = terms.iter();
            let parts = terms.map(|&(i, a)| (a * forces[i]).value().abs());
            parts.sum::<f64>() + constant.value().abs()
        });
        self.sizes.push(made_of.fold(least_size(), f64::max));
        let first = self.values.len();
        self.cones.push(match N {
            1 => Cone::Ray(first),
            _ => Cone::SecondOrder(first),
        });
        for ((terms, constant), (mut change, factor)) in rows.into_iter().zip(changes) {
            let value = (terms.iter()).fold(T::zero(), |sum, &(i, a)| sum + a * forces[i]);
            let value = value + constant;
            self.values.push(value.value());
            let factors = terms.iter().map(|&(i, a)| (i, a.value()));
            self.terms.push(factors.collect());
            if change.amax() <= CANCELLED {
                change.fill(0.0);
            }
            self.factors.push(factor);
            self.changes.push(change);
            if T::DERIVATIVES > 0 {
                self.exact.push((freedom.part(terms), value));
            }
        }
        true
    }

    /// Makes all bounds relative to their sizes, and finds a basis of what they depend on; nothing if there are none.
    pub(crate) fn complete(&mut self) {
        let Some(width) = self.changes.first().map(|change| change.len()) else {
            return;
        };
        let largest = self.sizes.iter().copied().fold(0.0, f64::max);
        // Without any load all are alike, and of no size of their own.
        let least = match largest > 0.0 {
            true => (SMALLEST * largest).max(f64::MIN_POSITIVE),
            false => 1.0,
        };
        let basis = basis(&self.changes, width);
        self.open = DMatrix::from_fn(self.changes.len(), basis.ncols(), |i, j| {
            self.factors[i] * self.changes[i].dot(&basis.column(j))
        });
        for (size, cone) in self.sizes.iter_mut().zip(&self.cones) {
            *size = size.max(least);
            for row in cone.rows() {
                self.values[row] /= *size;
                self.open.row_mut(row).unscale_mut(*size);
            }
        }
        // Numbers about 1.
        let scale = match self.open.is_empty() {
            true => 1.0,
            false => self.open.amax().max(f64::MIN_POSITIVE),
        };
        self.open /= scale;
        self.basis = basis / scale;
        self.unit = scale.recip();
    }

    /// The least of bounds with these `values` as they are.
    pub(crate) fn least(&self, values: &[f64]) -> f64 {
        self.each(values).fold(f64::INFINITY, f64::min)
    }

    /// How far bounds with these `values` are from being broken.
    fn each(&self, values: &[f64]) -> impl Iterator<Item = f64> {
        self.cones.iter().map(|cone| match *cone {
            Cone::Ray(i) => values[i],
            Cone::SecondOrder(i) => values[i] - values[i + 1].hypot(values[i + 2]),
        })
    }

    /// By how much more than the margin the `widest` forces keep each of the bounds with these `values`.
    pub(crate) fn slacks(&self, values: &[f64], widest: &DVector<f64>) -> Vec<f64> {
        let columns = self.open.ncols();
        let kept = DVector::from_column_slice(values) + &self.open * widest.rows(0, columns);
        let slacks = self.each(kept.as_slice());
        slacks.map(|bound| bound - widest[columns]).collect()
    }

    /// The forces (y, margin) that keep bounds with these `values` by the largest margin up to `most`.
    pub(crate) fn widest(&self, values: &[f64], most: f64) -> ConicPoint {
        let (rows, columns) = self.open.shape();
        let mut a = self.open.clone().resize(rows + 1, columns + 1, 0.0);
        let mut cones = self.cones.clone();
        cones.push(Cone::Ray(rows));
        for cone in &cones {
            a[(cone.first(), columns)] = -1.0;
        }
        let mut start = DVector::zeros(columns + 1);
        start[columns] = self.least(values).min(most) - 1.0;
        let mut c = DVector::zeros(columns + 1);
        c[columns] = -1.0;
        let program = ConicProgram {
            squares: DVector::zeros(columns + 1),
            c,
            a,
            b: DVector::from_iterator(rows + 1, values.iter().copied().chain([most])),
            cones,
        };
        program.solve(start)
    }

    /// By how much forces can keep all bounds, at most 1, or must break one.
    pub(crate) fn widest_margin(&self) -> f64 {
        self.widest(&self.values, 1.0).x[self.basis.ncols()]
    }

    /// What takes the forces of least norm to those of least norm that keep all bounds by `margin`, relative, or come as near to that as any
    /// do; `None` if they keep them as they are.
    pub(crate) fn shares(&self, margin: f64) -> Option<DVector<T>> {
        let (program, point) = self.nearest(margin)?;
        let shares = (&self.basis * &point.x).map(T::from_f64);
        Some(match T::DERIVATIVES {
            0 => shares,
            _ => shares + self.slopes(&program, &point),
        })
    }

    /// How long that is.
    pub(crate) fn change(&self, margin: f64) -> f64 {
        let nearest = self.nearest(margin);
        nearest.map_or(0.0, |(_, point)| self.unit * point.x.norm())
    }

    /// The programme of the shares for `margin`, and its solution.
    fn nearest(&self, margin: f64) -> Option<(ConicProgram, ConicPoint)> {
        if self.least(&self.values) >= margin {
            return None;
        }
        let free = self.basis.ncols();
        let widest = self.widest(&self.values, 1.0).x;
        let program = self.program((widest[free] - BORDER).min(margin));
        let point = program.solve(widest.rows(0, free).into_owned());
        Some((program, point))
    }

    /// What is to be solved for the forces of least norm that keep all bounds by `margin`.
    fn program(&self, margin: f64) -> ConicProgram {
        let columns = self.open.ncols();
        let mut b = DVector::from_column_slice(&self.values);
        for cone in &self.cones {
            b[cone.first()] -= margin;
        }
        ConicProgram {
            squares: DVector::repeat(columns, 1.0),
            c: DVector::zeros(columns),
            a: self.open.clone(),
            b,
            cones: self.cones.clone(),
        }
    }
}

/// How a sum of forces, (index, factor), changes with them, as a part of its largest factor; and that factor. Rows of a projector take out what has an effect.
fn change<'a, T: Scalar>(
    terms: &[(usize, T)],
    row: impl Fn(usize) -> &'a [T],
) -> (DVector<f64>, f64) {
    let sizes = terms.iter().map(|(_, a)| a.value().abs());
    let largest = sizes.fold(0.0, f64::max);
    let part = |a: T| match largest > 0.0 {
        true => a.value() / largest,
        false => 0.0,
    };
    let width = row(0).len();
    let change = DVector::from_fn(width, |j, _| {
        let parts = terms.iter().map(|&(i, a)| part(a) * row(i)[j].value());
        parts.sum()
    });
    (change, largest)
}

/// An orthonormal basis of the space that these rows span (Gram & Schmidt, the largest remainder first). Rows that hardly depend on the forces do
/// so with the errors of those that do.
fn basis(rows: &[DVector<f64>], width: usize) -> DMatrix<f64> {
    let mut left = rows.to_vec();
    let mut basis: Vec<DVector<f64>> = Vec::new();
    while let Some(largest) = (left.iter()).max_by(|x, y| x.norm().total_cmp(&y.norm()))
        && largest.norm() > OPEN
        && basis.len() < width
    {
        let mut next = largest.normalize();
        for known in &basis {
            next -= known * known.dot(&next);
        }
        next.normalize_mut();
        for row in &mut left {
            *row -= &next * next.dot(row);
        }
        basis.push(next);
    }
    DMatrix::from_iterator(width, basis.len(), basis.iter().flatten().copied())
}
