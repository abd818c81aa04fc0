//! What is said of a mode's work is what is emitted.

use super::{derivation, scenes};
use std::collections::BTreeSet;

/// The sums over earlier coefficients that a function forms: `earlier_n3`, or `earlier1_n3` if it is the second of an operation.
fn sums(function: &str) -> BTreeSet<&str> {
    let words = function.split(|c: char| !c.is_alphanumeric() && c != '_');
    words
        .filter(|word| word.starts_with("earlier") && *word != "earlier")
        .collect()
}

#[test]
fn work_of_a_mode_is_that_of_its_functions() {
    let mut compared = 0;
    for (name, tokens) in scenes() {
        let d = derivation(tokens.clone());
        let emitted = crate::expand(tokens).to_string();
        // Modes that differ in the direction of a slip share their functions.
        let mut said: Vec<String> = Vec::new();
        let mut expected: Vec<String> = Vec::new();
        for series in emitted.split(" struct Series").skip(1) {
            expected.push(format!("{} convolutions", sums(series).len()));
        }
        for constants in emitted.split("constants : ").skip(1) {
            let count = constants.split(['u', ' ', ',']).next().unwrap_or_default();
            if let Ok(count) = count.parse::<usize>() {
                expected.push(format!("{count} constants"));
            }
        }
        for own in d.modes.iter().filter_map(|mode| mode.work.emitted) {
            said.push(format!("{} convolutions", own.convolutions));
            said.push(format!("{} constants", own.constants));
            assert!(own.accelerations <= own.whole, "{name}");
            compared += 1;
        }
        for line in said {
            assert!(
                expected.contains(&line),
                "{name}: {line}, emitted are {expected:?}"
            );
        }
    }
    assert!(compared > 40, "{compared} modes");
}
