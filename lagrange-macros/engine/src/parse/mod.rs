//! Tokens → [`Declaration`]. The only place that reads tokens.
//!
//! An attribute is cut at its commas into parts, each part is read on its own, so that a mistake in one does not
//! hide those in the others. If there is any mistake there is no declaration: later stages never guess.

mod cursor;
mod expression;
mod file;
mod glimpse;
mod item;
mod leftover;
mod number;
mod relation;
mod structure;
#[cfg(test)]
mod tests;
mod words;

use crate::ast::Declaration;
use crate::diagnostics::Diagnostics;
use proc_macro2::TokenStream;

pub use file::{File, file, lone_expression};
pub use glimpse::{Glimpse, glimpse};
pub use words::{DEGREES, FUNCTIONS, KEYWORDS, is_degree};

/// Reads a struct with its `#[lagrange(…)]` attributes; mistakes go to the sink.
pub fn declaration(input: TokenStream, sink: &mut Diagnostics) -> Option<Declaration> {
    let before = sink.count();
    let declaration = structure::declaration(input, sink)?;
    (sink.count() == before).then_some(declaration)
}
