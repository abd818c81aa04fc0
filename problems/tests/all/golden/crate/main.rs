//! `cargo run --release -- run pendulum` runs the system in `pendulum.rs`; `--help` shows the other commands.

mod pendulum;

use lagrange_problems::{Entry, Program};
use pendulum::Pendulum;
use std::process::ExitCode;

fn main() -> ExitCode {
    Program::new()
        .scene(Entry::<Pendulum>::new("pendulum", 10.0))
        .main()
}
