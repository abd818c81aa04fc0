//! Checks on whole declarations.

mod hard;
mod identities;
mod rewriting;

use super::Outcome;
use crate::checked;

/// `proven in 2 modes`, `tested: why`, or the mistakes; fields separated by blanks.
pub fn judged(items: &str, fields: &str, checks: &str) -> Vec<String> {
    let fields = fields.split_whitespace();
    let fields: String = fields.map(|f| format!("{f}: f64, ")).collect();
    let text = format!("#[lagrange({items}, {checks})] struct S {{ {fields} }}");
    match checked(text.parse().unwrap()) {
        Ok((_, verdicts)) => verdicts
            .into_iter()
            .map(|verdict| match verdict.outcome {
                Outcome::Proven { modes } => format!("proven in {modes}"),
                Outcome::Tested { because, .. } => format!("tested: {because}"),
            })
            .collect(),
        Err(mistakes) => mistakes.iter().map(ToString::to_string).collect(),
    }
}

#[track_caller]
pub fn proven(items: &str, fields: &str, claim: &str) {
    let found = judged(items, fields, &format!("check({claim})"));
    assert!(
        found.len() == 1 && found[0].starts_with("proven"),
        "{claim}: {found:?}"
    );
}

#[track_caller]
pub fn tested(items: &str, fields: &str, claim: &str) {
    let found = judged(items, fields, &format!("check({claim})"));
    assert!(
        found.len() == 1 && found[0].starts_with("tested"),
        "{claim}: {found:?}"
    );
}

#[track_caller]
pub fn refuted(items: &str, fields: &str, claim: &str) -> String {
    let found = judged(items, fields, &format!("check({claim})"));
    assert!(
        found.len() == 1 && found[0].contains("E801"),
        "{claim}: {found:?}"
    );
    found[0].clone()
}

#[track_caller]
pub fn untried(items: &str, fields: &str, claim: &str) {
    let found = judged(items, fields, &format!("check({claim})"));
    assert!(
        found.len() == 1 && found[0].contains("E806"),
        "{claim}: {found:?}"
    );
}
