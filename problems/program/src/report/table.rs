//! Outcome → text: the story of the run, then the energy book and the work counts.
//!
//! Each event has two lines: above, the forces just before; below, just after, with what the mode does now that it did not before.
//! An impact shows impulses instead, in one line. Numbers of a column have the same number of decimals, so that they can be compared by eye.

use super::telling;
use super::words::{FEW, MANY, brief, changed};
use crate::notation::{is_angle, symbol};
use crate::outcome::{Force, Outcome, Sample, forces};
use crate::quantity::Quantity;
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table, TableStyle, Width,
};
use lagrange_core::mode::Mode;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use lagrange_core::trajectory::Entry;
use std::io::{self, Write};

/// Columns of the page.
pub(super) const WIDTH: u16 = 100;

/// So many numbers, forces among them, stand in a line of the story beside its mode.
const NUMBERS: usize = 6;

/// What the Jacobi integral is, said where it is not the energy.
const JACOBI: &str = "The works above change the Jacobi integral, not T + V: something moves as it is told to, and what it does to T + V has no line.";

/// Writes the story of `outcome`.
pub fn write(outcome: &Outcome, mut out: impl Write) -> io::Result<()> {
    let left_out = outcome.left_out();
    if !left_out.is_empty() {
        writeln!(out, "Without {}.\n", left_out.join(", "))?;
    }
    writeln!(out, "{}", story(outcome).trim_fmt())?;
    let open = outcome.undetermined();
    if !open.is_empty() {
        let depends = match outcome.slides_undetermined() {
            false => "does not depend",
            true => "may depend, since some slide,",
        };
        writeln!(
            out,
            "\nNot determined: {}. What moves {depends} on how these forces are shared out; \
             shown are the least that contacts and friction allow.",
            open.join(", ")
        )?;
    }
    if let Some(choice) = choices(outcome) {
        writeln!(out, "\n{choice}")?;
    }
    if let Some(stiffness) = outcome.stiffness() {
        writeln!(out, "\n{stiffness}")?;
    }
    if let Some(ledger) = &outcome.ledger {
        let unit = outcome.description.units.energy;
        writeln!(out, "\n{}", energy(ledger, unit).trim_fmt())?;
        writeln!(
            out,
            "The ledger{} closes to {:.1e} of its scale, {}{}{unit}.",
            match ledger.has_own_jacobi() {
                true => " of the Jacobi integral",
                false => "",
            },
            ledger.closure.abs() / ledger.scale.max(f64::MIN_POSITIVE),
            Decimals::of([ledger.scale]).show(ledger.scale),
            if unit.is_empty() { "" } else { " " }
        )?;
        if ledger.has_own_jacobi() {
            writeln!(out, "{JACOBI}")?;
        }
    }
    if let Some(estimate) = &outcome.estimate {
        writeln!(out, "{estimate}")?;
    }
    if let Some(certificate) = &outcome.certificate {
        writeln!(out, "{certificate}")?;
    }
    writeln!(out, "\n{}", work(outcome))
}

/// Where the motion could have gone on in another way, if anywhere.
fn choices(outcome: &Outcome) -> Option<String> {
    let groups = instants(&outcome.events);
    let mut open: Vec<String> = groups
        .iter()
        .filter(|(_, group)| group.iter().any(|event| event.ambiguous))
        .map(|(_, group)| format!("t = {} s", time(group[0].time, outcome.lasts())))
        .collect();
    open.dedup();
    let told = match open.len() > FEW {
        true => MANY,
        false => open.len(),
    };
    let more = match open.len() - told {
        0 => String::new(),
        more => format!(" and {more} times more"),
    };
    let at = open[..told].join(", ");
    (told > 0).then(|| {
        format!("More than one motion is possible at {at}{more}: a run takes one, `lagrange modes` lists all.")
    })
}

/// One line of the story, before it is laid out.
struct Line {
    time: f64,
    /// How far off the time is, s.
    error: Option<f64>,
    event: String,
    /// Coordinates and outputs; `None` between two events of one instant, where outputs are not known.
    state: Vec<Option<f64>>,
    /// Force or impulse per force, above and below; `None` where it does not act.
    upper: Vec<Option<f64>>,
    lower: Vec<Option<f64>>,
    impulse: bool,
    mode: String,
}

