//! Outcome → text: the story of the run, then the energy book and the work counts.
//!
//! Each event has two lines: above, the forces just before; below, just after, with what the mode does now that it did not before.
//! An impact shows impulses instead, in one line. Numbers of a column have the same number of decimals, so that they can be compared by eye.

mod decimals;
mod line;
mod story;

use super::words::{FEW, MANY};
use crate::outcome::Outcome;
use crate::quantity::Quantity;
use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};
use core::ops::RangeBounds;
use lagrange_core::prelude::*;
use lagrange_core::trajectory::Entry;
use line::instants;
use std::io::{self, Write};
use story::story;

pub(super) use decimals::{Decimals, time};

/// Columns of the page.
pub(super) const WIDTH: u16 = 100;

/// What the Jacobi integral is, said where it is not the energy: below works, and where none is listed.
const JACOBI: [&str; 2] = [
    "The works above change the Jacobi integral, not T + V: something moves as it is told to, and what it does to T + V has no line.",
    "The Jacobi integral stays, not T + V: something moves as it is told to, and what it does to T + V has no line.",
];

/// Writes the story of `outcome`.
pub fn write(outcome: &Outcome, mut out: impl Write) -> io::Result<()> {
    let left_out = outcome.left_out();
    if !left_out.is_empty() {
        writeln!(out, "Without {}.\n", left_out.join(", "))?;
    }
    for (k, table) in story(outcome).iter().enumerate() {
        let apart = if k > 0 { "\n" } else { "" };
        writeln!(out, "{apart}{}", table.trim_fmt())?;
    }
    if let Some(moved) = moved(outcome) {
        writeln!(out, "\n{moved}")?;
    }
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
    if let Some(at) = times(outcome, |event| event.impulses_undetermined) {
        writeln!(
            out,
            "\nNot determined: how the impulses at {at} are shared out; shown are the least that contacts and friction allow."
        )?;
    }
    let without = outcome.without_value();
    if !without.is_empty() {
        let told = |(output, first): &(&str, f64)| {
            format!("`{output}` at t = {} s", time(*first, outcome.lasts()))
        };
        let told: Vec<String> = without.iter().map(told).collect();
        writeln!(
            out,
            "\nNo finite number: {}. The expression leaves its domain there.",
            told.join(", ")
        )?;
    }
    for told in [MOTION, IMPACT, UNKNOWN]
        .into_iter()
        .filter_map(|kind| told_of(kind, outcome))
    {
        writeln!(out, "\n{told}")?;
    }
    if let Some(missing) = outcome.never_came() {
        writeln!(out, "\n{missing}")?;
    }
    if let Some(stiffness) = outcome.stiffness() {
        writeln!(out, "\n{stiffness}")?;
    }
    if let Some(ledger) = &outcome.ledger {
        let unit = outcome.description.units.energy;
        let (energy, works) = energy(ledger, unit);
        writeln!(out, "\n{}", energy.trim_fmt())?;
        writeln!(
            out,
            "The ledger{} closes to {} of its scale, {}{}{unit}.",
            match ledger.has_own_jacobi() {
                true => " of the Jacobi integral",
                false => "",
            },
            match ledger.closure.abs() / ledger.scale.max(f64::MIN_POSITIVE) {
                0.0 => "0".to_owned(),
                part => format!("{part:.1e}"),
            },
            Decimals::of([ledger.scale]).show(ledger.scale),
            if unit.is_empty() { "" } else { " " }
        )?;
        if ledger.has_own_jacobi() {
            writeln!(out, "{}", JACOBI[usize::from(works == 0)])?;
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

/// What of the start has been moved, and how far, if anything was that its digits show.
fn moved(outcome: &Outcome) -> Option<String> {
    let (asked, sample) = (outcome.asked.as_ref()?, outcome.first()?);
    let at_start = outcome.events.first();
    let at_start = at_start.filter(|event| event.time == sample.time);
    let taken = at_start.map_or(&sample.state, |event| &event.state);
    let d = outcome.description;
    let places = 0..d.coordinates.len();
    let numbers = |state: &State<f64>| [state.q.clone(), state.v.clone()].concat();
    let quantities = places.clone().map(Quantity::Position);
    let quantities = quantities.chain(places.map(Quantity::Velocity));
    let pairs = numbers(asked).into_iter().zip(numbers(taken));
    let told = quantities
        .zip(pairs)
        .filter_map(|(quantity, (asked, taken))| {
            let [asked, taken] = [asked, taken].map(|x| x * quantity.scale(d));
            let by = Decimals::of([taken - asked]).show(taken - asked);
            let decimals = Decimals::of([asked, taken]);
            let shows = decimals.show(asked) != decimals.show(taken);
            let told = format!("{} by {by} {}", quantity.name(d), quantity.unit(d));
            shows.then(|| told.trim_end().to_owned())
        });
    let told: Vec<String> = told.collect();
    let told = told.join(", ");
    (!told.is_empty()).then(|| format!("The start was moved onto what holds there: {told}."))
}

/// Of what a run takes one of several, and where the others are told.
type Choice = (&'static str, &'static str);

const MOTION: Choice = ("motion", ", `lagrange modes` lists all");
const IMPACT: Choice = (
    "impact",
    ", `--format json` has the others as `other_impacts`",
);
/// Of impacts in turn and of Poisson's law.
const UNKNOWN: Choice = ("impact", ", and the others are not known");

fn choice(event: &Event<f64>) -> Choice {
    match event.kind {
        EventKind::Impact if event.other_impacts.is_empty() => UNKNOWN,
        EventKind::Impact => IMPACT,
        _ => MOTION,
    }
}

/// When there are such events, if there are any; of many the first ones.
fn times(outcome: &Outcome, such: impl Fn(&Event<f64>) -> bool) -> Option<String> {
    let groups = instants(&outcome.events);
    let mut found: Vec<String> = groups
        .iter()
        .filter(|(_, group)| group.iter().any(&such))
        .map(|(_, group)| format!("t = {} s", time(group[0].time, outcome.lasts())))
        .collect();
    found.dedup();
    let told = match found.len() > FEW {
        true => MANY,
        false => found.len(),
    };
    let more = match found.len() - told {
        0 => String::new(),
        more => format!(" and {more} times more"),
    };
    (told > 0).then(|| found[..told].join(", ") + &more)
}

/// Where a run could have gone on in another way of this kind, if anywhere.
fn told_of(kind: Choice, outcome: &Outcome) -> Option<String> {
    let at = times(outcome, |event| event.ambiguous && choice(event) == kind)?;
    let (what, others) = kind;
    Some(format!(
        "More than one {what} is possible at {at}: a run takes one{others}."
    ))
}

/// How the energies and works of a ledger are written.
pub(super) fn decimals_of_energies(ledger: &Ledger) -> Decimals {
    let energies = [&ledger.start, &ledger.end].into_iter();
    let energies = energies.flat_map(|e| {
        let jacobi = ledger.has_own_jacobi().then_some(e.jacobi);
        [e.kinetic, e.potential, e.total()]
            .into_iter()
            .chain(jacobi)
    });
    Decimals::of(energies.chain(ledger.work.iter().map(|entry| entry.work)))
}

/// The ledger, and how many works are listed in it.
fn energy(ledger: &Ledger, unit: &str) -> (Table, usize) {
    let (start, end) = (&ledger.start, &ledger.end);
    let mut lines = vec![
        ("kinetic", start.kinetic, end.kinetic),
        ("potential", start.potential, end.potential),
        ("total", start.total(), end.total()),
    ];
    if ledger.has_own_jacobi() {
        lines.push(("Jacobi integral", start.jacobi, end.jacobi));
    }
    let decimals = decimals_of_energies(ledger);
    // Whoever did nothing that the digits show is left out; of few, friction is worth a line even then.
    let frictions = ledger.work.iter().filter(|entry| entry.kind == "friction");
    let few = frictions.count() <= FEW;
    let counts = |entry: &&Entry| {
        few && entry.kind == "friction"
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
    (table, shown.len())
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

/// Lays out columns from the left edge of a page; those of `numbers` stand at the right of theirs.
pub(super) fn align(table: &mut Table, numbers: impl RangeBounds<usize>) {
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((if index == 0 { 0 } else { 1 }, 1));
        if numbers.contains(&index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Decimals, time};
    use crate::file::scene;
    use crate::report::{CORNER, PLANK};
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

    /// A mass on a spring, at 4 rad/s for 9000 s with a tolerance of 1e-3: what its velocity carries it is 1000 times beside what it starts from.
    #[test]
    fn what_a_long_motion_starts_from_is_told() {
        let declared = "parameters(m: \"kg\" = 2, k: \"N/m\" = 32), coordinates(x: \"m\"), kinetic = m/2*der(x)^2, potential = k/2*x^2,
            start(pulled: x = 0.7), until = 9000";
        let scene = scene("spring.lagrange", declared).expect("a declaration");
        let request = Request {
            tolerance: 1e-3,
            ..Request::default()
        };
        let outcome = scene.run(&request).expect("a run");
        let mut text = Vec::new();
        super::write(&outcome, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let start = text.lines().find(|line| line.contains("start"));
        assert!(start.is_some_and(|line| line.contains("0.70000")), "{text}");
    }

    /// Nine blocks on a shelf: more numbers than a line has stand below, with the times.
    #[test]
    fn no_line_of_a_story_is_wider_than_a_page() {
        let declared = "parameters(m = 1, g = 10), coordinates(height[9]), kinetic = sum(k in 0..9: m/2 * der(height[k])^2),
            potential = sum(k in 0..9: (k + 1) * g * height[k]), contact(shelf[k in 0..9]: height[k] >= 0),
            mark(noon: t - 0.5), start(lying: height[0] = 0), until = 1";
        let scene = scene("shelf.lagrange", declared).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let mut text = Vec::new();
        super::write(&outcome, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let story = text.split("energy").next().unwrap_or_default();
        let widest = story
            .lines()
            .map(|line| line.trim_end().chars().count())
            .max();
        assert!(widest <= Some(usize::from(super::WIDTH)), "{text}");
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let noon: Vec<String> = story
            .lines()
            .map(words)
            .filter(|line| line.contains("noon"))
            .collect();
        let loads = |from: u32, to: u32| {
            let loads = (from..to).map(|k| format!("{:.3}", 10.0 * f64::from(k)));
            loads.collect::<Vec<_>>().join(" ")
        };
        assert!(noon.len() > 1, "{text}");
        assert!(
            noon.iter().any(|line| line.contains(&loads(1, 4))),
            "{noon:#?}"
        );
        assert!(
            story
                .lines()
                .filter(|line| line.contains("all 9 contacts"))
                .count()
                >= 2,
            "{text}"
        );
    }

    /// A bead beside its ring, and a roller that does not roll: each is moved by least squares of the masses, here one.
    #[test]
    fn how_far_a_start_is_moved_is_told() {
        let declared = "coordinates(x, y, phi), kinetic = (der(x)^2 + der(y)^2 + der(phi)^2) / 2, constraint(ring: x^2 + y^2 == 25),
            constraint(rolls: der(phi) == 3), start(out: x = 3.3, y = 4.4), until = 0.1";
        let scene = scene("ring.lagrange", declared).expect("a declaration");
        let told = |project: bool| {
            let request = Request {
                project,
                ..Request::default()
            };
            let outcome = scene.run(&request).expect("a run");
            let mut text = Vec::new();
            super::write(&outcome, &mut text).expect("memory");
            let text = String::from_utf8(text).expect("text");
            let mut lines = text.lines();
            lines
                .find(|line| line.starts_with("The start was moved"))
                .map(str::to_owned)
        };
        assert_eq!(told(false), None);
        let expected = "The start was moved onto what holds there: x by -0.30000, y by -0.40000, dφ/dt by 171.89 °/s.";
        assert_eq!(told(true).as_deref(), Some(expected));
    }

    /// A ball that keeps 0.9 of its speed, g = 8: from 1 m it falls 0.5 s, and the k-th flight takes 0.9^k s.
    #[test]
    fn of_a_long_series_of_impacts_the_first_and_the_last_are_told() {
        let declared = "coordinates(y), kinetic = der(y)^2 / 2, potential = 8 * y, contact(floor: y >= 0, restitution = 0.9),
            start(drop: y = 1), until = 7.3";
        let lines = story(declared);
        let impacts: Vec<&String> = lines
            .iter()
            .filter(|line| line.contains("floor impact"))
            .collect();
        let last = (1..14).fold(0.5, |t, k| t + 0.9_f64.powi(k));
        assert_eq!(impacts.len(), 2, "{lines:#?}");
        assert!(
            impacts[0].starts_with("0.500000 floor impact"),
            "{lines:#?}"
        );
        assert!(
            impacts[1].starts_with(&format!("{last:.6} floor impact")),
            "{last} {lines:#?}"
        );
        assert!(lines.contains(&"12 more".to_owned()), "{lines:#?}");
        let few = story(&declared.replace("7.3", "5"));
        assert_eq!(
            few.iter()
                .filter(|line| line.contains("floor impact"))
                .count(),
            7
        );
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
        let said = |lines: &[String]| super::JACOBI.map(|it| lines.iter().any(|line| line == it));
        assert_eq!(said(&lines), [false, true]);
        let pushed = story(&declared.replace("start", "force(push: theta = 1), start"));
        assert_eq!(said(&pushed), [true, false], "{pushed:#?}");
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

    /// A ball over ten steps, of which it meets the highest only; outputs are the ball's own coordinate and another one.
    #[test]
    fn a_story_shows_what_acts_and_what_is_observed_once() {
        let lines = story(
            "coordinates(y, far), kinetic = (der(y)^2 + der(far)^2) / 2, potential = 10 * y,
             contact(step[k in 0..10]: y >= k - 9), observe(y, low = y - 1), start(up: y = 1), until = 1,",
        );
        assert_eq!(lines[0], "t event y far low step[9] mode", "{lines:#?}");
        assert!(
            lines.iter().all(|line| !line.contains("0.0e0")),
            "{lines:#?}"
        );
    }

    /// A force of 1e-17 N beside one of 10 N, and 1e-20 m beside 1 m.
    #[test]
    fn what_is_rounding_beside_its_unit_is_shown_as_zero() {
        let lines = story(
            "parameters(m: \"kg\" = 1, g: \"m/s^2\" = 10, p: \"N\" = 1e-17, near: \"m\" = 1e-20, far: \"m\" = 1), coordinates(x: \"m\", y: \"m\"),
             kinetic = m/2 * (der(x)^2 + der(y)^2), potential = m * g * y + p * x,
             constraint(shelf: y == far), constraint(wall: x == near), start(up: y = far, x = near), until = 1,",
        );
        let start = "0.000000 start 0.0000 1.0000 10.000 0.000 smooth";
        assert!(lines.iter().any(|line| line == start), "{lines:#?}");
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

    #[test]
    fn impulses_that_are_not_determined_are_told() {
        let told = "Not determined: how the impulses at t = 0.200000 s are shared out; shown are the least that contacts and friction allow.";
        assert!(
            story(PLANK).iter().any(|line| line == told),
            "{:#?}",
            story(PLANK)
        );
        let two = story(&PLANK.replace("in 0..3", "in 0..2"));
        assert!(
            two.iter().all(|line| !line.contains("impulses")),
            "{two:#?}"
        );
    }

    /// Which of the ball's frictions sticks nothing says.
    #[test]
    fn where_the_other_impacts_are_is_told() {
        let said = |declared: &str| {
            let mut lines = story(declared);
            lines.retain(|line| line.starts_with("More than one"));
            lines.join("\n")
        };
        assert_eq!(
            said(CORNER),
            "More than one impact is possible at t = 1.000000 s: a run takes one, `--format json` has the others as `other_impacts`."
        );
        assert_eq!(said(&CORNER.replace("mu = 1", "mu = 0")), "");
        // Nobody knows the others of a wheel that jams at a kerb by Poisson's law.
        let kerb = "
            parameters(r = 0.3, h = 0.1, mu = 5), coordinates(x, y, phi), define(d = sqrt(x^2 + (y - h)^2)),
            kinetic = (der(x)^2 + der(y)^2 + r^2/2 * der(phi)^2) / 2, contact(floor: y >= r), contact(edge: d >= r, restitution = poisson(0)),
            friction(under on floor: slip = der(x) - r * der(phi), static = mu),
            friction(fore on edge: slip = ((y - h) * der(x) - x * der(y)) / d - r * der(phi), static = mu),
            start(rolling: x = -1, y = r, der(x) = 1, der(phi) = 1/r), until = 0.8,";
        assert_eq!(
            said(kerb),
            "More than one impact is possible at t = 0.776393 s: a run takes one, and the others are not known."
        );
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
