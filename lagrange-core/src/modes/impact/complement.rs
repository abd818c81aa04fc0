//! An impact as a linear complementarity problem, in the form of Stewart & Trinkle (1996).
//!
//! ```text
//! 0 ≤ Λₙ − least ⟂ rate⁺ − aim ≥ 0        0 ≤ β ⟂ d·s⁺ + σ ≥ 0        0 ≤ σ ⟂ μ N − Σ β ≥ 0
//! ```
//!
//! with friction impulses Σ β d along a few directions d and a bound σ of the slip. The bearing impulse of a friction on a
//! constraint is taken as known.
//!
//! Rates and impulses are measured by the rates that impulses have to change. A slip that is fast beside them has a unit of its own, and its σ with it: a weak
//! impact of bodies that slide fast would be lost in the rounding of their slips.

use super::collision::{Collision, NormalSource};
use super::pattern::Phase;
use crate::arithmetic::Scalar;
use crate::linear::Equilibrated;
use core::f64::consts::TAU;

/// Sides of the cone of a friction with two components.
const SIDES: usize = 8;
/// Friction that only has to keep a `while` row: a limit for the complementarity problem alone.
const UNLIMITED: f64 = 1e6;

/// A linear complementarity problem whose unknowns are impulses along directions, and bounds on slip.
#[derive(Clone, Debug, Default)]
pub(super) struct Linear {
    /// G without the constraints, row-major; and rates before.
    response: Vec<f64>,
    pub rates: Vec<f64>,
    column: Vec<f64>,
    pub rays: Vec<Ray>,
    pub matrix: Vec<f64>,
    pub q: Vec<f64>,
    /// Of rates and impulses, a power of two.
    unit: f64,
    /// Per friction: its unit over that of its slip.
    shares: Vec<f64>,
    /// Per friction: coefficient in force.
    pub coefficients: Vec<f64>,
}

/// An unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ray {
    /// Normal impulse of touch k beyond the least.
    Press(usize),
    /// Impulse of a friction along this direction.
    FrictionRow(usize, [f64; 2]),
    /// Slip speed of a friction.
    Slip(usize),
    /// Impulse of `while` row k, forward or backward.
    Hold(usize, f64),
    /// Speed that is left of `while` row k.
    Held(usize),
}

impl Linear {
    /// Takes the constraints into G and the rates.
    pub fn reduce<T: Scalar>(
        &mut self,
        c: &Collision<T>,
        phase: &Phase<T>,
        factors: &mut Equilibrated<f64>,
    ) {
        let (n, links) = (c.size, c.links);
        self.response.clear();
        self.response.extend(c.response.iter().map(|x| x.value()));
        self.rates.clear();
        self.rates.extend(phase.rates.iter().map(|x| x.value()));
        if links == 0 {
            return;
        }
        self.matrix.clear();
        for i in 0..links {
            self.matrix.extend((0..links).map(|j| c.g(i, j).value()));
        }
        factors.factor(&mut self.matrix, links);
        // One column after the other, the rates last.
        for j in 0..=n {
            self.column.clear();
            let column = (0..links).map(|i| match j {
                j if j < n => c.g(i, j).value(),
                _ => phase.rates[i].value(),
            });
            self.column.extend(column);
            factors.solve(&mut self.column);
            for i in 0..n {
                let part: f64 = (0..links).map(|k| c.g(i, k).value() * self.column[k]).sum();
                if j < n {
                    self.response[i * n + j] -= part;
                } else {
                    self.rates[i] -= part;
                }
            }
        }
    }

    /// Writes matrix and right-hand side; `before` are impulses that bound frictions on constraints.
    pub fn write<T: Scalar>(&mut self, c: &Collision<T>, phase: &Phase<T>, before: &[T]) {
        self.rays.clear();
        let taking = |k: &usize| phase.within[*k];
        for k in (0..c.touches.len()).filter(taking) {
            self.rays.push(Ray::Press(k));
        }
        for (r, rub) in c.rubs.iter().enumerate() {
            if !phase.includes(rub) {
                continue;
            }
            let sides = if rub.components == 1 { 2 } else { SIDES };
            for side in 0..sides {
                let angle = TAU * side as f64 / sides as f64;
                let direction = if rub.components == 1 {
                    [1.0 - 2.0 * side as f64, 0.0]
                } else {
                    [angle.cos(), angle.sin()]
                };
                self.rays.push(Ray::FrictionRow(r, direction));
            }
            self.rays.push(Ray::Slip(r));
        }
        for (i, &(_, k)) in c.conditional.iter().enumerate() {
            if phase.within[k] {
                self.rays
                    .extend([Ray::Hold(i, 1.0), Ray::Hold(i, -1.0), Ray::Held(i)]);
            }
        }
        self.measure(c, phase, before);
        self.matrix.clear();
        self.q.clear();
        for &row in &self.rays {
            let share = self.share(row);
            for &column in &self.rays {
                let entry = self.entry(row, column, c);
                self.matrix.push(match column {
                    Ray::Slip(_) | Ray::Held(_) => entry,
                    _ => share * entry,
                });
            }
            let constant = self.constant(row, c, phase, before);
            self.q.push(share * constant / self.unit);
        }
    }

