//! `lagrange new`: a declaration to start from, or a crate.

use super::Trouble;
use super::output::{ready, to_file};
use super::shell;
use crate::file::{self, ENDING, TEMPLATE};
use clap::Args;
use std::fs;
use std::path::Path;

/// Write a declaration to start from: a pendulum, with a remark on each line.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange new swing                          swing.lagrange
  lagrange run swing.lagrange
  lagrange new --crate swings                 a folder with a crate: cargo run --release -- run pendulum")]
pub(super) struct New {
    /// Name of the file, whose ending .lagrange may be left out, or of the folder of a crate.
    name: String,
    /// Write a crate in Rust instead, which has all commands for its systems.
    #[arg(long = "crate")]
    in_rust: bool,
}

/// `main.rs` of a crate.
const MAIN: &str = "//! `cargo run --release -- run pendulum` runs the system in `pendulum.rs`; `--help` shows the other commands.

mod pendulum;

use lagrange_program::{Entry, Program};
use pendulum::Pendulum;
use std::process::ExitCode;

fn main() -> ExitCode {
    Program::new()
        .scene(Entry::<Pendulum>::new(\"pendulum\", 10.0))
        .main()
}

#[cfg(test)]
mod tests {
    use super::Pendulum;
    use lagrange_core::prelude::*;

    #[test]
    fn without_friction_the_energy_stays() -> Result<(), Box<dyn std::error::Error>> {
        let pendulum = Pendulum {
            damping: 0.0,
            ..Pendulum::default()
        };
        let run = Simulation::new(&pendulum).run(pendulum.at(Pendulum::RELEASED), 0.0..10.0)?;
        let mut sampler = run.sampler();
        let (start, end) = (sampler.at(0.0)?.energy(), sampler.at(10.0)?.energy());
        assert!((end - start).abs() < 1e-6);
        Ok(())
    }
}
";

impl New {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let name = self.name.strip_suffix(ENDING).unwrap_or(&self.name);
        let Some(last) = Path::new(name).file_name() else {
            return Err(Trouble::usage("it needs a name: lagrange new pendulum"));
        };
        let shown = match self.in_rust {
            true => name.to_owned(),
            false => format!("{name}{ENDING}"),
        };
        if Path::new(&shown).exists() {
            return Err(Trouble::usage(format_args!(
                "{shown} is there already; choose another name"
            )));
        }
        if self.in_rust {
            in_rust(Path::new(name), &package(&last.to_string_lossy()))?;
            return super::print(|out| {
                writeln!(
                    out,
                    "{shown} is written; in it: cargo run --release -- run pendulum, and cargo test"
                )
            });
        }
        ready(Some(Path::new(&shown)), &[])?;
        to_file(Path::new(&shown), |out| out.write_all(TEMPLATE.as_bytes()))?;
        // A name with a dash in front would be an option.
        let file = match shown.starts_with('-') {
            true => format!("./{shown}"),
            false => shown.clone(),
        };
        let command = shell::command(["run".to_owned(), file]);
        super::print(|out| writeln!(out, "{shown} is written; run it: {command}"))
    }
}

/// Writes a crate that stands on the sources that this program was built from.
fn in_rust(folder: &Path, package: &str) -> Result<(), Trouble> {
    let program = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = program.ancestors().nth(2).unwrap_or(program);
    let core = root.join("lagrange-core");
    if !core.is_dir() {
        return Err(Trouble::failed(format_args!(
            "the sources of lagrange are no longer at {}; build the program again",
            core.display()
        )));
    }
    let cargo = format!(
        "[package]\nname = \"{package}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\n\
         lagrange-core = {{ path = {core:?} }}\n\
         # With `default-features = false` it is built in less time, and its pictures are SVG alone.\n\
         lagrange-program = {{ path = {program:?} }}\n\n[workspace]\n"
    );
    let pendulum = file::export("pendulum.lagrange", TEMPLATE).map_err(Trouble::failed)?;
    let sources = folder.join("src");
    fs::create_dir_all(&sources).map_err(|error| {
        Trouble::failed(format_args!("cannot make {}: {error}", sources.display()))
    })?;
    for (path, text) in [
        (folder.join("Cargo.toml"), cargo.as_str()),
        (sources.join("main.rs"), MAIN),
        (sources.join("pendulum.rs"), &pendulum.rust),
    ] {
        to_file(&path, |out| out.write_all(text.as_bytes()))?;
    }
    Ok(())
}

/// A name that cargo takes beside those of the crates that it stands on.
fn package(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    let name: String = name.chars().map(plain).collect();
    match name.starts_with(|c: char| c.is_ascii_alphabetic()) && !name.starts_with("lagrange-") {
        true => name,
        false => format!("crate-{name}"),
    }
}
