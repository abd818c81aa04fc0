//! The program `lagrange`: it runs, draws and reports systems of [one's own](Program), and those of `lagrange-problems`.
//!
//! Everything here works on the names and numbers that the derive macro puts in [`lagrange_core::system::Description`], so that it knows no
//! scene.

pub mod accuracy;
mod blame;
pub mod catalogue;
mod cli;
pub mod closed_form;
pub mod cost;
pub mod drawing;
mod drawn;
pub mod feasible;
pub mod file;
pub mod film;
pub mod format;
pub mod names;
pub mod notation;
pub mod number;
pub mod outcome;
pub mod path;
mod program;
pub mod progress;
mod quantity;
pub mod report;
pub mod request;
pub mod results;
pub mod scene;
pub mod scene_file;
pub mod space;
pub mod stability;
mod straight;
pub mod sweep;

pub use program::Program;
pub use results::Results;
pub use scene::Entry;
