//! The program as a user meets it: what goes where, and with which exit code.

use crate::program::{folder, lagrange, lagrange_in, path, refuses, says, text};
use serde_json::Value;
use std::fs;

fn json(arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = ["run"]
        .iter()
        .chain(arguments)
        .chain(&["--format", "json"])
        .copied()
        .collect();
    serde_json::from_str(&says(&arguments)).expect("output is JSON")
}

/// `item kind` of every event.
fn story(run: &Value) -> Vec<String> {
    let word = |event: &Value, key: &str| event[key].as_str().unwrap_or_default().to_owned();
    let events = run["events"].as_array().expect("events is a list");
    events
        .iter()
        .map(|event| format!("{} {}", word(event, "item"), word(event, "kind")))
        .collect()
}

#[test]
fn list_has_every_scene_with_a_summary() {
    let list = says(&["list"]);
    let names = [
        "mass-on-shell",
        "rolling-sphere",
        "rolling-slipping-sphere",
        "mass-on-wheel",
        "sphere-in-bowl",
        "double-pendulum",
        "five-link-chain",
        "chain",
        "net",
        "cartesian-pendulum",
        "kepler",
        "stiff-spring-pendulum",
    ];
    for (line, name) in list.lines().zip(names) {
        assert!(line.starts_with(name), "{line}");
    }
    // The hard cases follow. A line is a name and what it is.
    assert!(list.lines().count() > names.len());
    let words = |line: &str| line.split_whitespace().count();
    assert!(list.lines().all(|line| words(line) > 4), "{list}");
    let details = says(&["list", "mass-on-wheel"]);
    for word in [
        "mu_static",
        "0.6",
        "theta",
        "rest",
        "rim",
        "grip",
        "floor",
        "px",
    ] {
        assert!(details.contains(word), "{word} is missing in\n{details}");
    }
}

#[test]
fn requests_without_sense_are_refused_in_one_line() {
    refuses(&[], 2, "lagrange list");
    refuses(&["walk"], 2, "no command is called `walk`; there are: list");
    refuses(&["run"], 2, "<SCENE>");
    refuses(
        &["list", "mass-on-whele"],
        2,
        "did you mean `mass-on-wheel`?",
    );
    let run = |arguments: &[&str], reason: &str| {
        refuses(&[&["run", "mass-on-wheel"], arguments].concat(), 2, reason);
    };
    run(&["--set", "mu_statik=1"], "did you mean `mu_static`?");
    run(
        &["--set", "mass=1", "--set", "mass=2"],
        "`mass` is given twice",
    );
    run(&["--set", "mass"], "expected name=value");
    run(&["--set", "mass=nan"], "must be finite");
    run(&["--set", "mass=1e999"], "must be finite");
    run(&["--from", "rset"], "did you mean `rest`?");
    run(&["--start", "thta=1"], "did you mean `theta`?");
    run(
        &["--start", "theta=1", "--start", "theta=1"],
        "`theta` is given twice",
    );
    refuses(
        &["run", "tumbling-body", "--start", "body.turn[0]=0.3"],
        2,
        "here a body is turned by all of q[0], q[1], q[2], q[3], which are",
    );
    refuses(
        &["run", "tumbling-body", "--without", "body"],
        2,
        "`body` is an attitude, which cannot be left out",
    );
    run(
        &["--without", "grip", "--with", "grip"],
        "`grip` is both left out and switched on",
    );
    run(
        &["--output", "-", "--output", "-"],
        "two results would go to stdout",
    );
    run(&["--until", "0"], "must be above 0");
    run(
        &["--until", "3s"],
        "`3s` is not a number: a value is a plain number",
    );
    run(&["--set", "mass=2kg"], "write it without a unit");
    run(&["--tolerance", "-1"], "must be above 0");
    run(
        &["--format", "xml"],
        "there are: table, json, jsonl, csv, parquet",
    );
}

#[test]
fn stories_in_order() {
    let story = |scene: &str| story(&json(&[scene]));
    assert_eq!(story("mass-on-shell"), ["shell lost", "floor stop"]);
    assert_eq!(story("rolling-sphere"), ["shell lost", "floor stop"]);
    assert_eq!(
        story("rolling-slipping-sphere"),
        ["grip slips", "shell lost", "floor stop"]
    );
    assert_eq!(
        story("mass-on-wheel"),
        ["grip slips", "rim lost", "floor stop"]
    );
}

