//! Derived equations against hand-derived ones, against exact numeric derivatives, and against the theorems.

mod hyperdual;
pub(crate) mod kit;
mod notation;
pub(crate) mod numbers;
mod structure;
mod textbook;
mod theorems;
