//! Derivations of the scenes, printed.

use super::{derivation, scenes};
use crate::inspect::print;
use expect_test::expect_file;
use quote::quote;

/// The derivations of the textbook scenes, and of a smooth one, as they stand in `golden/`. `UPDATE_EXPECT=1 cargo test`
/// accepts what reads better.
#[test]
fn derivations_of_the_textbook_scenes() {
    let textbook = [
        "MassOnShell",
        "RollingSphere",
        "RollingSlippingSphere",
        "MassOnWheel",
        "SphereInBowl",
        "DoublePendulum",
    ];
    for (name, tokens) in scenes() {
        if textbook.contains(&name.as_str()) {
            let d = derivation(tokens);
            expect_file![format!("../golden/{name}.txt")].assert_eq(&print::plain(&d));
            expect_file![format!("../golden/{name}.tex")].assert_eq(&print::paper(&d));
        }
    }
}

/// A motor that carries the weight of an arm as if it were stretched: what the weight of its outer half moves alone is left.
#[test]
fn what_a_force_balances_exactly_is_not_written() {
    let declared = quote! {
        #[lagrange(
            coordinates(q, p),
            define(c = [l/2*cos(q), l/2*sin(q)]),
            define(d = [l*cos(q) + h/2*cos(q + p), l*sin(q) + h/2*sin(q + p)]),
            kinetic = m/2*dot(der(c), der(c)) + n/2*dot(der(d), der(d)),
            potential = m*g*c[1] + n*g*d[1],
            force(motor: q = -k*q + g*(m*l/2 + n*l)*cos(q)),
        )]
        struct Arm { m: f64, n: f64, l: f64, h: f64, g: f64, k: f64 }
    };
    let plain = print::plain(&derivation(declared));
    let (_, equations) = plain.split_once("Equations of motion").expect("equations");
    let (first, _) = equations.split_once("\n  p ").expect("two equations");
    let (_, forces) = first.split_once("sin p").expect("a force of Coriolis");
    assert!(
        forces.contains("cos(q + p)") && !forces.contains("cos q"),
        "{first}"
    );
}

#[test]
fn mathml_is_well_formed() {
    for (name, tokens) in scenes() {
        let d = derivation(tokens);
        let equations = print::equations(&d);
        assert!(!equations.contains('\n'));
        for text in [print::page(&d), equations] {
            let document =
                roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(document.descendants().any(|node| node.has_tag_name("math")));
            for node in document.descendants() {
                let children = node.children().filter(|child| child.is_element()).count();
                let expected = match node.tag_name().name() {
                    "mfrac" | "msub" | "msup" | "mover" => 2,
                    "msubsup" | "munderover" => 3,
                    _ => children,
                };
                assert_eq!(children, expected, "{name}: {node:?}");
            }
        }
    }
}

#[test]
fn braces_of_latex_balance() {
    for (name, tokens) in scenes() {
        let latex = print::paper(&derivation(tokens));
        let mut depth = 0;
        let mut escaped = false;
        for c in latex.chars() {
            match c {
                '{' if !escaped => depth += 1,
                '}' if !escaped => depth -= 1,
                _ => {}
            }
            assert!(depth >= 0, "{name}");
            escaped = c == '\\' && !escaped;
        }
        assert_eq!(depth, 0, "{name}");
        for pair in [("\\left", "\\right"), ("\\begin{", "\\end{")] {
            let count = |word| latex.matches(word).count();
            assert_eq!(count(pair.0), count(pair.1), "{name}");
        }
    }
}
