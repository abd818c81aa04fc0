//! Where results go.

use super::Trouble;
use clap::Args;
use lagrange_problems::report::Format;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What to print, and where to.
#[derive(Args)]
pub(super) struct Output {
    /// What to print [default: table].
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write the result to a file instead of stdout.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Output {
    /// What to print.
    pub(super) fn format(&self) -> Format {
        self.format.unwrap_or(Format::Table)
    }

    /// Takes from a scene file what the command line leaves open.
    pub(super) fn or(&mut self, format: Option<Format>, output: Option<PathBuf>) {
        self.format = self.format.or(format);
        self.output = self.output.take().or(output);
    }

    /// What to print, and where to, as given.
    pub(super) fn given(&self) -> (Option<Format>, Option<PathBuf>) {
        (self.format, self.output.clone())
    }

    /// Writes where the user wants it.
    pub(super) fn write(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Trouble> {
        match &self.output {
            None => super::print(write),
            Some(path) => to_file(path, write),
        }
    }
}

/// Writes a file, at once when all of it is there.
pub(super) fn to_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Trouble> {
    let mut text = Vec::new();
    write(&mut text)
        .and_then(|()| std::fs::write(path, text))
        .map_err(|error| Trouble::failed(format_args!("cannot write {}: {error}", path.display())))
}
