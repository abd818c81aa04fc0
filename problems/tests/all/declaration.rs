//! A declaration in a file is a scene to every command.

use crate::program::{folder, lagrange_in, text};
use expect_test::expect_file;
use lagrange_core::prelude::*;
use lagrange_program::Results;
use lagrange_program::file::TEMPLATE;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// What `lagrange export` makes of the template, compiled.
#[path = "golden/crate/pendulum.rs"]
mod exported;

/// The crate that `lagrange new --crate` writes, compiled; it has the same struct.
#[path = "golden/crate/main.rs"]
#[allow(dead_code, clippy::duplicate_mod)]
mod written;

/// Runs it in a folder with the template as `pendulum.lagrange`, expects success; stdout.
fn says(folder: &Path, arguments: &[&str]) -> String {
    fs::write(folder.join("pendulum.lagrange"), TEMPLATE).expect("a file");
    let output = lagrange_in(folder, arguments);
    assert_eq!(text(&output.stderr), "", "{arguments:?}");
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    text(&output.stdout).to_owned()
}

/// What cannot be plotted or written is refused with its cause.
#[test]
fn results_that_cannot_be_had_say_why() {
    let scene = exported::Pendulum::default();
    let start = scene.at(<exported::Pendulum>::RELEASED);
    let folder = folder("declaration-refused");
    let simulation = || Simulation::new(&scene);
    let bare = simulation().record(false).run(&start, 0.0..1.0);
    let refused = bare.expect("a run").plot(folder.join("bare.svg"));
    assert_eq!(
        refused
            .expect_err("nothing is known in between")
            .to_string(),
        Error::NotRecorded.to_string()
    );
    let run = simulation().run(&start, 0.0..1.0).expect("a run");
    for name in ["run.csv", "run.svg", "run.html"] {
        let path = folder.join("nowhere").join(name);
        let written = match name {
            "run.csv" => run.write(&path),
            "run.svg" => run.plot(&path),
            _ => run.report(&path),
        };
        let said = written.expect_err("no such folder").to_string();
        let begins = format!("cannot write {}: ", path.display());
        assert!(said.starts_with(&begins), "{said}");
    }
}

#[test]
fn every_command_takes_a_file() {
    let folder = folder("declaration");
    let file = "pendulum.lagrange";
    for (arguments, expected) in [
        (&["list", file][..], "released, pushed"),
        (
            &["list", file],
            "gravity = 9.81    m/s²   Gravitational acceleration.",
        ),
        (&["run", file, "--from", "pushed"], "lowest mark"),
        (
            &["run", file, "--without", "bearing", "--save", "free.toml"],
            "total",
        ),
        (&["run", "free.toml", "--set", "length=2"], "total"),
        (&["verify", file], "Certified"),
        (&["inspect", file], "½ mass length² θ̇²"),
        (
            &["inspect", file, "--format", "rust"],
            "A run of a file interprets the same operations",
        ),
        (&["effects", file], "bearing"),
        (&["accuracy", file, "--tolerances", "1e-3..1e-5"], "taylor"),
        (
            &[
                "sweep",
                file,
                "--vary",
                "length=1..2:3",
                "--observe",
                "theta",
            ],
            "theta",
        ),
        (&["report", file, "--compare", "without:bearing"], ""),
    ] {
        let said = says(&folder, arguments);
        assert!(said.contains(expected), "{arguments:?}\n{said}");
    }
    let saved = fs::read_to_string(folder.join("free.toml")).expect("a scene file");
    assert!(
        saved.starts_with("scene = \"pendulum.lagrange\""),
        "{saved}"
    );
}

