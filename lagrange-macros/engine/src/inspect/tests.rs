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
    let text = match std::env::var("FORMAT").as_deref() {
        Ok("latex") => print::paper(&d),
        Ok("markdown") => print::markdown(&d),
        Ok("mathml") => print::page(&d),
        Ok("json") => print::json(&d),
        Ok("graph") => print::mermaid(&d),
        Ok("dot") => print::dot(&d),
        _ => print::plain(&d),
    };
    println!("{text}");
}

#[test]
fn time() {
    let Ok(path) = std::env::var("LOOK") else {
        return;
    };
    let tokens = scene(&path);
    for _ in 0..5 {
        let t0 = std::time::Instant::now();
        let tok = crate::expand(tokens.clone());
        let t1 = std::time::Instant::now();
        let mut sink = crate::Diagnostics::new();
        let declaration = crate::parse::declaration(tokens.clone(), &mut sink).unwrap();
        let (mut program, _) = crate::planned(&declaration, &mut sink).unwrap();
        let t2 = std::time::Instant::now();
        let d = super::derivation(&declaration, &mut program, None).unwrap();
        let t3 = std::time::Instant::now();
        let sizes = [
            print::plain(&d).len(),
            print::paper(&d).len(),
            print::page(&d).len(),
            print::markdown(&d).len(),
            print::json(&d).len(),
            print::equations(&d).len(),
        ];
        let t4 = std::time::Instant::now();
        println!(
            "expand {:?} inspect {:?} print {:?} sizes {sizes:?} tokens {}",
            t1 - t0,
            t3 - t2,
            t4 - t3,
            tok.to_string().len()
        );
    }
}
