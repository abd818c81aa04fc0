//! What was derived, to be read: strings that the derive macro has written at build time.
//!
//! Nothing is printed here and nothing is computed: a program that does not ask for a derivation does not contain it.

use core::fmt;

/// What was derived from a declaration: `println!("{}", MassOnWheel::derivation())`.
///
/// The program `lagrange inspect` and the library `lagrange-engine` make more of [`Self::declaration`]: single modes,
/// Markdown, HTML, JSON, and the emitted Rust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Derivation {
    /// Name of the struct.
    pub name: &'static str,
    /// The struct with its `#[lagrange(…)]`, as tokens; `lagrange_engine::inspect` reads it.
    pub declaration: &'static str,
    /// Everything, as plain text: declaration, energies, equations of motion, constraint rows with their multipliers, each
    /// mode with unknowns, equations and guards, impacts, conserved quantities, operation counts.
    pub text: &'static str,
    /// The same in LaTeX (amsmath), to be `\input`.
    pub latex: &'static str,
    /// The equations of motion in MathML: one `<div>`, with plain text as the title of each.
    pub equations: &'static str,
    /// The graph of the modes, for Mermaid.
    pub graph: &'static str,
}

impl Derivation {
    /// Of a system about which nothing was derived.
    pub const NONE: Derivation = Derivation {
        name: "",
        declaration: "",
        text: "",
        latex: "",
        equations: "",
        graph: "",
    };
}

impl fmt::Display for Derivation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)
    }
}
