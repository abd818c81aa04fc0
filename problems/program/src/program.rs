//! The program `lagrange` with its scenes.

use crate::catalogue::Catalogue;
use crate::cli;
use crate::scene::{Entry, Scene};
use lagrange_core::prelude::System;
use std::ffi::OsString;
use std::process::ExitCode;

/// The program `lagrange` for systems of one's own: `run`, `report`, `sweep` and all other commands know them by name.
///
/// ```
/// use lagrange_core::prelude::*;
/// use lagrange_program::{Entry, Program};
///
/// /// A pendulum.
/// #[derive(Lagrangian, Clone, Debug)]
/// #[lagrange(
///     coordinates(theta),
///     kinetic   = length^2/2 * der(theta)^2,
///     potential = -gravity * length * cos(theta),
///     start(released: theta = 2),
/// )]
/// struct Pendulum {
///     length: f64,
///     gravity: f64,
/// }
///
/// /// What the program begins from where nothing else is said.
/// impl Default for Pendulum {
///     fn default() -> Self {
///         Self { length: 1.0, gravity: 9.81 }
///     }
/// }
///
/// let program = Program::new().scene(Entry::<Pendulum>::new("pendulum", 10.0));
/// # let file = std::env::temp_dir().join(format!("own-{}.csv", std::process::id()));
/// # let output = file.to_str().expect("unicode");
/// # program.run(["mine", "run", "pendulum", "--set", "length=2", "--output", output]);
/// # let rows = std::fs::read_to_string(&file)?;
/// # std::fs::remove_file(&file)?;
/// # assert!(rows.starts_with("t [s],event,theta"), "{rows}");
/// # #[cfg(any())]
/// program.main(); // what `fn main() -> ExitCode` returns
/// # Ok::<(), std::io::Error>(())
/// ```
#[must_use]
#[derive(Default)]
pub struct Program {
    catalogue: Catalogue,
}

impl Program {
    /// A program without scenes.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with one scene more.
    pub fn scene<S: System<Scalar = f64>>(mut self, scene: Entry<S>) -> Self {
        // A program has its scenes as long as it runs.
        let scene: &'static dyn Scene = Box::leak(Box::new(scene));
        self.catalogue.scenes.push(scene);
        self
    }

    /// Runs it with the arguments of the process.
    pub fn main(self) -> ExitCode {
        self.run(std::env::args_os())
    }

    /// Runs it with these arguments, of which the first is its name.
    pub fn run(self, arguments: impl IntoIterator<Item = impl Into<OsString>>) -> ExitCode {
        let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
        cli::run(&arguments, &self.catalogue)
    }
}

impl From<Catalogue> for Program {
    fn from(catalogue: Catalogue) -> Self {
        Self { catalogue }
    }
}
