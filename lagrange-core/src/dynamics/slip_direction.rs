//! Slips of two components that begin: the direction of the friction, and how it turns.
//!
//! At rest s/|s| is 0/0. The direction u is then an unknown of its own beside the accelerations, and
//!
//! ```text
//! s(τ) × u(τ) = 0,   |u| = 1,   u(0) = u₀ with ṡ(0) ∥ u₀
//! ```
//!
//! determines its coefficients order by order: uₖ = ψₖ u₀⊥ + (what |u| = 1 asks), and coefficient k + 1 of s × u is linear in
//! ψₖ, directly by s₁ = ṡ(0) and, through the friction force, by D/(k + 1), D the response of ṡ × u₀ to a turn. Because of D
//! this also holds where the slip begins as τ², at the limit of equal coefficients of friction; there the series is asymptotic
//! (the equation is of the kind of τ² y′ = τ − y) and good for a first step.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::Scalar;
use crate::mode::{Direction, FrictionMode, Sliding};
use crate::program::{MAX_ORDER, Operation};

/// A slip smaller than this, in units of what it is made of, has no direction.
const VANISHING: f64 = 1e-13;

/// Coefficients of a direction.
type Series<T> = [[T; 2]; MAX_ORDER + 2];

/// The directions of frictions with two components, one for every friction.
#[derive(Clone, Debug)]
pub(super) struct SlipDirections<T> {
    /// Where the slip points, or begins to.
    now: Vec<[T; 2]>,
    /// How it turns, where it begins.
    series: Vec<Series<T>>,
    /// D by rows, and the system of one order.
    response: Vec<T>,
    matrix: Vec<T>,
    right: Vec<T>,
}

impl<T: Scalar> SlipDirections<T> {
    pub(super) fn new(frictions: usize) -> Self {
        let zero = [T::zero(); 2];
        Self {
            now: vec![zero; frictions],
            series: vec![[zero; MAX_ORDER + 2]; frictions],
            response: Vec::with_capacity(frictions * frictions),
            matrix: Vec::with_capacity(frictions * frictions),
            right: Vec::with_capacity(frictions),
        }
    }

    /// Forgets where slips pointed.
    pub(super) fn restart(&mut self) {
        self.now.fill([T::zero(); 2]);
    }

    /// Of friction `f`.
    #[inline]
    pub(super) fn of(&self, f: usize) -> [T; 2] {
        self.now[f]
    }

    /// Coefficient `k` of that of friction `f`.
    #[inline]
    pub(super) fn coefficient(&self, f: usize, k: usize) -> [T; 2] {
        self.series[f][k]
    }

    /// u₀ and its normal u₀⊥, a quarter turn on.
    fn frame(&self, f: usize) -> ([T; 2], [T; 2]) {
        let [x, y] = self.series[f][0];
        ([x, y], [-y, x])
    }

    /// Coefficient `k` ≥ 1 without a turn: what |u| = 1 asks.
    fn keep_length(&mut self, f: usize, k: usize) {
        let u = &mut self.series[f];
        let mut sum = T::zero();
        for j in 1..k {
            sum += dot(u[j], u[k - j]);
        }
        let along = -T::from_f64(0.5) * sum;
        u[k] = u[0].map(|x| along * x);
    }

    fn turn(&mut self, f: usize, k: usize, by: T) {
        let (_, normal) = self.frame(f);
        let u = &mut self.series[f][k];
        *u = [u[0] + by * normal[0], u[1] + by * normal[1]];
    }
}

fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[1] - a[1] * b[0]
}

/// The direction in which a slip goes to zero, from the slip at parts of the way there, 1 its end: chords over ever shorter
/// parts, extrapolated. None if it does not change.
pub(crate) fn approach(mut slip: impl FnMut(f64) -> [f64; 2]) -> Option<[f64; 2]> {
    const PART: f64 = 1e-3;
    let end = slip(1.0);
    let mut along = [0.0; 2];
    for (weight, parts) in [(3.0, 1.0), (-1.5, 2.0), (1.0 / 3.0, 3.0)] {
        let before = slip(1.0 - parts * PART);
        for ((along, before), end) in along.iter_mut().zip(before).zip(end) {
            *along += weight * (before - end);
        }
    }
    let length = along[0].hypot(along[1]);
    (length > 0.0).then(|| along.map(|x| x / length))
}

