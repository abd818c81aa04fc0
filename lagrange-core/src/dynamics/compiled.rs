//! The equations of one mode, made ready once and kept: numbers that depend on parameters, the plan of the linear system,
//! and the tapes recorded for what has been asked for.

use super::needs::{self, NeedSet};
use super::tape::Tape;
use crate::arithmetic::{Given, Scalar};
use crate::effects::Effects;
use crate::equations::Emitted;
use crate::linear::{Plan, Solver};
use crate::mode::Mode;
use crate::system::{Description, Held};
use crate::tapes::Tapes;

/// Tapes kept per mode: what is asked for beside the motion changes between stepping and switching, and numbers coincide for some
/// parameters that differ for others.
const MOST_TAPES: usize = 12;

/// The equations of one mode.
#[derive(Clone, Debug)]
pub(super) struct Compiled<T: Scalar> {
    pub mode: Mode,
    /// Of the equations of motion.
    pub motion_needs: NeedSet,
    /// Inertia, Jacobians and residuals of the rows that act.
    pub row_needs: NeedSet,
    /// Of the constants.
    constant_needs: NeedSet,
    /// The system's own, then the plan's.
    pub constants: Vec<T>,
    pub plan: Plan<T>,
    /// The plan for the parameters before.
    spare: Plan<T>,
    pub solver: Solver<T>,
    /// Whether the solver holds the factors of this plan.
    pub factored: bool,
    /// Whether numbers and plan are those of other parameters.
    outdated: bool,
    /// The functions of this mode, if they have been emitted.
    pub emitted: Option<Emitted<T>>,
    /// Whether a tape may solve small systems itself.
    pub on_tape: bool,
    /// Coordinates that cannot accelerate.
    pub pinned: Vec<usize>,
    /// The one in use comes first.
    tapes: Vec<Tape<T>>,
}

/// What a tape is recorded for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<'a> {
    /// Everything that the motion tape is told.
    pub held: &'a NeedSet,
    /// Of this, what is asked for beside the motion.
    pub extra: &'a NeedSet,
    /// What the report tape is told; none if nothing is asked of it.
    pub report: Option<&'a NeedSet>,
    /// Whether the coordinates that cannot accelerate are at rest.
    pub at_rest: bool,
}

impl<T: Scalar> Compiled<T> {
    pub(super) fn new(system: &dyn Tapes<T>, effects: &Effects, mode: &Mode) -> Self {
        let d = system.description();
        let mut motion_needs = NeedSet::new(d);
        let mut row_needs = NeedSet::new(d);
        let mut held = NeedSet::new(d);
        needs::of_motion(d, effects, mode, &mut motion_needs);
        needs::of_rows(d, effects, mode, &mut row_needs);
        needs::of_effects(d, effects, &mut held);
        let mut compiled = Self {
            mode: mode.clone(),
            motion_needs,
            row_needs,
            constant_needs: held,
            pinned: Vec::new(),
            constants: Vec::new(),
            plan: Plan::default(),
            spare: Plan::default(),
            solver: Solver::default(),
            factored: false,
            outdated: false,
            emitted: Emitted::of(system, effects, mode),
            on_tape: true,
            tapes: Vec::new(),
        };
        compiled.set_numbers(system, effects);
        compiled.reserve(d);
        compiled
    }

    /// Constants and plan of a system.
    fn set_numbers(&mut self, system: &dyn Tapes<T>, effects: &Effects) {
        let d = system.description();
        let held = Held {
            needs: &self.constant_needs,
            branches: &self.mode.branches,
        };
        self.constants.clear();
        self.constants.resize(d.constants, T::default());
        system.constants(&held, &mut self.constants);
        if let Some(emitted) = &mut self.emitted {
            emitted.renew(system, &held);
        }
        self.plan.set(d, effects, &self.mode, &mut self.constants);
    }

    /// What follows from the shape of the plan.
    fn reserve(&mut self, d: &Description) {
        let Self { plan, solver, .. } = self;
        solver.reserve(plan.free(), plan.kept.len());
        self.pinned.clear();
        let pinned = (0..d.coordinates.len()).filter(|&j| plan.is_pinned(j));
        self.pinned.extend(pinned);
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.outdated = true;
    }

    /// Takes the present parameters, if they have changed. The tapes take them when they are selected.
    pub(super) fn renew(&mut self, system: &dyn Tapes<T>, effects: &Effects) {
        if !core::mem::take(&mut self.outdated) {
            return;
        }
        self.restart();
        core::mem::swap(&mut self.plan, &mut self.spare);
        self.set_numbers(system, effects);
        self.factored = false;
        if self.plan.is_like(&self.spare) {
            self.tapes.iter_mut().for_each(Tape::outdate);
        } else {
            self.tapes.clear();
            self.reserve(system.description());
        }
    }

    /// Undoes [`Self::leave_to_solver`]: one motion must not depend on those before it.
    pub(super) fn restart(&mut self) {
        if !self.on_tape {
            self.on_tape = true;
            self.tapes.clear();
        }
    }

    /// What the functions of the mode are told, with the needs that are held.
    #[inline]
    pub(super) fn emitted<'a>(&'a self, needs: &'a NeedSet) -> Option<(&'a Emitted<T>, Held<'a>)> {
        let branches = &self.mode.branches;
        let held = Held { needs, branches };
        self.emitted.as_ref().map(|emitted| (emitted, held))
    }

    /// The same, to be expanded.
    #[inline]
    pub(super) fn emitted_mut<'a>(
        &'a mut self,
        needs: &'a NeedSet,
    ) -> Option<(&'a mut Emitted<T>, Held<'a>)> {
        let branches = &self.mode.branches;
        let held = Held { needs, branches };
        self.emitted.as_mut().map(|emitted| (emitted, held))
    }

    /// The tape in use, if one has been recorded.
    #[inline]
    pub(super) fn tape(&self) -> Option<&Tape<T>> {
        self.tapes.first()
    }

    /// The parts that an evaluation works with.
    #[inline]
    pub(super) fn parts(&mut self) -> (&Plan<T>, &mut Solver<T>, &mut Tape<T>) {
        (&self.plan, &mut self.solver, &mut self.tapes[0])
    }

    /// Leaves all systems to the solver from now on.
    pub(super) fn leave_to_solver(&mut self) {
        self.on_tape = false;
        self.tapes.clear();
    }

    /// Makes the tape for what is asked current, with the numbers of the present parameters, recording it if there is none: for what
    /// is asked there may be several, for parameters with different coincidences. `given` is memory.
    pub(super) fn select(&mut self, system: &dyn Tapes<T>, asked: &Asked, given: &mut Given<T>) {
        let mut tapes = core::mem::take(&mut self.tapes);
        let found = tapes
            .iter_mut()
            .position(|tape| tape.is_for(asked) && tape.renew(system, self, given));
        match found {
            // The one used last comes first.
            Some(index) => tapes[..=index].rotate_right(1),
            None => {
                tapes.truncate(MOST_TAPES - 1);
                tapes.insert(0, Tape::record(system, self, asked, given));
            }
        }
        self.tapes = tapes;
    }
}
