//! The equations of motion of a scene in one mode at a time: evaluated, expanded in Taylor series, projected.
//!
//! A [`Dynamics`] owns all memory that this takes. It is told a [`Mode`] and from then on runs only what that mode needs:
//! the functions that the derive has emitted for it, or, where there are none, the system's programs as data, loaded for the mode once
//! and followed by a solver.

mod compiled;
mod constants;
mod emitted;
pub(crate) mod error;
mod held;
mod interpreted;
mod jacobian;
mod loading;
mod matrices;
mod output_mask;
mod owner;
mod packets;
mod projection;
mod resultant;
mod series;
mod shape;
mod slip_direction;
mod stepping;
#[cfg(test)]
pub(crate) mod tests;
mod values;

pub use error::{EvaluationError, row_name};
pub(crate) use matrices::LeastForces;
#[doc(hidden)]
pub(crate) use output_mask::products;
pub use output_mask::{OutputMask, add_branch_guards, add_guards};
pub(crate) use packets::Packets;
pub use projection::Residual;
pub(crate) use projection::rounding_of_residuals;
pub(crate) use slip_direction::{approach, cross, dot};

use crate::arithmetic::Scalar;
use crate::effects::{Effects, Item};
use crate::equations::Turn;
use crate::integrate::least_size;
use crate::linear::{SolveError, Solver};
use crate::mode::Mode;
use crate::system::Erased;
use crate::system::{Description, ValueRef};
use compiled::Compiled;
use constants::Constants;
use emitted::Emitted;
use shape::Part;

/// What evaluates the equations of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Equations {
    /// The functions that the derive has emitted for the mode; where there are none, the interpreter.
    #[default]
    Emitted,
    /// The interpreter, with the solver that looks for the best pivots.
    Interpreted,
}

/// Modes kept ready; beyond that the oldest goes.
const MOST_MODES: usize = 64;

/// [`Dynamics::at_rest`] in units of what is asked for.
pub(crate) const AT_REST: f64 = 1e-2;

/// Work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the equations of motion as values.
    pub values: usize,
    /// Taylor expansions.
    pub series: usize,
    /// Coefficients computed by them: Σ (order + 1).
    pub coefficients: usize,
    /// Factorizations of the linear system.
    pub factorizations: usize,
    /// Runs of the motion program by projections.
    pub projections: usize,
}

/// Arithmetic operations of one evaluation in the present mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Operations for the accelerations: a right-hand side.
    pub accelerations: usize,
    /// Operations for everything that was asked for: forces, guards and outputs as well.
    pub everything: usize,
}

/// The equations of motion of a scene.
#[derive(Clone, Debug)]
pub struct Dynamics<T: Scalar> {
    system: Erased<T>,
    description: &'static Description,
    effects: Effects,
    constants: Constants<T>,
    /// Modes met so far, and which is the present one.
    modes: Vec<Compiled<T>>,
    current: usize,
    /// Angles of the functions of all modes.
    turns: Vec<Turn<T>>,
    /// Memory of renewals.
    numbers: Vec<T>,
    /// Index of the mode to forget next.
    oldest: usize,
    /// Outputs asked for beside the equations of motion.
    extra: OutputMask,
    /// Whether the mode holds what is asked for.
    holds: bool,
    /// Whether only what guards read is read of these outputs.
    guards_alone: bool,
    /// Whether the outputs at the last value are those that the functions of the mode have given.
    given: bool,
    /// The outputs at the last value that the motion program has given; without need 0 where they are not of that state any more.
    run: OutputMask,
    report_needs: OutputMask,
    /// Needs of the named energies.
    energies: OutputMask,
    /// Whether the last evaluation was by the functions of the mode.
    by_functions: bool,
    /// Whether the last series was; a value between a series and what is read of it may not be.
    series_by_functions: bool,
    /// Whether stops and marks have none in the last series.
    without_watches: bool,
    /// What evaluates the equations.
    equations: Equations,
    /// t, q, v, v̇, λ of all rows at the last value.
    inputs: Vec<T>,
    /// Outputs of the motion program at the last value.
    nodes: Vec<T>,
    report_nodes: Vec<T>,
    right: Vec<T>,
    solution: Vec<T>,
    /// Directions of slips with two components.
    slip_directions: slip_direction::SlipDirections<T>,
    /// Directions of forces that press frictions together.
    resultants: resultant::Resultants<T>,
    /// Per coordinate: the size below which it is rounded as if it had that; empty: 1 for all.
    sizes: Vec<f64>,
    projector: Solver<T>,
    projection: projection::Scratch<T>,
    /// Columns of a Jacobian, for a stepper that wants rows.
    columns: Vec<T>,
    lanes: Vec<jacobian::Lanes<T>>,
    work: Work,
}

