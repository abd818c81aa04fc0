//! Derived equations against hand-derived ones, against exact numeric derivatives, and against the theorems.

mod hyperdual;
mod kit;
mod notation;
mod numbers;
mod structure;
mod textbook;
mod theorems;
