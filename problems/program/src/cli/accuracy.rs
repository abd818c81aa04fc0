//! `lagrange accuracy`: what accuracy costs in a scene, method by method.

use super::Trouble;
use super::output::{Output, draw, ready};
use super::run_args::Motion;
use super::shell;
use super::terminal::{keep_what_is_done, patiently};
use super::values::{number_of, picture, positive, tolerances};
use crate::accuracy::family;
use crate::accuracy::{Accuracy, Family, Study};
use crate::catalogue::Catalogue;
use crate::format::Format;
use crate::progress::Progress;
use crate::report::accuracy::{answer, csv, json, plot, table};
use crate::request::Request;
use clap::Args;
use std::io::{self, Write};
use std::path::PathBuf;

/// Measure what accuracy costs, method by method.
///
/// Every method runs at every tolerance, and is measured in time and work against a reference that is made on the spot. What a
/// scene file says of method and tolerance does not matter here.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange accuracy mass-on-wheel --tolerances 1e-6..1e-9 --plot accuracy.svg
  lagrange accuracy mass-on-wheel --target 1e-9
  lagrange accuracy kepler --methods taylor,verner98,gauss6:0.001 --until 20 --repeat 3

Ctrl-C ends the measurement; what has been measured is written.")]
pub(super) struct Measure {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    motion: Motion,
    /// Methods; rk4 and gauss6 get steps that suit the tolerances, or have one of their own (rk4:0.001)
    /// [default: all].
    #[arg(long, help_heading = "The measurement", value_name = "M,…", value_delimiter = ',', value_parser = family)]
    methods: Vec<Family>,
    /// Tolerances; 1e-3..1e-15 stands for every power of ten from one to the other.
    #[arg(long, help_heading = "The measurement", value_name = "X,…", value_delimiter = ',', value_parser = tolerances,
          default_value = "1e-3,1e-5,1e-7,1e-9,1e-11,1e-13,1e-15", allow_hyphen_values = true)]
    tolerances: Vec<Vec<f64>>,
    /// Times that everything is measured [default: 15, less often what takes long].
    #[arg(long, help_heading = "The measurement", value_name = "N", value_parser = number_of("rounds", 1, 10_000), allow_hyphen_values = true)]
    repeat: Option<usize>,
    /// Answer only which method and tolerance reach this error in the shortest time.
    #[arg(long, help_heading = "The measurement", value_name = "X", value_parser = positive, allow_hyphen_values = true)]
    target: Option<f64>,
    #[command(flatten)]
    output: Output,
    /// Draw time over error, into a file ….svg, ….png or ….pdf.
    #[arg(long, value_name = "FILE", value_parser = picture)]
    plot: Option<PathBuf>,
}

impl Measure {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let file = self.motion.of(&self.scene, catalogue)?;
        let format = self.output.format()?;
        let files = self.output.path().into_iter().chain(self.plot.as_deref());
        ready(files, std::slice::from_ref(&self.scene))?;
        let scene = file.scene;
        let progress = Progress::default();
        keep_what_is_done(&progress);
        let study = Study {
            request: Request {
                tolerance: 1e-15,
                progress: Some(progress.clone()),
                ..file.request
            },
            methods: match self.methods.is_empty() {
                true => Family::ALL.to_vec(),
                false => self.methods,
            },
            tolerances: self.tolerances.concat(),
            repeat: self.repeat,
        };
        let measured = patiently(&format!("measuring {}", self.scene), &progress, || {
            scene.accuracy(&study)
        });
        let accuracy = match measured {
            Err(_) if progress.is_stopped() => {
                let reason = "interrupted before there was anything to measure errors against";
                return Err(Trouble::Interrupted(reason.to_owned()));
            }
            measured => {
                measured.map_err(|refusal| Trouble::refused_run(refusal, scene, &study.request))?
            }
        };
        let what = ["run".to_owned(), self.scene.clone()];
        let run = shell::command(what.into_iter().chain(self.motion.arguments()));
        let target = self.target.map(|target| (target, run.as_str()));
        self.output
            .write(|out| write(&accuracy, format, target, out))?;
        let plotted = self.plot.as_deref().map_or(Ok(()), |path| {
            draw(path, &plot::svg(&accuracy).map_err(Trouble::failed)?)
        });
        if progress.is_stopped() {
            let reason = "interrupted; what was measured until then is kept";
            return Err(Trouble::Interrupted(reason.to_owned()));
        }
        // Why no method has a result is also why there is nothing to plot.
        answer::verdict(&accuracy, self.target).map_err(Trouble::failed)?;
        plotted
    }
}

fn write(
    accuracy: &Accuracy,
    format: Format,
    target: Option<(f64, &str)>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let error = target.map(|(error, _)| error);
    match (format, target) {
        (Format::Table, None) => table::write(accuracy, out),
        (Format::Table, Some((error, run))) => answer::write(accuracy, error, run, out),
        (Format::Json, _) => json::write(accuracy, error, out),
        (Format::Csv, _) => csv::write(accuracy, error, out),
    }
}
