//! What is made of a sweep that is complete: a file with a line per run, a picture, a few numbers.

use super::Trouble;
use super::output::draw;
use super::values::picture;
use crate::format::Format;
use crate::report::sweep as report;
use crate::sweep::{Journal, Summary, Sweep};
use clap::Args;
use std::fs::{self, File};
use std::io::{BufWriter, Error};
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(next_help_heading = "Results")]
pub(super) struct Results {
    /// Write a line per run, as Parquet (….parquet) or CSV (….csv).
    #[arg(long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Draw into a file ….svg, ….png or ….pdf: all observations over one axis, a map of the first over two, points of a sample.
    #[arg(long, value_name = "FILE", value_parser = picture)]
    plot: Option<PathBuf>,
    /// In what form to print what came out, in a few numbers; csv: a line per run.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

impl Results {
    /// Refuses what could not be written, before anything is run.
    pub(super) fn check(&self) -> Result<(), Trouble> {
        let ending = |path: &PathBuf| path.extension().and_then(|e| e.to_str()).map(str::to_owned);
        if let Some(path) = &self.output
            && !matches!(ending(path).as_deref(), Some("csv" | "parquet"))
        {
            let path = path.display();
            return Err(Trouble::usage(format_args!(
                "cannot tell the format of {path}; name it ….parquet or ….csv"
            )));
        }
        Ok(())
    }

    /// What is written.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        [&self.output, &self.plot]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    }

    /// Refuses what could not be drawn.
    pub(super) fn check_picture(&self, sweep: &Sweep) -> Result<(), Trouble> {
        match self.plot {
            Some(_) => report::drawable(sweep).map_err(Trouble::usage),
            None => Ok(()),
        }
    }

    /// Writes and prints them. What is to be said against them when all is written: every run failed, or none has what is to be drawn. Other runs that failed are
    /// part of the results.
    pub(super) fn write(
        &self,
        sweep: &Sweep,
        journal: &Journal,
    ) -> Result<Option<&'static str>, Trouble> {
        let summary = Summary::new(sweep, journal).map_err(Trouble::failed)?;
        if let Some(path) = &self.output {
            lines(path, sweep, journal)?;
        }
        let mut complaint = (summary.failures() == summary.runs).then_some("every run failed");
        if let Some(path) = &self.plot {
            match report::svg(sweep, journal).map_err(Trouble::failed)? {
                Some(picture) => draw(path, &picture)?,
                None => {
                    complaint
                        .get_or_insert("there is nothing to draw: no run has what was observed");
                }
            }
        }
        super::print(|out| match self.format {
            Format::Table => report::table(sweep, &summary, out),
            Format::Json => report::json(sweep, &summary, out),
            Format::Csv => report::csv(sweep, journal, out).map_err(Error::other),
        })?;
        Ok(complaint)
    }
}

/// Ends with what is said against the results, if there is something.
pub(super) fn verdict(complaint: Option<&'static str>) -> Result<(), Trouble> {
    complaint.map_or(Ok(()), |words| Err(Trouble::failed(words)))
}

/// The name of a file with something added.
pub(super) fn beside(path: &Path, addition: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(addition);
    PathBuf::from(name)
}

/// Writes a line per run. The file is there whole, or not at all.
fn lines(path: &Path, sweep: &Sweep, journal: &Journal) -> Result<(), Trouble> {
    let cannot = |error: &dyn std::fmt::Display| {
        Trouble::failed(format_args!("cannot write {}: {error}", path.display()))
    };
    let unfinished = beside(path, ".unfinished");
    let written = || -> Result<(), report::Failure> {
        let file = File::create(&unfinished)?;
        let out = BufWriter::new(&file);
        match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => report::csv(sweep, journal, out)?,
            _ => report::parquet(sweep, journal, out)?,
        }
        // What it was made from is removed next.
        file.sync_all()?;
        Ok(fs::rename(&unfinished, path)?)
    };
    written().map_err(|error| {
        let _ = fs::remove_file(&unfinished);
        cannot(&error)
    })
}
