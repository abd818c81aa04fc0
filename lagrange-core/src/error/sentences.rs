//! Errors as sentences: where, what is wrong with which numbers, and what to do.

use super::{Error, Level, NotFinite, Shortest};
use core::fmt;

/// Times that are farther apart than this, s, leave steps no room.
const UNRESOLVED: f64 = 1e-8;

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

/// What a residual may be.
fn accepted(tolerance: f64) -> String {
    match tolerance == 0.0 {
        true => "0".to_owned(),
        false => format!("{tolerance:.1e}"),
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Argument {
                what,
                value,
                expected,
            } => write!(f, "{what} = {}: must be {expected}", Shortest(*value)),
            Error::Domain {
                time,
                item,
                what,
                value,
                expected,
                fields,
            } => write!(
                f,
                "t = {}: `{item}`: {what} = {}{}; it must be {expected}",
                Shortest(*time),
                Shortest(*value),
                made_of(fields)
            ),
            Error::Dimension { expected, found } => write!(
                f,
                "the state has {found} coordinates, the system {expected}"
            ),
            Error::Start {
                item,
                level,
                residual,
                tolerance,
            } => write!(
                f,
                "the start violates `{item}`: {} residual {} (accepted: {}); \
                 give {} that satisfy it, or have the nearest ones taken (`--project`, in Rust `project_start(true)`)",
                match level {
                    Level::Position => "position",
                    Level::Velocity => "velocity",
                },
                short(*residual),
                accepted(*tolerance),
                match level {
                    Level::Position => "positions",
                    Level::Velocity => "velocities, `der(…)`,",
                }
            ),
            Error::Penetrates {
                item,
                gap,
                tolerance,
            } => write!(
                f,
                "the start is below the surface of `{item}`: gap {} (accepted: {}); begin above it, or have the \
                 nearest positions taken (`--project`, in Rust `project_start(true)`); if the body belongs on that side, turn the contact's inequality round; \
                 if it hangs under a surface that ends, let the contact's region (`where …`) leave that place out",
                short(*gap),
                accepted(-tolerance)
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
            } => write!(
                f,
                "t = {} ({mode}): {reason}{}",
                Shortest(*time),
                concerned(items)
            ),
            Error::NotFinite {
                time,
                mode,
                what,
                cause,
                ..
            } => write!(
                f,
                "t = {} ({mode}): {what} is not finite; {}",
                Shortest(*time),
                finite(*cause)
            ),
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
                 taken of vanishes or an asin or acos ends, and what velocities do at such a corner is not computed; round it, or, where a gap is the \
                 smaller of two, write each side as a contact of its own",
                Shortest(*time),
                short(*rate)
            ),
            Error::Kick {
                time,
                condition,
                momentum,
                before,
                after,
            } => write!(
                f,
                "t = {}: {} jumps from {} to {} where `{condition}` changes, and what velocities do at \
                 such a kick is not computed; let it change over a distance or within a time, or declare what is hit as a contact",
                Shortest(*time),
                match momentum {
                    Some(coordinate) => format!("the momentum of `{coordinate}`"),
                    None => "the Lagrangian T - V".to_owned(),
                },
                short(*before),
                short(*after)
            ),
            Error::Undirected { time, item } => write!(
                f,
                "t = {}: the gap of `{item}` vanishes where it has no direction, as the distance of two points does; give them a \
                 size, for example sqrt(x^2 + y^2) >= radius",
                Shortest(*time)
            ),
            Error::Undetermined { time, item, mode } => write!(
                f,
                "t = {}, mode {mode}: `{item}` asks for a force that the motion does not determine; watch a sum of forces that it does \
                 determine, or hold the load with springs",
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
                held,
            } => write!(
                f,
                "t = {} ({mode}): none of {tried} modes continues the motion at `{item}`; {}else ask for a smaller tolerance",
                Shortest(*time),
                some_mode(item, *held, *friction, *branches)
            ),
            Error::NoImpact {
                time,
                mode,
                item,
                tried,
                friction,
                together,
            } => write!(
                f,
                "t = {} ({mode}): no solution of the impact at `{item}` is found, in {tried} combinations of what takes part and what holds; {}",
                Shortest(*time),
                match (together, friction) {
                    (true, _) => "impacts in turn have one (impacts = in_turn)",
                    (false, true) =>
                        "without friction there is one: lower it, or make the contact compliant",
                    (false, false) =>
                        "constraints leave no speeds that keep apart what touches: something may be driven into it, or have no room between contacts that move",
                }
            ),
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
                "t = {} ({mode}): the step fell to {step:.1e} s; {}",
                Shortest(*time),
                match f64::EPSILON * time.abs() > UNRESOLVED {
                    true =>
                        "times as late as this are no closer to one another: count them from a later instant",
                    false => "the motion is singular here or the tolerance is too tight",
                }
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
            Error::Limit { time, what, limit } => write!(
                f,
                "t = {}: more than {limit} {}; {}",
                Shortest(*time),
                what.strip_suffix('s')
                    .filter(|_| *limit == 1)
                    .unwrap_or(what),
                match *what {
                    "events" =>
                        "if this is intended, end the run earlier or raise the limit (`max_events`, `--max-events`)",
                    "steps" =>
                        "if this is intended, end the run earlier or raise the limit (in Rust `max_steps`)",
                    _ => "a run takes one, and the others are not known",
                }
            ),
            Error::OutOfReach {
                time, end, steps, ..
            } if steps.is_infinite() => write!(
                f,
                "t = {}: the motion becomes faster and faster, and steps so short that none of them will come to the end, {end:e} s; end it earlier, or \
                 look for what grows without bound",
                Shortest(*time)
            ),
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
            } => write!(
                f,
                "an error of {asked:e} cannot be had{}: {reason}",
                attainable(*possible)
            ),
            Error::Interrupted { time } => write!(f, "interrupted at t = {}", Shortest(*time)),
            Error::OutsideTrajectory { time, first, last } => {
                let [time, first, last] = [time, first, last].map(|t| Shortest(*t));
                write!(f, "t = {time} is outside the trajectory [{first}, {last}]")
            }
            Error::NotRecorded => {
                f.write_str("the run kept its events and its ends only; leave `record(false)` out")
            }
        }
    }
}

