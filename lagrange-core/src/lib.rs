//! Integrates constrained mechanical systems with contacts and friction.

// The derive macro names this crate by its path, also inside it.
extern crate self as lagrange_core;

pub mod arithmetic;
pub mod checks;
pub mod code;
mod derivation;
pub mod dynamics;
pub mod effects;
mod entries;
pub mod error;
pub mod events;
pub mod handle;
pub mod integrate;
mod linear;
pub mod mode;
mod modes;
mod monitor;
mod pool;
pub mod prelude;
mod run;
pub mod simulation;
pub mod system;
mod tapes;
pub mod trajectory;

pub use derivation::Derivation;
pub use error::Error;
#[cfg(feature = "derive")]
pub use lagrange_macros::Lagrangian;
pub use monitor::Monitor;
pub use run::{Ensemble, Runner};
pub use simulation::{Awaited, Failure, Held, Simulation};
