//! One view on a value or a Taylor series that [`Dynamics`] holds.

use crate::dynamics::Dynamics;
use crate::system::{Place, System};

/// What a [`Dynamics`] has evaluated last: numbers, or Taylor coefficients.
#[derive(Debug)]
pub enum Reading<'a, S: System> {
    /// Of [`Dynamics::value`].
    Values(&'a Dynamics<S>),
    /// Of [`Dynamics::series`].
    Series(&'a Dynamics<S>),
}

/// Coefficients of one quantity; a number is a series of length one.
#[derive(Clone, Copy, Debug)]
pub enum Terms<'a, T> {
    /// A number.
    One(T),
    /// A series.
    Many(&'a [T]),
}

impl<T> Terms<'_, T> {
    /// The coefficients, lowest order first.
    pub fn as_slice(&self) -> &[T] {
        match self {
            Terms::One(x) => core::slice::from_ref(x),
            Terms::Many(series) => series,
        }
    }
}

impl<S: System> Reading<'_, S> {
    /// A number of the motion tape.
    pub fn motion(&self, place: Place) -> Terms<'_, S::Scalar> {
        match (self, place) {
            (Reading::Series(dynamics), Place::Node(_)) => {
                Terms::Many(dynamics.motion_series(place))
            }
            (Reading::Values(dynamics) | Reading::Series(dynamics), _) => {
                Terms::One(dynamics.motion(place))
            }
        }
    }

    /// A number of the report tape.
    pub fn report(&self, place: Place) -> Terms<'_, S::Scalar> {
        match (self, place) {
            (Reading::Series(dynamics), Place::Node(_)) => {
                Terms::Many(dynamics.report_series(place))
            }
            (Reading::Values(dynamics) | Reading::Series(dynamics), _) => {
                Terms::One(dynamics.report(place))
            }
        }
    }

    /// Where the slip of friction `f` with two components points at the start of the step.
    pub fn heading(&self, f: usize) -> [S::Scalar; 2] {
        let (Reading::Values(dynamics) | Reading::Series(dynamics)) = self;
        dynamics.heading(f)
    }

    /// The force of a row.
    pub fn force(&self, row: usize) -> Terms<'_, S::Scalar> {
        match self {
            Reading::Values(dynamics) => Terms::One(dynamics.force(row)),
            Reading::Series(dynamics) => Terms::Many(dynamics.force_series(row)),
        }
    }
}
