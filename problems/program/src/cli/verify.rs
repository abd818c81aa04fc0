//! `lagrange verify`: a run checked against its declaration.

use super::output::{Output, ready};
use super::run_args::RunArgs;
use super::terminal::{keep_what_is_done, patiently};
use super::values::whole;
use super::{Trouble, went_well};
use crate::catalogue::Catalogue;
use crate::format::Format;
use crate::outcome::Outcome;
use crate::progress::Progress;
use crate::report::certificate as report;
use crate::request::Request;
use crate::scene::RUN_STAGES;
use clap::Args;
use std::io::{self, Write};

/// Run a scene and check the run against its declaration.
///
/// Energies, gaps, slips and forces are evaluated as they were declared, without anything that was derived: the balance of
/// forces, constraints, contacts, frictions, impacts, stops and marks, each with a figure and its bound.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange verify mass-on-wheel
  lagrange verify mass-on-wheel --tolerance 1e-12 --method dop853
  lagrange verify mass-on-wheel --set mu_static=0.8 --seed 7 --format json

Exit codes: 0 every check is within its bound, 1 one is not or the run failed, 2 the request makes no sense.")]
pub(super) struct Verify {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    run: RunArgs,
    /// Seed of the instants that are looked at.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<u64>, allow_hyphen_values = true)]
    seed: u64,
    #[command(flatten)]
    output: Output,
}

impl Verify {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let file = self.run.of(&self.scene, catalogue)?;
        let format = self.output.format()?;
        ready(self.output.path(), std::slice::from_ref(&self.scene))?;
        let progress = Progress::default();
        progress.expect(RUN_STAGES);
        let request = Request {
            samples: 0,
            seed: self.seed,
            certified: 1.0,
            progress: Some(progress.clone()),
            ..file.request
        };
        keep_what_is_done(&progress);
        let words = format!("verifying {}", file.scene.name());
        let outcome = patiently(&words, &progress, || file.scene.run(&request));
        let outcome =
            outcome.map_err(|refusal| Trouble::refused_run(refusal, file.scene, &request))?;
        self.output.write(|out| write(&outcome, format, out))?;
        went_well(outcome, file.scene, &request)
    }
}

fn write(outcome: &Outcome, format: Format, out: &mut dyn Write) -> io::Result<()> {
    let Some(certificate) = &outcome.certificate else {
        return Ok(());
    };
    match format {
        Format::Table => report::table(certificate, out),
        Format::Json => report::json(certificate, out),
        Format::Csv => report::csv(certificate, out),
    }
}
