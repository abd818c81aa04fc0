//! Printers of derivations. Each is a fold over the same data; none looks at an expression again.

mod diagram;
mod json;
pub mod latex;
mod markdown;
pub mod mathml;
pub mod notation;
mod page;
mod paper;
mod plain;
pub mod text;

pub use diagram::{dot, mermaid};
pub use json::json;
pub use markdown::markdown;
pub use page::{equations, page, said, titled};
pub use paper::paper;
pub use plain::{brief, plain};
