//! A run as a table: JSON lines and Parquet say the same as CSV, in order of time, with the same names.

use crate::program::{folder, lagrange_in, says, text};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;

/// A row by column; what is missing is not there.
type Row = BTreeMap<String, Value>;

fn run(folder: &Path, arguments: &[&str]) {
    let output = lagrange_in(folder, &[&["run"], arguments].concat());
    assert_eq!(text(&output.stderr), "", "{arguments:?}");
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
}

/// Names without units.
fn csv_rows(path: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(path).expect("the table");
    let header = reader.headers().expect("a header").clone();
    let name = |column: &str| column.split(" [").next().unwrap_or(column).to_owned();
    let value = |text: &str| match text.parse::<f64>() {
        Ok(number) => Value::from(number),
        Err(_) => Value::from(text),
    };
    let row = |record: csv::StringRecord| {
        let cells = header.iter().zip(record.iter());
        let there = cells.filter(|(_, text)| !text.is_empty());
        there
            .map(|(column, text)| (name(column), value(text)))
            .collect()
    };
    reader
        .records()
        .map(|record| row(record.expect("a row")))
        .collect()
}

fn parquet_rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(File::open(path).expect("the file")).expect("Parquet");
    let value = |field: &Field| match field {
        Field::Double(number) => Some(Value::from(*number)),
        Field::Str(text) => Some(Value::from(text.as_str())),
        Field::Null => None,
        other => panic!("unexpected {other:?}"),
    };
    let rows = reader.get_row_iter(None).expect("rows");
    rows.map(|row| {
        let row = row.expect("a row");
        let cells = row.get_column_iter();
        cells
            .filter_map(|(name, field)| Some((name.clone(), value(field)?)))
            .collect()
    })
    .collect()
}

fn metadata(path: &Path) -> BTreeMap<String, Value> {
    let reader = SerializedFileReader::new(File::open(path).expect("the file")).expect("Parquet");
    let metadata = reader.metadata().file_metadata();
    let pairs = metadata.key_value_metadata().expect("metadata");
    let parsed = pairs.iter().map(|pair| {
        let text = pair.value.as_deref().unwrap_or_default();
        (pair.key.clone(), serde_json::from_str(text).expect("JSON"))
    });
    parsed.collect()
}

fn lines(path: &Path) -> Vec<Value> {
    let text = fs::read_to_string(path).expect("the lines");
    text.lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect()
}

/// Scenes with switches, impacts, friction in space, many events, none.
const SCENES: [&str; 5] = [
    "mass-on-wheel",
    "bouncing-ball",
    "five-ball-cradle",
    "turning-push",
    "kepler",
];

/// Files of all formats that have a row for each sample.
const ALL: [&str; 6] = [
    "--output",
    "run.csv",
    "--output",
    "run.parquet",
    "--output",
    "run.jsonl",
];

/// Parquet has them in groups, of which each column has levels of its own.
#[test]
fn very_many_rows_are_the_same_in_csv_and_parquet() {
    let folder = folder("very many rows");
    let long = ["bouncing-ball", "--samples", "70000"];
    let outputs = ["--output", "run.csv", "--output", "run.parquet"];
    run(&folder, &[&long[..], &outputs].concat());
    let table = csv_rows(&folder.join("run.csv"));
    assert!(table.len() > 70_000);
    // Not `assert_eq!`, which would print them.
    assert!(table == parquet_rows(&folder.join("run.parquet")));
}

