//! Sweeps as a user runs them.

use crate::program::{folder, lagrange, path, refuses, says, sweep, text};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;

/// A file of this name in a folder of its own.
fn place(name: &str) -> PathBuf {
    folder(&format!("sweep-{name}")).join(name)
}

#[test]
fn results_do_not_depend_on_workers() {
    let [alone, all] = ["alone.csv", "all.csv"].map(place);
    says(&sweep(&["--output", path(&alone), "--workers", "1"]));
    says(&sweep(&["--output", path(&all)]));
    let expected = fs::read(&alone).expect("results");
    assert_eq!(fs::read(&all).expect("results"), expected);
    let text = String::from_utf8(expected).expect("text");
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("mu_static,theta,leave angle,t at grip slips,failure")
    );
    assert_eq!(lines.count(), 9000);
    // Cosine of the angle at which it leaves: rolling all the way, 10/17 of that at the start. Slipping it leaves a little earlier
    // or later, but leaves.
    let far = text.lines().last().expect("a line");
    let numbers: Vec<f64> = far
        .split(',')
        .take(3)
        .map(|x| x.parse().expect("a number"))
        .collect();
    assert!(
        (numbers[2].cos() - 10.0 / 17.0 * 0.4_f64.cos()).abs() < 0.05,
        "{far}"
    );
}

/// What falls from rest through h strikes with √(2 g h); the impulse is m (1 + e) times that.
#[test]
fn impulses_are_observed() {
    let folder = folder("sweep-impulses");
    let [declared, results] = ["ball.lagrange", "impulses.csv"].map(|name| folder.join(name));
    let text = "parameters(m = 3, g = 2, e = 0), coordinates(y), kinetic = m/2 * der(y)^2, potential = m * g * y,
        contact(floor: y >= 0, restitution = e), start(up: y = 1),";
    fs::write(&declared, text).expect("a file");
    says(&[
        "sweep",
        path(&declared),
        "--vary",
        "e=0..1:2",
        "--observe",
        "impulse floor at floor impact",
        "--quiet",
        "--output",
        path(&results),
    ]);
    let table = fs::read_to_string(&results).expect("results");
    let lines = table.lines().skip(1);
    let found: Vec<f64> = lines
        .filter_map(|line| line.split(',').nth(1)?.parse().ok())
        .collect();
    assert!((found[0] - 6.0).abs() < 1e-12, "{table}");
    assert!((found[1] - 12.0).abs() < 1e-12, "{table}");
}

#[test]
fn what_is_observed_is_what_a_single_run_tells() {
    let file = place("single.csv");
    says(&[
        "sweep",
        "mass-on-wheel",
        "--vary",
        "mass=0.1..0.3:3",
        "--observe",
        "theta at grip slips",
        "--observe",
        "rim at floor stop",
        "--observe",
        "x",
        "--observe",
        "count rim lost",
        "--observe",
        "t at rim impact",
        "--quiet",
        "--output",
        path(&file),
    ]);
    let text = fs::read_to_string(&file).expect("results");
    let line = text.lines().nth(2).expect("the second run");
    let cells: Vec<&str> = line.split(',').collect();
    let run = says(&[
        "run",
        "mass-on-wheel",
        "--set",
        "mass=0.2",
        "--format",
        "json",
    ]);
    let run: serde_json::Value = serde_json::from_str(&run).expect("JSON");
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    assert_eq!(number(cells[1]), run["events"][0]["state"]["theta"]);
    assert_eq!(number(cells[2]), run["events"][2]["forces"]["rim"]);
    assert_eq!(number(cells[3]), run["final"]["state"]["x"]);
    assert_eq!((number(cells[4]), cells[5], cells[6]), (1.0, "", ""));
}

