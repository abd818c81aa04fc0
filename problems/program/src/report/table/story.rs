//! The story of a run as a table: which numbers are shown, with how many digits, and how wide the columns are.

use super::decimals::{Decimals, time};
use super::line::{Line, lines};
use super::page;
use crate::notation::impulse_unit;
use crate::notation::{is_angle, symbol};
use crate::outcome::rounding::ROUNDING;
use crate::outcome::{Force, Outcome, forces};
use crate::quantity::Quantity;
use crate::report::telling;
use comfy_table::{CellAlignment, ColumnConstraint, Table, Width};
use lagrange_core::system::Description;

/// So many numbers at most, forces among them, stand in a line of the story.
const NUMBERS: usize = 6;

/// A coordinate or an output in the story.
struct Column {
    head: String,
    /// Place in [`Line::state`].
    place: usize,
    unit: String,
    scale: f64,
}

/// What has this place in [`Line::state`].
fn quantity(description: &Description, place: usize) -> Quantity {
    match place.checked_sub(description.coordinates.len()) {
        None => Quantity::Position(place),
        Some(i) => Quantity::Output(i),
    }
}

/// What it is called in the declaration.
fn name(description: &Description, place: usize) -> &'static str {
    match place.checked_sub(description.coordinates.len()) {
        None => description.coordinates[place].name,
        Some(i) => description.observes[i].name,
    }
}

impl Column {
    fn of(&self, line: &Line) -> Option<f64> {
        Some(line.state[self.place]? * self.scale)
    }

    /// The largest number of its unit in the lines.
    fn beside(&self, lines: &[Line], description: &Description) -> f64 {
        let places = 0..description.coordinates.len() + description.observes.len();
        let alike =
            places.filter(|&place| quantity(description, place).unit(description) == self.unit);
        let numbers =
            alike.flat_map(|place| lines.iter().filter_map(move |line| line.state[place]));
        numbers.fold(0.0, |a: f64, x| a.max(x.abs())) * self.scale
    }

    /// As many as the lines need. What is nothing but error in all of them, as what the run starts from is not, is shown beside how far its
    /// velocities carry a coordinate, or what an output ever is; what is nothing but rounding, beside the largest number of its unit, and an
    /// angle beside 1 rad.
    fn decimals(&self, lines: &[Line], outcome: &Outcome) -> Decimals {
        let told: Vec<f64> = lines.iter().filter_map(|line| self.of(line)).collect();
        let largest = |values: &[f64]| values.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let samples = outcome.samples.iter().map(|sample| &sample.state);
        let events = outcome.events.iter();
        let states = samples.chain(events.flat_map(|event| [&event.state, &event.state_after]));
        let speeds: Vec<f64> = states
            .filter_map(|state| state.v.get(self.place).copied())
            .collect();
        let output = self
            .place
            .checked_sub(outcome.description.coordinates.len());
        let ever = match output {
            Some(i) => {
                let values = outcome.samples.iter().map(|sample| sample.observes[i]);
                largest(&values.collect::<Vec<_>>())
            }
            None => largest(&speeds) * outcome.lasts(),
        };
        let ever = ever * self.scale;
        let coordinates = outcome.description.coordinates;
        let beside = self.beside(lines, outcome.description);
        let turn = coordinates.get(self.place).filter(|c| is_angle(c));
        let start = lines.first().and_then(|line| self.of(line));
        let exact = start.is_some_and(|start| start.abs() > ROUNDING * ever);
        if largest(&told) < outcome.tolerance * ever && !exact {
            Decimals::of([ever])
        } else if turn.is_some() && largest(&told) < ROUNDING * self.scale {
            Decimals::of([self.scale])
        } else if largest(&told) < ROUNDING * beside {
            Decimals::of([beside])
        } else {
            Decimals::of(told)
        }
    }
}

