//! The derivative reading: how the accelerations change with the state, for implicit methods.
//!
//! From K w = b, with w = (u̇, −λ) already known: K ∂w = ∂b − ∂K w, so the factors of the value serve every column.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Derivative, Dual, Scalar};
use crate::simulation::Equations;
use crate::system::Held;
use crate::tapes::Call;

/// Columns per run of the tape: two registers of derivatives beside the value.
const LANES: usize = 4;

/// Nodes of the derivative reading.
pub(crate) type Lanes<T> = Dual<T, LANES>;

/// The arithmetic of them.
pub(crate) type Seeded<T> = Derivative<T, LANES>;

impl<T: Scalar> Dynamics<T> {
    /// ∂v̇/∂(q, v) at (t, q, v) in the present mode, written to `columns`: n columns for q, then n for v, of n elements
    /// each. The values of the state are evaluated on the way ([`Self::value`]).
    ///
    /// # Errors
    /// Those of [`Self::value`].
    pub fn jacobian(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        columns: &mut [T],
    ) -> Result<(), EvaluationError> {
        // The columns are solved for with the factors that the interpreter leaves.
        let equations = self.equations;
        if equations == Equations::Emitted {
            self.equations = Equations::Interpreted;
        }
        let outcome = self.value(t, q, v);
        self.equations = equations;
        outcome?;
        let n = self.description().coordinates.len();
        let known = self.known_solution()?;
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
                let elimination = &self.compiled().plan.elimination;
                for (j, element) in columns[(first + lane) * n..].iter_mut().take(n).enumerate() {
                    *element = elimination.acceleration(j, &self.right);
                }
            }
        }
        self.solution = known;
        outcome
    }

    /// What the differences of the matrix multiply: the solution of the value. Its factors are made if the tape solved alone.
    fn known_solution(&mut self) -> Result<Vec<T>, EvaluationError> {
        let n = self.description().coordinates.len();
        let compiled = &self.modes[self.current];
        let divides = compiled
            .tape()
            .is_some_and(|tape| tape.shape.unsolved.is_none());
        let mut known = core::mem::take(&mut self.solution);
        if divides {
            let free = compiled.plan.elimination.free.iter();
            known.clear();
            known.extend(free.map(|&j| self.inputs[1 + 2 * n + j]));
            self.factor()?;
        }
        Ok(known)
    }

    /// The motion tape and the plan's program with seeds on inputs `first`, `first` + 1, … of (q, v).
    fn run_derivative(&mut self, first: usize) {
        let d = self.description();
        let inputs = &self.inputs[..1 + 2 * d.coordinates.len()];
        self.lane_inputs.clear();
        self.lane_inputs
            .extend(
                inputs
                    .iter()
                    .enumerate()
                    .map(|(i, &x)| match i.checked_sub(1 + first) {
                        Some(lane) if lane < LANES => Dual::variable(x, lane),
                        _ => Dual::constant(x),
                    }),
            );
        self.lane_nodes.clear();
        let compiled = &self.modes[self.current];
        let nodes = d.motion.outputs + compiled.plan.program.len();
        self.lane_nodes.resize(nodes, Dual::default());
        let held = Held {
            needs: &self.held,
            branches: &compiled.mode.branches,
        };
        for heading in &compiled.plan.headings {
            let along = self.headings.of(heading.friction);
            for (node, x) in heading.nodes.into_iter().zip(along) {
                self.lane_nodes[node] = Dual::constant(x);
            }
        }
        let outputs = &mut self.lane_nodes[..d.motion.outputs];
        self.system.differentiate(Call {
            arithmetic: &mut self.lanes,
            held: &held,
            constants: &compiled.constants,
            inputs: &self.lane_inputs,
            outputs,
        });
        compiled
            .plan
            .program
            .run(&mut self.lanes, &compiled.constants, &mut self.lane_nodes);
    }

    /// ∂b − ∂K w
    fn differentiate_right(&mut self, lane: usize, known: &[T]) {
        let Self {
            modes,
            current,
            right,
            lane_nodes,
            ..
        } = self;
        let plan = &modes[*current].plan;
        right.clear();
        right.resize(plan.size(), T::default());
        // Loads and elements beyond are those of eliminated forces.
        for load in plan.loads.iter().filter(|load| load.row < plan.size()) {
            right[load.row] += load.factor * lane_nodes[load.node].derivative[lane];
        }
        for entry in &plan.entries {
            right[entry.row] -= lane_nodes[entry.node].derivative[lane] * known[entry.column];
        }
    }
}