fn entries(outcome: &Outcome, items: &[Force]) -> Vec<Line> {
    let description = outcome.description;
    let acting = |rows: &[f64], mode: &Mode| -> Vec<Option<f64>> {
        items
            .iter()
            .map(|item| item.acts(description, mode).then(|| rows[item.row]))
            .collect()
    };
    let known = |q: &[f64], sample: Option<&Sample>| -> Vec<Option<f64>> {
        let outputs = (0..description.observes.len()).map(|i| Some(sample?.observes[i]));
        q.iter().copied().map(Some).chain(outputs).collect()
    };
    let instant = |sample: &Sample, event: &str| Line {
        time: sample.time,
        error: None,
        event: event.to_owned(),
        state: known(&sample.state.q, Some(sample)),
        upper: acting(&sample.forces, &sample.mode),
        lower: Vec::new(),
        impulse: false,
        mode: brief(&sample.mode, description),
    };
    let groups = instants(&outcome.events);
    let happening = |(index, group): &(usize, &[Event<f64>])| {
        let [event, ..] = group else { return None };
        let impulse = event.kind == EventKind::Impact;
        // What an impact changes is told by the events that follow at its instant, where there are any.
        let next = outcome.events.get(index + group.len());
        let told_next = next.is_some_and(|next| {
            (next.time, &next.before, &next.after) == (event.time, &event.before, &event.after)
        });
        let changed = changed(&event.before, &event.after, description);
        let changed = changed.filter(|_| !(impulse && told_next));
        let before = outcome.around.get(*index).and_then(|a| a[0].as_ref());
        Some(Line {
            time: event.time,
            error: None,
            event: named(group, description),
            state: known(&event.state.q, before),
            upper: match impulse {
                true => items
                    .iter()
                    .map(|item| Some(event.impulses[item.row]).filter(|j| *j != 0.0))
                    .collect(),
                false => acting(&event.forces, &event.before),
            },
            lower: match impulse || changed.is_none() {
                true => Vec::new(),
                false => acting(&event.forces_after, &event.after),
            },
            impulse,
            mode: match (changed, event.kind) {
                (Some(changed), _) if impulse => format!("→ {changed}"),
                (Some(changed), _) => format!("\n→ {changed}"),
                (None, EventKind::Stop) => brief(&event.after, description),
                (None, _) => String::new(),
            },
        })
    };
    // An impact at the start is told by itself, after what was before it.
    let first = groups.first().map(|(_, group)| *group);
    let first = first.filter(|group| outcome.is_decided_at_start(&group[0]));
    let decided = first.is_some_and(|group| group[0].kind != EventKind::Impact);
    let start = |sample: &Sample| match first {
        Some(group) if decided => Line {
            event: format!("start\n{}", named(group, description)),
            upper: acting(&group[0].forces_after, &group[0].after),
            mode: brief(&group[0].after, description),
            ..instant(sample, "start")
        },
        Some(group) => Line {
            state: known(
                &group[0].state.q,
                outcome.around.first().and_then(|a| a[0].as_ref()),
            ),
            upper: acting(&group[0].forces, &group[0].before),
            mode: brief(&group[0].before, description),
            ..instant(sample, "start")
        },
        None => instant(sample, "start"),
    };
    let mut lines: Vec<Line> = outcome.first().map(start).into_iter().collect();
    let errors = outcome.estimate.as_ref();
    let errors = errors.map_or(&[][..], |estimate| &estimate.difference.events);
    let told = groups.iter().skip(usize::from(decided));
    lines.extend(told.filter_map(|(index, group)| {
        let errors = errors.iter().skip(*index).take(group.len());
        Some(Line {
            error: errors.copied().reduce(f64::max),
            ..happening(&(*index, *group))?
        })
    }));
    let stopped = outcome
        .events
        .last()
        .is_some_and(|event| event.kind == EventKind::Stop);
    if let Some(last) = outcome.last().filter(|_| !stopped) {
        let how = match outcome.failure {
            None => "end",
            Some(Error::Interrupted { .. }) => "interrupted",
            Some(_) => "failed",
        };
        lines.push(instant(last, how));
    }
    lines
}

