//! Scene files: a run written down in TOML, and read again with every mistake at its line.
//!
//! ```toml
//! scene = "mass-on-wheel"
//! tolerance = 1e-12
//! end_after = "rim lost"
//!
//! [parameters]
//! mu_static = 10
//!
//! [effects]
//! grip = false
//!
//! [outputs]
//! output = ["wheel.parquet", "wheel.csv"]
//! ```

mod read;
mod value;
mod write;

pub use read::read;
pub use write::write;

use crate::format::RunFormat;
use crate::request::Request;
use crate::scene::Scene;
use core::fmt;
use std::path::PathBuf;

/// What a scene file says.
pub struct SceneFile {
    /// The scene.
    pub scene: &'static dyn Scene,
    /// The run of it.
    pub request: Request,
    /// Where its results go.
    pub outputs: Outputs,
}

/// Where the results of a run go; what is `None` or empty is as the command line says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outputs {
    /// In what form to write the run; if `None`, as the names of the files say.
    pub format: Option<RunFormat>,
    /// The files to write it to.
    pub output: Vec<PathBuf>,
    /// The picture to draw.
    pub plot: Option<PathBuf>,
    /// What it shows; forces, coordinates and outputs if empty.
    pub show: Vec<String>,
    /// Intervals to sample the motion at.
    pub samples: Option<usize>,
}

/// What is wrong with a scene file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong, and what to do.
    pub reason: String,
}

impl Mistake {
    /// The mistake at this byte of a text.
    fn at(text: &str, byte: usize, reason: String) -> Self {
        let before = text.get(..byte).unwrap_or(text);
        let line = before.rfind('\n').map_or(0, |end| end + 1);
        Self {
            line: before.matches('\n').count() + 1,
            column: before[line..].chars().count() + 1,
            reason,
        }
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.reason)
    }
}

impl core::error::Error for Mistake {}

/// The keys of a scene file, outside and inside of its table `outputs`.
const KEYS: [&str; 15] = [
    "scene",
    "until",
    "end_after",
    "max_events",
    "tolerance",
    "absolute_tolerance",
    "error",
    "estimate",
    "method",
    "project",
    "impacts",
    "parameters",
    "start",
    "effects",
    "outputs",
];
const OUTPUTS: [&str; 6] = ["format", "output", "plot", "show", "ledger", "samples"];
