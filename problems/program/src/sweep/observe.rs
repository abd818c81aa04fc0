//! What is read from each run of a sweep.
//!
//! ```text
//! theta at shell lost        a coordinate, velocity, force, output or energy just before an event, `t` for its time
//! theta at floor impact 2    … at its second occurrence
//! impulse floor at floor impact    the impulse of a force in an impact
//! count floor impact         how often, of an array all of its elements together
//! theta, theta at the end    at the end of the run; `theta at end` where nothing is called `end`
//! modes                      the sequence of its switches
//! ```

use super::modes::Switches;
use super::unit;
use crate::notation::{impulse_unit, velocity_name};
use crate::outcome::rounding::impulse;
use crate::outcome::{Force, forces};
use crate::request::event::{event, events};
use crate::request::{Quantity, Refusal, find_state};
use crate::scene::Scene;
use lagrange_core::prelude::*;

/// A number read from a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// As asked for: the name of its column.
    pub name: String,
    what: What,
    at: At,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    Time,
    Position(usize),
    Velocity(usize),
    Force(usize),
    /// Of this force, in an impact.
    Impulse(usize),
    Output(usize),
    Kinetic,
    Potential,
    /// Kinetic and potential.
    Energy,
    /// How many events are one of these.
    Count(Vec<Awaited>),
    Modes(Switches),
}

#[derive(Clone, Debug, PartialEq)]
enum At {
    End,
    /// An event at its first, second … occurrence.
    Event(Awaited),
}

impl Observation {
    /// Reads an observation of a scene, or the name of one of its results.
    ///
    /// # Errors
    /// A name that is not known.
    pub fn new(text: &str, scene: &dyn Scene) -> Result<Self, Refusal> {
        let description = scene.description();
        let asked = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let name = scene.result(&asked);
        let (what, at) = match (name.strip_prefix("count "), name.split_once(" at ")) {
            _ if name == "modes" => (What::Modes(Switches::of(description)), At::End),
            (Some(event), _) => (What::Count(every(event, description)?), At::End),
            (None, Some(("modes", _))) => {
                return Err(Refusal::Whole {
                    asked,
                    alone: "modes".to_owned(),
                });
            }
            (None, Some((quantity, "the end"))) => (quantity_of(quantity, description)?, At::End),
            (None, Some((quantity, "end"))) if event("end", description).is_err() => {
                (quantity_of(quantity, description)?, At::End)
            }
            (None, Some((quantity, event))) => {
                let found = self::event(event, description)?;
                let what = match quantity.strip_prefix("impulse ") {
                    Some(force) => impulse_of(force, found, event, description)?,
                    None => quantity_of(quantity, description)?,
                };
                if let What::Force(row) = what {
                    refuse_before_contact(row, found, event, description)?;
                }
                (what, At::Event(found.into()))
            }
            (None, None) => (quantity_of(name, description)?, At::End),
        };
        Ok(Self {
            name: asked.clone(),
            what,
            at,
        })
    }

    /// Its unit; empty for a plain number.
    pub(super) fn unit(&self, description: &Description) -> String {
        match &self.what {
            What::Time => "s".to_owned(),
            What::Position(index) => unit(description, *index, Quantity::Position),
            What::Velocity(index) => unit(description, *index, Quantity::Velocity),
            What::Force(row) => description.units.row(*row).to_owned(),
            What::Impulse(row) => impulse_unit(description.units.row(*row)),
            What::Output(index) => description.observes[*index].unit.to_owned(),
            What::Kinetic | What::Potential | What::Energy => description.units.energy.to_owned(),
            What::Count(_) | What::Modes(_) => String::new(),
        }
    }

    /// A value in words, one for each switch and one for those that are too many, if it stands for a sequence of switches.
    pub fn words(&self, value: f64) -> Option<Vec<String>> {
        match &self.what {
            What::Modes(switches) if !value.is_nan() => Some(switches.words(value)),
            _ => None,
        }
    }

    /// Whether its values stand for sequences of switches: they can be told apart and nothing else.
    pub fn is_sequence(&self) -> bool {
        matches!(self.what, What::Modes(_))
    }

    /// The event after which a run has no more to say to this, if there is one.
    pub fn ends_with(&self) -> Option<Awaited> {
        match &self.at {
            At::Event(event) => Some(*event),
            At::End => None,
        }
    }

