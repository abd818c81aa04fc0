//! States, and what is kept of them.

use crate::error::Error;
use crate::handle::{CoordinateId, StartId, named, named_mut};
use crate::system::{Coordinate, Description, System};
use core::fmt;
use nalgebra::{DVectorView, Scalar};

/// Positions and velocities, made by [`Starts::at`] or [`Starts::state`] and changed by name: `wheel.state().with_q(Wheel::THETA, 0.1)`.
#[derive(Default)]
pub struct State<T = f64> {
    /// q, one per coordinate.
    pub q: Vec<T>,
    /// v = dq/dt.
    pub v: Vec<T>,
    /// What the numbers belong to; empty if that is not known.
    coordinates: &'static [Coordinate],
}

impl<T> State<T> {
    /// Of code that knows no names: positions and velocities in the order of the declaration.
    pub fn new(q: Vec<T>, v: Vec<T>) -> Self {
        let coordinates = &[];
        Self { q, v, coordinates }
    }

    /// Calls its numbers by the names of a system.
    pub(crate) fn name(&mut self, description: &'static Description) {
        self.coordinates = description.coordinates;
    }

    /// The same with another position of a coordinate.
    #[must_use]
    #[track_caller]
    pub fn with_q(mut self, coordinate: CoordinateId, q: T) -> Self {
        *named_mut(&mut self.q, coordinate.0, "coordinate") = q;
        self
    }

    /// The same with another velocity of a coordinate.
    #[must_use]
    #[track_caller]
    pub fn with_v(mut self, coordinate: CoordinateId, v: T) -> Self {
        *named_mut(&mut self.v, coordinate.0, "coordinate") = v;
        self
    }
}

impl<T> State<T> {
    /// Whether there are so many numbers of each kind.
    ///
    /// # Errors
    /// [`Error::Dimension`] if not.
    pub(crate) fn check_dimension(&self, coordinates: usize) -> Result<(), Error> {
        let mut lengths = [self.q.len(), self.v.len()].into_iter();
        match lengths.find(|&found| found != coordinates) {
            Some(found) => Err(Error::Dimension {
                expected: coordinates,
                found,
            }),
            None => Ok(()),
        }
    }
}

impl<T: Copy> State<T> {
    /// Position of a coordinate.
    #[track_caller]
    pub fn q(&self, coordinate: CoordinateId) -> T {
        *named(&self.q, coordinate.0, "coordinate")
    }

    /// Velocity of a coordinate.
    #[track_caller]
    pub fn v(&self, coordinate: CoordinateId) -> T {
        *named(&self.v, coordinate.0, "coordinate")
    }
}

impl<T: Scalar> State<T> {
    /// The positions as a vector of nalgebra.
    pub fn positions(&self) -> DVectorView<'_, T> {
        DVectorView::from_slice(&self.q, self.q.len())
    }

    /// The velocities as a vector of nalgebra.
    pub fn velocities(&self) -> DVectorView<'_, T> {
        DVectorView::from_slice(&self.v, self.v.len())
    }
}

impl<T: crate::arithmetic::Scalar> State<T> {
    /// Without derivatives and names.
    pub(crate) fn values(&self) -> State {
        let values = |list: &[T]| list.iter().map(|x| x.value()).collect();
        State::new(values(&self.q), values(&self.v))
    }
}

impl<T: Clone> Clone for State<T> {
    fn clone(&self) -> Self {
        Self {
            q: self.q.clone(),
            v: self.v.clone(),
            coordinates: self.coordinates,
        }
    }

    // Into memory that is there already.
    fn clone_from(&mut self, source: &Self) {
        self.q.clone_from(&source.q);
        self.v.clone_from(&source.v);
        self.coordinates = source.coordinates;
    }
}

impl<T: PartialEq> PartialEq for State<T> {
    fn eq(&self, other: &Self) -> bool {
        (&self.q, &self.v) == (&other.q, &other.v)
    }
}

/// `State { theta: 0.1, der(theta): 0.0 }`, or the lists `q` and `v` where names are not known.
impl<T: fmt::Debug> fmt::Debug for State<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut state = f.debug_struct("State");
        if self.coordinates.len() != self.q.len() || self.coordinates.len() != self.v.len() {
            state.field("q", &self.q).field("v", &self.v);
            return state.finish();
        }
        for (coordinate, q) in self.coordinates.iter().zip(&self.q) {
            state.field(coordinate.name, q);
        }
        for (coordinate, v) in self.coordinates.iter().zip(&self.v) {
            state.field(&format!("der({})", coordinate.name), v);
        }
        state.finish()
    }
}

/// The states that a system can start from.
pub trait Starts: System {
    /// The state of a named start at time 0.
    #[track_caller]
    fn at(&self, start: StartId) -> State<Self::Scalar> {
        named(self.description().starts, start.0, "start");
        let mut state = self.state();
        let zero = Self::Scalar::default();
        System::start(self, start.0, zero, &mut state.q, &mut state.v);
        state
    }

    /// All positions and velocities 0, to be changed by [`State::with_q`] and [`State::with_v`].
    fn state(&self) -> State<Self::Scalar> {
        let zeros = vec![Self::Scalar::default(); self.description().coordinates.len()];
        let mut state = State::new(zeros.clone(), zeros);
        state.name(self.description());
        state
    }
}

impl<S: System> Starts for S {}

/// Values that a consistent state must have exactly: `FixedComponents::default().q(Pendulum::X, 0.6).v(Pendulum::Y, 0.0)`.
#[derive(Clone, Debug, PartialEq)]
pub struct FixedComponents<T = f64> {
    positions: Vec<(CoordinateId, T)>,
    velocities: Vec<(CoordinateId, T)>,
}

impl<T> Default for FixedComponents<T> {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            velocities: Vec::new(),
        }
    }
}

impl<T: Copy> FixedComponents<T> {
    /// With this position of a coordinate.
    #[must_use]
    pub fn q(mut self, coordinate: CoordinateId, q: T) -> Self {
        self.positions.push((coordinate, q));
        self
    }

    /// With this velocity of a coordinate.
    #[must_use]
    pub fn v(mut self, coordinate: CoordinateId, v: T) -> Self {
        self.velocities.push((coordinate, v));
        self
    }

    /// Writes the values into a state, and says per coordinate whether its position, and whether its velocity is fixed.
    ///
    /// # Errors
    /// [`Error::Argument`] for a coordinate that the system does not have.
    pub(crate) fn write(&self, state: &mut State<T>) -> Result<[Vec<bool>; 2], Error> {
        let positions = write(&self.positions, &mut state.q)?;
        let velocities = write(&self.velocities, &mut state.v)?;
        Ok([positions, velocities])
    }
}

/// Writes `values` among `numbers`, and says which of these they are.
fn write<T: Copy>(values: &[(CoordinateId, T)], numbers: &mut [T]) -> Result<Vec<bool>, Error> {
    let mut fixed = vec![false; numbers.len()];
    for &(CoordinateId(i), value) in values {
        let (Some(number), Some(is_fixed)) = (numbers.get_mut(i), fixed.get_mut(i)) else {
            return Err(Error::Argument {
                what: "index of the coordinate that is fixed",
                value: i as f64,
                expected: "less than this system has coordinates; the handle is one of another system",
            });
        };
        (*number, *is_fixed) = (value, true);
    }
    Ok(fixed)
}
