//! `lagrange merge`: the parts of a sweep, from wherever they were done, to what one machine would have written.

use super::Trouble;
use super::output::ready;
use super::results::{Results, verdict};
use crate::catalogue::Catalogue;
use crate::sweep::Journal;
use clap::Args;
use std::path::PathBuf;

/// Put the parts of a sweep together that were done with --shard. The result is the same byte for byte as without.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange sweep ladder --vary length=1..9:3000 --observe t --output one.csv --shard 1/2
  lagrange sweep ladder --vary length=1..9:3000 --observe t --output two.csv --shard 2/2
  lagrange merge one.csv.part two.csv.part --output both.csv

Parts that are missing are named, and nothing is written then.")]
pub(super) struct Merge {
    /// The folders of the parts (FILE.part), in any order; they stay as they are.
    #[arg(required = true, value_name = "FILE.part")]
    folders: Vec<PathBuf>,
    #[command(flatten)]
    results: Results,
}

impl Merge {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        self.results.check()?;
        ready(self.results.files(), &[])?;
        let (sweep, journal) =
            Journal::gather(&self.folders, catalogue).map_err(Trouble::failed)?;
        verdict(self.results.write(&sweep, &journal)?)
    }
}