#[test]
fn mistakes_stop_a_command_before_it_begins() {
    let folder = folder("declaration-wrong");
    let wrong = TEMPLATE.replace("length * sin", "lenght * sin");
    fs::write(folder.join("wrong.lagrange"), wrong).expect("a file");
    fs::write(folder.join("wrong.toml"), "scene = \"wrong.lagrange\"\n").expect("a file");
    let mistake = "wrong.lagrange:22:9: `lenght` is not known; did you mean `length`? [E201]\n  \
                   22 |     x = lenght * sin(theta),\n     |         ^^^^^^\n";
    for (arguments, expected) in [
        (
            &["run", "wrong.lagrange"][..],
            format!("lagrange: {mistake}"),
        ),
        (
            &["export", "wrong.lagrange"],
            format!("lagrange: {mistake}"),
        ),
        (
            &["report", "wrong.toml"],
            format!("lagrange: wrong.toml:1:9: {mistake}"),
        ),
    ] {
        let output = lagrange_in(&folder, arguments);
        assert_eq!(text(&output.stderr), expected, "{arguments:?}");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    // Written in another encoding, byte 7 is é.
    for name in ["latin.lagrange", "latin.toml"] {
        fs::write(folder.join(name), b"\n// Caf\xe9.").expect("a file");
    }
    let latin = "is not UTF-8; save the file as UTF-8";
    for (arguments, expected) in [
        (
            ["run", "latin.lagrange"],
            &*format!("cannot read latin.lagrange: byte 7, in line 2, {latin}"),
        ),
        (["run", "latin.toml"], latin),
        (["run", "missing.lagrange"], "cannot read missing.lagrange"),
        (["run", "wrong"], "did you mean the file `wrong.toml`?"),
        (["export", "wrong.toml"], "its name ends in .lagrange"),
        (["new", "wrong"], "wrong.lagrange is there already"),
        (["wrong.lagrange", ""], "lagrange run wrong.lagrange"),
    ] {
        let output = lagrange_in(&folder, &arguments);
        assert!(
            text(&output.stderr).contains(expected),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn new_writes_what_runs() {
    let folder = folder("declaration-new");
    let output = lagrange_in(&folder, &["new", "swing"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(
        fs::read_to_string(folder.join("swing.lagrange")).expect("it"),
        TEMPLATE
    );
    let output = lagrange_in(&folder, &["new", "x y"]);
    assert_eq!(
        text(&output.stdout),
        "x y.lagrange is written; run it: lagrange run 'x y.lagrange'\n"
    );
    let output = lagrange_in(&folder, &["new", "--", "-x"]);
    assert_eq!(
        text(&output.stdout),
        "-x.lagrange is written; run it: lagrange run ./-x.lagrange\n"
    );
    assert_eq!(
        lagrange_in(&folder, &["run", "swing.lagrange"])
            .status
            .code(),
        Some(0)
    );
}

/// A block that a force pulls from its place as soon as the run begins.
const PULLED: &str = "\
parameters(m: \"kg\" = 1, g: \"m/s^2\" = 9.81, mu = 0.1, pull: \"N\" = 5),
coordinates(x: \"m\", y: \"m\"),
kinetic = m/2*(der(x)^2 + der(y)^2),
potential = m*g*y,
contact(floor: y >= 0),
friction(grip on floor: slip = der(x), static = mu),
force(hand: x = pull),
start(rest),
observe(backward = -der(y)),
";

#[test]
fn a_story_begins_with_what_was_decided_at_its_start() {
    let folder = folder("pulled");
    fs::write(folder.join("pulled.lagrange"), PULLED).expect("a file");
    let story = says(&folder, &["run", "pulled.lagrange"]);
    let line = |word: &str| story.lines().find(|line| line.contains(word)).expect("it");
    assert!(
        line("start").ends_with("floor closed, grip slips forward"),
        "{story}"
    );
    // The friction is μ m g, not the 5 N that would hold the block.
    assert!(line("start").contains(" -0.98100 "), "{story}");
    assert!(
        story.lines().any(|line| line.trim() == "grip slips") && !story.contains('→'),
        "{story}"
    );
    for format in ["csv", "json", "jsonl"] {
        let data = says(&folder, &["run", "pulled.lagrange", "--format", format]);
        let negative_zero = data.split([',', ':', '\n', ' ']).find(|text| {
            text.parse()
                .is_ok_and(|x: f64| x == 0.0 && x.is_sign_negative())
        });
        assert_eq!(negative_zero, None, "{format}");
    }
}

#[test]
fn a_run_that_failed_has_results() {
    let scene = exported::Pendulum::default();
    let stopped = Simulation::new(&scene)
        .max_steps(2)
        .run(scene.at(<exported::Pendulum>::RELEASED), 0.0..3.0)
        .expect_err("two steps are too few");
    let story = stopped.story();
    assert!(story.contains("failed"), "{story}");
    assert!(story.trim_end().ends_with(&stopped.to_string()), "{story}");
    let file = folder("failure").join("run.txt");
    stopped.write(&file).expect("a file");
    assert_eq!(fs::read_to_string(file).expect("it"), story);
}

/// The exported struct has emitted functions; the file is interpreted.
#[test]
fn an_exported_struct_moves_as_the_file_does() {
    let folder = folder("declaration-export");
    expect_file!["golden/crate/pendulum.rs"]
        .assert_eq(&says(&folder, &["export", "pendulum.lagrange"]));
    let json = says(
        &folder,
        &[
            "run",
            "pendulum.lagrange",
            "--until",
            "3",
            "--format",
            "json",
        ],
    );
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let scene = exported::Pendulum::default();
    let start = scene.at(<exported::Pendulum>::RELEASED);
    let run = Simulation::new(&scene)
        .run(start, 0.0..3.0)
        .expect("it runs");
    let marks = json["events"].as_array().expect("events");
    assert_eq!(marks.len(), run.events().len());
    for (event, told) in run.events().iter().zip(marks) {
        let time = told["time"].as_f64().expect("a time");
        assert!((event.time - time).abs() < 1e-12, "{} {time}", event.time);
    }
}

#[test]
fn new_writes_a_crate() {
    let folder = folder("declaration-crate");
    let output = lagrange_in(&folder, &["new", "--crate", "Swings 2"]);
    assert_eq!(text(&output.stderr), "");
    let written = |name: &str| fs::read_to_string(folder.join("Swings 2").join(name)).expect("it");
    expect_file!["golden/crate/main.rs"].assert_eq(&written("src/main.rs"));
    expect_file!["golden/crate/pendulum.rs"].assert_eq(&written("src/pendulum.rs"));
    let cargo: toml::Table = written("Cargo.toml").parse().expect("TOML");
    assert_eq!(cargo["package"]["name"].as_str(), Some("swings-2"));
    for (name, krate) in cargo["dependencies"].as_table().expect("dependencies") {
        let path = Path::new(krate["path"].as_str().expect("a path"));
        let text = fs::read_to_string(path.join("Cargo.toml")).expect("a crate");
        assert!(text.contains(&format!("name = \"{name}\"")), "{name}");
    }
}

/// Cargo cannot tell two packages of one name in folders apart.
#[test]
fn a_new_crate_has_a_name_of_its_own() {
    let folder = folder("declaration-crate-name");
    lagrange_in(&folder, &["new", "--crate", "lagrange-core"]);
    let cargo = fs::read_to_string(folder.join("lagrange-core/Cargo.toml")).expect("it");
    let cargo: toml::Table = cargo.parse().expect("TOML");
    let name = cargo["package"]["name"].as_str();
    assert_eq!(name, Some("crate-lagrange-core"));
}

#[test]
fn a_file_that_is_watched_runs_again() {
    let folder = folder("declaration-watch");
    let file = folder.join("pendulum.lagrange");
    fs::write(&file, TEMPLATE).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"));
    program
        .current_dir(&folder)
        .args(["run", "pendulum.lagrange", "--watch"]);
    let mut program = program
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(program.stdout.take().expect("stdout")).lines();
    let mut story = || -> String {
        let lines = lines.by_ref().map(|line| line.expect("text"));
        lines
            .take_while(|line| !line.starts_with("Work:"))
            .collect()
    };
    let first = story();
    fs::write(
        &file,
        TEMPLATE.replace("mark(lowest: theta)", "mark(bottom: theta)"),
    )
    .expect("it");
    let second = story();
    program.kill().expect("it runs until it is ended");
    program.wait().expect("it has ended");
    assert!(
        first.contains("lowest mark") && second.contains("bottom mark"),
        "{second}"
    );
}
