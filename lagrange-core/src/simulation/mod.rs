//! A run: the system, what takes part in it, how exact it is to be.

mod ensemble;
mod refine;
mod runner;

pub use crate::dynamics::Equations;
pub use crate::settings::Awaited;
pub use crate::state::FixedComponents;
pub use ensemble::Ensemble;
pub use runner::Runner;

use crate::arithmetic::Scalar;
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::CoordinateId;
use crate::integrate::Method;
use crate::monitor::Monitor;
use crate::precompiled::Runnable;
use crate::settings::{Goal, Settings, is_single};
use crate::system::{Erased, Impacts, System};
use crate::trajectory::{Instant, State, Trajectory};
use core::borrow::Borrow;
use core::fmt;
use core::ops::Range;
use runner::Work;

/// How to run a system. Build it, set what differs from the defaults, call [`Simulation::run`].
#[derive(Debug)]
pub struct Simulation<'a, S: System> {
    scene: &'a S,
    settings: Settings,
}

// A derive would ask for systems that are `Clone`.
impl<S: System> Clone for Simulation<'_, S> {
    fn clone(&self) -> Self {
        Self {
            scene: self.scene,
            settings: self.settings.clone(),
        }
    }
}

/// A run that ended early, with everything up to there.
pub struct Failure<T: Scalar = f64> {
    /// Why.
    pub error: Error,
    /// The motion until then.
    pub trajectory: Box<Trajectory<T>>,
}

/// What `unwrap` shows: the sentence of the error, and how far the run came.
impl<T: Scalar> fmt::Debug for Failure<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Failure")
            .field("error", &format_args!("{}", self.error))
            .field("trajectory", &self.trajectory)
            .finish()
    }
}

impl<T: Scalar> fmt::Display for Failure<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl<T: Scalar> core::error::Error for Failure<T> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.error)
    }
}

impl<'a, S: System<Scalar: Runnable>> Simulation<'a, S> {
    /// All effects, [`Method::Auto`], tolerance 1e-9 (in single precision 1e-6).
    pub fn new(scene: &'a S) -> Self {
        Self {
            scene,
            settings: Settings {
                effects: Effects::all(),
                goal: Goal::Tolerance,
                tolerance: match is_single::<S::Scalar>() {
                    true => 1e-6,
                    false => 1e-9,
                },
                absolute: Vec::new(),
                sizes: Vec::new(),
                method: Method::Auto,
                careful: false,
                project_start: false,
                equations: Equations::Emitted,
                record: true,
                last_events: Vec::new(),
                impacts: None,
                max_events: 100_000,
                max_steps: 100_000_000,
                monitor: None,
            },
        }
    }

