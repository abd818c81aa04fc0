//! `lagrange inspect`: the program and the struct say the same, formats are what they are called, mistakes are one line.

use crate::program::{folder, path, refuses, says};
use lagrange_core::prelude::*;
use lagrange_problems::catalogue::scenes;
use lagrange_problems::scenes::MassOnWheel;
use serde_json::Value;

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
fn json_has_what_its_schema_says() {
    for scene in scenes() {
        let text = says(&["inspect", scene.name(), "--format", "json"]);
        let value: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(value["schema"], "lagrange.derivation.1");
        let count = |key: &str| value[key].as_array().map_or(0, Vec::len);
        let description = scene.description();
        // Three rates of a body in place of four coordinates and a row that keeps their sum of squares.
        let shown = |n: usize| match n - count("bodies") {
            n if n > 12 => 5,
            n => n,
        };
        assert_eq!(count("motion"), shown(description.coordinates.len()));
        assert_eq!(count("rows"), shown(description.rows.len()));
        for mode in value["modes"].as_array().into_iter().flatten() {
            let len = |key: &str| mode[key].as_array().map_or(0, Vec::len);
            let told = len("solution") + len("left_out");
            assert!(
                told == 0 || told == len("unknowns"),
                "{}: {mode}",
                scene.name()
            );
        }
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
    for part in ["fn value_0", "struct Series0", "// Program of `motion`:"] {
        assert!(rust.contains(part), "{part}");
    }
    // What the declaration names keeps its name.
    for part in [
        "p_mass_ = self.mass;",
        "turn19_.sin_cos(q_theta_)",
        "a_theta",
        "v_phi",
    ] {
        assert!(rust.contains(part), "{part}");
    }
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
        &["--mode", "rim closed"],
        "with that there are `rim closed, grip sticks`, `rim closed, grip slips forward`",
    );
    wheel(
        &["--mode", "rim closed, grip stiks"],
        "did you mean `rim closed, grip sticks`?",
    );
    wheel(&["--mode", "flying"], "there are: `rim open`");
    // What is written right is no other mode's.
    refuses(
        &["inspect", "ladder", "--mode", "flor and wall closed"],
        2,
        "did you mean `wall closed, floor closed`?",
    );
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
fn a_file_has_the_format_that_its_name_says() {
    let folder = folder("inspected");
    let written = |name: &str, format: &[&str]| {
        let file = folder.join(name);
        let inspect = ["inspect", "mass-on-wheel", "--output", path(&file)];
        assert_eq!(says(&[&inspect, format].concat()), "");
        std::fs::read_to_string(file).expect("a file")
    };
    let printed = |format: &str| says(&["inspect", "mass-on-wheel", "--format", format]);
    for (ending, format) in [
        ("txt", "text"),
        ("tex", "latex"),
        ("html", "mathml"),
        ("md", "markdown"),
        ("rs", "rust"),
        ("mmd", "graph"),
        ("dot", "dot"),
        ("json", "json"),
    ] {
        let name = format!("wheel.{ending}");
        assert_eq!(written(&name, &[]), printed(format), "{name}");
        let other = written(&name, &["--format", "markdown"]);
        assert_eq!(other, printed("markdown"), "{name}");
    }
    assert_eq!(written("wheel", &[]), printed("text"));
    assert_eq!(
        says(&["inspect", "mass-on-wheel", "--output", "-"]),
        printed("text")
    );
    refuses(
        &["inspect", "mass-on-wheel", "--output", "wheel.pdf"],
        2,
        "the name wheel.pdf says no format: let it end in .txt, .tex,",
    );
}

/// The LaTeX of all scenes on pages of the usual width. Skipped where there is no TeX.
#[test]
fn latex_compiles_and_stays_on_the_page() {
    let folder = std::env::temp_dir().join(format!("lagrange-latex-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut document =
        "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n".to_owned();
    for scene in scenes() {
        let name = scene.name();
        let file = folder.join(format!("{name}.tex"));
        std::fs::write(file, says(&["inspect", name, "--format", "latex"])).expect("a file");
        document += &format!("\\typeout{{Scene {name}}}\n\\input{{{name}}}\\clearpage\n");
    }
    document += "\\end{document}\n";
    std::fs::write(folder.join("all.tex"), document).expect("a file");
    let tex = std::process::Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "all.tex"])
        .current_dir(&folder)
        .output();
    let Ok(tex) = tex else {
        std::fs::remove_dir_all(&folder).expect("it is ours");
        println!("skipped: there is no pdflatex on this machine");
        return;
    };
    let said = String::from_utf8_lossy(&tex.stdout);
    let wrong = |line: &&str| {
        let signs = ["Scene ", "! ", "Overfull", "Missing character"];
        signs.iter().any(|sign| line.starts_with(sign))
    };
    let lines: Vec<&str> = said.lines().filter(wrong).collect();
    // Each with the scene before it.
    let pairs = lines
        .windows(2)
        .filter(|pair| !pair[1].starts_with("Scene "));
    assert_eq!(pairs.collect::<Vec<_>>(), Vec::<&[&str]>::new());
    assert!(tex.status.success());
    std::fs::remove_dir_all(&folder).expect("it is ours");
}
