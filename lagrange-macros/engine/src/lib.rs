//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.
pub mod symbolic;
