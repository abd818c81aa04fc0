//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod derive;
pub mod diagnostics;
pub mod model;
pub mod symbolic;
