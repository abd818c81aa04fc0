//! Emitted code reads as planned.

use super::emit;
use super::encoded::Writer;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

fn declared(input: TokenStream) -> crate::model::Declared {
    let mut sink = crate::diagnostics::Diagnostics::new();
    let declaration = crate::parse::declaration(input, &mut sink);
    crate::model::declared(&declaration.unwrap_or_else(|| panic!("{sink}")))
}

fn program(declaration: TokenStream) -> crate::plan::Program {
    crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// A mass on a spring that can be left out, with a floor below.
fn spring() -> TokenStream {
    quote! {
        #[lagrange(
            coordinates(x),
            kinetic = mass/2 * der(x)^2,
            potential = mass * gravity * x,
            potential(spring: stiffness/2 * (x - rest*cos(t))^2),
            contact(floor: x >= 0),
            start(high: x = 2*rest),
        )]
        pub struct Spring<T = f64> {
            pub mass: T,
            pub gravity: T,
            pub stiffness: T,
            pub rest: T,
        }
    }
}

/// Tokens compare without regard to white space.
#[track_caller]
fn check(emitted: &TokenStream, expected: TokenStream) {
    let (emitted, expected) = (emitted.to_string(), expected.to_string());
    assert!(
        emitted.contains(&expected),
        "\n{expected}\nis not in\n{emitted}"
    );
}

#[test]
fn a_tape_is_a_list_of_words_in_blocks() {
    let program = program(spring());
    let writer = Writer::written(&program.motion);
    let (words, _) = writer.bytes.as_chunks::<4>();
    let words: Vec<u32> = words.iter().map(|word| u32::from_le_bytes(*word)).collect();
    // Inputs: t, x, ẋ are values 0, 1, 2. Parameters: mass, gravity, stiffness, rest.
    let always = [
        0, 2, 3, /* n₃ = c₂ */ 0, 8, 0, /* y₂ = n₃ */ 23, 2, 3,
    ];
    let spring = [
        1, 0, 2, 0, 5, 4, // n₄, n₅ = sin t, cos t
        14, 0, 0, // n₆ = rest n₅
        5, 13, 5, // n₇ = x − n₆
        2, 1, 6, // n₈ = stiffness n₇
        5, 9, 7, // y₂ −= n₈
        25, 2, 8,
    ];
    let position = [1, 0, 16, 0, 1, 0, /* y₀ = x */ 23, 0, 1];
    let velocity = [1, 0, 32, 0, 1, 0, /* y₁ = ẋ */ 23, 1, 2];
    assert_eq!(words, [&always[..], &spring, &position, &velocity].concat());
}

#[test]
fn constants_starts_and_handles() {
    let emitted = emit(&program(spring()), &declared(spring()), &[]);
    check(
        &emitted,
        quote! { pub const FLOOR: ::lagrange_core::handle::ContactId = ::lagrange_core::handle::ContactId(0); },
    );
}

#[test]
fn mistakes_come_with_an_implementation_that_type_checks() {
    let declaration = quote! {
        #[lagrange(coordinates(x), kinetic = mass/2 * der(y)^2, contact(floor: x >= 0))]
        struct Wrong<T> { mass: T }
    };
    let emitted = crate::expand(declaration);
    check(
        &emitted,
        quote!(impl<T: ::lagrange_core::arithmetic::Scalar> ::lagrange_core::system::System for Wrong<T>),
    );
    check(
        &emitted,
        quote!(pub const FLOOR: ::lagrange_core::handle::ContactId),
    );
    assert_eq!(emitted.to_string().matches("compile_error").count(), 1);
}

/// What is drawn stands beside the equations and changes nothing in them, whatever is in it.
#[test]
fn a_picture_is_no_equation() {
    let of = |draws: TokenStream| {
        let declaration = quote! {
            #[lagrange(
                coordinates(x, y),
                define(height = y + x^2),
                kinetic = mass/2 * (der(x)^2 + der(y)^2),
                potential = mass * gravity * height,
                contact(floor: height >= 0),
                #draws
            )]
            struct Bead { mass: f64, gravity: f64 }
        };
        let program = program(declaration.clone());
        super::tables(&program, &declared(declaration))
    };
    let plain = of(quote!());
    let drawn = of(quote! {
        draw(mass: (max(x^2 - y, gravity * x), sin(height))),
        draw(arrow: floor * (0, cos(x*y)) at (abs(x), y)),
    });
    assert_eq!(plain.description.to_string(), drawn.description.to_string());
    assert_ne!(plain.declaration.to_string(), drawn.declaration.to_string());
}

