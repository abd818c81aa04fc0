//! What was derived for a run, typeset: declaration, energies, equations of motion, rows, and each mode that the run was in.

use super::{Shown, minus};
use crate::outcome::Outcome;
use crate::report::table::time;
use lagrange_core::prelude::*;
use lagrange_engine::inspect::print::mathml::{self, escaped};
use lagrange_engine::inspect::print::{said, titled};
use lagrange_engine::inspect::{self, Formula, Guard, Letter, Statement};
use lagrange_engine::inspect_without;
use std::fmt::Write;

/// More modes than this are not written out.
const MODES: usize = 12;
/// More rows than this are not shown.
const ROWS: usize = 24;
/// Of more spans of a mode only so many are told.
const SPANS: usize = 3;

/// The section. What the run leaves out is not in it, as far as whole items of the declaration are left out.
pub(super) fn equations(run: &Shown) -> String {
    let outcome = &run.film.outcome;
    let tokens = || {
        run.derivation
            .declaration
            .parse::<proc_macro2::TokenStream>()
    };
    let (Ok(all), Ok(left)) = (tokens(), tokens()) else {
        return String::new();
    };
    let left_out = outcome.left_out();
    let mut note = String::new();
    let derived = inspect_without(left, &left_out, None).or_else(|refusal| {
        note = "<p class=\"note\">These are the equations with nothing left out.</p>\n".to_owned();
        if left_out.is_empty() {
            Err(refusal)
        } else {
            inspect_without(all, &[], None)
        }
    });
    let Ok(derived) = derived else {
        return String::new();
    };
    let title = escaped(&run.title);
    let (declared, bodies) = (declared(&derived), bodies(&derived));
    let energies: String = derived.energies().map(titled).collect();
    let motion: String = derived
        .motion
        .iter()
        .map(|e| titled(&e.statement))
        .collect();
    let rows = rows(&derived);
    let modes = modes(run, &derived);
    let impacts = impacts(outcome, &derived);
    format!(
        "<h3>Equations</h3>\n{note}<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"Equations of {title}\">\n\
         <h4>Declared</h4>\n{declared}{bodies}<h4>Energies</h4>\n{energies}\n<h4>Equations of motion</h4>\n{motion}\n\
         {rows}{modes}{impacts}</div>\n"
    )
}

/// What the user wrote that makes the motion: energies, constraints, contacts, friction laws, forces, and what they are written with.
fn declared(derived: &inspect::Derivation) -> String {
    const TOLD: [&str; 9] = [
        "define",
        "kinetic",
        "potential",
        "lagrangian",
        "constraint",
        "contact",
        "friction",
        "force",
        "dissipation",
    ];
    let items = derived.declared.iter();
    let items = items.filter(|item| TOLD.contains(&item.keyword));
    let row = |item: &inspect::Item| {
        let name = escaped(&item.name);
        format!(
            "<tr><th scope=\"row\">{} {name}</th><td>{}</td></tr>\n",
            item.keyword,
            said(item)
        )
    };
    format!("<table>\n{}</table>\n", items.map(row).collect::<String>())
}

/// What the rates and axes of bodies in space are.
fn bodies(derived: &inspect::Derivation) -> String {
    let body = |body: &inspect::Body| {
        let definitions: String = body.definitions.iter().map(titled).collect();
        format!("<p>{}</p>\n{definitions}\n", escaped(&body.text))
    };
    match derived.bodies.as_slice() {
        [] => String::new(),
        list => format!(
            "<h4>Bodies in space</h4>\n{}",
            list.iter().map(body).collect::<String>()
        ),
    }
}

fn rows(derived: &inspect::Derivation) -> String {
    if derived.rows.is_empty() {
        return String::new();
    }
    let row = |row: &inspect::Row| {
        format!(
            "<tr><th scope=\"row\">{} ({})</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&row.name),
            row.kind,
            within(&row.declared, row.region.as_ref()),
            mathml::statement(&row.acceleration),
            letter(&row.multiplier),
            escaped(&row.when),
        )
    };
    let shown: String = derived.rows.iter().take(ROWS).map(row).collect();
    let left = match derived.rows.len().saturating_sub(ROWS) {
        0 => String::new(),
        left => format!("<p class=\"note\">{left} more like these.</p>\n"),
    };
    format!(
        "<h4>Constraints, contacts and slips</h4>\n<table>\n<thead><tr><th scope=\"col\">row</th><th scope=\"col\">declared</th>\
         <th scope=\"col\">on accelerations</th><th scope=\"col\">force</th><th scope=\"col\">acts</th></tr></thead>\n\
         <tbody>\n{shown}</tbody>\n</table>\n{left}"
    )
}

