//! `cargo run --release -- run pendulum` runs the system in `pendulum.rs`; `--help` shows the other commands.

mod pendulum;

use lagrange_program::{Entry, Program};
use pendulum::Pendulum;
use std::process::ExitCode;

fn main() -> ExitCode {
    Program::new()
        .scene(Entry::<Pendulum>::new("pendulum", 10.0))
        .main()
}

#[cfg(test)]
mod tests {
    use super::Pendulum;
    use lagrange_core::prelude::*;

    #[test]
    fn without_friction_the_energy_stays() -> Result<(), Box<dyn std::error::Error>> {
        let pendulum = Pendulum {
            damping: 0.0,
            ..Pendulum::default()
        };
        let run = Simulation::new(&pendulum).run(pendulum.at(Pendulum::RELEASED), 0.0..10.0)?;
        let mut sampler = run.sampler();
        let (start, end) = (sampler.at(0.0)?.energy(), sampler.at(10.0)?.energy());
        assert!((end - start).abs() < 1e-6);
        Ok(())
    }
}
