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
        let n = q.len();
        let mut inputs = core::mem::take(&mut self.inputs);
        let (accelerations, forces) = inputs[1 + 2 * n..].split_at_mut(n);
        let outcome = self.evaluate(t, q, v, accelerations, Some(forces));
        self.inputs = inputs;
        outcome?;
        self.tape(t, q, v);
        Ok(())
    }

    /// Accelerations, and forces of all rows if asked for, at (t, q, v): by the functions of the mode where they hold, else by the
    /// recorded tape.
    #[inline]
    fn evaluate(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        accelerations: &mut [T],
        mut forces: Option<&mut [T]>,
    ) -> Result<(), EvaluationError> {
        if self.choose(q, v) {
            if let Some(forces) = forces.as_deref_mut() {
                forces.fill(T::default());
            }
            let compiled = &self.modes[self.current];
            let safe = compiled.emitted(&self.held).is_some_and(|(emitted, held)| {
                emitted.value(&held, (t, q, v), accelerations, forces.as_deref_mut())
            });
            if safe && is_finite(accelerations) {
                return Ok(());
            }
            self.by_functions = false;
            if !safe {
                self.leave_to_solver();
            }
        }
        let extent = match forces {
            Some(_) => Extent::Everything,
            None => Extent::Accelerations,
        };
        self.run(t, q, v, extent, false)?;
        let n = q.len();
        let results = self.registers().get(2 + 2 * n..).unwrap_or_default();
        let (found, rest) = results.split_at(n);
        accelerations.copy_from_slice(found);
        if let Some(forces) = forces {
            forces.copy_from_slice(&rest[..forces.len()]);
        }
        if is_finite(accelerations) {
            return Ok(());
        }
        let bad = accelerations.iter().position(|x| !x.value().is_finite());
        Err(EvaluationError::NotFiniteAcceleration {
            coordinate: bad.unwrap_or(0),
        })
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

    /// Accelerations alone at (t, q, v).
    #[inline]
    pub(super) fn run_accelerations(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        accelerations: &mut [T],
    ) -> Result<(), EvaluationError> {
        self.work.values += 1;
        self.evaluate(t, q, v, accelerations, None)
    }

    /// Leaves the linear systems of the mode to the solver from now on.
    pub(super) fn leave_to_solver(&mut self) {
        self.modes[self.current].leave_to_solver();
        (self.selected, self.by_functions) = (false, false);
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

/// Whether all numbers are finite: the sum of zeros is zero unless one of the factors is not.
#[inline]
pub(super) fn is_finite<T: Scalar>(numbers: &[T]) -> bool {
    numbers.iter().fold(0.0, |sum, x| sum + 0.0 * x.value()) == 0.0
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
