//! What of a run can be drawn, by name: `t`, a coordinate `theta`, its rate `der(theta)`, a force, `|grip|`, what a friction can
//! hold `limit(grip)`, an output, `kinetic`, `potential`, `energy`.

use crate::names::is_element;
use crate::notation::{is_angle, rate_unit, symbol, velocity_name};
use crate::outcome::{Force, Outcome, Sample, Source, forces};
use crate::request::Refusal;
use lagrange_core::__private::places::Normal;
use lagrange_core::system::{Description, Friction};
use lagrange_engine::parse::FUNCTIONS;

/// Functions of the language that take an item or a coordinate.
const OF_ITEMS: [&str; 3] = ["gap", "slip", "momentum"];

/// A number that a run has at every instant, or while something acts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Time,
    Position(usize),
    Velocity(usize),
    /// Of one row, with its sign.
    Force(Force),
    /// Of a friction, whatever its direction.
    Size(usize),
    /// What a friction can hold.
    Limit(usize),
    /// An extra output.
    Output(usize),
    Kinetic,
    Potential,
    /// Kinetic and potential.
    Energy,
}

impl Quantity {
    /// All of a scene, with the names that a user gives.
    fn all(d: &Description) -> Vec<(String, Self)> {
        let mut all = vec![("t".to_owned(), Quantity::Time)];
        for (i, coordinate) in d.coordinates.iter().enumerate() {
            all.push((coordinate.name.to_owned(), Quantity::Position(i)));
            all.push((velocity_name(coordinate.name), Quantity::Velocity(i)));
        }
        for force in forces(d) {
            all.push((force.name.clone(), Quantity::Force(force)));
        }
        for (i, friction) in d.frictions.iter().enumerate() {
            all.push((format!("|{}|", friction.name), Quantity::Size(i)));
            all.push((format!("limit({})", friction.name), Quantity::Limit(i)));
        }
        for (i, output) in d.observes.iter().enumerate() {
            all.push((output.name.to_owned(), Quantity::Output(i)));
        }
        let energies = [Quantity::Kinetic, Quantity::Potential, Quantity::Energy];
        // What a scene has declared goes before.
        all.extend(
            ["kinetic", "potential", "energy"]
                .map(str::to_owned)
                .into_iter()
                .zip(energies),
        );
        all
    }

    /// What `name` means, blanks ignored: a quantity, or all elements of an array.
    fn find(name: &str, d: &Description) -> Result<Vec<Self>, Refusal> {
        let plain = plain(name);
        let all = Self::all(d);
        let elements = all.iter().filter(|(known, _)| is_element(known, &plain));
        let elements: Vec<Self> = elements.map(|(_, quantity)| quantity.clone()).collect();
        match elements.is_empty() || all.iter().any(|(known, _)| *known == plain) {
            true => Self::one(name, d).map(|one| vec![one]),
            false => Ok(elements),
        }
    }

    /// The one called `name`, blanks ignored.
    fn one(name: &str, d: &Description) -> Result<Self, Refusal> {
        let plain = plain(name);
        let all = Self::all(d);
        let found = all.iter().find(|(known, _)| *known == plain);
        found.map(|(_, quantity)| quantity.clone()).ok_or_else(|| {
            let known = all.iter().map(|(known, _)| known.as_str());
            match is_expression(&plain, d) {
                true => Refusal::NoQuantity { name: plain },
                false => Refusal::unknown("quantity", name.trim(), known),
            }
        })
    }

    /// As it is written beside a curve.
    pub(crate) fn name(&self, d: &Description) -> String {
        match self {
            Quantity::Time => "time".to_owned(),
            Quantity::Position(i) => symbol(d.coordinates[*i].name),
            Quantity::Velocity(i) => format!("d{}/dt", symbol(d.coordinates[*i].name)),
            Quantity::Force(force) => force.name.clone(),
            Quantity::Size(i) => format!("|{}|", d.frictions[*i].name),
            Quantity::Limit(i) => {
                let friction = &d.frictions[*i];
                format!("{} of {}", limit_name(friction), friction.name)
            }
            Quantity::Output(i) => d.observes[*i].name.to_owned(),
            Quantity::Kinetic => "kinetic".to_owned(),
            Quantity::Potential => "potential".to_owned(),
            Quantity::Energy => "energy".to_owned(),
        }
    }

