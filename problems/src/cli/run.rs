//! `lagrange run`: one scene, from a start to its end.

use super::Trouble;
use super::course::Course;
use super::output::{Format, Output, patiently, to_file};
use super::values::positive;
use clap::Args;
use lagrange_core::prelude::Method;
use lagrange_problems::catalogue::find;
use lagrange_problems::outcome::Outcome;
use lagrange_problems::report::{csv, json, plot, table};
use lagrange_problems::request::Request;
use std::io::{self, Write};
use std::path::PathBuf;

/// Intervals at which tables of numbers and pictures sample a trajectory.
const SAMPLES: usize = 400;

/// Run a scene and tell what happened.
#[derive(Args)]
pub(super) struct Run {
    /// The scene; `lagrange list` shows them.
    scene: String,
    #[command(flatten)]
    course: Course,
    /// Tolerance of the integration, relative and absolute.
    #[arg(long, value_name = "X", default_value = "1e-9", value_parser = positive, allow_hyphen_values = true)]
    tolerance: f64,
    /// Method of integration.
    #[arg(long, value_name = "M", default_value_t = Method::Taylor)]
    method: Method,
    #[command(flatten)]
    output: Output,
    /// Draw forces and state over time.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Move a start that violates a constraint onto it instead of refusing it.
    #[arg(long)]
    project: bool,
}

impl Run {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let scene = find(&self.scene).map_err(Trouble::usage)?;
        let sampled = self.plot.is_some() || self.output.format == Format::Csv;
        let request = Request {
            samples: if sampled { SAMPLES } else { 0 },
            tolerance: self.tolerance,
            method: self.method,
            project: self.project,
            ..self.course.request()
        };
        let outcome = patiently(&format!("running {}", self.scene), || scene.run(&request))
            .map_err(Trouble::refused)?;
        let format = self.output.format;
        self.output.write(|out| write(&outcome, format, out))?;
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
