//! Integrates constrained mechanical systems with contacts and friction.

// The derive macro names this crate by its path, also inside it.
extern crate self as lagrange_core;

pub mod arithmetic;
pub mod events;
pub mod integrate;
pub mod system;
