//! Mistakes in declarations reach the user through rustc at the token that is wrong.

#[test]
fn a_mistake_is_shown_where_it_is() {
    trybuild::TestCases::new().compile_fail("tests/mistakes/*.rs");
}