#[test]
fn every_format_says_the_same() {
    let folder = folder("formats");
    for scene in SCENES {
        let arguments = [scene, "--samples", "50", "--ledger"];
        run(&folder, &[&arguments[..], &ALL].concat());
        let table = csv_rows(&folder.join("run.csv"));
        assert_eq!(table, parquet_rows(&folder.join("run.parquet")), "{scene}");
        let lines = lines(&folder.join("run.jsonl"));
        let of = |kind: &str| lines.iter().filter(|line| line["type"] == kind).count();
        let events = table.iter().filter(|row| row.contains_key("event")).count();
        assert_eq!((of("header"), of("end")), (1, 1), "{scene}");
        assert_eq!(2 * of("event"), events, "{scene}");
        assert_eq!(of("sample") + events, table.len(), "{scene}");
        let samples = lines.iter().filter(|line| line["type"] == "sample");
        let rows = table.iter().filter(|row| !row.contains_key("event"));
        for (sample, row) in samples.zip(rows) {
            assert!(
                row.iter().all(|(name, value)| sample[name] == *value),
                "{scene}"
            );
        }
        // Between events at one instant they are not known.
        let known = |row: &&Row| row.contains_key("kinetic") && row.contains_key("potential");
        let missing = table.iter().filter(|row| !known(row)).count();
        let most = [("five-ball-cradle", 6), ("bouncing-ball", 2)];
        let most = most.iter().find(|(name, _)| *name == scene);
        assert!(
            missing <= most.map_or(0, |(_, most)| *most),
            "{scene}: {missing}"
        );
        let times = lines.iter().filter_map(|line| line["t"].as_f64());
        assert!(times.is_sorted(), "{scene}");
    }
}

/// What is observed stands in JSON as in the table.
#[test]
fn json_has_what_is_observed() {
    let folder = folder("observed");
    let outputs = ["--output", "run.csv", "--output", "run.json"];
    run(&folder, &[&["mass-on-wheel"], &outputs[..]].concat());
    let table = csv_rows(&folder.join("run.csv"));
    let text = fs::read_to_string(folder.join("run.json")).expect("the run");
    let run: Value = serde_json::from_str(&text).expect("JSON");
    let events = run["events"].as_array().expect("events");
    assert_eq!(events.len(), 3);
    let switches: Vec<&Row> = table
        .iter()
        .filter(|row| row.contains_key("event"))
        .collect();
    for name in ["px", "py"] {
        assert_eq!(run["start"]["outputs"][name], table[0][name]);
        // The run ends with a stop.
        assert_eq!(run["final"]["outputs"][name], table[table.len() - 1][name]);
        let sides = ["outputs", "outputs_after"];
        let told = events
            .iter()
            .flat_map(|event| sides.map(|side| &event[side][name]));
        assert!(told.eq(switches.iter().map(|row| &row[name])), "{name}");
    }
}

#[test]
fn energies_are_known_at_switches_and_the_modes_are_in_order() {
    let folder = folder("switches");
    run(&folder, &["mass-on-wheel", "--output", "run.parquet"]);
    let table = parquet_rows(&folder.join("run.parquet"));
    assert!(
        table
            .iter()
            .all(|row| row.contains_key("kinetic") && row.contains_key("px"))
    );
    let mut modes: Vec<&str> = table
        .iter()
        .filter_map(|row| row["mode"].as_str())
        .collect();
    modes.dedup();
    assert_eq!(
        modes,
        [
            "rim closed, grip sticks",
            "rim closed, grip slips forward",
            "rim open"
        ]
    );
    // In free flight energy is conserved; what is lost before is the work of friction.
    let energy = |row: &Row| row["kinetic"].as_f64().zip(row["potential"].as_f64());
    let energy = |row: &Row| energy(row).map_or(f64::NAN, |(t, v)| t + v);
    let flight: Vec<f64> = table
        .iter()
        .filter(|row| row["mode"] == "rim open")
        .map(energy)
        .collect();
    assert!(flight.len() > 10 && flight.iter().all(|e| (e - flight[0]).abs() < 1e-9));
}