impl<T: Scalar> Dynamics<T> {
    /// The equations of a system whose type is forgotten.
    pub(crate) fn of(system: Erased<T>, effects: &Effects) -> Self {
        let d = system.description();
        let (n, rows) = (d.coordinates.len(), d.rows.len());
        let zero = T::default();
        let mut projector = Solver::default();
        projector.reserve(n, rows);
        let mut constants = Constants::new(d, effects);
        let open = Compiled::new(&*system, effects, &Mode::open(d), &mut constants);
        let turns = system.structures().iter().map(|structure| structure.turns);
        Self {
            turns: vec![Turn::none(); turns.max().unwrap_or(0)],
            effects: effects.clone(),
            constants,
            modes: vec![open],
            system,
            description: d,
            current: 0,
            // A projection may be the first to ask for them, in the middle of a run.
            numbers: Vec::with_capacity(loading::most_numbers(d)),
            oldest: 0,
            extra: OutputMask::new(d),
            holds: false,
            guards_alone: false,
            given: false,
            run: OutputMask::default(),
            report_needs: OutputMask::new(d),
            energies: output_mask::of_energies(d),
            by_functions: false,
            series_by_functions: false,
            without_watches: false,
            equations: Equations::Emitted,
            inputs: vec![zero; 1 + 3 * n + rows],
            nodes: vec![zero; d.motion.outputs],
            report_nodes: vec![zero; d.report.outputs],
            right: Vec::with_capacity(n + rows),
            solution: Vec::with_capacity(n + rows),
            slip_directions: slip_direction::SlipDirections::new(d.frictions.len()),
            resultants: resultant::Resultants::new(d.resultants.len()),
            sizes: Vec::new(),
            projector,
            projection: projection::Scratch::new(n, rows),
            columns: Vec::new(),
            lanes: Vec::new(),
            work: Work::default(),
        }
    }

    /// A velocity of coordinate `j` below this counts as much: one that is zero is so only to rounding of its unit, as projections leave it.
    pub(crate) fn at_rest(&self, j: usize) -> f64 {
        AT_REST * least_size(&self.sizes, j)
    }

    /// Has constraints kept to rounding of positions and velocities of these sizes, or of 1: per coordinate, or empty.
    pub(crate) fn set_sizes(&mut self, sizes: &[f64]) {
        self.sizes = sizes.to_vec();
    }

