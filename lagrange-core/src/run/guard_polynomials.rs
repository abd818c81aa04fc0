//! The guards of a step as polynomials in s ∈ [0, 1].
//!
//! With Taylor series they come exactly, from the coefficients of the step. With a Runge–Kutta method the guards are
//! evaluated at the Chebyshev–Lobatto points of the dense output and interpolated; [`super::samples`] sees to it that the
//! interpolation holds.

use super::samples::SampledRoot;
use crate::arithmetic::quad::{Quad, QuadBody, side_by_side};
use crate::arithmetic::{self, Scalar};
use crate::dynamics::{Dynamics, EvaluationError};
use crate::effects::{Effects, Item};
use crate::events::{Root, RootList, clearance, deflate, keeps_its_sign, turns};
use crate::integrate::taylor::worse;
use crate::integrate::{StepPolynomial, polynomial_value as at};
use crate::mode::Mode;
use crate::modes::composite::{self, CompositeGuard};
use crate::modes::guard::{Guard, Linear, Sums};
use crate::modes::reading::Reading;
use crate::system::Description;

/// A guard on the other side of zero than its polynomial is off by more than rounding explains: this much more is counted.
const OTHER_SIDE: f64 = 1e3;

/// Coefficients this much smaller than all together can still be told from 0.
pub(super) const CLEAR: f64 = 1e-10;

/// So much a guard of size 1 is off by rounding; see [`rounding`].
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Samples of a guard in a step of a Runge–Kutta method, at least.
const FEWEST_SAMPLES: usize = 8;

/// Coefficients of an interpolation lose so many digits to rounding, relative.
const INTERPOLATION: f64 = 1e-11;

/// An interpolated guard may be off by this share of what would give it other roots,
const AWAY: f64 = 1e-2;

/// and by this share if it is known to what an end of a step may be off.
const CLOSE: f64 = 0.3;

/// A guard that turns in a step comes close to zero where it has this share of what it was before.
const NEAR: f64 = 1e-2;

/// A guard over a step.
#[derive(Clone, Copy, Debug)]
struct GuardPolynomial {
    guard: Guard,
    /// What it is made of, where that does not change along the mode.
    linear: Option<Linear>,
    /// Of its coefficients, with Taylor series.
    sums: Sums,
    /// Whether it stays positive for certain.
    stays: bool,
    /// What is added to the guard: that far it may fall below zero.
    margin: f64,
}

/// The guards of a mode and what is watched beside, with their polynomials over a step.
#[derive(Clone, Debug, Default)]
pub(super) struct GuardPolynomials {
    /// Stops, marks, guards of the mode.
    list: Vec<GuardPolynomial>,
    /// Guards of undetermined forces that have been met in this mode.
    pub(super) composites: Vec<CompositeGuard>,
    /// Per branch: whether the mode holds it at its border, where its guard is rounding and is not watched.
    pub(super) held: Vec<bool>,
    /// One after the other, each of `width` coefficients.
    coefficients: Vec<f64>,
    width: usize,
    /// The stops and marks that take part.
    pub(super) stops: Vec<usize>,
    pub(super) marks: Vec<usize>,
    /// Terms of those before the first of each.
    first_stop: Vec<usize>,
    first_mark: Vec<usize>,
    watches: Vec<Guard>,
    /// Interpolation: samples → coefficients, row-major, for `nodes`.
    matrix: Vec<f64>,
    nodes: Vec<f64>,
    /// Roots of guards that were sampled.
    pub(super) roots: Vec<SampledRoot>,
}

/// Takes guards from the series that the dynamics hold, for four coefficients at a time.
struct FromSeries;

impl<T: Scalar> QuadBody<(&mut GuardPolynomials, &Dynamics<T>, &Mode, &[f64])> for FromSeries {
    type Output = ();

    #[inline(always)]
    fn run<Q: Quad>(
        quad: Q,
        (guards, dynamics, mode, powers): (&mut GuardPolynomials, &Dynamics<T>, &Mode, &[f64]),
    ) {
        let reading = Reading::Series(dynamics);
        let coefficients = guards.coefficients.chunks_exact_mut(guards.width);
        for (c, curve) in coefficients.zip(&mut guards.list) {
            curve.sums = match &curve.linear {
                Some(linear) => linear.series(quad, &reading, powers, c),
                None => {
                    composite::series(curve.guard, &guards.composites, mode, &reading, powers, c);
                    Sums::of(c)
                }
            };
            c[0] += curve.margin;
            curve.sums.end += curve.margin;
            curve.stays = false;
        }
    }
}

