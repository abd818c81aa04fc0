//! Accelerations and forces at one state.

use super::compiled::{Compiled, Outcome};
use super::interpreted::Interpreted;
use super::shape::{Extent, FORCES, MOTION, Part, REPORT, SYSTEM};
use super::{AT_REST, Dynamics, Equations, EvaluationError};
use crate::arithmetic::{Scalar, epsilon};
use crate::equations::Arguments;
use crate::linear::{Inertia, Shares, SolveError};
use crate::system::ValueRef;

impl<T: Scalar> Dynamics<T> {
    /// Accelerations and forces at (t, q, v): then read [`Self::acceleration`], [`Self::force`], [`Self::motion`].
    ///
    /// `q` and `v` have one element per coordinate.
    ///
    /// # Errors
    /// The system is singular there, or a number is not finite.
    pub fn value(&mut self, t: T, q: &[T], v: &[T]) -> Result<(), EvaluationError> {
        // What the interpreter leaves beside the value is made anew.
        if self.given && self.functions().is_some() && self.is_at(t, q, v) {
            self.by_functions = true;
            return Ok(());
        }
        self.work.values += 1;
        let n = q.len();
        let mut inputs = core::mem::take(&mut self.inputs);
        let (accelerations, forces) = inputs[1 + 2 * n..].split_at_mut(n);
        let outcome = self.evaluate(t, q, v, accelerations, forces);
        self.inputs = inputs;
        outcome?;
        self.take_state(t, q, v);
        self.given = self.by_functions && self.guards_alone;
        if self.given {
            self.take_given();
            return Ok(());
        }
        match self.by_functions {
            true => self.run_outputs(t, q, v),
            false => self.take_nodes(),
        }
        Ok(())
    }

    /// Accelerations and forces of all rows at (t, q, v): by the functions of the mode where they hold, else by the interpreter.
    #[inline]
    fn evaluate(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        accelerations: &mut [T],
        forces: &mut [T],
    ) -> Result<(), EvaluationError> {
        self.hold();
        let compiled = &mut self.modes[self.current];
        let outcome = match self.equations {
            Equations::Interpreted => Outcome::NotGiven,
            Equations::Emitted => {
                let alone = self.guards_alone;
                let out = (&mut *accelerations, &mut *forces);
                compiled.value(self.description, alone, (t, q, v), out, &mut self.turns)
            }
        };
        self.by_functions = outcome == Outcome::Given;
        match outcome {
            Outcome::Given => Ok(()),
            _ => self.interpret(outcome, (t, q, v), accelerations, Some(forces)),
        }
    }

