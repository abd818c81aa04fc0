//! Ctrl-C: what is done is kept, and the exit code says what happened.

use crate::program::{folder, text};
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Starts the program, interrupts it after `after`, and gives the exit code, what it said and what it complained of.
fn interrupted(
    folder: &std::path::Path,
    arguments: &[&str],
    after: Duration,
) -> (Option<i32>, String, String) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"))
        .current_dir(folder)
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    sleep(after);
    let mut signal = Command::new("kill");
    signal.args(["-INT", &program.id().to_string()]);
    assert!(signal.status().expect("kill is there").success());
    let mut said = String::new();
    let mut stdout = program.stdout.take().expect("a pipe");
    stdout.read_to_string(&mut said).expect("text");
    let output = program.wait_with_output().expect("it ends");
    (output.status.code(), said, text(&output.stderr).to_owned())
}

/// Long enough for a run to begin.
const A_WHILE: Duration = Duration::from_millis(700);

#[test]
fn a_run_that_is_interrupted_is_written_until_then() {
    let folder = folder("interrupted-run");
    let run = ["run", "long-pendulum", "--until", "1e9"];
    let outputs = ["--output", "run.csv", "--plot", "run.svg"];
    let (code, said, complaint) = interrupted(&folder, &[&run[..], &outputs].concat(), A_WHILE);
    assert_eq!((code, said.as_str()), (Some(130), ""), "{complaint}");
    // No bar: stderr is no terminal.
    assert_eq!(complaint.lines().count(), 1, "{complaint}");
    let time = complaint
        .strip_prefix("lagrange: interrupted at t = ")
        .and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok())
        .expect("the time of the interruption");
    assert!(0.0 < time && time < 1e9, "{complaint}");
    let table = fs::read_to_string(folder.join("run.csv")).expect("the table");
    let last = table.lines().last().and_then(|line| line.split(',').next());
    assert_eq!(last.and_then(|t| t.parse().ok()), Some(time));
    assert!(folder.join("run.svg").exists());
}

#[test]
fn a_measurement_that_is_interrupted_shows_what_it_has() {
    let folder = folder("interrupted-accuracy");
    // A thousand rounds take minutes, the first of them a moment.
    let study = [
        "accuracy",
        "mass-on-shell",
        "--repeat",
        "10000",
        "--format",
        "csv",
    ];
    let (code, said, complaint) = interrupted(&folder, &study, 3 * A_WHILE);
    assert_eq!(code, Some(130), "{complaint}");
    assert!(complaint.contains("what was measured until then is kept"));
    assert!(
        said.starts_with("method,tolerance") && said.lines().count() > 1,
        "{said}"
    );
}

#[test]
fn the_hard_cases_end_after_the_one_in_hand() {
    let folder = folder("interrupted-stability");
    let (code, _, complaint) = interrupted(&folder, &["stability", "--long"], A_WHILE / 4);
    assert_eq!(code, Some(130), "{complaint}");
    assert!(complaint.contains("interrupted after"), "{complaint}");
    assert!(complaint.contains(" cases"), "{complaint}");
}

#[test]
fn pressed_twice_it_ends_at_once() {
    let begin = Instant::now();
    let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"))
        .args(["run", "long-pendulum", "--until", "1e9"])
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    sleep(2 * A_WHILE);
    for _ in 0..2 {
        let mut signal = Command::new("kill");
        signal.args(["-INT", &program.id().to_string()]);
        assert!(signal.status().expect("kill is there").success());
        sleep(A_WHILE / 10);
    }
    let status = program.wait().expect("it ends");
    assert_eq!(status.code(), Some(130));
    assert!(begin.elapsed() < Duration::from_secs(60));
}
