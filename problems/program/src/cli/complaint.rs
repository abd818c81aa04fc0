//! What is wrong with the arguments, in one line: what clap has found out, in the words of the other messages.

use super::commands;
use crate::catalogue::Catalogue;
use crate::file::ENDING;
use crate::names::nearest;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::error::Error;

/// The line.
pub(super) fn one_line(error: &clap::Error, catalogue: &Catalogue) -> String {
    let words = |kind: ContextKind| match error.get(kind) {
        Some(ContextValue::String(word)) => vec![word.as_str()],
        Some(ContextValue::Strings(words)) => words.iter().map(String::as_str).collect(),
        _ => Vec::new(),
    };
    let word = |kind: ContextKind| words(kind).first().copied().unwrap_or_default();
    let argument = word(ContextKind::InvalidArg);
    let value = word(ContextKind::InvalidValue);
    match error.kind() {
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            "no command given; `lagrange list` shows the scenes, `lagrange run SCENE` runs one"
                .to_owned()
        }
        ErrorKind::InvalidSubcommand => command(word(ContextKind::InvalidSubcommand), catalogue),
        ErrorKind::UnknownArgument if argument.starts_with('-') => {
            let near = word(ContextKind::SuggestedArg);
            match near.is_empty() {
                true => format!("no option is called `{argument}`; --help shows all"),
                false => format!("no option is called `{argument}`; did you mean `{near}`?"),
            }
        }
        ErrorKind::UnknownArgument => {
            format!("what is `{argument}` for? --help shows what can be given")
        }
        ErrorKind::InvalidValue if value.is_empty() => {
            let known = words(ContextKind::ValidValue).join(", ");
            match known.is_empty() {
                true => format!("a value is missing: {argument}"),
                false => format!("a value is missing: {argument}, one of {known}"),
            }
        }
        ErrorKind::InvalidValue => {
            let known = words(ContextKind::ValidValue);
            let option = option(argument);
            match nearest(value, &known) {
                Some(near) => format!("{option} cannot be `{value}`; did you mean `{near}`?"),
                None => format!(
                    "{option} cannot be `{value}`; there are: {}",
                    known.join(", ")
                ),
            }
        }
        ErrorKind::ValueValidation => {
            let reason = error.source().map(ToString::to_string);
            let (option, reason) = (option(argument), reason.unwrap_or_default());
            format!("{option} {value}: {reason}")
        }
        ErrorKind::MissingRequiredArgument => {
            format!(
                "missing: {}; --help shows how it is written",
                words(ContextKind::InvalidArg).join(", ")
            )
        }
        ErrorKind::ArgumentConflict if word(ContextKind::PriorArg) == argument => {
            format!("`{}` is given twice; give it once", option(argument))
        }
        _ => rendered(error),
    }
}

/// `--format` of `--format <FORMAT>`
fn option(argument: &str) -> &str {
    argument.split(' ').next().unwrap_or(argument)
}

/// A command that there is not.
fn command(name: &str, catalogue: &Catalogue) -> String {
    if name.ends_with(".toml") || name.ends_with(ENDING) || catalogue.find(name).is_ok() {
        return format!("`{name}` is what to run: lagrange run {name}");
    }
    let command = commands(catalogue);
    let known: Vec<&str> = command
        .get_subcommands()
        .filter(|command| !command.is_hide_set())
        .map(clap::Command::get_name)
        .collect();
    match nearest(name, &known) {
        Some(near) => format!("no command is called `{name}`; did you mean `{near}`?"),
        None => format!(
            "no command is called `{name}`; there are: {}",
            known.join(", ")
        ),
    }
}

/// What clap has to say, without its usage paragraphs.
fn rendered(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let said = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:"));
    let telling = |line: &&str| !line.is_empty() && !line.starts_with("For more information");
    let words: Vec<&str> = said.filter(telling).collect();
    words
        .join("; ")
        .replace(":; ", ": ")
        .trim_start_matches("error: ")
        .to_owned()
}
