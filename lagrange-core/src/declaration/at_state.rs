//! An evaluator with room for the state that it is given.

use super::{Declaration, Evaluator, Inputs, Real};

/// Values that need no forces, and a state.
#[derive(Debug)]
pub(crate) struct AtState<N = f64> {
    pub(crate) evaluator: Evaluator<N>,
    pub(crate) q: Vec<N>,
    pub(crate) v: Vec<N>,
    pub(crate) acceleration: Vec<N>,
}

impl<N: Real> AtState<N> {
    /// Room for these values with these parameters, and for a state of so many coordinates.
    pub(crate) fn new(
        declaration: &'static Declaration,
        parameters: &[f64],
        values: impl IntoIterator<Item = usize>,
        coordinates: usize,
    ) -> Self {
        let state = vec![N::default(); coordinates];
        Self {
            evaluator: Evaluator::new(declaration, parameters, values),
            q: state.clone(),
            v: state.clone(),
            acceleration: state,
        }
    }

    /// Evaluates the values at the state, at this time.
    pub(crate) fn evaluate(&mut self, time: N) {
        self.evaluator.evaluate(Inputs {
            time,
            q: &self.q,
            v: &self.v,
            acceleration: &self.acceleration,
            forces: &[],
            loads: &[],
        });
    }
}