#[test]
fn numbers_are_in_full_and_where_they_belong() {
    let run = json(&[
        "mass-on-shell",
        "--set",
        "start_angle=0.1",
        "--tolerance",
        "1e-12",
    ]);
    assert_eq!(run["scene"], "mass-on-shell");
    assert_eq!(run["parameters"]["start_angle"], 0.1);
    let lost = &run["events"][0];
    let theta = lost["state"]["theta"].as_f64().expect("θ is a number");
    assert!(
        (theta - (2.0 / 3.0 * 0.1f64.cos()).acos()).abs() < 1e-10,
        "{theta}"
    );
    assert!(
        lost["forces"]["shell"]
            .as_f64()
            .expect("N is a number")
            .abs()
            < 1e-10
    );
    assert!(run["final"]["time"].as_f64() > lost["time"].as_f64());
    assert!(
        run["energy"]["closure"]
            .as_f64()
            .expect("closure is a number")
            .abs()
            < 1e-10
    );
    assert!(run["work"]["steps"].as_u64() > Some(0));
}

#[test]
fn start_holds_what_is_named_and_solves_the_rest() {
    let run = json(&[
        "rolling-sphere",
        "--start",
        "theta=0.3",
        "--start",
        "der(theta)=1",
        "--until",
        "0.01",
    ]);
    let state = &run["start"]["state"];
    assert_eq!(state["theta"], 0.3);
    assert_eq!(state["der(theta)"], 1.0);
    let spin = state["der(phi)"].as_f64().expect("φ̇ is a number");
    assert!(
        (spin - 6.0).abs() < 1e-12,
        "a (φ̇ − θ̇) = R θ̇ gives 6, not {spin}"
    );
    // Held together, these two cannot roll.
    let impossible = [
        "run",
        "rolling-sphere",
        "--start",
        "der(theta)=1",
        "--start",
        "der(phi)=0",
    ];
    refuses(&impossible, 1, "rolling");
}

#[test]
fn csv_has_one_header_and_lines_in_order_of_time() {
    let table = says(&["run", "mass-on-wheel", "--format", "csv"]);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().expect("a header").clone();
    for name in [
        "t [s]",
        "event",
        "theta [rad]",
        "der(theta) [rad/s]",
        "force(rim) [N]",
        "kinetic [J]",
        "px [m]",
        "mode",
    ] {
        assert!(
            header.iter().any(|column| column == name),
            "`{name}` is missing in {header:?}"
        );
    }
    let times: Vec<f64> = reader
        .records()
        .map(|r| r.expect("a line")[0].parse().expect("a time"))
        .collect();
    assert!(times.len() > 200 && times.is_sorted());
}

#[test]
fn a_run_that_fails_prints_what_there_is() {
    let output = lagrange(&["run", "double-pendulum", "--method", "rk4:0.1"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).contains("start"));
    let said = text(&output.stderr);
    assert_eq!(said.lines().count(), 1);
    // In a file it says why it ends there.
    let folder = folder("a story that fails");
    let story = ["--method", "rk4:0.1", "--output", "run.txt"];
    lagrange_in(&folder, &[&["run", "double-pendulum"], &story[..]].concat());
    let written = fs::read_to_string(folder.join("run.txt")).expect("the story");
    let last = written.lines().last().expect("a line");
    assert_eq!(said.trim_end(), format!("lagrange: {last}"));
}

/// Without its wall a body falls to where its potential ends.
#[test]
fn effects_say_why_a_run_fails_without_one() {
    let folder = folder("effects that fail");
    let well = "coordinates(x), kinetic = der(x)^2/2, potential = sqrt(x), contact(wall: x >= 0.1),
        start(thrown: x = 1, der(x) = -1), until = 2,";
    fs::write(folder.join("well.lagrange"), well).expect("a file");
    let output = lagrange_in(&folder, &["effects", "well.lagrange"]);
    let told = text(&output.stdout);
    let last = told.lines().last().expect("a line");
    assert!(
        last.starts_with("Without wall the run fails: t = "),
        "{told}"
    );
}

/// Three masses on a table, without it: two fall freely, g t²/2 in a second, one is held by its part of it.
#[test]
fn an_array_is_left_out_by_its_name() {
    let folder = folder("array left out");
    let shelf = "coordinates(y[3]), kinetic = sum(k in 0..3: der(y[k])^2/2), potential = sum(k in 0..3: 10 * y[k]),
        contact(top[k in 0..3]: y[k] >= 0), start(still), until = 1,";
    fs::write(folder.join("shelf.lagrange"), shelf).expect("a file");
    let run = [
        "run",
        "shelf.lagrange",
        "--without",
        "top",
        "--with",
        "top[1]",
        "--format",
        "json",
    ];
    let output = lagrange_in(&folder, &run);
    let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(told["without"], serde_json::json!(["top[0]", "top[2]"]));
    for (k, expected) in [-5.0, 0.0, -5.0].into_iter().enumerate() {
        let y = told["final"]["state"][format!("y[{k}]")].as_f64();
        let y = y.unwrap_or_else(|| panic!("{told:#}"));
        assert!((y - expected).abs() < 1e-9, "y[{k}] = {y}");
    }
}