/// What no event has: forces, outputs and energies at the end, outputs before an event. A start that is varied and the same
/// coordinate at the end are two columns.
#[test]
fn forces_and_outputs_are_observed_at_the_end_and_at_events() {
    let observed = [
        "rim",
        "px",
        "energy",
        "phi",
        "py at rim lost",
        "kinetic at rim lost",
    ];
    let observe: Vec<&str> = observed.iter().flat_map(|o| ["--observe", o]).collect();
    let scene = ["sweep", "mass-on-wheel", "--vary", "phi=0.1..0.3:3"];
    let told = ["--format", "csv", "--quiet"];
    // Before the mass slips it is at rest on the rim; until 2.6 s it has not left.
    for until in ["2", "10"] {
        let arguments = [&scene[..], &observe, &told, &["--until", until]].concat();
        let said = says(&arguments);
        let mut lines = said.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let head = lines.next().expect("a header");
        assert!(head[4].starts_with("phi at the end"), "{head:?}");
        let cells = lines.nth(1).expect("the second run");
        let run = ["run", "mass-on-wheel", "--start", "phi=0.2", "--until"];
        let rows = says(&[&run[..], &[until, "--format", "csv"]].concat());
        let mut rows = rows.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = rows.next().expect("a header");
        let rows: Vec<_> = rows.collect();
        let number = |row: Option<&Vec<&str>>, name: &str| {
            let column = names.iter().position(|n| n.split(' ').next() == Some(name));
            let column = column.unwrap_or_else(|| panic!("no column {name}"));
            row.map_or(f64::NAN, |row| row[column].parse().expect("a number"))
        };
        let lost = rows.iter().find(|row| row[1] == "rim lost");
        let end = rows.last();
        let sum = |row, a, b| number(row, a) + number(row, b);
        let expected = [
            number(end, "force(rim)"),
            number(end, "px"),
            sum(end, "kinetic", "potential"),
            number(end, "phi"),
            number(lost, "py"),
            number(lost, "kinetic"),
        ];
        for ((cell, expected), name) in cells[1..].iter().zip(expected).zip(observed) {
            let found = cell.parse().unwrap_or(f64::NAN);
            let same = (found - expected).abs() <= 1e-12 * (1.0 + expected.abs());
            assert!(
                same || found.is_nan() && expected.is_nan(),
                "{name}: {found} {expected}"
            );
        }
    }
}