    /// Local error per step, relative and absolute (in the units of the coordinates); from 1e-17 to 0.1, in single precision
    /// from 1e-7.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.settings.tolerance = tolerance;
        self
    }

    /// Absolute tolerance of one coordinate, in its unit, and of its velocity, in its unit per second; it takes the place of what
    /// [`Self::tolerance`] says for numbers near 0, and of what [`Self::error`] says for numbers below 1. This is SciPy's array `atol`
    /// and ODEPACK's `ATOL(i)`. A coordinate in metres that moves by micrometres has one of its own.
    #[must_use]
    pub fn absolute_tolerance(mut self, coordinate: CoordinateId, tolerance: f64) -> Self {
        self.settings.absolute.push((coordinate, tolerance));
        self
    }

    /// Instead of a tolerance: the final state and the times of all events are to be within this error, relative for numbers
    /// above 1 and absolute (in their own units) below; from 1e-15 to 0.1.
    ///
    /// The run is made at tighter and tighter tolerances (shorter and shorter fixed steps) until two in a row differ by a quarter of
    /// the error. The result is the tighter one; [`Trajectory::estimate`](crate::trajectory::Trajectory::estimate) has the difference.
    /// Where runs do not agree so well however tight they are, the run ends with [`Error::Inexact`].
    #[must_use]
    pub fn error(mut self, error: f64) -> Self {
        self.settings.goal = Goal::Error(error);
        self
    }

    /// Whether the run is made a second time, at a hundredth of the tolerance, to see how far off it is:
    /// [`Trajectory::estimate`](crate::trajectory::Trajectory::estimate). Where [`Self::error`] is asked for, there is an estimate in any case.
    #[must_use]
    pub fn estimate(mut self, yes: bool) -> Self {
        self.settings.goal = match (self.settings.goal, yes) {
            (within @ Goal::Error(_), _) => within,
            (_, true) => Goal::Estimate,
            (_, false) => Goal::Tolerance,
        };
        self
    }

    /// The integration method.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.settings.method = method;
        self
    }

    /// Which effects take part.
    #[must_use]
    pub fn effects(mut self, effects: Effects) -> Self {
        self.settings.effects = effects;
        self
    }

    /// Whether a start that violates a constraint is moved onto it instead of refused.
    #[must_use]
    pub fn project_start(mut self, yes: bool) -> Self {
        self.settings.project_start = yes;
        self
    }

    /// What evaluates the equations of motion: the functions that the derive emitted, or an interpreter of the same equations,
    /// slower and with the same numbers to rounding. To compare the two.
    #[must_use]
    pub fn equations(mut self, equations: Equations) -> Self {
        self.settings.equations = equations;
        self
    }

    /// Whether the motion between the events is kept (it is unless this says no). Without it a trajectory has its events, its
    /// phases and its final state; sampling it and its ledger are [`Error::NotRecorded`].
    #[must_use]
    pub fn record(mut self, yes: bool) -> Self {
        self.settings.record = yes;
        self
    }

    /// Ends the run once this has happened: any event of an item, `MassOnWheel::FLOOR`, one of a kind, `(MassOnWheel::RIM,
    /// EventKind::Lost)`, or the fifth of a kind, `(Ball::FLOOR, EventKind::Impact, 5)`. Given several times, once all of them have.
    /// A run is refused if it is to end after event number 0, or after one that cannot happen to the item, or of an item that is left out.
    #[must_use]
    pub fn end_after(mut self, event: impl Into<Awaited>) -> Self {
        self.settings.last_events.push(event.into());
        self
    }

    /// How contacts are solved that are hit together, instead of what `impacts = …` declares.
    #[must_use]
    pub fn impacts(mut self, impacts: Impacts) -> Self {
        self.settings.impacts = Some(impacts);
        self
    }

    /// Most events of a run, marks among them, but for the one that ends it; with more it ends with [`Error::Limit`], and the log has what happened at
    /// that instant. Switches that change nothing are counted with them.
    #[must_use]
    pub fn max_events(mut self, limit: usize) -> Self {
        self.settings.max_events = limit;
        self
    }

    /// Most steps before the run ends with [`Error::Limit`].
    #[must_use]
    pub fn max_steps(mut self, limit: usize) -> Self {
        self.settings.max_steps = limit;
        self
    }

    /// Lets other threads see how far a run has come, and stop it.
    #[must_use]
    pub fn monitor(mut self, monitor: &Monitor) -> Self {
        self.settings.monitor = Some(monitor.clone());
        self
    }

    /// Integrates from `start`, a [`State`] or a reference to one, over `span` (s), or until a stop.
    ///
    /// # Errors
    /// A [`Failure`] with the error and the trajectory so far.
    pub fn run(
        &self,
        start: impl Borrow<State<S::Scalar>>,
        span: Range<f64>,
    ) -> Result<Trajectory<S::Scalar>, Failure<S::Scalar>> {
        let system = self.scene.erased().system;
        run_alone(system, &self.settings(), start.borrow(), span)
    }

    /// Everything that a run works with, made ready once for many runs.
    pub fn runner(&self) -> Runner<S> {
        Runner::new(self.scene, &self.settings())
    }

    /// Everything that many runs work with, several at a time.
    pub fn ensemble(&self) -> Ensemble<S> {
        Ensemble::new(self.scene, &self.settings())
    }

    fn settings(&self) -> Settings {
        let coordinates = self.scene.description().coordinates;
        self.settings.completed(coordinates.len())
    }

    /// The state nearest to `reference` (in the mass metric) that has the values in `fixed` exactly and satisfies all constraints.
    /// Contacts that are closed in `reference` stay closed, and frictions that stick in the motion that begins there stick, but for those
    /// that what is fixed lifts or moves.
    ///
    /// # Errors
    /// [`Error::Projection`] if there is none, with the row that cannot be satisfied; [`Error::Dimension`] if `reference`
    /// belongs to another system, [`Error::Argument`] if `fixed` does, and [`Error::Domain`] for what is not finite.
    pub fn consistent(
        &self,
        time: f64,
        reference: impl Borrow<State<S::Scalar>>,
        fixed: &FixedComponents<S::Scalar>,
    ) -> Result<State<S::Scalar>, Error> {
        self.runner().consistent(time, reference, fixed)
    }

    /// All modes in which the motion can go on from a state, with their accelerations and forces, the one that a run takes first;
    /// of modes with the same accelerations one. Where contacts are hit in this state, velocities and modes are those after the impact.
    ///
    /// A rod that leans and slides on its tip may stay or fly off (Painlevé 1895): then there are two.
    ///
    /// # Errors
    /// [`Error::NoMode`] if there is none, [`Error::Limit`] if more than 256 candidates would have to be tried, and what a run
    /// refuses in a start.
    pub fn feasible_modes(
        &self,
        time: f64,
        state: impl Borrow<State<S::Scalar>>,
    ) -> Result<Vec<Instant<S::Scalar>>, Error> {
        self.runner().feasible_modes(time, state)
    }
}

/// One run with a memory of its own. The type of the system is forgotten, so that this is compiled once for all.
fn run_alone<T: Runnable>(
    system: Erased<T>,
    settings: &Settings,
    start: &State<T>,
    span: Range<f64>,
) -> Result<Trajectory<T>, Failure<T>> {
    let mut work = Work::new(system, settings);
    let outcome = work.run(start, span);
    let trajectory = work.trajectory;
    match outcome {
        Ok(()) => Ok(trajectory),
        Err(error) => Err(Failure {
            error,
            trajectory: Box::new(trajectory),
        }),
    }
}