/// Events that are one switch, each with the index of its first: all that happens at one instant between the same modes and states.
fn instants(events: &[Event<f64>]) -> Vec<(usize, &[Event<f64>])> {
    let is_impact = |event: &Event<f64>| event.kind == EventKind::Impact;
    let one = |a: &Event<f64>, b: &Event<f64>| {
        (a.time, is_impact(a)) == (b.time, is_impact(b))
            && (&a.before, &a.after) == (&b.before, &b.after)
            && (&a.state, &a.state_after) == (&b.state, &b.state_after)
    };
    let mut index = 0;
    let groups = events.chunk_by(one).map(|group| {
        index += group.len();
        (index - group.len(), group)
    });
    groups.collect()
}

/// What happens in one switch, a line each; of many events the first ones.
fn named(group: &[Event<f64>], description: &'static Description) -> String {
    let told = match group.len() > FEW {
        true => MANY,
        false => group.len(),
    };
    let name = |event: &Event<f64>| format!("{} {}", event.subject.name(description), event.kind);
    let mut lines: Vec<String> = group[..told].iter().map(name).collect();
    if group.len() > told {
        lines.push(format!("and {} more", group.len() - told));
    }
    lines.join("\n")
}

/// A coordinate or an output in the story.
struct Column {
    head: String,
    /// Place in [`Line::state`].
    place: usize,
    scale: f64,
}

impl Column {
    fn of(&self, line: &Line) -> Option<f64> {
        Some(line.state[self.place]? * self.scale)
    }

    /// As many as the lines need. What is nothing but error in all of them is shown beside how far its velocities carry a coordinate, or what an
    /// output ever is.
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
        match largest(&told) < outcome.tolerance * ever {
            true => Decimals::of([ever]),
            false => Decimals::of(told),
        }
    }
}

/// Angles, or all coordinates if none is an angle; then outputs, and then the other coordinates, where there is room beside the forces.
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
            .filter(|place| !places.contains(place))
            .collect();
        if forces + places.len() + new.len() <= NUMBERS {
            places.extend(new);
        }
    }
    places.sort_unstable();
    let column = |place: usize| {
        let (name, quantity) = match place.checked_sub(coordinates.len()) {
            None => (coordinates[place].name, Quantity::Position(place)),
            Some(i) => (description.observes[i].name, Quantity::Output(i)),
        };
        Column {
            head: format!("{}\n{}", symbol(name), quantity.unit(description)),
            place,
            scale: quantity.scale(description),
        }
    };
    places.into_iter().map(column).collect()
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
    let decimals = |(k, item): (usize, &Force)| {
        let held = outcome.samples.iter().map(|sample| sample.held[item.row]);
        let whole = held.fold(of_all(&|other| other.source == item.source), f64::max);
        let beside = of_all(&|other| unit(other) == unit(item));
        if largest[k] < outcome.tolerance * whole {
            Decimals::of([whole])
        } else if largest[k] < f64::EPSILON * beside {
            Decimals::of([beside])
        } else {
            Decimals::of(told(k))
        }
    };
    items.iter().enumerate().map(decimals).collect()
}