impl<T: Scalar> Dynamics<T> {
    /// The direction in which friction `f` of two components slips, or begins to: that at the last [`Self::series`],
    /// [`Self::set_slip_direction`] or [`Self::take_slip_directions`].
    pub fn slip_direction(&self, f: usize) -> [T; 2] {
        self.slip_directions.of(f)
    }

    /// The direction, a unit vector, in which friction `f` of two components begins to slip ([`Direction::Incipient`]).
    pub fn set_slip_direction(&mut self, f: usize, along: [T; 2]) {
        self.slip_directions.now[f] = along;
    }

    /// Slip of friction `f` of two components at the last [`Self::tape`] or [`Self::value`]; its need must have been held.
    pub fn slip(&self, f: usize) -> [T; 2] {
        let row = self.description().frictions[f].row;
        [row, row + 1].map(|row| self.motion(self.description().rows[row].velocity))
    }

    /// [`Self::value`] at a state of a step in which slips begin: the directions are those of the slips, where they do not
    /// vanish; afterwards the slip directions are those of the mode again.
    ///
    /// # Errors
    /// Those of [`Self::value`].
    pub fn value_along(&mut self, t: T, q: &[T], v: &[T]) -> Result<(), EvaluationError> {
        let count = self.compiled().pattern.slip_directions.len();
        if count == 0 {
            return self.value(t, q, v);
        }
        self.tape(t, q, v);
        for i in 0..count {
            let f = self.beginning(i);
            let slip = self.slip(f);
            if dot(slip, slip).value().sqrt() > VANISHING * self.slip_size(f, v) {
                self.head_along(f, slip);
            }
        }
        let outcome = self.value(t, q, v);
        for i in 0..count {
            let f = self.beginning(i);
            let sliding = self.mode().frictions[f];
            if let FrictionMode::Slip(Sliding {
                direction: Direction::Incipient(along),
                ..
            }) = sliding
            {
                self.set_slip_direction(f, along.map(T::from_f64));
            }
        }
        outcome
    }

    /// The size of what makes the slip of friction `f`, at least 1, from the numbers of the last [`Self::tape`].
    pub fn slip_size(&self, f: usize, v: &[T]) -> f64 {
        let friction = &self.description().frictions[f];
        let rows = &self.description().rows[friction.row..friction.row + friction.components];
        let terms = rows.iter().flat_map(|row| row.jacobian);
        let sizes = terms.map(|&(j, place)| (self.motion(place) * v[j]).value().abs());
        1.0 + sizes.sum::<f64>()
    }

    /// Takes the slip directions of all sliding frictions of two components from their slips at the last value.
    pub fn take_slip_directions(&mut self) {
        for f in 0..self.description().frictions.len() {
            if self.turns(f) {
                self.head_along(f, self.slip(f));
            }
        }
    }

    /// The same from the series.
    pub(super) fn take_slip_directions_of_series(&mut self) {
        for f in 0..self.description().frictions.len() {
            if self.turns(f) {
                self.head_along(f, self.slip_coefficient(f, 0));
            }
        }
    }

    /// Whether friction `f` slips along itself.
    fn turns(&self, f: usize) -> bool {
        let state = self.mode().frictions[f];
        matches!(
            state,
            FrictionMode::Slip(Sliding {
                direction: Direction::AlongSlip,
                ..
            })
        )
    }

    fn head_along(&mut self, f: usize, slip: [T; 2]) {
        let speed = dot(slip, slip).sqrt();
        if speed.value() > 0.0 {
            self.slip_directions.now[f] = slip.map(|s| s / speed);
        }
    }

    /// Coefficient `k` of the slip.
    fn slip_coefficient(&self, f: usize, k: usize) -> [T; 2] {
        let row = self.description().frictions[f].row;
        [row, row + 1].map(|row| {
            let series = self.motion_series(self.description().rows[row].velocity);
            series.get(k).copied().unwrap_or_default()
        })
    }

    /// Coefficients up to `order` in a mode where slips begin, from values in the registers.
    pub(super) fn expand_from_rest(&mut self, order: usize) -> Result<(), EvaluationError> {
        let count = self.compiled().pattern.slip_directions.len();
        for i in 0..count {
            let f = self.beginning(i);
            self.slip_directions.series[f] = [[T::zero(); 2]; MAX_ORDER + 2];
            self.slip_directions.series[f][0] = self.slip_directions.now[f];
        }
        for k in 1..(order + 1).min(MAX_ORDER) {
            for i in 0..count {
                let f = self.beginning(i);
                self.slip_directions.keep_length(f, k);
            }
            self.start_series(k + 1)?;
            self.expand(k + 1);
            self.ask(k);
            if k == 1 {
                self.respond()?;
            }
            self.turn_all(k)?;
        }
        self.start_series(order)?;
        self.expand(order);
        Ok(())
    }