/// Five masses on a table: of so many contacts a story says in brief what they do, and what changes.
#[test]
fn of_many_items_a_story_says_what_changes() {
    let folder = folder("many items");
    let shelf = "parameters(gravity = 9.81),
        coordinates(x[5], y[5]),
        kinetic = sum(k in 0..5: (der(x[k])^2 + der(y[k])^2)/2),
        potential = sum(k in 0..5: gravity * y[k]),
        contact(top[k in 0..5]: y[k] >= 0, where x[k] <= 5),
        start(pushed: x[k in 0..5] = k, der(x[4]) = 2),
        until = 1,";
    fs::write(folder.join("shelf.lagrange"), shelf).expect("a file");
    let output = lagrange_in(&folder, &["run", "shelf.lagrange"]);
    let story = text(&output.stdout);
    let modes = [
        "all 5 contacts closed",
        "→ top[4] open",
        "4 of 5 contacts closed",
    ];
    for mode in modes {
        assert!(story.contains(mode), "{story}");
    }
    assert!(!story.contains("top[0] closed"), "{story}");
}

/// Long names beside many numbers: what a reader searches for stands in one piece.
#[test]
fn no_name_of_an_event_is_broken() {
    let folder = folder("long names");
    let joints = "parameters(torque: \"N m\" = 3, inertia: \"kg m^2\" = 1, rate: \"rad/s\" = 3),
        coordinates(a: \"rad\", b: \"rad\", c: \"rad\"),
        kinetic = inertia/2 * (der(a)^2 + der(b)^2 + der(c)^2),
        force(drive: b = torque * sin(rate * t)),
        friction(shoulder_bearing: slip = der(a), limit = torque/2),
        friction(elbow_bearing: slip = der(b), limit = torque/2),
        friction(wrist_bearing: slip = der(c), limit = torque/2),
        start(turned: der(a) = 1, der(c) = 2),
        until = 4,";
    fs::write(folder.join("joints.lagrange"), joints).expect("a file");
    let output = lagrange_in(&folder, &["run", "joints.lagrange"]);
    let story = text(&output.stdout);
    // The time of each event stands before its name.
    for name in ["shoulder_bearing", "elbow_bearing", "wrist_bearing"] {
        let named = |line: &str| line.split_whitespace().nth(1) == Some(name);
        assert!(story.lines().any(named), "{name} in\n{story}");
    }
}

/// A bar on three feet: the motion leaves open what each carries.
#[test]
fn forces_that_are_open_are_told_with_what_hangs_on_them() {
    let folder = folder("open forces");
    let bar = "parameters(mu = 0.3, gravity = 9.81, speed = 0),
        coordinates(x, z, pitch),
        kinetic = (der(x)^2 + der(z)^2 + der(pitch)^2/12)/2,
        potential = gravity * z,
        contact(foot[k in 0..3]: z + (k - 1)/2*pitch >= 0),
        friction(rub[k in 0..3] on foot[k]: slip = der(x), static = mu),
        start(go: der(x) = speed),
        until = 0.1,";
    fs::write(folder.join("bar.lagrange"), bar).expect("a file");
    for (speed, told) in [("speed=0", "does not depend"), ("speed=1", "may depend")] {
        let output = lagrange_in(&folder, &["run", "bar.lagrange", "--set", speed]);
        let story = text(&output.stdout);
        let open = story
            .lines()
            .find(|line| line.starts_with("Not determined"));
        assert!(open.is_some_and(|open| open.contains(told)), "{story}");
    }
}

#[test]
fn outputs_without_a_value_are_told() {
    let folder = folder("outputs without a value");
    let fall = "coordinates(x),
        kinetic = der(x)^2/2,
        potential = 10*x,
        observe(height = sqrt(x)),
        observe(speed = abs(der(x))),
        start(go: x = 5),
        until = 2,";
    // It is at the ground after a second.
    fs::write(folder.join("fall.lagrange"), fall).expect("a file");
    let output = lagrange_in(&folder, &["run", "fall.lagrange"]);
    let story = text(&output.stdout);
    let told = "No finite number: `height` at t = 2.000000 s.";
    assert!(story.contains(told), "{story}");
}

#[test]
fn of_many_branches_a_story_names_the_first() {
    let folder = folder("many branches");
    let wall = "coordinates(x),
        kinetic = der(x)^2/2,
        force(wall: x = -sum(k in 0..40: max(0, x - 100 - k))),
        start(go: der(x) = 1),
        until = 1,";
    fs::write(folder.join("wall.lagrange"), wall).expect("a file");
    let output = lagrange_in(&folder, &["run", "wall.lagrange"]);
    let story = text(&output.stdout);
    assert!(story.contains("37 more"), "{story}");
    assert!(story.lines().count() < 30, "{story}");
}

#[test]
fn a_run_whose_certificate_falls_short_is_printed_and_said_to_be_wrong() {
    // Between the ends of fixed steps that are too long the linkage comes apart.
    let loose = [
        "slider-crank",
        "--method",
        "rk4:0.02",
        "--tolerance",
        "1e-6",
    ];
    for command in ["run", "verify"] {
        let output = lagrange(&[&[command], &loose[..]].concat());
        assert_eq!(output.status.code(), Some(1), "{command}");
        assert!(text(&output.stdout).contains("Not certified: "));
        let said = text(&output.stderr);
        assert!(said.starts_with("lagrange: Not certified: "), "{said}");
        assert_eq!(said.lines().count(), 1);
    }
}

#[test]
fn what_a_run_was_to_end_after_and_did_not_is_told() {
    let told = "What the run was to end after has not happened: `grip slips 2`.";
    let story = |events: &[&str]| {
        let asked = events.iter().flat_map(|&event| ["--end-after", event]);
        let start = ["run", "mass-on-wheel"].into_iter();
        says(&start.chain(asked).collect::<Vec<_>>())
    };
    assert!(story(&["grip slips", "grip slips 2"]).contains(told));
    assert!(!story(&["grip slips"]).contains("has not happened"));
}

#[test]
fn events_beyond_their_limit_end_a_run() {
    let output = lagrange(&["run", "mass-on-wheel", "--max-events", "1"]);
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert!(said.contains("more than 1 event;"), "{said}");
    says(&["run", "mass-on-wheel", "--max-events", "1e3"]);
    // Marks are events: within 10 s cos t turns three times.
    let file = folder("marks").join("swing.lagrange");
    let declared = "coordinates(x), kinetic = der(x)^2, potential = x^2, start(out: x = 1), mark(turns: der(x)),";
    fs::write(&file, declared).expect("a file");
    says(&["run", path(&file), "--max-events", "3"]);
    let output = lagrange(&["run", path(&file), "--max-events", "2"]);
    let said = text(&output.stderr);
    assert!(said.contains("more than 2 events;"), "{said}");
    refuses(
        &["run", "mass-on-wheel", "--max-events", "0"],
        2,
        "is not a number of events",
    );
}

#[test]
fn a_run_says_what_its_declaration_makes_one_wonder_about() {
    let file = folder("hints").join("fed.lagrange");
    let declared = "coordinates(x), kinetic = der(x)^2/2,\ndissipation(damper: -der(x)^2), start(thrown: der(x) = 1),";
    fs::write(&file, declared).expect("a file");
    let output = lagrange(&["run", path(&file)]);
    assert!(output.status.success());
    let said = text(&output.stderr);
    assert!(
        said.contains("fed.lagrange:2:13: `damper` gives energy"),
        "{said}"
    );
    let output = lagrange(&["run", path(&file), "--quiet"]);
    assert_eq!(text(&output.stderr), "");
}

#[test]
fn a_run_that_fails_at_its_start_prints_only_why() {
    // Above μ = 4/3 a rod that slides has no answer at some angles (Painlevé).
    for command in ["run", "verify"] {
        let output = lagrange(&[command, "painleve-rod", "--set", "mu=2"]);
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(text(&output.stdout), "");
        assert_eq!(text(&output.stderr).lines().count(), 1);
    }
    // It says that also where a picture of it was asked for, in which nothing would be.
    let folder = folder("a plot of nothing");
    let output = lagrange_in(
        &folder,
        &["run", "painleve-rod", "--set", "mu=2", "--plot", "rod.svg"],
    );
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert!(said.contains("none of 2 modes continues"), "{said}");
    assert!(!folder.join("rod.svg").exists());
    // Nothing was moved, so there is nothing to certify and no work to book.
    let output = lagrange(&["run", "painleve-rod", "--set", "mu=2", "--format", "json"]);
    let run: Value = serde_json::from_str(text(&output.stdout)).expect("JSON");
    assert!(run["error"].is_string(), "{run}");
    assert!(run["certificate"].is_null() && run["energy"].is_null());
}

#[test]
fn files_are_written_or_the_reason_is_given() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (data, picture) = (folder.join("run.json"), folder.join("run.svg"));
    let [data, picture] = [&data, &picture].map(|path| path.to_str().expect("a plain path"));
    let run = [
        "run",
        "mass-on-wheel",
        "--format",
        "json",
        "--output",
        data,
        "--plot",
        picture,
    ];
    assert_eq!(says(&run), "");
    let written = std::fs::read_to_string(data).expect("the data");
    assert!(serde_json::from_str::<Value>(&written).is_ok());
    let drawn = std::fs::read_to_string(picture).expect("the picture");
    assert!(
        drawn.starts_with("<svg") && drawn.contains("rim open") && drawn.contains("μN of grip")
    );
    refuses(
        &[
            "run",
            "mass-on-wheel",
            "--output",
            "/nowhere/run.json",
            "--format",
            "json",
        ],
        1,
        "/nowhere/run.json",
    );
}

