//! Quadratic programmes over second-order cones, by a primal-dual method of interior points.
//!
//! ```text
//! minimize ½ xᵀ P x + cᵀ x    where A x + b ∈ K
//! ```
//!
//! K is a product of rays s ≥ 0 and of cones s₀ ≥ √(s₁² + s₂²), P is diagonal. Beside x each step makes multipliers z ∈ K better; for them
//! Aᵀ z = c + P x. Where P = 0 every such z bounds what can be reached, −bᵀ z ≤ cᵀ x, however far the steps have come.
//!
//! Steps are those of Mehrotra with the scaling of Nesterov & Todd, W z = W⁻ᵀ s = λ, and are solved by orthogonal factors, which do not
//! square the condition. Near the end s and z lie so close to the border of K that differences of their elements are rounding: s is not
//! carried on at all, and W and λ are, so that fourteen digits are right. References: Andersen, Roos & Terlaky 2003, Mathematical
//! Programming 95, 249; Vandenberghe 2010, The CVXOPT linear and quadratic cone program solvers, sections 4 to 6.

use crate::arithmetic::Scalar;
use core::ops::Range;
use nalgebra::{DMatrix, DVector};

/// So many steps; a problem takes 8 to 20.
const MOST_STEPS: usize = 60;

/// Share of the way to the border of K that a step takes.
const WAY: f64 = 0.99;

/// What is left is rounding, relative to the numbers of the problem.
const SETTLED: f64 = 1e-15;

/// So near to the end a step that leaves so many times more shows that rounding is all that is left.
const NEARLY: f64 = 1e-9;
const WORSE: f64 = 4.0;

/// A factor of the product K: its first row, and how many there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cone {
    /// s ≥ 0
    Ray(usize),
    /// s₀ ≥ √(s₁² + s₂²)
    SecondOrder(usize),
}

impl Cone {
    /// Its first row.
    pub(crate) fn first(self) -> usize {
        self.rows().start
    }

    /// All its rows.
    pub(crate) fn rows(self) -> Range<usize> {
        match self {
            Cone::Ray(i) => i..i + 1,
            Cone::SecondOrder(i) => i..i + 3,
        }
    }

    /// Multiplies what belongs to it.
    fn multiply(self, by: &Matrix, y: &mut [f64]) {
        match self {
            Cone::Ray(i) => y[i] *= by[0][0],
            Cone::SecondOrder(i) => {
                let old = [y[i], y[i + 1], y[i + 2]];
                for (k, row) in by.iter().enumerate() {
                    y[i + k] = row[0] * old[0] + row[1] * old[1] + row[2] * old[2];
                }
            }
        }
    }
}

/// x ∘ y in the product K of these cones.
pub(super) fn product<T: Scalar>(cones: &[Cone], x: &DVector<T>, y: &DVector<T>) -> DVector<T> {
    let mut out = x.component_mul(y);
    for &cone in cones {
        if let Cone::SecondOrder(i) = cone {
            out[i] = x[i] * y[i] + x[i + 1] * y[i + 1] + x[i + 2] * y[i + 2];
            for k in i + 1..i + 3 {
                out[k] = x[i] * y[k] + y[i] * x[k];
            }
        }
    }
    out
}

/// A problem.
#[derive(Clone, Debug)]
pub(crate) struct ConicProgram {
    /// Diagonal of P.
    pub(crate) squares: DVector<f64>,
    pub(crate) c: DVector<f64>,
    pub(crate) a: DMatrix<f64>,
    pub(crate) b: DVector<f64>,
    pub(crate) cones: Vec<Cone>,
}

/// What a search has come to.
#[derive(Clone, Debug)]
pub(crate) struct ConicPoint {
    pub(crate) x: DVector<f64>,
    /// The multipliers.
    pub(crate) z: DVector<f64>,
}

