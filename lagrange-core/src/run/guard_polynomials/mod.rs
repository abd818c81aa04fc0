//! The guards of a step as polynomials in s ∈ [0, 1].
//!
//! With Taylor series they come exactly, from the coefficients of the step. With a Runge–Kutta method they are interpolated between samples.

mod errors;
mod interpolation;

use super::samples::SharpRoot;
use crate::arithmetic::Scalar;
use crate::arithmetic::quad::{Quad, QuadBody, side_by_side};
use crate::dynamics::Dynamics;
use crate::effects::{Effects, Item};
use crate::events::{Root, RootList, deflate, keeps_its_sign, turns};
use crate::integrate::polynomial_value as at;
use crate::mode::Mode;
use crate::modes::composite::{self, CompositeGuard};
use crate::modes::guard::{Guard, Linear, Sums};
use crate::modes::reading::Reading;
use crate::system::Description;
use errors::ROUNDING;
use interpolation::Interpolation;
pub(super) use interpolation::Located;

/// Coefficients this much smaller than all together can still be told from 0.
pub(super) const CLEAR: f64 = 1e-10;

/// A guard that turns in a step comes close to zero where it has this share of what it was before.
const NEAR: f64 = 1e-2;

/// A guard over a step.
#[derive(Clone, Copy, Debug)]
struct GuardPolynomial {
    guard: Guard,
    /// What it is made of, where that does not change along the mode.
    linear: Option<Linear>,
    /// Sums of its coefficients, with Taylor series.
    sums: Sums,
    /// Whether it stays positive for certain.
    stays: bool,
    /// Added to the guard, so that it may fall this far below zero.
    margin: f64,
}

/// The guards of a mode and what is watched beside, with their polynomials over a step.
#[derive(Clone, Debug, Default)]
pub(super) struct GuardPolynomials {
    /// Stops, marks, guards of the mode.
    list: Vec<GuardPolynomial>,
    /// Those that were watched before.
    before: Vec<GuardPolynomial>,
    /// Guards of undetermined forces that have been met in this mode.
    pub(super) composites: Vec<CompositeGuard>,
    /// Per branch: whether the mode holds it at its border, where its guard is rounding and is not watched.
    pub(super) held: Vec<bool>,
    /// Coefficients of all polynomials, one after the other, `width` of each.
    coefficients: Vec<f64>,
    width: usize,
    /// Length of the step, s.
    length: f64,
    /// Per contact: what its gap changes by when the coordinates change by their sizes, and 1 at least.
    pub(super) extents: Vec<f64>,
    /// What the forces of the mode were made of as it began.
    pub(super) forces: f64,
    /// The momentum of the motion as the mode began, where signs of normal forces are watched.
    pub(super) momentum: f64,
    /// The stops and marks that take part.
    pub(super) stops: Vec<usize>,
    pub(super) marks: Vec<usize>,
    /// Number of terms before the first term of each stop and of each mark.
    first_stop: Vec<usize>,
    first_mark: Vec<usize>,
    watches: Vec<Guard>,
    interpolation: Interpolation,
    /// Roots that were sharpened.
    pub(super) roots: Vec<SharpRoot>,
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
        let mut curves = GuardPolynomials {
            extents: vec![1.0; d.contacts.len()],
            ..Default::default()
        };
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

    /// Watches no guard until some are watched from a mode on.
    pub(super) fn restart(&mut self) {
        self.list.clear();
        self.composites.clear();
        self.held.clear();
    }

