//! All tests of the program and its catalogue, in one binary: it is linked once, and its tests share the processors.

mod accuracy;
mod balls_in_space;
mod book;
mod browser;
mod checks;
mod command_line;
mod complaints;
mod declaration;
mod file;
mod frames;
mod help;
mod inspect;
#[cfg(unix)]
mod interrupt;
mod large_scenes;
mod markup;
mod neighbours;
mod outputs;
#[cfg(feature = "export")]
mod pictures;
mod program;
mod reference;
mod report;
mod report_in_browser;
mod scene_file;
mod smooth_scenes;
mod sweep;
mod sweep_kept;
#[cfg(feature = "mpi")]
mod sweep_mpi;
mod switches;

/// Built once more for its unit tests, so that the scenes are not.
#[path = "../../src/closed_form/mod.rs"]
#[allow(dead_code)]
mod closed_form;
