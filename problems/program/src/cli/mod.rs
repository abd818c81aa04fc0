//! The command line: arguments in, data to stdout, words to stderr.
//!
//! Exit codes: 0 all went well; 1 the run failed or its certificate falls short (what there is of it is still printed), or a
//! file could not be written; 2 the request makes no sense; 130 interrupted (what there is is still printed).

mod accuracy;
mod compare;
mod complaint;
mod completions;
mod effects;
mod export;
mod inspect;
mod list;
mod merge;
mod modes;
mod new;
mod output;
mod report;
mod results;
mod run;
mod run_args;
mod shell;
mod stability;
mod sweep;
mod terminal;
mod values;
mod verify;
mod watch;

use crate::blame;
use crate::catalogue::Catalogue;
use crate::outcome::Outcome;
use crate::request::{Refusal, Request};
use crate::scene::Scene;
use crate::sweep::launch;
use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use lagrange_core::Error;
use std::ffi::OsString;
use std::fmt::Display;
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

/// Runs textbook scenes of constrained mechanics: each declared once as a Lagrangian, every switch located.
#[derive(Parser)]
#[command(name = "lagrange", version, max_term_width = 100)]
#[command(after_help = "Examples:
  lagrange list                               the scenes
  lagrange list mass-on-wheel                 what one of them can be given
  lagrange run mass-on-wheel                  what happens
  lagrange report mass-on-wheel --output wheel.html
  lagrange new cart                           a system of one's own, in cart.lagrange
  lagrange run cart.lagrange

lagrange COMMAND --help has examples of each command.")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// No progress bars.
    #[arg(long, global = true, display_order = 1000)]
    quiet: bool,
    /// Colours in help and messages; `auto` heeds NO_COLOR and CLICOLOR.
    #[arg(
        long,
        global = true,
        display_order = 1001,
        value_name = "WHEN",
        default_value_t
    )]
    color: ColorChoice,
}

#[derive(Subcommand)]
enum Command {
    List(list::List),
    Inspect(inspect::Inspect),
    Run(run::Run),
    Verify(verify::Verify),
    Modes(modes::Modes),
    Report(report::Report),
    Accuracy(accuracy::Measure),
    Effects(effects::Effects),
    Stability(stability::Stability),
    Sweep(sweep::Sweeps),
    Merge(merge::Merge),
    New(new::New),
    Export(export::Export),
    Completions(completions::Completions),
}

/// What went wrong, and with it the exit code.
pub(crate) enum Trouble {
    /// The request makes no sense.
    Usage(String),
    /// It was run or written, and failed.
    Failed(String),
    /// The user has ended it.
    Interrupted(String),
}

/// Exit code of what Ctrl-C has ended: 128 and the number of the signal, as shells have it.
const INTERRUPTED: i32 = 130;

impl Trouble {
    fn usage(reason: impl Display) -> Self {
        Trouble::Usage(reason.to_string())
    }

    fn failed(reason: impl Display) -> Self {
        Trouble::Failed(reason.to_string())
    }

    /// The same of a run of this scene: with places and the cause where the motion cannot begin.
    fn refused_run(refusal: Refusal, scene: &dyn Scene, request: &Request) -> Self {
        let told = blame::refusal(scene, request, &refusal);
        match Trouble::refused(refusal) {
            Trouble::Failed(_) => Trouble::Failed(told),
            other => other,
        }
    }

    /// A name that is not known makes no sense; a start or a reference that does not exist was tried.
    fn refused(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Run(Error::Interrupted { .. }) => Trouble::Interrupted(refusal.to_string()),
            Refusal::Start(_)
            | Refusal::Begin(_)
            | Refusal::Run(_)
            | Refusal::Ended { .. }
            | Refusal::Reference { .. } => Trouble::failed(refusal),
            _ => Trouble::usage(refusal),
        }
    }
}

/// A run went well if it came to its end and its certificate holds.
fn went_well(outcome: Outcome, scene: &dyn Scene, request: &Request) -> Result<(), Trouble> {
    if let Some(Error::Interrupted { time }) = outcome.failure {
        return Err(Trouble::Interrupted(format!(
            "interrupted at t = {time} s; what was run until then is kept"
        )));
    }
    if let Some(told) = blame::failure(scene, request, &outcome) {
        return Err(Trouble::Failed(told));
    }
    match outcome.certificate {
        None => Err(Trouble::failed(
            "the motion could not be evaluated everywhere",
        )),
        Some(certificate) if certificate.holds() => Ok(()),
        Some(certificate) => Err(Trouble::failed(certificate)),
    }
}