impl GuardPolynomials {
    /// Room for the stops and marks of a system, as far as these effects have them.
    pub(super) fn new(d: &Description, effects: &Effects) -> Self {
        let mut curves = GuardPolynomials::default();
        for (i, stop) in d.stops.iter().enumerate() {
            curves.first_stop.push(curves.watches.len());
            if effects.includes(d, Item::Stop(i)) {
                curves.stops.push(i);
                let terms = (0..stop.terms.len()).map(|k| Guard::Stop(i, k));
                curves.watches.extend(terms);
            }
        }
        for (i, mark) in d.marks.iter().enumerate() {
            curves.first_mark.push(curves.watches.len());
            if effects.includes(d, Item::Mark(i)) {
                curves.marks.push(i);
                let terms = (0..mark.terms.len()).map(|k| Guard::Mark(i, k));
                curves.watches.extend(terms);
            }
        }
        curves
    }

    /// Watches these guards of single forces in a mode, and the composite ones, from now on.
    pub(super) fn arm<T: Scalar>(
        &mut self,
        guards: impl Iterator<Item = Guard>,
        mode: &Mode,
        dynamics: &Dynamics<T>,
    ) {
        let composites = (0..self.composites.len()).map(Guard::Composite);
        let watches = self.watches.iter().copied();
        let held = &self.held;
        let moves =
            |guard: &Guard| !matches!(*guard, Guard::Branch(b) if held.get(b) == Some(&true));
        let curves = watches
            .chain(guards.filter(moves))
            .chain(composites)
            .map(|guard| GuardPolynomial {
                guard,
                linear: Linear::of(guard, mode, dynamics),
                sums: Sums {
                    end: 0.0,
                    rest: f64::INFINITY,
                },
                stays: false,
                margin: 0.0,
            });
        self.list.clear();
        self.list.extend(curves);
        self.shape(self.width);
    }

    /// The same in a mode that goes on: what may fall below zero still may, and what is known of guards over the step at hand is kept. Whether
    /// others are watched than before.
    pub(super) fn rearm<T: Scalar>(
        &mut self,
        guards: impl Iterator<Item = Guard>,
        mode: &Mode,
        dynamics: &Dynamics<T>,
    ) -> bool {
        let before = self.list.clone();
        let coefficients = core::mem::take(&mut self.coefficients);
        self.arm(guards, mode, dynamics);
        let width = self.width;
        let curves = self.coefficients.chunks_exact_mut(width.max(1));
        for (curve, c) in self.list.iter_mut().zip(curves) {
            // A guard that is new has no root in this step.
            c[0] = 1.0;
            curve.sums = Sums::of(c);
            let known = before.iter().position(|known| known.guard == curve.guard);
            if let Some(known) = known {
                curve.margin = before[known].margin;
                (curve.sums, curve.stays) = (before[known].sums, before[known].stays);
                if let Some(own) = coefficients.get(known * width..(known + 1) * width) {
                    c.copy_from_slice(own);
                }
            }
        }
        let guards = |list: &[GuardPolynomial]| -> Vec<Guard> {
            list.iter().map(|curve| curve.guard).collect()
        };
        guards(&before) != guards(&self.list)
    }

    /// The guards of the mode with their polynomials.
    pub(super) fn of_mode(&self) -> impl Iterator<Item = (Guard, &[f64])> {
        let first = self.watches.len();
        let curves = self.coefficients.chunks_exact(self.width.max(1));
        let guards = self.list.iter().map(|curve| curve.guard);
        guards.zip(curves).skip(first)
    }

    /// The polynomial of a guard, if it is one of the mode.
    pub(super) fn of(&self, guard: Guard) -> Option<&[f64]> {
        self.of_mode().find(|(g, _)| *g == guard).map(|(_, c)| c)
    }

    fn curve(&self, index: usize) -> &[f64] {
        &self.coefficients[index * self.width..][..self.width]
    }

    /// Term `k` of stop `i`.
    pub(super) fn stop_term(&self, i: usize, k: usize) -> &[f64] {
        self.curve(self.first_stop[i] + k)
    }

