//! `lagrange inspect`: what was derived from a scene's declaration.

use super::Trouble;
use super::output::{file, put, ready};
use super::run_args::scene;
use crate::catalogue::Catalogue;
use crate::file::{ENDING, export, read};
use crate::format::named;
use crate::names::nearest;
use clap::{Args, ValueEnum};
use lagrange_engine::inspect::{Derivation, print};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Show what was derived from a scene.
///
/// Energies, equations of motion, constraints with their multipliers, every mode with its unknowns, guards and resets, what is
/// conserved, and what it costs.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange inspect mass-on-wheel
  lagrange inspect mass-on-wheel --mode \"rim closed, grip sticks\"
  lagrange inspect mass-on-wheel --output wheel.tex")]
pub(super) struct Inspect {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    /// How to write it [default: what the name of the output says, else text].
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Only this mode, "rim closed, grip sticks".
    #[arg(long, value_name = "MODE")]
    mode: Option<String>,
    /// Write the result to a file instead of stdout, in the format that its name says: ….txt, ….tex, ….html, ….md, ….rs, ….mmd, ….dot,
    /// ….json. `-` is stdout.
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

impl Format {
    /// The format that the ending of a file's name says, if it says one.
    fn of(ending: &str) -> Option<Self> {
        Some(match ending {
            "txt" => Format::Text,
            "tex" => Format::Latex,
            "html" | "htm" => Format::Mathml,
            "md" => Format::Markdown,
            "rs" => Format::Rust,
            "mmd" => Format::Graph,
            "dot" | "gv" => Format::Dot,
            "json" => Format::Json,
            _ => return None,
        })
    }
}

/// What is said of the Rust for a declaration in a file.
const INTERPRETED: &str = "// What the derive macro emits for this declaration. A run of a file interprets the same operations;\n\
     // `lagrange export` writes the system for the macro.";

impl Inspect {
    pub(super) fn execute(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let scene = scene(&self.scene, catalogue)?.scene;
        let path = file(self.output.as_deref());
        let format = self.format()?;
        ready(path, &[])?;
        let declaration = scene.derivation().declaration;
        let tokens: proc_macro2::TokenStream = declaration.parse().map_err(Trouble::failed)?;
        let text = match (format, &self.mode) {
            (Format::Rust, None) => {
                let (path, text) = (scene.name(), lagrange_engine::readable(tokens));
                match path.ends_with(ENDING) {
                    true => {
                        // Names that would become one constant are told where they stand.
                        let exported = read(path).and_then(|text| export(path, &text));
                        exported.map_err(Trouble::usage)?;
                        format!("{INTERPRETED}\n{text}")
                    }
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
        put(path, |out| out.write_all(text.as_bytes()))
    }

    /// What to write.
    fn format(&self) -> Result<Format, Trouble> {
        match (self.format, &self.output) {
            (Some(format), _) => Ok(format),
            (None, Some(path)) => {
                let endings = ".txt, .tex, .html, .md, .rs, .mmd, .dot or .json";
                named(path, Format::Text, Format::of, endings).map_err(Trouble::usage)
            }
            (None, None) => Ok(Format::Text),
        }
    }

    /// A mode that is not there, with those that agree with all that it says, or with what it seems to say.
    fn refused(&self, refusal: lagrange_engine::Refusal) -> Trouble {
        let lagrange_engine::Refusal::Mode(unknown) = &refusal else {
            return Trouble::failed(refusal);
        };
        let parts =
            |mode: &'_ String| -> Vec<String> { mode.split(", ").map(str::to_owned).collect() };
        let agree = |said: &[String]| -> Vec<String> {
            let known = unknown.known.iter();
            let agree = known.filter(|mode| said.iter().all(|part| parts(mode).contains(part)));
            agree.map(|mode| format!("`{mode}`")).collect()
        };
        let agreeing = agree(&unknown.said);
        if !agreeing.is_empty() {
            return Trouble::usage(format_args!(
                "`{}` is not all of a mode; with that there are {}",
                unknown.name,
                agreeing.join(", ")
            ));
        }
        // What is written right stands in the mode that is suggested.
        let known: BTreeSet<String> = unknown.known.iter().flat_map(parts).collect();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let meant = unknown
            .said
            .iter()
            .map(|part| match known.contains(&part.as_str()) {
                true => Some(part.clone()),
                false => nearest(part, &known).map(str::to_owned),
            });
        let meant: Option<Vec<String>> = meant.collect();
        match meant.and_then(|meant| agree(&meant).into_iter().next()) {
            Some(near) => Trouble::usage(format_args!(
                "no mode is called `{}`; did you mean {near}?",
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
