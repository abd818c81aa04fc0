//! Textbook scenes, each declared once on a struct, and what the program `lagrange` needs to run and report them.
//!
//! A scene is one file in [`scenes`] and one line in [`catalogue`]. Everything else here works on the names and
//! numbers that the derive macro puts in [`lagrange_core::system::Description`], so it never has to be touched.

pub mod accuracy;
pub mod catalogue;
pub mod closed_form;
pub mod cost;
pub mod count;
pub mod drawing;
pub mod file;
pub mod film;
pub mod names;
pub mod outcome;
pub mod progress;
pub mod reference;
pub mod report;
pub mod request;
pub mod scene_file;
pub mod scenes;
pub mod space;
pub mod stability;
pub mod sweep;
