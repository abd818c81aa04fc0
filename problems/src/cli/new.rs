//! `lagrange new`: a declaration to start from.

use super::Trouble;
use super::output::to_file;
use clap::Args;
use lagrange_problems::file::{ENDING, TEMPLATE};
use std::path::{Path, PathBuf};

/// Write a declaration to start from: a pendulum, with a remark on each line.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange new swing                          swing.lagrange
  lagrange run swing.lagrange")]
pub(super) struct New {
    /// Name of the file; the ending .lagrange may be left out.
    name: String,
}

impl New {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let name = self.name.strip_suffix(ENDING).unwrap_or(&self.name);
        let path = PathBuf::from(format!("{name}{ENDING}"));
        let shown = path.display();
        if Path::new(name).file_name().is_none() {
            return Err(Trouble::usage("a file needs a name: lagrange new pendulum"));
        }
        if path.exists() {
            return Err(Trouble::usage(format_args!(
                "{shown} is there already; choose another name"
            )));
        }
        to_file(&path, |out| out.write_all(TEMPLATE.as_bytes()))?;
        super::print(|out| writeln!(out, "{shown} is written; run it: lagrange run {shown}"))
    }
}
