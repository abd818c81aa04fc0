//! Tests of the pool: tables of canonical forms, and properties on seeded random expressions.

mod canonical;
mod exact;
mod properties;
mod random;
mod read;
mod rewritten;
