//! The program, called from tests.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

pub fn lagrange(arguments: &[&str]) -> Output {
    lagrange_in(Path::new("."), arguments)
}

/// Runs it in a folder.
pub fn lagrange_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lagrange"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts")
}

/// Runs a line of a shell in a folder, with the program on its path.
pub fn shell(folder: &Path, line: &str) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_lagrange"));
    let mut path = program.parent().expect("a folder").as_os_str().to_owned();
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap_or_default());
    let mut shell = Command::new("sh");
    shell.current_dir(folder).env("PATH", path);
    shell.args(["-c", line]).output().expect("the shell starts")
}

/// An empty folder of this name.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("it is ours");
    }
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

pub fn path(file: &Path) -> &str {
    file.to_str().expect("unicode")
}

pub fn text(bytes: &[u8]) -> &str {
    core::str::from_utf8(bytes).expect("output is UTF-8")
}

/// Runs it, expects success and silence on stderr, gives stdout.
pub fn says(arguments: &[&str]) -> String {
    let output = lagrange(arguments);
    assert_eq!(text(&output.stderr), "", "{arguments:?}");
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    text(&output.stdout).to_owned()
}

/// Runs it, expects a refusal: exit code, one line on stderr that contains `reason`, nothing on stdout.
pub fn refuses(arguments: &[&str], code: i32, reason: &str) {
    let output = lagrange(arguments);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
    assert_eq!(text(&output.stdout), "", "{arguments:?}");
    assert_eq!(said.lines().count(), 1, "{arguments:?}: {said}");
    assert!(said.contains(reason), "{arguments:?}: {said}");
}

/// 9000 runs, in nine chunks.
const SWEEP: &[&str] = &[
    "sweep",
    "rolling-slipping-sphere",
    "--vary",
    "mu_static=0.2..1:30",
    "--vary",
    "theta=0.01..0.4:300",
    "--observe",
    "leave angle",
    "--observe",
    "t at grip slips",
    "--quiet",
];

/// This sweep with further arguments.
pub fn sweep<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [SWEEP, more].concat()
}
