//! What a page says in tables: events, parameters, energy and accuracy.

use super::{Shown, minus};
use crate::notation::impulse_unit;
use crate::notation::{is_angle, symbol};
use crate::outcome::rounding::ROUNDING;
use crate::outcome::{Force, forces};
use crate::report::table::{Decimals, decimals_of_energies, time};
use crate::report::words::Names;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::*;
use lagrange_core::trajectory::Entry;
use lagrange_engine::inspect::print::mathml::escaped;
use std::fmt::Write;

/// More events than this are left out.
const EVENTS: usize = 200;
/// More coordinates than this, and more forces of those that act, do not have columns.
const COLUMNS: usize = 8;

pub(super) fn tables(run: &Shown) -> String {
    let small = [parameters(run), energy(run), accuracy(run)].concat();
    format!("{}<div class=\"tables\">\n{small}</div>\n", events(run))
}

/// A table that scrolls by itself on narrow screens.
fn table(run: &Shown, caption: &str, head: &[String], rows: &[Vec<String>]) -> String {
    let cells = |tag: &str, row: &[String]| -> String {
        let cell = |(i, text): (usize, &String)| match (tag, i) {
            ("td", 0) => format!("<th scope=\"row\">{text}</th>"),
            ("td", _) => format!("<td>{text}</td>"),
            _ => format!("<th scope=\"col\">{text}</th>"),
        };
        format!(
            "<tr>{}</tr>\n",
            row.iter().enumerate().map(cell).collect::<String>()
        )
    };
    let head = match head {
        [] => String::new(),
        head => format!("<thead>{}</thead>\n", cells("th", head)),
    };
    let body: String = rows.iter().map(|row| cells("td", row)).collect();
    let label = format!("{caption} of {}", escaped(&run.title));
    format!(
        "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{label}\">\n<table>\n\
         <caption>{caption}</caption>\n{head}<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )
}

fn events(run: &Shown) -> String {
    let outcome = &run.film.outcome;
    let description = outcome.description;
    if outcome.events.is_empty() {
        return "<p>No events.</p>\n".to_owned();
    }
    let named = |name: &str, unit: &str| match unit {
        "" => escaped(name),
        unit => format!("{} [{}]", escaped(name), escaped(unit)),
    };
    let told = &outcome.events[..outcome.events.len().min(EVENTS)];
    let force = |force: &Force, event: &Event<f64>| {
        let (rows, mode) = match outcome.is_decided_at_start(event) {
            true => (&event.forces_after, &event.after),
            false => (&event.forces, &event.before),
        };
        let impulse = event.impulses.get(force.row).copied().unwrap_or(0.0);
        match event.kind {
            EventKind::Impact if impulse != 0.0 => {
                let unit = impulse_unit(description.units.row(force.row));
                Some((impulse, unit))
            }
            EventKind::Impact => None,
            _ => force
                .acts(description, mode)
                .then(|| (rows[force.row], String::new())),
        }
    };
    let position = |i: usize, event: &Event<f64>| match (
        event.state.q[i],
        is_angle(&description.coordinates[i]),
    ) {
        (q, true) if q.abs() < ROUNDING => 0.0,
        (q, true) => q.to_degrees(),
        (q, false) => q,
    };
    let coordinates = &description.coordinates;
    let coordinates = &coordinates[..coordinates.len().min(COLUMNS)];
    let acts = |one: &Force| told.iter().any(|event| force(one, event).is_some());
    let acting: Vec<Force> = forces(description).into_iter().filter(acts).collect();
    let all = &acting[..acting.len().min(COLUMNS)];
    let mut head: Vec<String> = ["t [s]", "event", "mode after"].map(str::to_owned).into();
    head.extend(coordinates.iter().map(|c| match is_angle(c) {
        true => format!("{} [°]", symbol(c.name)),
        false => named(&symbol(c.name), c.unit),
    }));
    head.extend(
        all.iter()
            .map(|force| named(&force.name, description.units.row(force.row))),
    );
    let names = Names::of(outcome, []);
    let of_positions =
        (0..coordinates.len()).map(|i| Decimals::of(told.iter().map(|event| position(i, event))));
    let of_positions: Vec<Decimals> = of_positions.collect();
    let of_forces = all.iter().map(|one| {
        let forces = told.iter().filter_map(|event| force(one, event));
        Decimals::of(forces.map(|(x, _)| x))
    });
    let of_forces: Vec<Decimals> = of_forces.collect();
    let row = |event: &Event<f64>| {
        let at = event.time;
        let mut row = vec![
            format!(
                "<button type=\"button\" class=\"jump\" data-time=\"{at}\">{}</button>",
                minus(&time(at, outcome.lasts()))
            ),
            escaped(&format!(
                "{} {}",
                event.subject.name(description),
                event.kind
            )),
            escaped(&names.brief(&event.after)),
        ];
        let positions = of_positions.iter().enumerate();
        row.extend(positions.map(|(i, decimals)| minus(&decimals.show(position(i, event)))));
        let forces = all.iter().zip(&of_forces);
        row.extend(forces.map(|(one, decimals)| {
            match force(one, event) {
                Some((x, unit)) => format!("{} {unit}", minus(&decimals.show(x)))
                    .trim_end()
                    .to_owned(),
                None => "–".to_owned(),
            }
        }));
        row
    };
    let rows: Vec<Vec<String>> = told.iter().map(row).collect();
    let mut note = "State and forces just before each event, at the start just after it; of impacts their impulses.".to_owned();
    for (left, what) in [
        (outcome.events.len() - told.len(), "events"),
        (
            description.coordinates.len() - coordinates.len(),
            "coordinates",
        ),
        (acting.len() - all.len(), "forces that act"),
    ] {
        if left > 0 {
            let _ = write!(note, " {left} more {what} are left out.");
        }
    }
    table(run, "Events", &head, &rows) + &format!("<p class=\"note\">{note}</p>\n")
}

fn parameters(run: &Shown) -> String {
    let outcome = &run.film.outcome;
    let list = outcome.description.parameters.iter();
    let row = |(parameter, value): (&lagrange_core::system::Parameter, &f64)| {
        let text = parameter.documentation.trim().lines().next();
        vec![
            escaped(parameter.name),
            Shortest(*value).to_string(),
            escaped(parameter.unit),
            escaped(text.unwrap_or_default().trim()),
        ]
    };
    let mut rows: Vec<Vec<String>> = list.zip(&outcome.parameters).map(row).collect();
    let mut head = vec!["name", "value", "unit", "meaning"];
    // Often nobody has said what the parameters are.
    if rows.iter().all(|row| row[3].is_empty()) {
        head.truncate(3);
        rows.iter_mut().for_each(|row| row.truncate(3));
    }
    let head: Vec<String> = head.into_iter().map(str::to_owned).collect();
    match rows.is_empty() {
        true => String::new(),
        false => table(run, "Parameters", &head, &rows),
    }
}

fn energy(run: &Shown) -> String {
    let Some(ledger) = &run.film.outcome.ledger else {
        return String::new();
    };
    let unit = run.film.outcome.description.units.energy;
    let unit = match unit {
        "" => String::new(),
        unit => format!(" [{}]", escaped(unit)),
    };
    let decimals = decimals_of_energies(ledger);
    let line = |name: &str, value: f64| vec![escaped(name), minus(&decimals.show(value))];
    let both = |when: &str, energies: &Energies| {
        let mut rows = vec![
            line(&format!("kinetic, {when}"), energies.kinetic),
            line(&format!("potential, {when}"), energies.potential),
        ];
        if ledger.has_own_jacobi() {
            rows.push(line(&format!("Jacobi integral, {when}"), energies.jacobi));
        }
        rows
    };
    let mut rows = both("at the start", &ledger.start);
    // Whoever did nothing that the digits show is left out.
    let shows = |e: &&Entry| decimals.show(e.work) != decimals.show(0.0);
    let work = ledger.work.iter().filter(shows);
    rows.extend(work.map(|e| line(&format!("work of {} ({})", e.name, e.kind), e.work)));
    rows.extend(both("at the end", &ledger.end));
    rows.push(vec![
        "closure: what is left unexplained".to_owned(),
        minus(&Decimals::of([ledger.closure]).show(ledger.closure)),
    ]);
    table(
        run,
        "Energy",
        &["what".to_owned(), format!("value{unit}")],
        &rows,
    )
}

fn accuracy(run: &Shown) -> String {
    let outcome = &run.film.outcome;
    let work = outcome.work;
    let line = |name: &str, value: String| vec![name.to_owned(), value];
    let mut rows = vec![
        line("scene", escaped(outcome.scene)),
        line("program", format!("lagrange {}", env!("CARGO_PKG_VERSION"))),
        line("method", escaped(&outcome.method.to_string())),
        line(
            "tolerance, relative and absolute",
            format!("{:e}", outcome.tolerance),
        ),
    ];
    for (name, absolute) in &outcome.absolute {
        let what = format!("absolute tolerance of {}", escaped(name));
        rows.push(line(&what, format!("{absolute:e}")));
    }
    if let Some(estimate) = &outcome.estimate {
        rows.push(line("off by", escaped(&estimate.to_string())));
    }
    if let Some(drift) = run.film.drift {
        rows.push(line(
            "what must hold is off by at most",
            match drift {
                0.0 => "0".to_owned(),
                drift => format!("{drift:.1e} of its scale"),
            },
        ));
    }
    if let Some(ledger) = &outcome.ledger {
        let relative = ledger.closure.abs() / ledger.scale.max(f64::MIN_POSITIVE);
        rows.push(line(
            "energy book closes to",
            format!("{relative:.1e} of its scale"),
        ));
    }
    if let Some(certificate) = &outcome.certificate {
        let text = escaped(&certificate.to_string());
        rows.push(line("checked against the declaration", text));
    }
    rows.extend([
        line(
            "steps",
            format!("{} ({} rejected)", work.steps, work.rejected),
        ),
        line("evaluations of the equations", work.evaluations.to_string()),
        line("Taylor series", work.series.to_string()),
        line("factorizations", work.factorizations.to_string()),
    ]);
    rows.push(line(
        "projections onto constraints",
        work.projections.to_string(),
    ));
    if let Some(missing) = outcome.never_came() {
        rows.push(line("end", escaped(&missing)));
    }
    if let Some(stiffness) = outcome.stiffness() {
        rows.push(line("stiffness", stiffness));
    }
    let left_out = outcome.left_out();
    if !left_out.is_empty() {
        rows.push(line("left out", escaped(&left_out.join(", "))));
    }
    let open = outcome.undetermined();
    if !open.is_empty() {
        rows.push(line(
            "forces that are not determined",
            escaped(&open.join(", ")),
        ));
    }
    table(
        run,
        "Accuracy and work",
        &["what".to_owned(), "value".to_owned()],
        &rows,
    )
}
