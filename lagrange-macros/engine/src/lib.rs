//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod diagnostics;
pub mod derive;
pub mod model;
pub mod symbolic;
