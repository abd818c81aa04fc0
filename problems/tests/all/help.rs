//! The help: every command has examples, and they work.

use crate::program::{folder, says, shell, text};
use lagrange_program::file::TEMPLATE;
use std::fs;

/// Commands that every `lagrange` has; `help` is clap's.
fn commands() -> Vec<String> {
    let help = says(&["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let lines = lines.take_while(|line| !line.is_empty());
    let names = lines.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    names
        .filter(|name| *name != "help")
        .map(str::to_owned)
        .collect()
}

/// The examples in a help text, without what is said about them.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    let lines = lines.take_while(|line| line.starts_with("  "));
    let commands = lines.map(|line| line.trim().split("   ").next().unwrap_or(line).trim());
    // The rest of a remark that was wrapped is no command.
    let commands = commands.filter(|line| line.starts_with("lagrange "));
    commands.map(str::to_owned).collect()
}

/// Whether a test has the time, and the shell, for an example.
fn is_quick(example: &str) -> bool {
    !["--long", "mpirun", ">"]
        .iter()
        .any(|word| example.contains(word))
}

#[test]
fn every_example_works() {
    let folder = folder("examples");
    // Some speak of a scene file of the user's.
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/sticky-wheel.toml");
    fs::copy(file, folder.join("sticky.toml")).expect("a scene file");
    fs::write(folder.join("pendulum.lagrange"), TEMPLATE).expect("a declaration");
    let commands = commands();
    assert!(commands.len() >= 9, "{commands:?}");
    let mut helps = vec![says(&["--help"])];
    helps.extend(commands.iter().map(|command| says(&[command, "--help"])));
    for help in helps {
        let examples = examples(&help);
        assert!(examples.len() >= 2, "too few examples in\n{help}");
        for example in examples.iter().filter(|example| is_quick(example)) {
            let output = shell(&folder, example);
            let said = text(&output.stderr);
            assert_eq!(output.status.code(), Some(0), "{example}: {said}");
        }
    }
}

#[test]
fn shells_are_told_commands_options_and_scenes() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = says(&["completions", shell]);
        assert!(
            script.contains("accuracy") && script.contains("tolerance"),
            "{shell}"
        );
        // The others are told options only.
        let scenes = ["bash", "zsh", "fish"].contains(&shell);
        assert_eq!(script.contains("mass-on-wheel"), scenes, "{shell}");
    }
}
