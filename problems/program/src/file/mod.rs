//! Systems in files: the language without rustc, derived when the program starts.
//!
//! ```text
//! //! A mass on a spring.
//! parameters(mass: "kg" = 1, stiffness: "N/m" = 40),
//! coordinates(x: "m"),
//! kinetic = mass/2 * der(x)^2,
//! potential = stiffness/2 * x^2,
//! start(pulled: x = 0.1),
//! ```
//!
//! It is the engine of the derive that reads them, with the same checks. Its tables are read here instead of being compiled
//! (`literal`), and what they describe is a [`Scene`] as those of the catalogue are.

mod literal;
mod mistake;
mod system;

pub use mistake::Mistakes;

use crate::scene::{Entry, Scene};
use lagrange_core::Derivation;
use lagrange_engine::FromFile;
use literal::Literal;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use system::{FileSystem, Tables};

/// How the name of such a file ends.
pub const ENDING: &str = ".lagrange";

/// Time at which a run ends if neither the file nor the request says when, s.
const UNTIL: f64 = 10.0;

/// A file that declares a system, as `lagrange new` writes it.
pub const TEMPLATE: &str = include_str!("template.lagrange");

/// Why there is no scene.
#[derive(Debug)]
#[non_exhaustive]
pub enum Refused {
    /// The file of this name cannot be read, for this reason.
    Unreadable(String),
    /// What it declares has mistakes.
    Mistakes(Mistakes),
    /// A mistake of this program.
    Bug(String),
}

impl core::fmt::Display for Refused {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Refused::Unreadable(error) => write!(f, "cannot read {error}"),
            Refused::Mistakes(mistakes) => mistakes.fmt(f),
            Refused::Bug(reason) => {
                write!(
                    f,
                    "a bug in lagrange: {reason}; please report it with this file"
                )
            }
        }
    }
}

impl core::error::Error for Refused {}

/// The scene that a file declares. It is called as its path is written, and is kept as long as the program runs.
///
/// # Errors
/// The file cannot be read, or what it declares has mistakes.
pub fn load(path: &str) -> Result<&'static dyn Scene, Refused> {
    scene(path, &read(path)?)
}

/// The scene that a text declares, called `path`.
///
/// # Errors
/// What it declares has mistakes.
pub fn scene(path: &str, text: &str) -> Result<&'static dyn Scene, Refused> {
    let found = derived(path, text)?;
    let description = Literal::read(&parsed(found.tables.description)?).map_err(Refused::Bug)?;
    let declaration = Literal::read(&parsed(found.tables.declaration)?).map_err(Refused::Bug)?;
    let tables = Tables {
        description,
        declaration,
        derivation: Derivation {
            name: type_name(path).leak(),
            declaration: found.declaration.leak(),
            ..Derivation::NONE
        },
        starts: found.starts,
    };
    let system: &FileSystem = Box::leak(Box::new(FileSystem {
        tables: Box::leak(Box::new(tables)),
        parameters: found.defaults,
    }));
    let name = path.to_owned().leak();
    let place = |line: usize, column: usize| format!("{path}:{line}:{column}");
    let places = found.places.into_iter();
    let places = places.map(|(name, line, column)| (name, place(line, column)));
    let hints = found.hints.into_iter();
    let hints = hints.map(|(text, line, column)| format!("{}: {text}", place(line, column)));
    let entry = Entry::kept(name, found.until.unwrap_or(UNTIL), system)
        .places(Box::leak(places.collect::<Box<[_]>>()))
        .hints(Box::leak(hints.collect::<Box<[_]>>()));
    Ok(Box::leak(Box::new(entry)))
}

/// A declaration in Rust.
#[derive(Clone, Debug)]
pub struct Exported {
    /// The text of a file with a struct that declares the same, and its default values.
    pub rust: String,
    /// Name of the struct.
    pub system: String,
    /// Time at which a run ends unless asked otherwise, s.
    pub until: f64,
}

/// The struct that declares what the text of a file declares.
///
/// # Errors
/// What it declares has mistakes, or names that become one constant of the struct.
pub fn export(path: &str, text: &str) -> Result<Exported, Refused> {
    let found = derived(path, text)?;
    Ok(Exported {
        rust: found
            .rust
            .map_err(|found| Refused::Mistakes(Mistakes::new(path, unmarked(text), &found)))?,
        system: type_name(path),
        until: found.until.unwrap_or(UNTIL),
    })
}

/// The text of a file.
///
/// # Errors
/// It cannot be read.
pub fn read(path: &str) -> Result<String, Refused> {
    let refused = |why: String| Refused::Unreadable(format!("{path}: {why}"));
    let bytes = fs::read(path).map_err(|error| refused(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let read = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let (line, byte) = (1 + read.iter().filter(|&&c| c == b'\n').count(), read.len());
        refused(format!(
            "byte {byte}, in line {line}, is not UTF-8; save the file as UTF-8"
        ))
    })?;
    // Lines end in carriage returns alone where a file comes from an old Mac.
    Ok(match text.contains('\n') {
        true => text,
        false => text.replace('\r', "\n"),
    })
}

/// A text without the mark that some editors write at its beginning.
fn unmarked(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// What the engine makes of a text. A panic of the engine is a bug, never the user's mistake.
fn derived(path: &str, text: &str) -> Result<FromFile, Refused> {
    let text = unmarked(text);
    let derive = || lagrange_engine::file(text, &type_name(path));
    match catch_unwind(AssertUnwindSafe(derive)) {
        Ok(Ok(found)) => Ok(found),
        Ok(Err(found)) => Err(Refused::Mistakes(Mistakes::new(path, text, &found))),
        Err(_) => Err(Refused::Bug("the derivation has panicked".to_owned())),
    }
}

fn parsed(tokens: proc_macro2::TokenStream) -> Result<syn::Expr, Refused> {
    syn::parse2(tokens).map_err(|error| Refused::Bug(error.to_string()))
}

/// What means something else in the Rust that is exported.
const TAKEN: [&str; 3] = ["Default", "Self", "T"];

/// `double-pendulum.lagrange` → `DoublePendulum`.
pub fn type_name(path: &str) -> String {
    let stem = Path::new(path).file_stem().unwrap_or_default();
    let stem = stem.to_string_lossy();
    let words = stem.split(|c: char| !c.is_ascii_alphanumeric());
    let name: String = words
        .filter_map(|word| {
            let (first, rest) = word.split_at_checked(1)?;
            Some(first.to_ascii_uppercase() + rest)
        })
        .collect();
    match name.chars().next() {
        Some(first) if !first.is_ascii_digit() && !TAKEN.contains(&name.as_str()) => name,
        _ => format!("System{name}"),
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod textbook;
