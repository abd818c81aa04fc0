//! `lagrange effects`: what each effect of a scene costs.

use super::Trouble;
use super::course::Course;
use super::output::{Output, patiently};
use clap::Args;
use lagrange_problems::cost::Costs;
use lagrange_problems::report::{Format, cost as report};
use std::io::{self, Write};

/// Measure what each effect costs, mode by mode: operations and nanoseconds of a right-hand side, and of a whole run.
#[derive(Args)]
pub(super) struct Effects {
    /// The scene, or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    course: Course,
    #[command(flatten)]
    output: Output,
}

impl Effects {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let file = self.course.of(&self.scene)?;
        let costs = patiently(&format!("measuring {}", file.scene.name()), || {
            file.scene.costs(&file.request)
        })
        .map_err(Trouble::refused)?;
        let format = self.output.format();
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
