//! The table is consistent, and errors become tokens at their place.

use super::{Code, Diagnostics};
use proc_macro2::TokenStream;

/// Whether each of these texts has one mistake, at its `line:column code`; tells of all that do not.
#[track_caller]
pub(crate) fn mistakes_are_at(wrong: &[(&str, &str)], read: impl Fn(&str) -> Result<(), String>) {
    let mut failures = String::new();
    for (text, expected) in wrong {
        let found = read(text).err().unwrap_or("nothing wrong".to_owned());
        let places: Vec<String> = found
            .lines()
            .map(|line| line.split(' ').take(2).collect::<Vec<_>>().join(" "))
            .collect();
        if places != [*expected] {
            failures += &format!("{text}\n  expected {expected}\n  found {found}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn codes_are_distinct_and_ascending() {
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.row().code).collect();
    assert!(codes.windows(2).all(|pair| pair[0] < pair[1]), "{codes:?}");
}

/// A file can have a mistake in each of ten thousand items, and a name of a million letters.
#[test]
fn many_and_long_mistakes_are_counted_and_cut() {
    let tokens: TokenStream = "a".parse().unwrap();
    let token = tokens.into_iter().next().unwrap();
    let mut sink = Diagnostics::new();
    for _ in 0..10_000 {
        sink.report(Code::UnknownName, &token, &[&"z".repeat(5_000), &""]);
    }
    assert_eq!(sink.count(), 10_000);
    assert_eq!(sink.iter().count(), 100);
    let longest = sink.iter().map(|one| one.message.len()).max();
    assert!(longest < Some(1_100), "{longest:?}");
}

#[test]
fn prints_place_code_message_and_hint() {
    let tokens: TokenStream = "a\n  **".parse().unwrap();
    let token = tokens.into_iter().nth(1).unwrap();
    let mut sink = Diagnostics::new();
    sink.report(Code::PowerStars, &token, &[]);
    assert_eq!(
        sink.to_string(),
        "2:3 E004 `**` is not an operator here; a power is written with `^`: `x^2`\n"
    );
    let tokens = sink.into_compile_errors().to_string();
    assert!(tokens.starts_with(":: core :: compile_error !"), "{tokens}");
    assert!(tokens.contains("[E004]"), "{tokens}");
}