/// Angles, or all coordinates if none is an angle; then outputs, and then the other coordinates, where there is room beside the forces or
/// nothing stands there yet. An output of a coordinate by its own name is that coordinate.
fn shown(description: &Description, forces: usize) -> Vec<Column> {
    let coordinates = description.coordinates;
    let telling = telling(description);
    let (angles, others): (Vec<usize>, Vec<usize>) =
        telling.iter().partition(|&&i| is_angle(&coordinates[i]));
    let first = if angles.is_empty() { &others } else { &angles };
    let mut places = first.clone();
    let outputs = (0..description.observes.len()).map(|i| coordinates.len() + i);
    for more in [outputs.collect(), others] {
        let new: Vec<usize> = more
            .into_iter()
            .filter(|&place| {
                let mut known = places.iter();
                known.all(|&known| name(description, known) != name(description, place))
            })
            .collect();
        if places.is_empty() || forces + places.len() + new.len() <= NUMBERS {
            places.extend(new);
        }
    }
    places.sort_unstable();
    let column = |place: usize| {
        let quantity = quantity(description, place);
        let unit = quantity.unit(description);
        Column {
            head: format!("{}\n{unit}", symbol(name(description, place))),
            place,
            unit,
            scale: quantity.scale(description),
        }
    };
    places.into_iter().map(column).collect()
}

/// A force that is rounding alone beside the largest of its unit is 0.
fn forget_rounding(lines: &mut [Line], items: &[Force], description: &Description) {
    let unit = |k: usize| description.units.row(items[k].row);
    let mut largest = vec![0.0_f64; items.len()];
    for line in &*lines {
        for (k, force) in line.upper.iter().chain(&line.lower).enumerate() {
            let k = k % items.len();
            largest[k] = largest[k].max(force.unwrap_or(0.0).abs());
        }
    }
    let alike = |k: usize| (0..items.len()).filter(move |other| unit(*other) == unit(k));
    let least = (0..items.len()).map(|k| alike(k).fold(0.0, |a: f64, other| a.max(largest[other])));
    let least: Vec<f64> = least.map(|largest| f64::EPSILON * largest).collect();
    for line in lines {
        for side in [&mut line.upper, &mut line.lower] {
            for (force, least) in side.iter_mut().zip(&least) {
                *force = force.map(|force| if force.abs() < *least { 0.0 } else { force });
            }
        }
    }
}

/// As many as the lines need. What is nothing but error in all of them is shown like what it is an error of: the other component of its
/// friction, what the force holds in balance, or, of rounding alone, the largest force of its unit.
fn decimals_of_forces(items: &[Force], lines: &[Line], outcome: &Outcome) -> Vec<Decimals> {
    let told = |k: usize| {
        let sides = lines.iter().flat_map(|line| [&line.upper, &line.lower]);
        sides.filter_map(move |forces| *forces.get(k)?)
    };
    let largest: Vec<f64> = (0..items.len())
        .map(|k| told(k).fold(0.0, |a: f64, x| a.max(x.abs())))
        .collect();
    let of_all = |alike: &dyn Fn(&Force) -> bool| {
        let all = items.iter().zip(&largest);
        let alike = all.filter(|(item, _)| alike(item));
        alike.fold(0.0, |a: f64, (_, x)| a.max(*x))
    };
    let unit = |item: &Force| outcome.description.units.row(item.row);
    let held = outcome.held();
    let decimals = |(k, item): (usize, &Force)| {
        let whole = held[item.row].max(of_all(&|other| other.source == item.source));
        let beside = of_all(&|other| unit(other) == unit(item));
        let whole = match whole < f64::EPSILON * beside {
            true => beside,
            false => whole,
        };
        if largest[k] < outcome.tolerance * whole {
            Decimals::of([whole])
        } else {
            Decimals::of(told(k))
        }
    };
    items.iter().enumerate().map(decimals).collect()
}

/// The forces of the story: where there are many, those that act in some line.
fn told(outcome: &Outcome) -> Vec<Force> {
    let all = forces(outcome.description);
    if all.len() <= NUMBERS {
        return all;
    }
    let lines = lines(outcome, &all);
    let acts = |k: usize| {
        let mut sides = lines.iter().flat_map(|line| [&line.upper, &line.lower]);
        sides.any(|forces| forces.get(k).is_some_and(Option::is_some))
    };
    let all = all.into_iter().enumerate();
    all.filter(|(k, _)| acts(*k))
        .map(|(_, force)| force)
        .collect()
}

