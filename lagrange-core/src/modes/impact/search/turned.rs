//! Where [bearings](super::super::bearing) press frictions: the direction of each impulse is looked for.
//!
//! How is told in [`crate::linear::direction`].

use super::super::bearing::Axes;
use super::super::collision::{Collision, NormalSource};
use super::super::pattern::{Pattern, Phase, ROUNDING};
use super::Search;
use crate::arithmetic::{Scalar, rounding};
use crate::linear::direction::{is_along, length, settle};

/// A collision with its bearings turned.
#[derive(Clone, Debug, Default)]
pub(super) struct Turned<T> {
    collision: Collision<T>,
    phase: Phase<T>,
    axes: Vec<Axes<T>>,
}

impl<T: Scalar> Turned<T> {
    fn begin(&mut self, c: &Collision<T>) {
        let mut first = [T::zero(); 3];
        first[0] = T::one();
        self.axes.clear();
        self.axes
            .extend(c.bearings.iter().map(|bearing| bearing.axes(first)));
    }

    /// Turns a collision to the axes; `pressed`: with the frictions that bearings press.
    fn turn(&mut self, c: &Collision<T>, phase: &Phase<T>, pressed: bool) {
        self.collision.clone_from(c);
        self.phase.clone_from(phase);
        let n = c.size;
        for (bearing, axes) in c.bearings.iter().zip(&self.axes) {
            for k in 0..n {
                bearing.turn(axes, &mut self.collision.response[k * n..][..n], 1, false);
            }
            for k in 0..n {
                bearing.turn(axes, &mut self.collision.response[k..], n, false);
            }
            bearing.turn(axes, &mut self.phase.rates, 1, false);
            bearing.turn(axes, &mut self.collision.rates, 1, false);
            let terms = &mut self.collision.terms;
            let largest = bearing.rows().iter().map(|&row| terms[row]);
            let largest = largest.fold(0.0, f64::max);
            bearing.rows().iter().for_each(|&row| terms[row] = largest);
            for rub in &mut self.collision.rubs {
                if rub.bearer == NormalSource::ConstraintRow(bearing.first()) && !pressed {
                    (rub.stick, rub.slide) = (T::zero(), T::zero());
                }
            }
        }
    }

    /// Turns the axes to where the impulses point. Returns how far they did not.
    fn follow(&mut self, found: &Pattern<T>) -> f64 {
        let Self {
            collision: c, axes, ..
        } = self;
        let effort = c.effort(&found.impulses);
        let mut most = 0.0_f64;
        for (bearing, axes) in c.bearings.iter().zip(axes) {
            let turned = bearing.impulse(&found.impulses);
            let size = length(turned.map(|x| T::from_f64(x.value()))).value();
            let strengths = bearing.rows().iter().map(|&row| c.strength(row));
            if !(size * strengths.fold(0.0, f64::max) > rounding::<T>(ROUNDING) * effort) {
                continue;
            }
            let across = length([T::zero(), turned[1], turned[2]].map(|x| T::from_f64(x.value())));
            most = most.max(across.value() / size);
            let long = length(turned);
            let mut u = [T::zero(); 3];
            for (axis, part) in axes.iter().zip(turned) {
                for (u, &x) in u.iter_mut().zip(axis) {
                    *u += part / long * x;
                }
            }
            *axes = bearing.axes(u);
        }
        most
    }
}

impl<T: Scalar> Search<T> {
    /// [`Search::find`] where bearings press frictions.
    pub(super) fn find_turned(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let mut turned = core::mem::take(&mut self.turned);
        let found = self.turn_until_settled(&mut turned, c, phase);
        self.turned = turned;
        found
    }

    fn turn_until_settled(
        &mut self,
        turned: &mut Turned<T>,
        c: &Collision<T>,
        phase: &Phase<T>,
    ) -> bool {
        turned.begin(c);
        // Without these frictions there is a direction to begin with.
        if !self.solve_turned(turned, c, phase, false) {
            return false;
        }
        turned.follow(&self.pattern);
        let mut axes = Vec::new();
        let settled = settle::<T, _>(|| {
            axes.clone_from(&turned.axes);
            let solved = self.solve_turned(turned, c, phase, true);
            solved.then(|| turned.follow(&self.pattern)).ok_or(())
        });
        let found = settled == Ok(true);
        if found {
            self.turn_back(c, &axes);
        }
        found
    }

    /// Solves with the present axes; `pressed`: with the frictions that bearings press.
    fn solve_turned(
        &mut self,
        turned: &mut Turned<T>,
        c: &Collision<T>,
        phase: &Phase<T>,
        pressed: bool,
    ) -> bool {
        turned.turn(c, phase, pressed);
        self.find_straight(&turned.collision, &turned.phase)
    }

    /// Turns what was found back to the rows.
    fn turn_back(&mut self, c: &Collision<T>, axes: &[Axes<T>]) {
        let Self {
            pattern, others, ..
        } = self;
        // Another impact has another direction: what was pressed along this one obeys the law.
        others.retain(|other| {
            c.bearings.iter().all(|bearing| {
                let [along, rest @ ..] = bearing.impulse(&other.impulses);
                let rest = rest.map(|x| x.value().abs());
                is_along(rest[0].max(rest[1]), along.value().abs())
            })
        });
        for found in others.iter_mut().chain([pattern]) {
            for (bearing, axes) in c.bearings.iter().zip(axes) {
                bearing.turn(axes, &mut found.impulses, 1, true);
                bearing.turn(axes, &mut found.after, 1, true);
            }
        }
    }
}
