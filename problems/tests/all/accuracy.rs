//! `lagrange accuracy` as a user meets it: the table, the answer, the files, and what is refused.

use crate::program::{lagrange, refuses, says, text};
use serde_json::Value;

fn accuracy(scene: &str, arguments: &[&str]) -> Vec<String> {
    let all = ["accuracy", scene, "--repeat", "1"];
    let all = all.iter().chain(arguments);
    all.map(|argument| (*argument).to_owned()).collect()
}

fn table(scene: &str, arguments: &[&str]) -> String {
    let all = accuracy(scene, arguments);
    says(&all.iter().map(String::as_str).collect::<Vec<_>>())
}

fn json(scene: &str, arguments: &[&str]) -> Value {
    let all = [arguments, &["--format", "json"]].concat();
    serde_json::from_str(&table(scene, &all)).expect("output is JSON")
}

fn rows(report: &Value) -> &Vec<Value> {
    report["rows"].as_array().expect("rows is a list")
}

fn number(row: &Value, key: &str) -> f64 {
    row[key]
        .as_f64()
        .unwrap_or_else(|| panic!("no {key} in {row}"))
}

#[test]
fn errors_follow_the_tolerance_and_something_is_fastest() {
    let report = json(
        "mass-on-wheel",
        &[
            "--methods",
            "taylor,verner98",
            "--tolerances",
            "1e-4,1e-8,1e-12",
        ],
    );
    // By another method than that of the reference, as tight as it gets.
    let checked_by = report["reference"]["checked_by"].as_str();
    let checked_by = checked_by.unwrap_or_default();
    assert!(checked_by.ends_with(" at 1e-15") && !checked_by.starts_with("taylor"));
    let floor = number(&report["reference"], "floor");
    assert!(floor < 1e-14, "{floor:e}");
    let rows = rows(&report);
    assert_eq!(rows.len(), 6);
    for row in rows {
        let (tolerance, error) = (number(row, "tolerance"), number(row, "error"));
        assert!(error < 30.0 * tolerance, "{row}");
        assert_eq!(
            error,
            number(row, "state_error").max(number(row, "event_error"))
        );
        assert!(number(row, "energy_drift") < 30.0 * tolerance, "{row}");
        assert!(number(row, "constraint_drift") < 1e-12, "{row}");
        assert!(number(row, "time") > 0.0 && number(row, "ratio") >= 1.0);
        assert!(row["steps"].as_u64() > Some(0) && row["series"].as_u64() > Some(0));
    }
    assert!(rows.iter().any(|row| number(row, "ratio") == 1.0));
}

#[test]
fn events_are_compared_by_name_and_time() {
    let report = json(
        "mass-on-shell",
        &["--methods", "dop853", "--tolerances", "1e-10"],
    );
    let events = &report["reference"]["events"];
    assert_eq!(events[0]["event"], "shell lost");
    assert_eq!(events[1]["event"], "floor stop");
    // 32 digits by quadrature of the closed form, for R = 1, g = 9.81, θ₀ = 0.01.
    let left = number(&events[0], "time") - 1.641_132_327_593_929_8;
    let landed = number(&events[1], "time") - 2.061_265_815_602_948_4;
    assert!(
        left.abs() < 1e-15 && landed.abs() < 1e-15,
        "{left:e}, {landed:e}"
    );
    assert!(number(&report["reference"], "difference") < 4e-15);
}

#[test]
fn without_events_or_constraints_there_is_nothing_to_say_of_them() {
    let report = json(
        "double-pendulum",
        &[
            "--methods",
            "taylor",
            "--tolerances",
            "1e-9",
            "--until",
            "1",
        ],
    );
    let row = &rows(&report)[0];
    assert!(row["event_error"].is_null() && row["constraint_drift"].is_null());
    assert_eq!(report["reference"]["time"], 1.0);
}

#[test]
fn fixed_steps_follow_the_tolerance_or_the_user() {
    let report = json(
        "rolling-sphere",
        &["--methods", "rk4,rk4:0.001", "--tolerances", "1e-4,1e-8"],
    );
    let steps: Vec<f64> = rows(&report)
        .iter()
        .map(|row| number(row, "step"))
        .collect();
    assert_eq!(steps.len(), 3);
    assert!(
        (steps[0] / steps[1] - 10.0).abs() < 0.1,
        "10⁻⁴ in a method of order 4 is a tenth of the step"
    );
    assert_eq!(steps[2], 0.001);
    assert!(rows(&report).iter().all(|row| row["tolerance"].is_null()));
}

