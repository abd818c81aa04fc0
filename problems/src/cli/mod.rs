//! The command line: arguments in, data to stdout, words to stderr.
//!
//! Exit codes: 0 all went well; 1 the run failed (what there is of it is still printed) or a file could not be
//! written; 2 the request makes no sense.

mod accuracy;
mod compare;
mod course;
mod effects;
mod inspect;
mod list;
mod output;
mod report;
mod run;
mod stability;
mod sweep;
mod values;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use lagrange_problems::request::Refusal;
use std::fmt::Display;
use std::process::ExitCode;

/// Runs textbook scenes of constrained mechanics: each declared once as a Lagrangian, every switch located.
#[derive(Parser)]
#[command(name = "lagrange", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    List(list::List),
    Inspect(inspect::Inspect),
    Run(run::Run),
    Report(report::Report),
    Accuracy(accuracy::Measure),
    Effects(effects::Effects),
    Stability(stability::Stability),
    Sweep(sweep::Sweeps),
}

/// What went wrong, and with it the exit code.
pub(crate) enum Trouble {
    /// The request makes no sense.
    Usage(String),
    /// It was run or written, and failed.
    Failed(String),
}

impl Trouble {
    fn usage(reason: impl Display) -> Self {
        Trouble::Usage(reason.to_string())
    }

    fn failed(reason: impl Display) -> Self {
        Trouble::Failed(reason.to_string())
    }

    /// A name that is not known makes no sense; a start or a reference that does not exist was tried.
    fn refused(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Start(_) | Refusal::Run(_) | Refusal::Reference { .. } => {
                Trouble::failed(refusal)
            }
            _ => Trouble::usage(refusal),
        }
    }
}

/// Runs the program with the arguments of the process.
pub(crate) fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) if error.use_stderr() => return complain(&Trouble::Usage(one_line(&error))),
        // `--help` and `--version` are answers, not errors.
        Err(answer) => {
            let _ = answer.print();
            return ExitCode::SUCCESS;
        }
    };
    let result = match arguments.command {
        Command::List(list) => list.execute(),
        Command::Inspect(inspect) => inspect.execute(),
        Command::Run(run) => run.execute(),
        Command::Report(report) => report.execute(),
        Command::Accuracy(accuracy) => accuracy.execute(),
        Command::Effects(effects) => effects.execute(),
        Command::Stability(stability) => stability.execute(),
        Command::Sweep(sweep) => sweep.execute(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(trouble) => complain(&trouble),
    }
}

fn complain(trouble: &Trouble) -> ExitCode {
    let (reason, code) = match trouble {
        Trouble::Usage(reason) => (reason, 2),
        Trouble::Failed(reason) => (reason, 1),
    };
    eprintln!("lagrange: {reason}");
    ExitCode::from(code)
}

/// What clap has to say, without its usage paragraphs.
fn one_line(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "no command given; `lagrange list` shows the scenes, `lagrange run SCENE` runs one"
            .to_owned();
    }
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

/// Writes to stdout; a reader that has gone away (`| head`) is not an error.
pub(crate) fn print(
    write: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>,
) -> Result<(), Trouble> {
    use std::io::Write;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Trouble::failed(
            format_args!("cannot write the result: {error}"),
        )),
        _ => Ok(()),
    }
}
