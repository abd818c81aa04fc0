//! A derivation as JSON. The layout is a contract: what is there stays; more may be added. Its name is in `schema`.
//!
//! ```text
//! { "schema": "lagrange.derivation.1", "name", "summary",
//!   "symbols":   [{ "name", "letter": F, "text", "unit" }],
//!   "declared":  [{ "item", "name", "parts": [text | F | S] }],
//!   "energies":  { "kinetic": F, "potential": F, "lagrangian": S | null },
//!   "bodies":    [{ "name", "text", "definitions": [S] }],
//!   "motion":    [{ "coordinate": F, "equation": S }],
//!   "rows":      [{ "name", "kind", "declared": S, "where": S | null, "acceleration": S, "multiplier": F, "acts" }],
//!   "mode_count", "modes": [{ "name", "known": [S], "unknowns": [F], "equations": [S], "solution": [S], "left_out": [F],
//!                 "guards": [{ "while": S, "where": S | null, "otherwise" }], "operations", "operations_with_guards",
//!                 "functions": { "constants", "unknowns", "accelerations", "whole", "convolutions" } | null }],
//!   "switches":  [{ "from", "to", "label" }]        indices of modes
//!   "impacts":   [{ "contact", "when": [S, S], "where": S | null, "equations": [S], "note" }],
//!   "conserved": [{ "name", "quantity": S, "rate": S | null, "when" }],
//!   "checks":    [{ "name", "claim", "outcome" }],
//!   "operations": [{ "effect", "alone", "shared" }],
//!   "hints":     [text], "notes": [text] }
//!
//! F = { "text", "latex" }        S = { "left": F, "relation": "=" | ">=" | "<=" | ">" | "<", "right": F }
//! ```

use super::{latex, text};
use crate::inspect::formula::{Formula, Relation, Statement};
use crate::inspect::letter::Letter;
use crate::inspect::{
    Body, Checked, Conserved, Cost, Derivation, Equation, Impact, Item, Meaning, Mode, Part, Row,
    Switch,
};

/// The whole derivation as JSON.
pub fn json(d: &Derivation) -> String {
    let energies = object(&[
        ("kinetic", formula(&d.kinetic.right)),
        ("potential", formula(&d.potential.right)),
        ("lagrangian", maybe(d.lagrangian.as_ref())),
    ]);
    let whole = object(&[
        ("schema", quoted("lagrange.derivation.1")),
        ("name", quoted(&d.name)),
        ("summary", quoted(&d.summary)),
        ("symbols", list(d.symbols.iter().map(symbol))),
        ("declared", list(d.declared.iter().map(declared))),
        ("energies", energies),
        ("bodies", list(d.bodies.iter().map(body))),
        ("motion", list(d.motion.iter().map(motion))),
        ("rows", list(d.rows.iter().map(row))),
        ("mode_count", d.mode_count.to_string()),
        ("modes", list(d.modes.iter().map(mode))),
        ("switches", list(d.switches.iter().map(switch))),
        ("impacts", list(d.impacts.iter().map(impact))),
        ("conserved", list(d.conserved.iter().map(conserved))),
        ("checks", list(d.checks.iter().map(check))),
        ("operations", list(d.costs.iter().map(cost))),
        ("hints", list(d.hints.iter().map(|hint| quoted(hint)))),
        ("notes", list(d.notes.iter().map(|note| quoted(note)))),
    ]);
    whole + "\n"
}

fn symbol(meaning: &Meaning) -> String {
    object(&[
        ("name", quoted(&meaning.name)),
        ("letter", letter(&meaning.letter)),
        ("text", quoted(&meaning.text)),
        ("unit", quoted(&meaning.unit)),
    ])
}

fn declared(item: &Item) -> String {
    let parts = item.parts.iter().map(|part| match part {
        Part::Word(word) => quoted(word),
        Part::Formula(f) => formula(f),
        Part::Statement(s) => statement(s),
    });
    object(&[
        ("item", quoted(item.keyword)),
        ("name", quoted(&item.name)),
        ("parts", list(parts)),
    ])
}

fn body(body: &Body) -> String {
    object(&[
        ("name", quoted(&body.name)),
        ("text", quoted(&body.text)),
        ("definitions", list(body.definitions.iter().map(statement))),
    ])
}