/// Each mode that the run was in, in the order in which it met them.
fn modes(run: &Shown, derived: &inspect::Derivation) -> String {
    let outcome = &run.film.outcome;
    let mut names: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for phase in &outcome.phases {
        let name = name(outcome, &phase.mode);
        let span = [phase.from, phase.to];
        match names.iter_mut().find(|(other, _)| *other == name) {
            Some((_, spans)) => spans.push(span),
            None => names.push((name, vec![span])),
        }
    }
    if derived.mode_count < 2 {
        return String::new();
    }
    let mut out = String::from("<h4>Modes of this run</h4>\n");
    for (name, spans) in names.iter().take(MODES) {
        let _ = write!(
            out,
            "<h5>{}</h5>\n<p>{}</p>\n",
            escaped(name),
            when(spans, outcome.lasts())
        );
        let known = derived
            .modes
            .iter()
            .find(|mode| mode.name == *name)
            .cloned();
        let asked = || {
            let tokens = run.derivation.declaration.parse().ok()?;
            let one = inspect_without(tokens, &outcome.left_out(), Some(name)).ok()?;
            one.modes.into_iter().next()
        };
        match known.or_else(asked) {
            Some(mode) => self::mode(&mode, &mut out),
            None => out.push_str("<p class=\"note\">Its equations are not written out.</p>\n"),
        }
    }
    if names.len() > MODES {
        let left = names.len() - MODES;
        let _ = writeln!(
            out,
            "<p class=\"note\">{left} more modes are not written out.</p>"
        );
    }
    out
}

fn mode(mode: &inspect::Mode, out: &mut String) {
    if !mode.known.is_empty() {
        let held: Vec<String> = mode.known.iter().map(mathml::statement).collect();
        let _ = writeln!(out, "<p>Held: {}</p>", held.join(", "));
    }
    let unknowns: Vec<String> = mode.unknowns.iter().take(ROWS).map(letter).collect();
    let more = if mode.unknowns.len() > ROWS {
        ", …"
    } else {
        ""
    };
    let _ = writeln!(out, "<p>Unknown: {}{more}</p>", unknowns.join(", "));
    out.extend(mode.equations.iter().map(titled));
    let solution = mode.solution.as_deref().unwrap_or_default();
    if !solution.is_empty() {
        out.push_str("<p>Hence</p>\n");
        out.extend(solution.iter().map(titled));
    }
    let unsolved: Vec<String> = mode.unsolved().into_iter().map(letter).collect();
    if !unsolved.is_empty() {
        let _ = writeln!(
            out,
            "<p>Not in closed form, or too long to be written out: {}</p>",
            unsolved.join(", ")
        );
    }
    if mode.guards.is_empty() {
        return;
    }
    let row = |guard: &Guard| {
        format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
            escaped(&guard.meaning),
            within(&guard.statement, guard.region.as_ref()),
            escaped(&guard.otherwise),
        )
    };
    let rows: String = mode.guards.iter().map(row).collect();
    let _ = writeln!(
        out,
        "<table>\n<thead><tr><th scope=\"col\">as long as</th><th scope=\"col\">that is</th><th scope=\"col\">else</th></tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table>"
    );
}

/// What holds, and the region in which it does.
fn within(statement: &Statement, region: Option<&Statement>) -> String {
    let region = region.map(|region| format!(" where {}", mathml::statement(region)));
    mathml::statement(statement) + &region.unwrap_or_default()
}

/// What happens at the impacts that there were.
fn impacts(outcome: &Outcome, derived: &inspect::Derivation) -> String {
    let hit = |contact: &str| {
        let mut events = outcome.events.iter();
        events.any(|event| {
            event.kind == EventKind::Impact && event.subject.name(outcome.description) == contact
        })
    };
    let mut out = String::new();
    for impact in derived.impacts.iter().filter(|impact| hit(&impact.contact)) {
        let [gap, rate] = impact.when.each_ref().map(mathml::statement);
        let region = impact.region.as_ref();
        let region = region.map(|region| format!(", {}", mathml::statement(region)));
        let region = region.unwrap_or_default();
        let _ = write!(
            out,
            "<h5>{}</h5>\n<p>When {gap}{region} and {rate}:</p>\n{}<p>{}</p>\n",
            escaped(&impact.contact),
            impact.equations.iter().map(titled).collect::<String>(),
            escaped(&impact.note)
        );
    }
    match out.is_empty() {
        true => out,
        false => format!("<h4>Impacts of this run</h4>\n{out}"),
    }
}

/// A mode as the derivation calls it: without what is left out, and without branches, which are in its formulas.
fn name(outcome: &Outcome, mode: &Mode) -> String {
    let description = outcome.description;
    let contacts = description.contacts.iter().zip(&mode.contacts).enumerate();
    let contacts = contacts
        .filter(|(i, _)| outcome.effects.includes(description, Item::Contact(*i)))
        .map(|(_, (contact, closed))| {
            format!(
                "{} {}",
                contact.name,
                if *closed { "closed" } else { "open" }
            )
        });
    let acting = mode
        .frictions
        .iter()
        .filter(|state| **state != FrictionMode::Inactive);
    let display = mode.display(description).to_string();
    let words = display.split(", ").skip(mode.contacts.len());
    let words = words.take(acting.count()).map(str::to_owned);
    let words: Vec<String> = contacts.chain(words).collect();
    match words.is_empty() {
        true => "smooth".to_owned(),
        false => words.join(", "),
    }
}

/// When a run, which `lasts` so long, was in a mode.
fn when(spans: &[[f64; 2]], lasts: f64) -> String {
    let told = spans.iter().take(SPANS);
    let at = |instant: f64| minus(&time(instant, lasts));
    let told: Vec<String> = told
        .map(|[from, to]| format!("{} s to {} s", at(*from), at(*to)))
        .collect();
    let more = match spans.len().saturating_sub(SPANS) {
        0 => String::new(),
        more => format!(", and {more} more times"),
    };
    format!("From {}{more}.", told.join(", "))
}

fn letter(letter: &Letter) -> String {
    mathml::formula(&Formula::Letter(letter.clone()))
}
