//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod derive;
pub mod diagnostics;
pub mod emit;
pub mod interpret;
pub mod model;
pub mod parse;
pub mod plan;
pub mod symbolic;