fn story(outcome: &Outcome) -> Table {
    let items = forces(outcome.description);
    let lines = entries(outcome, &items);
    let units = &outcome.description.units;
    let shown = shown(outcome.description, items.len());

    let mut table = page();
    let estimated = lines.iter().any(|line| line.error.is_some());
    let mut header = vec!["t\ns".to_owned()];
    if estimated {
        header.push("±\ns".to_owned());
    }
    let texts = header.len();
    header.push("event".to_owned());
    header.extend(shown.iter().map(|column| column.head.clone()));
    header.extend(
        items
            .iter()
            .map(|item| format!("{}\n{}", item.name, units.row(item.row))),
    );
    header.push("mode".to_owned());
    table.set_header(header);

    let of_coordinates: Vec<Decimals> = shown
        .iter()
        .map(|column| column.decimals(&lines, outcome))
        .collect();
    let of_forces = decimals_of_forces(&items, &lines, outcome);
    let lasts = outcome.lasts();
    for line in &lines {
        let mut row = vec![time(line.time, lasts)];
        if estimated {
            row.push(
                line.error
                    .map_or(String::new(), |error| match error < 1e-15 {
                        true => "<1e-15".to_owned(),
                        false => format!("{error:.0e}"),
                    }),
            );
        }
        row.push(line.event.clone());
        row.extend(
            shown.iter().zip(&of_coordinates).map(|(column, decimals)| {
                column.of(line).map_or(String::new(), |x| decimals.show(x))
            }),
        );
        row.extend((0..items.len()).map(|k| {
            let show = |values: &[Option<f64>]| match values.get(k).copied().flatten() {
                Some(value) if line.impulse => format!(
                    "{} {}",
                    of_forces[k].show(value),
                    impulse_unit(units.row(items[k].row))
                )
                .trim_end()
                .to_owned(),
                Some(value) => of_forces[k].show(value),
                None => String::new(),
            };
            format!("{}\n{}", show(&line.upper), show(&line.lower))
                .trim_end()
                .to_owned()
        }));
        row.push(line.mode.clone());
        table.add_row(row);
    }
    let numbers = texts + 1 + shown.len() + items.len();
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((1, 0));
        if index != texts && index < numbers {
            column.set_cell_alignment(CellAlignment::Right);
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
        // Beside so many numbers that they are wider than a page, texts need not be narrow.
        let wide = shown.len() + items.len() > NUMBERS;
        if index == texts {
            // No name is broken: the longest word and the space before it.
            let of = |line: &Line| match wide {
                true => longest(line.event.lines()),
                false => longest(line.event.split_whitespace()),
            };
            let least = lines.iter().map(of).max().unwrap_or(0) + 1;
            column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(least)));
        }
        if index == numbers {
            let most = if wide { 40 } else { 18 };
            let modes = lines.iter().flat_map(|line| line.mode.lines());
            let least = longest(modes).clamp(18, most);
            column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(least)));
        }
    }
    table
}

/// Characters of the longest of some texts.
fn longest<'a>(texts: impl Iterator<Item = &'a str>) -> u16 {
    texts
        .map(|text| text.chars().count() as u16)
        .max()
        .unwrap_or(0)
}

/// Of a force's impulse, `N s`.
pub(super) fn impulse_unit(force: &str) -> String {
    match force {
        "" => String::new(),
        unit if unit.contains('/') => format!("({unit}) s"),
        unit => format!("{unit} s"),
    }
}

