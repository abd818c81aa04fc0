//! Derivations of the scenes, and what they leave alone.

mod bodies;
mod costs;
mod modes;
mod printed;
mod read_back;
mod values;
mod written;

use crate::ast::Declaration;
use crate::diagnostics::Diagnostics;
use crate::plan::Program;
use proc_macro2::TokenStream;
use quote::ToTokens;
use std::path::{Path, PathBuf};

/// All scenes, as the derive macro is given them.
fn scenes() -> Vec<(String, TokenStream)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../problems/src/scenes");
    let mut files: Vec<PathBuf> = Vec::new();
    for folder in [root.clone(), root.join("hard")] {
        let entries = std::fs::read_dir(folder).expect("the scenes");
        files.extend(entries.map(|entry| entry.expect("a file").path()));
    }
    files.retain(|file| file.extension().is_some_and(|e| e == "rs"));
    files.sort();
    let mut scenes = Vec::new();
    for file in files {
        let source = std::fs::read_to_string(&file).expect("a scene");
        let parsed = syn::parse_file(&source).expect("Rust");
        for item in parsed.items {
            if let syn::Item::Struct(mut item) = item
                && item.attrs.iter().any(|a| a.path().is_ident("lagrange"))
            {
                item.attrs.retain(|a| !a.path().is_ident("derive"));
                scenes.push((item.ident.to_string(), item.into_token_stream()));
            }
        }
    }
    assert!(scenes.len() >= 20);
    scenes
}

fn planned(tokens: TokenStream) -> (Declaration, Program) {
    let mut sink = Diagnostics::new();
    let declaration = crate::parse::declaration(tokens, &mut sink).expect("a declaration");
    let program = crate::planned(&declaration, &mut sink);
    (declaration, program.unwrap_or_else(|| panic!("{sink}")).0)
}

fn derivation(tokens: TokenStream) -> crate::inspect::Derivation {
    crate::inspect(tokens, None).unwrap_or_else(|refusal| panic!("{refusal}"))
}

#[test]
fn what_is_read_does_not_reach_what_is_emitted() {
    for (name, tokens) in scenes() {
        let (declaration, mut program) = planned(tokens);
        let declared = crate::model::declared(&declaration);
        let before = crate::emit::emit(&program, &declared, &[]).to_string();
        crate::inspect::derivation(&declaration, &mut program, &[], None).expect("all modes");
        assert!(
            before == crate::emit::emit(&program, &declared, &[]).to_string(),
            "{name}"
        );
    }
}

#[test]
fn the_same_byte_for_byte() {
    for (_, tokens) in scenes().into_iter().take(6) {
        let [a, b] = [(); 2].map(|()| crate::expand(tokens.clone()).to_string());
        assert!(a == b);
    }
}