    /// The numbers of the terms of stop `i`.
    pub(super) fn stop_terms(&self, i: usize) -> impl Iterator<Item = usize> {
        let of_stop = move |guard| matches!(guard, Guard::Stop(j, _) if j == i);
        self.terms(self.first_stop[i], of_stop)
    }

    /// The numbers of the terms of mark `i`.
    pub(super) fn mark_terms(&self, i: usize) -> impl Iterator<Item = usize> {
        let of_mark = move |guard| matches!(guard, Guard::Mark(j, _) if j == i);
        self.terms(self.first_mark[i], of_mark)
    }

    /// The numbers of the terms of a watch, given the first.
    fn terms(&self, first: usize, own: impl Fn(Guard) -> bool) -> impl Iterator<Item = usize> {
        (first..self.watches.len()).take_while(move |&index| own(self.watches[index]))
    }

    /// Term `k` of mark `i`.
    pub(super) fn mark_term(&self, i: usize, k: usize) -> &[f64] {
        self.curve(self.first_mark[i] + k)
    }

    /// Makes room for curves of `width` coefficients.
    fn shape(&mut self, width: usize) {
        self.width = width;
        self.coefficients.resize(self.list.len() * width, 0.0);
    }

    /// Takes the guards from the series that `dynamics` holds; `powers` are those of the length of the step.
    #[inline(never)]
    pub(super) fn take_series<T: Scalar>(
        &mut self,
        dynamics: &Dynamics<T>,
        mode: &Mode,
        powers: &[f64],
    ) {
        self.shape(powers.len());
        self.roots.clear();
        if !self.list.is_empty() {
            side_by_side::<FromSeries, _>((self, dynamics, mode, powers));
        }
    }

    /// Lets a guard of the mode fall below zero by `margin`, until [`Self::raise`] finds it clear of zero.
    pub(super) fn lower(&mut self, guard: Guard, margin: f64) {
        for curve in self.list.iter_mut().filter(|curve| curve.guard == guard) {
            curve.margin = margin;
        }
    }

    /// Whether a guard may fall below zero.
    pub(super) fn is_lowered(&self, guard: Guard) -> bool {
        let mut lowered = self.list.iter().filter(|curve| curve.margin > 0.0);
        lowered.any(|curve| curve.guard == guard)
    }

    /// How many guards may fall below zero.
    pub(super) fn lowered(&self) -> usize {
        self.list.iter().filter(|curve| curve.margin > 0.0).count()
    }

    /// Takes the margin from guards that are clear of zero at part `end` of the step.
    pub(super) fn raise(&mut self, end: f64) {
        let coefficients = self.coefficients.chunks_exact(self.width.max(1));
        for (curve, c) in self.list.iter_mut().zip(coefficients) {
            if curve.margin > 0.0 && at(c, end) > 2.0 * curve.margin {
                curve.margin = 0.0;
            }
        }
    }

    /// Finds out which guards of the mode stay positive within the step for certain; true if all do but those of which that does
    /// not matter. `zeros` tells how many first coefficients are residues.
    pub(super) fn look(
        &mut self,
        zeros: &[(Guard, usize)],
        matters: impl Fn(Guard) -> bool,
    ) -> bool {
        let mut all = true;
        let coefficients = self.coefficients.chunks_exact(self.width);
        let curves = self.list.iter_mut().zip(coefficients);
        for (curve, c) in curves.skip(self.watches.len()) {
            let known = zeros.iter().find(|(guard, _)| *guard == curve.guard);
            let (c, rest) = match known {
                None => (c, curve.sums.rest),
                Some((_, known)) => {
                    let c = deflate(c, *known);
                    (c, Sums::of(c).rest)
                }
            };
            curve.stays = c.is_empty() || c[0] > 0.0 && keeps_its_sign(c, rest, CLEAR);
            all &= curve.stays || !matters(curve.guard);
        }
        all
    }

    /// The guards of the mode that may not stay positive, with their polynomials.
    pub(super) fn in_question(&self) -> impl Iterator<Item = (Guard, &[f64])> {
        let curves = self.list.iter().skip(self.watches.len());
        let stays = curves.map(|curve| curve.stays);
        let open = self.of_mode().zip(stays).filter(|(_, stays)| !stays);
        open.map(|(pair, _)| pair)
    }