#[test]
fn a_method_that_fails_is_a_line_that_says_why() {
    let arguments = ["--methods", "taylor,gauss6:5", "--tolerances", "1e-6"];
    let report = json(
        "cartesian-pendulum",
        &[&arguments[..], &["--until", "10"]].concat(),
    );
    let failure = rows(&report)[1]["failure"].as_str().expect("a reason");
    assert!(
        failure.contains("too long to follow the motion"),
        "{failure}"
    );
    let printed = table(
        "cartesian-pendulum",
        &[&arguments[..], &["--until", "10"]].concat(),
    );
    assert!(
        printed.contains("gauss6 with steps of 5 s: t = 0"),
        "{printed}"
    );
    assert!(
        printed.contains("Reference: the closed form (Jacobi's elliptic functions)"),
        "{printed}"
    );
}

#[test]
fn a_target_is_answered_with_a_command() {
    let arguments = [
        "--methods",
        "taylor,dopri5",
        "--tolerances",
        "1e-3..1e-12",
        "--target",
        "1e-9",
    ];
    let answer = table("mass-on-shell", &arguments);
    assert!(
        answer.contains("is the fastest way to errors below 1e-9"),
        "{answer}"
    );
    assert!(answer.contains("times as long"), "{answer}");
    let command = answer.lines().last().expect("a command");
    let command: Vec<&str> = command.split(' ').skip(1).collect();
    assert_eq!(command[..2], ["run", "mass-on-shell"]);
    assert!(says(&command).contains("floor stop"));
    // Of the run that was measured, not of the scene as it stands.
    let asked = "--set mass=2 --without floor --until 0.5";
    let asked: Vec<&str> = asked.split(' ').collect();
    let answer = table("mass-on-shell", &[&asked, &arguments[..]].concat());
    let command = answer.lines().last().expect("a command").split(' ');
    let command: Vec<&str> = command.skip(3).take(asked.len()).collect();
    assert_eq!(command, asked);

    let report = json("mass-on-shell", &arguments);
    let fastest = report["target"]["fastest"].as_array().expect("a list");
    assert!(!fastest.is_empty());
    for row in fastest {
        assert!(number(row, "error") <= 1e-9);
    }
}

#[test]
fn what_cannot_be_reached_is_said() {
    let arguments = |target: &'static str| {
        [
            "accuracy",
            "mass-on-shell",
            "--methods",
            "dopri5",
            "--tolerances",
            "1e-4",
            "--repeat",
            "1",
            "--target",
            target,
        ]
    };
    refuses(
        &arguments("1e-9"),
        1,
        "nothing reaches 1e-9; the best is dopri5 at 1e-4 with",
    );
    refuses(&arguments("1e-30"), 1, "cannot be told apart");
}

#[test]
fn csv_has_a_line_per_setting() {
    let arguments = [
        "--methods",
        "taylor,rk4:9",
        "--tolerances",
        "1e-5,1e-7",
        "--format",
        "csv",
    ];
    let printed = table("kepler", &[&arguments[..], &["--until", "3"]].concat());
    let mut reader = csv::Reader::from_reader(printed.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let column = |name: &str| header.iter().position(|h| h == name).expect("a column");
    let (method, error, failure) = (column("method"), column("state_error"), column("failure"));
    let lines: Vec<_> = reader.records().map(|line| line.expect("a line")).collect();
    assert_eq!(lines.len(), 3);
    for line in &lines {
        assert!(
            line[error].is_empty() != line[failure].is_empty(),
            "{line:?}"
        );
    }
    assert_eq!(&lines[0][method], "taylor");
}

#[test]
fn the_picture_has_every_method() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let picture = folder.join("accuracy.svg");
    let picture = picture.to_str().expect("a plain path");
    let arguments = [
        "--methods",
        "taylor,dop853,rk4",
        "--tolerances",
        "1e-4,1e-8",
        "--plot",
        picture,
    ];
    table("rolling-sphere", &arguments);
    let drawn = std::fs::read_to_string(picture).expect("the picture");
    for word in [
        "<svg",
        "rolling-sphere",
        "taylor",
        "dop853",
        "rk4",
        "time of one run",
        "error",
        "10⁻⁸",
        "floor",
    ] {
        assert!(drawn.contains(word), "{word} is missing");
    }
}

#[test]
fn without_a_result_of_any_method_the_cause_is_told() {
    for arguments in [&["--plot", "useless.svg"][..], &["--target", "1e-6"], &[]] {
        let wheel = ["accuracy", "mass-on-wheel", "--methods", "gauss6:3,rk4:1e9"];
        let output = lagrange(&[&wheel[..], arguments].concat());
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        let cause = "no method has a result; gauss6 with steps of 3 s: t =";
        assert!(said.contains(cause), "{said}");
        assert!(!text(&output.stdout).contains("0 rounds"));
    }
    // A floor that is hit at the start.
    refuses(
        &[
            "accuracy",
            "bouncing-ball",
            "--start",
            "y=0",
            "--start",
            "der(y)=-1",
            "--end-after",
            "floor impact",
        ],
        1,
        "the run ends at the instant at which it begins",
    );
}

