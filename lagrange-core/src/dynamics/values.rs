//! The value reading: accelerations and forces at one state.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Scalar, Value};
use crate::linear::Inertia;
use crate::system::{Held, Place, System};

/// A sum below this share of its terms is the rounding of a sum that is zero.
const CANCELLED: f64 = 1e-13;

impl<S: System> Dynamics<S> {
    /// Accelerations and forces at (t, q, v): then read [`Self::acceleration`], [`Self::force`], [`Self::motion`].
    ///
    /// `q` and `v` have one element per coordinate.
    pub fn value(
        &mut self,
        t: S::Scalar,
        q: &[S::Scalar],
        v: &[S::Scalar],
    ) -> Result<(), EvaluationError> {
        self.work.values += 1;
        self.tape(t, q, v);
        self.plan
            .program
            .run(&mut Value::new(), &self.constants, &mut self.nodes);
        let nodes = core::mem::take(&mut self.nodes);
        let outcome = self.factor(|node| nodes[node]);
        self.nodes = nodes;
        outcome?;
        self.right.copy_from_slice(&self.plan.constant_load);
        for load in &self.plan.loads {
            self.right[load.row] += load.factor * self.nodes[load.node];
        }
        self.solve()?;
        self.check_rows_aside()?;
        self.store();
        Ok(())
    }

    /// Factors the system whose changing numbers are `node(index)`.
    pub(super) fn factor(
        &mut self,
        node: impl Fn(usize) -> S::Scalar,
    ) -> Result<(), EvaluationError> {
        if self.factored && self.plan.entries.is_empty() {
            return Ok(());
        }
        let (free, size) = (self.plan.free(), self.plan.size());
        let matrix = self
            .solver
            .begin(free, size, &self.plan.constant[..size * size]);
        for entry in &self.plan.entries {
            matrix[entry.row * size + entry.column] += node(entry.node);
        }
        // A kept row that follows from the eliminated ones leaves rounding behind: that is a zero.
        let constants = &self.constants;
        let read = |place: Place| match place {
            Place::Zero => S::Scalar::default(),
            Place::Constant(i) => constants[i],
            Place::Node(i) => node(i),
        };
        for (row, terms) in self.plan.cancelled(read) {
            let row = &mut matrix[row * size..row * size + free];
            if row.iter().all(|x| x.value().abs() <= CANCELLED * terms) {
                row.fill(S::Scalar::default());
            }
        }
        let inertia = if self.plan.elimination.symmetric {
            Inertia::Symmetric
        } else {
            Inertia::General
        };
        self.factored = false;
        self.solver
            .factor(inertia)
            .map_err(|e| self.solve_error(e))?;
        self.factored = true;
        Ok(())
    }

    /// The solution of the equations with the right-hand side `right`.
    #[inline]
    pub(super) fn solve(&mut self) -> Result<(), EvaluationError> {
        let equations = &self.right[..self.plan.size()];
        self.solution.copy_from_slice(equations);
        self.solver.solve(&mut self.solution);
        match self.solution.iter().position(|x| !x.value().is_finite()) {
            Some(unknown) => Err(self.not_finite(unknown)),
            None => Ok(()),
        }
    }

    /// Whether dependent rows agree with the solution.
    pub(super) fn check_rows_aside(&self) -> Result<(), EvaluationError> {
        self.solver
            .check_rows_aside(&self.solution, &self.right)
            .map_err(|e| self.solve_error(e))
    }

    /// Runs only the motion tape at (t, q, v), for the needs held: then read [`Self::motion`].
    pub fn tape(&mut self, t: S::Scalar, q: &[S::Scalar], v: &[S::Scalar]) {
        let n = S::DESCRIPTION.coordinates.len();
        self.inputs[0] = t;
        self.inputs[1..1 + n].copy_from_slice(q);
        self.inputs[1 + n..1 + 2 * n].copy_from_slice(v);
        let held = Held {
            needs: &self.held,
            branches: &self.mode.branches,
        };
        let mut a = Value::new();
        let outputs = S::DESCRIPTION.motion.outputs;
        self.scene.motion(
            &mut a,
            &held,
            &self.constants,
            &self.inputs[..1 + 2 * n],
            &mut self.nodes[..outputs],
        );
    }

    /// The solution as inputs of the report.
    fn store(&mut self) {
        let Self {
            plan,
            inputs,
            nodes,
            solution,
            right,
            ..
        } = self;
        let n = S::DESCRIPTION.coordinates.len();
        let (accelerations, forces) = inputs[1 + 2 * n..].split_at_mut(n);
        for (j, acceleration) in accelerations.iter_mut().enumerate() {
            *acceleration = plan.elimination.acceleration(j, solution);
        }
        for (&row, &x) in plan.kept.iter().zip(&solution[plan.free()..]) {
            forces[row] = -x;
        }
        let size = plan.size();
        let constant_parts = plan.constant_forces(solution).zip(&right[size..]);
        for (&row, (part, &load)) in plan.eliminated.iter().zip(constant_parts) {
            forces[row] = part - load;
        }
        for entry in &plan.force_entries {
            forces[plan.eliminated[entry.row - size]] += nodes[entry.node] * solution[entry.column];
        }
        for slide in &self.plan.slides {
            let factor = match slide.factor {
                Place::Zero => S::Scalar::default(),
                Place::Constant(i) => self.constants[i],
                Place::Node(i) => nodes[i],
            };
            forces[slide.row] = slide
                .source
                .map_or(factor, |source| factor * forces[source]);
        }
    }

    /// Runs the report tape at the state of the last [`Self::value`], for the needs given to
    /// [`Self::set_report_needs`]: then read [`Self::report`].
    pub fn report_value(&mut self) {
        let held = Held {
            needs: &self.report_held,
            branches: &self.mode.branches,
        };
        self.scene.report(
            &mut Value::new(),
            &held,
            &self.constants,
            &self.inputs,
            &mut self.report_nodes,
        );
    }
}
