//! `lagrange inspect`: what was derived from a scene's declaration.

use super::Trouble;
use super::output::{ready, to_file};
use super::run_args::scene;
use crate::catalogue::Catalogue;
use crate::file::ENDING;
use crate::names::nearest;
use clap::{Args, ValueEnum};
use lagrange_engine::inspect::{Derivation, print};
use std::path::PathBuf;

/// Show what was derived from a scene.
///
/// Energies, equations of motion, constraints with their multipliers, every mode with its unknowns, guards and resets, what is
/// conserved, and what it costs.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange inspect mass-on-wheel
  lagrange inspect mass-on-wheel --mode \"rim closed, grip sticks\"
  lagrange inspect mass-on-wheel --format latex --output wheel.tex")]
pub(super) struct Inspect {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    /// How to write it.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Only this mode, "rim closed, grip sticks".
    #[arg(long, value_name = "MODE")]
    mode: Option<String>,
    /// Write the result to a file instead of stdout.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// To read.
    Text,
    /// For a document with amsmath.
    Latex,
    /// HTML with MathML.
    Mathml,
    /// With formulas and a graph that GitHub shows.
    Markdown,
    /// The Rust that the derive macro emits.
    Rust,
    /// The modes as a Mermaid graph.
    Graph,
    /// The modes as a Graphviz graph.
    Dot,
    /// Everything, for programs.
    Json,
}

/// What is said of the Rust for a declaration in a file.
const INTERPRETED: &str = "// What the derive macro emits for this declaration. A run of a file interprets the same operations;\n\
     // `lagrange export` writes the system for the macro.";

impl Inspect {
    pub(super) fn execute(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let scene = scene(&self.scene, catalogue)?.scene;
        ready(self.output.as_deref(), &[])?;
        let declaration = scene.derivation().declaration;
        let tokens: proc_macro2::TokenStream = declaration.parse().map_err(Trouble::failed)?;
        let text = match (self.format, &self.mode) {
            (Format::Rust, None) => {
                let text = lagrange_engine::readable(tokens);
                match scene.name().ends_with(ENDING) {
                    true => format!("{INTERPRETED}\n{text}"),
                    false => text,
                }
            }
            (Format::Rust, Some(_)) => {
                return Err(Trouble::usage(
                    "the emitted Rust serves all modes; leave out `--mode`",
                ));
            }
            (format, mode) => {
                let derivation = lagrange_engine::inspect(tokens, mode.as_deref())
                    .map_err(|refusal| self.refused(refusal))?;
                written(&derivation, format)
            }
        };
        match &self.output {
            None => super::print(|out| out.write_all(text.as_bytes())),
            Some(path) => to_file(path, |out| out.write_all(text.as_bytes())),
        }
    }

    /// A mode that is not there, with those that agree with all that it says, or the nearest one.
    fn refused(&self, refusal: lagrange_engine::Refusal) -> Trouble {
        let lagrange_engine::Refusal::Mode(unknown) = &refusal else {
            return Trouble::failed(refusal);
        };
        let known: Vec<&str> = unknown.known.iter().map(String::as_str).collect();
        let parts = |mode: &str| -> Vec<String> {
            let parts = mode.split(',').map(|part| part.trim().to_owned());
            parts.collect()
        };
        let asked = parts(&unknown.name);
        let agrees = |mode: &&&str| {
            let said = parts(mode);
            asked.iter().all(|part| said.contains(part))
        };
        let agree: Vec<String> = known
            .iter()
            .filter(agrees)
            .map(|mode| format!("`{mode}`"))
            .collect();
        if !agree.is_empty() {
            return Trouble::usage(format_args!(
                "`{}` is not all of a mode; with that there are {}",
                unknown.name,
                agree.join(", ")
            ));
        }
        match nearest(&unknown.name, &known) {
            Some(near) => Trouble::usage(format_args!(
                "no mode is called `{}`; did you mean `{near}`?",
                unknown.name
            )),
            None => Trouble::usage(unknown),
        }
    }
}

fn written(derivation: &Derivation, format: Format) -> String {
    match format {
        Format::Latex => print::paper(derivation),
        Format::Mathml => print::page(derivation),
        Format::Markdown => print::markdown(derivation),
        Format::Graph => print::mermaid(derivation),
        Format::Dot => print::dot(derivation),
        Format::Json => print::json(derivation),
        Format::Text | Format::Rust => print::plain(derivation),
    }
}
