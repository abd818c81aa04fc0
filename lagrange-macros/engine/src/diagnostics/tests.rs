//! The table is consistent, and errors become tokens at their place.

use super::{Code, Diagnostics};
use proc_macro2::TokenStream;

#[test]
fn codes_are_distinct_and_ascending() {
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.row().code).collect();
    assert!(codes.windows(2).all(|pair| pair[0] < pair[1]), "{codes:?}");
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
