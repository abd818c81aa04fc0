//! The value reading: accelerations and forces at one state.

use super::compiled::Compiled;
use super::tape::{FORCES, MOTION};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::Scalar;
use crate::linear::{Inertia, SolveError, epsilon};
use crate::system::{Held, Place};
use crate::tapes::{Call, Which};

/// How much of a tape runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Everything that was asked for.
    Everything,
    /// What the accelerations need.
    Accelerations,
}

impl<T: Scalar> Dynamics<T> {
    /// Accelerations and forces at (t, q, v): then read [`Self::acceleration`], [`Self::force`], [`Self::motion`].
    ///
    /// `q` and `v` have one element per coordinate.
    ///
    /// # Errors
    /// The system is singular there, or a number is not finite.
    pub fn value(&mut self, t: T, q: &[T], v: &[T]) -> Result<(), EvaluationError> {
        self.work.values += 1;
        self.run(t, q, v, Extent::Everything, false)?;
        self.check_accelerations()?;
        let mut inputs = core::mem::take(&mut self.inputs);
        inputs.copy_from_slice(self.results());
        self.inputs = inputs;
        self.tape(t, q, v);
        Ok(())
    }

    /// Motion and forces at (t, q, v), into the registers. `refined`: what rounding leaves in the forces step after step is
    /// taken out.
    #[inline]
    pub(super) fn run(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        extent: Extent,
        refined: bool,
    ) -> Result<(), EvaluationError> {
        if self.choose(q, v) {
            let forces = extent == Extent::Everything;
            let evaluated = self.modes[self.current].emitted(&self.held);
            if evaluated.is_some_and(|(emitted, held)| emitted.value(&held, forces, t, q, v)) {
                return Ok(());
            }
            self.leave_to_solver();
        }
        self.select(v);
        let (_, _, tape) = self.modes[self.current].parts();
        let n = q.len();
        // A step ends with a value and the next begins with a series; where there is nothing to refine that is the same.
        let known = &tape.registers[1..2 + 2 * n];
        if tape.evaluated
            && tape.shape.unsolved.is_none()
            && known[0] == t
            && known[1..=n] == *q
            && known[1 + n..] == *v
        {
            return Ok(());
        }
        tape.evaluated = false;
        tape.registers[1] = t;
        tape.registers[2..2 + n].copy_from_slice(q);
        tape.registers[2 + n..2 + 2 * n].copy_from_slice(v);
        for &(friction, slots, _) in &tape.headings {
            for (slot, along) in slots.into_iter().zip(self.headings.of(friction)) {
                tape.registers[slot.index()] = along;
            }
        }
        tape.evaluate(extent, MOTION);
        if tape.shape.unsolved.is_some() {
            self.solve_start(refined)?;
        } else if !tape
            .pivots
            .iter()
            .all(|pivot| pivot.is_safe(&tape.registers))
        {
            self.leave_to_solver();
            return self.run(t, q, v, extent, refined);
        }
        let (_, _, tape) = self.modes[self.current].parts();
        tape.evaluate(extent, FORCES);
        tape.evaluated = extent == Extent::Everything;
        Ok(())
    }

    /// Accelerations alone at (t, q, v); they stay in the registers.
    #[inline]
    pub(super) fn run_accelerations(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
    ) -> Result<&[T], EvaluationError> {
        self.work.values += 1;
        self.run(t, q, v, Extent::Accelerations, false)?;
        self.check_accelerations()?;
        let n = q.len();
        Ok(&self.results()[1 + 2 * n..1 + 3 * n])
    }

    /// t, q, v, v̇, λ of the last run.
    #[inline]
    fn results(&self) -> &[T] {
        match self.in_use() {
            Some(emitted) => &emitted.state,
            None => {
                let count = self.inputs_len();
                self.compiled()
                    .tape()
                    .map_or(&[], |tape| &tape.registers[1..=count])
            }
        }
    }

    fn inputs_len(&self) -> usize {
        let d = self.description();
        1 + 3 * d.coordinates.len() + d.rows.len()
    }

    /// Leaves the linear systems of the mode to the solver from now on.
    pub(super) fn leave_to_solver(&mut self) {
        self.modes[self.current].leave_to_solver();
        (self.selected, self.by_functions) = (false, false);
    }

    /// Whether all accelerations of the last run are finite.
    #[inline]
    pub(super) fn check_accelerations(&self) -> Result<(), EvaluationError> {
        let n = self.description().coordinates.len();
        let accelerations = &self.results()[1 + 2 * n..1 + 3 * n];
        // The sum of zeros is zero unless one of the factors is not finite.
        let poison = accelerations
            .iter()
            .fold(0.0, |sum, x| sum + 0.0 * x.value());
        if poison == 0.0 {
            return Ok(());
        }
        let bad = accelerations.iter().position(|x| !x.value().is_finite());
        Err(EvaluationError::NotFiniteAcceleration {
            coordinate: bad.unwrap_or(0),
        })
    }

