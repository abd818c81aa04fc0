//! The value reading: accelerations and forces at one state.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Scalar, Value};
use crate::system::{Held, Place, System};

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
        self.assemble();
        self.solver.factor().map_err(|e| self.solve_error(e))?;
        self.right.clear();
        self.right.resize(self.plan.size(), S::Scalar::default());
        for &(row, sign, place) in &self.plan.loads {
            let load = sign * self.motion(place);
            self.right[row] += load;
        }
        self.solution.clear();
        self.solution.extend_from_slice(&self.right);
        self.solver.solve(&mut self.solution);
        if let Some(unknown) = self.solution.iter().position(|x| !x.value().is_finite()) {
            return Err(self.not_finite(unknown));
        }
        self.solver
            .check_rows_aside(&self.solution, &self.right)
            .map_err(|e| self.solve_error(e))?;
        self.store();
        Ok(())
    }

    /// Runs only the motion tape at (t, q, v), for the needs held: then read [`Self::motion`].
    pub fn tape(&mut self, t: S::Scalar, q: &[S::Scalar], v: &[S::Scalar]) {
        let n = self.plan.coordinates;
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

    fn assemble(&mut self) {
        let size = self.plan.size();
        let matrix = self
            .solver
            .begin(self.plan.coordinates, size, &self.plan.constant);
        for entry in &self.plan.entries {
            matrix[entry.row * size + entry.column] += self.nodes[entry.node];
        }
    }

    /// The solution as inputs of the report.
    fn store(&mut self) {
        let n = self.plan.coordinates;
        self.inputs[1 + 2 * n..1 + 3 * n].copy_from_slice(&self.solution[..n]);
        let forces = 1 + 3 * n;
        for (&row, &x) in self.plan.acting.iter().zip(&self.solution[n..]) {
            self.inputs[forces + row] = -x;
        }
        for slide in &self.plan.slides {
            let factor = match slide.factor {
                Place::Zero => S::Scalar::default(),
                Place::Constant(i) => self.constants[i],
                Place::Node(i) => self.nodes[i],
            };
            self.inputs[forces + slide.row] = slide
                .source
                .map_or(factor, |source| factor * self.inputs[forces + source]);
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