#[test]
fn requests_without_sense_are_refused_in_one_line() {
    let refused = |arguments: &[&str], reason: &str| {
        refuses(
            &[&["accuracy", "mass-on-shell"], arguments].concat(),
            2,
            reason,
        );
    };
    refuses(&["accuracy"], 2, "<SCENE>");
    refuses(&["accuracy", "keppler"], 2, "did you mean `kepler`?");
    refused(&["--methods", "euler"], "no method is called `euler`");
    refused(&["--methods", "rk4:0"], "no step size");
    refused(&["--tolerances", "1"], "between 1e-17 and 0.1");
    refused(&["--tolerances", "2e-3..1e-9"], "powers of ten");
    refused(&["--target", "-1"], "must be above 0");
    refused(&["--repeat", "0"], "`0` is not a number of rounds");
    refused(&["--repeat", "1.5"], "`1.5` is not a number of rounds");
    refused(&["--repeat", "1e6"], "there can be 1 to 10000 rounds");
    refused(&["--set", "mas=1"], "did you mean `mass`?");
    refused(&["--from", "rset"], "did you mean `rest`?");
    // The motion itself has no answer (Painlevé): what a run says of it.
    let paradox = ["accuracy", "painleve-rod", "--set", "mu=2"];
    refuses(
        &paradox,
        1,
        "t = 0 (tip closed, grip slips backward): none of 2 modes",
    );
}

#[test]
fn impacts_that_accumulate_are_compared_as_one_instant() {
    // Both corners bounce in turn; which of them ends it, and after how many impacts, depends on the tolerance.
    let report = json(
        "rocking-block",
        &["--methods", "taylor,verner98", "--tolerances", "1e-6,1e-12"],
    );
    assert!(number(&report["reference"], "floor") < 1e-11);
    for row in rows(&report) {
        assert!(
            number(row, "error") < 30.0 * number(row, "tolerance"),
            "{row}"
        );
    }
}

#[test]
fn a_run_tells_its_error() {
    let run = |arguments: &[&str]| -> Value {
        let all = [&["run", "rolling-sphere", "--format", "json"], arguments].concat();
        serde_json::from_str(&says(&all)).expect("output is JSON")
    };
    // The closed form, by `accuracy`: its reference.
    let exact = json(
        "rolling-sphere",
        &["--methods", "taylor", "--tolerances", "1e-6"],
    );
    let event = |k: usize| number(&exact["reference"]["events"][k], "time");
    for arguments in [
        &["--tolerance", "1e-6", "--estimate"][..],
        &["--tolerance", "1e-6", "--method", "dopri5", "--estimate"],
    ] {
        let found = run(arguments);
        let told = found["estimate"]["events"].as_array().expect("a list");
        assert_eq!(told.len(), 2);
        for (k, told) in told.iter().enumerate() {
            let error = (number(&found["events"][k], "time") - event(k)).abs();
            let ratio = told.as_f64().expect("a number") / error;
            assert!((0.3..10.0).contains(&ratio), "{arguments:?}: {ratio}");
        }
        assert!(number(&found["estimate"]["state"], "theta") > 0.0);
        assert_eq!(number(&found["estimate"], "tolerance"), 1e-8);
    }
    let found = run(&["--error", "1e-12"]);
    for k in 0..2 {
        let error = (number(&found["events"][k], "time") - event(k)).abs();
        assert!(error <= 1e-12 * event(k), "{error:e}");
    }
    let story = says(&["run", "rolling-sphere", "--estimate"]);
    assert!(
        story.contains("Error: about ") && story.contains("±"),
        "{story}"
    );
    assert!(!says(&["run", "rolling-sphere"]).contains("Error:"));
}

#[test]
fn an_error_that_cannot_be_had_is_told() {
    let chaos = ["run", "double-pendulum", "--until", "60", "--error", "1e-9"];
    let output = lagrange(&chaos);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("an error of 1e-9 cannot be had"), "{said}");
    assert!(text(&output.stdout).contains("Error: about "));
    let both = ["run", "kepler", "--error", "1e-9", "--tolerance", "1e-9"];
    refuses(&both, 2, "cannot be used with");
    refuses(
        &["run", "kepler", "--error", "1"],
        2,
        "between 1e-15 and 0.1",
    );
}