fn energy(ledger: &Ledger, unit: &str) -> Table {
    let (start, end) = (&ledger.start, &ledger.end);
    let mut lines = vec![
        ("kinetic", start.kinetic, end.kinetic),
        ("potential", start.potential, end.potential),
        ("total", start.total(), end.total()),
    ];
    if ledger.has_own_jacobi() {
        lines.push(("Jacobi integral", start.jacobi, end.jacobi));
    }
    let works = ledger.work.iter().map(|entry| entry.work);
    let decimals = Decimals::of(lines.iter().flat_map(|(_, a, b)| [*a, *b]).chain(works));
    // Whoever did nothing that the digits show is left out; friction is worth a line even then.
    let counts = |entry: &&Entry| {
        entry.kind == "friction"
            || decimals
                .show(entry.work)
                .contains(|digit| matches!(digit, '1'..='9'))
    };
    let shown: Vec<&Entry> = ledger.work.iter().filter(counts).collect();
    let mut table = page();
    let heading = match unit {
        "" => "energy".to_owned(),
        unit => format!("energy, {unit}"),
    };
    table.set_header([&heading, "start", "end", "change"]);
    for (name, a, b) in lines {
        table.add_row([
            name.to_owned(),
            decimals.show(a),
            decimals.show(b),
            decimals.show(b - a),
        ]);
    }
    for entry in &shown {
        let name = format!("work of {} ({})", entry.name, entry.kind);
        table.add_row([
            name,
            String::new(),
            String::new(),
            decimals.show(entry.work),
        ]);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn work(outcome: &Outcome) -> String {
    let Work {
        steps,
        rejected,
        evaluations,
        series,
        factorizations,
        projections,
    } = outcome.work;
    let of = |count: usize, noun: &str| match count {
        1 => format!("1 {noun}"),
        _ => format!("{count} {noun}s"),
    };
    format!(
        "Work: {}, {rejected} rejected, {}, {series} series, {}, {}, {}.",
        of(steps, "step"),
        of(evaluations, "evaluation"),
        of(factorizations, "factorization"),
        of(projections, "projection"),
        of(outcome.events.len(), "event"),
    )
}

/// Whether a figure is within its bound.
pub(super) fn verdict(holds: bool) -> &'static str {
    match holds {
        true => "holds",
        false => "FAILS",
    }
}

pub(super) fn page() -> Table {
    let rule = LineStyle::none().fill('─').junction('─');
    let mut table = Table::new();
    table
        .load_style(TableStyle::new().header_separator(rule))
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(WIDTH);
    table
}

/// How a column of numbers is written: with five significant digits of its largest.
#[derive(Clone, Copy)]
pub(super) enum Decimals {
    /// With so many of them.
    Plain(usize),
    /// As 1.2345e30.
    Scientific,
}

impl Decimals {
    pub(super) fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let largest = values
            .into_iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        match largest {
            0.0 => Decimals::Plain(4),
            1e-4..1e12 => {
                Decimals::Plain((4.0 - largest.log10().floor()).clamp(0.0, 13.0) as usize)
            }
            _ => Decimals::Scientific,
        }
    }

    /// The number, without the sign of a zero.
    pub(super) fn show(self, value: f64) -> String {
        let text = match self {
            Decimals::Plain(decimals) => format!("{value:.decimals$}"),
            Decimals::Scientific if value == 0.0 => "0".to_owned(),
            Decimals::Scientific => format!("{value:.4e}"),
        };
        match text.strip_prefix('-') {
            Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
            _ => text,
        }
    }
}

