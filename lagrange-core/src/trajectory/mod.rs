//! The result of a run: the motion as polynomials in time, the modes, the events, the work done.

mod by_handle;
mod debug;
mod display;
mod energy;
mod estimate;
mod event;
mod ledger;
mod owner;
mod sampler;

pub use crate::handle::Subject;
pub use crate::modes::impact::OtherImpact;
pub use crate::state::{Starts, State};
pub use energy::Energies;
pub use estimate::{Difference, Estimate, Parting, Summary};
pub(crate) use event::Around;
pub use event::{Event, EventKind};
pub use ledger::{Entry, Ledger};
pub use sampler::{Instant, Sampler};
pub(crate) use sampler::{instant, report_everything};

use crate::arithmetic::Scalar;
use crate::declaration::Declaration;
use crate::derivation::Derivation;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::CoordinateId;
use crate::integrate::least_size;
use crate::integrate::{Method, StepPolynomial, horner};
use crate::mode::Mode;
use crate::monitor::Monitor;
use crate::pool::Pool;
use crate::system::Erased;
use crate::system::{Description, Impacts};
use core::ops::Range;

/// What a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of the equations of motion as values.
    pub evaluations: usize,
    /// Evaluations as Taylor series.
    pub series: usize,
    /// Factorizations of the constrained system.
    pub factorizations: usize,
    /// Projections onto the constraints that changed the state.
    pub projections: usize,
}

/// What was asked of a run.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    /// Relative and absolute.
    pub tolerance: f64,
    /// Per coordinate, the size below which its errors are absolute; empty: 1 for all.
    pub sizes: Vec<f64>,
    /// The method.
    pub method: Method,
    /// How contacts are solved that are hit together.
    pub impacts: Impacts,
}

/// A time interval in one mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    /// Begin, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// The mode.
    pub mode: Mode,
}

/// One accepted step: polynomials in s = (t − t₀)/h, valid for s in [0, end].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment<T> {
    /// t₀
    pub t: T,
    /// h
    pub h: T,
    /// Part of the step that was used.
    pub end: T,
    /// Degree of the polynomials.
    pub degree: usize,
    /// Index of the first coefficient; positions of all coordinates, then velocities.
    pub offset: usize,
    /// Index into the modes.
    pub mode: usize,
    /// Whether rows depended on others where it began, and were held aside in all of it.
    pub holds_rows_aside: bool,
}

/// The motion of a system over a time interval: polynomials in time, modes, events, work. It is that of any system with numbers `T`.
///
/// `{}` tells its events, a line for each; `{:?}` is a summary.
#[derive(Clone)]
pub struct Trajectory<T: Scalar = f64> {
    pub(crate) system: Erased<T>,
    pub(crate) effects: Effects,
    /// What was asked of the run.
    pub(crate) asked: Asked,
    /// Whether the polynomials of the steps are kept; if not, a segment is a whole phase, and its polynomial the state with which it begins.
    pub(crate) recorded: bool,
    pub(crate) first_time: T,
    pub(crate) last_time: T,
    pub(crate) start: State<T>,
    pub(crate) last: State<T>,
    pub(crate) modes: Pool<Mode>,
    pub(crate) segments: Vec<Segment<T>>,
    pub(crate) coefficients: Vec<T>,
    pub(crate) events: Pool<Event<T>>,
    pub(crate) work: Work,
    /// When steps were bounded by stability.
    pub(crate) stiff: Vec<Range<f64>>,
    pub(crate) estimate: Option<Estimate>,
    /// Who sees how far the books have been drawn up.
    pub(crate) monitor: Option<Monitor>,
}

impl<T: Scalar> Trajectory<T> {
    pub(crate) fn new(system: &Erased<T>, effects: &Effects, recorded: bool, asked: Asked) -> Self {
        let (time, state) = (T::default(), State::default());
        Self {
            system: system.clone(),
            effects: effects.clone(),
            asked,
            recorded,
            first_time: time,
            last_time: time,
            last: state.clone(),
            start: state,
            modes: Pool::default(),
            segments: Vec::new(),
            coefficients: Vec::new(),
            events: Pool::default(),
            work: Work::default(),
            stiff: Vec::new(),
            estimate: None,
            monitor: None,
        }
    }

    /// Begins anew.
    pub(crate) fn begin(&mut self, time: T, start: &State<T>, mode: &Mode) {
        self.first_time = time;
        self.last_time = time;
        self.start.clone_from(start);
        self.last.clone_from(start);
        self.modes.clear();
        self.modes.push(mode);
        self.segments.clear();
        self.coefficients.clear();
        self.events.clear();
        self.work = Work::default();
        self.stiff.clear();
        self.estimate = None;
    }

