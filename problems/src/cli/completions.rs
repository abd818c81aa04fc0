//! `lagrange completions`: what a shell needs to complete commands, options and names of scenes.

use super::{Arguments, Trouble, print};
use clap::builder::PossibleValuesParser;
use clap::{Args, Command, CommandFactory, ValueHint};
use clap_complete::{Generator, Shell};
use lagrange_problems::catalogue::scenes;

/// Print a script that makes a shell complete commands, options and names of scenes.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange completions bash > ~/.local/share/bash-completion/completions/lagrange
  lagrange completions zsh > ~/.zfunc/_lagrange          # a folder of your fpath
  lagrange completions fish > ~/.config/fish/completions/lagrange.fish")]
pub(super) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(super) fn execute(&self) -> Result<(), Trouble> {
        let mut command = named(Arguments::command());
        command.set_bin_name("lagrange");
        command.build();
        let mut script = Vec::new();
        self.shell.generate(&command, &mut script);
        print(|out| out.write_all(&script))
    }
}

/// The command with the names of the scenes where a scene is expected.
fn named(command: Command) -> Command {
    let subcommands: Vec<String> = command
        .get_subcommands()
        .map(|sub| sub.get_name().to_owned())
        .collect();
    let scene = |id: &str| id == "scene" || id == "scenes";
    subcommands.into_iter().fold(command, |command, name| {
        command.mut_subcommand(name, |sub| {
            sub.mut_args(|argument| match scene(argument.get_id().as_str()) {
                true => argument
                    .value_parser(PossibleValuesParser::new(scenes().map(|s| s.name())))
                    .value_hint(ValueHint::FilePath),
                false => argument,
            })
        })
    })
}
