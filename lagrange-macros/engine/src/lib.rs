//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod diagnostics;
pub mod parse;
