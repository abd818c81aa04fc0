//! Units.

mod dimension;
mod grammar;
