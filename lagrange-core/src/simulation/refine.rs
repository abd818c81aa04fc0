//! An error instead of a tolerance: a second run tells how far off the first is, and tighter ones follow until two agree.
//!
//! Let the second run have a hundredth of the tolerance. As long as errors fall with the tolerance, the difference of the two is
//! the error of the first, to a percent. Unlike defects that are carried along variational equations this needs nothing but to
//! run again: switches, impacts and accumulations are in it, and so is rounding, which the second run meets in another way.
//!
//! Where a run or a phase begins, steps grow as fast as a method lets them, which is the same at all tolerances, and free flight is exact whatever the
//! tolerance is. The second run is careful there, or it would make the same steps, the same error, and the same rounding, which chaos makes large.

use super::runner::Work;
use crate::arithmetic::{Scalar, epsilon};
use crate::error::Error;
use crate::integrate::Method;
use crate::mode::Mode;
use crate::precompiled::Runnable;
use crate::settings::{Goal, Settings};
use crate::trajectory::{Difference, Estimate, State, Summary, Trajectory};
use core::ops::Range;

/// Error of a second run over that of the first.
const TIGHTER: f64 = 0.01;

/// In units of the last place: below this only rounding is left of an error of the Taylor method.
const FINEST: f64 = 4.0;

/// The same for the other methods, whose estimates of their errors are differences of nearly equal sums.
const FINEST_SUM: f64 = 512.0;

/// Tolerance of what the run at the tightest one is compared with, over that.
const LOOSER: f64 = 10.0;

/// Runs whose tolerances differ by less than this factor differ by less than the error of either.
const APART: f64 = 4.0;

/// Looser than this a run within an error does not begin: it may miss what happens.
const LOOSEST: f64 = 1e-8;

/// Share of the error asked for that two runs may differ by: of the tighter one, which is the result, rounding may make as much
/// again.
const SHARE: f64 = 0.25;

/// A tolerance a hundred times tighter lets differences fall by more than this, or they are rounding.
const FALLS: f64 = 2.0;

/// After so many differences in a row that do not fall none will.
const PATIENCE: usize = 2;

impl Settings {
    /// The same for a plain run whose error is `factor` times as large, as far as that goes, with other steps in any case: of two runs to be compared
    /// one is careful.
    fn finer<T: Scalar>(&self, factor: f64) -> Settings {
        let mut finer = Settings {
            goal: Goal::Tolerance,
            careful: !self.careful && !self.method.has_fixed_steps(),
            ..self.clone()
        };
        match &mut finer.method {
            Method::RungeKutta4 { step } => *step *= factor.powf(1.0 / 4.0),
            Method::Gauss6 { step } => *step *= factor.powf(1.0 / 6.0),
            _ => {
                let finest = self.finest::<T>().min(self.tolerance);
                let tolerance = self.tolerance * factor;
                // What is left to the finest is decent or nothing.
                finer.tolerance = match tolerance < APART * finest {
                    true => finest,
                    false => tolerance,
                };
            }
        }
        finer
    }

    /// Below this tolerance only rounding is left.
    fn finest<T: Scalar>(&self) -> f64 {
        let units = match self.method {
            Method::Auto | Method::Taylor => FINEST,
            _ => FINEST_SUM,
        };
        units * epsilon::<T>()
    }

    /// What the first run within an error is made with.
    fn first<T: Scalar>(&self, error: f64) -> Settings {
        let tolerance = TIGHTER * error.min(LOOSEST);
        Settings {
            goal: Goal::Tolerance,
            tolerance: tolerance.max(self.finest::<T>() / TIGHTER),
            ..self.clone()
        }
    }

    /// What a run is compared with: one at a tighter tolerance, or a looser one where there is no tighter.
    fn second<T: Scalar>(&self) -> Settings {
        let tighter = self.finer::<T>(TIGHTER);
        let second = match tighter.is_tighter_than(self) {
            true => tighter,
            false => self.finer::<T>(LOOSER),
        };
        Settings {
            // Its events and its end are compared.
            record: false,
            ..second
        }
    }