/// A time of a run that `lasts` so long: to a microsecond where that has a meaning, and to as much less as the run is shorter than 10 ms.
fn time(t: f64, lasts: f64) -> String {
    let shorter = match lasts > 0.0 && lasts < 1e-2 {
        true => (-1.0 - lasts.log10()).ceil() as usize,
        false => 0,
    };
    match t.abs() < 1e9 && shorter < 9 {
        true => format!("{t:.0$}", 6 + shorter),
        false => format!("{t:.9e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Decimals, time};
    use crate::file::scene;
    use crate::request::Request;

    /// The story of a run, with single blanks.
    fn story(declared: &str) -> Vec<String> {
        let scene = scene("told.lagrange", declared).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let mut text = Vec::new();
        super::write(&outcome, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        text.lines().map(words).collect()
    }

    /// A bead on a hoop that is turned: T has no form quadratic in the velocity, and v ∂T/∂v − T + V stays.
    #[test]
    fn a_story_shows_the_jacobi_integral_where_it_is_not_the_energy() {
        let declared = "
            parameters(m = 0.5, g = 10, r = 2, rate = 3), coordinates(theta),
            kinetic = m/2 * r^2 * (der(theta)^2 + rate^2 * sin(theta)^2),
            potential = -m * g * r * cos(theta), start(a: theta = 0.5), until = 1,";
        let lines = story(declared);
        let (sin, cos) = 0.5_f64.sin_cos();
        let h = -0.5 * 0.5 * 4.0 * 9.0 * sin * sin - 0.5 * 10.0 * 2.0 * cos;
        let own = format!("Jacobi integral {h:.3} {h:.3} 0.000");
        assert!(lines.contains(&own), "{own}\n{lines:#?}");
        let closes = "The ledger of the Jacobi integral closes to";
        assert!(lines.iter().any(|line| line.starts_with(closes)));
        assert!(lines.iter().any(|line| line == super::JACOBI));
        let still = story(&declared.replace("rate = 3", "rate = 0"));
        assert!(still.iter().all(|line| !line.contains("Jacobi")));
    }

    /// A pendulum let go at 60°: it passes below with θ̇² = g/l.
    #[test]
    fn outputs_that_are_angles_are_in_degrees_as_coordinates_are() {
        let lines = story(
            "parameters(m: \"kg\" = 1, l: \"m\" = 1, g: \"m/s^2\" = 10), coordinates(theta: \"rad\"),
             kinetic = m/2 * l^2 * der(theta)^2, potential = -m * g * l * cos(theta),
             observe(incline = theta + pi/6, rate = -der(theta)), start(up: theta = pi/3), stop(low: theta <= 0)",
        );
        assert!(lines.contains(&"s ° ° °/s".to_owned()), "{lines:#?}");
        let rate = 10_f64.sqrt().to_degrees();
        for told in [
            "start 60.000 90.000 0.00 smooth".to_owned(),
            format!("low stop 0.000 30.000 {rate:.2} smooth"),
        ] {
            assert!(
                lines.iter().any(|line| line.ends_with(&told)),
                "{told}\n{lines:#?}"
            );
        }
    }

    /// Two equal springs: one is in the middle when the other is.
    #[test]
    fn what_is_rounding_at_every_event_is_shown_as_zero() {
        let lines = story(
            "coordinates(a, b), kinetic = (der(a)^2 + der(b)^2) / 2, potential = (a^2 + b^2) / 2,
             mark(middle: a), stop(end: t >= 6 and a >= 0), start(both: der(a) = 1, der(b) = 1e-3), until = 6.5,",
        );
        let middle = "middle mark 0.0000 0.0000000";
        assert_eq!(
            lines.iter().filter(|line| line.contains(middle)).count(),
            2,
            "{lines:#?}"
        );
    }

    /// A puck that is pushed along one of two directions that are not those of its coordinates.
    #[test]
    fn what_is_error_across_a_friction_is_shown_as_zero() {
        let lines = story(
            "coordinates(a, b), parameters(c = 0.6, s = 0.8, f = 3, g = 1), kinetic = (der(a)^2 + der(b)^2) / 2,
             force(push: f * t along c * der(a) + s * der(b)),
             friction(table: slip = (c * der(a) + s * der(b), c * der(b) - s * der(a)), limit = g), start(rest: a = 0), until = 1,",
        );
        let slips = lines.iter().find(|line| line.contains("table slips"));
        assert!(
            slips.is_some_and(|line| line.contains("-1.0000 0.0000")),
            "{lines:#?}"
        );
    }

    /// A bead in a hoop that turns: where it does not move along the hoop, what turns the hoop needs no torque.
    #[test]
    fn a_force_that_is_rounding_beside_others_is_shown_as_zero() {
        let lines = story(
            "coordinates(r, theta, psi), parameters(w = 3), kinetic = (der(r)^2 + r^2*der(theta)^2 + r^2*sin(theta)^2*der(psi)^2)/2,
             potential = -10*r*cos(theta), constraint(hoop: r == 1), constraint(turning: psi == w*t),
             stop(rests: t >= 1 and der(theta) >= 0), start(out: r = 1, theta = 1, der(psi) = w), until = 3",
        );
        let stop = lines.iter().find(|line| line.contains("rests stop"));
        assert!(
            stop.is_some_and(|line| line.contains(" -11.776 0.000 ")),
            "{lines:#?}"
        );
    }

    /// A ladder that slips at once at both ends: while it slips its forces are determined.
    #[test]
    fn what_never_acted_is_not_told_as_undetermined() {
        let lines = story(
            "parameters(m: \"kg\" = 10, l: \"m\" = 2, g: \"m/s^2\" = 9.81, lean = 0.7), coordinates(x: \"m\", y: \"m\", theta),
             kinetic = m/2*(der(x)^2 + der(y)^2) + m*l^2/6*der(theta)^2, potential = m*g*y,
             contact(floor: y - l*cos(theta) >= 0), contact(wall: x + l*sin(theta) <= 0),
             friction(foot on floor: slip = der(x - l*sin(theta)), static = 0.3),
             friction(head on wall: slip = der(y + l*cos(theta)), static = 0.2),
             start(leaning: theta = lean, x = -l*sin(lean), y = l*cos(lean)), until = 0.2",
        );
        assert!(
            lines.iter().any(|line| line.contains("foot slips")),
            "{lines:#?}"
        );
        assert!(lines.iter().all(|line| !line.starts_with("Not determined")));
    }

    /// Two blocks that are pulled too hard, and one that is not: nobody sees the two stick, and 10 N on 2 N of friction are 4 m in a second.
    #[test]
    fn the_start_is_one_row_with_what_was_decided_there() {
        let lines = story(
            "parameters(f = 10, g = 2), coordinates(a, b, c), kinetic = (der(a)^2 + der(b)^2 + der(c)^2) / 2,
             force(pull: f along der(a) + der(b)), force(push: c = 1), friction(fa: slip = der(a), limit = g),
             friction(fb: slip = der(b), limit = g), friction(fc: slip = der(c), limit = g), start(rest: a = 0), until = 1,",
        );
        let starting = |with: &str| lines.iter().filter(|line| line.starts_with(with)).count();
        assert_eq!(starting("0.000000"), 1, "{lines:#?}");
        let start = "0.000000 start 0.0000 0.0000 0.0000 -2.0000 -2.0000 -1.0000 fa and fb slip";
        assert_eq!(starting(start), 1, "{lines:#?}");
        assert!(
            starting("fa slips") > 0 && starting("fb slips") > 0,
            "{lines:#?}"
        );
        assert_eq!(
            starting("1.000000 end 4.0000 4.0000 0.0000"),
            1,
            "{lines:#?}"
        );
        assert!(
            lines.iter().all(|line| !line.contains("-10.000")),
            "{lines:#?}"
        );
    }

    /// Two blocks on one ramp of force let go at the same instant: one row, forces before and after.
    #[test]
    fn what_switches_at_one_instant_is_one_row() {
        let lines = story(
            "parameters(f = 4, hold = 2, rub = 1), coordinates(a, b),
             kinetic = (der(a)^2 + der(b)^2) / 2, force(pull: f * t along der(a) + der(b)),
             friction(fa: slip = der(a), static = hold, kinetic = rub, normal = 1),
             friction(fb: slip = der(b), static = hold, kinetic = rub, normal = 1),
             start(rest: a = 0), until = 1,",
        );
        let rows = lines.iter().filter(|line| line.starts_with("0.500000"));
        assert_eq!(rows.count(), 1, "{lines:#?}");
        let second = lines.iter().find(|line| line.starts_with("fb slips"));
        assert!(
            second.is_some_and(|line| line.contains("-1.0000 -1.0000")),
            "{lines:#?}"
        );
    }

    #[test]
    fn five_digits_of_the_largest_number_and_no_negative_zero() {
        let decimals = Decimals::of([12.3456789, -0.00001]);
        assert_eq!(decimals.show(12.3456789), "12.346");
        assert_eq!(decimals.show(-0.00001), "0.000");
        assert_eq!(Decimals::of([0.0]).show(-0.0), "0.0000");
        assert_eq!(Decimals::of([123456.7]).show(123456.7), "123457");
        let far = Decimals::of([-1.5e300]);
        assert_eq!(
            [-1.5e300, 2.0, -0.0].map(|x| far.show(x)),
            ["-1.5000e300", "2.0000e0", "0"]
        );
        assert_eq!(Decimals::of([3e-20]).show(3e-20), "3.0000e-20");
        assert_eq!(Decimals::of([5e-7]).show(5e-7), "5.0000e-7");
    }

    #[test]
    fn times_have_the_digits_that_a_short_run_needs() {
        assert_eq!(time(2.5, 3.0), "2.500000");
        assert_eq!(time(4.35e-6, 1e-4), "0.000004350");
        assert_eq!(time(0.0, 0.0), "0.000000");
    }
}