    /// Finds the units, as powers of two, by which nothing is rounded.
    fn measure<T: Scalar>(&mut self, c: &Collision<T>, phase: &Phase<T>, before: &[T]) {
        let change = |&ray: &Ray| {
            let constant = self.constant(ray, c, phase, before);
            match ray {
                Ray::Press(_) => -constant,
                Ray::Hold(..) => constant.abs(),
                // What friction can do to its own slip.
                Ray::Slip(r) => {
                    let row = c.rubs[r].row;
                    constant * self.response[row * c.size + row]
                }
                Ray::FrictionRow(..) | Ray::Held(_) => 0.0,
            }
        };
        let unit = self.rays.iter().map(change).fold(0.0, f64::max);
        let mut shares = core::mem::take(&mut self.shares);
        shares.clear();
        shares.extend(c.rubs.iter().map(|rub| {
            let rates = rub.rows().map(|row| self.start(row, c, phase).abs());
            let slip = rates.fold(0.0, f64::max);
            match unit > 0.0 && slip > unit {
                true => (unit / slip).log2().round().exp2(),
                false => 1.0,
            }
        }));
        self.shares = shares;
        self.unit = match unit > 0.0 {
            true => unit.log2().round().exp2(),
            false => 1.0,
        };
    }

    /// The unit over that of the rate of a ray.
    fn share(&self, ray: Ray) -> f64 {
        match ray {
            Ray::FrictionRow(r, _) => self.shares[r],
            _ => 1.0,
        }
    }

    /// Rows of a ray and its direction in them.
    fn rows<T: Scalar>(ray: Ray, c: &Collision<T>) -> [(usize, f64); 2] {
        match ray {
            Ray::Press(k) => [(c.touches[k].row, 1.0), (0, 0.0)],
            Ray::FrictionRow(r, [x, y]) => {
                let row = c.rubs[r].row;
                [
                    (row, x),
                    (row + 1, if c.rubs[r].components == 1 { 0.0 } else { y }),
                ]
            }
            Ray::Hold(i, sign) => [(c.conditional[i].0, sign), (0, 0.0)],
            Ray::Slip(_) | Ray::Held(_) => [(0, 0.0); 2],
        }
    }

    fn entry<T: Scalar>(&self, row: Ray, column: Ray, c: &Collision<T>) -> f64 {
        match (row, column) {
            (Ray::Slip(r), Ray::Press(k)) => match c.rubs[r].bearer {
                NormalSource::ContactRow(on) if on == k => {
                    self.coefficients[r] * c.rubs[r].factor.value()
                }
                _ => 0.0,
            },
            (Ray::Slip(r), Ray::FrictionRow(f, _)) => -f64::from(u8::from(r == f)),
            (Ray::FrictionRow(f, _), Ray::Slip(r)) => f64::from(u8::from(r == f)),
            (Ray::Held(i), Ray::Press(k)) => {
                UNLIMITED * f64::from(u8::from(c.conditional[i].1 == k))
            }
            (Ray::Held(i), Ray::Hold(j, _)) => -f64::from(u8::from(i == j)),
            (Ray::Hold(j, _), Ray::Held(i)) => f64::from(u8::from(i == j)),
            (Ray::Slip(_) | Ray::Held(_), _) | (_, Ray::Slip(_) | Ray::Held(_)) => 0.0,
            _ => {
                let mut sum = 0.0;
                for (i, x) in Self::rows(row, c) {
                    for (j, y) in Self::rows(column, c) {
                        if x != 0.0 && y != 0.0 {
                            sum += x * y * self.response[i * c.size + j];
                        }
                    }
                }
                sum
            }
        }
    }

    fn constant<T: Scalar>(
        &self,
        ray: Ray,
        c: &Collision<T>,
        phase: &Phase<T>,
        before: &[T],
    ) -> f64 {
        match ray {
            Ray::Slip(r) => {
                let rub = &c.rubs[r];
                let normal = match rub.bearer {
                    NormalSource::ContactRow(k) => phase.least[k].value(),
                    NormalSource::ConstraintRow(row) => before[row].value().abs(),
                };
                self.coefficients[r] * rub.factor.value() * normal
            }
            Ray::Held(i) => {
                let touch = c.conditional[i].1;
                let before = if phase.struck[touch] {
                    phase.rates[c.touches[touch].row].value().abs().max(1.0)
                } else {
                    0.0
                };
                UNLIMITED * before
            }
            _ => {
                let aim = match ray {
                    Ray::Press(k) => phase.aims[k].value(),
                    _ => 0.0,
                };
                let along = Self::rows(ray, c).into_iter().filter(|(_, x)| *x != 0.0);
                let rate: f64 = along.map(|(i, x)| x * self.start(i, c, phase)).sum();
                rate - aim
            }
        }
    }

    /// Rate of row `i` after the least impulses alone.
    fn start<T: Scalar>(&self, i: usize, c: &Collision<T>, phase: &Phase<T>) -> f64 {
        let least = c.touches.iter().zip(&phase.least).zip(&phase.within);
        let parts = least
            .filter(|(_, within)| **within)
            .map(|((touch, least), _)| self.response[i * c.size + touch.row] * least.value());
        self.rates[i] + parts.sum::<f64>()
    }

    /// Rate of row `i` after the impulses `z`, which are measured in the unit.
    pub fn rate<T: Scalar>(&self, i: usize, c: &Collision<T>, phase: &Phase<T>, z: &[f64]) -> f64 {
        let mut rate = self.start(i, c, phase);
        for (&ray, &z) in self.rays.iter().zip(z) {
            for (j, x) in Self::rows(ray, c) {
                if x != 0.0 {
                    rate += x * z * self.unit * self.response[i * c.size + j];
                }
            }
        }
        rate
    }
}