impl ConicProgram {
    /// Searches from `x`, at which A x + b is inside K.
    pub(crate) fn solve(&self, x: DVector<f64>) -> ConicPoint {
        let mut scaled = (&self.a * &x + &self.b, self.unit());
        let mut at = ConicPoint { x, z: self.unit() };
        let degree = self.cones.len() as f64;
        let size = 1.0 + self.b.amax().max(self.c.amax());
        let mut best = (f64::INFINITY, at.clone());
        let mut scaling = vec![ONE; self.cones.len()];
        for _ in 0..MOST_STEPS {
            let Some(lambda) = self.rescale(&mut scaling, &scaled) else {
                break;
            };
            let gap = lambda.dot(&lambda) / degree;
            let slope = self.squares.component_mul(&at.x) + &self.c - self.a.tr_mul(&at.z);
            let left = gap.max(slope.amax());
            if !left.is_finite() {
                break;
            }
            if left < best.0 {
                best = (left, at.clone());
            }
            // From some step on rounding takes over.
            if left <= SETTLED * size || left > WORSE * best.0 && best.0 <= NEARLY * size {
                break;
            }
            let equations = Equations {
                lambda: &lambda,
                slope: &slope,
                factors: self.factors(&scaling),
            };
            // Straight to the end, to see how far that goes.
            let toward = -product(&self.cones, &lambda, &lambda);
            let Some(affine) = self.step(&scaling, &equations, &toward) else {
                break;
            };
            let part = self.longest(&lambda, &affine).min(1.0);
            let centre = (1.0 - part).powi(3) * gap;
            let bend = product(&self.cones, &affine.s, &affine.z);
            let Some(step) = self.step(
                &scaling,
                &equations,
                &(toward - bend + centre * self.unit()),
            ) else {
                break;
            };
            let part = (WAY * self.longest(&lambda, &step)).min(1.0);
            scaled = (&lambda + part * &step.s, &lambda + part * &step.z);
            at.x += part * step.x;
            at.z += part * self.apply_inverse(&scaling, step.z);
        }
        best.1
    }

    /// The unit e of K.
    fn unit(&self) -> DVector<f64> {
        let mut e = DVector::zeros(self.b.len());
        for cone in &self.cones {
            e[cone.first()] = 1.0;
        }
        e
    }

    /// u of λ ∘ u = y.
    fn quotient(&self, lambda: &DVector<f64>, y: &DVector<f64>) -> DVector<f64> {
        let mut out = y.component_div(lambda);
        for &cone in &self.cones {
            if let Cone::SecondOrder(i) = cone {
                let across = lambda[i + 1] * y[i + 1] + lambda[i + 2] * y[i + 2];
                out[i] = (lambda[i] * y[i] - across) / inside(lambda, i);
                for k in i + 1..i + 3 {
                    out[k] = (y[k] - out[i] * lambda[k]) / lambda[i];
                }
            }
        }
        out
    }

    /// Takes up in the scaling what it has made of s and z, so that both become the same λ; `None` where one is no longer inside K.
    ///
    /// What is left to be scaled is near the middle of K: it has no differences of large numbers, as s and z have near the end.
    fn rescale(
        &self,
        scaling: &mut [Matrix],
        (s, z): &(DVector<f64>, DVector<f64>),
    ) -> Option<DVector<f64>> {
        let mut lambda = z.clone();
        for (cone, scale) in self.cones.iter().zip(scaling) {
            match *cone {
                Cone::Ray(i) => {
                    if !(s[i] > 0.0 && z[i] > 0.0) {
                        return None;
                    }
                    let by = (s[i] / z[i]).sqrt();
                    lambda[i] = by * z[i];
                    scale[0][0] /= by;
                }
                Cone::SecondOrder(i) => {
                    let (ds, dz) = (inside(s, i), inside(z, i));
                    if !(ds > 0.0 && dz > 0.0 && s[i] > 0.0 && z[i] > 0.0) {
                        return None;
                    }
                    let unit = |x: &DVector<f64>, square: f64| -> [f64; 3] {
                        core::array::from_fn(|k| x[i + k] / square.sqrt())
                    };
                    let (s, z) = (unit(s, ds), unit(z, dz));
                    let cosine = s[0] * z[0] + s[1] * z[1] + s[2] * z[2];
                    let root = 0.5 / (0.5 * (1.0 + cosine)).sqrt();
                    let turn = [s[0] + z[0], s[1] - z[1], s[2] - z[2]].map(|x| root * x);
                    let size = (ds / dz).powf(0.25);
                    for (k, row) in hyperbolic(turn, size).iter().enumerate() {
                        let sum: f64 = row.iter().zip(z).map(|(x, z)| x * z).sum();
                        lambda[i + k] = dz.sqrt() * sum;
                    }
                    let back = hyperbolic([turn[0], -turn[1], -turn[2]], size.recip());
                    *scale = times(&back, scale);
                }
            }
        }
        Some(lambda)
    }