/// Path of a scene file of the catalogue.
fn scene_file(name: &str) -> String {
    format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn scene_files_run_and_the_command_line_has_the_last_word() {
    let folder = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes"));
    let mut count = 0;
    for file in folder.expect("scene files") {
        let path = file.expect("a file").path();
        says(&["run", path.to_str().expect("unicode")]);
        count += 1;
    }
    assert!(count >= 3);
    let sticky = json(&[&scene_file("sticky-wheel")]);
    assert_eq!(story(&sticky), ["rim lost", "floor stop"]);
    assert_eq!(sticky["parameters"]["mu_static"], 10.0);
    let again = json(&[&scene_file("sticky-wheel"), "--set", "mu_static=0.6"]);
    assert_eq!(story(&again), ["grip slips", "rim lost", "floor stop"]);
    let smooth = json(&[&scene_file("smooth-wheel")]);
    assert_eq!(smooth["without"], serde_json::json!(["grip"]));
    let rough = json(&[&scene_file("smooth-wheel"), "--with", "grip"]);
    assert_eq!(rough["without"], Value::Null);
}

#[test]
fn a_saved_run_runs_again() {
    let path = std::env::temp_dir().join(format!("lagrange-saved-{}.toml", std::process::id()));
    let path = path.to_str().expect("unicode");
    let arguments = [
        "mass-on-wheel",
        "--set",
        "mass=0.3",
        "--start",
        "theta=0.2",
        "--without",
        "floor",
        "--until",
        "2",
    ];
    let first = json(&[&arguments[..], &["--save", path]].concat());
    let second = json(&[path]);
    std::fs::remove_file(path).expect("it was written");
    assert_eq!(first, second);
    let smooth = says(&["run", "mass-on-wheel", "--without", "grip"]);
    assert!(smooth.starts_with("Without grip.\n"), "{smooth}");
    refuses(
        &["run", "mass-on-wheel", "--without", "gripp"],
        2,
        "did you mean `grip`?",
    );
    refuses(&["run", "nowhere.toml"], 2, "cannot read nowhere.toml");
}

/// Painlevé's rod stays with N = −b/A, or flies off; A and b are those of its declaration's documentation.
#[test]
fn feasible_modes_are_listed_with_their_forces() {
    let asked = [
        "modes",
        "painleve-rod",
        "--set",
        "mu=1.6",
        "--set",
        "rate=5",
        "--format",
        "csv",
    ];
    let said = says(&asked);
    let lines: Vec<Vec<&str>> = said.lines().map(|line| line.split(',').collect()).collect();
    let [_, stays, flies] = &lines[..] else {
        panic!("{said}")
    };
    let (sin, cos) = 1.1_f64.sin_cos();
    let (a, b) = (1.0 + 3.0 * cos * (cos - 1.6 * sin), 12.5 * sin - 9.81);
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    // The names of what the first mode does are two cells.
    assert!((number(stays[2]) + b / a).abs() < 1e-12, "{said}");
    assert_eq!(number(flies[1]), 0.0);
    assert!((number(flies[4]) + 9.81).abs() < 1e-12, "{said}");
    // 0 is the start, and what comes right after it is told in short.
    assert_eq!(says(&[&asked[..], &["--at", "0"]].concat()), said);
    let soon = says(&["modes", "mass-on-wheel", "--at", "1e-300"]);
    assert!(soon.contains("At t = 1e-300 s the motion"), "{soon}");
    refuses(
        &["modes", "mass-on-shell", "--at", "9"],
        1,
        "the run ends at t = 2.06",
    );
    refuses(
        &["modes", "mass-on-wheel", "--at", "-1"],
        2,
        "not be below 0",
    );
}
