//! Where results go.

use super::Trouble;
use crate::format::{Format, Still};
use crate::results::{self, PLOTS};
use clap::Args;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What to print, and where to.
#[derive(Args)]
#[command(next_help_heading = "Results")]
pub(super) struct Output {
    /// What to print [default: what the name of the output says, else table].
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write the result to a file (….csv, ….json, ….txt) instead of stdout, which is `-`.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Output {
    /// What to print.
    pub(super) fn format(&self) -> Result<Format, Trouble> {
        match (self.format, &self.output) {
            (Some(format), _) => Ok(format),
            (None, Some(path)) => Format::named(path).map_err(Trouble::usage),
            (None, None) => Ok(Format::Table),
        }
    }

    /// The file, if it goes into one.
    pub(super) fn path(&self) -> Option<&Path> {
        file(self.output.as_deref())
    }

    /// Writes where the user wants it.
    pub(super) fn write(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Trouble> {
        put(self.path(), write)
    }
}

/// The file that an output names; `-` is stdout.
pub(super) fn file(output: Option<&Path>) -> Option<&Path> {
    output.filter(|path| *path != Path::new("-"))
}

/// Writes into a file or, without one, to stdout.
pub(super) fn put(
    path: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Trouble> {
    match path {
        None => super::print(write),
        Some(path) => to_file(path, write),
    }
}

/// Refuses, before any work is done, what could not be written when it is: outputs in folders that are not there or not
/// writable, one in the place of another, and those in the place of an input.
pub(super) fn ready<'a>(
    outputs: impl IntoIterator<Item = &'a Path>,
    inputs: &[String],
) -> Result<(), Trouble> {
    let place = |path: &Path| fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let inputs: Vec<PathBuf> = inputs.iter().map(|name| place(Path::new(name))).collect();
    let mut seen = Vec::new();
    for output in outputs {
        let (here, shown) = (place(output), output.display());
        // What is not there yet cannot be an input.
        if here.is_file() && inputs.contains(&here) {
            return Err(Trouble::usage(format_args!(
                "{shown} is the scene file itself; choose another name for the output"
            )));
        }
        if here.extension().is_some() && seen.contains(&here) {
            return Err(Trouble::usage(format_args!(
                "two results would go to {shown}; give each its own name"
            )));
        }
        writable(output)
            .map_err(|why| Trouble::failed(format_args!("cannot write {shown}: {why}")))?;
        seen.push(here);
    }
    Ok(())
}

fn writable(path: &Path) -> Result<(), String> {
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        let folder = folder.display();
        return Err(format!("there is no folder {folder}; make it first"));
    }
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => Err("it is a folder".to_owned()),
        Ok(there) if there.is_file() => {
            let opened = OpenOptions::new().append(true).open(path);
            opened.map(drop).map_err(|error| error.to_string())
        }
        // A device or a pipe.
        Ok(_) => Ok(()),
        // A file without a name is tried: a process that is killed here leaves nothing that looks like a result.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let tried = tempfile::tempfile_in(folder.unwrap_or(Path::new(".")));
            tried.map(drop).map_err(|error| error.to_string())
        }
        Err(error) => Err(error.to_string()),
    }
}

/// Writes a file, at once when all of it is there.
pub(super) fn to_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Trouble> {
    results::to_file(path, write).map_err(Trouble::failed)
}

/// Draws a picture into a file of a kind that its name says.
pub(super) fn draw(path: &Path, svg: &str) -> Result<(), Trouble> {
    let still = Still::of(path).map_err(Trouble::usage)?;
    to_file(path, |out| still.write(svg, PLOTS, out))
}
