//! A file gives what the struct gives.

use lagrange_core::prelude::Equations;
use lagrange_problems::catalogue::scenes;
use lagrange_program::file::scene;
use lagrange_program::outcome::Outcome;
use lagrange_program::request::Request;
use lagrange_program::scene::Scene;
use quote::{ToTokens, quote};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Attribute, Item, ItemStruct, Type};

/// All structs of the scenes' sources that are not made by a macro.
fn structs() -> Vec<ItemStruct> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scenes");
    let list = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).expect("the scenes");
        entries.map(|entry| entry.expect("a file").path()).collect()
    };
    let files = list(&folder).into_iter().chain(list(&folder.join("hard")));
    let sources = files.filter(|file| file.extension().is_some_and(|end| end == "rs"));
    let items = sources.flat_map(|file| {
        let text = fs::read_to_string(file).expect("text");
        syn::parse_file(&text).expect("Rust").items
    });
    let structs = items.filter_map(|item| match item {
        Item::Struct(item) => Some(item),
        _ => None,
    });
    structs.collect()
}

/// The file that declares the same as a struct.
fn text(item: &ItemStruct, defaults: &[f64]) -> String {
    let is = |name| move |attribute: &&Attribute| attribute.path().is_ident(name);
    let mut text = String::new();
    for doc in item.attrs.iter().filter(is("doc")) {
        let meta = &doc.meta;
        let _ = writeln!(text, "#![{}]", quote!(#meta));
    }
    let mut defaults = defaults.iter();
    let _ = writeln!(text, "parameters(");
    for field in &item.fields {
        for attribute in &field.attrs {
            let _ = writeln!(text, "{}", attribute.to_token_stream());
        }
        let name = field.ident.to_token_stream();
        let _ = match &field.ty {
            Type::Array(array) => {
                let length = array.len.to_token_stream();
                let count = length.to_string().parse().expect("a number");
                let values: Vec<_> = defaults.by_ref().take(count).collect();
                writeln!(text, "{name}[{length}] = {values:?},")
            }
            _ => writeln!(text, "{name} = {:?},", defaults.next().expect("a value")),
        };
    }
    let _ = writeln!(text, "),");
    for attribute in item.attrs.iter().filter(is("lagrange")) {
        let list = attribute.meta.require_list().expect("items");
        let _ = writeln!(text, "{}", list.tokens);
    }
    text
}

/// The scenes of the catalogue that stand in the sources, with the same read from a text.
fn pairs() -> Vec<(&'static dyn Scene, &'static dyn Scene)> {
    let structs = structs();
    let pairs = scenes().filter_map(|compiled| {
        let name = compiled.description().name;
        let item = structs.iter().find(|item| item.ident == name)?;
        let text = text(item, &compiled.defaults());
        let read = scene(&format!("{name}.lagrange"), &text);
        Some((compiled, read.unwrap_or_else(|refused| panic!("{refused}"))))
    });
    pairs.collect()
}

#[test]
fn a_file_has_the_tables_and_defaults_of_the_struct() {
    let pairs = pairs();
    assert!(pairs.len() > 35, "{} scenes", pairs.len());
    for (compiled, read) in pairs {
        let [expected, found] = [compiled, read].map(|s| format!("{:?}", s.description()));
        assert_eq!(found, expected);
        assert_eq!(read.defaults(), compiled.defaults(), "{}", compiled.name());
    }
}

/// One interpreter takes both through the same operations, so that they move alike to the last bit. What is read off the motion, such as
/// forces, comes from emitted functions where there are any, and is equal to rounding.
#[test]
fn a_file_moves_as_the_struct_does() {
    for (compiled, read) in pairs() {
        let request = Request {
            until: Some(compiled.until().min(2.0)),
            equations: Equations::Interpreted,
            samples: 20,
            ..Request::default()
        };
        let [expected, found] = [compiled, read].map(|scene| scene.run(&request).expect("a start"));
        let name = compiled.name();
        assert_eq!(found.samples.len(), expected.samples.len(), "{name}");
        for (found, expected) in found.samples.iter().zip(&expected.samples) {
            assert_eq!(found.time, expected.time, "{name}");
            assert_eq!(found.mode, expected.mode, "{name}");
            assert_eq!(found.state, expected.state, "{name}");
            let size = expected
                .forces
                .iter()
                .fold(1.0, |size, f| f.abs().max(size));
            for (found, expected) in found.forces.iter().zip(&expected.forces) {
                assert!(
                    (found - expected).abs() < 1e-11 * size,
                    "{name}: {found} {expected}"
                );
            }
        }
        let story = |run: &Outcome| -> Vec<String> {
            let events = run.events.iter();
            events
                .map(|e| format!("{:?} {} {}", e.subject, e.kind, e.time))
                .collect()
        };
        assert_eq!(story(&found), story(&expected), "{name}");
    }
}

/// What is exported is a struct that declares the same.
#[test]
fn an_export_declares_the_same() {
    for (_, read) in pairs() {
        let declaration = read.derivation().declaration;
        let item: ItemStruct = syn::parse_str(declaration).expect("a struct");
        let again = scene("Again.lagrange", &text(&item, &read.defaults()));
        let again = again.unwrap_or_else(|refused| panic!("{refused}"));
        let name = format!("name: {:?}", read.description().name);
        let expected = format!("{:?}", read.description()).replacen(&name, "name: \"Again\"", 1);
        // The names of the structs differ, as those of the files do.
        let found = format!("{:?}", again.description());
        let own = format!("name: {:?}", item.ident.to_string());
        assert_eq!(found, expected.replacen(&own, "name: \"Again\"", 1));
    }
}