    /// The friction of slip direction `i` of the plan.
    fn beginning(&self, i: usize) -> usize {
        self.compiled().pattern.slip_directions[i].friction
    }

    /// Coefficient k + 1 of s × u without a turn of order k, into the right-hand side.
    fn ask(&mut self, k: usize) {
        self.slip_directions.right.clear();
        for i in 0..self.compiled().pattern.slip_directions.len() {
            let f = self.beginning(i);
            let mut sum = T::zero();
            for j in 1..=k + 1 {
                let u = self.slip_directions.coefficient(f, k + 1 - j);
                sum += cross(self.slip_coefficient(f, j), u);
            }
            self.slip_directions.right.push(-sum);
        }
    }

    /// D, from what a turn of order 1 does to the slip of order 2.
    fn respond(&mut self) -> Result<(), EvaluationError> {
        let count = self.compiled().pattern.slip_directions.len();
        self.slip_directions.response.clear();
        self.slip_directions
            .response
            .resize(count * count, T::zero());
        let across = |dynamics: &Self, i: usize| {
            let f = dynamics.beginning(i);
            let (along, _) = dynamics.slip_directions.frame(f);
            let twice = cross(dynamics.slip_coefficient(f, 2), along);
            twice + twice
        };
        for i in 0..count {
            for j in 0..count {
                self.slip_directions.response[i * count + j] = -across(self, i);
            }
        }
        for j in 0..count {
            let f = self.beginning(j);
            self.slip_directions.turn(f, 1, num_traits::one());
            self.start_series(2)?;
            self.expand(2);
            for i in 0..count {
                let after = across(self, i);
                self.slip_directions.response[i * count + j] += after;
            }
            self.slip_directions.keep_length(f, 1);
        }
        Ok(())
    }

    /// Solves for the turns of order `k`.
    fn turn_all(&mut self, k: usize) -> Result<(), EvaluationError> {
        let count = self.compiled().pattern.slip_directions.len();
        let share = T::from_f64(1.0 / (k + 1) as f64);
        for i in 0..count {
            let f = self.beginning(i);
            let (along, _) = self.slip_directions.frame(f);
            let growth = dot(self.slip_coefficient(f, 1), along);
            let SlipDirections {
                response, matrix, ..
            } = &mut self.slip_directions;
            if i == 0 {
                matrix.clear();
                matrix.extend(response.iter().map(|&x| share * x));
            }
            matrix[i * count + i] += growth;
        }
        let SlipDirections { matrix, right, .. } = &mut self.slip_directions;
        if !solve_small(matrix, right) {
            let operation = Operation::SquareRoot;
            let f = self.beginning(0);
            let item = Some(self.description().frictions[f].name);
            return Err(EvaluationError::NoSeries { operation, item });
        }
        for i in 0..count {
            let f = self.beginning(i);
            let by = self.slip_directions.right[i];
            self.slip_directions.turn(f, k, by);
        }
        Ok(())
    }
}

/// Solves a small system in place, by Gauss elimination with row exchanges. False if it is singular.
pub(crate) fn solve_small<T: Scalar>(matrix: &mut [T], right: &mut [T]) -> bool {
    let n = right.len();
    for step in 0..n {
        let size = |i: &usize| matrix[i * n + step].value().abs();
        let Some(best) = (step..n).max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return false;
        };
        for j in 0..n {
            matrix.swap(step * n + j, best * n + j);
        }
        right.swap(step, best);
        let pivot = matrix[step * n + step];
        for i in (0..n).filter(|i| *i != step) {
            let factor = matrix[i * n + step] / pivot;
            for j in step..n {
                let x = matrix[step * n + j];
                matrix[i * n + j] -= factor * x;
            }
            let x = right[step];
            right[i] -= factor * x;
        }
    }
    for (i, x) in right.iter_mut().enumerate() {
        *x /= matrix[i * n + i];
    }
    right.iter().all(|x| x.value().is_finite())
}
