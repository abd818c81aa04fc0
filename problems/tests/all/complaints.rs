//! What a user can get wrong at the command line: one line on stderr that says what to write instead, and an exit code.

use crate::program::{folder, lagrange, lagrange_in, refuses, text};
use std::fs;
use std::process::{Command, Stdio};

#[test]
fn names_that_are_nearly_right_are_recognised() {
    let meant = |arguments: &[&str], meant: &str| {
        refuses(arguments, 2, &format!("did you mean `{meant}`?"));
    };
    meant(&["rnu"], "run");
    meant(&["run", "mass-on-whele"], "mass-on-wheel");
    meant(&["list", "kepelr"], "kepler");
    meant(&["inspect", "ladde"], "ladder");
    meant(&["report", "kepler", "mas-on-wheel"], "mass-on-wheel");
    meant(&["completions", "bahs"], "bash");
    meant(&["stability", "--only", "laddr"], "ladder");
    meant(&["run", "kepler", "--colour", "never"], "--color");
    meant(&["run", "kepler", "--color", "nevr"], "never");
    meant(
        &["accuracy", "kepler", "--methods", "taylor,vernr98"],
        "verner98",
    );
    let run = |arguments: &[&str], name: &str| {
        meant(&[&["run", "mass-on-wheel"], arguments].concat(), name);
    };
    run(&["--set", "mu_statik=1"], "mu_static");
    run(&["--start", "thta=1"], "theta");
    run(&["--start", "der(thta)=1"], "der(theta)");
    run(&["--from", "rset"], "rest");
    run(&["--with", "gripp"], "grip");
    run(&["--without", "flor"], "floor");
    run(&["--end-after", "rim lots"], "rim lost");
    run(&["--method", "tayler"], "taylor");
    run(&["--format", "jsn"], "json");
    run(&["--tolerence", "1e-9"], "--tolerance");
    let sweep = |vary: &str, observe: &str, name: &str| {
        let sweep = [
            "sweep",
            "mass-on-wheel",
            "--vary",
            vary,
            "--observe",
            observe,
        ];
        meant(&sweep, name);
    };
    sweep("mu_statik=1..2:2", "theta", "mu_static");
    sweep("mu_static=1..2:2", "thta", "theta");
    sweep("mu_static=1..2:2", "theta at rim lots", "rim lost");
}

#[test]
fn a_size_that_nothing_could_hold_is_refused_with_it() {
    let sweep = |vary: &[&str], said: &str| {
        let vary = vary.iter().flat_map(|axis| ["--vary", axis]);
        let arguments: Vec<&str> = ["sweep", "mass-on-wheel", "--observe", "theta"]
            .into_iter()
            .chain(vary)
            .collect();
        refuses(&arguments, 2, said);
    };
    // A number observed and a reason of failure for each point: 16 bytes.
    sweep(
        &["mass=1..2:1e14"],
        "1e14 points are too many: their results would take 1.6e15 bytes",
    );
    let grid = ["mass=1..2:1e11", "mu_static=1..2:100000000000"];
    sweep(
        &grid,
        "1e22 points are too many: their results would take 1.6e23 bytes",
    );
    sweep(&["mass=1..2:1.5"], "`1.5` is not a number of values");
    let samples =
        |samples: &str, said: &str| refuses(&["run", "kepler", "--samples", samples], 2, said);
    samples("1e9", "there can be 1 to 1000000 intervals");
    samples("ten", "`ten` is not a number of intervals");
    samples("0", "`0` is not a number of intervals");
    let width = |width: &str, said: &str| refuses(&["report", "kepler", "--width", width], 2, said);
    width("1.5", "`1.5` is not a number of pixels");
    width("1e4", "there can be 16 to 8192 pixels");
    let workers = ["sweep", "kepler", "--vary", "mu=1..2:2", "--observe", "x"];
    refuses(
        &[&workers[..], &["--workers", "all"]].concat(),
        2,
        "`all` is not a number of cores",
    );
}

#[test]
fn what_is_missing_or_too_much_is_said() {
    refuses(&["mass-on-wheel"], 2, "lagrange run mass-on-wheel");
    refuses(&["run", "kepler", "more"], 2, "what is `more` for?");
    refuses(
        &["run", "kepler", "--set"],
        2,
        "a value is missing: --set <NAME=VALUE>",
    );
    refuses(
        &["run", "kepler", "--until", "1", "--until", "2"],
        2,
        "`--until` is given twice",
    );
    refuses(&["run", "kepler", "--samples", "0"], 2, "--samples 0");
    refuses(
        &["run", "kepler", "--method", "rk4"],
        2,
        "give one as rk4:0.001",
    );
    refuses(
        &["run", "kepler", "--method", "taylor:1"],
        2,
        "leave out the step size",
    );
    for command in ["run", "accuracy", "effects"] {
        refuses(
            &[
                command,
                "mass-on-wheel",
                "--without",
                "rim",
                "--end-after",
                "grip slips",
            ],
            2,
            "`grip slips`: `grip` is left out, and its events with it",
        );
    }
    refuses(
        &["accuracy", "kepler", "--tolerances", "2"],
        2,
        "between 1e-17 and 0.1",
    );
    refuses(
        &["run", "kepler", "--tolerance", "2"],
        2,
        "between 1e-17 and 0.1",
    );
    refuses(
        &["inspect", "kepler", "--format", "rust", "--mode", "x"],
        2,
        "leave out `--mode`",
    );
}

