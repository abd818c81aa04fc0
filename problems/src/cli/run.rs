//! `lagrange run`: one scene, from a start to its end.

use super::Trouble;
use super::course::Course;
use super::output::{Output, patiently, to_file};
use clap::Args;
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
    #[command(flatten)]
    output: Output,
    /// Draw forces and state over time.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Give the work of every item over time (csv: columns, json: a list).
    #[arg(long)]
    ledger: bool,
    /// Write this run down as a scene file.
    #[arg(long, value_name = "FILE.toml")]
    save: Option<PathBuf>,
}

impl Run {
    pub(super) fn execute(mut self) -> Result<(), Trouble> {
        let file = self.course.of(&self.scene)?;
        let (scene, name) = (file.scene, file.scene.name());
        self.output.or(file.outputs.format, file.outputs.output);
        let plot = self.plot.or(file.outputs.plot);
        let format = self.output.format();
        let sampled = plot.is_some() || format == Format::Csv || self.ledger;
        let request = Request {
            samples: if sampled { SAMPLES } else { 0 },
            ledger: self.ledger || file.request.ledger,
            ..file.request
        };
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
