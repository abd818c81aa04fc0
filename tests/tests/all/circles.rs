//! No two files of a crate ask each other, directly or through others: what a file says can be read without those that stand on it.
//!
//! A folder's own file (`mod.rs`) belongs to all that is below it: its types are used there, and it hands on what is there.

use crate::architecture::sources;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Item, UseTree};

/// A module by the names on the way to it.
type Module = Vec<String>;

/// The files of a crate, each with the paths that it names.
struct Crate {
    modules: BTreeMap<Module, Vec<Vec<String>>>,
}

impl Crate {
    fn read(root: &Path) -> Crate {
        let mut files: Vec<PathBuf> = Vec::new();
        sources(root, &mut files);
        let read = |file: PathBuf| {
            let path = file.strip_prefix(root).expect("below the root");
            let names = path.with_extension("");
            let names = names
                .iter()
                .map(|name| name.to_str().expect("letters").to_owned());
            let mut module: Module = names.collect();
            if module
                .last()
                .is_some_and(|name| ["mod", "lib", "main"].contains(&&**name))
            {
                module.pop();
            }
            (module, paths(&fs::read_to_string(file).expect("text")))
        };
        Crate {
            modules: files.into_iter().map(read).collect(),
        }
    }

    /// The file that says what a path means which `module` names: of names that are handed on, the one from which they come.
    fn home(&self, module: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (mut home, mut rest) = (module.clone(), path);
        match rest.first()?.as_str() {
            "crate" => (home, rest) = (Vec::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|name| name == "super") {
                    home.pop()?;
                    rest = &rest[1..];
                }
            }
            child => {
                home.push(child.to_owned());
                self.modules.get(&home)?;
                rest = &rest[1..];
            }
        }
        while let Some(name) = rest.first() {
            home.push(name.clone());
            if !self.modules.contains_key(&home) {
                home.pop();
                break;
            }
            rest = &rest[1..];
        }
        let named = self.modules.get(&home)?;
        let Some(name) = rest.first().filter(|_| depth < 8) else {
            return Some(home);
        };
        let mut handed_on = named
            .iter()
            .filter(|other| other.last() == Some(name) && **other != path);
        let found = handed_on.find_map(|other| self.home(&home, other, depth + 1));
        Some(found.unwrap_or(home))
    }

    /// By file: those that it asks, but for folders that it is in or that are in it.
    fn asked(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let asks = |(module, named): (&Module, &Vec<Vec<String>>)| {
            let homes = named.iter().filter_map(|path| self.home(module, path, 0));
            homes
                .filter(|home| !home.starts_with(module) && !module.starts_with(home))
                .collect()
        };
        self.modules
            .iter()
            .map(|pair| (pair.0, asks(pair)))
            .collect()
    }
}

/// The paths that a file names, in `use` and elsewhere; its tests may name everything.
fn paths(text: &str) -> Vec<Vec<String>> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    let file = syn::parse_file(text).expect("Rust");
    let mut list = Vec::new();
    for item in file.items {
        if let Item::Use(found) = item {
            expand(&found.tree, &mut Vec::new(), &mut list);
        }
    }
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    for line in lines.filter(|line| !line.contains("use ")) {
        for start in ["super::", "crate::"] {
            let Some((_, rest)) = line.split_once(start) else {
                continue;
            };
            let path = rest
                .split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
                .next();
            let names = path
                .unwrap_or("")
                .split("::")
                .filter(|name| !name.is_empty());
            list.push(
                core::iter::once(&start[..5])
                    .chain(names)
                    .map(str::to_owned)
                    .collect(),
            );
        }
    }
    list
}

/// Every path of a tree of `use`.
fn expand(tree: &UseTree, before: &mut Vec<String>, list: &mut Vec<Vec<String>>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            expand(&path.tree, before, list);
            before.pop();
        }
        UseTree::Group(group) => group
            .items
            .iter()
            .for_each(|tree| expand(tree, before, list)),
        UseTree::Name(name) => {
            let own = Some(name.ident.to_string()).filter(|name| name != "self");
            list.push(before.iter().cloned().chain(own).collect());
        }
        UseTree::Rename(name) => list.push([&before[..], &[name.ident.to_string()]].concat()),
        _ => list.push(before.clone()),
    }
}

/// The files on a way from one back to it, if there is one.
fn circle(asked: &BTreeMap<&Module, BTreeSet<Module>>) -> Option<Vec<String>> {
    let mut sound: BTreeSet<&Module> = BTreeSet::new();
    for &start in asked.keys() {
        // The way so far, each with what it has still to be asked.
        let mut way = vec![(start, asked[start].iter())];
        while let Some((module, rest)) = way.last_mut() {
            let Some(next) = rest.next() else {
                sound.insert(module);
                way.pop();
                continue;
            };
            if let Some(at) = way.iter().position(|(on_way, _)| *on_way == next) {
                return Some(
                    way[at..]
                        .iter()
                        .map(|(module, _)| module.join("/"))
                        .collect(),
                );
            }
            if let Some((next, all)) = asked.get_key_value(next)
                && !sound.contains(next)
            {
                way.push((next, all.iter()));
            }
        }
    }
    None
}

#[test]
fn files_do_not_ask_each_other() {
    for root in [
        "lagrange-macros/engine/src",
        "lagrange-core/src",
        "problems/program/src",
        "problems/src",
    ] {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(root);
        let files = Crate::read(&root);
        assert!(files.modules.len() > 20, "{} sources", files.modules.len());
        let asked = files.asked();
        let ways = asked.values().map(BTreeSet::len).sum::<usize>();
        assert!(ways > files.modules.len(), "{ways} ways");
        if let Some(circle) = circle(&asked) {
            panic!("{}: {} ask each other", root.display(), circle.join(", "));
        }
    }
}

/// What the test would say, were there a circle.
#[test]
fn a_circle_is_found() {
    let module = |name: &str| vec![name.to_owned()];
    let named = |text: &str| paths(text);
    let files = Crate {
        modules: BTreeMap::from([
            (Vec::new(), named("pub use b::Lever;")),
            (module("a"), named("use crate::Lever;")),
            (module("b"), named("use super::c::{self, Wheel};")),
            (
                module("c"),
                named("fn turn() -> crate::a::Angle { todo!() }"),
            ),
        ]),
    };
    assert_eq!(
        circle(&files.asked()),
        Some(vec!["a".to_owned(), "b".to_owned(), "c".to_owned()])
    );
}