    /// Accelerations, and forces of all rows if asked for, by the interpreter, where the functions of the mode have come to nothing.
    #[cold]
    #[inline(never)]
    fn interpret(
        &mut self,
        outcome: Outcome,
        (t, q, v): Arguments<T>,
        accelerations: &mut [T],
        forces: Option<&mut [T]>,
    ) -> Result<(), EvaluationError> {
        if outcome == Outcome::Unsafe {
            self.refuse_functions();
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
        let bad = |numbers: &[T]| numbers.iter().position(|x| !x.value().is_finite());
        if let Some(coordinate) = bad(accelerations) {
            return Err(EvaluationError::NotFiniteAcceleration { coordinate });
        }
        let Some(forces) = forces else {
            return Ok(());
        };
        forces.copy_from_slice(&rest[..forces.len()]);
        match bad(forces) {
            Some(row) => Err(EvaluationError::NotFiniteForce { row }),
            None => Ok(()),
        }
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
        self.select(Part::Solution);
        let (_, _, interpreted) = self.modes[self.current].parts();
        interpreted.place(t, q, v);
        for &(friction, components, _) in &interpreted.shape.slip_directions {
            for (register, along) in components
                .into_iter()
                .zip(self.slip_directions.hold(friction))
            {
                interpreted.registers[register.index()] = along;
            }
        }
        interpreted.evaluate(extent, MOTION);
        if self.presses_by_resultants() {
            return self.solve_pressed(extent, refined);
        }
        self.solve_system(extent, refined)
    }

    /// The linear system and its forces, from what the motion program has left in the registers.
    #[inline]
    pub(super) fn solve_system(
        &mut self,
        extent: Extent,
        refined: bool,
    ) -> Result<(), EvaluationError> {
        let (_, _, interpreted) = self.modes[self.current].parts();
        interpreted.evaluate(extent, SYSTEM);
        self.solve_start(refined)?;
        let (_, _, interpreted) = self.modes[self.current].parts();
        interpreted.evaluate(extent, FORCES);
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
        let compiled = &self.modes[self.current];
        let outcome = match self.equations {
            Equations::Interpreted => Outcome::NotGiven,
            Equations::Emitted => compiled.accelerations((t, q, v), accelerations, &mut self.turns),
        };
        self.by_functions = outcome == Outcome::Given;
        match outcome {
            Outcome::Given => Ok(()),
            _ => self.interpret(outcome, (t, q, v), accelerations, None),
        }
    }

    /// Leaves the equations of the mode to the interpreter from now on.
    pub(super) fn refuse_functions(&mut self) {
        self.modes[self.current].refuse_functions();
        self.by_functions = false;
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
        let (pattern, solver, interpreted) = modes[*current].parts();
        solution.clear();
        solution.extend_from_slice(&right[..pattern.size()]);
        solver.solve(solution);
        let n = self.description.coordinates.len();
        let outcome = solver.check_rows_aside(solution, right, || {
            let velocities = interpreted.registers[2 + n..2 + 2 * n].iter().enumerate();
            // No factor occurs twice, so that nothing cancels because coordinates move alike.
            let others = velocities.map(|(j, v)| {
                let v = v.value();
                (1.0 + j as f64).sqrt() * (v + AT_REST.copysign(v))
            });
            let others: Vec<f64> = others.collect();
            interpreted
                .right_sides_at(&others)
                .split_off(pattern.free())
        });
        let refined = refined || !solver.is_direct();
        if outcome.is_ok() && refined && pattern.size() > pattern.free() {
            solver.refine(solution, &mut right[..pattern.size()]);
        }
        for (register, &x) in interpreted.shape.unknowns.iter().zip(&*solution) {
            interpreted.registers[register.index()] = x;
        }
        if let Some(unknown) = solution.iter().position(|x| !x.value().is_finite()) {
            return Err(self.not_finite(unknown));
        }
        outcome.map_err(|e| self.solve_error(e))
    }

    /// Per coordinate how far its acceleration at a state is open where the elements of the matrix of the equations are known to within a
    /// share, in units of that share.
    pub(crate) fn open_accelerations(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
    ) -> Result<Vec<f64>, EvaluationError> {
        self.run(t, q, v, Extent::Everything, false)?;
        let solution = &self.solution;
        let (pattern, solver, _) = self.modes[self.current].parts();
        let mut open = vec![0.0; pattern.free()];
        solver.open(solution, &mut open);
        let coordinates = 0..q.len();
        let of_coordinate = |j: usize| {
            let terms = pattern.elimination.right.row(j).iter();
            terms
                .map(|&(k, factor)| factor.value().abs() * open[k])
                .sum()
        };
        Ok(coordinates.map(of_coordinate).collect())
    }

    /// Right-hand sides from the registers.
    fn fill_right(&mut self) {
        let (_, _, interpreted) = self.modes[self.current].parts();
        let right = interpreted.shape.right.iter();
        self.right.clear();
        self.right
            .extend(right.map(|register| interpreted.registers[register.index()]));
    }

    /// Factors the system whose changing numbers are in the registers.
    pub(super) fn factor(&mut self) -> Result<(), EvaluationError> {
        let compiled = &mut self.modes[self.current];
        if compiled.factored && compiled.pattern.entries.is_empty() {
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

    /// Runs only the motion program at (t, q, v), for the needs held: then read [`Self::motion`].
    pub fn tape(&mut self, t: T, q: &[T], v: &[T]) {
        self.given = false;
        self.take_state(t, q, v);
        self.run_outputs(t, q, v);
    }

    /// What can be told of a state in which accelerations and forces cannot be had: what is made of these is no number.
    pub(crate) fn tape_without_forces(&mut self, t: T, q: &[T], v: &[T]) {
        self.tape(t, q, v);
        self.inputs[1 + 2 * q.len()..].fill(T::from_f64(f64::NAN));
    }

    /// The outputs of the motion program at the last value: all that are held, also where those for guards were enough.
    pub(crate) fn complete_outputs(&mut self) {
        if !self.given {
            return;
        }
        let inputs = core::mem::take(&mut self.inputs);
        let n = self.description.coordinates.len();
        let (q, v) = inputs[1..=2 * n].split_at(n);
        self.run_outputs(inputs[0], q, v);
        self.inputs = inputs;
    }

    /// Runs the motion program for what is held: as a function where the mode has functions, else as data.
    fn run_outputs(&mut self, t: T, q: &[T], v: &[T]) {
        self.hold();
        if self.functions().is_some() {
            let compiled = &self.modes[self.current];
            let held = compiled.selection(&compiled.held.motion);
            let (constants, nodes) = (&compiled.constants, &mut self.nodes);
            if self.system.motion(&held, constants, (t, q, v), nodes) {
                self.run.clone_from(&compiled.held.motion);
                return;
            }
        }
        self.select_outputs();
        let interpreted = self.in_front();
        if interpreted.has_motion() {
            interpreted.place(t, q, v);
            interpreted.evaluate(Extent::Everything, MOTION);
        }
        self.take_nodes();
    }

    /// The interpreted equations in use, which have been selected.
    #[inline]
    fn in_front(&mut self) -> &mut Interpreted<T> {
        let compiled = &mut self.modes[self.current];
        match compiled.held.selected {
            Some(Part::Outputs) => compiled.outputs(),
            Some(Part::Solution) | None => compiled.parts().2,
        }
    }

    #[inline]
    fn take_state(&mut self, t: T, q: &[T], v: &[T]) {
        self.run.empty();
        let n = q.len();
        self.inputs[0] = t;
        self.inputs[1..1 + n].copy_from_slice(q);
        self.inputs[1 + n..1 + 2 * n].copy_from_slice(v);
        // What has not been asked for is no number.
        #[cfg(debug_assertions)]
        self.nodes.fill(T::from_f64(f64::NAN));
    }

    /// Takes the outputs of the motion program from the registers.
    #[inline]
    fn take_nodes(&mut self) {
        let mut nodes = core::mem::take(&mut self.nodes);
        self.in_front().take_nodes(&mut nodes);
        self.nodes = nodes;
        self.run.clone_from(&self.modes[self.current].held.motion);
    }

    /// Takes the outputs that the functions of the mode have given.
    #[inline]
    fn take_given(&mut self) {
        #[cfg(debug_assertions)]
        self.report_nodes.fill(T::from_f64(f64::NAN));
        if let Some(emitted) = &self.modes[self.current].emitted {
            emitted.take_outputs(&mut self.nodes, &mut self.report_nodes);
        }
    }

    /// Whether the last value is of this state. Equal numbers may have other derivatives.
    #[inline]
    fn is_at(&self, t: T, q: &[T], v: &[T]) -> bool {
        let n = q.len();
        let same = |at: usize, numbers: &[T]| self.inputs[at..at + n] == *numbers;
        T::DERIVATIVES == 0 && self.inputs[0] == t && same(1, q) && same(1 + n, v)
    }

    /// Inertia, Jacobians and residuals of the rows that act, at (t, q, v): they are there if that is the last value and the functions
    /// of the mode or the motion program have given them. Whether the functions have.
    #[inline]
    pub(super) fn see_rows(&mut self, t: T, q: &[T], v: &[T]) -> bool {
        let given = self.given && self.gives_rows();
        let known = given || self.run.includes(&self.compiled().row_needs);
        let is_seen = known && self.is_at(t, q, v);
        if !is_seen {
            self.run_rows(t, q, v);
        }
        is_seen && given
    }

    /// Runs the motion program at (t, q, v) for inertia, Jacobians and residuals of the rows that act.
    pub(super) fn run_rows(&mut self, t: T, q: &[T], v: &[T]) {
        self.work.projections += 1;
        self.run.empty();
        self.given &= self.is_at(t, q, v);
        let compiled = &mut self.modes[self.current];
        let rows = compiled.rows(&*self.system, &mut self.numbers);
        rows.place(t, q, v);
        rows.evaluate(Extent::Everything, MOTION);
        rows.take_nodes(&mut self.nodes);
    }

    /// Replaces the forces of all rows that [`Self::force`] and the report see until the next [`Self::value`].
    pub(crate) fn replace_forces(&mut self, forces: &[T]) {
        let first = 1 + 3 * self.description().coordinates.len();
        self.inputs[first..].copy_from_slice(forces);
        self.given = false;
    }

    /// Runs the report at (t, q, v) for needs that read neither accelerations nor forces: then read [`Self::report`].
    pub(crate) fn report_of_state(&mut self, t: T, q: &[T], v: &[T]) {
        self.given = false;
        self.take_state(t, q, v);
        self.report_value();
    }

    /// Runs the report at the state of the last [`Self::value`], for the needs given to
    /// [`Self::set_report_needs`]: then read [`Self::report`].
    pub fn report_value(&mut self) {
        if self.given {
            return;
        }
        self.hold();
        if self.compiled().held.selected.is_none() {
            self.select_outputs();
        }
        let inputs = core::mem::take(&mut self.inputs);
        let mut nodes = core::mem::take(&mut self.report_nodes);
        let interpreted = self.in_front();
        interpreted.registers[1..1 + inputs.len()].copy_from_slice(&inputs);
        interpreted.evaluate(Extent::Everything, REPORT);
        for (node, register) in nodes.iter_mut().zip(&interpreted.shape.report_nodes) {
            *node = interpreted.registers[register.index()];
        }
        (self.inputs, self.report_nodes) = (inputs, nodes);
    }
}

/// Factors the linear system of a mode.
fn factor<T: Scalar>(compiled: &mut Compiled<T>) -> Result<(), SolveError> {
    let constants = core::mem::take(&mut compiled.constants);
    let (pattern, solver, interpreted) = compiled.parts();
    let number = |node: usize| interpreted.registers[interpreted.shape.nodes[node].index()];
    let (free, size) = (pattern.free(), pattern.size());
    let matrix = solver.begin(free, size, &pattern.constant[..size * size]);
    for entry in &pattern.entries {
        matrix[entry.row * size + entry.column] += number(entry.node);
    }
    // A kept row that follows from the eliminated ones leaves rounding behind: that is a zero.
    let read = |place: ValueRef| match place {
        ValueRef::Zero => T::default(),
        ValueRef::Constant(i) => constants[i],
        ValueRef::Node(i) => number(i),
    };
    let rounding = 512.0 * epsilon::<T>();
    for (row, terms) in pattern.cancelled(read) {
        let row = &mut matrix[row * size..row * size + free];
        if row.iter().all(|x| x.value().abs() <= rounding * terms) {
            row.fill(T::default());
        }
    }
    for (row, size) in pattern.taken(read) {
        solver.note_taken(row, size);
    }
    let inertia = if pattern.elimination.symmetric {
        Inertia::Symmetric
    } else {
        Inertia::General
    };
    let shares = match pattern.shares_matter() {
        true => Shares::Equal,
        false => Shares::Any,
    };
    let outcome = solver.factor(inertia, shares);
    compiled.constants = constants;
    outcome
}