    /// Whether term `k` of stop `i` keeps its sign within the step for certain, and the one that it had before.
    pub(super) fn stop_stays(&self, i: usize, k: usize, was_below: bool) -> bool {
        let index = self.first_stop[i] + k;
        let c = self.curve(index);
        keeps_its_sign(c, self.list[index].sums.rest, CLEAR) && (c[0] < 0.0) == was_below
    }

    /// Guard number `index` and its polynomial.
    pub(super) fn get(&self, index: usize) -> Option<(Guard, &[f64])> {
        let curve = self.list.get(index)?;
        Some((curve.guard, self.curve(index)))
    }

    /// The number of a guard of the mode.
    pub(super) fn index_of(&self, guard: Guard) -> Option<usize> {
        let first = self.watches.len();
        let found = self.list[first..].iter().position(|c| c.guard == guard)?;
        Some(first + found)
    }

    /// Guard number `index` at the last value of `dynamics`.
    #[inline]
    pub(super) fn value<T: Scalar>(
        &self,
        index: usize,
        mode: &Mode,
        dynamics: &Dynamics<T>,
    ) -> f64 {
        let reading = Reading::Values(dynamics);
        let curve = &self.list[index];
        let value = match &curve.linear {
            Some(linear) => linear.value(&reading),
            None => composite::value(curve.guard, &self.composites, mode, &reading),
        };
        value + curve.margin
    }