    /// How far off a run is that differs so much from one with these settings.
    fn estimate(&self, difference: Difference) -> Estimate {
        Estimate {
            method: self.method,
            tolerance: self.tolerance,
            difference,
        }
    }

    /// Whether a run with these settings is so much more exact than one with the others that what they differ by is the error of that.
    fn is_tighter_than(&self, other: &Settings) -> bool {
        self.method != other.method || APART * self.tolerance <= other.tolerance
    }
}

impl<T: Runnable> Work<T> {
    /// Runs as asked, given away piece by piece, and once more to see how far off that is.
    pub(super) fn run_twice(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        bytes: usize,
        take: &mut dyn FnMut(&Trajectory<T>),
    ) -> Result<(), Error> {
        let mut events = Vec::new();
        self.execute(start, span.clone(), bytes, &mut |piece| {
            events.extend(Summary::of(piece).events);
            take(piece);
        })?;
        let mut first = Summary::of(&self.trajectory);
        events.append(&mut first.events);
        first.events = events;
        let settings = self.settings.second::<T>();
        let (second, outcome) = self.another(&settings, start, span);
        if let Err(error @ Error::Interrupted { .. }) = outcome {
            return Err(error);
        }
        let mut difference = first.compare(&Summary::of(&second.trajectory));
        if let Err(error) = outcome {
            difference.ends(second.trajectory.last_time(), &error);
        }
        self.trajectory.estimate = Some(settings.estimate(difference));
        Ok(())
    }

    /// Runs at tighter and tighter tolerances until two in a row agree to `error`; the trajectory is that of the last one.
    pub(super) fn run_within(
        &mut self,
        error: f64,
        start: &State<T>,
        span: Range<f64>,
    ) -> Result<(), Error> {
        let outcome = self.tighten(error, start, span);
        if self.settings.method.has_fixed_steps() {
            // They have been chosen for the error, not for a tolerance: nobody has asked for more between their ends.
            let asked = &mut self.trajectory.asked.tolerance;
            *asked = asked.max(error);
        }
        outcome
    }