    /// Solves for the unknowns, from values in the registers.
    fn solve_start(&mut self, refined: bool) -> Result<(), EvaluationError> {
        self.factor()?;
        self.fill_right();
        let Self {
            modes,
            current,
            right,
            solution,
            ..
        } = self;
        let (plan, solver, tape) = modes[*current].parts();
        solution.clear();
        solution.extend_from_slice(&right[..plan.size()]);
        solver.solve(solution);
        let outcome = solver.check_rows_aside(solution, right);
        if outcome.is_ok() && refined && plan.size() > plan.free() {
            solver.refine(solution, &mut right[..plan.size()]);
        }
        if let Some(unsolved) = &tape.shape.unsolved {
            for (slot, &x) in unsolved.unknowns.iter().zip(&*solution) {
                tape.registers[slot.index()] = x;
            }
        }
        if let Some(unknown) = solution.iter().position(|x| !x.value().is_finite()) {
            return Err(self.not_finite(unknown));
        }
        outcome.map_err(|e| self.solve_error(e))
    }

    /// Right-hand sides from the registers.
    fn fill_right(&mut self) {
        let (_, _, tape) = self.modes[self.current].parts();
        self.right.clear();
        if let Some(unsolved) = &tape.shape.unsolved {
            let values = unsolved
                .right
                .iter()
                .map(|r| tape.registers[r.slot.index()]);
            self.right.extend(values);
        }
    }

    /// Factors the system whose changing numbers are in the registers.
    pub(super) fn factor(&mut self) -> Result<(), EvaluationError> {
        let compiled = &mut self.modes[self.current];
        if compiled.factored && compiled.plan.entries.is_empty() {
            return Ok(());
        }
        compiled.factored = false;
        self.work.factorizations += 1;
        match factor(compiled) {
            Ok(()) => {
                compiled.factored = true;
                Ok(())
            }
            Err(e) => Err(self.solve_error(e)),
        }
    }

    /// Runs only the motion tape at (t, q, v), for the needs held: then read [`Self::motion`].
    pub fn tape(&mut self, t: T, q: &[T], v: &[T]) {
        let n = self.description().coordinates.len();
        self.inputs[0] = t;
        self.inputs[1..1 + n].copy_from_slice(q);
        self.inputs[1 + n..1 + 2 * n].copy_from_slice(v);
        let compiled = &self.modes[self.current];
        let held = Held {
            needs: &self.held,
            branches: &compiled.mode.branches,
        };
        let call = Call {
            arithmetic: &mut self.plain,
            held: &held,
            constants: &compiled.constants,
            inputs: &self.inputs[..1 + 2 * n],
            outputs: &mut self.nodes,
        };
        self.system.evaluate(Which::Motion, call);
    }

    /// Replaces the forces of all rows that [`Self::force`] and the report tape see until the next [`Self::value`].
    pub(crate) fn replace_forces(&mut self, forces: &[T]) {
        let first = 1 + 3 * self.description().coordinates.len();
        self.inputs[first..].copy_from_slice(forces);
    }

    /// Runs the report tape at the state of the last [`Self::value`], for the needs given to
    /// [`Self::set_report_needs`]: then read [`Self::report`].
    pub fn report_value(&mut self) {
        let compiled = &self.modes[self.current];
        let held = Held {
            needs: &self.report_held,
            branches: &compiled.mode.branches,
        };
        let call = Call {
            arithmetic: &mut self.plain,
            held: &held,
            constants: &compiled.constants,
            inputs: &self.inputs,
            outputs: &mut self.report_nodes,
        };
        self.system.evaluate(Which::Report, call);
    }
}

/// Factors the linear system of a mode.
fn factor<T: Scalar>(compiled: &mut Compiled<T>) -> Result<(), SolveError> {
    let constants = core::mem::take(&mut compiled.constants);
    let (plan, solver, tape) = compiled.parts();
    let number = |node: usize| tape.registers[tape.nodes[node].slot.index()];
    let (free, size) = (plan.free(), plan.size());
    let matrix = solver.begin(free, size, &plan.constant[..size * size]);
    for entry in &plan.entries {
        matrix[entry.row * size + entry.column] += number(entry.node);
    }
    // A kept row that follows from the eliminated ones leaves rounding behind: that is a zero.
    let read = |place: Place| match place {
        Place::Zero => T::default(),
        Place::Constant(i) => constants[i],
        Place::Node(i) => number(i),
    };
    let rounding = 512.0 * epsilon::<T>();
    for (row, terms) in plan.cancelled(read) {
        let row = &mut matrix[row * size..row * size + free];
        if row.iter().all(|x| x.value().abs() <= rounding * terms) {
            row.fill(T::default());
        }
    }
    let inertia = if plan.elimination.symmetric {
        Inertia::Symmetric
    } else {
        Inertia::General
    };
    let outcome = solver.factor(inertia);
    compiled.constants = constants;
    outcome
}
