//! Where a slip of two components begins: ṡ ∥ u, for the friction that points against u.
//!
//! ṡ(u) × u = 0 with ṡ·u > 0. Where the slip begins smoothly (equal coefficients of friction) ṡ vanishes at the answer, but
//! ṡ × u still changes its sign there.

use super::examine::row_acceleration;
use super::{Decider, Moment};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::mode::{Direction, FrictionMode};
use crate::modes::table::Table;
use crate::system::System;
use core::f64::consts::TAU;

/// Directions that are tried for one slip.
const TRIES: usize = 16;
/// Iterations that make a direction exact.
const MOST_ITERATIONS: usize = 60;
/// ṡ·u below this share of the largest ṡ is not positive, nor negative.
const NOTHING: f64 = 1e-6;

/// ṡ in the frame of u: along it and across.
#[derive(Clone, Copy, Debug)]
struct Turn {
    along: f64,
    across: f64,
}

impl<T: Scalar> Decider<T> {
    /// Finds the directions in which the slips of `self.posed` begin, and writes them there. False: there are none.
    ///
    /// Of several the one nearest to that of what made it stick is taken.
    pub(super) fn find_directions<S: System<Scalar = T>>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        table: &mut Table,
        moment: Moment<'_, S::Scalar>,
    ) -> Result<bool, EvaluationError> {
        let beginning: Vec<usize> = self.posed.incipient().map(|(f, _)| f).collect();
        let mut angles = self.against_sticking(dynamics, moment, &beginning);
        self.point(&beginning, &angles);
        dynamics.set_mode(&self.posed);
        dynamics.set_extra_needs(&table.of(dynamics).deciding);
        let found = match *beginning {
            [f] => self.look_around(dynamics, moment, f, &mut angles[0])?,
            _ => settle(dynamics, moment, &beginning, &mut angles)?,
        };
        self.point(&beginning, &angles);
        Ok(found)
    }

    /// Angles against the forces that would keep the slips at zero.
    fn against_sticking<S: System<Scalar = T>>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        moment: Moment<'_, S::Scalar>,
        beginning: &[usize],
    ) -> Vec<f64> {
        let Moment { t, q, v, .. } = moment;
        let sticking = &mut self.decision.mode;
        sticking.clone_from(&self.posed);
        for &f in beginning {
            sticking.frictions[f] = FrictionMode::Stick;
        }
        dynamics.set_mode(sticking);
        let known = dynamics.value(t, q, v).is_ok();
        let angle = |&f: &usize| {
            let row = S::DESCRIPTION.frictions[f].row;
            let [x, y] = [row, row + 1].map(|row| dynamics.force(row).value());
            let angle = (-y).atan2(-x);
            if known && angle.is_finite() {
                angle
            } else {
                0.0
            }
        };
        beginning.iter().map(angle).collect()
    }

    /// Writes directions into the candidate.
    fn point(&mut self, beginning: &[usize], angles: &[f64]) {
        for (&f, angle) in beginning.iter().zip(angles) {
            let along = [angle.cos(), angle.sin()];
            self.posed.turn(f, Direction::Incipient(along));
        }
    }

    /// All directions of one slip: that nearest to `angle`.
    fn look_around<S: System<Scalar = T>>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        moment: Moment<'_, S::Scalar>,
        f: usize,
        angle: &mut f64,
    ) -> Result<bool, EvaluationError> {
        let mut turn = |angle: f64| turn_of(dynamics, moment, f, angle);
        let step = TAU / TRIES as f64;
        // The guess lies within the first interval.
        let first = *angle - 0.5 * step;
        let (mut roots, mut largest) = (Vec::new(), 0.0_f64);
        let mut low = turn(first)?;
        for k in 0..TRIES {
            let from = first + step * k as f64;
            let high = turn(from + step)?;
            largest = largest.max(high.along.abs()).max(high.across.abs());
            if (low.across < 0.0) != (high.across < 0.0) {
                let at = sharpen(&mut turn, (from, low), (from + step, high))?;
                roots.push((at, turn(at)?.along));
            }
            low = high;
        }
        roots.retain(|(_, along)| *along > -NOTHING * largest);
        let far = |at: f64| (at - *angle - TAU * ((at - *angle) / TAU).round()).abs();
        let nearest = roots.iter().min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
        let Some(&(nearest, _)) = nearest else {
            return Ok(false);
        };
        let clear = |(_, along): &&(f64, f64)| *along > NOTHING * largest;
        self.forks = roots.iter().filter(clear).count() > 1;
        *angle = nearest;
        Ok(true)
    }
}

