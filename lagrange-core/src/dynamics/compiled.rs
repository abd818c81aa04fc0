//! The equations of one mode, made ready once and kept: numbers that depend on parameters, the plan of the linear system,
//! and the interpreted equations for what has been asked for.

use super::constants::Constants;
use super::emitted::{Emitted, is_finite};
use super::held::Held;
use super::interpreted::Interpreted;
use super::output_mask::{self, OutputMask};
use super::shape::{Asked, Part, Planned};
use crate::arithmetic::Scalar;
use crate::effects::Effects;
use crate::equations::{Arguments, Turn};
use crate::linear::{KktPattern, Solver, UnitQuaternion, acting};
use crate::mode::Mode;
use crate::system::{Description, ErasedSystem, Selection};

/// Interpreted equations kept per mode: what is asked for beside the motion changes between stepping and switching, and numbers vanish
/// for some parameters and not for others.
const MOST_INTERPRETED: usize = 12;

/// The equations of one mode.
#[derive(Clone, Debug)]
pub(super) struct Compiled<T: Scalar> {
    pub mode: Mode,
    /// See [`Dynamics::mode_number`](super::Dynamics::mode_number).
    pub number: usize,
    /// Outputs that the equations of motion need.
    pub motion_needs: OutputMask,
    /// Inertia, Jacobians and residuals of the rows that act.
    pub row_needs: OutputMask,
    /// What is held beside.
    pub held: Held,
    /// Rows that act, ascending.
    pub acting: Vec<usize>,
    /// Constants of the system, then those of the plan.
    pub constants: Vec<T>,
    /// How the linear system is solved where no functions do it.
    pub pattern: KktPattern<T>,
    /// Whether the plan was made for the present parameters.
    is_planned: bool,
    /// The plan for the parameters before.
    spare: KktPattern<T>,
    pub solver: Solver<T>,
    /// Whether the solver holds the factors of this plan.
    pub factored: bool,
    /// Whether the parameters have changed since the numbers were taken.
    outdated: bool,
    /// The functions of this mode, if they have been emitted.
    pub emitted: Option<Emitted<T>>,
    /// Whether a pivot of the functions was not safe.
    pub refused: bool,
    /// The interpreted equations.
    interpreted: Loaded<T>,
    /// The equations for outputs alone, used where functions solve the equations of motion.
    outputs: Loaded<T>,
    /// The equations for projections: one, once a projection has asked for it.
    rows: Vec<Interpreted<T>>,
}

impl<T: Scalar> Compiled<T> {
    pub(super) fn new(
        system: &dyn ErasedSystem<T>,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Constants<T>,
    ) -> Self {
        let d = system.description();
        let mut compiled = Self {
            mode: mode.clone(),
            number: 0,
            motion_needs: output_mask::of_motion(d, effects, mode),
            row_needs: output_mask::of_rows(d, effects, mode),
            held: Held::new(d),
            acting: acting(d, effects, mode).collect(),
            constants: Vec::new(),
            pattern: KktPattern::default(),
            is_planned: false,
            spare: KktPattern::default(),
            solver: Solver::default(),
            factored: false,
            outdated: false,
            emitted: Emitted::of(system, effects, mode),
            refused: false,
            interpreted: Loaded::default(),
            outputs: Loaded::default(),
            rows: Vec::new(),
        };
        compiled.set_numbers(system, effects, constants);
        compiled
    }

    /// Numbers of a system, and the plan if it is needed for sure.
    fn set_numbers(
        &mut self,
        system: &dyn ErasedSystem<T>,
        effects: &Effects,
        constants: &mut Constants<T>,
    ) {
        let branches = &self.mode.branches;
        constants.write(system, branches, &mut self.constants);
        if let Some(emitted) = &mut self.emitted {
            emitted.renew(system, &constants.held(branches));
        }
        self.is_planned = false;
        if self.functions().is_none() {
            self.make_plan(system.description(), effects);
        }
    }

