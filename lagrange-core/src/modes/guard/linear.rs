//! Guards that are one reading times a number, or the sum of two: nearly all, and those of every step.

use super::Guard;
use super::coefficients::{add, scale};
use crate::arithmetic::Scalar;
use crate::arithmetic::quad::{Quad, values};
use crate::dynamics::Dynamics;
use crate::integrate::polynomial_sum;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::reading::{Reading, Terms};
use crate::system::{Normal, ValueRef};

/// What a guard is made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// A number of the motion tape.
    Motion(ValueRef),
    /// A number of the report tape.
    Report(ValueRef),
    /// The force of a row.
    Force(usize),
}

impl Source {
    #[inline]
    pub(super) fn read<'a, T: Scalar>(self, reading: &Reading<'a, T>) -> Terms<'a, T> {
        match self {
            Source::Motion(place) => reading.motion(place),
            Source::Report(place) => reading.report(place),
            Source::Force(row) => reading.force(row),
        }
    }

    /// The number, or the first coefficient.
    #[inline(always)]
    fn first<T: Scalar>(self, reading: &Reading<T>) -> T {
        match (self, reading) {
            (Source::Motion(place), Reading::Values(dynamics)) => dynamics.motion(place),
            (Source::Report(place), Reading::Values(dynamics)) => dynamics.report(place),
            (Source::Force(row), Reading::Values(dynamics)) => dynamics.force(row),
            (_, Reading::Series(_)) => self.read(reading).first(),
        }
    }
}

/// A guard that is one reading times a number, or the sum of two, as long as mode and parameters are what they are.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    first: (f64, Source),
    second: Option<(f64, Source)>,
}

impl Linear {
    /// `None` for guards with products of readings in them, or with a direction that turns.
    pub fn of<T: Scalar>(guard: Guard, mode: &Mode, dynamics: &Dynamics<T>) -> Option<Self> {
        let d = dynamics.description();
        let motion =
            |place: Option<ValueRef>| (1.0, Source::Motion(place.unwrap_or(ValueRef::Zero)));
        let first = match guard {
            Guard::Gap(c) => motion(d.rows[d.contacts[c].row].position),
            Guard::Normal(c) => (1.0, Source::Force(d.contacts[c].row)),
            Guard::Region(c) => motion(d.contacts[c].region),
            Guard::StickUpper(f) | Guard::StickLower(f) => linear_limit(f, dynamics)?,
            Guard::Slip(f) => match mode.frictions[f] {
                FrictionMode::Slip(Sliding {
                    direction: Direction::Fixed([sign, 0.0]),
                    ..
                }) => (sign, Source::Motion(d.rows[d.frictions[f].row].velocity)),
                _ => return None,
            },
            Guard::Branch(b) => {
                let branch = &d.branches[b];
                let sign = if mode.branch(b) { 1.0 } else { -1.0 };
                let source = match branch.after_solve {
                    true => Source::Report(branch.guard),
                    false => Source::Motion(branch.guard),
                };
                (sign, source)
            }
            Guard::Stop(i, k) => (1.0, Source::Report(d.stops[i].terms[k])),
            Guard::Mark(i, k) => (1.0, Source::Report(d.marks[i].terms[k])),
            Guard::StickCone(_) | Guard::NormalForceSign(_) | Guard::Composite(_) => return None,
        };
        let second = match guard {
            Guard::StickUpper(f) => Some((-1.0, Source::Force(d.frictions[f].row))),
            Guard::StickLower(f) => Some((1.0, Source::Force(d.frictions[f].row))),
            _ => None,
        };
        Some(Self { first, second })
    }