/// Runs the program with these arguments, its name first.
pub(crate) fn run(arguments: &[OsString], catalogue: &Catalogue) -> ExitCode {
    let choice = colour_asked(arguments.iter());
    terminal::colour(choice);
    let command = commands(catalogue).color(choice);
    let parsed = command.try_get_matches_from(arguments);
    let arguments = match parsed.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
        Err(error) if error.use_stderr() => {
            return complain(&Trouble::Usage(complaint::one_line(&error, catalogue)));
        }
        // `--help` and `--version` are answers, not errors.
        Err(answer) => {
            let _ = answer.print();
            return ExitCode::SUCCESS;
        }
    };
    if arguments.quiet {
        terminal::be_quiet();
    }
    let result = match arguments.command {
        Command::List(list) => list.execute(catalogue),
        Command::Inspect(inspect) => inspect.execute(catalogue),
        Command::Run(run) => run.execute(catalogue),
        Command::Verify(verify) => verify.execute(catalogue),
        Command::Modes(modes) => modes.execute(catalogue),
        Command::Report(report) => report.execute(catalogue),
        Command::Accuracy(accuracy) => accuracy.execute(catalogue),
        Command::Effects(effects) => effects.execute(catalogue),
        Command::Stability(stability) => stability.execute(catalogue),
        Command::Sweep(sweep) => sweep.execute(catalogue),
        Command::Merge(merge) => merge.execute(catalogue),
        Command::New(new) => new.execute(),
        Command::Export(export) => export.execute(),
        Command::Completions(completions) => completions.execute(catalogue),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(trouble) => complain(&trouble),
    }
}

/// All commands; `stability` is hidden where there is nothing that it could run.
fn commands(catalogue: &Catalogue) -> clap::Command {
    let nothing = catalogue.cases.is_empty();
    Arguments::command().mut_subcommand("stability", |command| command.hide(nothing))
}

fn complain(trouble: &Trouble) -> ExitCode {
    let (reason, code) = match trouble {
        Trouble::Usage(reason) => (reason, 2),
        Trouble::Failed(reason) => (reason, 1),
        Trouble::Interrupted(reason) => (reason, INTERRUPTED as u8),
    };
    // Of processes that were started together with the same arguments, one is enough to say it.
    if launch::place().is_none_or(|place| place.rank == 0) {
        say(reason);
    }
    ExitCode::from(code)
}

/// Words to the user, in one line but for mistakes that are shown where they are.
fn say(words: &str) {
    let style = anstyle::AnsiColor::Red.on_default().bold();
    // There is nobody to tell that stderr is closed.
    let _ = writeln!(anstream::stderr(), "{style}lagrange:{style:#} {words}");
}

/// The colours asked for, before anything is parsed: help and complaints about arguments need it.
fn colour_asked<'a>(arguments: impl Iterator<Item = &'a OsString>) -> ColorChoice {
    let words: Vec<String> = arguments
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect();
    let given = |pair: &[String]| match pair[0].strip_prefix("--color") {
        Some("") => pair.get(1).cloned(),
        Some(rest) => rest.strip_prefix('=').map(str::to_owned),
        None => None,
    };
    let asked = (0..words.len()).find_map(|k| given(&words[k..]));
    asked
        .and_then(|word| ColorChoice::from_str(&word, false).ok())
        .unwrap_or_default()
}

/// Writes to stdout; a reader that has gone away (`| head`) is not an error.
pub(crate) fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Trouble> {
    let mut reader = Reader {
        out: io::stdout().lock(),
        gone: false,
    };
    let mut out = BufWriter::new(&mut reader);
    let written = write(&mut out).and_then(|()| out.flush());
    drop(out);
    match written {
        Err(error) if !reader.gone => Err(Trouble::failed(format_args!(
            "cannot write the result: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Who reads stdout. What writes tables wraps errors, so that only here it can be seen that nobody reads any more.
struct Reader<W> {
    out: W,
    gone: bool,
}

impl<W: Write> Reader<W> {
    fn note<T>(&mut self, written: io::Result<T>) -> io::Result<T> {
        let broken = |error: &io::Error| error.kind() == io::ErrorKind::BrokenPipe;
        self.gone |= written.as_ref().is_err_and(broken);
        written
    }
}

impl<W: Write> Write for Reader<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes);
        self.note(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.out.flush();
        self.note(flushed)
    }
}