    /// How far the polynomials are off at part `s` of the step, in units of what is allowed by the tolerance and, of forces, by their blur;
    /// `dynamics` holds the values of the state there, `known` tells of a guard whether this is its root, and how large what makes it is at least.
    ///
    /// The step is chosen for the coordinates, but a guard is a function of them whose series may converge no further than
    /// a part of it: in free flight the coordinates are polynomials, the distance √(x² + y²) is not. Where the flight passes
    /// through 0 even a series that has ended, and looks exact, goes on along the wrong branch.
    #[inline(never)]
    pub(super) fn defect<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        [tolerance, blur]: [f64; 2],
        known: impl Fn(Guard) -> (bool, f64),
    ) -> f64 {
        let mut worst = 0.0;
        self.errors(
            dynamics,
            mode,
            s,
            [tolerance, blur],
            known,
            |error, allowed, rounding, other_side| {
                let mut ratio = error / (allowed + rounding);
                if other_side && error > rounding {
                    ratio *= OTHER_SIDE;
                }
                worst = worse(worst, ratio);
            },
        );
        worst
    }

    /// The same without what rounding explains: a guard that is a small difference of large numbers is off by as much however short
    /// the step.
    pub(super) fn truncation<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
        known: impl Fn(Guard) -> (bool, f64),
    ) -> f64 {
        let mut worst = 0.0_f64;
        self.errors(
            dynamics,
            mode,
            s,
            [tolerance, 0.0],
            known,
            |error, allowed, rounding, _| worst = worst.max((error - rounding) / allowed),
        );
        worst
    }

    /// Tells the error of every polynomial at part `s` of the step, what is allowed but for rounding, what rounding makes, and whether the guard
    /// is on the other side of zero.
    #[inline(always)]
    fn errors<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        [tolerance, blur]: [f64; 2],
        known: impl Fn(Guard) -> (bool, f64),
        mut tell: impl FnMut(f64, f64, f64, bool),
    ) {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        for (index, (curve, c)) in (self.list.iter())
            .zip(self.coefficients.chunks_exact(self.width))
            .enumerate()
        {
            let (located, least) = known(curve.guard);
            let (share, floor) = allowance::<T>(curve.guard, located);
            let blur = if curve.guard.is_force() { blur } else { 0.0 };
            let allowed = (share * tolerance).max(floor).max(blur);
            let value = self.value(index, mode, dynamics);
            let found = if s == 1.0 { curve.sums.end } else { at(c, s) };
            // Not all coefficients: where the series has stopped converging they are large and cancel.
            let size = (value.abs() + (c[0].abs() + c[1].abs())).max(least);
            let other_side = !located && (found < 0.0) != (value < 0.0);
            let error = (found - value).abs();
            let rounding = rounding(error, curve.guard, dynamics);
            tell(error, allowed * size, rounding, other_side);
        }
    }

    /// A guard whose polynomial has a coefficient that is not finite.
    pub(super) fn without_series(&self) -> Option<Guard> {
        let coefficients = self.coefficients.chunks_exact(self.width.max(1));
        let mut curves = self.list.iter().zip(coefficients);
        let found = curves.find(|(_, c)| c.iter().any(|c| !c.is_finite()));
        found.map(|(curve, _)| curve.guard)
    }

    /// Makes the guards stay what they are at the start of the step. The first that must not be what it is in the values that
    /// `dynamics` holds: no number, or, of a gap or a branch, below zero; with what it was and is.
    pub(super) fn hold<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
    ) -> Option<(Guard, f64, f64)> {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        let mut broken = None;
        for index in 0..self.list.len() {
            let value = self.value(index, mode, dynamics);
            let curve = &mut self.coefficients[index * self.width..][..self.width];
            curve[1..].fill(0.0);
            let guard = self.list[index].guard;
            let one_sided = matches!(guard, Guard::Gap(_) | Guard::Branch(_));
            let falls = value < -rounding(value.abs(), guard, dynamics) && curve[0] >= 0.0;
            if value.is_nan() || one_sided && falls {
                broken = broken.or(Some((guard, curve[0], value)));
            }
        }
        broken
    }

    /// Samples the guards along the dense output of a step and interpolates them.
    ///
    /// # Errors
    /// The equations of motion could not be evaluated somewhere in the step.
    pub(super) fn sample<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        step: &StepPolynomial<T>,
        q: &mut [T],
        v: &mut [T],
    ) -> Result<(), EvaluationError> {
        // A guard bends more than the coordinates that it is made of.
        let m = (step.degree + 1).max(FEWEST_SAMPLES);
        self.prepare(m);
        self.shape(m);
        for curve in &mut self.list {
            curve.stays = false;
        }
        self.coefficients.fill(0.0);
        if self.coefficients.is_empty() {
            return Ok(());
        }
        for j in 0..m {
            let s = self.nodes[j];
            step.state_into(T::from_f64(s), q, v);
            dynamics.value(step.t + step.h * T::from_f64(s), q, v)?;
            if j == 0 {
                dynamics.take_directions();
            }
            // Stops and marks read the tape after the solve.
            dynamics.report_value();
            for index in 0..self.list.len() {
                let sample = self.value(index, mode, dynamics);
                let curve = &mut self.coefficients[index * m..][..m];
                if j == 0 {
                    curve[0] = sample;
                    continue;
                }
                // What does not change has no part in the rounding of the coefficients, which are large.
                let change = sample - curve[0];
                for (c, row) in curve[1..]
                    .iter_mut()
                    .zip(self.matrix.chunks_exact(m).skip(1))
                {
                    *c += row[j] * change;
                }
            }
        }
        Ok(())
    }

    /// How far interpolated guards are off at part `s` of the step, in units of what is allowed; `dynamics` holds the values of
    /// the state there. A guard need not be known well as long as it has no other roots than its interpolation.
    pub(super) fn interpolation_defect<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
    ) -> f64 {
        dynamics.report_value();
        let mut worst = 0.0;
        for (index, curve) in self.list.iter().enumerate() {
            let c = self.curve(index);
            let value = self.value(index, mode, dynamics);
            let size = value.abs() + (c[0].abs() + c[1].abs());
            let error = (at(c, s) - value).abs();
            let rounding = rounding(error, curve.guard, dynamics);
            let allowed = |located: bool| {
                let (share, floor) = allowance::<T>(curve.guard, located);
                (share * tolerance).max(floor).max(INTERPOLATION) * size + rounding
            };
            let [missed, located] = [false, true].map(allowed);
            // Where it begins with zero the root is known.
            let begins = usize::from(c[0].abs() <= located);
            let clear = clearance(deflate(c, begins)) * s.powi(begins as i32);
            let accepted = located.max(AWAY * clear).max(missed.min(CLOSE * clear));
            worst = worse(worst, error / accepted);
        }
        worst
    }

    /// Whether guard number `index` is zero at the last value of `dynamics`, to what its interpolation may be off. Those of undetermined forces are
    /// corrected by themselves.
    pub(super) fn vanishes<T: Scalar>(
        &self,
        index: usize,
        mode: &Mode,
        dynamics: &Dynamics<T>,
        tolerance: f64,
    ) -> bool {
        let guard = self.list[index].guard;
        let (share, floor) = allowance::<T>(guard, true);
        let allowed = (share * tolerance).max(floor).max(INTERPOLATION);
        let (c, value) = (self.curve(index), self.value(index, mode, dynamics));
        let size = value.abs() + (c[0].abs() + c[1].abs());
        let allowed = allowed * size + rounding(value.abs(), guard, dynamics);
        matches!(guard, Guard::Composite(_)) || value.abs() <= allowed
    }

    /// Where the first guard turns that comes close to zero without a root before, or with roots that are hardly apart: there the
    /// dense output must not be off.
    pub(super) fn first_turn(&self, end: f64) -> Option<f64> {
        let mut first = None;
        let mut all = RootList::new();
        for index in 0..self.list.len() {
            let c = self.curve(index);
            turns(c, &mut all);
            let close = |root: &&Root| {
                let least = at(c, root.s);
                let fall = (c[0] - least).abs();
                root.s < first.unwrap_or(end) && fall > ROUNDING && least.abs() <= NEAR * fall
            };
            first = all.iter().find(close).map(|root| root.s).or(first);
        }
        first
    }

    /// Two parts of a step between the samples of its guards; nothing where none is sampled.
    pub(super) fn between_samples(&self) -> Option<[f64; 2]> {
        self.get(0)?;
        let m = self.nodes.len();
        Some([m / 4, 2 * m / 3].map(|j| 0.5 * (self.nodes[j] + self.nodes[j + 1])))
    }

    /// Chebyshev–Lobatto points on [0, 1] and the inverse of their Vandermonde matrix.
    fn prepare(&mut self, m: usize) {
        if self.nodes.len() == m {
            return;
        }
        let last = (m - 1) as f64;
        self.nodes = (0..m)
            .map(|j| 0.5 - 0.5 * (core::f64::consts::PI * j as f64 / last).cos())
            .collect();
        self.nodes[0] = 0.0;
        self.nodes[m - 1] = 1.0;
        self.matrix = vec![0.0; m * m];
        for j in 0..m {
            // Coefficients of the Lagrange polynomial of node j.
            let mut c = vec![0.0; m];
            c[0] = 1.0;
            for (degree, i) in (0..m).filter(|i| *i != j).enumerate() {
                let scale = 1.0 / (self.nodes[j] - self.nodes[i]);
                for k in (0..=degree).rev() {
                    c[k + 1] += c[k] * scale;
                    c[k] *= -self.nodes[i] * scale;
                }
            }
            for (k, c) in c.into_iter().enumerate() {
                self.matrix[k * m + j] = c;
            }
        }
    }
}