    /// See [`series`].
    #[inline(always)]
    pub fn series<T: Scalar, Q: Quad>(
        &self,
        quad: Q,
        reading: &Reading<T>,
        powers: &[f64],
        out: &mut [f64],
    ) -> Sums {
        let (a, x) = self.first;
        let second = self.second.map(|(b, y)| (b, y.read(reading)));
        match (x.read(reading), second) {
            (Terms::Many(x), None) => combine::<T, Q, false>(quad, out, (a, x), (0.0, x), powers),
            (Terms::Many(x), Some((b, Terms::Many(y)))) => {
                combine::<T, Q, true>(quad, out, (a, x), (b, y), powers)
            }
            (x, second) => {
                out.fill(0.0);
                add(out, (a, x));
                second.into_iter().for_each(|part| add(out, part));
                scale(out, powers);
                Sums::of(out)
            }
        }
    }

    /// See [`value`].
    #[inline]
    pub fn value<T: Scalar>(&self, reading: &Reading<T>) -> f64 {
        let (a, x) = self.first;
        let first = a * x.first(reading).value();
        match self.second {
            None => first,
            Some((b, y)) => first + b * y.first(reading).value(),
        }
    }
}

/// Sums of the coefficients of a guard.
#[derive(Clone, Copy, Debug)]
pub struct Sums {
    /// Σ cₖ: the guard at the end of the step.
    pub end: f64,
    /// Σ |cₖ| without the first two.
    pub rest: f64,
}

impl Sums {
    /// Of coefficients that nobody has added up: of such a guard nothing is certain.
    pub const UNKNOWN: Self = Self {
        end: 0.0,
        rest: f64::INFINITY,
    };

    /// Of these coefficients.
    pub fn of(c: &[f64]) -> Self {
        Self {
            end: polynomial_sum(c),
            rest: c.iter().skip(2).map(|c| c.abs()).sum(),
        }
    }
}

/// (a xₖ + b yₖ) pₖ, the second term only if there are `TWO`.
#[inline(always)]
fn combine<T: Scalar, Q: Quad, const TWO: bool>(
    quad: Q,
    out: &mut [f64],
    (a, x): (f64, &[T]),
    (b, y): (f64, &[T]),
    powers: &[f64],
) -> Sums {
    let count = out.len();
    let (out, out_end) = out.as_chunks_mut::<4>();
    let (x, x_end) = x[..count].as_chunks::<4>();
    let (y, y_end) = y[..count].as_chunks::<4>();
    let (p, p_end) = powers[..count].as_chunks::<4>();
    let (mut sums, mut sizes) = (quad.splat(0.0), quad.splat(0.0));
    let mut i = out.len();
    while i > 0 {
        i -= 1;
        let mut c = quad.product(quad.splat(a), quad.four(values(x[i])));
        if TWO {
            c = quad.sum(c, quad.product(quad.splat(b), quad.four(values(y[i]))));
        }
        c = quad.product(c, quad.four(p[i]));
        out[i] = quad.numbers(c);
        if i > 0 {
            sums = quad.sum(sums, c);
            sizes = quad.sum(sizes, quad.magnitudes(c));
        }
    }
    let (mut end, mut rest) = (quad.total(sums), quad.total(sizes));
    let mut i = out_end.len();
    while i > 0 {
        i -= 1;
        let mut c = a * x_end[i].value();
        if TWO {
            c += b * y_end[i].value();
        }
        out_end[i] = c * p_end[i];
        end += out_end[i];
        if i > 1 || !out.is_empty() {
            rest += out_end[i].abs();
        }
    }
    if let Some(&[c0, c1, c2, c3]) = out.first() {
        end = end + (c2 + c3) + c1 + c0;
        rest += c2.abs() + c3.abs();
    }
    Sums { end, rest }
}

/// μs N, if it is one reading times a number.
pub(super) fn linear_limit<T: Scalar>(f: usize, dynamics: &Dynamics<T>) -> Option<(f64, Source)> {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    match (friction.normal, friction.static_coefficient) {
        (_, ValueRef::Node(_)) => None,
        (Normal::Contact(c), coefficient) if d.contacts[c].normal_factor.is_none() => {
            let coefficient = dynamics.motion(coefficient).value();
            Some((coefficient, Source::Force(d.contacts[c].row)))
        }
        _ => None,
    }
}
