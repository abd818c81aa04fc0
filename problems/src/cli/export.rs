//! `lagrange export`: a declaration in a file as a struct of Rust.

use super::Trouble;
use super::output::{ready, to_file};
use clap::Args;
use lagrange_problems::file::{self, ENDING};
use std::path::PathBuf;

/// Write a declaration as Rust: the struct with its derive, and its default values.
///
/// In a crate with lagrange-core rustc compiles its equations, which then run faster, and with other numbers than f64 too.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange export pendulum.lagrange
  lagrange export pendulum.lagrange --output pendulum.rs")]
pub(super) struct Export {
    /// The declaration (….lagrange).
    file: String,
    /// Write the Rust to a file instead of stdout.
    #[arg(long, value_name = "FILE.rs")]
    output: Option<PathBuf>,
}

impl Export {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        if !self.file.ends_with(ENDING) {
            return Err(Trouble::usage(format_args!(
                "{} is no declaration in a file: its name ends in {ENDING}",
                self.file
            )));
        }
        ready(self.output.as_deref(), std::slice::from_ref(&self.file))?;
        let rust = file::read(&self.file).and_then(|text| file::rust(&self.file, &text));
        let rust = rust.map_err(Trouble::usage)?;
        match &self.output {
            None => super::print(|out| out.write_all(rust.as_bytes())),
            Some(path) => to_file(path, |out| out.write_all(rust.as_bytes())),
        }
    }
}