    /// W⁻¹ y
    fn apply_inverse(&self, scaling: &[Matrix], mut y: DVector<f64>) -> DVector<f64> {
        for (cone, scale) in self.cones.iter().zip(scaling) {
            let transposed = core::array::from_fn(|i| scale.map(|row| row[i]));
            cone.multiply(&transposed, y.as_mut_slice());
        }
        y
    }

    /// Orthogonal factors of [W⁻ᵀ A; √P].
    fn factors(&self, scaling: &[Matrix]) -> Factors {
        let (rows, columns) = self.a.shape();
        let mut scaled = self.a.clone();
        for mut column in scaled.column_iter_mut() {
            for (cone, scale) in self.cones.iter().zip(scaling) {
                cone.multiply(scale, column.as_mut_slice());
            }
        }
        let mut stacked = scaled.clone().resize_vertically(rows + columns, 0.0);
        for j in 0..columns {
            stacked[(rows + j, j)] = self.squares[j].sqrt();
        }
        let qr = stacked.qr();
        Factors {
            scaled,
            q: qr.q(),
            r: qr.r(),
        }
    }

    /// A step, s and z of it scaled, that takes away what is left of all equations, where λ ∘ (Δs + Δz) = `toward`.
    fn step(
        &self,
        scaling: &[Matrix],
        equations: &Equations<'_>,
        toward: &DVector<f64>,
    ) -> Option<Step> {
        let (rows, columns) = self.a.shape();
        let Equations {
            lambda,
            slope,
            factors,
        } = equations;
        // A Δx = Δs, and Δs = sum − Δz in scaled numbers.
        let sum = self.quotient(lambda, toward);
        let right = sum.clone().resize_vertically(rows + columns, 0.0);
        let first = factors.r.tr_solve_upper_triangular(slope)?;
        let x = (factors.r).solve_upper_triangular(&(factors.q.tr_mul(&right) - first))?;
        let s = &factors.scaled * &x;
        let mut z = sum - &s;
        // Along the border x may move far, and what that leaves of Δz is mostly rounding.
        let change = self.apply_inverse(scaling, z.clone());
        let left = *slope + self.squares.component_mul(&x) - self.a.tr_mul(&change);
        let share = factors.r.tr_solve_upper_triangular(&left)?;
        z += factors.q.rows(0, rows) * share;
        Some(Step { x, s, z })
    }

    /// How far λ may go along both parts of a scaled step.
    fn longest(&self, lambda: &DVector<f64>, step: &Step) -> f64 {
        let way = |direction: &DVector<f64>| {
            let of = |&cone: &Cone| match cone {
                Cone::Ray(i) => positive_part(lambda[i], direction[i]),
                Cone::SecondOrder(i) => {
                    let root = inside(lambda, i).sqrt();
                    let l: [f64; 3] = core::array::from_fn(|k| lambda[i + k] / root);
                    let d: [f64; 3] = core::array::from_fn(|k| direction[i + k] / root);
                    let first = l[0] * d[0] - l[1] * d[1] - l[2] * d[2];
                    let along = (first + d[0]) / (l[0] + 1.0);
                    let across = (d[1] - along * l[1]).hypot(d[2] - along * l[2]);
                    positive_part(1.0, first - across)
                }
            };
            self.cones.iter().map(of).fold(f64::INFINITY, f64::min)
        };
        way(&step.s).min(way(&step.z))
    }
}

/// Where x + α d vanishes.
fn positive_part(x: f64, d: f64) -> f64 {
    if d < 0.0 { -x / d } else { f64::INFINITY }
}

/// s₀² − s₁² − s₂² of the cone that begins at `i`.
fn inside(s: &DVector<f64>, i: usize) -> f64 {
    let across = s[i + 1].hypot(s[i + 2]);
    (s[i] - across) * (s[i] + across)
}

/// A step, s and z scaled.
struct Step {
    x: DVector<f64>,
    s: DVector<f64>,
    z: DVector<f64>,
}

/// W⁻ᵀ of one cone; of a ray the first element.
type Matrix = [[f64; 3]; 3];

const ONE: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// `size` times the symmetric map of the cone onto itself that takes e to `turn`.
fn hyperbolic(turn: [f64; 3], size: f64) -> Matrix {
    let [w, u, v] = turn;
    let across = |x: f64, y: f64| x * y / (1.0 + w);
    [
        [w, u, v],
        [u, 1.0 + across(u, u), across(u, v)],
        [v, across(u, v), 1.0 + across(v, v)],
    ]
    .map(|row| row.map(|x| size * x))
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    a.map(|row| core::array::from_fn(|j| (0..3).map(|k| row[k] * b[k][j]).sum()))
}