#[test]
fn failures_are_told_by_reason_and_place() {
    let said = says(&sweep(&[]));
    // A coefficient at rest below that of sliding is not a law of friction.
    let told = "9000 runs of rolling-slipping-sphere, of which 1200 failed.\n  domain: 1200, the first at mu_static = 0.2, theta = 0.01\n";
    // The message is that of the run itself.
    let run = [
        "run",
        "rolling-slipping-sphere",
        "--quiet",
        "--set",
        "mu_static=0.2",
        "--start",
        "theta=0.01",
    ];
    let run = crate::program::lagrange(&run);
    let message = crate::program::text(&run.stderr);
    let message = message.trim_start_matches("lagrange: ").trim_end();
    assert!(message.contains("kinetic friction = 0.3"), "{message}");
    assert!(said.ends_with(&format!("{told}    {message}\n")), "{said}");
    let said = says(&sweep(&["--format", "json"]));
    let value: serde_json::Value = serde_json::from_str(&said).expect("JSON");
    assert_eq!(value["failures"][0]["reason"], "domain");
    assert_eq!(value["failures"][0]["message"], message);
    assert_eq!(value["failures"][0]["first_at"]["mu_static"], 0.2);
    assert_eq!(value["observed"][0]["runs"], 7800);
    let said = says(&sweep(&["--format", "csv"]));
    assert_eq!(
        said.lines()
            .filter(|line| line.ends_with(",domain"))
            .count(),
        1200
    );
    // If every run fails, so does the sweep.
    let scene = ["sweep", "rolling-slipping-sphere", "--quiet"];
    let failing = ["--vary", "mu_static=0.1..0.2:5", "--observe", "leave angle"];
    let output = crate::program::lagrange(&[&scene[..], &failing].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(crate::program::text(&output.stdout).contains("5 failed"));
    assert!(crate::program::text(&output.stderr).contains("every run failed"));
}

#[test]
fn a_summary_is_that_of_the_lines() {
    let said = says(&[
        "sweep",
        "kepler",
        "--vary",
        "x=1..2:11",
        "--observe",
        "x",
        "--until",
        "1e-12",
        "--format",
        "json",
        "--quiet",
    ]);
    let value: serde_json::Value = serde_json::from_str(&said).expect("JSON");
    let column = &value["observed"][0];
    let near = |key: &serde_json::Value, expected: f64| {
        let number = key.as_f64().expect("a number");
        assert!((number - expected).abs() < 1e-9, "{number} {expected}");
    };
    near(&column["mean"], 1.5);
    near(&column["deviation"], 0.1 * 10_f64.sqrt());
    near(&column["quantiles"]["0.25"], 1.25);
    near(&column["quantiles"]["0.95"], 1.95);
    near(&column["least"], 1.0);
    near(&column["greatest_at"]["x"], 2.0);
}

#[test]
fn pictures_have_units_and_do_not_grow() {
    let draw = |more: &[&str]| {
        let file = place("picture.svg");
        let scene = [
            "sweep",
            "rolling-slipping-sphere",
            "--quiet",
            "--plot",
            path(&file),
        ];
        says(&[&scene[..], more].concat());
        let text = fs::read_to_string(&file).expect("a picture");
        assert!(text.len() < 300_000, "{more:?}: {}", text.len());
        text
    };
    let leave = ["--observe", "leave angle"];
    let [mu, theta] = ["mu_static=0.2..1:20", "theta=0.01..0.4:30"];
    let map = draw(&[&leave[..], &["--vary", mu, "--vary", theta]].concat());
    for words in [
        "θ [rad]",
        "μₛ",
        "leave angle [rad]",
        "failed",
        "url(#failed)",
    ] {
        assert!(map.contains(words), "{words}");
    }
    let mean = draw(
        &[
            &leave[..],
            &["--vary", mu, "--vary", theta, "--vary", "mass=1..2:2"],
        ]
        .concat(),
    );
    assert!(mean.contains("mean over mass"));
    let curve = [
        "--vary",
        "mu_static=0.3..1:5000",
        "--observe",
        "t at grip slips",
    ];
    assert!(draw(&[&leave[..], &curve].concat()).contains("t at grip slips [s]"));
    // A panel for each unit: two angles share one, whose axis has their unit.
    let units = ["theta", "leave angle", "count grip slips", "t"].map(|name| ["--observe", name]);
    for vary in [
        &["--vary", "mu_static=0.3..1:9"][..],
        &["--vary", "mu_static=0.3..1", "--sample", "lhs:9"],
    ] {
        let curves = draw(&[&units.concat()[..], vary].concat());
        let heights = |words: &str| -> Vec<f64> {
            let texts = curves
                .split("<text ")
                .filter(|text| text.contains(&format!("\n{words}\n")));
            let place = |text: &str| text.split_once("y=\"")?.1.split_once('"')?.0.parse().ok();
            texts.filter_map(place).collect()
        };
        let over = heights("μₛ");
        assert_eq!(over.len(), 3, "{curves}");
        for (words, panel) in [
            ("rad", 0),
            ("θ [rad]", 0),
            ("leave angle [rad]", 0),
            ("count grip slips", 1),
            ("t [s]", 2),
        ] {
            let [height] = heights(words)[..] else {
                panic!("{words}: {curves}")
            };
            let above = over.iter().filter(|below| **below < height).count();
            assert_eq!(above, panel, "{words}");
        }
    }
    let sample = [
        "--vary",
        "mu_static=0.3..1",
        "--vary",
        "theta=0.01..0.4",
        "--sample",
        "lhs:6000",
    ];
    assert!(draw(&[&leave[..], &sample].concat()).contains("the first 5000 of 6000 points"));
}

#[test]
fn sweeps_without_sense_are_refused_in_one_line() {
    let of_wheel = |more: &[&'static str], reason: &str| {
        refuses(
            &[&["sweep", "mass-on-wheel", "--quiet"], more].concat(),
            2,
            reason,
        );
    };
    of_wheel(&["--observe", "x"], "--vary");
    of_wheel(&["--vary", "mass=1..2:3"], "--observe");
    of_wheel(
        &["--vary", "mass=1..2:0", "--observe", "x"],
        "not a number of values",
    );
    of_wheel(
        &["--vary", "masss=1..2:3", "--observe", "x"],
        "did you mean `mass`?",
    );
    of_wheel(
        &[
            "--vary",
            "mass=1..2:3",
            "--vary",
            "mass=1..2:3",
            "--observe",
            "x",
        ],
        "given twice",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--set", "mass=1", "--observe", "x"],
        "given twice",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "y"],
        "no coordinate, velocity, force or output is called `y`",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "x", "--observe", "x"],
        "given twice",
    );
    of_wheel(
        &["--vary", "mass=1..2", "--observe", "x"],
        "--vary mass=1..2: how many values?",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "x", "--estimate"],
        "no place for estimates",
    );
    of_wheel(
        &[
            "--vary",
            "mass=1..2:3",
            "--observe",
            "t at rim lost",
            "--without",
            "rim",
        ],
        "`t at rim lost`: `rim` is left out, and its events with it",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "theta at rim loss"],
        "did you mean `rim lost`?",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "theta at rimm lost"],
        "did you mean `rim`?",
    );
    of_wheel(
        &[
            "--vary",
            "mass=1..2:3",
            "--observe",
            "x",
            "--sample",
            "sobol",
        ],
        "sobol:N",
    );
    of_wheel(
        &["--vary", "mass=1..2:3", "--observe", "x", "--shard", "1/2"],
        "--output",
    );
    of_wheel(
        &[
            "--vary",
            "mass=1..2:3",
            "--observe",
            "x",
            "--output",
            "x.json",
        ],
        "name it",
    );
}

