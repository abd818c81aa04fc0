//! States, and what is kept of them.

use crate::handle::StartId;
use crate::system::System;

/// Positions and velocities.
#[derive(Debug, PartialEq, Default)]
pub struct State<T> {
    /// q, one per coordinate.
    pub q: Vec<T>,
    /// v = dq/dt.
    pub v: Vec<T>,
}

impl<T: Clone> Clone for State<T> {
    fn clone(&self) -> Self {
        Self {
            q: self.q.clone(),
            v: self.v.clone(),
        }
    }

    // Into memory that is there already.
    fn clone_from(&mut self, source: &Self) {
        self.q.clone_from(&source.q);
        self.v.clone_from(&source.v);
    }
}

/// Named starts as states.
pub trait Starts: System {
    /// The state of a named start at time 0.
    fn at(&self, start: StartId) -> State<Self::Scalar> {
        let n = self.description().coordinates.len();
        let zero = Self::Scalar::default();
        let mut state = State {
            q: vec![zero; n],
            v: vec![zero; n],
        };
        System::start(self, start.0, zero, &mut state.q, &mut state.v);
        state
    }
}

impl<S: System> Starts for S {}

/// Which values a consistent state must keep exactly.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FixedComponents {
    /// Per coordinate: keep its position.
    pub positions: Vec<bool>,
    /// Per coordinate: keep its velocity.
    pub velocities: Vec<bool>,
}