/// ṡ of friction `f` if it begins to slip at an angle.
fn turn_of<S: System>(
    dynamics: &mut Dynamics<S>,
    moment: Moment<'_, S::Scalar>,
    f: usize,
    angle: f64,
) -> Result<Turn, EvaluationError> {
    let (y, x) = angle.sin_cos();
    dynamics.set_heading(f, [x, y].map(S::Scalar::from_f64));
    dynamics.value(moment.t, moment.q, moment.v)?;
    Ok(frame_of(dynamics, f))
}

/// ṡ of friction `f` in the frame of its heading, at the last value.
fn frame_of<S: System>(dynamics: &Dynamics<S>, f: usize) -> Turn {
    let row = S::DESCRIPTION.frictions[f].row;
    let [x, y] = dynamics.heading(f).map(|x| x.value());
    let [a, b] = [row, row + 1].map(|row| row_acceleration(row, dynamics));
    Turn {
        along: a * x + b * y,
        across: a * y - b * x,
    }
}

/// Where `across` vanishes between two angles at which it has different signs (Illinois' variant of regula falsi).
fn sharpen<E>(
    turn: &mut impl FnMut(f64) -> Result<Turn, E>,
    low: (f64, Turn),
    high: (f64, Turn),
) -> Result<f64, E> {
    let ((mut a, fa), (mut b, fb)) = (low, high);
    let (mut fa, mut fb) = (fa.across, fb.across);
    for _ in 0..MOST_ITERATIONS {
        let c = b - fb * (b - a) / (fb - fa);
        let c = if c.is_finite() { c } else { 0.5 * (a + b) };
        let fc = turn(c)?.across;
        if fc == 0.0 {
            return Ok(c);
        }
        if (fc < 0.0) == (fb < 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
        if (b - a).abs() <= f64::EPSILON * (1.0 + b.abs()) {
            break;
        }
    }
    Ok(b)
}

/// The directions of several slips that begin together, by Newton's method from `angles`.
fn settle<S: System>(
    dynamics: &mut Dynamics<S>,
    moment: Moment<'_, S::Scalar>,
    beginning: &[usize],
    angles: &mut [f64],
) -> Result<bool, EvaluationError> {
    /// Step of the differences.
    const SMALL: f64 = 1e-6;
    let m = beginning.len();
    let mut all = |angles: &[f64]| {
        for (&f, angle) in beginning.iter().zip(angles) {
            let (y, x) = angle.sin_cos();
            dynamics.set_heading(f, [x, y].map(S::Scalar::from_f64));
        }
        dynamics.value(moment.t, moment.q, moment.v)?;
        Ok(nalgebra::DVector::from_iterator(
            m,
            beginning.iter().map(|&f| frame_of(dynamics, f).across),
        ))
    };
    for _ in 0..MOST_ITERATIONS {
        let here = all(angles)?;
        let mut jacobian = nalgebra::DMatrix::zeros(m, m);
        for j in 0..m {
            let held = angles[j];
            angles[j] = held + SMALL;
            let moved = all(angles)?;
            angles[j] = held;
            jacobian.set_column(j, &((moved - &here) / SMALL));
        }
        let Some(by) = jacobian.lu().solve(&here) else {
            return Ok(false);
        };
        for (angle, by) in angles.iter_mut().zip(&by) {
            *angle -= by.clamp(-1.0, 1.0);
        }
        if by.amax() <= 4.0 * f64::EPSILON {
            break;
        }
    }
    all(angles)?;
    let along = beginning.iter().map(|&f| frame_of(dynamics, f));
    let turns: Vec<Turn> = along.collect();
    let largest = turns
        .iter()
        .fold(0.0_f64, |m, turn| m.max(turn.along.abs()));
    Ok(turns
        .iter()
        .all(|turn| turn.along >= -NOTHING * largest && turn.across.is_finite()))
}
