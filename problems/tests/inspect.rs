//! `lagrange inspect`: the derivations of the textbook scenes as they stand in `tests/inspect/`, and every format of every
//! scene well-formed. `UPDATE_EXPECT=1 cargo test` accepts what reads better.

mod program;

use expect_test::expect_file;
use lagrange_core::prelude::*;
use lagrange_problems::catalogue::{find, scenes};
use lagrange_problems::scenes::MassOnWheel;
use program::{refuses, says};
use serde_json::Value;

/// The textbook scenes, and a smooth one.
const TEXTBOOK: [&str; 6] = [
    "mass-on-shell",
    "rolling-sphere",
    "rolling-slipping-sphere",
    "mass-on-wheel",
    "sphere-in-bowl",
    "double-pendulum",
];

#[test]
fn derivations_of_the_textbook_scenes() {
    for scene in TEXTBOOK {
        let derivation = find(scene).unwrap_or_else(|e| panic!("{e}")).derivation();
        expect_file![format!("inspect/{scene}.txt")].assert_eq(derivation.text);
        expect_file![format!("inspect/{scene}.tex")].assert_eq(derivation.latex);
    }
}

/// What the struct says of itself is what the program says of it.
#[test]
fn the_program_and_the_struct_agree() {
    let derivation = MassOnWheel::derivation();
    let inspect = |format: &str| says(&["inspect", "mass-on-wheel", "--format", format]);
    assert_eq!(derivation.text, inspect("text"));
    assert_eq!(derivation.latex, inspect("latex"));
    assert_eq!(derivation.graph, inspect("graph"));
    assert_eq!(derivation.to_string(), says(&["inspect", "mass-on-wheel"]));
    assert_eq!(derivation.name, "MassOnWheel");
}

#[test]
fn mathml_is_well_formed() {
    for scene in scenes() {
        let page = says(&["inspect", scene.name(), "--format", "mathml"]);
        for text in [&page, scene.derivation().equations] {
            let document = roxmltree::Document::parse(text)
                .unwrap_or_else(|error| panic!("{}: {error}", scene.name()));
            let math = |node: &roxmltree::Node| node.has_tag_name("math");
            assert!(document.descendants().any(|node| math(&node)));
            for node in document.descendants() {
                let children = node.children().filter(|child| child.is_element()).count();
                let expected = match node.tag_name().name() {
                    "mfrac" | "msub" | "msup" | "mover" => 2,
                    "msubsup" | "munderover" => 3,
                    _ => children,
                };
                assert_eq!(children, expected, "{}: {node:?}", scene.name());
            }
        }
        assert!(!scene.derivation().equations.contains('\n'));
    }
}

#[test]
fn braces_of_latex_balance() {
    for scene in scenes() {
        let latex = scene.derivation().latex;
        let mut depth = 0;
        let mut escaped = false;
        for c in latex.chars() {
            match c {
                '{' if !escaped => depth += 1,
                '}' if !escaped => depth -= 1,
                _ => {}
            }
            assert!(depth >= 0, "{}", scene.name());
            escaped = c == '\\' && !escaped;
        }
        assert_eq!(depth, 0, "{}", scene.name());
        for pair in [("\\left", "\\right"), ("\\begin{", "\\end{")] {
            let count = |word| latex.matches(word).count();
            // `\leftarrow` and the like do not occur.
            assert_eq!(count(pair.0), count(pair.1), "{}", scene.name());
        }
    }
}

#[test]
fn json_has_what_its_schema_says() {
    for scene in scenes() {
        let text = says(&["inspect", scene.name(), "--format", "json"]);
        let value: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(value["schema"], "lagrange.derivation.1");
        let count = |key: &str| value[key].as_array().map_or(0, Vec::len);
        let description = scene.description();
        let shown = |n: usize| if n > 12 { 5 } else { n };
        assert_eq!(count("motion"), shown(description.coordinates.len()));
        assert_eq!(count("rows"), shown(description.rows.len()));
        assert!(count("modes") > 0 && count("conserved") > 0 && count("operations") > 0);
        for equation in value["motion"].as_array().into_iter().flatten() {
            for side in ["left", "right"] {
                assert!(equation["equation"][side]["text"].is_string());
                assert!(equation["equation"][side]["latex"].is_string());
            }
        }
    }
}

/// Modes are called as a run calls them, so that a line of its story can be looked up.
#[test]
fn modes_have_the_names_of_a_run() {
    let text = says(&["inspect", "mass-on-wheel", "--format", "json"]);
    let value: Value = serde_json::from_str(&text).expect("JSON");
    let modes = value["modes"].as_array().expect("modes");
    let names: Vec<&str> = modes
        .iter()
        .filter_map(|mode| mode["name"].as_str())
        .collect();
    let run = says(&["run", "mass-on-wheel", "--format", "json"]);
    let run: Value = serde_json::from_str(&run).expect("JSON");
    for event in run["events"].as_array().expect("events") {
        let mode = event["from"].as_str().expect("a mode");
        assert!(names.contains(&mode), "{mode} is not among {names:?}");
        let one = says(&["inspect", "mass-on-wheel", "--mode", mode]);
        assert!(one.contains(mode), "{one}");
    }
    let open = Mode::open(MassOnWheel::<f64>::DESCRIPTION);
    assert_eq!(
        names[0],
        open.display(MassOnWheel::<f64>::DESCRIPTION).to_string()
    );
}

#[test]
fn the_emitted_rust_parses() {
    let rust = says(&["inspect", "mass-on-wheel", "--format", "rust"]);
    syn::parse_file(&rust).expect("Rust");
    assert!(rust.contains("fn motion"));
}

#[test]
fn graphs_name_every_mode() {
    let graph = says(&["inspect", "sphere-in-bowl", "--format", "graph"]);
    assert!(graph.starts_with("flowchart LR\n"));
    for mode in [
        "bowl open",
        "bowl closed, grip sticks",
        "grip slips forward",
    ] {
        assert!(graph.contains(mode), "{graph}");
    }
    let dot = says(&["inspect", "sphere-in-bowl", "--format", "dot"]);
    assert!(dot.starts_with("digraph \"SphereInBowl\" {\n") && dot.ends_with("}\n"));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let wheel = |arguments: &[&str], reason: &str| {
        refuses(
            &[&["inspect", "mass-on-wheel"], arguments].concat(),
            2,
            reason,
        );
    };
    refuses(
        &["inspect", "mass-on-whele"],
        2,
        "did you mean `mass-on-wheel`?",
    );
    wheel(
        &["--mode", "rim closed, grip stiks"],
        "did you mean `rim closed, grip sticks`?",
    );
    wheel(&["--mode", "flying"], "there are: `rim open`");
    wheel(
        &["--format", "pdf"],
        "text, latex, mathml, markdown, rust, graph, dot, json",
    );
    wheel(
        &["--format", "rust", "--mode", "rim open"],
        "serves all modes",
    );
}

#[test]
fn a_file_is_written() {
    let file = std::env::temp_dir().join(format!("inspect-{}.md", std::process::id()));
    let path = file.to_str().expect("a path");
    let said = says(&[
        "inspect",
        "mass-on-wheel",
        "--format",
        "markdown",
        "--output",
        path,
    ]);
    let written = std::fs::read_to_string(&file).expect("a file");
    std::fs::remove_file(&file).expect("it was there");
    assert_eq!(said, "");
    assert!(written.starts_with("# MassOnWheel\n") && written.contains("```mermaid\n"));
}