/// What rounding makes of a guard at the last value of `dynamics`, to be told from an `error`. Gaps and slips are differences of positions and of
/// velocities, which may be large: those of two satellites on a rope, from the centre of the Earth. What is watched, and where branches change, may be
/// made of all of them.
#[inline]
pub(super) fn rounding<T: Scalar>(error: f64, guard: Guard, dynamics: &Dynamics<T>) -> f64 {
    let least = arithmetic::rounding::<T>(ROUNDING);
    if error <= least {
        return least;
    }
    let state = dynamics.time_and_state();
    let n = state.len() / 2;
    let terms = match guard {
        Guard::Gap(_) => &state[1..=n],
        Guard::Slip(_) => &state[1 + n..],
        Guard::Stop(..) | Guard::Mark(..) | Guard::Branch(_) => state,
        _ => return least,
    };
    let larger = |size: f64, x: &T| size.max(x.value().abs());
    least * terms.iter().fold(1.0, larger)
}

/// Error that a guard may have at the end of a step: in units of the tolerance, and at least.
///
/// Forces are second derivatives, and the worse for it. Where a guard has been located it has to be exact, else it only must not
/// be missed.
#[inline]
fn allowance<T: Scalar>(guard: Guard, located: bool) -> (f64, f64) {
    let (share, floor) = match (guard.is_force(), located) {
        (true, true) => (10.0, 1e-12),
        (true, false) => (1e4, 1e-10),
        (false, true) => (0.1, 1e-14),
        (false, false) => (10.0, 1e-13),
    };
    (share, arithmetic::rounding::<T>(floor))
}