/// A block that is thrown lands without a rebound, and at this instant it is marked that it lies there: m u²/2 and m g h are left of its energy.
#[test]
fn energies_are_known_at_a_mark_that_a_switch_makes_true() {
    let folder = folder("marked switch");
    let file = "thrown.lagrange";
    let declared = "parameters(m = 1.5, g = 9.8, height = 0.4, u = 2), coordinates(x, y), \
        kinetic = m/2 * (der(x)^2 + der(y)^2), potential = m*g*y, contact(floor: y >= height), \
        mark(lies: closed(floor) and floor >= m*g/2), start(thrown: y = height + 1, der(x) = u), until = 1,";
    fs::write(folder.join(file), declared).expect("a file");
    run(&folder, &[file, "--output", "run.csv"]);
    let table = csv_rows(&folder.join("run.csv"));
    let marked = ["lies mark", "lies mark (after)"];
    for name in marked {
        let mut rows = table
            .iter()
            .filter(|row| row.get("event").is_some_and(|event| event == name));
        let row = rows.next().expect(name);
        for (energy, value) in [("kinetic", 3.0), ("potential", 5.88)] {
            let told = row.get(energy).and_then(Value::as_f64).expect(energy);
            assert!((told - value).abs() < 1e-12, "{name}: {energy} {told}");
        }
    }
}

#[test]
fn a_parquet_file_says_what_was_run() {
    let folder = folder("metadata");
    let arguments = [
        "mass-on-wheel",
        "--set",
        "mu_static=2",
        "--tolerance",
        "1e-10",
        "--without",
        "floor",
    ];
    run(
        &folder,
        &[&arguments[..], &["--until", "1", "--output", "run.parquet"]].concat(),
    );
    let metadata = metadata(&folder.join("run.parquet"));
    let keys: Vec<&str> = metadata.keys().map(String::as_str).collect();
    assert_eq!(keys, ["PANDAS_ATTRS", "lagrange"]);
    assert_eq!(metadata["PANDAS_ATTRS"], metadata["lagrange"]);
    let what = &metadata["lagrange"];
    assert_eq!(what["scene"], "mass-on-wheel");
    assert_eq!(what["parameters"]["mu_static"], 2.0);
    assert_eq!(what["units"]["der(theta)"], "rad/s");
    assert_eq!(what["without"], serde_json::json!(["floor"]));
    assert_eq!(
        (&what["method"], &what["tolerance"]),
        (&Value::from("auto"), &Value::from(1e-10))
    );
    assert_eq!(what["version"], env!("CARGO_PKG_VERSION"));
}

/// Also of a coordinate that is observed.
#[test]
fn a_unit_is_told_once() {
    let folder = folder("outputs-units");
    let file = "slide.lagrange";
    let declared = "parameters(m: \"kg\" = 1), coordinates(x: \"m\"), kinetic = m/2 * der(x)^2, observe(x), until = 1,";
    fs::write(folder.join(file), declared).expect("a file");
    let output = lagrange_in(&folder, &["run", file, "--format", "json"]);
    let said = text(&output.stdout);
    assert_eq!(said.matches("\"x\": \"m\"").count(), 1, "{said}");
}

#[test]
fn samples_are_as_many_as_asked_for() {
    let table = says(&[
        "run",
        "double-pendulum",
        "--samples",
        "1000",
        "--format",
        "csv",
    ]);
    assert_eq!(table.lines().count(), 1 + 1001);
    let table = says(&[
        "run",
        "double-pendulum",
        "--samples",
        "1",
        "--format",
        "csv",
    ]);
    assert_eq!(table.lines().count(), 1 + 2);
}

#[test]
fn a_dash_is_stdout() {
    let folder = folder("dash");
    let output = lagrange_in(
        &folder,
        &["run", "kepler", "--output", "-", "--output", "run.json"],
    );
    assert_eq!(text(&output.stdout), says(&["run", "kepler"]));
    assert!(folder.join("run.json").exists());
    let output = lagrange_in(
        &folder,
        &["run", "kepler", "--output", "-", "--format", "parquet"],
    );
    assert!(output.stdout.starts_with(b"PAR1") && output.stdout.ends_with(b"PAR1"));
}