/// A coordinate may be called what an emitted name of another one could end in: nothing hides its value.
#[test]
fn no_local_hides_a_declared_name() {
    let declaration = quote! {
        #[lagrange(
            coordinates(x, x_k, x_u, x_earlier, x_inverse),
            kinetic = (der(x)^2 + der(x_k)^2 + der(x_u)^2 + der(x_earlier)^2 + der(x_inverse)^2) / 2,
            potential = x * x_k * x_u * x_earlier * x_inverse + ln(1 + x^2) / tan(x),
        )]
        struct Chain {}
    };
    let emitted = crate::expand(declaration).to_string();
    assert!(emitted.contains("let dq_x_ ="));
    for name in ["x", "x_k", "x_u", "x_earlier", "x_inverse"] {
        for bound in [format!("let q_{name}_ ="), format!("let mut q_{name}_ =")] {
            // The motion program takes each from the state, once.
            let mut others = emitted.split(&bound).skip(1);
            let hides = others.any(|value| !value.trim_start().starts_with("q_ ["));
            assert!(!hides, "{bound}");
        }
    }
}

/// Whether a constraint hangs on a vanishing inertia is tested where one may vanish, and nowhere else: with constant inertias a row that
/// knows one coordinate only, as that of a bob straight below its pivot does, loses nothing.
#[test]
fn only_inertias_that_vary_are_tested_for_vanishing() {
    let tests = |kinetic: TokenStream| {
        let declaration = quote! {
            #[lagrange(
                coordinates(x, y),
                kinetic = #kinetic,
                potential = mass * y,
                constraint(rod: x^2 + y^2 == 1),
            )]
            struct Bob { mass: f64 }
        };
        let emitted = crate::expand(declaration).to_string();
        assert!(emitted.contains("is_safe_pivot"));
        emitted.contains("is_spread")
    };
    assert!(!tests(quote!(mass / 2 * (der(x) ^ 2 + der(y) ^ 2))));
    assert!(tests(quote!(mass / 2 * (der(x) ^ 2 + x ^ 2 * der(y) ^ 2))));
}

/// All identifiers, inside groups as well.
fn identifiers(tokens: TokenStream) -> Vec<String> {
    let of = |token| match token {
        TokenTree::Ident(ident) => vec![ident.to_string()],
        TokenTree::Group(group) => identifiers(group.stream()),
        TokenTree::Punct(_) | TokenTree::Literal(_) => Vec::new(),
    };
    tokens.into_iter().flat_map(of).collect()
}

/// A struct whose names are Greek letters, for which rustc looks for letters like them; as a text, or it would find them here.
const GREEK: &str = "#[lagrange(
    crate = ::lg,
    coordinates(ρ, ν),
    kinetic = μ/2 * (der(ρ)^2 + der(ν)^2),
    potential = μ * exp(ρ) * sin(ν),
    contact(κ: ρ >= 0),
    friction(φ on κ: slip = der(ν), static = 1),
    observe(ψ = der(ρ)),
    start(τ: ν = 1),
)]
struct Σ { μ: f64 }";

/// rustc warns of a `p` beside a `ρ` and of a `v` beside a `ν`; the type parameter of emitted functions is the only letter.
#[test]
fn no_emitted_name_looks_like_a_greek_letter() {
    let letters = identifiers(crate::expand(GREEK.parse().expect("tokens")))
        .into_iter()
        .filter(|name| name.len() == 1);
    let letters: Vec<String> = letters.collect();
    assert!(
        letters.iter().all(|name| name == "N" || name == "_"),
        "{letters:?}"
    );
}

/// A dependency may be renamed.
#[test]
fn another_path_to_the_core_is_the_only_one() {
    let wrong = GREEK.replace("exp(ρ)", "exp(x)");
    for declaration in [GREEK, &wrong] {
        let declaration = declaration.parse().expect("tokens");
        let emitted = identifiers(crate::expand(declaration));
        assert!(emitted.contains(&"lg".to_owned()));
        assert!(!emitted.contains(&"lagrange_core".to_owned()));
    }
}