fn motion(equation: &Equation) -> String {
    object(&[
        ("coordinate", letter(&equation.label)),
        ("equation", statement(&equation.statement)),
    ])
}

fn row(row: &Row) -> String {
    object(&[
        ("name", quoted(&row.name)),
        ("kind", quoted(row.kind)),
        ("declared", statement(&row.declared)),
        ("where", maybe(row.region.as_ref())),
        ("acceleration", statement(&row.acceleration)),
        ("multiplier", letter(&row.multiplier)),
        ("acts", quoted(&row.when)),
    ])
}

fn mode(mode: &Mode) -> String {
    let guards = mode.guards.iter().map(|guard| {
        object(&[
            ("while", statement(&guard.statement)),
            ("where", maybe(guard.region.as_ref())),
            ("otherwise", quoted(&guard.otherwise)),
        ])
    });
    let functions = mode.work.emitted.map(|own| {
        object(&[
            ("constants", own.constants.to_string()),
            ("unknowns", own.unknowns.to_string()),
            ("accelerations", own.accelerations.to_string()),
            ("whole", own.whole.to_string()),
            ("convolutions", own.convolutions.to_string()),
        ])
    });
    object(&[
        ("name", quoted(&mode.name)),
        ("known", list(mode.known.iter().map(statement))),
        ("unknowns", list(mode.unknowns.iter().map(letter))),
        ("equations", list(mode.equations.iter().map(statement))),
        (
            "solution",
            list(mode.solution.iter().flatten().map(statement)),
        ),
        ("left_out", list(mode.unsolved().into_iter().map(letter))),
        ("guards", list(guards)),
        ("operations", mode.work.operations.to_string()),
        ("operations_with_guards", mode.work.with_guards.to_string()),
        ("functions", functions.unwrap_or("null".to_owned())),
    ])
}

fn switch(switch: &Switch) -> String {
    object(&[
        ("from", switch.from.to_string()),
        ("to", switch.to.to_string()),
        ("label", quoted(&switch.label)),
    ])
}

fn impact(impact: &Impact) -> String {
    object(&[
        ("contact", quoted(&impact.contact)),
        ("when", list(impact.when.iter().map(statement))),
        ("where", maybe(impact.region.as_ref())),
        ("equations", list(impact.equations.iter().map(statement))),
        ("note", quoted(&impact.note)),
    ])
}

fn conserved(item: &Conserved) -> String {
    object(&[
        ("name", quoted(&item.name)),
        ("quantity", statement(&item.quantity)),
        ("rate", maybe(item.rate.as_ref())),
        ("when", quoted(&item.when)),
    ])
}

fn check(check: &Checked) -> String {
    object(&[
        ("name", quoted(&check.name)),
        ("claim", quoted(&check.claim)),
        ("outcome", quoted(&check.outcome)),
    ])
}

fn cost(cost: &Cost) -> String {
    object(&[
        ("effect", quoted(&cost.name)),
        ("alone", cost.before.to_string()),
        ("shared", cost.after.to_string()),
    ])
}

fn letter(l: &Letter) -> String {
    formula(&Formula::Letter(l.clone()))
}

fn formula(f: &Formula) -> String {
    let (text, latex) = (text::formula(f), latex::formula(f));
    object(&[("text", quoted(&text)), ("latex", quoted(&latex))])
}

fn maybe(s: Option<&Statement>) -> String {
    s.map_or("null".to_owned(), statement)
}

fn statement(s: &Statement) -> String {
    let relation = match s.relation {
        Relation::Equal => "=",
        Relation::AtLeast => ">=",
        Relation::AtMost => "<=",
        Relation::Above => ">",
        Relation::Below => "<",
    };
    object(&[
        ("left", formula(&s.left)),
        ("relation", quoted(relation)),
        ("right", formula(&s.right)),
    ])
}

fn object(fields: &[(&str, String)]) -> String {
    let fields: Vec<String> = fields
        .iter()
        .map(|(name, value)| format!("\"{name}\":{value}"))
        .collect();
    format!("{{{}}}", fields.join(","))
}

fn list(elements: impl Iterator<Item = String>) -> String {
    format!("[{}]", elements.collect::<Vec<_>>().join(","))
}

fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            c if c < ' ' => out.push_str(&format!("\\u{:04x}", c as u32)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