#[test]
fn scene_files_that_cannot_be_read_are_named() {
    let folder = folder("scene-files");
    fs::write(folder.join("wheel.toml"), "scene = \"mass-on-whele\"\n").expect("a file");
    fs::write(folder.join("wheel"), "").expect("a file");
    fs::write(folder.join("binary.toml"), [0xff, 0xfe, 0x00]).expect("a file");
    fs::create_dir_all(folder.join("folder.toml")).expect("a folder");
    let told = |arguments: &[&str], reason: &str| {
        let output = lagrange_in(&folder, arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains(reason), "{said}");
    };
    for command in ["run", "accuracy", "effects", "report"] {
        told(
            &[command, "wheel.toml"],
            "wheel.toml:1:9: no scene is called `mass-on-whele`",
        );
        told(&[command, "nowhere.toml"], "cannot read nowhere.toml");
    }
    told(&["run", "wheel"], "did you mean the file `wheel.toml`?");
    fs::remove_file(folder.join("wheel.toml")).expect("it was there");
    told(&["run", "wheel"], "the name of a scene file ends in .toml");
    told(&["run", "binary.toml"], "cannot read binary.toml");
    told(&["run", "folder.toml"], "cannot read folder.toml");
    fs::create_dir_all(folder.join("swings")).expect("a folder");
    told(
        &["run", "swings"],
        "`swings` is a folder; name a file in it: a declaration, swings/NAME.lagrange",
    );
    fs::write(folder.join("swings/Cargo.toml"), "").expect("a file");
    told(&["report", "swings"], "is the folder of a crate");
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_the_run() {
    let folder = folder("outputs");
    let scene = "scene = \"kepler\"\nuntil = 1e9\n";
    fs::write(folder.join("long.toml"), scene).expect("a file");
    fs::create_dir_all(folder.join("there.csv")).expect("a folder");
    let told = |arguments: &[&str], code: i32, reason: &str| {
        // The run would take minutes.
        let output = lagrange_in(&folder, &[&["run", "long.toml"], arguments].concat());
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert_eq!(said.lines().count(), 1, "{arguments:?}: {said}");
        assert!(said.contains(reason), "{arguments:?}: {said}");
    };
    told(
        &["--output", "no/run.csv"],
        1,
        "cannot write no/run.csv: there is no folder no; make it first",
    );
    told(&["--plot", "no/run.svg"], 1, "there is no folder no");
    told(&["--save", "no/run.toml"], 1, "there is no folder no");
    let long = format!("{}.csv", "n".repeat(300));
    told(&["--output", &long], 1, "cannot write nnn");
    told(&["--output", "there.csv"], 1, "it is a folder");
    told(
        &["--output", "long.toml", "--format", "csv"],
        2,
        "long.toml is the scene file itself",
    );
    told(&["--save", "./long.toml"], 2, "is the scene file itself");
    told(
        &["--format", "csv", "--output", "a.svg", "--plot", "a.svg"],
        2,
        "two results would go to a.svg",
    );
    told(&["--output", "run.xlsx"], 2, "let it end in .csv");
    told(
        &["--output", "run.svg"],
        2,
        "pictures are drawn with --plot",
    );
    told(
        &["--output", "a.csv", "--output", "b.csv", "--format", "csv"],
        2,
        "leave the format out",
    );
    let there: Vec<_> = fs::read_dir(&folder).expect("the folder").collect();
    assert_eq!(there.len(), 2, "nothing was left behind");
    assert_eq!(
        fs::read_to_string(folder.join("long.toml")).expect("the file"),
        scene
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let full = || fs::OpenOptions::new().write(true).open("/dev/full");
    let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"));
    let output = program
        .args(["run", "mass-on-wheel"])
        .stdout(full().expect("the device"))
        .stderr(Stdio::piped())
        .output()
        .expect("the program starts");
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).starts_with("lagrange: cannot write the result: "));
    refuses(
        &["run", "mass-on-wheel", "--output", "/dev/full"],
        1,
        "cannot write /dev/full",
    );
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    for arguments in [
        &["list"][..],
        &["run", "kepler", "--format", "csv"],
        &["run", "--help"],
    ] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(program.stdout.take());
        let output = program.wait_with_output().expect("it ends");
        assert_eq!(text(&output.stderr), "", "{arguments:?}");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    }
}

#[test]
fn colours_come_when_they_are_asked_for() {
    let coloured = |arguments: &[&str]| text(&lagrange(arguments).stderr).contains('\u{1b}');
    assert!(!coloured(&["run", "nothing"]), "stderr is no terminal");
    assert!(coloured(&["run", "nothing", "--color", "always"]));
    assert!(coloured(&["--color=always", "run"]));
    assert!(!coloured(&["run", "nothing", "--color=never"]));
    let help = lagrange(&["run", "--help", "--color", "always"]);
    assert!(text(&help.stdout).contains('\u{1b}'));
}

/// A bead without inertia: whatever is to be run of it says where, and why.
#[test]
fn a_motion_that_cannot_begin_is_told_alike_by_all_commands() {
    let folder = folder("a bead without inertia");
    let declared = "parameters(bead = 0, cart = 2),\ncoordinates(s, x), kinetic = bead/2 * der(s)^2 + cart/2 * der(x)^2,\n\
        potential = s^2, friction(rail: slip = der(x), limit = 1), start(out: s = 1, der(x) = 3), until = 1,";
    fs::write(folder.join("bead.lagrange"), declared).expect("a file");
    let said = |command: &str| {
        let output = lagrange_in(&folder, &[command, "bead.lagrange"]);
        assert_eq!(output.status.code(), Some(1), "{command}");
        text(&output.stderr).to_owned()
    };
    let told = said("run");
    assert!(told.contains("bead.lagrange:2:13: "), "{told}");
    assert!(told.contains("the cause is `bead` = 0"), "{told}");
    for command in ["effects", "accuracy", "modes"] {
        assert_eq!(said(command), told, "{command}");
    }
}
