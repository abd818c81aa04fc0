//! Derivations read as a person would write them.

use super::print;
use quote::ToTokens;

fn scene(path: &str) -> proc_macro2::TokenStream {
    let source = std::fs::read_to_string(path).expect("a scene");
    let file = syn::parse_file(&source).expect("Rust");
    let mut item = file
        .items
        .into_iter()
        .find_map(|item| match item {
            syn::Item::Struct(item) => Some(item),
            _ => None,
        })
        .expect("a struct");
    item.attrs.retain(|a| !a.path().is_ident("derive"));
    item.into_token_stream()
}

#[test]
fn look() {
    let Ok(path) = std::env::var("LOOK") else {
        return;
    };
    let d = crate::inspect(scene(&path), std::env::var("MODE").ok().as_deref()).unwrap();
    println!("{}", print::plain(&d));
}
