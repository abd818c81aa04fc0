//! Textbook scenes, each declared once on a struct, and the program `lagrange` that runs and reports them, or [systems of one's
//! own](Program).
//!
//! A scene is one file in [`scenes`] and one line in [`catalogue`]. Everything else here works on the names and
//! numbers that the derive macro puts in [`lagrange_core::system::Description`], so it never has to be touched.

// The commands name this library by its path.
extern crate self as lagrange_problems;

pub mod accuracy;
pub mod catalogue;
mod cli;
pub mod closed_form;
pub mod cost;
pub mod count;
pub mod drawing;
mod drawn;
pub mod feasible;
pub mod file;
pub mod film;
pub mod names;
pub mod outcome;
mod program;
pub mod progress;
#[cfg(feature = "scenes")]
pub mod reference;
pub mod report;
pub mod request;
pub mod results;
pub mod scene_file;
#[cfg(feature = "scenes")]
pub mod scenes;
pub mod space;
#[cfg(feature = "scenes")]
pub mod stability;
pub mod sweep;

pub use catalogue::Entry;
pub use program::Program;
pub use results::Results;