    /// Makes the plan for the present parameters, unless it is there.
    pub(super) fn make_plan(&mut self, d: &Description, effects: &Effects) {
        if self.is_planned {
            return;
        }
        self.is_planned = true;
        self.factored = false;
        core::mem::swap(&mut self.pattern, &mut self.spare);
        self.pattern
            .set(d, effects, &self.mode, &mut self.constants);
        if !self.pattern.is_like(&self.spare) {
            self.interpreted.list.clear();
            self.held.selected = None;
            let KktPattern {
                elimination, kept, ..
            } = &self.pattern;
            let place = |j: usize| elimination.free.iter().position(|&free| free == j);
            let quaternions = d.constraints.iter().filter_map(|c| {
                let first = c.attitude?;
                let [w, x, y, z] = [0, 1, 2, 3].map(|k| place(first + k));
                let row = kept.iter().position(|&row| row == c.row)?;
                Some(UnitQuaternion {
                    coordinates: [w?, x?, y?, z?],
                    row: elimination.free.len() + row,
                })
            });
            self.solver.set_quaternions(quaternions);
            self.solver.reserve(elimination.free.len(), kept.len());
        }
    }

    /// The functions of the mode, if they hold for the present parameters.
    #[inline]
    pub(super) fn functions(&self) -> Option<&Emitted<T>> {
        let emitted = self.emitted.as_ref().filter(|_| !self.refused);
        emitted.filter(|emitted| emitted.is_admitted())
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.outdated = true;
        self.held.selected = None;
    }

    /// Holds what is asked for beside the motion: extra needs, those of the report, and the energies that are no part of it.
    #[inline]
    pub(super) fn hold(&mut self, d: &Description, asked: (&OutputMask, &OutputMask, &OutputMask)) {
        let gives_rows = self.emitted.as_ref().is_some_and(Emitted::gives_rows);
        let rows = gives_rows.then_some(&self.row_needs);
        self.held.renew(d, &self.motion_needs, rows, asked);
    }

    /// Takes the present parameters, if they have changed. Interpreted equations take them when they are selected.
    pub(super) fn renew(
        &mut self,
        system: &dyn ErasedSystem<T>,
        effects: &Effects,
        constants: &mut Constants<T>,
    ) {
        if !core::mem::take(&mut self.outdated) {
            return;
        }
        self.restart();
        let lists = [
            &mut self.interpreted.list,
            &mut self.outputs.list,
            &mut self.rows,
        ];
        let interpreted = lists.into_iter().flatten();
        interpreted.for_each(Interpreted::outdate);
        self.set_numbers(system, effects, constants);
    }

    /// Undoes [`Self::refuse_functions`]: one motion must not depend on those before it.
    pub(super) fn restart(&mut self) {
        self.refused = false;
        // Other factors are those of the rows that were not set aside.
        self.factored &= self.solver.is_direct();
        self.solver.forget_rows_aside();
    }

    /// Whether a row that acts is held aside.
    pub(super) fn holds_aside(&self, row: usize) -> bool {
        let kept = self.pattern.kept.iter().position(|&kept| kept == row);
        kept.is_some_and(|i| self.solver.holds_aside(i))
    }

    /// Accelerations by the functions of the mode.
    #[inline]
    pub(super) fn accelerations(
        &self,
        state: Arguments<T>,
        out: &mut [T],
        turns: &mut [Turn<T>],
    ) -> Outcome {
        let (_, q, v) = state;
        let Some(emitted) = self.functions().filter(|emitted| emitted.holds_at(q, v)) else {
            return Outcome::NotGiven;
        };
        let held = self.selection(&self.motion_needs);
        Outcome::of(emitted.accelerations(&held, state, out, turns), [out, &[]])
    }

    /// The same with the forces of all rows, and what is held if guards read it.
    #[inline]
    pub(super) fn value(
        &mut self,
        d: &Description,
        for_guards: bool,
        state: Arguments<T>,
        (accelerations, forces): (&mut [T], &mut [T]),
        turns: &mut [Turn<T>],
    ) -> Outcome {
        let (_, q, v) = state;
        if !self
            .functions()
            .is_some_and(|emitted| emitted.holds_at(q, v))
        {
            return Outcome::NotGiven;
        }
        let held = Selection {
            needs: match for_guards {
                true => &self.held.value,
                false => &self.motion_needs,
            },
            branches: &self.mode.branches,
        };
        let Some(emitted) = &mut self.emitted else {
            return Outcome::NotGiven;
        };
        let safe = emitted.value(&held, state, accelerations, turns);
        forces.copy_from_slice(emitted.forces(d));
        Outcome::of(safe, [accelerations, forces])
    }

    /// What functions are told for these needs.
    #[inline]
    pub(super) fn selection<'a>(&'a self, needs: &'a OutputMask) -> Selection<'a> {
        let branches = &self.mode.branches;
        Selection { needs, branches }
    }