    /// What several of them are called together.
    pub(crate) fn kind(&self, d: &Description) -> &'static str {
        match self {
            Quantity::Time => "time",
            Quantity::Position(i) if is_angle(&d.coordinates[*i]) => "angle",
            Quantity::Position(_) => "position",
            Quantity::Velocity(_) => "rate",
            Quantity::Force(force) => force_word(d.units.row(force.row)),
            Quantity::Size(i) | Quantity::Limit(i) => force_word(d.units.row(d.frictions[*i].row)),
            Quantity::Output(_) => "output",
            Quantity::Kinetic | Quantity::Potential | Quantity::Energy => "energy",
        }
    }

    /// Its unit on paper, where angles are in degrees, and how many of that one of its own is; empty for a plain number.
    fn scaled_unit(&self, d: &Description) -> (String, f64) {
        let unit = match self {
            Quantity::Time => "s".to_owned(),
            Quantity::Position(i) if is_angle(&d.coordinates[*i]) => "rad".to_owned(),
            Quantity::Velocity(i) if is_angle(&d.coordinates[*i]) => "rad/s".to_owned(),
            Quantity::Position(i) => d.coordinates[*i].unit.to_owned(),
            Quantity::Velocity(i) => rate_unit(d.coordinates[*i].unit),
            Quantity::Force(force) => d.units.row(force.row).to_owned(),
            Quantity::Size(i) | Quantity::Limit(i) => d.units.row(d.frictions[*i].row).to_owned(),
            Quantity::Output(i) => d.observes[*i].unit.to_owned(),
            Quantity::Kinetic | Quantity::Potential | Quantity::Energy => d.units.energy.to_owned(),
        };
        match unit.strip_prefix("rad") {
            Some(rest @ ("" | "/s")) => (format!("°{rest}"), 180.0 / core::f64::consts::PI),
            _ => (unit, 1.0),
        }
    }

    /// How many of its unit on paper one of its own is.
    pub(crate) fn scale(&self, d: &Description) -> f64 {
        self.scaled_unit(d).1
    }

    /// Its unit on paper.
    pub(crate) fn unit(&self, d: &Description) -> String {
        self.scaled_unit(d).0
    }

    /// Its value in that unit, `None` while it does not act.
    pub(crate) fn of(&self, d: &Description, sample: &Sample) -> Option<f64> {
        let value = match self {
            Quantity::Time => sample.time,
            Quantity::Position(i) => sample.state.q[*i],
            Quantity::Velocity(i) => sample.state.v[*i],
            Quantity::Force(force) if !force.acts(d, &sample.mode) => return None,
            Quantity::Force(force) => sample.forces[force.row],
            Quantity::Size(i) => {
                sample.limits[*i]?;
                let friction = &d.frictions[*i];
                let parts = &sample.forces[friction.row..friction.row + friction.components];
                parts.iter().fold(0.0, |size, x| x.hypot(size))
            }
            Quantity::Limit(i) => sample.limits[*i]?,
            Quantity::Output(i) => sample.observes[*i],
            Quantity::Kinetic => sample.energies.kinetic,
            Quantity::Potential => sample.energies.potential,
            Quantity::Energy => sample.energies.total(),
        };
        Some(self.scaled_unit(d).1 * value)
    }

    /// The absolute tolerance of a coordinate or rate, in its unit on paper.
    pub(crate) fn tolerance(&self, outcome: &Outcome) -> Option<f64> {
        let d = outcome.description;
        let (Quantity::Position(i) | Quantity::Velocity(i)) = self else {
            return None;
        };
        let name = d.coordinates[*i].name;
        let own = outcome.absolute.iter().find(|(other, _)| other == name);
        let tolerance = own.map_or(outcome.tolerance, |(_, tolerance)| *tolerance);
        Some(self.scaled_unit(d).1 * tolerance)
    }

    /// The forces of a scene, each friction followed by what it can hold.
    pub(crate) fn all_forces(d: &Description) -> Vec<Self> {
        let mut all = Vec::new();
        for force in forces(d) {
            match force.source {
                Source::Friction(i) if force.row == d.frictions[i].row => {
                    all.extend([Quantity::Size(i), Quantity::Limit(i)]);
                }
                // A friction of two components is one curve.
                Source::Friction(_) => {}
                _ => all.push(Quantity::Force(force)),
            }
        }
        all
    }
}

