//! Printers of derivations. Each is a fold over the same data; none looks at an expression again.

pub mod latex;
pub mod mathml;
pub mod notation;
mod plain;
pub mod text;

pub use plain::plain;
