//! Formats of files: what the name of one says.

use clap::ValueEnum;
use core::fmt;
use std::path::Path;

/// What is said where the feature is off.
pub(crate) const WITHOUT: &str =
    "this program was built without the feature `export`: its pictures are .svg";

/// In what form to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// To read.
    Table,
    /// Every number in full precision.
    Json,
    /// One line each.
    Csv,
}

impl Format {
    /// The format that the name of a file says, to read if it has no ending.
    ///
    /// # Errors
    /// A sentence, if its ending is that of no format.
    pub(crate) fn named(path: &Path) -> Result<Self, String> {
        let of = |ending: &str| match ending {
            "json" => Some(Format::Json),
            "csv" => Some(Format::Csv),
            "txt" => Some(Format::Table),
            _ => None,
        };
        named(path, Format::Table, of, ".csv, .json or .txt")
    }
}

/// What the ending of a file's name says, or `plain` if it has none.
///
/// # Errors
/// A sentence, if it is none of the `endings` that say something.
pub(crate) fn named<F>(
    path: &Path,
    plain: F,
    of: impl Fn(&str) -> Option<F>,
    endings: &str,
) -> Result<F, String> {
    let Some(ending) = path.extension() else {
        return Ok(plain);
    };
    ending.to_str().and_then(of).ok_or_else(|| {
        let path = path.display();
        format!("the name {path} says no format: let it end in {endings}, or give --format")
    })
}

/// In what form to write a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RunFormat {
    /// To read.
    Table,
    /// Every number in full precision.
    Json,
    /// The same over time: a line per sample and event.
    Jsonl,
    /// A line per sample, two per event.
    Csv,
    /// The same for pandas, polars and the like.
    Parquet,
}

impl RunFormat {
    /// The format that the name of a file says, if it says one.
    pub fn of(path: &Path) -> Option<Self> {
        Some(match path.extension()?.to_str()? {
            "json" => RunFormat::Json,
            "jsonl" | "ndjson" => RunFormat::Jsonl,
            "csv" => RunFormat::Csv,
            "parquet" => RunFormat::Parquet,
            "txt" => RunFormat::Table,
            _ => return None,
        })
    }

    /// The same, to read if it has no ending.
    ///
    /// # Errors
    /// A sentence, if its ending is that of no format.
    pub(crate) fn named(path: &Path) -> Result<Self, String> {
        let picture = match path.extension().is_some_and(|ending| ending == "svg") {
            true => "; pictures are drawn with --plot",
            false => "",
        };
        let endings = ".csv, .json, .jsonl, .parquet or .txt";
        named(path, RunFormat::Table, |_| Self::of(path), endings)
            .map_err(|reason| format!("{reason}{picture}"))
    }

    /// Whether it says how the run was between its events.
    pub fn is_sampled(self) -> bool {
        matches!(self, RunFormat::Jsonl | RunFormat::Csv | RunFormat::Parquet)
    }
}

impl fmt::Display for RunFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.to_possible_value();
        f.write_str(name.as_ref().map_or("", |name| name.get_name()))
    }
}

/// What a single picture can become.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Still {
    /// Shapes and text, for browsers and editors.
    Svg,
    /// Pixels.
    Png,
    /// Shapes, for print.
    Pdf,
}

impl Still {
    /// What the name of a file says.
    ///
    /// # Errors
    /// A sentence, if it says nothing or what this program cannot write.
    pub fn of(path: &Path) -> Result<Self, String> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let still = match ending.map(str::to_lowercase).as_deref() {
            Some("svg") => Still::Svg,
            Some("png") => Still::Png,
            Some("pdf") => Still::Pdf,
            _ => {
                let path = path.display();
                return Err(format!(
                    "let the name of a picture end in .svg, .png or .pdf, not {path}"
                ));
            }
        };
        match still == Still::Svg || cfg!(feature = "export") {
            true => Ok(still),
            false => Err(WITHOUT.to_owned()),
        }
    }
}
