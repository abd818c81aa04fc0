//! Certificates: a finished run checked against its declaration, by nothing that produced it.
//!
//! [`Trajectory::verify`](crate::trajectory::Trajectory::verify) evaluates the energies, gaps, slips and forces as they were declared (`declaration`), without the
//! symbolic derivation, the emitted equations, the integrator and the logic of modes. Every check gives a figure without unit and
//! a bound. There are two kinds of bounds, and none is fitted to a run:
//!
//! * **Rounding.** What holds exactly at every instant (the equations of motion, the balance of an impact, reported energies)
//!   is compared with the sum of the absolute values of its terms. The bound is 2¹² units in the last place: each of the
//!   operations of the declaration rounds once, and solving a linear system loses a few digits.
//! * **Tolerance.** What an integration only approximates is compared with the change that it makes when each position and
//!   velocity x changes by 1 + |x|, the scale on which the tolerance is asked (or by what its own absolute tolerance says instead of 1). Such a figure is the error of the state in units in
//!   which the integrator keeps it below the tolerance, step by step. The bound is [`MARGIN`] times the tolerance, because error
//!   estimates only estimate. For forces the scale is the sum of the absolute values of the forces that balance.

mod equations;
mod impact;
mod instant;
mod joins;
mod jumps;
mod motion;
mod quadrature;
mod sizes;
mod step;
mod step_error;
#[cfg(test)]
mod tests;
mod watch;

pub(crate) use motion::verify;

use core::fmt;

/// Bounds that depend on the tolerance are this many times the tolerance.
pub const MARGIN: f64 = 16.0;

/// No run is held to less than this, the size of rounding errors of a state.
const FINEST: f64 = 1e-14;

/// Bounds of rounding are this many units in the last place.
const ROUNDINGS: f64 = 4096.0;

/// Numbers that are smaller lose digits: what has decayed so far is zero.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// What a check is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// d/dt ∂L/∂v − ∂L/∂q = Q + Σ λ∇g with the reported accelerations and forces.
    Equations,
    /// The reported accelerations keep constraints, closed contacts and sticking frictions.
    Rows,
    /// Reported energies are those declared.
    Energies,
    /// Positions and velocities over a step are the integrals of velocities and accelerations.
    Motion,
    /// Energies do not jump within a step.
    Jumps,
    /// Steps and modes join without jumps.
    Joins,
    /// Constraints hold, and so do their rates.
    Constraints,
    /// Gaps of closed contacts vanish, and so do their rates.
    Closed,
    /// Gaps are not negative.
    Gaps,
    /// Normal forces are not negative.
    NormalForces,
    /// A sticking friction stays within its cone.
    Cones,
    /// A sticking friction does not slip, and one that slips does so in its direction.
    Slips,
    /// A slipping friction is −μk N s/|s|.
    Sliding,
    /// What is open, inactive or left out exerts no force.
    Idle,
    /// M (v⁺ − v⁻) = Σ aᵀΛ at impacts.
    Impulses,
    /// Restitution, friction and constraints at impacts.
    Impacts,
    /// An impact adds no energy.
    Dissipation,
    /// No stop has become true without ending the run.
    Stops,
    /// Every mark that was passed is logged.
    Marks,
}

impl Subject {
    /// All, in the order of a certificate.
    pub const ALL: [Subject; 19] = [
        Subject::Equations,
        Subject::Rows,
        Subject::Energies,
        Subject::Motion,
        Subject::Jumps,
        Subject::Joins,
        Subject::Constraints,
        Subject::Closed,
        Subject::Gaps,
        Subject::NormalForces,
        Subject::Cones,
        Subject::Slips,
        Subject::Sliding,
        Subject::Idle,
        Subject::Impulses,
        Subject::Impacts,
        Subject::Dissipation,
        Subject::Stops,
        Subject::Marks,
    ];

    /// In a few words.
    pub fn words(self) -> &'static str {
        match self {
            Subject::Equations => "equations of motion",
            Subject::Rows => "accelerations keep constraints",
            Subject::Energies => "reported energies",
            Subject::Motion => "motion over steps",
            Subject::Jumps => "energies over steps",
            Subject::Joins => "steps join",
            Subject::Constraints => "constraints",
            Subject::Closed => "closed contacts",
            Subject::Gaps => "gaps",
            Subject::NormalForces => "normal forces",
            Subject::Cones => "friction that sticks",
            Subject::Slips => "slips",
            Subject::Sliding => "friction that slips",
            Subject::Idle => "forces of what does not act",
            Subject::Impulses => "balance of impacts",
            Subject::Impacts => "laws of impact",
            Subject::Dissipation => "energy of impacts",
            Subject::Stops => "stops",
            Subject::Marks => "marks",
        }
    }

    /// Whether its bound comes from rounding rather than from the tolerance.
    fn is_exact(self) -> bool {
        use Subject::*;
        matches!(self, Equations | Rows | Energies | Idle | Impulses)
    }
}