/// The fields that a number is made of, with their values.
fn made_of(fields: &[(&str, f64)]) -> String {
    let values = fields.iter();
    let values = values.map(|(field, value)| format!("`{field}` = {}", Shortest(*value)));
    match fields {
        [] => String::new(),
        _ => format!(" with {}", values.collect::<Vec<_>>().join(", ")),
    }
}

/// The coordinates or rows concerned.
fn concerned(items: &[&str]) -> String {
    match items {
        [] => String::new(),
        _ => format!(": `{}`", items.join("`, `")),
    }
}

/// What would keep a quantity finite.
fn finite(cause: NotFinite) -> &'static str {
    match cause {
        NotFinite::Exponential => {
            "exp, sinh or cosh is so large here that a power of it overflows: write 1/cosh(z)^2 as \
             1 - tanh(z)^2, and 1/(1 + exp(-z)) as (1 + tanh(z/2))/2"
        }
        NotFinite::Range => {
            "masses, lengths or accelerations here are so large or so small that products of them are beyond all numbers: \
             choose other units"
        }
        NotFinite::Domain => "the expression leaves its domain here",
    }
}

/// What would let a mode continue the motion.
fn some_mode(item: &str, held: Option<&str>, friction: bool, branches: bool) -> String {
    // Conditions are told as they are written; names have no blanks.
    if branches && item.contains(' ') {
        return "on either side of it the motion is driven back to the other, as by a controller that switches: let the force change over a short range, or declare one that jumps with the sign of a velocity as a friction; ".to_owned();
    }
    if let Some(constraint) = held {
        return format!(
            "`{constraint}` holds with any force while `{item}` is closed, also where that would have to pull: let a friction on it hold instead, which gives way; "
        );
    }
    let contacts = match friction {
        true => {
            "rigid friction may have no solution (Painlevé 1895): lower its coefficient or make the contact compliant; "
        }
        false => "contacts that move may leave no room between them; ",
    };
    let jumps = match branches {
        true => {
            "a force that jumps with the sign of a velocity is declared as a friction; one that jumps at the surface of a contact may push what touches away and let it fall back at once: let it change over a distance; "
        }
        false => "",
    };
    format!("{contacts}{jumps}")
}

/// The error that can be had, in two digits and not smaller than it is: a smaller one could be what was asked for.
fn attainable(error: f64) -> String {
    if !(error < 0.1) {
        return String::new();
    }
    let digit = 10_f64.powf(error.log10().floor() - 1.0);
    format!(", one of {:.1e} can", (error / digit).ceil() * digit)
}