    /// Appends a step, valid up to `end` of its length.
    pub(crate) fn push(&mut self, step: &StepPolynomial<T>, end: T, holds_rows_aside: bool) {
        let mode = self.modes.len() - 1;
        if !self.recorded {
            // A step of no length may end in an impact, after which the same mode begins with other velocities.
            let phase = self.segments.last_mut();
            let goes_on = |phase: &&mut Segment<T>| phase.mode == mode && phase.h.value() > 0.0;
            if let Some(phase) = phase.filter(goes_on) {
                phase.h = step.time(end) - phase.t;
                return;
            }
        }
        let (h, end, degree) = match self.recorded {
            true => (step.h, end, step.degree),
            false => (step.time(end) - step.t, num_traits::one(), 0),
        };
        let offset = self.coefficients.len();
        for polynomials in [&step.q, &step.v] {
            match self.recorded {
                true => self.coefficients.extend_from_slice(polynomials),
                false => {
                    let starts = polynomials.iter().step_by(step.degree + 1);
                    self.coefficients.extend(starts);
                }
            }
        }
        self.segments.push(Segment {
            t: step.t,
            h,
            end,
            degree,
            offset,
            mode,
            holds_rows_aside,
        });
    }

    /// Makes `dynamics`, which is in the mode of a segment, leave those rows aside that the run did: the ones that depend on others where
    /// the segment begins. Within it, where constraints hold to a tolerance only, they seem to be independent. `scratch` is overwritten.
    pub(crate) fn hold_rows_aside(
        &self,
        segment: &Segment<T>,
        dynamics: &mut Dynamics<T>,
        State { q, v, .. }: &mut State<T>,
    ) {
        dynamics.hold_rows_aside(false);
        if segment.holds_rows_aside {
            self.state_at(segment, num_traits::zero(), q, v);
            let known = dynamics.value_along(segment.t, q, v).is_ok();
            dynamics.hold_rows_aside(known);
        }
    }

    /// The state at part `s` of a segment whose rows `dynamics` leaves aside. Rows that depend on one another agree, and their forces
    /// exist, on the constraints only, so that it is moved onto them.
    pub(crate) fn place(
        &self,
        segment: &Segment<T>,
        s: T,
        dynamics: &mut Dynamics<T>,
        State { q, v, .. }: &mut State<T>,
    ) -> Result<(), EvaluationError> {
        self.state_at(segment, s, q, v);
        if segment.holds_rows_aside {
            dynamics.project(segment.t + segment.h * s, q, v, 0.0)?;
        }
        Ok(())
    }

