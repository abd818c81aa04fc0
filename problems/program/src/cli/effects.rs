//! `lagrange effects`: what each effect of a scene costs.

use super::Trouble;
use super::output::{Output, ready};
use super::run_args::RunArgs;
use super::terminal::patiently;
use crate::catalogue::Catalogue;
use crate::cost::Costs;
use crate::format::Format;
use crate::progress::Progress;
use crate::report::cost as report;
use crate::request::Request;
use clap::Args;
use std::io::{self, Write};

/// Measure what each effect costs, mode by mode.
///
/// Operations and nanoseconds of a right-hand side, with and without each item that can be left out, and of a whole run.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange effects mass-on-wheel
  lagrange effects mass-on-wheel --without floor --format json")]
pub(super) struct Effects {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    output: Output,
}

impl Effects {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let file = self.run.of(&self.scene, catalogue)?;
        let format = self.output.format()?;
        ready(self.output.path(), std::slice::from_ref(&self.scene))?;
        let progress = Progress::default();
        let request = Request {
            progress: Some(progress.clone()),
            ..file.request
        };
        let costs = patiently(
            &format!("measuring {}", file.scene.name()),
            &progress,
            || file.scene.costs(&request),
        )
        .map_err(|refusal| Trouble::refused_run(refusal, file.scene, &request))?;
        self.output.write(|out| write(&costs, format, out))
    }
}

fn write(costs: &Costs, format: Format, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => report::table(costs, out),
        Format::Json => report::json(costs, out),
        Format::Csv => report::csv(costs, out),
    }
}
