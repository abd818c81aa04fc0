//! The modules of the engine, of the core and of the program stand on one another in this order, and none knows one above it; the
//! program knows no scene.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// From the tokens of a declaration to Rust; the lowest first.
const ENGINE: [&str; 13] = [
    "sorted",
    "symbolic",
    "diagnostics",
    "ast",
    "parse",
    "model",
    "derive",
    "modes",
    "plan",
    "interpret",
    "check",
    "inspect",
    "emit",
];

/// From numbers to a finished run; the lowest first.
const CORE: [&str; 28] = [
    "shortest",
    "arithmetic",
    "declaration",
    "program",
    "equations",
    "derivation",
    "system",
    "effects",
    "handle",
    "mode",
    "linear",
    "integrate",
    "dynamics",
    "error",
    "state",
    "events",
    "pool",
    "modes",
    "monitor",
    "trajectory",
    "checks",
    "certificate",
    "settings",
    "run",
    "precompiled",
    "simulation",
    "prelude",
    "book",
];

/// From the name of a scene to what is written of it; the lowest first.
const PROGRAM: [&str; 29] = [
    "closed_form",
    "number",
    "drawing",
    "format",
    "names",
    "notation",
    "progress",
    "stability",
    "space",
    "straight",
    "path",
    "request",
    "scene",
    "outcome",
    "blame",
    "cost",
    "feasible",
    "drawn",
    "quantity",
    "film",
    "file",
    "catalogue",
    "accuracy",
    "scene_file",
    "sweep",
    "report",
    "results",
    "cli",
    "program",
];

/// Rust sources below a folder, but for tests.
pub fn sources(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let name = path.file_stem().and_then(|name| name.to_str());
        if name == Some("tests") {
            continue;
        }
        if path.is_dir() {
            sources(&path, list);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            list.push(path);
        }
    }
}

/// Names after `crate::` in the code of a file; its tests may know everything.
fn known(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let names = lines.flat_map(|line| line.split("crate::").skip(1));
    let first = |rest: &str| -> String {
        let letters = rest.chars();
        letters
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    names.map(first).collect()
}

fn check(root: &str, layers: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(root);
    let rank = |name: &str| layers.iter().position(|layer| *layer == name);
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 50, "{} sources", files.len());
    for file in files {
        let path = file.strip_prefix(&root).expect("below the root");
        let module = path.components().next().expect("a file");
        let module = Path::new(module.as_os_str()).with_extension("");
        let module = module.to_str().expect("letters");
        if module == "lib" {
            continue;
        }
        let own = rank(module).unwrap_or_else(|| panic!("`{module}` has no place in the order"));
        let text = fs::read_to_string(&file).expect("text");
        for name in known(&text) {
            let above = rank(&name).is_some_and(|rank| rank > own);
            assert!(
                !above,
                "{} knows `{name}`, which stands above it",
                path.display()
            );
        }
    }
}

#[test]
fn no_module_of_the_engine_knows_one_above() {
    check("lagrange-macros/engine/src", &ENGINE);
}

#[test]
fn no_module_of_the_core_knows_one_above() {
    check("lagrange-core/src", &CORE);
}

#[test]
fn no_module_of_the_program_knows_one_above() {
    check("problems/program/src", &PROGRAM);
}

/// Not even its tests, as cargo would let them: a change of a scene would build the program again.
#[test]
fn the_program_knows_no_scene() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../problems/program");
    let manifest = fs::read_to_string(root.join("Cargo.toml")).expect("a manifest");
    assert!(manifest.contains("name = \"lagrange-program\""));
    for above in ["lagrange-problems", "lagrange-tests"] {
        let known = manifest.lines().any(|line| line.starts_with(above));
        assert!(!known, "the program knows {above}");
    }
}
