//! What the derive macro takes: declaration → tokens, in milliseconds, and how much Rust comes out; for the scenes, and
//! for chains of n links, with the operations of their mass matrix and forcing.
//!
//! This is the macro's own share. What rustc makes of the result is seen with `cargo build --timings`. Users' builds run
//! macros without optimisation: `cargo bench -p lagrange-problems --bench derive --profile unoptimized`.

use lagrange_engine::derive::Stage;
use proc_macro2::TokenStream;
use quote::ToTokens;
use std::time::{Duration, Instant};

/// Time spent on each scene.
const BUDGET: Duration = Duration::from_millis(300);

const SCENES: [(&str, &str); 5] = [
    (
        "mass-on-shell",
        include_str!("../src/scenes/mass_on_shell.rs"),
    ),
    (
        "rolling-sphere",
        include_str!("../src/scenes/rolling_sphere.rs"),
    ),
    (
        "rolling-slipping-sphere",
        include_str!("../src/scenes/rolling_slipping_sphere.rs"),
    ),
    (
        "mass-on-wheel",
        include_str!("../src/scenes/mass_on_wheel.rs"),
    ),
    (
        "sphere-in-bowl",
        include_str!("../src/scenes/sphere_in_bowl.rs"),
    ),
];

/// Numbers of links.
const CHAINS: [usize; 8] = [2, 3, 5, 8, 10, 20, 30, 50];

fn main() {
    println!(
        "{:24} {:>10} {:>10} {:>10} {:>10}",
        "scene", "min ms", "median ms", "tokens", "operations"
    );
    for (name, source) in SCENES {
        row(name, &declaration(source));
    }
    for links in CHAINS {
        row(&format!("chain of {links}"), &chain(links));
    }
}

/// Measures and prints.
fn row(name: &str, declaration: &TokenStream) {
    let mut times = Vec::new();
    let mut tokens = 0;
    let begin = Instant::now();
    while begin.elapsed() < BUDGET || times.len() < 3 {
        let input = declaration.clone();
        let start = Instant::now();
        let output = lagrange_engine::expand(input);
        times.push(start.elapsed().as_secs_f64() * 1e3);
        tokens = count(output);
    }
    times.sort_by(f64::total_cmp);
    let program = lagrange_engine::program(declaration.clone()).expect("a scene is right");
    let always = [1];
    println!(
        "{name:24} {:10.3} {:10.3} {tokens:10} {:10}",
        times[0],
        times[times.len() / 2],
        program.operations(Stage::Motion, &always),
    );
}

/// A plane chain of equal links, as the scene of five of them.
fn chain(links: usize) -> TokenStream {
    let n = proc_macro2::Literal::usize_unsuffixed(links);
    quote::quote! {
        #[lagrange(
            coordinates(theta[#n]),
            define(
                x[k in 0..#n] = sum(i in 0..k+1: length * sin(theta[i])),
                y[k in 0..#n] = sum(i in 0..k+1: -length * cos(theta[i])),
            ),
            kinetic   = sum(k in 0..#n: mass/2 * (der(x[k])^2 + der(y[k])^2)),
            potential = sum(k in 0..#n: mass * gravity * y[k]),
        )]
        pub struct Chain {
            pub mass: f64,
            pub length: f64,
            pub gravity: f64,
        }
    }
}

/// The struct of a scene's file, as the macro is given it: without its `derive`.
fn declaration(source: &str) -> TokenStream {
    let file = syn::parse_file(source).expect("a scene is Rust");
    let item = file.items.into_iter().find_map(|item| match item {
        syn::Item::Struct(item) => Some(item),
        _ => None,
    });
    let mut item = item.expect("a scene has a struct");
    item.attrs
        .retain(|attribute| !attribute.path().is_ident("derive"));
    item.into_token_stream()
}

/// Number of tokens, those in groups included.
fn count(tokens: TokenStream) -> usize {
    tokens
        .into_iter()
        .map(|token| match token {
            proc_macro2::TokenTree::Group(group) => 2 + count(group.stream()),
            _ => 1,
        })
        .sum()
}