    /// Its value in a run; NaN if the run has no such event.
    pub(crate) fn read(&self, trajectory: &Trajectory) -> f64 {
        match &self.what {
            What::Modes(switches) => return switches.number(trajectory.events()),
            What::Count(any) => {
                let events = trajectory.events().iter();
                let such = events.filter(|event| any.iter().any(|awaited| awaited.is(event)));
                return such.count() as f64;
            }
            _ => {}
        }
        let event = match &self.at {
            At::End => None,
            At::Event(awaited) => {
                let mut events = trajectory.events().iter().filter(|event| awaited.is(event));
                let Some(event) = events.nth(awaited.number - 1) else {
                    return f64::NAN;
                };
                Some(event)
            }
        };
        let state = event.map_or(trajectory.final_state(), |event| &event.state);
        let value = match (&self.what, event) {
            (What::Time, _) => event.map_or(trajectory.last_time(), |event| event.time),
            (What::Position(i), _) => state.q[*i],
            (What::Velocity(i), _) => state.v[*i],
            (What::Force(row), Some(event)) => event.forces[*row],
            (What::Impulse(row), Some(event)) => impulse(event, *row, trajectory.description()),
            // The rest is not kept of a run.
            _ => {
                let mut sampler = trajectory.sampler();
                let instant = match event {
                    None => sampler.at(trajectory.last_time()),
                    Some(event) => sampler.before(event),
                };
                instant.map_or(f64::NAN, |instant| self.evaluated(&instant))
            }
        };
        // Not `-0`.
        value + 0.0
    }

    fn evaluated(&self, instant: &Instant<f64>) -> f64 {
        match &self.what {
            What::Force(row) => instant.forces[*row],
            What::Output(i) => instant.observes[*i],
            What::Kinetic => instant.kinetic,
            What::Potential => instant.potential,
            What::Energy => instant.energy(),
            _ => 0.0,
        }
    }
}

/// `item kind`, and no more: all of them are counted.
fn every(text: &str, description: &'static Description) -> Result<Vec<Awaited>, Refusal> {
    let second = text.match_indices(' ').nth(1);
    let kind = second.map_or(text, |(end, _)| &text[..end]);
    let found = events(kind, description)?;
    match kind == text {
        true => Ok(found.into_iter().map(Awaited::from).collect()),
        false => Err(Refusal::Whole {
            asked: format!("count {text}"),
            alone: format!("count {kind}"),
        }),
    }
}

/// The impulse of a force, of which only impacts have any.
fn impulse_of(
    force: &str,
    (_, kind, _): (Subject, EventKind, usize),
    event: &str,
    description: &'static Description,
) -> Result<What, Refusal> {
    match (kind, quantity_of(force, description)?) {
        (EventKind::Impact, What::Force(row)) => Ok(What::Impulse(row)),
        (_, What::Force(_)) => Err(Refusal::NoImpulse {
            event: event.to_owned(),
        }),
        _ => {
            let forces = forces(description);
            let names = forces.iter().map(|force| force.name.as_str());
            Err(Refusal::unknown("force", force, names))
        }
    }
}

/// Before a contact closes, what acts only while it is closed is zero in every run.
fn refuse_before_contact(
    row: usize,
    (subject, kind, _): (Subject, EventKind, usize),
    event: &str,
    description: &'static Description,
) -> Result<(), Refusal> {
    let closes = matches!(
        kind,
        EventKind::Impact | EventKind::Closed | EventKind::Accumulates { .. }
    );
    let forces = forces(description);
    let force = forces.iter().find(|force| force.row == row);
    let force = force.filter(|force| {
        let contact = force.contact(description);
        closes && contact.is_some_and(|contact| subject == Subject::Contact(contact))
    });
    force.map_or(Ok(()), |force| {
        Err(Refusal::NotYet {
            force: force.name.clone(),
            contact: subject.name(description).to_owned(),
            event: event.to_owned(),
            has_impulse: kind == EventKind::Impact,
        })
    })
}

