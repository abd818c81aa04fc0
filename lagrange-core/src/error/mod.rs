//! What can go wrong at run time, with the numbers that say where.

mod sentences;

use crate::dynamics::EvaluationError;
pub use crate::dynamics::error::Level;
use crate::mode::Mode;
pub use crate::shortest::Shortest;
use crate::system::Description;

/// Why a run ended early, or could not begin.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A number that the caller gave is not usable.
    Argument {
        /// What it is for.
        what: &'static str,
        /// What was given.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// A number of the declaration is outside the domain in which it means something.
    Domain {
        /// Time, s.
        time: f64,
        /// The coordinate, contact, friction or field.
        item: &'static str,
        /// What the number is: `value` (of a field), `inertia`, `restitution`, `static friction`, `kinetic friction`, `position at the start`,
        /// `velocity at the start`, `absolute tolerance`.
        what: &'static str,
        /// The number.
        value: f64,
        /// What would do.
        expected: String,
        /// Fields that it is made of, with their values; of an inertia those that are negative.
        fields: Vec<(&'static str, f64)>,
    },
    /// The state has another number of coordinates than the system.
    Dimension {
        /// Number of coordinates of the system.
        expected: usize,
        /// Number given.
        found: usize,
    },
    /// The start does not satisfy a constraint.
    Start {
        /// Name of the constraint.
        item: &'static str,
        /// Level of the residual.
        level: Level,
        /// Its value, in the unit of the declaration.
        residual: f64,
        /// What is accepted.
        tolerance: f64,
    },
    /// The start is below the surface of a contact.
    Penetrates {
        /// Name of the contact.
        item: &'static str,
        /// Its gap, in the unit of the declaration.
        gap: f64,
        /// What is accepted.
        tolerance: f64,
    },
    /// No state near the one asked for satisfies all constraints.
    Projection {
        /// Time, s.
        time: f64,
        /// Largest residual left.
        residual: f64,
        /// Name of the row it belongs to.
        item: &'static str,
    },
    /// The equations of motion cannot be solved.
    Singular {
        /// Time, s.
        time: f64,
        /// The mode.
        mode: String,
        /// Names of the coordinates or rows concerned.
        items: Vec<&'static str>,
        /// Why.
        reason: String,
    },
    /// A quantity is not a finite number.
    NotFinite {
        /// Time, s.
        time: f64,
        /// The mode.
        mode: String,
        /// Which quantity.
        what: String,
        /// The item that makes it so, if one has no finite value itself.
        item: Option<&'static str>,
        /// Why.
        cause: NotFinite,
    },
    /// A gap, or the guard of a piecewise function, jumps below zero.
    Discontinuous {
        /// Time, s.
        time: f64,
        /// The contact, or the text of the guard.
        item: &'static str,
        /// Its value before the jump, in the unit of the declaration.
        before: f64,
        /// Its value after the jump.
        after: f64,
    },
    /// What a constraint, a closed contact or a friction that sticks holds at zero bends where a piecewise expression changes: velocities
    /// would have to jump there.
    Corner {
        /// Time, s.
        time: f64,
        /// The constraint, contact or friction.
        item: &'static str,
        /// Its rate just after, in the unit of the declaration per second; of a friction its slip.
        rate: f64,
    },
    /// A generalized momentum, or L itself, jumps where a piecewise expression in the energies changes: velocities would have to jump there.
    Kick {
        /// Time, s.
        time: f64,
        /// The condition that changes.
        condition: &'static str,
        /// The coordinate whose momentum ∂L/∂v jumps; `None`: L does, as at the step of a potential.
        momentum: Option<&'static str>,
        /// What jumps, before, in the unit of the declaration.
        before: f64,
        /// The same after.
        after: f64,
    },
    /// A contact is hit whose gap does not fall below zero but turns there, as the distance of two points does: the direction of its force is
    /// not known.
    Undirected {
        /// Time, s.
        time: f64,
        /// The contact.
        item: &'static str,
    },
    /// A stop or a mark asks for a force that the motion does not determine, where that has no value of its own: contacts or frictions bound how a load is
    /// shared, or forces act in directions that change.
    Undetermined {
        /// Time, s: the end of the step in which this is seen.
        time: f64,
        /// The stop or mark.
        item: &'static str,
        /// The mode.
        mode: String,
    },
    /// In dual numbers: a slip of two components begins, in a direction whose derivatives are not computed, and all of the motion after it
    /// has them.
    NoDerivatives {
        /// Time, s.
        time: f64,
        /// The friction.
        item: &'static str,
    },
    /// No mode continues the motion although all coefficients are legal (Painlevé's paradox, walls that meet).
    NoMode {
        /// Time, s.
        time: f64,
        /// The mode before.
        mode: String,
        /// The contact or friction concerned.
        item: &'static str,
        /// Number of modes that were tried.
        tried: usize,
        /// Whether frictions take part.
        friction: bool,
        /// Whether there are piecewise expressions, which may jump.
        branches: bool,
        /// A constraint that holds with any force while that contact is closed.
        held: Option<&'static str>,
    },
    /// No solution of an impact was found.
    NoImpact {
        /// Time, s.
        time: f64,
        /// The mode before.
        mode: String,
        /// A contact that is hit.
        item: &'static str,
        /// Number of combinations that were tried of contacts that take part and frictions that hold.
        tried: usize,
        /// Whether one is found without friction.
        friction: bool,
        /// Whether one is found by impacts in turn, where all were to be solved together.
        together: bool,
    },
    /// Impacts in turn do not come to an end at one instant.
    EndlessImpacts {
        /// Time, s.
        time: f64,
        /// A contact that still approaches.
        item: &'static str,
        /// Number of impacts that were followed.
        impacts: usize,
    },
    /// An impact would add energy although nothing supplies it.
    EnergyGain {
        /// Time, s.
        time: f64,
        /// A contact that is hit.
        item: &'static str,
        /// How much, J.
        gain: f64,
    },
    /// The step became too small to advance time.
    StepTooSmall {
        /// Time, s.
        time: f64,
        /// Step, s.
        step: f64,
        /// The mode.
        mode: String,
    },
    /// The normal force of a contact grows without bound: the friction on it jams.
    Unbounded {
        /// Time, s.
        time: f64,
        /// The mode.
        mode: String,
        /// The contact.
        item: &'static str,
        /// The force where the mode began, N for a gap in m.
        from: f64,
        /// The force at the last state.
        to: f64,
    },
    /// Fixed steps are too long to follow the motion.
    StepTooLarge {
        /// Time, s.
        time: f64,
        /// Step, s.
        step: f64,
        /// The mode.
        mode: String,
    },
    /// Modes alternate without time advancing.
    NoProgress {
        /// Time, s.
        time: f64,
        /// The last modes, newest last.
        modes: Vec<String>,
        /// The item that switched last.
        item: &'static str,
    },
    /// A limit of the simulation was reached.
    Limit {
        /// Time, s.
        time: f64,
        /// What was counted.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// The end of the run is more steps away than can ever be made.
    OutOfReach {
        /// Time, s.
        time: f64,
        /// The end that was asked for, s.
        end: f64,
        /// Steps that are missing, if the run goes on as it did; infinite where no number of them comes to the end.
        steps: f64,
        /// Steps that a run may take.
        limit: usize,
    },
    /// The error that was asked for cannot be had.
    Inexact {
        /// What was asked for.
        asked: f64,
        /// What can be had; infinite if nothing is certain about the end.
        possible: f64,
        /// Why, and what would help.
        reason: String,
    },
    /// It was stopped from outside ([`Monitor::stop`](crate::Monitor::stop)).
    Interrupted {
        /// Time, s.
        time: f64,
    },
    /// A time outside the trajectory was asked for.
    OutsideTrajectory {
        /// Time asked for, s.
        time: f64,
        /// First time, s.
        first: f64,
        /// Last time, s.
        last: f64,
    },
    /// Something was asked of the motion between the events of a run that did not record it.
    NotRecorded,
}

/// Why a quantity is not a finite number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotFinite {
    /// An expression leaves its domain.
    Domain,
    /// `exp`, `sinh` or `cosh` are so large that powers of them overflow.
    Exponential,
    /// What the motion is made of is so large or so small that products of it overflow.
    Range,
}

impl core::error::Error for Error {}

impl Error {
    /// Adds time, mode and names to what the equations of motion report.
    pub(crate) fn from_evaluation(
        error: EvaluationError,
        time: f64,
        mode: &Mode,
        description: &'static Description,
    ) -> Error {
        let mode = mode.display(description).to_string();
        let item = error.item(description);
        let turns = |name: &str| {
            let mut frictions = description.frictions.iter();
            frictions.any(|friction| friction.name == name && friction.components > 1)
        };
        match error {
            root if root.is_of_root() && item.is_some_and(turns) => Error::Singular {
                time,
                mode,
                items: item.into_iter().collect(),
                reason: format!(
                    "{root}, and `norm(slip)` of a slip of two components that begins as `sqrt(dot(slip, slip) + v0^2)`, with a small speed v0"
                ),
            },
            EvaluationError::NotFiniteAcceleration { .. }
            | EvaluationError::NotFiniteForce { .. } => {
                let what = format!(
                    "the acceleration or force of `{}`",
                    item.unwrap_or(description.name)
                );
                Error::NotFinite {
                    time,
                    mode,
                    what,
                    item: None,
                    cause: NotFinite::Domain,
                }
            }
            EvaluationError::Projection { residual, .. } => Error::Projection {
                time,
                residual,
                item: item.unwrap_or(description.name),
            },
            other => Error::Singular {
                time,
                mode,
                items: item.into_iter().collect(),
                reason: other.to_string(),
            },
        }
    }
}
