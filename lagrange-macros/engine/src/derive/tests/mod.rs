//! Derived equations against hand-derived ones, against exact numeric derivatives, and against the theorems.

mod constrained;
mod counts;
mod hyperdual;
mod kit;
mod notation;
mod numbers;
mod onsets;
mod smooth;
mod structure;
mod systems;
mod theorems;