fn quantity_of(name: &str, description: &'static Description) -> Result<What, Refusal> {
    if name == "t" {
        return Ok(What::Time);
    }
    if let Some(Force { row, .. }) = forces(description).iter().find(|force| force.name == name) {
        return Ok(What::Force(*row));
    }
    if let Some(index) = description.observes.iter().position(|o| o.name == name) {
        return Ok(What::Output(index));
    }
    match name {
        "kinetic" => return Ok(What::Kinetic),
        "potential" => return Ok(What::Potential),
        "energy" => return Ok(What::Energy),
        _ => {}
    }
    let (index, level) = find_state(description, name).map_err(|_| unknown(name, description))?;
    Ok(match level {
        Quantity::Position => What::Position(index),
        Quantity::Velocity => What::Velocity(index),
    })
}

fn unknown(name: &str, description: &'static Description) -> Refusal {
    let mut known = vec!["t".to_owned()];
    for coordinate in description.coordinates {
        known.extend([coordinate.name.to_owned(), velocity_name(coordinate.name)]);
    }
    known.extend(forces(description).into_iter().map(|force| force.name));
    known.extend(
        description
            .observes
            .iter()
            .map(|output| output.name.to_owned()),
    );
    known.extend(["kinetic", "potential", "energy", "modes"].map(str::to_owned));
    Refusal::unknown(
        "coordinate, velocity, force or output",
        name,
        known.iter().map(String::as_str),
    )
}

#[cfg(test)]
mod tests {
    use super::{At, Observation};
    use crate::file::scene;

    #[test]
    fn the_end_of_a_run_may_be_called_end_unless_something_is_called_so() {
        let declared = "coordinates(x), kinetic = der(x)^2, start(a: der(x) = 1)";
        let plain = scene("plain.lagrange", declared).expect("a declaration");
        for asked in ["x", "x at the end", "x at end"] {
            let observed = Observation::new(asked, plain).expect(asked);
            assert!(matches!(observed.at, At::End), "{asked}");
        }
        let named = format!("{declared}, stop(end: x >= 1)");
        let named = scene("named.lagrange", &named).expect("a declaration");
        let observed = Observation::new("x at end", named).expect("a stop");
        assert!(!matches!(observed.at, At::End));
    }

    #[test]
    fn at_an_impact_the_contact_has_an_impulse_and_no_force() {
        let declared = "parameters(m: \"kg\" = 2), coordinates(x: \"m\", y: \"m\"), kinetic = m/2 * (der(x)^2 + der(y)^2),
            contact(floor: y >= 0), friction(rub on floor: slip = der(x), static = 0.1), start(a: der(y) = 0)";
        let scene = scene("ball.lagrange", declared).expect("a declaration");
        for (asked, answer) in [
            (
                "floor at floor impact",
                "`impulse floor at floor impact` is the impulse",
            ),
            (
                "rub at floor impact 2",
                "`impulse rub at floor impact 2` is the impulse",
            ),
            ("floor at floor closed", "`floor` is open just before"),
            ("impulse floor at floor lost", "`floor lost` has no impulse"),
            ("impulse x at floor impact", "there are: floor, rub"),
        ] {
            let refusal = Observation::new(asked, scene).expect_err(asked).to_string();
            assert!(refusal.contains(answer), "{refusal}");
        }
        Observation::new("floor at rub sticks", scene).expect("it is closed before");
        let asked = "impulse floor at floor impact";
        let observed = Observation::new(asked, scene).expect("an impulse");
        assert_eq!(observed.unit(scene.description()), "N s");
    }

    #[test]
    fn what_is_read_from_a_whole_run_has_no_part() {
        let declared =
            "coordinates(x), kinetic = der(x)^2, contact(wall: x <= 1), stop(end: x <= -1)";
        let scene = scene("walls.lagrange", declared).expect("a declaration");
        for (asked, alone) in [
            ("count wall impact 2", "`count wall impact` is"),
            ("count wall impact at the end", "`count wall impact` is"),
            ("modes at wall impact", "`modes` is"),
            ("modes at the end", "`modes` is"),
        ] {
            let refusal = Observation::new(asked, scene).expect_err(asked).to_string();
            let told = refusal.contains(alone) && refusal.contains(&format!("in `{asked}`"));
            assert!(told, "{refusal}");
        }
        for asked in ["count wall impact", "count end", "count end stop", "modes"] {
            Observation::new(asked, scene).expect(asked);
        }
        let refusal = Observation::new("count wal impact 2", scene).expect_err("no such item");
        assert!(
            refusal.to_string().contains("did you mean `wall`?"),
            "{refusal}"
        );
    }
}