/// Whether a declaration may say so in an `observe`: all words of it are names there, or functions where they are called.
fn is_expression(plain: &str, d: &Description) -> bool {
    let names = || {
        let coordinates = d.coordinates.iter().map(|coordinate| coordinate.name);
        let parameters = d.parameters.iter().map(|parameter| parameter.name);
        let items = d.contacts.iter().map(|contact| contact.name);
        let items = items.chain(d.constraints.iter().map(|constraint| constraint.name));
        let items = items.chain(d.frictions.iter().map(|friction| friction.name));
        let items = items.chain(d.forces.iter().map(|force| force.name));
        let outputs = d.observes.iter().map(|output| output.name);
        coordinates.chain(parameters).chain(items).chain(outputs)
    };
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = plain;
    while let Some(begin) = rest.find(is_of_word) {
        let word = &rest[begin..];
        let (word, after) = word.split_at(word.find(|c| !is_of_word(c)).unwrap_or(word.len()));
        let is_number = word.starts_with(|c: char| c.is_ascii_digit());
        let is_known = match after.chars().next() {
            Some('(') => FUNCTIONS.contains(&word) || OF_ITEMS.contains(&word),
            Some('[') => names().any(|name| is_element(name, word)),
            _ => word == "pi" || names().any(|name| name == word),
        };
        if !(is_number || is_known) {
            return false;
        }
        rest = after;
    }
    syn::parse_str::<syn::Expr>(plain).is_ok()
}

/// A name without blanks.
fn plain(name: &str) -> String {
    name.chars().filter(|c| !c.is_whitespace()).collect()
}

/// What a multiplier of this unit is called on an axis.
pub(crate) fn force_word(unit: &str) -> &'static str {
    match unit {
        "" | "N" => "force",
        "N m" => "torque",
        _ => "multiplier",
    }
}

/// What a friction can hold, on paper: there is a μN where something presses; else its force is given.
pub(crate) fn limit_name(friction: &Friction) -> &'static str {
    match friction.normal {
        Normal::Given(_) => "limit",
        Normal::Contact(_) | Normal::Constraint(_) | Normal::Resultant(_) => "μN",
    }
}

/// Some quantities over another one, as a user asks for them: `theta, rim vs t`.
#[derive(Clone, Debug, PartialEq)]
pub struct Show {
    pub(crate) over: Quantity,
    pub(crate) curves: Vec<Quantity>,
}

impl Show {
    /// Names with commas between, and what they are drawn over (`vs x`), which is time if it is not said.
    ///
    /// # Errors
    /// A name that the scene does not have.
    pub fn new(text: &str, d: &Description) -> Result<Self, Refusal> {
        let (curves, over) = text.split_once(" vs ").unwrap_or((text, "t"));
        let curves = curves.split(',').map(|name| Quantity::find(name, d));
        let curves: Vec<Vec<Quantity>> = curves.collect::<Result<_, _>>()?;
        Ok(Self {
            curves: curves.concat(),
            over: Quantity::one(over, d)?,
        })
    }
}
