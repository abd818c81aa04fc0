//! The equations of one mode, made ready once and kept: numbers that depend on parameters, the plan of the linear system,
//! and the interpreted equations for what has been asked for.

use super::constants::Constants;
use super::emitted::Emitted;
use super::interpreted::Interpreted;
use super::needs::{self, NeedSet};
use crate::arithmetic::Scalar;
use crate::effects::Effects;
use crate::erased::ErasedSystem;
use crate::linear::{Plan, Solver};
use crate::mode::Mode;
use crate::system::{Description, Held};

/// Interpreted equations kept per mode: what is asked for beside the motion changes between stepping and switching, and numbers vanish
/// for some parameters and not for others.
const MOST_INTERPRETED: usize = 12;

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
    /// What computes the system's constants.
    own: Constants<T>,
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
    /// Whether a pivot of the functions was not safe.
    pub refused: bool,
    /// Coordinates that cannot accelerate.
    pub pinned: Vec<usize>,
    /// The one in use comes first.
    interpreted: Vec<Interpreted<T>>,
    /// For projections.
    rows: Option<Interpreted<T>>,
}

/// What equations are loaded for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<'a> {
    /// Everything that is held of the motion.
    pub held: &'a NeedSet,
    /// Of this, what is asked for beside the motion.
    pub extra: &'a NeedSet,
    /// What is held of the report; none if nothing is asked of it.
    pub report: Option<&'a NeedSet>,
}

impl<T: Scalar> Compiled<T> {
    pub(super) fn new(system: &dyn ErasedSystem<T>, effects: &Effects, mode: &Mode) -> Self {
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
            own: Constants::load(
                system,
                &Held {
                    needs: &held,
                    branches: &mode.branches,
                },
            ),
            constant_needs: held,
            pinned: Vec::new(),
            constants: Vec::new(),
            plan: Plan::default(),
            spare: Plan::default(),
            solver: Solver::default(),
            factored: false,
            outdated: false,
            emitted: Emitted::of(system, effects, mode),
            refused: false,
            interpreted: Vec::new(),
            rows: None,
        };
        compiled.set_numbers(system, effects);
        compiled.reserve(d);
        compiled
    }

    /// Constants and plan of a system.
    fn set_numbers(&mut self, system: &dyn ErasedSystem<T>, effects: &Effects) {
        let d = system.description();
        let held = Held {
            needs: &self.constant_needs,
            branches: &self.mode.branches,
        };
        self.own.evaluate(system, &mut self.constants);
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

    /// Takes the present parameters, if they have changed. Interpreted equations take them when they are selected.
    pub(super) fn renew(&mut self, system: &dyn ErasedSystem<T>, effects: &Effects) {
        if !core::mem::take(&mut self.outdated) {
            return;
        }
        self.restart();
        core::mem::swap(&mut self.plan, &mut self.spare);
        self.set_numbers(system, effects);
        self.factored = false;
        if self.plan.is_like(&self.spare) {
            let interpreted = self.interpreted.iter_mut().chain(&mut self.rows);
            interpreted.for_each(Interpreted::outdate);
        } else {
            self.interpreted.clear();
            self.rows = None;
            self.reserve(system.description());
        }
    }

    /// Undoes [`Self::refuse_functions`]: one motion must not depend on those before it.
    pub(super) fn restart(&mut self) {
        self.refused = false;
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

    /// The interpreted equations in use, if they have been loaded.
    #[inline]
    pub(super) fn interpreted(&self) -> Option<&Interpreted<T>> {
        self.interpreted.first()
    }

    /// The parts that an evaluation by the interpreter works with.
    #[inline]
    pub(super) fn parts(&mut self) -> (&Plan<T>, &mut Solver<T>, &mut Interpreted<T>) {
        (&self.plan, &mut self.solver, &mut self.interpreted[0])
    }

    /// What projections evaluate: inertia, Jacobians and residuals of the rows that act. `numbers` is memory.
    pub(super) fn rows(
        &mut self,
        system: &dyn ErasedSystem<T>,
        numbers: &mut Vec<T>,
    ) -> &mut Interpreted<T> {
        let mut rows = self.rows.take();
        let renewed = rows.take_if(|rows| rows.renew(system, self, numbers));
        let rows = renewed.unwrap_or_else(|| {
            let no_series = NeedSet::new(system.description());
            let asked = Asked {
                held: &self.row_needs,
                extra: &no_series,
                report: None,
            };
            Interpreted::load(system, self, &asked, numbers)
        });
        self.rows.insert(rows)
    }

    /// Leaves the equations to the interpreter and the linear systems to the solver from now on.
    pub(super) fn refuse_functions(&mut self) {
        self.refused = true;
    }

    /// Makes the interpreted equations for what is asked current, with the numbers of the present parameters. `numbers` is memory.
    pub(super) fn select(
        &mut self,
        system: &dyn ErasedSystem<T>,
        asked: &Asked,
        numbers: &mut Vec<T>,
    ) {
        let mut list = core::mem::take(&mut self.interpreted);
        let found = list
            .iter_mut()
            .position(|one| one.is_for(asked) && one.renew(system, self, numbers));
        match found {
            // The one used last comes first.
            Some(index) => list[..=index].rotate_right(1),
            None => {
                list.truncate(MOST_INTERPRETED - 1);
                list.insert(0, Interpreted::load(system, self, asked, numbers));
            }
        }
        self.interpreted = list;
    }
}
