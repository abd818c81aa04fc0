//! `lagrange stability`: hard cases, each against an answer known by other means.

use super::Trouble;
use super::output::{Output, ready};
use super::terminal::{keep_what_is_done, patiently};
use crate::catalogue::Catalogue;
use crate::format::Format;
use crate::progress::Progress;
use crate::report::stability as report;
use crate::request::Refusal;
use crate::stability::{Case, Extent, Report};
use clap::Args;
use std::io::{self, Write};

/// Run the hard cases, each against a known answer.
///
/// What breaks other programs, how far from the known answer each ends here, and whether it keeps its bound.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange stability
  lagrange stability --only ladder,turntable --format json
  lagrange stability --long                    ten times as long

Ctrl-C ends it after the case in hand; those before are shown.")]
pub(super) struct Stability {
    /// Only these cases.
    #[arg(long, value_name = "CASE,…", value_delimiter = ',')]
    only: Vec<String>,
    /// Run the endurance cases ten times as long: a hundred thousand periods.
    #[arg(long)]
    long: bool,
    #[command(flatten)]
    output: Output,
}

impl Stability {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let cases = self.cases(catalogue.cases)?;
        let format = self.output.format()?;
        ready(self.output.path(), &[])?;
        let extent = match self.long {
            true => Extent::Long,
            false => Extent::Short,
        };
        let (progress, all) = (Progress::default(), cases.len());
        progress.expect(all);
        keep_what_is_done(&progress);
        let reports: Vec<Report> = patiently("running the hard cases", &progress, || {
            let wanted = cases.into_iter().take_while(|_| !progress.is_stopped());
            let run = |case: &'static Case| {
                let report = case.run(extent);
                progress.advance(1);
                report
            };
            wanted.map(run).collect()
        });
        self.output.write(|out| write(&reports, format, out))?;
        if reports.len() < all {
            return Err(Trouble::Interrupted(format!(
                "interrupted after {} of {all} cases",
                reports.len()
            )));
        }
        let failing = reports.iter().filter(|report| !report.holds());
        let names: Vec<&str> = failing.map(|report| report.case.name).collect();
        match names[..] {
            [] => Ok(()),
            _ => Err(Trouble::failed(format_args!(
                "outside its bounds: {}",
                names.join(", ")
            ))),
        }
    }

    /// The cases asked for, in the order of the table.
    fn cases(&self, all: &'static [Case]) -> Result<Vec<&'static Case>, Trouble> {
        if all.is_empty() {
            return Err(Trouble::usage("this program has no hard cases"));
        }
        let known = |name: &String| all.iter().any(|case| case.name == name);
        if let Some(name) = self.only.iter().find(|name| !known(name)) {
            let names = all.iter().map(|case| case.name);
            return Err(Trouble::usage(Refusal::unknown("case", name, names)));
        }
        let asked = |case: &&Case| self.only.is_empty() || self.only.iter().any(|n| n == case.name);
        Ok(all.iter().filter(asked).collect())
    }
}

fn write(reports: &[Report], format: Format, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => report::table(reports, out),
        Format::Json => report::json(reports, out),
        Format::Csv => report::csv(reports, out),
    }
}