    /// The functions of the mode, to be expanded, with what they are told.
    #[inline]
    pub(super) fn emitted_mut(&mut self) -> Option<(&mut Emitted<T>, Selection<'_>)> {
        let held = Selection {
            needs: &self.held.series,
            branches: &self.mode.branches,
        };
        self.emitted.as_mut().map(|emitted| (emitted, held))
    }

    /// The interpreted equations in use, if they have been loaded.
    #[inline]
    pub(super) fn interpreted(&self) -> Option<&Interpreted<T>> {
        self.interpreted.list.get(self.interpreted.in_use)
    }

    /// The parts that an evaluation by the interpreter works with.
    #[inline]
    pub(super) fn parts(&mut self) -> (&KktPattern<T>, &mut Solver<T>, &mut Interpreted<T>) {
        let Loaded { list, in_use } = &mut self.interpreted;
        (&self.pattern, &mut self.solver, &mut list[*in_use])
    }

    /// The outputs in use.
    #[inline]
    pub(super) fn outputs(&mut self) -> &mut Interpreted<T> {
        &mut self.outputs.list[self.outputs.in_use]
    }

    /// What interpreted equations are loaded from.
    fn planned(&self) -> Planned<'_, T> {
        Planned {
            mode: &self.mode,
            constants: &self.constants,
            pattern: &self.pattern,
        }
    }

    /// What projections evaluate: inertia, Jacobians and residuals of the rows that act. `numbers` is memory.
    pub(super) fn rows(
        &mut self,
        system: &dyn ErasedSystem<T>,
        numbers: &mut Vec<T>,
    ) -> &mut Interpreted<T> {
        let ready = self.rows.first().is_some_and(Interpreted::is_current);
        if !ready {
            let mut rows = core::mem::take(&mut self.rows);
            rows.retain_mut(|rows| rows.renew(system, self.planned(), numbers));
            if rows.is_empty() {
                let no_series = OutputMask::new(system.description());
                let asked = Asked {
                    held: &self.row_needs,
                    extra: &no_series,
                    report: None,
                    part: Part::Outputs,
                    forcing: false,
                };
                rows.push(Interpreted::load(system, self.planned(), &asked, numbers));
            }
            self.rows = rows;
        }
        &mut self.rows[0]
    }

    /// Leaves the equations to the interpreter and the linear systems to the solver from now on.
    pub(super) fn refuse_functions(&mut self) {
        self.refused = true;
    }

    /// Makes a part of the interpreted equations for what is held current, with the numbers of the present parameters. `numbers` is memory.
    pub(super) fn select(
        &mut self,
        system: &dyn ErasedSystem<T>,
        part: Part,
        numbers: &mut Vec<T>,
    ) {
        let mut loaded = core::mem::take(self.loaded(part));
        let asked = &self.held.asked(part);
        let found = loaded
            .list
            .iter_mut()
            .position(|one| one.is_for(asked) && one.renew(system, self.planned(), numbers));
        loaded.in_use = found.unwrap_or_else(|| {
            let one = Interpreted::load(system, self.planned(), asked, numbers);
            loaded.keep(one)
        });
        *self.loaded(part) = loaded;
        self.held.selected = Some(part);
    }

    fn loaded(&mut self, part: Part) -> &mut Loaded<T> {
        match part {
            Part::Solution => &mut self.interpreted,
            Part::Outputs => &mut self.outputs,
        }
    }
}

/// Equations loaded for what has been asked for, and which of them are in use.
#[derive(Clone, Debug, Default)]
struct Loaded<T> {
    list: Vec<Interpreted<T>>,
    in_use: usize,
}

impl<T> Loaded<T> {
    /// Takes one more, in the place of another if there are many; returns its place.
    fn keep(&mut self, one: Interpreted<T>) -> usize {
        if self.list.len() < MOST_INTERPRETED {
            self.list.push(one);
            return self.list.len() - 1;
        }
        let place = (self.in_use + 1) % MOST_INTERPRETED;
        self.list[place] = one;
        place
    }
}

/// What an evaluation by the functions of a mode has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Finite accelerations and forces.
    Given,
    /// Nothing: there are no functions, or none that hold at this state.
    NotGiven,
    /// A pivot that is not safe.
    Unsafe,
}

impl Outcome {
    #[inline]
    fn of<T: Scalar>(safe: bool, found: [&[T]; 2]) -> Self {
        match safe {
            false => Self::Unsafe,
            true if found.into_iter().all(is_finite) => Self::Given,
            true => Self::NotGiven,
        }
    }
}
