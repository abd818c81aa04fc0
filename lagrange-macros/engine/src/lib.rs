//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod diagnostics;
pub mod model;
pub mod parse;
pub mod symbolic;
