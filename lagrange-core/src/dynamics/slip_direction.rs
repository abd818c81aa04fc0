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
//!
//! A slip may have one direction only, that of a foot about another one that sticks. A turn then does nothing to ṡ × u₀, and where the slip
//! begins as τ² as well coefficient k + 1 says nothing of ψₖ: coefficient k + 2 does. Of several slips this may be so of combinations. Where loads grow
//! from zero as τᵖ the slip begins as τᵖ⁺¹, and it is coefficient k + 1 + p that does.

use super::shape::Extent;
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Scalar, derivatives};
use crate::linear::{VanishingCombinations, solve_small};
use crate::mode::{Direction, FrictionMode, Sliding};
use crate::program::{MAX_ORDER, Operation};

/// A slip smaller than this, in units of what it is made of, has no direction.
const VANISHING: f64 = 1e-13;

/// So often is a turn of order 1 corrected: it squares itself in the coefficient that decides it.
const MOST_CORRECTIONS: usize = 6;

/// Part of its size by which it is changed to see what that does.
const SMALL: f64 = 1e-5;

/// A correction this small, relative, is the last one.
const SETTLED: f64 = 1e-14;

/// ṡ above this share of what friction does to it is no error.
const CLEARLY: f64 = 1e-3;

/// An equation for turns says nothing by less than this share of what frictions do: a force that was located at its limit is off by as much, and
/// with it ṡ.
const NO_ANSWER: f64 = 1e-8;

/// Of what cancels in s × u rounding leaves this share.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Coefficients of a direction.
type Series<T> = [[T; 2]; MAX_ORDER + 2];

/// The directions of frictions with two components, one for every friction.
#[derive(Clone, Debug)]
pub(super) struct SlipDirections<T> {
    /// Where the slip points, or begins to.
    now: Vec<[T; 2]>,
    /// The same at the last value.
    held: Vec<[T; 2]>,
    /// How it turns, where it begins.
    series: Vec<Series<T>>,
    /// D by rows.
    response: Vec<T>,
    /// What frictions of full size do to each ṡ.
    strength: Vec<f64>,
    /// Slips of order 2 without a turn.
    straight: Vec<[T; 2]>,
    /// The system of one order, and what it leaves to the next.
    matrix: Vec<T>,
    right: Vec<T>,
    open: VanishingCombinations<T>,
}

impl<T: Scalar> SlipDirections<T> {
    pub(super) fn new(frictions: usize) -> Self {
        let zero = [T::zero(); 2];
        Self {
            now: vec![zero; frictions],
            held: vec![zero; frictions],
            series: vec![[zero; MAX_ORDER + 2]; frictions],
            response: Vec::with_capacity(frictions * frictions),
            strength: Vec::with_capacity(frictions),
            straight: Vec::with_capacity(frictions),
            matrix: Vec::with_capacity(frictions * frictions),
            right: Vec::with_capacity(frictions),
            open: VanishingCombinations::default(),
        }
    }

    /// Forgets where slips pointed.
    pub(super) fn restart(&mut self) {
        self.now.fill([T::zero(); 2]);
    }

    /// Direction of the slip of friction `f`.
    #[inline]
    pub(super) fn of(&self, f: usize) -> [T; 2] {
        self.now[f]
    }

    /// The same, for a value.
    #[inline]
    pub(super) fn hold(&mut self, f: usize) -> [T; 2] {
        self.held[f] = self.now[f];
        self.held[f]
    }

    /// That at the last value.
    pub(super) fn held(&self, f: usize) -> [T; 2] {
        self.held[f]
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
        self.add(f, k, normal.map(|x| by * x));
    }

    fn add(&mut self, f: usize, k: usize, change: [T; 2]) {
        let u = &mut self.series[f][k];
        *u = [u[0] + change[0], u[1] + change[1]];
    }
}

pub(crate) fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[1] - a[1] * b[0]
}

/// The direction in which a slip goes to zero, from the slip at parts of the way there, 1 its end: chords over ever shorter
/// parts, extrapolated. None if it does not change.
pub(crate) fn approach<T: Scalar>(mut slip: impl FnMut(f64) -> [T; 2]) -> Option<[T; 2]> {
    const PART: f64 = 1e-3;
    let end = slip(1.0);
    let mut along = [T::zero(); 2];
    for (weight, parts) in [(3.0, 1.0), (-1.5, 2.0), (1.0 / 3.0, 3.0)] {
        let before = slip(1.0 - parts * PART);
        for ((along, before), end) in along.iter_mut().zip(before).zip(end) {
            *along += T::from_f64(weight) * (before - end);
        }
    }
    let length = along[0].value().hypot(along[1].value());
    if !(length > 0.0) {
        return None;
    }
    // About 1, so that the square is: a slip may be very small.
    let along = along.map(|x| x / T::from_f64(length));
    let unit = dot(along, along).sqrt();
    Some(along.map(|x| T::from_f64(x.value()) + derivatives(x / unit)))
}

