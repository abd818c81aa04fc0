//! `lagrange completions`: what a shell needs to complete commands, options and names of scenes.

use super::{Trouble, commands, print};
use crate::catalogue::Catalogue;
use clap::builder::PossibleValuesParser;
use clap::{Args, Command, ValueHint};
use clap_complete::{Generator, Shell};

/// Print what makes a shell complete commands, options and scenes.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange completions bash > ~/.local/share/bash-completion/completions/lagrange
  lagrange completions zsh > ~/.zfunc/_lagrange          a folder of your fpath
  lagrange completions fish > ~/.config/fish/completions/lagrange.fish")]
pub(super) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(super) fn execute(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let names: Vec<&'static str> = catalogue.names().collect();
        let mut command = named(commands(catalogue), &names);
        command.set_bin_name("lagrange");
        command.build();
        let mut script = Vec::new();
        self.shell.generate(&command, &mut script);
        match self.shell {
            Shell::Fish => script.extend(fish(&command, &names).bytes()),
            Shell::Zsh => script = zsh(&String::from_utf8_lossy(&script), &names).into_bytes(),
            _ => {}
        }
        print(|out| out.write_all(&script))
    }
}

/// The script for zsh with files where a scene file will do: the generator knows names or files, not both.
fn zsh(script: &str, names: &[&str]) -> String {
    let names = names.join(" ");
    let files = r#""files:scene file:_files -g \"*.(toml|lagrange)\"""#;
    let both = format!(":{{_alternative \"scenes:scene:({names})\" {files}}}");
    let line = |line: &str| match line.contains("scene file") {
        true => line.replace(&format!(":({names})"), &both) + "\n",
        false => format!("{line}\n"),
    };
    script.lines().map(line).collect()
}

/// Names of scenes for fish, to which the generator tells options only.
fn fish(command: &Command, names: &[&str]) -> String {
    let names = names.join(" ");
    let takes = |sub: &&Command| sub.get_arguments().any(|a| is_scene(a.get_id().as_str()));
    let line = |sub: &Command| {
        let seen = format!("__fish_seen_subcommand_from {}", sub.get_name());
        format!("complete -c lagrange -n \"{seen}\" -a \"{names}\"\n")
    };
    command.get_subcommands().filter(takes).map(line).collect()
}

fn is_scene(id: &str) -> bool {
    id == "scene" || id == "scenes"
}

/// The command with the names of the scenes where a scene is expected.
fn named(command: Command, names: &[&'static str]) -> Command {
    let subcommands: Vec<String> = command
        .get_subcommands()
        .map(|sub| sub.get_name().to_owned())
        .collect();
    subcommands.into_iter().fold(command, |command, name| {
        command.mut_subcommand(name, |sub| {
            sub.mut_args(|argument| match is_scene(argument.get_id().as_str()) {
                true => argument
                    .value_parser(PossibleValuesParser::new(names))
                    .value_hint(ValueHint::FilePath),
                false => argument,
            })
        })
    })
}
