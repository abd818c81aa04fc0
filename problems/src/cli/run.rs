//! `lagrange run`: one scene, from a start to its end.

use super::Trouble;
use super::course::{Course, scene};
use super::output::{Output, patiently, to_file};
use super::values::positive;
use clap::Args;
use lagrange_core::prelude::{Impacts, Method};
use lagrange_problems::outcome::Outcome;
use lagrange_problems::report::{Format, csv, json, plot, table};
use lagrange_problems::request::Request;
use lagrange_problems::scene_file::{self, Outputs};
use std::io::{self, Write};
use std::path::PathBuf;

/// Intervals at which tables of numbers and pictures sample a trajectory.
const SAMPLES: usize = 400;

/// Run a scene and tell what happened.
#[derive(Args)]
pub(super) struct Run {
    /// The scene, or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    course: Course,
    /// Tolerance of the integration, relative and absolute [default: 1e-9].
    #[arg(long, value_name = "X", value_parser = positive, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Method of integration [default: taylor].
    #[arg(long, value_name = "M")]
    method: Option<Method>,
    #[command(flatten)]
    output: Output,
    /// Draw forces and state over time.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Give the work of every item over time (csv: columns, json: a list).
    #[arg(long)]
    ledger: bool,
    /// Move a start that violates a constraint onto it instead of refusing it.
    #[arg(long)]
    project: bool,
    /// How impacts at one instant are solved, instead of as the scene declares: `together` or `in_turn`.
    #[arg(long, value_name = "HOW")]
    impacts: Option<Impacts>,
    /// Write this run down as a scene file.
    #[arg(long, value_name = "FILE.toml")]
    save: Option<PathBuf>,
}

impl Run {
    pub(super) fn execute(mut self) -> Result<(), Trouble> {
        let file = scene(&self.scene)?;
        let (scene, name) = (file.scene, file.scene.name());
        self.output.or(file.outputs.format, file.outputs.output);
        let plot = self.plot.or(file.outputs.plot);
        let format = self.output.format();
        let sampled = plot.is_some() || format == Format::Csv || self.ledger;
        let base = Request {
            samples: if sampled { SAMPLES } else { 0 },
            tolerance: self.tolerance.unwrap_or(file.request.tolerance),
            method: self.method.unwrap_or(file.request.method),
            project: self.project || file.request.project,
            impacts: self.impacts.or(file.request.impacts),
            ledger: self.ledger || file.request.ledger,
            ..file.request
        };
        let request = self.course.request(base);
        let outcome = patiently(&format!("running {name}"), || scene.run(&request))
            .map_err(Trouble::refused)?;
        if let Some(path) = &self.save {
            let (format, output) = self.output.given();
            let outputs = Outputs {
                format,
                output,
                plot: plot.clone(),
            };
            let text = scene_file::write(scene, &request, &outputs).map_err(Trouble::failed)?;
            to_file(path, |out| out.write_all(text.as_bytes()))?;
        }
        self.output.write(|out| write(&outcome, format, out))?;
        if let Some(path) = &plot {
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
