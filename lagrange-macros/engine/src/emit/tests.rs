//! Emitted code reads as planned.
