//! What the derive macro takes per scene: declaration → tokens, in milliseconds, and how much Rust comes out.
//!
//! This is the macro's own share. What rustc makes of the result is seen with `cargo build --timings`.

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

fn main() {
    println!(
        "{:24} {:>10} {:>10} {:>10}",
        "scene", "min ms", "median ms", "tokens"
    );
    for (name, source) in SCENES {
        let declaration = declaration(source);
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
        println!(
            "{name:24} {:10.3} {:10.3} {tokens:10}",
            times[0],
            times[times.len() / 2]
        );
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
