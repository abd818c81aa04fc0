//! Modes: how they are found, how many are shown, and their solutions.

use super::{derivation, scenes};
use crate::inspect::formula::{Relation, Statement};
use crate::inspect::print;
use quote::quote;

#[test]
fn modes_are_found_by_name() {
    let tokens = quote! {
        #[lagrange(
            coordinates(x, y),
            kinetic = m/2 * (der(x)^2 + der(y)^2),
            potential = m * g * y,
            contact(floor: y >= 0, restitution = 1/2),
            friction(rub on floor: slip = der(x), static = mu),
        )]
        struct Puck { m: f64, g: f64, mu: f64 }
    };
    let one = |mode: &str| crate::inspect(tokens.clone(), Some(mode));
    let mode = one(" floor closed,rub  sticks ")
        .expect("a mode")
        .modes
        .remove(0);
    assert_eq!(mode.name, "floor closed, rub sticks");
    let lines: Vec<String> = mode.equations.iter().map(print::text::statement).collect();
    assert_eq!(
        lines,
        ["m x\u{308} = F_rub", "N_floor = m g", "x\u{308} = 0"]
    );
    assert_eq!(mode.known[0].relation, Relation::Equal);
    for wrong in [
        "floor closed",
        "rub sticks",
        "floor closed, rub sticks, rub slips",
        "roof open",
    ] {
        assert!(one(wrong).is_err(), "{wrong}");
    }
    let all = crate::inspect(tokens, None).expect("all modes");
    assert_eq!((all.modes.len(), all.mode_count), (4, 4));
    let bounce = print::text::statement(all.impacts[0].equations.last().expect("a law"));
    assert_eq!(bounce, "y\u{307}⁺ = −½ y\u{307}⁻");
}

/// The edge of a contact ends its mode, bounds its impacts, and leaves the momentum along it as it is.
#[test]
fn a_region_is_told_wherever_its_contact_acts() {
    let tokens = quote! {
        #[lagrange(
            coordinates(x, y),
            kinetic = m/2 * (der(x)^2 + der(y)^2),
            potential = m * g * y,
            contact(table: y >= 0, where x <= edge),
            contact(slope: y >= x * slant, where x >= edge),
        )]
        struct Slide { m: f64, g: f64, edge: f64, slant: f64 }
    };
    let d = crate::inspect(tokens, None).expect("a derivation");
    let text = print::plain(&d);
    for line in [
        "  table  y ≥ 0 where edge − x ≥ 0",
        "while  y ≥ 0 where edge − x ≥ 0",
        "while  edge − x ≥ 0",
        "  table: when y = 0, edge − x ≥ 0 and y\u{307}⁻ < 0",
        "p\u{307}ₓ = −slant N_slope  while nothing acts at slope",
    ] {
        assert!(text.contains(line), "{line} in {text}");
    }
    let latex = print::paper(&d);
    assert_eq!(
        latex.matches(r"\mathrm{edge} - x \ge 0").count(),
        6,
        "{latex}"
    );
}

/// A place that makes a force infinite is no number in it.
#[test]
fn a_mode_at_a_pole_keeps_its_letter() {
    let tokens = quote! {
        #[lagrange(
            coordinates(x, y),
            kinetic = m/2 * (der(x)^2 + der(y)^2),
            potential = m * g * (x + y) - k * ln(x),
            contact(bottom: x >= 0),
            contact(floor: y >= 0),
        )]
        struct Piston { m: f64, g: f64, k: f64 }
    };
    let closed = "bottom closed, floor closed";
    let mode = crate::inspect(tokens, Some(closed)).expect("a mode");
    let lines = |statements: &[Statement]| -> Vec<String> {
        statements.iter().map(print::text::statement).collect()
    };
    let mode = &mode.modes[0];
    assert_eq!(lines(&mode.known), ["x = 0", "y = 0"]);
    let equations = ["N_bottom = m g − k/x", "N_floor = m g"];
    assert_eq!(lines(&mode.equations), equations);
}

/// 3³ modes without a contact: one without slip, and two for each friction that slips alone.
#[test]
fn many_frictions_are_shown_in_part() {
    let tokens = quote! {
        #[lagrange(
            coordinates(x[3]),
            kinetic = sum(k in 0..3: m/2 * der(x[k])^2),
            friction(rub[k in 0..3]: slip = der(x[k]), limit = f),
        )]
        struct Row { m: f64, f: f64 }
    };
    let all = crate::inspect(tokens.clone(), None).expect("a derivation");
    assert_eq!((all.modes.len(), all.mode_count), (7, 27));
    assert!(
        all.notes[0]
            .starts_with("7 of 27 modes are shown: those in which at most one friction slips."),
        "{:?}",
        all.notes
    );
    let slips = |name: &str| name.matches("slips").count();
    assert_eq!(
        all.modes
            .iter()
            .map(|mode| slips(&mode.name))
            .sum::<usize>(),
        6
    );
    let refusal = crate::inspect(tokens, Some("all")).expect_err("no such mode");
    let said = refusal.to_string();
    assert!(
        said.starts_with("no mode is called `all`; there are 27, among them: `rub[0] sticks, "),
        "{said}"
    );
}

#[test]
fn many_contacts_are_shown_in_part() {
    let d = derivation(quote! {
        #[lagrange(
            coordinates(x[30]),
            kinetic = sum(k in 0..30: m/2 * der(x[k])^2),
            contact(pair[k in 0..29]: x[k + 1] - x[k] >= 2*a),
        )]
        struct Row { m: f64, a: f64 }
    });
    assert_eq!(d.mode_count, 1 << 29);
    assert!(d.modes.len() < 10 && d.notes.len() == 2, "{:?}", d.notes);
    assert!(print::plain(&d).len() < 40_000);
}

/// Results that textbooks derive by hand.
#[test]
fn modes_are_solved_where_the_solution_is_short() {
    let solved = |scene: &str, mode: &str| {
        let (_, tokens) = scenes()
            .into_iter()
            .find(|(name, _)| name == scene)
            .expect("a scene");
        let found = crate::inspect(tokens, Some(mode)).unwrap_or_else(|e| panic!("{e}"));
        let lines = found.modes[0]
            .solution
            .iter()
            .flatten()
            .map(print::text::statement);
        lines.collect::<Vec<_>>().join("\n")
    };
    let check = |scene, mode, expected: &[&str]| {
        let found = solved(scene, mode);
        for line in expected {
            assert!(
                found.lines().any(|own| own == *line),
                "{line}\nis not in\n{found}"
            );
        }
    };
    check(
        "RollingSphere",
        "shell closed",
        &[
            "θ\u{308} = 5 g sin(θ)/(7 (R + a))",
            "λ_rolling = −(2/7) m g sin θ",
        ],
    );
    check(
        "SphereInBowl",
        "bowl closed, grip sticks",
        &[
            "θ\u{308} = −5 g sin(θ)/(7 (R − a))",
            "F_grip = (2/7) m g sin θ",
        ],
    );
    check(
        "Ladder",
        "wall closed, floor closed",
        &["θ\u{308} = −3 g cos(θ)/(2 l)"],
    );
    check("MassOnWheel", "rim open", &["x\u{308} = 0", "φ\u{308} = 0"]);
    // Nothing to be read: nothing is said.
    check("FiveLinkChain", "smooth", &[]);
}