    fn tighten(&mut self, error: f64, start: &State<T>, span: Range<f64>) -> Result<(), Error> {
        if !(1e-15..=0.1).contains(&error) {
            let mut state = start.clone();
            state.name(self.trajectory.description());
            let mode = Mode::open(self.trajectory.description());
            let time = T::from_f64(span.start);
            self.trajectory.begin(time, &state, &mode);
            return Err(Error::Argument {
                what: "error",
                value: error,
                expected: "between 1e-15 and 0.1",
            });
        }
        let mut settings = self.settings.first::<T>(error);
        let (mut first, outcome) = self.another(&settings, start, span.clone());
        core::mem::swap(&mut self.trajectory, &mut first.trajectory);
        outcome?;
        let (mut factor, mut best, mut stays) = (TIGHTER, f64::INFINITY, 0);
        // The largest difference since they fall no longer: one of them may be small by chance, and other runs would not have it.
        let mut largest = f64::INFINITY;
        loop {
            let finer = settings.finer::<T>(factor);
            let (mut next, mut refusal) = (None, None);
            if stays < PATIENCE && finer.is_tighter_than(&settings) {
                match self.another(&finer, start, span.clone()) {
                    (work, Ok(())) => next = Some(work),
                    (_, Err(error @ Error::Interrupted { .. })) => return Err(error),
                    (_, Err(error)) => refusal = Some(error),
                }
            }
            let Some(mut next) = next else {
                let mut possible = largest / SHARE;
                if stays < PATIENCE && refusal.as_ref().is_none_or(is_for_rounding) {
                    // What the last run differs by is the error of the one before, which may have been far looser.
                    let looser = settings.finer::<T>(LOOSER);
                    let (near, outcome) = self.another(&looser, start, span.clone());
                    let difference = near.difference(self);
                    let apart = difference.error();
                    // It is more exact than that, for as long as differences fall.
                    if outcome.is_ok() && apart * FALLS <= best {
                        self.trajectory.estimate = Some(looser.estimate(difference));
                        if apart <= error {
                            return Ok(());
                        }
                        possible = apart;
                    }
                }
                let estimate = self.trajectory.estimate();
                let reason = match (refusal, estimate) {
                    (Some(cause), _) => format!("the next run ends early: {cause}"),
                    (None, Some(Estimate { difference, .. })) => {
                        let why = match stays == PATIENCE {
                            true => of_rounding(largest, &settings),
                            false => of_tolerance(difference.error(), &settings),
                        };
                        reason(difference, &why)
                    }
                    (None, None) => String::new(),
                };
                return Err(Error::Inexact {
                    asked: error,
                    possible,
                    reason,
                });
            };
            let difference = next.difference(self);
            let apart = difference.error();
            (stays, largest) = match apart * FALLS > best {
                true if best.is_finite() => (stays + 1, largest.max(apart)),
                _ => (0, apart),
            };
            best = best.min(apart);
            core::mem::swap(&mut self.trajectory, &mut next.trajectory);
            self.trajectory.estimate = Some(settings.estimate(difference));
            if apart <= SHARE * error {
                return Ok(());
            }
            factor = match stays {
                0 => (SHARE * error / apart).clamp(TIGHTER * TIGHTER, TIGHTER),
                // Where steps only round, far shorter ones round far more.
                _ => TIGHTER,
            };
            settings = finer;
        }
    }

    /// A plain run with other settings, in memory of its own.
    fn another(
        &self,
        settings: &Settings,
        start: &State<T>,
        span: Range<f64>,
    ) -> (Self, Result<(), Error>) {
        let mut work = Self::new(self.trajectory.system.clone(), settings);
        let outcome = work.run_once(start, span);
        (work, outcome)
    }

    fn difference(&self, other: &Self) -> Difference {
        Summary::of(&self.trajectory).compare(&Summary::of(&other.trajectory))
    }
}

/// Whether a run has ended early because rounding does not let it be as exact as its tolerance asks for.
fn is_for_rounding(error: &Error) -> bool {
    matches!(error, Error::Singular { .. } | Error::StepTooSmall { .. })
}

/// Why runs do not agree, and what would help: that they part, or how far off what differs is, and `why`.
fn reason(difference: &Difference, why: &str) -> String {
    if let Some(parting) = &difference.parting {
        return format!("the last two runs part at {parting}; end before that");
    }
    let what = match difference.event_error {
        Some(error) if error > difference.state_error => "the times of events differ".to_owned(),
        _ => format!("`{}` differs", difference.coordinate),
    };
    format!("{what} by {why}")
}

/// The part of a reason where runs are as exact as numbers are.
fn of_rounding(apart: f64, settings: &Settings) -> String {
    if settings.method.has_fixed_steps() {
        return format!(
            "{apart:.1e} however short the steps are, each of which rounds; end earlier, ask for less, or take the default method, `auto`, \
             which makes fewer of them"
        );
    }
    let growth = (apart / f64::EPSILON).max(1.0).ln();
    format!(
        "{apart:.1e} however tight the tolerance is, from rounding that grows by e^{growth:.0}; end earlier, or ask \
         for less"
    )
}

/// The same where the method has no tighter tolerance.
fn of_tolerance(error: f64, settings: &Settings) -> String {
    let help = match settings.method {
        Method::Auto | Method::Taylor => "end earlier, or ask for less",
        _ => "the default method, `auto`, goes further",
    };
    let tightest = settings.tolerance;
    format!("{error:.1e} at {tightest:.1e}, the tightest tolerance that is tried; {help}")
}
