//! `lagrange run`: one scene, from a start to its end.

use super::values::{named, positive};
use super::{Trouble, print};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use lagrange_core::prelude::Method;
use lagrange_problems::catalogue::find;
use lagrange_problems::outcome::Outcome;
use lagrange_problems::report::{csv, json, plot, table};
use lagrange_problems::request::{Refusal, Request};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Intervals at which tables of numbers and pictures sample a trajectory.
const SAMPLES: usize = 400;

/// Run a scene and tell what happened.
#[derive(Args)]
pub(super) struct Run {
    /// The scene; `lagrange list` shows them.
    scene: String,
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = named, allow_hyphen_values = true)]
    set: Vec<(String, f64)>,
    /// The named start to begin from [default: the first].
    #[arg(long, value_name = "START")]
    from: Option<String>,
    /// Hold a coordinate (theta=0.1) or velocity ("der(theta)=2") at the start; the others follow from the named
    /// start: constraints hold, contacts closed there stay closed, slips zero there stay zero. May be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = named, allow_hyphen_values = true)]
    start: Vec<(String, f64)>,
    /// End of the run, s [default: the scene's].
    #[arg(long, value_name = "T", value_parser = positive, allow_hyphen_values = true)]
    until: Option<f64>,
    /// Tolerance of the integration, relative and absolute.
    #[arg(long, value_name = "X", default_value = "1e-9", value_parser = positive, allow_hyphen_values = true)]
    tolerance: f64,
    /// Method of integration.
    #[arg(long, value_name = "M", default_value_t = Method::Taylor)]
    method: Method,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Write the result to a file instead of stdout.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw forces and state over time.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Move a start that violates a constraint onto it instead of refusing it.
    #[arg(long)]
    project: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// The story of the run.
    Table,
    /// Every number in full precision.
    Json,
    /// Samples over time, and every event.
    Csv,
}

impl Run {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let scene = find(&self.scene).map_err(Trouble::usage)?;
        let request = Request {
            samples: if self.plot.is_some() || self.format == Format::Csv {
                SAMPLES
            } else {
                0
            },
            parameters: self.set,
            from: self.from,
            start: self.start,
            until: self.until,
            tolerance: self.tolerance,
            method: self.method,
            project: self.project,
        };
        let outcome =
            patiently(&self.scene, || scene.run(&request)).map_err(|refusal| match refusal {
                Refusal::Start(_) => Trouble::failed(refusal),
                _ => Trouble::usage(refusal),
            })?;
        let write = |out: &mut dyn Write| write(&outcome, self.format, out);
        match &self.output {
            None => print(write)?,
            Some(path) => to_file(path, write)?,
        }
        if let Some(path) = &self.plot {
            let picture = plot::svg(&outcome).map_err(Trouble::failed)?;
            to_file(path, |out| out.write_all(picture.as_bytes()))?;
        }
        match outcome.failure {
            None => Ok(()),
            Some(error) => Err(Trouble::failed(error)),
        }
    }
}

fn write(outcome: &Outcome, format: Format, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => table::write(outcome, out),
        Format::Json => json::write(outcome, out),
        Format::Csv => csv::write(outcome, out),
    }
}

fn to_file(
    path: &std::path::Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Trouble> {
    let mut text = Vec::new();
    write(&mut text)
        .and_then(|()| std::fs::write(path, text))
        .map_err(|error| Trouble::failed(format_args!("cannot write {}: {error}", path.display())))
}

/// Does `work`; if it takes longer than a second, shows on stderr that it is alive.
fn patiently<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let (done, waiting) = channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            if waiting.recv_timeout(Duration::from_secs(1)) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let spinner = ProgressBar::new_spinner().with_message(format!("running {what}"));
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
                spinner.set_style(style);
            }
            spinner.enable_steady_tick(Duration::from_millis(100));
            let _ = waiting.recv();
            spinner.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}
