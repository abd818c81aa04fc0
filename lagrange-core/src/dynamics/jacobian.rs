//! How the accelerations change with the state, for implicit methods.
//!
//! From K w = b, with w = (u̇, −λ) already known: K ∂w = ∂b − ∂K w, so the factors of the value serve every column.

use super::shape::{Extent, MOTION, SYSTEM};
use super::{Dynamics, Equations, EvaluationError};
use crate::arithmetic::{Dual, Scalar};

/// Columns per run of the program: two registers of derivatives beside the value.
const LANES: usize = 4;

/// What the program runs on.
pub(crate) type Lanes<T> = Dual<T, LANES>;

impl<T: Scalar> Dynamics<T> {
    /// ∂v̇/∂(q, v) at (t, q, v) in the present mode, written to `columns`: n columns for q, then n for v, of n elements
    /// each. The values of the state are evaluated on the way ([`Self::value`]).
    ///
    /// # Errors
    /// The same as [`Self::value`].
    pub fn jacobian(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        columns: &mut [T],
    ) -> Result<(), EvaluationError> {
        // The columns are solved for with the factors that the interpreter leaves.
        let equations = core::mem::replace(&mut self.equations, Equations::Interpreted);
        let outcome = self.value(t, q, v);
        self.equations = equations;
        outcome?;
        let n = self.description().coordinates.len();
        let known = core::mem::take(&mut self.solution);
        let mut outcome = Ok(());
        for first in (0..2 * n).step_by(LANES) {
            self.run_derivative(first);
            for lane in 0..LANES.min(2 * n - first) {
                self.differentiate_right(lane, &known);
                let compiled = &mut self.modes[self.current];
                compiled.solver.solve(&mut self.right);
                if let Some(unknown) = self.right.iter().position(|x| !x.value().is_finite()) {
                    outcome = outcome.and(Err(self.not_finite(unknown)));
                }
                let elimination = &self.compiled().pattern.elimination;
                for (j, element) in columns[(first + lane) * n..].iter_mut().take(n).enumerate() {
                    *element = elimination.acceleration(j, &self.right);
                }
            }
        }
        self.solution = known;
        outcome
    }

    /// The motion program and the right-hand sides with seeds on inputs `first`, `first` + 1, … of (q, v).
    fn run_derivative(&mut self, first: usize) {
        let (_, _, interpreted) = self.modes[self.current].parts();
        let shape = &interpreted.shape;
        self.lanes.resize(shape.registers, Dual::default());
        let registers = interpreted.registers[..shape.used].iter();
        for (lanes, &x) in self.lanes.iter_mut().zip(registers) {
            *lanes = Dual::constant(x);
        }
        let last = (first + LANES).min(2 * self.description.coordinates.len());
        for (lane, input) in (first..last).enumerate() {
            let register = &mut self.lanes[2 + input];
            *register = Dual::variable(register.value, lane);
        }
        let program = shape.program(Extent::Accelerations);
        program.evaluate(MOTION, &mut self.lanes);
        program.evaluate(SYSTEM, &mut self.lanes);
    }

    /// ∂b − ∂K w
    fn differentiate_right(&mut self, lane: usize, known: &[T]) {
        let Self {
            modes,
            current,
            right,
            lanes,
            ..
        } = self;
        let (pattern, _, interpreted) = modes[*current].parts();
        let shape = &interpreted.shape;
        let sides = shape.right.iter();
        right.clear();
        right.extend(sides.map(|register| lanes[register.index()].derivative[lane]));
        for entry in &pattern.entries {
            let element = lanes[shape.nodes[entry.node].index()];
            right[entry.row] -= element.derivative[lane] * known[entry.column];
        }
    }
}
