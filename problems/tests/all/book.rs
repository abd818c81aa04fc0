//! What the README and the book show is run: the program's commands in their order, which say what is shown below them, and
//! the Python that reads their files. That needs pandas and polars (`PYTHON`, else python3 of the path); without, it is skipped.

use crate::program::{folder, shell, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The README and the chapters of the book.
fn files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let chapters = fs::read_dir(root.join("lagrange-core/src/book")).expect("the book");
    let chapters = chapters.map(|entry| entry.expect("a chapter").path());
    let chapters = chapters.filter(|path| path.extension().is_some_and(|end| end == "md"));
    let mut files: Vec<PathBuf> = chapters.collect();
    files.push(root.join("README.md"));
    files.sort();
    files
}

/// The blocks of this language.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("\n```{language}\n");
    let blocks = text.split(fence.as_str()).skip(1);
    blocks
        .filter_map(|block| block.split("\n```").next())
        .collect()
}

/// Commands of a block, each with what is shown below it.
fn commands(block: &str) -> impl Iterator<Item = (String, Vec<&str>)> {
    let commands = block.strip_prefix("$ ").unwrap_or(block).split("\n$ ");
    commands.map(|command| {
        let mut lines = command.lines();
        let line = lines.next().unwrap_or_default();
        let line = line.replace("cargo run --release --", "lagrange");
        (line, lines.collect())
    })
}

/// Whether a test can run it: neither another program's nor one that writes into the user's home.
fn is_ours(command: &str) -> bool {
    command.starts_with("lagrange ") && !command.contains('~')
}

/// The words of a line. Numbers and their units may change.
fn words(line: &str) -> Vec<&str> {
    let words = line.split(|c: char| !c.is_alphabetic());
    words.filter(|word| word.chars().count() > 2).collect()
}

/// The first line that is shown and not said, in the same order.
fn missing<'a>(shown: &[&'a str], said: &str) -> Option<&'a str> {
    let mut said = said.lines();
    let mut shown = shown.iter().filter(|line| !words(line).is_empty());
    shown
        .find(|line| !said.any(|found| words(found) == words(line)))
        .copied()
}

#[test]
fn commands_say_what_is_shown() {
    let mut count = 0;
    for file in files() {
        let name = file
            .file_stem()
            .and_then(|name| name.to_str())
            .expect("unicode");
        let text_of_file = fs::read_to_string(&file).expect("a text");
        let folder = folder(&format!("book-{name}"));
        // A scene file or declaration begins with its name.
        for (language, remark) in [("toml", "# "), ("lagrange", "// ")] {
            for block in blocks(&text_of_file, language) {
                let first = block.lines().next();
                if let Some(name) = first.and_then(|line| line.strip_prefix(remark)) {
                    fs::write(folder.join(name), block).expect("a file");
                }
            }
        }
        let blocks = blocks(&text_of_file, "console");
        let commands = blocks.into_iter().flat_map(commands);
        for (command, shown) in commands.filter(|(command, _)| is_ours(command)) {
            let output = shell(&folder, &command);
            let said = [text(&output.stdout), text(&output.stderr)].concat();
            let refused = shown.iter().any(|line| line.starts_with("lagrange: "));
            assert_eq!(
                output.status.success(),
                !refused,
                "{name}: {command}\n{said}"
            );
            let missing = missing(&shown, &said);
            assert_eq!(missing, None, "{name}: {command}\n{said}");
            count += 1;
        }
    }
    assert!(count > 30, "only {count} commands");
}

#[test]
fn python_reads_what_is_written() {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let folder = folder("book-in-python");
    let run = |code: &str| {
        let mut python = Command::new(&python);
        python.current_dir(&folder).args(["-c", code]).output()
    };
    let ready = run("import pandas, pyarrow, polars");
    if !ready.is_ok_and(|output| output.status.success()) {
        println!("skipped: {python} has no pandas, pyarrow and polars");
        return;
    }
    for command in [
        "lagrange run mass-on-wheel --output wheel.parquet",
        "lagrange sweep rolling-slipping-sphere --vary mu_static=0.5..1:3 --observe 'leave angle' --output sweep.parquet",
    ] {
        let output = shell(&folder, command);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
    let texts = files()
        .into_iter()
        .map(|file| fs::read_to_string(file).expect("a text"));
    let texts: Vec<String> = texts.collect();
    let blocks = texts.iter().flat_map(|text| blocks(text, "python"));
    let said = blocks.map(|block| {
        let output = run(block).expect("Python starts");
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).to_owned()
    });
    let said: String = said.collect();
    let words = [
        "0.6 rad/s",
        "floor stop",
        "rim open",
        "1e-09",
        "mu_static",
        "0.75",
    ];
    for word in words {
        assert!(said.contains(word), "{word} is missing in\n{said}");
    }
}
