//! Declarations that were drawn and are compiled ([`super::written`]): the functions of their modes against the interpreter of the same
//! equations.

use super::scene;
use super::written::each;
use lagrange_core::dynamics::Dynamics;
use lagrange_core::prelude::*;
use lagrange_core::system::Derived;
use lagrange_program::file;
use lagrange_tests::declarations::declaration;
use lagrange_tests::{Random, all_agree, modes};

/// How many declarations are compiled.
const COMPILED: usize = 8;

/// States in each mode.
const STATES: usize = 3;

/// Order of the Taylor series that are compared.
const ORDER: usize = 8;

/// The first declarations with functions of their modes, of a size that compiles in seconds: few modes, and no code for each order.
fn chosen() -> Vec<u64> {
    let long = [
        "emit = data",
        "emit = unrolled",
        ", s[2]",
        "friction(seal",
        "friction(rub",
        "friction(brake",
    ];
    let compiles = |number: &u64| {
        let text = declaration(*number).text;
        text.len() < 2700 && !long.iter().any(|word| text.contains(word))
    };
    (0..).filter(compiles).take(COMPILED).collect()
}

#[test]
fn what_is_compiled_is_what_is_drawn() {
    let mut text = "//! Declarations drawn at random, as `lagrange export` writes them. `UPDATE_EXPECT=1` writes this file.\n\n\
                    #![allow(missing_docs)]\n"
        .to_owned();
    let mut calls = String::new();
    for number in chosen() {
        let exported = file::export(
            &format!("drawn-{number}.lagrange"),
            &declaration(number).text,
        );
        let rust = exported.expect("a declaration that is right").rust;
        text.push_str(&format!("\npub mod d{number} {{\n{rust}}}\n"));
        calls.push_str(&format!(
            "        $check::<super::written::d{number}::Drawn{number}>({number});\n"
        ));
    }
    text.push_str(&format!(
        "\n/// Calls a function for each system.\nmacro_rules! each {{\n    ($check:ident) => {{\n{calls}    }};\n}}\npub(crate) use each;\n"
    ));
    expect_test::expect_file!["written.rs"].assert_eq(&text);
}

#[test]
fn compiled_functions_are_what_the_interpreter_computes() {
    each!(check);
}

fn check<S: Derived<Scalar = f64> + Default>(number: u64) {
    let (system, d) = (S::default(), S::DESCRIPTION);
    let read = scene(number, &declaration(number)).description();
    assert_eq!(format!("{d:?}"), format!("{read:?}"));
    assert!(!S::MODES.is_empty(), "{number}");
    let mut random = Random::new(number);
    let mut compared = 0;
    for mut mode in modes::all(d) {
        for b in 0..d.branches.len() {
            mode.set_branch(b, random.below(2) == 0);
        }
        for _ in 0..STATES {
            let mut near = || {
                (0..d.coordinates.len())
                    .map(|_| random.between(-1.0, 1.0))
                    .collect()
            };
            let (q, v): (Vec<f64>, Vec<f64>) = (near(), near());
            let by = |equations: Equations| {
                let mut dynamics = Dynamics::new(&system, &Effects::all());
                dynamics.set_equations(equations);
                dynamics.set_mode(&mode);
                dynamics.value_along(0.3, &q, &v).ok()?;
                let rows = 0..d.rows.len();
                let mut numbers = dynamics.acceleration().to_vec();
                numbers.extend(rows.clone().map(|row| dynamics.force(row)));
                dynamics.series(0.3, &q, &v, ORDER).ok()?;
                (0..d.coordinates.len()).for_each(|i| numbers.extend(dynamics.velocity_series(i)));
                rows.for_each(|row| numbers.extend(dynamics.force_series(row)));
                Some(numbers)
            };
            // Where friction holds what a constraint moves there is no solution.
            if let (Some(emitted), Some(interpreted)) =
                (by(Equations::Emitted), by(Equations::Interpreted))
            {
                all_agree(format!("{number}"), &emitted, &interpreted, 1e-9);
                compared += 1;
            }
        }
    }
    assert!(compared > 0, "{number}");
}
