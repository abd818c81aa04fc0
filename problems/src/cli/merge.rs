//! `lagrange merge`: the parts of a sweep, from wherever they were done, to what one machine would have written.

use super::Trouble;
use super::results::{Results, verdict};
use clap::Args;
use lagrange_problems::sweep::Journal;
use std::path::PathBuf;

/// Put the parts of a sweep together that were done with --shard. The result is the same byte for byte as without.
#[derive(Args)]
pub(super) struct Merge {
    /// The folders of the parts (FILE.part), in any order; they stay as they are.
    #[arg(required = true, value_name = "FILE.part")]
    folders: Vec<PathBuf>,
    #[command(flatten)]
    results: Results,
}

impl Merge {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let (sweep, journal) = Journal::gather(&self.folders).map_err(Trouble::failed)?;
        verdict(&self.results.write(&sweep, &journal)?)
    }
}