/// One check of a certificate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// What it is about.
    pub subject: Subject,
    /// The largest error found, relative to what it is measured by.
    pub figure: f64,
    /// What it may be; infinite where a method with fixed steps promises nothing.
    pub bound: f64,
    /// How often it was looked at.
    pub count: usize,
    /// When the error was largest, s.
    pub time: f64,
    /// The item or coordinate with the largest error.
    pub item: &'static str,
}

impl Check {
    /// Whether the figure is within the bound.
    pub fn holds(&self) -> bool {
        self.figure <= self.bound
    }

    /// The figure in units of the bound.
    pub fn share(&self) -> f64 {
        if self.bound == f64::INFINITY {
            0.0
        } else {
            self.figure / self.bound
        }
    }
}

/// A finished run checked against its declaration; see [`Trajectory::verify`](crate::trajectory::Trajectory::verify).
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The checks for which there was something to look at.
    pub checks: Vec<Check>,
    /// Tolerance that was asked of the run.
    pub tolerance: f64,
    /// Steps of the run, and how many of them were looked at.
    pub steps: usize,
    /// See [`Self::steps`].
    pub looked: usize,
    /// Steps within which constraints lose rank somewhere, so that there are no forces to be checked.
    pub unevaluated: usize,
}

impl Certificate {
    /// Whether every figure is within its bound.
    pub fn holds(&self) -> bool {
        self.checks.iter().all(Check::holds)
    }

    /// The check that comes closest to its bound, or lies farthest beyond.
    pub fn worst(&self) -> Option<&Check> {
        self.checks
            .iter()
            .max_by(|a, b| a.share().total_cmp(&b.share()))
    }
}

impl fmt::Display for Certificate {
    /// A sentence, and one more if there are steps that nothing can be said of.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let beyond = self.checks.iter().filter(|check| !check.holds()).count();
        let all = self.checks.len();
        match self.worst() {
            None => return f.write_str("Nothing is declared that could be checked."),
            Some(worst) if beyond == 0 => write!(
                f,
                "Certified: {all} checks at {} of {} steps, the nearest to its bound {} with {:.0} %.",
                self.looked,
                self.steps,
                worst.subject.words(),
                (100.0 * worst.share()).ceil(),
            )?,
            Some(worst) => write!(
                f,
                "Not certified: {beyond} of {all} checks beyond their bounds; {} {:.1e} instead of {:.1e} at t = {:.6} s ({}).",
                worst.subject.words(),
                worst.figure,
                worst.bound,
                worst.time,
                worst.item,
            )?,
        }
        match self.unevaluated {
            0 => Ok(()),
            steps => write!(
                f,
                " In {steps} of the steps constraints lose rank; their forces are not checked."
            ),
        }
    }
}

/// What is left of an error beyond what is explained; what is no number stays none.
fn beyond(error: f64, explained: f64) -> f64 {
    match error <= explained {
        true => 0.0,
        false => error - explained,
    }
}

/// What has been found so far.
#[derive(Debug)]
struct Findings {
    /// The tolerance of the run, but no less than rounding allows.
    tolerance: f64,
    checks: [Check; Subject::ALL.len()],
}

impl Findings {
    fn new(tolerance: f64, rounding: f64) -> Self {
        let check = |subject: Subject| Check {
            subject,
            figure: 0.0,
            bound: if subject.is_exact() {
                ROUNDINGS * rounding
            } else {
                MARGIN * tolerance
            },
            count: 0,
            time: 0.0,
            item: "",
        };
        Self {
            tolerance,
            checks: Subject::ALL.map(check),
        }
    }

    /// Books an error beside what it is measured by.
    fn book(&mut self, subject: Subject, error: f64, size: f64, time: f64, item: &'static str) {
        let check = &mut self.checks[subject as usize];
        check.count += 1;
        let figure = if error <= UNDERFLOW {
            0.0
        } else {
            error / size
        };
        // What is no number is worse than any number.
        let figure = if figure.is_nan() {
            f64::INFINITY
        } else {
            figure
        };
        if figure > check.figure || check.count == 1 {
            (check.figure, check.time, check.item) = (figure, time, item);
        }
    }
}