/// What a step starts from.
struct Equations<'a> {
    lambda: &'a DVector<f64>,
    slope: &'a DVector<f64>,
    factors: Factors,
}

struct Factors {
    /// W⁻ᵀ A
    scaled: DMatrix<f64>,
    q: DMatrix<f64>,
    r: DMatrix<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a cheap sequence in (−1, 1).
    fn numbers() -> impl FnMut() -> f64 {
        let mut k = 0.0;
        move || {
            k += 1.0;
            2.0 * (k * 0.618_033_988_749_895_f64).fract() - 1.0
        }
    }

    #[test]
    fn the_nearest_point_of_a_cone_is_that_of_its_closed_form() {
        let mut next = numbers();
        for _ in 0..100 {
            let from: [f64; 3] = core::array::from_fn(|_| 3.0 * next());
            // x + from is to be in the cone, and x as short as possible.
            let program = ConicProgram {
                squares: DVector::repeat(3, 1.0),
                c: DVector::zeros(3),
                a: DMatrix::identity(3, 3),
                b: DVector::from_row_slice(&from),
                cones: vec![Cone::SecondOrder(0)],
            };
            let found = program.solve(DVector::from_row_slice(&[10.0, 0.0, 0.0])).x;
            let across = from[1].hypot(from[2]);
            let share = 0.5 * (1.0 + from[0] / across);
            let nearest = if across <= from[0] {
                from
            } else if across <= -from[0] {
                [0.0; 3]
            } else {
                [share * across, share * from[1], share * from[2]]
            };
            for k in 0..3 {
                let off = from[k] + found[k] - nearest[k];
                assert!(off.abs() < 1e-7, "{from:?}: {found} for {nearest:?}");
                // Where the border of the cone is not left in its tip, rounding is all that is off.
                let tip = (across - from[0].abs()).abs() < 1e-2;
                assert!(tip || off.abs() < 1e-12, "{from:?}: {off:e}");
            }
        }
    }

    #[test]
    fn multipliers_prove_how_far_one_can_go() {
        let mut next = numbers();
        for _ in 0..50 {
            // The largest margin x₂ to the borders of three discs, and of a line, in the plane.
            let mut a = DMatrix::zeros(10, 3);
            let mut b = DVector::zeros(10);
            for disc in 0..3 {
                let i = 3 * disc;
                (a[(i, 2)], a[(i + 1, 0)], a[(i + 2, 1)]) = (-1.0, 1.0, 1.0);
                (b[i], b[i + 1], b[i + 2]) = (1.0 + 0.5 * next(), next(), next());
            }
            let angle = 3.0 * next();
            (a[(9, 0)], a[(9, 1)], a[(9, 2)]) = (angle.cos(), angle.sin(), -1.0);
            b[9] = 0.3 * next();
            let mut cones: Vec<Cone> = (0..3).map(|k| Cone::SecondOrder(3 * k)).collect();
            cones.push(Cone::Ray(9));
            let program = ConicProgram {
                squares: DVector::zeros(3),
                c: DVector::from_row_slice(&[0.0, 0.0, -1.0]),
                a,
                b,
                cones,
            };
            let margin = |x: f64, y: f64| {
                let discs = [0, 3, 6]
                    .map(|i| program.b[i] - (program.b[i + 1] + x).hypot(program.b[i + 2] + y));
                let line = program.b[9] + angle.cos() * x + angle.sin() * y;
                discs.into_iter().fold(line, f64::min)
            };
            let found = program.solve(DVector::from_row_slice(&[0.0, 0.0, -9.0]));
            let (x, y, most) = (found.x[0], found.x[1], found.x[2]);
            // The optimum is reached.
            assert!((margin(x, y) - most).abs() < 1e-13);
            // The dual solution bounds it by the same number.
            let left = program.a.tr_mul(&found.z) - &program.c;
            assert!(left.amax() < 1e-13, "{left}");
            assert!((program.b.dot(&found.z) - most).abs() < 1e-13);
            for k in 0..3 {
                let z = &found.z.as_slice()[3 * k..];
                assert!(z[0] >= z[1].hypot(z[2]) - 1e-12);
            }
        }
    }
}
