//! What a program calls of the core, compiled once for `f64`.
//!
//! Everything here is generic over the scalar, so that a program would compile all of it once more for itself. The table of `f64`
//! is made in this crate: programs that run on it call what is compiled already. Another scalar is compiled where it is used, since
//! each takes as long as this whole crate.

use crate::arithmetic::{Dual, Scalar};
use crate::certificate::{self, Certificate};
use crate::dynamics::{Dynamics, EvaluationError, Packets};
use crate::effects::Effects;
use crate::error::Error;
use crate::integrate::Acceleration;
use crate::run::Run;
use crate::run::lockstep::{Member, go_on};
use crate::settings::Settings;
use crate::state::{FixedComponents, State};
use crate::system::Erased;
use crate::system::System;
use crate::trajectory::{Event, Instant, Ledger, Sampler, Trajectory};
use core::fmt;
use core::ops::Range;
use std::sync::Arc;

/// A scalar that runs are made of.
///
/// The functions that a run consists of are called through a table, which this crate has for `f64`. For a scalar of one's
/// own an empty implementation will do: the table is made where it is used.
pub trait Runnable: Scalar {
    /// The functions for this scalar.
    #[doc(hidden)]
    fn functions() -> &'static Functions<Self> {
        &const { Functions::OWN }
    }
}

impl Runnable for f64 {
    // Not inlined: what it names is compiled here, once.
    #[inline(never)]
    fn functions() -> &'static Functions<Self> {
        &const { Functions::OWN }
    }
}

impl Runnable for f32 {}

impl<T: Runnable, const N: usize> Runnable for Dual<T, N> {}

