//! What can go wrong at run time, with the numbers that say where.

use crate::dynamics::EvaluationError;
pub use crate::dynamics::error::Level;
use crate::mode::Mode;
pub use crate::shortest::Shortest;
use crate::system::Description;
use core::fmt;

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
        /// Whether frictions take part.
        friction: bool,
        /// Whether several contacts are hit at once.
        several: bool,
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
        /// Steps that are missing, if the run goes on as it did.
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

/// A number with four digits, with an exponent where it is very small or very large.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.3e}");
    }
    let places = 3 - size.max(1e-3).log10().floor() as i32;
    let text = format!("{value:.*}", places.max(1) as usize);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Argument {
                what,
                value,
                expected,
            } => {
                write!(f, "{what} = {}: must be {expected}", Shortest(*value))
            }
            Error::Domain {
                time,
                item,
                what,
                value,
                expected,
                fields,
            } => {
                write!(
                    f,
                    "t = {}: `{item}`: {what} = {}",
                    Shortest(*time),
                    Shortest(*value)
                )?;
                for (k, (field, value)) in fields.iter().enumerate() {
                    let before = if k == 0 { " with " } else { ", " };
                    write!(f, "{before}`{field}` = {}", Shortest(*value))?;
                }
                write!(f, "; it must be {expected}")
            }
            Error::Dimension { expected, found } => {
                write!(
                    f,
                    "the state has {found} coordinates, the system {expected}"
                )
            }
            Error::Start {
                item,
                level,
                residual,
                tolerance,
            } => {
                let (level, what) = match level {
                    Level::Position => ("position", "positions"),
                    Level::Velocity => ("velocity", "velocities, `der(…)`,"),
                };
                write!(
                    f,
                    "the start violates `{item}`: {level} residual {} (accepted: {tolerance:.1e}); \
                     give {what} that satisfy it, or have the nearest ones taken (`--project`, in Rust `project_start(true)`)",
                    short(*residual)
                )
            }
            Error::Penetrates {
                item,
                gap,
                tolerance,
            } => write!(
                f,
                "the start is below the surface of `{item}`: gap {} (accepted: {:.1e}); begin above it, or have the \
                 nearest positions taken (`--project`, in Rust `project_start(true)`), or, for a body that hangs under a surface, let the \
                 contact's region (`where …`) leave that place out",
                short(*gap),
                -tolerance
            ),
            Error::Projection {
                time,
                residual,
                item,
            } => write!(
                f,
                "t = {}: no nearby state satisfies all constraints; `{item}` is left with residual {}; \
                 start nearer to the constraints or hold fewer values (what is at rest in the named start stays at rest)",
                Shortest(*time),
                short(*residual)
            ),
            Error::Singular {
                time,
                mode,
                items,
                reason,
            } => {
                write!(f, "t = {} ({mode}): {reason}", Shortest(*time))?;
                for (k, item) in items.iter().enumerate() {
                    write!(f, "{}`{item}`", if k == 0 { ": " } else { ", " })?;
                }
                Ok(())
            }
            Error::NotFinite {
                time,
                mode,
                what,
                cause,
            } => {
                write!(
                    f,
                    "t = {} ({mode}): {what} is not finite; ",
                    Shortest(*time)
                )?;
                f.write_str(match cause {
                    NotFinite::Exponential => {
                        "exp, sinh or cosh is so large here that a power of it overflows: write 1/cosh(z)^2 as \
                         1 - tanh(z)^2, and 1/(1 + exp(-z)) as (1 + tanh(z/2))/2"
                    }
                    NotFinite::Range => {
                        "masses, lengths or accelerations here are so large or so small that products of them are beyond all numbers: \
                         choose other units"
                    }
                    NotFinite::Domain => "the expression leaves its domain here",
                })
            }
            Error::Discontinuous {
                time,
                item,
                before,
                after,
            } => write!(
                f,
                "t = {}: `{item}` jumps from {} to {}; write it so that it is continuous, \
                 for example an angle as a coordinate instead of by atan2",
                Shortest(*time),
                short(*before),
                short(*after)
            ),
            Error::Corner { time, item, rate } => write!(
                f,
                "t = {}: the rate of `{item}` jumps to {} where a piecewise expression changes, or where what a root is \
                 taken of vanishes, and what velocities do at such a corner is not computed; round it, or write each side as a contact of its own",
                Shortest(*time),
                short(*rate)
            ),
            Error::Kick {
                time,
                condition,
                momentum,
                before,
                after,
            } => {
                let what = match momentum {
                    Some(coordinate) => format!("the momentum of `{coordinate}`"),
                    None => "the Lagrangian T - V".to_owned(),
                };
                write!(
                    f,
                    "t = {}: {what} jumps from {} to {} where `{condition}` changes, and what velocities do at \
                     such a kick is not computed; let it change over a distance or within a time, or declare what is hit as a contact",
                    Shortest(*time),
                    short(*before),
                    short(*after)
                )
            }
            Error::Undirected { time, item } => write!(
                f,
                "t = {}: the gap of `{item}` vanishes where it has no direction, as the distance of two points does; give them a \
                 size, for example sqrt(x^2 + y^2) >= radius",
                Shortest(*time)
            ),
            Error::NoDerivatives { time, item } => write!(
                f,
                "t = {}: the slip of `{item}` begins in a direction whose derivatives are not computed; take differences of two runs",
                Shortest(*time)
            ),
            Error::NoMode {
                time,
                mode,
                item,
                tried,
                friction,
                branches,
            } => {
                write!(
                    f,
                    "t = {} ({mode}): none of {tried} modes continues the motion at `{item}`; ",
                    Shortest(*time)
                )?;
                // Conditions are told as they are written; names have no blanks.
                if *branches && item.contains(' ') {
                    f.write_str("on either side of it the motion is driven back to the other, as by a controller that switches: let the force change over a short range, or declare one that jumps with the sign of a velocity as a friction; ")?;
                } else {
                    f.write_str(match friction {
                        true => "rigid friction may have no solution (Painlevé 1895): lower its coefficient or make the contact compliant; ",
                        false => "contacts that move may leave no room between them; ",
                    })?;
                    if *branches {
                        f.write_str("a force that jumps with the sign of a velocity is declared as a friction; one that jumps at the surface of a contact may push what touches away and let it fall back at once: let it change over a distance; ")?;
                    }
                }
                f.write_str("else ask for a smaller tolerance")
            }
            Error::NoImpact {
                time,
                mode,
                item,
                tried,
                friction,
                several,
            } => {
                write!(
                    f,
                    "t = {} ({mode}): no solution of the impact at `{item}` is found, in {tried} combinations of what takes part and what holds; ",
                    Shortest(*time)
                )?;
                f.write_str(match (friction, several) {
                    (false, _) => "contacts that move may leave no room between them",
                    (true, true) => "impacts in turn may have one (impacts = in_turn)",
                    (true, false) => "lower the friction or make the contact compliant",
                })
            }
            Error::EndlessImpacts {
                time,
                item,
                impacts,
            } => write!(
                f,
                "t = {}: `{item}` still approaches after {impacts} impacts in turn; lower the restitutions or solve \
                 impacts together",
                Shortest(*time)
            ),
            Error::EnergyGain { time, item, gain } => write!(
                f,
                "t = {}: the impact at `{item}` would add {} J; lower its restitution or its friction",
                Shortest(*time),
                short(*gain)
            ),
            Error::StepTooSmall { time, step, mode } => write!(
                f,
                "t = {} ({mode}): the step fell to {step:.1e} s; the motion is singular here or the tolerance is too tight",
                Shortest(*time)
            ),
            Error::Unbounded {
                time,
                mode,
                item,
                from,
                to,
            } => write!(
                f,
                "t = {} ({mode}): the force of `{item}` grows without bound, from {from:.3e} to {to:.3e}: rigid friction jams (Painlevé 1895); lower its \
                 coefficient or make the contact compliant",
                Shortest(*time)
            ),
            Error::StepTooLarge { time, step, mode } => write!(
                f,
                "t = {} ({mode}): a step of {step:.1e} s is too long to follow the motion; choose a smaller one",
                Shortest(*time)
            ),
            Error::NoProgress { time, modes, item } => write!(
                f,
                "t = {}: `{item}` keeps switching without time advancing; last modes: {}",
                Shortest(*time),
                modes.join(" → ")
            ),
            Error::Limit { time, what, limit } => {
                let advice = match *what {
                    "events" => " or raise the limit (`max_events`, `--max-events`)",
                    "steps" => " or raise the limit (`max_steps`)",
                    _ => "",
                };
                let one = what.strip_suffix('s').filter(|_| *limit == 1);
                let what = one.unwrap_or(what);
                write!(
                    f,
                    "t = {}: more than {limit} {what}; if this is intended, end the run earlier{advice}",
                    Shortest(*time)
                )
            }
            Error::OutOfReach {
                time,
                end,
                steps,
                limit,
            } => write!(
                f,
                "t = {}: the end, {end:e} s, is about {steps:.0e} steps away, and a run has at most {limit}; end it earlier",
                Shortest(*time)
            ),
            Error::Inexact {
                asked,
                possible,
                reason,
            } => {
                write!(f, "an error of {asked:e} cannot be had")?;
                if *possible < 0.1 {
                    // Two digits, not fewer than there are: a smaller one could be what was asked for.
                    let digit = 10_f64.powf(possible.log10().floor() - 1.0);
                    write!(f, ", one of {:.1e} can", (possible / digit).ceil() * digit)?;
                }
                write!(f, ": {reason}")
            }
            Error::Interrupted { time } => write!(f, "interrupted at t = {}", Shortest(*time)),
            Error::OutsideTrajectory { time, first, last } => {
                let [time, first, last] = [time, first, last].map(|t| Shortest(*t));
                write!(f, "t = {time} is outside the trajectory [{first}, {last}]")
            }
            Error::NotRecorded => {
                write!(
                    f,
                    "the run kept its events and its ends only; leave `record(false)` out"
                )
            }
        }
    }
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