#[test]
#[cfg(not(feature = "mpi"))]
fn without_mpi_many_processes_do_not_all_do_the_same() {
    let many = |rank: &str, more: &[&'static str]| {
        std::process::Command::new(env!("CARGO_BIN_EXE_lagrange"))
            .args(sweep(more))
            .envs([
                ("OMPI_COMM_WORLD_RANK", rank),
                ("OMPI_COMM_WORLD_SIZE", "64"),
            ])
            .output()
            .expect("it starts")
    };
    let first = many("0", &[]);
    assert_eq!(first.status.code(), Some(2));
    let said = crate::program::text(&first.stderr);
    assert!(said.contains("built without MPI"), "{said}");
    // One says it for all.
    let other = many("7", &[]);
    assert_eq!(
        (other.status.code(), crate::program::text(&other.stderr)),
        (Some(2), "")
    );
    // With parts of its own each is on its own.
    let file = place("many.csv");
    let output = ["--output", path(&file)].map(|word| word.to_owned().leak() as &str);
    let part = many("7", &[output[0], output[1], "--shard", "8/64"]);
    assert_eq!(part.status.code(), Some(0));
}

/// The sequences of a grid are those that single runs tell.
#[test]
fn modes_are_the_switches_of_the_runs() {
    let file = place("modes.csv");
    let picture = place("modes.svg");
    let [mu, mass] = ["mu_static=0.6..1.2:4", "mass=0.1..4:3"];
    let axes = [
        "sweep",
        "mass-on-wheel",
        "--quiet",
        "--vary",
        mu,
        "--vary",
        mass,
    ];
    let said = says(
        &[
            &axes[..],
            &[
                "--observe",
                "modes",
                "--output",
                path(&file),
                "--plot",
                path(&picture),
            ],
        ]
        .concat(),
    );
    let table = fs::read_to_string(&file).expect("a table");
    let mut sequences: Vec<String> = Vec::new();
    let mut lines = csv::Reader::from_reader(table.as_bytes());
    for line in lines.records() {
        let line = line.expect("a line");
        let set = [
            format!("mu_static={}", &line[0]),
            format!("mass={}", &line[1]),
        ];
        let run = says(&[
            "run",
            "mass-on-wheel",
            "--set",
            &set[0],
            "--set",
            &set[1],
            "--format",
            "json",
        ]);
        let run: Value = serde_json::from_str(&run).expect("JSON");
        let events = run["events"].as_array().expect("events").iter();
        let word = |event: &Value, key: &str| event[key].as_str().expect("a word").to_owned();
        let mut events: Vec<String> = events
            .map(|event| [word(event, "item"), word(event, "kind")].join(" "))
            .collect();
        events.dedup();
        assert_eq!(line[2], events.join(", "), "{set:?}");
        let told = events.join(" → ");
        assert!(said.contains(&told), "{told}");
        if !sequences.contains(&told) {
            sequences.push(told);
        }
    }
    let drawn = fs::read_to_string(&picture).expect("a picture");
    assert!(sequences.len() > 1, "{sequences:?}");
    for told in sequences {
        assert!(drawn.contains(&told), "{told}");
    }
    // The same sequences draw lines into the map of something else.
    let lines = [
        &axes[..],
        &[
            "--observe",
            "t",
            "--observe",
            "modes",
            "--plot",
            path(&picture),
        ],
    ]
    .concat();
    says(&lines);
    let drawn = fs::read_to_string(&picture).expect("a picture");
    assert!(
        drawn.contains("lines: other modes")
            && drawn.contains("stroke=\"#000000\" stroke-width=\"10\" stroke-linecap=\"square\"")
    );
    refuses(
        &[
            "sweep",
            "mass-on-wheel",
            "--vary",
            mu,
            "--observe",
            "modes",
            "--plot",
            path(&picture),
        ],
        2,
        "over two axes",
    );
}

