//! Checks on whole declarations.

mod identities;
mod rewriting;

use super::{Outcome, Verdict};
use crate::checked;

const SHELL: &str = r#"
    coordinates(r, theta),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic = m/2 * (der(x)^2 + der(y)^2),
    potential = m * g * y,
    contact(shell: r >= radius),
"#;

fn verdicts(items: &str, fields: &str) -> Result<Vec<Verdict>, String> {
    let fields: String = fields
        .split_whitespace()
        .map(|f| format!("{f}: f64, "))
        .collect();
    let text = format!("#[lagrange({items})] struct S {{ {fields} }}");
    checked(text.parse().unwrap())
        .map(|(_, verdicts)| verdicts)
        .map_err(|mistakes| mistakes.to_string())
}

#[test]
fn shell() {
    let check = |claim: &str| verdicts(&format!("{SHELL} check({claim})"), "m g radius start");
    for claim in [
        "shell == m*g*cos(theta) - m*radius*der(theta)^2 when closed(shell)",
        "normal: shell == 3*m*g*cos(theta) - 2*energy/radius when closed(shell)",
        "shell == m*g*(3*cos(theta) - 2*cos(start)) when closed(shell) and energy == m*g*radius*cos(start)",
        "der(der(theta)) == g*sin(theta)/radius when closed(shell)",
        "der(der(x)) == 0 when open(shell)",
        "conserved energy",
        "shell == 0 when open(shell)",
    ] {
        println!("{claim}: {:?}", check(claim));
    }
    for claim in [
        "shell == m*g*cos(theta) + m*radius*der(theta)^2 when closed(shell)",
        "der(der(theta)) == -g*sin(theta)/radius when closed(shell)",
        "conserved momentum(theta)",
        "shell == m*g*cos(theta) - m*radius*der(theta)^2",
    ] {
        println!("{claim}: {:?}", check(claim));
    }
    let _: Option<Outcome> = None;
}