/// The functions of one scalar.
pub struct Functions<T: Scalar> {
    pub(crate) run: fn(Erased<T>, &Settings) -> Run<T>,
    pub(crate) execute: Execute<T>,
    pub(crate) launch: Launch<T>,
    pub(crate) go_on: fn(&mut Packets<T>, &mut [Member<'_, T>]),
    pub(crate) land: fn(&mut Run<T>, &mut Trajectory<T>),
    pub(crate) set_system: fn(&mut Run<T>, Erased<T>),
    pub(crate) consistent: Consistent<T>,
    pub(crate) feasible_modes: Feasible<T>,
    pub(crate) sampler: fn(&Trajectory<T>) -> Sampler<'_, T>,
    pub(crate) at: fn(&mut Sampler<'_, T>, f64) -> Result<Instant<T>, Error>,
    pub(crate) before: Beside<T>,
    pub(crate) after: Beside<T>,
    pub(crate) ledgers: Book<T>,
    pub(crate) verify: fn(&Trajectory<T>, u64, f64) -> Result<Certificate, Error>,
    pub(crate) dynamics: fn(Erased<T>, &Effects) -> Dynamics<T>,
    pub(crate) right_side: fn(&mut Dynamics<T>) -> &mut RightSide<T>,
}

type RightSide<T> = dyn Acceleration<T, Error = EvaluationError>;

type Launch<T> = fn(&mut Run<T>, &State<T>, Range<f64>, &mut Trajectory<T>) -> Result<(), Error>;
type Execute<T> = fn(
    &mut Run<T>,
    &State<T>,
    Range<f64>,
    &mut Trajectory<T>,
    usize,
    &mut dyn FnMut(&Trajectory<T>),
) -> Result<(), Error>;
type Book<T> = fn(&Trajectory<T>, Option<&[f64]>) -> Result<Vec<Ledger>, Error>;
type Beside<T> = fn(&mut Sampler<'_, T>, &Event<T>) -> Result<Instant<T>, Error>;
type Consistent<T> =
    fn(&mut Run<T>, f64, &State<T>, &FixedComponents<T>) -> Result<State<T>, Error>;
type Feasible<T> = fn(&mut Run<T>, f64, &State<T>) -> Result<Vec<Instant<T>>, Error>;

impl<T: Scalar> Functions<T> {
    /// The functions themselves.
    pub(crate) const OWN: Self = Self {
        run: Run::new,
        execute: Run::execute,
        launch: Run::launch,
        go_on,
        land: Run::land,
        set_system: Run::set_system,
        consistent: Run::consistent,
        feasible_modes: Run::feasible_modes,
        sampler: |record| Sampler::new(record),
        at: |sampler, t| sampler.evaluate_at(t),
        before: |sampler, event| sampler.evaluate_before(event),
        after: |sampler, event| sampler.evaluate_after(event),
        ledgers: Trajectory::book,
        verify: certificate::verify,
        dynamics: Dynamics::of,
        right_side: |dynamics| dynamics,
    };
}

impl<T: Scalar> fmt::Debug for Functions<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Functions").finish_non_exhaustive()
    }
}

impl<T: Runnable> Dynamics<T> {
    /// The equations of a scene with all contacts open.
    pub fn new<S: System<Scalar = T>>(scene: &S, effects: &Effects) -> Self {
        (T::functions().dynamics)(Arc::new(scene.copy()), effects)
    }

    /// The accelerations as an integrator calls them.
    pub fn right_side(&mut self) -> &mut dyn Acceleration<T, Error = EvaluationError> {
        (T::functions().right_side)(self)
    }
}

impl<T: Runnable> Trajectory<T> {
    /// Evaluates the trajectory at any time.
    pub fn sampler(&self) -> Sampler<'_, T> {
        (T::functions().sampler)(self)
    }

    /// Books the energy of the whole trajectory.
    ///
    /// # Errors
    /// [`Error::NotRecorded`]; or the equations of motion could not be evaluated somewhere on the way.
    pub fn ledger(&self) -> Result<Ledger, Error> {
        let ledgers = (T::functions().ledgers)(self, None)?;
        ledgers.into_iter().next().ok_or(Error::NotRecorded)
    }

    /// Books the energy from the beginning to each of `times`, s, in the order given; with impacts up to and at that time.
    /// Every ledger has the same entries.
    ///
    /// # Errors
    /// [`Error::OutsideTrajectory`], [`Error::NotRecorded`]; or the equations of motion could not be evaluated somewhere on
    /// the way.
    pub fn ledgers(&self, times: &[f64]) -> Result<Vec<Ledger>, Error> {
        (T::functions().ledgers)(self, Some(times))
    }

    /// Checks the run against the declaration, at instants chosen by `seed`: every step, its ends and what joins them, and
    /// every impact. It costs about as much as a few runs.
    ///
    /// # Errors
    /// [`Error::NotRecorded`].
    pub fn verify(&self, seed: u64) -> Result<Certificate, Error> {
        self.verify_share(seed, 1.0)
    }

    /// The same for the first step and a share of the others, 0 to 1, chosen by `seed`. How steps join, and impacts, are looked at in any case.
    ///
    /// # Errors
    /// [`Error::NotRecorded`]; [`Error::Argument`] if the share is none.
    pub fn verify_share(&self, seed: u64, share: f64) -> Result<Certificate, Error> {
        (T::functions().verify)(self, seed, share)
    }
}

impl<T: Runnable> Sampler<'_, T> {
    /// The motion at time `t`, s. At the instant of a switch: just after it.
    ///
    /// Derivatives are those at a fixed time. At [`Trajectory::last_time`] they are those at the end of the run, which moves with the event
    /// that ends it, as those of [`Trajectory::final_state`] are.
    ///
    /// # Errors
    /// [`Error::OutsideTrajectory`]; [`Error::NotRecorded`] but at the first and the last time of the run; or the equations of motion
    /// could not be evaluated there.
    pub fn at(&mut self, t: f64) -> Result<Instant<T>, Error> {
        (T::functions().at)(self, t)
    }

    /// The motion just before an event of this run, which need not be recorded for that: outputs, accelerations, energies, gaps.
    ///
    /// # Errors
    /// [`Error::Dimension`] for an event of another system; or the equations of motion could not be evaluated there.
    pub fn before(&mut self, event: &Event<T>) -> Result<Instant<T>, Error> {
        (T::functions().before)(self, event)
    }

    /// The same just after it. Of several events at one instant each has the mode that follows them all, and an impact the velocities
    /// that it leaves.
    ///
    /// # Errors
    /// Those of [`Self::before`].
    pub fn after(&mut self, event: &Event<T>) -> Result<Instant<T>, Error> {
        (T::functions().after)(self, event)
    }
}