    /// Watches these guards of single forces in a mode, and the composite ones, from now on. Positions do not jump: what an open gap may fall below zero by, it
    /// still may.
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
        core::mem::swap(&mut self.list, &mut self.before);
        let before = &self.before;
        let known = |guard| before.iter().find(|known| known.guard == guard);
        let curves = watches
            .chain(guards.filter(moves))
            .chain(composites)
            .map(|guard| GuardPolynomial {
                guard,
                linear: Linear::of(guard, mode, dynamics),
                sums: Sums::UNKNOWN,
                stays: false,
                margin: match guard {
                    Guard::Gap(_) => known(guard).map_or(0.0, |known| known.margin),
                    _ => 0.0,
                },
            });
        self.list.clear();
        self.list.extend(curves);
        self.shape(self.width);
    }

    /// Whether the sign of a normal force is among the guards.
    pub(super) fn watch_signs_of_normal_forces(&self) -> bool {
        let mut guards = self.list.iter().map(|curve| curve.guard);
        guards.any(|guard| matches!(guard, Guard::NormalForceSign(_)))
    }

    /// The same in a mode that goes on: what may fall below zero still may, and what is known of guards over the step at hand is kept. Whether
    /// others are watched than before.
    pub(super) fn rearm<T: Scalar>(
        &mut self,
        guards: impl Iterator<Item = Guard>,
        mode: &Mode,
        dynamics: &Dynamics<T>,
    ) -> bool {
        let before = core::mem::take(&mut self.list);
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
        let guards = self.list.iter().map(|curve| curve.guard);
        guards.ne(before.iter().map(|curve| curve.guard))
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

    /// A guard of the mode where the step ends.
    pub(super) fn end_of(&self, guard: Guard) -> Option<f64> {
        self.index_of(guard).map(|index| self.list[index].sums.end)
    }

    fn curve(&self, index: usize) -> &[f64] {
        &self.coefficients[index * self.width..][..self.width]
    }

    /// The terms of the stops and marks that take part, the first guards of all.
    pub(super) fn watches(&self) -> &[Guard] {
        &self.watches
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

    /// Term `k` of stop `i` where the step ends.
    pub(super) fn stop_end(&self, i: usize, k: usize) -> f64 {
        self.list[self.first_stop[i] + k].sums.end
    }

    /// Term `k` of mark `i` where the step ends.
    pub(super) fn mark_end(&self, i: usize, k: usize) -> f64 {
        self.list[self.first_mark[i] + k].sums.end
    }

    /// Makes room for curves of `width` coefficients.
    fn shape(&mut self, width: usize) {
        self.width = width;
        self.coefficients.resize(self.list.len() * width, 0.0);
    }

    /// Takes the guards from the series that `dynamics` holds; `powers` are the powers of the step length, h⁰ … hᵖ.
    #[inline(never)]
    pub(super) fn take_series<T: Scalar>(
        &mut self,
        dynamics: &Dynamics<T>,
        mode: &Mode,
        powers: &[f64],
    ) {
        self.shape(powers.len());
        self.roots.clear();
        self.length = powers.get(1).copied().unwrap_or(0.0);
        if !self.list.is_empty() {
            side_by_side::<FromSeries, _>((self, dynamics, mode, powers));
        }
    }

    /// Whether roots were sharpened: of interpolations all, of Taylor polynomials where they are less exact than rounding.
    pub(super) fn are_sharpened(&self) -> bool {
        !self.roots.is_empty()
    }

    /// Lets a guard of the mode fall below zero by `margin`, of gaps in units of their extents, until [`Self::raise`] finds it clear of zero.
    pub(super) fn lower(&mut self, guard: Guard, margin: f64) {
        let extent = match guard {
            Guard::Gap(c) => self.extents[c],
            _ => 1.0,
        };
        for curve in self.list.iter_mut().filter(|curve| curve.guard == guard) {
            curve.margin = margin * extent;
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
        for index in 0..self.list.len() {
            let margin = self.list[index].margin;
            if margin > 0.0 && at(self.curve(index), end) > 2.0 * margin {
                self.list[index].margin = 0.0;
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
            // One that was located by the forces falls whatever its polynomial is.
            let located = match curve.guard {
                Guard::Composite(k) => self.composites[k].falls_after.is_some(),
                _ => false,
            };
            let stays = c.is_empty() || c[0] > 0.0 && keeps_its_sign(c, rest, CLEAR);
            curve.stays = stays && !located;
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
        let mut of_mode = self.list.iter().skip(first);
        let found = of_mode.position(|c| c.guard == guard)?;
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

    /// A guard whose polynomial has a coefficient that is not finite.
    pub(super) fn without_series(&self) -> Option<Guard> {
        let coefficients = self.coefficients.chunks_exact(self.width.max(1));
        let mut curves = self.list.iter().zip(coefficients);
        let found = curves.find(|(_, c)| c.iter().any(|c| !c.is_finite()));
        found.map(|(curve, _)| curve.guard)
    }

    /// Makes the guards stay what they are at the start of the step. The first that must not be what it is in the values that
    /// `dynamics` holds: infinite or no number, or, of a gap or a branch, below zero; with what it was and is.
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
            let guard = self.list[index].guard;
            let rounding = self.rounding(value.abs(), guard, dynamics);
            let curve = &mut self.coefficients[index * self.width..][..self.width];
            curve[1..].fill(0.0);
            let one_sided = matches!(guard, Guard::Gap(_) | Guard::Branch(_));
            let falls = value < -rounding && curve[0] >= 0.0;
            if !value.is_finite() || one_sided && falls {
                broken = broken.or(Some((guard, curve[0], value)));
            }
        }
        broken
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
}