#[test]
fn what_never_happens_and_what_has_no_room_is_said() {
    let said = says(&[
        "sweep",
        "mass-on-wheel",
        "--quiet",
        "--vary",
        "mu_static=0.5..1:2",
        "--observe",
        "t at rim impact",
    ]);
    assert!(said.contains("t at rim impact: no run has it"), "{said}");
    let grid = |x: &str, y: &str, more: &[&str], reason: &str| {
        let fixed = [
            "sweep",
            "mass-on-wheel",
            "--vary",
            x,
            "--vary",
            y,
            "--observe",
            "t",
        ];
        let output = lagrange(&[&fixed[..], more].concat());
        let told = text(&output.stderr);
        assert_ne!(output.status.code(), Some(0));
        assert!(told.contains(reason) && told.lines().count() == 1, "{told}");
    };
    grid(
        "mass=1..2:1e7",
        "radius=1..2:1e7",
        &[],
        "1e14 points are too many: their results would take 1.6e15 bytes",
    );
    grid(
        "mass=1..2:1e11",
        "radius=1..2:1e11",
        &[],
        "1e22 points are too many",
    );
    grid(
        "mass=1..2:1e4",
        "radius=1..2:1e5",
        &[],
        "the results take 1.6e10 bytes, too many for memory; keep them in a file with --output",
    );
}

/// What a scene file gives is varied instead of that; the other numbers stay.
#[test]
fn the_command_line_has_the_last_word_over_a_scene_file() {
    let folder = folder("sweep-scene-file");
    let file = folder.join("wheel.toml");
    let given =
        "scene = \"mass-on-wheel\"\n[parameters]\nmass = 7\nmu_static = 2\n[start]\ntheta = 0.3\n";
    fs::write(&file, given).expect("a file");
    let vary = ["--vary", "mass=1..2:3", "--vary", "theta=0.1..0.2:2"];
    let read = ["--observe", "t at grip slips", "--format", "csv"];
    let of_file = says(&[&["sweep", path(&file)], &vary[..], &read].concat());
    let set = ["sweep", "mass-on-wheel", "--set", "mu_static=2"];
    assert_eq!(of_file, says(&[&set, &vary[..], &read].concat()));
    let twice = ["sweep", path(&file), "--set", "mass=1"];
    refuses(
        &[&twice, &vary[..], &read].concat(),
        2,
        "`mass` is given twice",
    );
}