impl<T: Scalar> Dynamics<T> {
    /// The direction in which friction `f` of two components slips, or begins to: that at the last [`Self::series`], or the
    /// one that was set or taken since.
    pub fn slip_direction(&self, f: usize) -> [T; 2] {
        self.slip_directions.of(f)
    }

    /// The direction, a unit vector, in which friction `f` of two components begins to slip ([`Direction::Incipient`]).
    pub(crate) fn set_slip_direction(&mut self, f: usize, along: [T; 2]) {
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
    /// The same as [`Self::value`].
    pub fn value_along(&mut self, t: T, q: &[T], v: &[T]) -> Result<(), EvaluationError> {
        self.value_along_from(t, q, v, &[])
    }

    /// The slips that begin in the mode, as errors have left them at the last [`Self::tape`].
    pub(crate) fn beginning_slips(&self) -> Vec<[T; 2]> {
        let beginnings = 0..self.beginnings();
        beginnings.map(|i| self.slip(self.beginning(i))).collect()
    }

    /// [`Self::value_along`], where the slips that begin were `left` by errors as they began.
    pub(crate) fn value_along_from(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        left: &[[T; 2]],
    ) -> Result<(), EvaluationError> {
        let count = self.compiled().pattern.sliding.slip_directions.len();
        if count == 0 {
            return self.value(t, q, v);
        }
        self.tape(t, q, v);
        for i in 0..count {
            let f = self.beginning(i);
            let left = left.get(i).copied().unwrap_or_default();
            let slip = self.slip(f);
            let slip = [0, 1].map(|k| slip[k] - left[k]);
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
    pub(crate) fn slip_size(&self, f: usize, v: &[T]) -> f64 {
        let friction = &self.description().frictions[f];
        let rows = &self.description().rows[friction.rows()];
        let terms = rows.iter().flat_map(|row| row.jacobian);
        let sizes = terms.map(|&(j, place)| (self.motion(place) * v[j]).value().abs());
        1.0 + sizes.sum::<f64>()
    }

    /// Takes the slip directions of all sliding frictions of two components from their slips at the last value, and those of the forces that
    /// press together.
    pub(crate) fn take_directions(&mut self) {
        self.take_directions_of(Self::slip);
    }

    /// The same from the series.
    pub(super) fn take_directions_of_series(&mut self) {
        self.take_directions_of(|dynamics, f| dynamics.slip_coefficient(f, 0));
    }

    #[inline]
    fn take_directions_of(&mut self, slip: impl Fn(&Self, usize) -> [T; 2]) {
        self.resultants.hold();
        for f in 0..self.description().frictions.len() {
            if self.turns(f) {
                self.head_along(f, slip(self, f));
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
        self.begin_straight();
        for k in 1..(order + 1).min(MAX_ORDER) {
            self.keep_lengths(k);
            self.expand_anew(k + 1)?;
            if k == 1 {
                self.respond()?;
            }
            self.turn_all(k)?;
        }
        self.expand_anew(order)
    }

    /// Whether each slip that begins does so by more than what errors make of one whose friction is at its limit: a root of that would begin anywhere.
    pub(super) fn begins_clearly(&self) -> bool {
        let strengths = &self.slip_directions.strength;
        (0..self.beginnings()).all(|i| {
            let slip = self.slip_coefficient(self.beginning(i), 1);
            let strength = strengths.get(i).copied().unwrap_or(0.0);
            dot(slip, slip).value().sqrt() > CLEARLY * strength
        })
    }

    /// Coefficient 2 of s × u of each slip that begins, for directions that do not turn.
    ///
    /// # Errors
    /// The same as [`Self::series`].
    pub(crate) fn bends(&mut self, t: T, q: &[T], v: &[T]) -> Result<Vec<T>, EvaluationError> {
        self.expand_straight(2, t, q, v)?;
        let count = self.beginnings();
        Ok((0..count).map(|i| self.crossed(i, 2)).collect())
    }

    /// Coefficient `order` of the slip of friction `f`, for directions that do not turn.
    ///
    /// # Errors
    /// The same as [`Self::series`].
    pub(crate) fn slip_ahead(
        &mut self,
        f: usize,
        order: usize,
        t: T,
        q: &[T],
        v: &[T],
    ) -> Result<[T; 2], EvaluationError> {
        self.expand_straight(order, t, q, v)?;
        Ok(self.slip_coefficient(f, order))
    }

    fn expand_straight(
        &mut self,
        order: usize,
        t: T,
        q: &[T],
        v: &[T],
    ) -> Result<(), EvaluationError> {
        (self.series_by_functions, self.by_functions) = (false, false);
        self.run(t, q, v, Extent::Series, true)?;
        let expand = |this: &mut Self, order| {
            this.begin_straight();
            this.expand_anew(order)
        };
        self.with_roots(order, expand)
    }

    /// How many slips begin.
    fn beginnings(&self) -> usize {
        self.compiled().pattern.sliding.slip_directions.len()
    }

    /// The friction of slip direction `i` of the plan.
    fn beginning(&self, i: usize) -> usize {
        self.compiled().pattern.sliding.slip_directions[i].friction
    }

    /// Directions that do not turn.
    fn begin_straight(&mut self) {
        for i in 0..self.beginnings() {
            let f = self.beginning(i);
            self.slip_directions.series[f] = [[T::zero(); 2]; MAX_ORDER + 2];
            self.slip_directions.series[f][0] = self.slip_directions.now[f];
        }
    }

    /// Coefficients `k` of all directions without a turn.
    fn keep_lengths(&mut self, k: usize) {
        for i in 0..self.beginnings() {
            let f = self.beginning(i);
            self.slip_directions.keep_length(f, k);
        }
    }

    /// Coefficient `k` of s × u of slip direction `i`; zero where it is rounding, which grows without bound where slips begin smoothly.
    fn crossed(&self, i: usize, k: usize) -> T {
        let (sum, size) = self.terms_crossed(i, k);
        match sum.value().abs() <= ROUNDING * size {
            true => derivatives(sum),
            false => sum,
        }
    }

    /// The same as it is, and the size of its terms.
    fn terms_crossed(&self, i: usize, k: usize) -> (T, f64) {
        let f = self.beginning(i);
        let (mut sum, mut size) = (T::zero(), 0.0);
        for j in 1..=k {
            let u = self.slip_directions.coefficient(f, k - j);
            let s = self.slip_coefficient(f, j);
            sum += cross(s, u);
            size += (dot(s, s) * dot(u, u)).value().sqrt();
        }
        (sum, size)
    }

    /// D, from what a turn of order 1 does to the slip of order 2; and what a friction that grows or turns at the rate 1/s does to it.
    fn respond(&mut self) -> Result<(), EvaluationError> {
        let count = self.beginnings();
        self.slip_directions.straight.clear();
        for i in 0..count {
            let slip = self.slip_coefficient(self.beginning(i), 2);
            self.slip_directions.straight.push(slip);
        }
        self.slip_directions.response.clear();
        self.slip_directions
            .response
            .resize(count * count, T::zero());
        self.slip_directions.strength.clear();
        self.slip_directions.strength.resize(count, 0.0);
        for j in 0..count {
            let f = self.beginning(j);
            let (along, normal) = self.slip_directions.frame(f);
            for (change, turns) in [(along, false), (normal, true)] {
                self.slip_directions.add(f, 1, change);
                self.expand_anew(2)?;
                for i in 0..count {
                    let f = self.beginning(i);
                    let (before, after) = (
                        self.slip_directions.straight[i],
                        self.slip_coefficient(f, 2),
                    );
                    let twice = [0, 1].map(|k| after[k] - before[k] + after[k] - before[k]);
                    let size = dot(twice, twice).value().sqrt();
                    let directions = &mut self.slip_directions;
                    directions.strength[i] = directions.strength[i].max(size);
                    if turns {
                        let (along, _) = directions.frame(f);
                        directions.response[i * count + j] = cross(twice, along);
                    }
                }
                self.slip_directions.keep_length(f, 1);
            }
        }
        self.expand_anew(2)
    }

    /// Solves for the turns of order `k`; the slips are known up to order k + 1 without them.
    fn turn_all(&mut self, k: usize) -> Result<(), EvaluationError> {
        let count = self.beginnings();
        for _ in 0..MOST_CORRECTIONS {
            self.ask(k);
            let SlipDirections {
                matrix,
                strength,
                open,
                ..
            } = &mut self.slip_directions;
            open.find(matrix, strength, NO_ANSWER);
            let higher = !open.is_empty();
            let mut ahead = k + 1;
            while higher && (ahead == k + 1 || self.says_nothing()) {
                ahead += 1;
                if ahead > MAX_ORDER {
                    return Ok(());
                }
                self.ask_ahead(k, ahead)?;
            }
            let SlipDirections { matrix, right, .. } = &mut self.slip_directions;
            if !solve_small(matrix, right) {
                let operation = Operation::SquareRoot;
                let f = self.beginning(0);
                let item = Some(self.description().frictions[f].name);
                return Err(EvaluationError::NoSeries { operation, item });
            }
            let mut largest = 0.0_f64;
            for i in 0..count {
                let f = self.beginning(i);
                let by = self.slip_directions.right[i];
                largest = largest.max(by.value().abs());
                self.slip_directions.turn(f, k, by);
            }
            // Linear but for the coefficient after that of a turn of order 1.
            let size = |i: usize| {
                let u = self.slip_directions.coefficient(self.beginning(i), k);
                dot(u, u).value().sqrt()
            };
            let size = (0..count).map(size).fold(0.0, f64::max);
            if !higher || k > 1 || largest <= SETTLED * size {
                break;
            }
            self.expand_anew(k + 1)?;
        }
        Ok(())
    }

    /// The equations for the turns of order `k`: coefficient k + 1 of s × u.
    fn ask(&mut self, k: usize) {
        let count = self.beginnings();
        let share = T::from_f64(1.0 / (k + 1) as f64);
        let directions = &mut self.slip_directions;
        directions.matrix.clear();
        (directions.matrix).extend(directions.response.iter().map(|&x| share * x));
        directions.right.clear();
        for i in 0..count {
            let f = self.beginning(i);
            let (along, _) = self.slip_directions.frame(f);
            let growth = dot(self.slip_coefficient(f, 1), along);
            self.slip_directions.matrix[i * count + i] += growth;
            let right = -self.crossed(i, k + 1);
            self.slip_directions.right.push(right);
        }
    }

    /// Whether an equation whose combination vanishes has nothing in its place.
    fn says_nothing(&self) -> bool {
        let SlipDirections { open, matrix, .. } = &self.slip_directions;
        let count = self.beginnings();
        let mut rows = open.iter();
        rows.any(|(row, _)| {
            matrix[row * count..][..count]
                .iter()
                .all(|x| x.value() == 0.0)
        })
    }

    /// Puts combinations of later coefficients, `ahead`, in the place of equations whose combinations vanish.
    fn ask_ahead(&mut self, k: usize, ahead: usize) -> Result<(), EvaluationError> {
        let open = self.slip_directions.open.clone();
        let count = self.beginnings();
        let next = |dynamics: &mut Self| -> Result<Vec<T>, EvaluationError> {
            (k + 1..ahead).for_each(|j| dynamics.keep_lengths(j));
            dynamics.expand_anew(ahead)?;
            Ok((0..count).map(|i| dynamics.crossed(i, ahead)).collect())
        };
        let sum = |weights: &[T], terms: &[T]| {
            let mut sum = T::zero();
            for (&weight, &term) in weights.iter().zip(terms) {
                sum += weight * term;
            }
            sum
        };
        let before = next(self)?;
        // Not lost beside coefficients that grow without bound, and small where they depend on the square of a turn.
        let turns = (0..count).flat_map(|i| self.slip_directions.series[self.beginning(i)]);
        let size = turns.fold(1.0_f64, |m, u| m.max(dot(u, u).value().sqrt()));
        let size = before.iter().fold(size, |m, x| m.max(x.value().abs()));
        let terms = (0..count).map(|i| self.terms_crossed(i, ahead).1);
        let part = T::from_f64(match k {
            1 => SMALL * size,
            _ => terms.fold(size, f64::max),
        });
        for (row, weights) in open.iter() {
            self.slip_directions.right[row] = -sum(weights, &before);
        }
        for j in 0..count {
            let f = self.beginning(j);
            let held = self.slip_directions.coefficient(f, k);
            self.slip_directions.turn(f, k, part);
            let after = next(self)?;
            self.slip_directions.series[f][k] = held;
            let changes = after.iter().zip(&before);
            let changes: Vec<T> = changes.map(|(&x, &y)| (x - y) / part).collect();
            for (row, weights) in open.iter() {
                self.slip_directions.matrix[row * count + j] = sum(weights, &changes);
            }
        }
        (k + 1..ahead).for_each(|j| self.keep_lengths(j));
        Ok(())
    }
}