    /// How much memory the motion takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.coefficients[..]) + size_of_val(&self.segments[..])
    }

    /// Enters a mode, if it is another one.
    pub(crate) fn enter(&mut self, mode: &Mode) {
        if self.modes.last() != Some(mode) {
            self.modes.push(mode);
        }
    }

    /// Whether the motion between the events is known.
    ///
    /// # Errors
    /// It is not: [`record(false)`](crate::Simulation::record) was asked for.
    pub fn check_recorded(&self) -> Result<(), Error> {
        if self.recorded {
            self.check_dimension()
        } else {
            Err(Error::NotRecorded)
        }
    }

    /// Whether the states are those of the system: not where a run was refused because its start is not.
    fn check_dimension(&self) -> Result<(), Error> {
        let n = self.description().coordinates.len();
        self.start.check_dimension(n)
    }

    /// The table of names and places of the system.
    pub fn description(&self) -> &'static Description {
        self.system.description()
    }

    /// What was declared.
    pub fn declaration(&self) -> &'static Declaration {
        self.system.declaration()
    }

    /// What was derived from it, in words.
    pub fn derivation(&self) -> &'static Derivation {
        self.system.derivation()
    }

    /// Value of parameter `index` of the description.
    pub fn parameter(&self, index: usize) -> T {
        self.system.parameter(index)
    }

    /// The equations of motion of the system, with the effects that took part and all contacts open.
    pub fn dynamics(&self) -> Dynamics<T> {
        Dynamics::of(self.system.clone(), &self.effects)
    }

    /// The effects that took part.
    pub fn effects(&self) -> &Effects {
        &self.effects
    }

    /// Relative and absolute tolerance that was asked for; with [`Simulation::error`](crate::Simulation::error) the one that was found, and of fixed
    /// steps, which follow none, the error.
    pub fn tolerance(&self) -> f64 {
        self.asked.tolerance
    }

    /// The same for a position or velocity of this coordinate near 0; differs where
    /// [`Simulation::absolute_tolerance`](crate::Simulation::absolute_tolerance) says so.
    pub fn absolute_tolerance(&self, coordinate: CoordinateId) -> f64 {
        self.asked.tolerance * least_size(&self.asked.sizes, coordinate.0)
    }

    /// Method of integration that was asked for; where it has steps of fixed length, with the length that was found.
    pub fn method(&self) -> Method {
        self.asked.method
    }

    /// First time, s.
    pub fn first_time(&self) -> f64 {
        self.first_time.value()
    }

    /// Last time, s. Its derivatives, where an event ends the run, are those of [`Event::time`].
    pub fn last_time(&self) -> f64 {
        self.last_time.value()
    }

    /// State at the beginning.
    pub fn first_state(&self) -> &State<T> {
        &self.start
    }

    /// State at the end.
    pub fn final_state(&self) -> &State<T> {
        &self.last
    }

    /// Mode at the end.
    pub fn final_mode(&self) -> &Mode {
        &self.modes[self.modes.len() - 1]
    }

    /// Whether the mode of this segment is that at the end.
    fn ends_in_mode_of(&self, segment: usize) -> bool {
        self.modes[self.segments[segment].mode] == *self.final_mode()
    }

    /// What happened, in order.
    pub fn events(&self) -> &[Event<T>] {
        &self.events
    }

    /// How far off the run is, if that was asked for ([`Simulation::estimate`](crate::Simulation::estimate),
    /// [`Simulation::error`](crate::Simulation::error)).
    pub fn estimate(&self) -> Option<&Estimate> {
        self.estimate.as_ref()
    }

    /// What the run cost.
    pub fn work(&self) -> Work {
        self.work
    }

    /// When explicit steps were found to be bounded by stability, not by accuracy, s, in order: each time until the next switch, or until
    /// accuracy bounds them again. With [`Method::Auto`] Radau has made the steps of these intervals; with another method `Auto` or
    /// [`Method::Radau5`] would make far longer ones.
    pub fn stiff(&self) -> &[Range<f64>] {
        &self.stiff
    }

    /// The modes with their time intervals; the last one is an instant where the run ends with a switch.
    pub fn phases(&self) -> Vec<Phase> {
        let mut phases: Vec<Phase> = Vec::new();
        let mut last = None;
        // The sum of a step's start and length may be rounded to a time after its end.
        let ends = self.step_times().skip(1).chain([self.last_time()]);
        for (segment, to) in self.segments.iter().zip(ends) {
            let mode = &self.modes[segment.mode];
            match phases.last_mut() {
                Some(phase) if last == Some(segment.mode) => phase.to = to,
                // The first step of a slip in space is of the same phase as those that follow.
                Some(phase)
                    if last.is_some_and(|last: usize| self.modes[last].has_incipient_slip())
                        && phase.mode == *mode =>
                {
                    phase.to = to
                }
                _ => phases.push(Phase {
                    from: segment.t.value(),
                    to,
                    mode: mode.under_way(),
                }),
            }
            last = Some(segment.mode);
        }
        if last.is_some() && !self.ends_in_mode_of(self.segments.len() - 1) {
            let (from, to) = (self.last_time(), self.last_time());
            let mode = self.final_mode().under_way();
            phases.push(Phase { from, to, mode });
        }
        phases
    }

    /// Where the accepted steps begin, s, in order.
    pub fn step_times(&self) -> impl Iterator<Item = f64> + '_ {
        self.segments.iter().map(|segment| segment.t.value())
    }

    /// Coefficients of a position (`which` = 0) or velocity (1) in a segment.
    pub(crate) fn polynomial(&self, segment: &Segment<T>, which: usize, coordinate: usize) -> &[T] {
        let n = self.description().coordinates.len();
        let width = segment.degree + 1;
        let begin = segment.offset + (which * n + coordinate) * width;
        &self.coefficients[begin..begin + width]
    }

    /// State at part `s` of a segment.
    pub(crate) fn state_at(&self, segment: &Segment<T>, s: T, q: &mut [T], v: &mut [T]) {
        for (which, out) in [q, v].into_iter().enumerate() {
            for (i, x) in out.iter_mut().enumerate() {
                *x = horner(self.polynomial(segment, which, i), s);
            }
        }
    }
}