    /// The table of names, places and needs.
    #[inline]
    pub fn description(&self) -> &'static Description {
        self.description
    }

    /// The system.
    pub(crate) fn system(&self) -> &Erased<T> {
        &self.system
    }

    /// The effects that take part.
    pub fn effects(&self) -> &Effects {
        &self.effects
    }

    /// The present mode.
    pub fn mode(&self) -> &Mode {
        &self.compiled().mode
    }

    /// Index of the present mode among those that are kept ready.
    pub(crate) fn mode_index(&self) -> usize {
        self.current
    }

    /// Number of the present mode, in the order in which modes were made ready.
    pub(crate) fn mode_number(&self) -> usize {
        self.compiled().number
    }

    /// What the equations of motion of this mode need.
    #[doc(hidden)]
    pub fn motion_needs(&self) -> &OutputMask {
        &self.compiled().motion_needs
    }

    /// What was asked of the report.
    #[doc(hidden)]
    pub fn report_needs(&self) -> &OutputMask {
        &self.report_needs
    }

    /// Work done so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Operations that the equations of the mode take at the last [`Self::value`], as the interpreter counts them: what takes no part
    /// is not among them.
    pub fn operations(&mut self) -> Operations {
        self.select(Part::Solution);
        let interpreted = self.compiled().interpreted();
        interpreted
            .map(|interpreted| interpreted.operations())
            .unwrap_or_default()
    }

    /// Whether frictions take part.
    pub(crate) fn has_frictions(&self) -> bool {
        let d = self.description();
        (0..d.frictions.len()).any(|f| self.effects().includes(d, Item::Friction(f)))
    }

    /// The rows that act as equations in this mode, ascending.
    pub fn acting_rows(&self) -> &[usize] {
        &self.compiled().acting
    }

    /// The functions of the mode, if the last series was by them.
    #[inline]
    fn in_use(&self) -> Option<&Emitted<T>> {
        let emitted = self.compiled().emitted.as_ref();
        emitted.filter(|_| self.series_by_functions)
    }

    /// Has the equations evaluated by this from now on.
    pub fn set_equations(&mut self, equations: Equations) {
        (self.equations, self.by_functions) = (equations, false);
    }

    /// The functions of the mode, unless the interpreter is to be used.
    #[inline]
    fn functions(&self) -> Option<&Emitted<T>> {
        let functions = self.compiled().functions();
        functions.filter(|_| self.equations == Equations::Emitted)
    }

    /// Whether values for guards, by the functions of the mode, give the inertia and the Jacobians of the rows that act as well.
    #[inline]
    pub(crate) fn gives_rows(&self) -> bool {
        self.functions().is_some_and(Emitted::gives_rows)
    }

    /// Decides by what the coming evaluation is.
    #[inline]
    fn choose(&mut self, q: &[T], v: &[T]) -> bool {
        let functions = self.functions();
        self.by_functions = functions.is_some_and(|emitted| emitted.holds_at(q, v));
        self.by_functions
    }

    #[inline(always)]
    fn compiled(&self) -> &Compiled<T> {
        &self.modes[self.current]
    }

    /// Changes the mode. The first time in a mode parameter-only numbers are made, and the plan of the linear system where there
    /// are no functions; they are kept. What was asked for beside the motion stays asked for.
    pub fn set_mode(&mut self, mode: &Mode) {
        for (f, along) in mode.incipient() {
            self.set_slip_direction(f, along.map(T::from_f64));
        }
        if *self.mode() == *mode {
            return;
        }
        if self.mode().branches != mode.branches {
            self.run.empty();
        }
        let known = self
            .modes
            .iter()
            .position(|compiled| compiled.mode.has_equations_of(mode));
        self.current = known.unwrap_or_else(|| self.compile(mode));
        self.renew();
        // Equations are one but for the directions in which slips begin.
        if mode.has_incipient_slip() {
            self.modes[self.current].mode.clone_from(mode);
        }
        (self.holds, self.given) = (false, false);
    }

    /// Takes another system of the same kind. What has been loaded stays, with other numbers in it.
    pub(crate) fn set_system(&mut self, system: Erased<T>) {
        self.system = system;
        self.constants.outdate();
        self.modes.iter_mut().for_each(Compiled::outdate);
        self.renew();
        self.given = false;
        self.run.empty();
    }

    /// Brings the present mode up to date with the parameters.
    fn renew(&mut self) {
        let compiled = &mut self.modes[self.current];
        compiled.renew(&*self.system, &self.effects, &mut self.constants);
    }

    /// Forgets what could make a motion depend on those before it.
    pub(crate) fn restart(&mut self) {
        self.modes.iter_mut().for_each(Compiled::restart);
        self.slip_directions.restart();
        self.resultants.restart();
    }

    /// Makes a mode ready; returns its place.
    #[cold]
    fn compile(&mut self, mode: &Mode) -> usize {
        let mut compiled = Compiled::new(&*self.system, &self.effects, mode, &mut self.constants);
        let before = self.modes.iter().map(|compiled| compiled.number);
        compiled.number = before.max().map_or(0, |last| last + 1);
        if self.modes.len() < MOST_MODES {
            self.modes.push(compiled);
            return self.modes.len() - 1;
        }
        self.oldest = (self.oldest + 1) % MOST_MODES;
        self.modes[self.oldest] = compiled;
        self.oldest
    }

    /// Makes a part of the interpreted equations for the present mode and needs current.
    #[inline]
    fn select(&mut self, part: Part) {
        self.hold();
        let compiled = &mut self.modes[self.current];
        if compiled.held.selected == Some(part) {
            return;
        }
        if part == Part::Solution {
            compiled.make_plan(self.description, &self.effects);
        }
        compiled.select(&*self.system, part, &mut self.numbers);
    }

    /// Makes those interpreted equations current that outputs are read from.
    #[inline]
    fn select_outputs(&mut self) {
        let part = match self.functions() {
            Some(_) => Part::Outputs,
            None => Part::Solution,
        };
        self.select(part);
    }

    /// Asks the motion program for more than the equations of motion: gaps, slips, coefficients, branch guards.
    /// Replaces what was asked for before.
    #[doc(hidden)]
    pub fn set_extra_needs(&mut self, needs: &[u64]) {
        self.ask_for(needs, false);
    }

    /// The same where nothing is read but guards: the functions of a mode give these.
    pub(crate) fn set_guard_needs(&mut self, needs: &[u64]) {
        self.ask_for(needs, true);
    }

    fn ask_for(&mut self, needs: &[u64], guards_alone: bool) {
        if !self.extra.iter().eq(needs) || self.guards_alone != guards_alone {
            self.extra.clear();
            self.extra.extend(needs);
            self.guards_alone = guards_alone;
            (self.holds, self.given) = (false, false);
        }
    }

    /// Asks for outputs of the report, of [`Self::report_value`] and of every [`Self::series`]. Replaces what was
    /// asked for before; need 0 alone asks for nothing.
    #[doc(hidden)]
    pub fn set_report_needs(&mut self, needs: &[u64]) {
        if self.report_needs[..] != *needs {
            self.report_needs.clear();
            self.report_needs.extend(needs);
            (self.holds, self.given) = (false, false);
        }
    }

    /// Has the present mode hold what is asked for, before it is evaluated.
    #[inline]
    fn hold(&mut self) {
        if !self.holds {
            self.holds = true;
            let asked = (&self.extra, &self.report_needs, &self.energies);
            self.modes[self.current].hold(self.description, asked);
        }
    }

    fn solve_error(&self, error: SolveError) -> EvaluationError {
        let pattern = &self.compiled().pattern;
        let free = pattern.free();
        let carries = pattern.sliding.slides.iter().find_map(|slide| slide.source);
        if let (SolveError::Undetermined { .. }, Some(row)) = (error, carries)
            && self.has_inertia()
        {
            // Where every coordinate has inertia only a sliding friction leaves anything open.
            return EvaluationError::Undetermined { row };
        }
        match error {
            SolveError::NotFinite { equation } => self.not_finite(equation),
            SolveError::Undetermined { unknown } if unknown < free => EvaluationError::NoInertia {
                coordinate: pattern.elimination.free[unknown],
            },
            SolveError::Undetermined { unknown } => EvaluationError::Undetermined {
                row: pattern.kept[unknown - free],
            },
            SolveError::Inconsistent { row, residual } => EvaluationError::Inconsistent {
                row: pattern.kept[row],
                residual,
            },
        }
    }

    /// The acceleration or force that is not finite, given a solution with such a number.
    fn not_finite(&self, unknown: usize) -> EvaluationError {
        let pattern = &self.compiled().pattern;
        let free = pattern.free();
        if unknown < free {
            EvaluationError::NotFiniteAcceleration {
                coordinate: pattern.elimination.free[unknown],
            }
        } else {
            EvaluationError::NotFiniteForce {
                row: pattern.kept[unknown - free],
            }
        }
    }

    /// A number of the motion program at the last [`Self::value`]. Its need must have been held.
    #[inline]
    #[doc(hidden)]
    pub fn motion(&self, place: ValueRef) -> T {
        place.read(&self.compiled().constants, &self.nodes)
    }

    /// Σ |∂g/∂qⱼ| size(j) of a row, from the numbers of the last [`Self::value`]: what it changes by at most when each coordinate changes by its
    /// size, or its rate when each velocity does.
    pub(crate) fn size_of_row(&self, row: usize, size: impl Fn(usize) -> f64) -> f64 {
        let terms = self.description().rows[row].jacobian.iter();
        let terms = terms.map(|&(j, place)| self.motion(place).value().abs() * size(j));
        terms.sum()
    }

    /// a v of a row with these velocities, at the last value: its rate, but for what moves by itself.
    pub(crate) fn speed_along(&self, row: usize, v: &[T]) -> T {
        let terms = self.description().rows[row].jacobian.iter();
        terms.fold(T::zero(), |sum, &(j, place)| {
            sum + self.motion(place) * v[j]
        })
    }

    /// A number of the report at the last [`Self::report_value`]. Its need must have been held.
    #[inline]
    #[doc(hidden)]
    pub fn report(&self, place: ValueRef) -> T {
        place.read(&self.compiled().constants, &self.report_nodes)
    }

    /// Time, positions and velocities of the last value, one after the other.
    pub(crate) fn time_and_state(&self) -> &[T] {
        &self.inputs[..=2 * self.description().coordinates.len()]
    }

    /// v̇ at the last [`Self::value`], one per coordinate.
    #[inline]
    pub fn acceleration(&self) -> &[T] {
        let n = self.description().coordinates.len();
        &self.inputs[1 + 2 * n..1 + 3 * n]
    }

    /// The force λ of a row at the last [`Self::value`]: 0 where the row does not act; −μk N d for sliding friction.
    #[inline]
    pub fn force(&self, row: usize) -> T {
        self.inputs[1 + 3 * self.description().coordinates.len() + row]
    }
}
