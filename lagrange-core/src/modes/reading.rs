//! One view on a value or a Taylor series that [`Dynamics`] holds.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::system::{Description, ValueRef};

/// What a [`Dynamics`] has evaluated last: numbers, or Taylor coefficients.
#[derive(Debug)]
pub enum Reading<'a, T: Scalar> {
    /// The numbers of the last [`Dynamics::value`].
    Values(&'a Dynamics<T>),
    /// The coefficients of the last [`Dynamics::series`].
    Series(&'a Dynamics<T>),
}

/// Coefficients of one quantity; a number is a series of length one.
#[derive(Clone, Copy, Debug)]
pub enum Terms<'a, T> {
    /// A number.
    One(T),
    /// A series.
    Many(&'a [T]),
}

impl<T: Scalar> Terms<'_, T> {
    /// The number, or the first coefficient.
    #[inline]
    pub fn first(&self) -> T {
        self.as_slice().first().copied().unwrap_or_default()
    }

    /// The coefficients, lowest order first.
    pub fn as_slice(&self) -> &[T] {
        match self {
            Terms::One(x) => core::slice::from_ref(x),
            Terms::Many(series) => series,
        }
    }
}

impl<'a, T: Scalar> Reading<'a, T> {
    /// What is read.
    #[inline]
    pub fn dynamics(&self) -> &'a Dynamics<T> {
        let (Reading::Values(dynamics) | Reading::Series(dynamics)) = self;
        dynamics
    }

    /// The table of names and places of the system.
    #[inline]
    pub fn description(&self) -> &'static Description {
        self.dynamics().description()
    }

    /// A number of the motion tape.
    #[inline]
    pub fn motion(&self, place: ValueRef) -> Terms<'a, T> {
        match self {
            Reading::Series(dynamics) if place.varies() => {
                Terms::Many(dynamics.motion_series(place))
            }
            _ => Terms::One(self.dynamics().motion(place)),
        }
    }

    /// A number of the report tape.
    #[inline]
    pub fn report(&self, place: ValueRef) -> Terms<'a, T> {
        match self {
            Reading::Series(dynamics) if place.varies() => {
                Terms::Many(dynamics.report_series(place))
            }
            _ => Terms::One(self.dynamics().report(place)),
        }
    }

    /// Where the slip of friction `f` with two components points at the start of the step.
    pub fn slip_direction(&self, f: usize) -> [T; 2] {
        self.dynamics().slip_direction(f)
    }

    /// The direction of the forces that press together, at the start of the step.
    pub fn resultant_direction(&self, i: usize) -> [T; 3] {
        self.dynamics().resultant_direction(i)
    }

    /// The force of a row.
    #[inline]
    pub fn force(&self, row: usize) -> Terms<'a, T> {
        match self {
            Reading::Values(dynamics) => Terms::One(dynamics.force(row)),
            Reading::Series(dynamics) => Terms::Many(dynamics.force_series(row)),
        }
    }
}
