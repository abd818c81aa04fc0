//! `lagrange modes`: in which modes the motion can go on.

use super::Trouble;
use super::output::{Output, ready};
use super::run_args::RunArgs;
use super::values::not_negative;
use crate::catalogue::Catalogue;
use crate::feasible::Feasible;
use crate::format::Format;
use crate::report::modes as report;
use clap::Args;
use std::io::{self, Write};

/// List all modes in which the motion can go on, with their forces and accelerations.
///
/// At the start of a run, or at a later time of it. Where there are several, a run takes the first. Where contacts are hit at that
/// instant, modes are those after the impact.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange modes painleve-rod --set mu=1.6 --set rate=5
  lagrange modes mass-on-wheel --at 0.3 --format json

Exit codes: 0 there are modes, 1 there is none or the run failed, 2 the request makes no sense.")]
pub(super) struct Modes {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    /// Time of the run, s [default: its start].
    #[arg(long, value_name = "T", value_parser = not_negative, allow_hyphen_values = true)]
    at: Option<f64>,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    output: Output,
}

impl Modes {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let file = self.run.of(&self.scene, catalogue)?;
        let format = self.output.format()?;
        ready(self.output.path(), std::slice::from_ref(&self.scene))?;
        let found = file.scene.modes(&file.request, self.at);
        let found =
            found.map_err(|refusal| Trouble::refused_run(refusal, file.scene, &file.request))?;
        self.output.write(|out| write(&found, format, out))
    }
}

fn write(found: &Feasible, format: Format, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => report::table(found, out),
        Format::Json => report::json(found, out),
        Format::Csv => report::csv(found, out),
    }
}