/// The table of what happened; where there are many numbers, one table below the other, each with the times and the events, the last with the mode.
pub(super) fn story(outcome: &Outcome) -> Vec<Table> {
    let items = told(outcome);
    let mut lines = lines(outcome, &items);
    forget_rounding(&mut lines, &items, outcome.description);
    let numbers = numbers(outcome, &items, &lines);
    let blocks = numbers.chunks(NUMBERS);
    let blocks = match numbers.is_empty() {
        true => vec![&numbers[..]],
        false => blocks.collect(),
    };
    let last = blocks.len() - 1;
    let tables = blocks.iter().enumerate();
    tables
        .map(|(k, block)| table(outcome, &lines, block, k == last))
        .collect()
}

/// A column of numbers: its head, and a cell for each line.
struct Numbers {
    head: String,
    cells: Vec<String>,
}

/// Coordinates and outputs, then forces.
fn numbers(outcome: &Outcome, items: &[Force], lines: &[Line]) -> Vec<Numbers> {
    let units = &outcome.description.units;
    let columns = shown(outcome.description, items.len());
    let states = columns.iter().map(|column| {
        let decimals = column.decimals(lines, outcome);
        let cell = |line: &Line| column.of(line).map_or(String::new(), |x| decimals.show(x));
        Numbers {
            head: column.head.clone(),
            cells: lines.iter().map(cell).collect(),
        }
    });
    let of_forces = decimals_of_forces(items, lines, outcome);
    let forces = items.iter().zip(of_forces).enumerate();
    let forces = forces.map(|(k, (item, decimals))| {
        let unit = units.row(item.row);
        let cell = |line: &Line| two_lines(line, k, decimals, unit);
        Numbers {
            head: format!("{}\n{unit}", item.name),
            cells: lines.iter().map(cell).collect(),
        }
    });
    states.chain(forces).collect()
}

/// The lines with some of the numbers, and with the mode if asked for.
fn table(outcome: &Outcome, lines: &[Line], numbers: &[Numbers], with_mode: bool) -> Table {
    let estimated = lines.iter().any(|line| line.error.is_some());
    let times = 1 + usize::from(estimated);
    let mut table = page();
    let mut header = vec!["t\ns", "±\ns"];
    header.truncate(times);
    header.push("event");
    header.extend(numbers.iter().map(|number| &number.head[..]));
    header.extend(with_mode.then_some("mode"));
    table.set_header(header);
    for (i, line) in lines.iter().enumerate() {
        if line.left_out > 0 {
            let mut row = vec![String::new(); times];
            row.push(format!("{} more", line.left_out));
            table.add_row(row);
        }
        let mut row = vec![time(line.time, outcome.lasts())];
        if estimated {
            row.push(line.error.map_or(String::new(), off));
        }
        row.push(line.event.clone());
        row.extend(numbers.iter().map(|number| number.cells[i].clone()));
        row.extend(with_mode.then(|| line.mode.clone()));
        table.add_row(row);
    }
    lay_out(&mut table, lines, times, numbers.len());
    table
}

/// How far off a time is.
fn off(error: f64) -> String {
    match error < 1e-15 {
        true => "<1e-15".to_owned(),
        false => format!("{error:.0e}"),
    }
}

/// Force number `k`, before and after.
fn two_lines(line: &Line, k: usize, decimals: Decimals, unit: &str) -> String {
    let show = |values: &[Option<f64>]| match values.get(k).copied().flatten() {
        Some(value) if line.impulse => {
            let shown = format!("{} {}", decimals.show(value), impulse_unit(unit));
            shown.trim_end().to_owned()
        }
        Some(value) => decimals.show(value),
        None => String::new(),
    };
    let both = format!("{}\n{}", show(&line.upper), show(&line.lower));
    both.trim_end().to_owned()
}

/// The widths of the columns: `times`, the event, so many `numbers`, the mode.
fn lay_out(table: &mut Table, lines: &[Line], times: usize, numbers: usize) {
    let (event, mode) = (times, times + 1 + numbers);
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((1, 0));
        if index == event {
            // No name is broken: the longest word and the space before it.
            let of = |line: &Line| longest(line.event.split_whitespace());
            let least = lines.iter().map(of).max().unwrap_or(0) + 1;
            column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(least)));
        } else if index == mode {
            column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(18)));
        } else {
            column.set_cell_alignment(CellAlignment::Right);
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
    }
}

/// Characters of the longest of some texts.
fn longest<'a>(texts: impl Iterator<Item = &'a str>) -> u16 {
    texts
        .map(|text| text.chars().count() as u16)
        .max()
        .unwrap_or(0)
}