#[test]
fn every_command_has_stdout_for_a_dash_and_no_other_ending_than_its_own() {
    let folder = folder("outputs-dash");
    let file = "pendulum.lagrange";
    fs::write(folder.join(file), lagrange_program::file::TEMPLATE).expect("a file");
    let said = |arguments: &[&str]| lagrange_in(&folder, arguments);
    for command in [
        &["verify", file][..],
        &["modes", file],
        &["export", file],
        &["inspect", file],
    ] {
        let printed = said(command);
        let dashed = said(&[command, &["--output", "-"]].concat());
        assert!(!printed.stdout.is_empty(), "{command:?}");
        assert_eq!(text(&dashed.stdout), text(&printed.stdout), "{command:?}");
    }
    for command in [
        &["verify", file][..],
        &["modes", file],
        &["accuracy", file],
        &["effects", file],
        &["stability"],
    ] {
        let refused = said(&[command, &["--output", "a.parquet"]].concat());
        let reason = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{command:?}: {reason}");
        let told = "the name a.parquet says no format: let it end in .csv, .json or .txt, or give --format";
        assert!(reason.contains(told), "{command:?}: {reason}");
    }
    let report = |format: &str| said(&["report", file, "--output", "-", "--format", format]);
    assert!(text(&report("html").stdout).trim_end().ends_with("</html>"));
    assert!(text(&report("svg").stdout).ends_with("</svg>\n"));
    let refused = report("gif");
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("name a file for pixels"));
    // In main.rs there would be nothing beside it that declares it.
    let refused = said(&["export", file, "--output", "main.rs"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("choose another name, as --output system.rs"));
    let refused = said(&["export", file, "--output", "system.py"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("let it end in .rs"));
    let there = fs::read_dir(&folder).expect("the folder").count();
    assert_eq!(there, 1, "nothing but the declaration");
}

#[test]
fn a_scene_file_says_where_everything_goes() {
    let folder = folder("outputs-of-a-file");
    let text = "scene = \"mass-on-wheel\"\nend_after = \"grip slips\"\n[outputs]\noutput = [\"a.csv\", \"a.parquet\"]\n\
                plot = \"a.svg\"\nsamples = 10\nledger = true\n";
    fs::write(folder.join("a.toml"), text).expect("a file");
    run(&folder, &["a.toml", "--save", "b.toml"]);
    let table = csv_rows(&folder.join("a.csv"));
    let last = table.last().expect("rows");
    assert_eq!(last["event"], "grip slips (after)");
    assert!(
        last.contains_key("work(grip)") && table.len() == 12,
        "{}",
        table.len()
    );
    assert!(folder.join("a.svg").exists() && folder.join("a.parquet").exists());
    // What was saved does the same again.
    let before = fs::read(folder.join("a.parquet")).expect("the file");
    for name in ["a.csv", "a.parquet", "a.svg"] {
        fs::remove_file(folder.join(name)).expect("it is there");
    }
    run(&folder, &["b.toml"]);
    assert_eq!(
        before,
        fs::read(folder.join("a.parquet")).expect("the file")
    );
    assert!(folder.join("a.svg").exists());
    // The command line has the last word.
    fs::remove_file(folder.join("a.csv")).expect("it is there");
    run(&folder, &["b.toml", "--output", "c.jsonl"]);
    assert!(folder.join("c.jsonl").exists() && !folder.join("a.csv").exists());
}

/// Outputs may be called as coordinates and energies are; columns have one name each, and keep their numbers.
#[test]
fn no_two_columns_have_one_name() {
    let folder = folder("columns");
    let declared = "coordinates(x), kinetic = der(x)^2/2, potential = 2*x^2, start(s: x = 1), until = 1,\n\
                    observe(x, kinetic = 7*x, mode = 3*x, far = 2*x)\n";
    fs::write(folder.join("same.lagrange"), declared).expect("a file");
    run(
        &folder,
        &[&["same.lagrange", "--samples", "5"], &ALL[..]].concat(),
    );
    let text = fs::read_to_string(folder.join("run.csv")).expect("the table");
    let header: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    for (i, column) in header.iter().enumerate() {
        assert!(!header[..i].contains(column), "{header:?}");
    }
    let table = csv_rows(&folder.join("run.csv"));
    assert!(table == parquet_rows(&folder.join("run.parquet")));
    let number = |row: &Row, name: &str| row[name].as_f64().expect("a number");
    let lines = lines(&folder.join("run.jsonl"));
    let samples = lines.iter().filter(|line| line["type"] == "sample");
    let rows = table.iter().filter(|row| !row.contains_key("event"));
    let mut compared = 0;
    for (sample, row) in samples.zip(rows) {
        compared += 1;
        let x = number(row, "x");
        assert_eq!(number(row, "output(x)"), x);
        assert_eq!(number(row, "output(kinetic)"), 7.0 * x);
        assert_eq!(number(row, "output(mode)"), 3.0 * x);
        assert_eq!(number(row, "far"), 2.0 * x);
        assert_eq!(sample["output(kinetic)"].as_f64(), Some(7.0 * x));
        assert_eq!(sample["x"].as_f64(), Some(x));
    }
    assert!(compared > 3);
}

/// A run that ends by what happens at its start has both ends, in the mode in which it would go on: the brake holds 1 N of 3 N, and the motion would
/// begin.
#[test]
fn a_run_that_ends_at_its_start_has_a_start_and_an_end() {
    let folder = folder("ends_at_start");
    let pulled = |slip: &str| {
        format!(
            "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2)/2, force(pull: x = 3), friction(brake: slip = {slip}, limit = 1), \
             start(held), until = 1"
        )
    };
    for (slip, force) in [("der(x)", "brake"), ("(der(x), der(y))", "brake[0]")] {
        fs::write(folder.join("pulled.lagrange"), pulled(slip)).expect("a file");
        let arguments = [
            "run",
            "pulled.lagrange",
            "--end-after",
            "brake slips",
            "--format",
            "json",
        ];
        let output = lagrange_in(&folder, &arguments);
        let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(told["events"].as_array().map(Vec::len), Some(1));
        for end in ["start", "final"] {
            assert_eq!(told[end]["time"], 0.0, "{slip}");
            assert_eq!(told[end]["mode"], told["events"][0]["to"], "{slip}");
            assert_eq!(told[end]["forces"][force], -1.0, "{slip}");
        }
    }
}

/// A run that ends after a switch ends in what that leads to: a rope that has gone taut pulls.
#[test]
fn a_run_that_ends_after_a_switch_ends_in_the_mode_after_it() {
    let folder = folder("ends_after_a_switch");
    // The mass falls half a metre until the rope drags the drum along: with the inertia J/R² of that it falls on, and the rope pulls by what is left
    // of its weight, m g J/R²/(m + J/R²).
    let drum = "parameters(m = 5, J = 0.4, R = 0.2), coordinates(y, turn), kinetic = m/2*der(y)^2 + J/2*der(turn)^2, \
                potential = -m*9.81*y, contact(rope: y - R*turn <= 0.5), start(drop), until = 1";
    fs::write(folder.join("drum.lagrange"), drum).expect("a file");
    let (drags, weight) = (0.4 / 0.04, 5.0 * 9.81);
    let pull = weight * drags / (5.0 + drags);
    for after in ["rope impact", "rope closed"] {
        let arguments = [
            "run",
            "drum.lagrange",
            "--end-after",
            after,
            "--format",
            "json",
        ];
        let output = lagrange_in(&folder, &arguments);
        let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(told["final"]["mode"], "rope closed", "{after}");
        let force = told["final"]["forces"]["rope"].as_f64().expect("a force");
        assert!(
            (force - pull).abs() < 1e-9,
            "{after}: {force} N, not {pull} N"
        );
    }
}
