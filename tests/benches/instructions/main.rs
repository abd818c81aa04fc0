//! Processor instructions of a run, part by part, and of what is left out: a declaration with an item left out beside the one that
//! never had it.
//!
//! ```console
//! $ cargo bench -p lagrange-tests --bench instructions
//! ```
//!
//! valgrind counts, so the figures repeat exactly: a right-hand side in every mode, and a whole run with all decisions and
//! events. Each is counted for a number of calls and for twice that number; what is left of the difference is free of
//! everything that happens once. Without valgrind the bench says so and ends.

mod parts;

use lagrange_core::prelude::*;
use lagrange_program::cost::{Place, RightSide};
use lagrange_tests::modes::all;
use lagrange_tests::pairs::{Pair, Visitor, visit};
use std::process::Command;

/// Calls of a right-hand side, and runs, in the shorter of two counts.
const CALLS: u64 = 2000;
const RUNS: u64 = 10;
/// End of a run, s.
const UNTIL: f64 = 2.0;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|a| a == "--count") {
        let mut work = Work {
            asked: Asked::read(&arguments[at + 1..]),
            pairs: 0,
        };
        visit(&mut work);
        return;
    }
    if let Some(at) = arguments.iter().position(|a| a == "--parts") {
        return parts::work(&arguments[at + 1..]);
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("skipped: there is no valgrind on this machine");
        return;
    }
    if arguments.iter().any(|a| a == "--test" || a == "--list") {
        return;
    }
    println!("instructions of a run, part by part");
    parts::print();
    println!("\ninstructions with the item left out, and as if it were not declared");
    println!(
        "{:<44}{:>34}{:>36}",
        "", "a right-hand side", "a run of two seconds"
    );
    visit(&mut Table(0));
}

/// What a process under valgrind does.
#[derive(Clone, Copy)]
struct Asked {
    pair: usize,
    /// Whether of the whole declaration with the item left out.
    whole: bool,
    /// Whether runs, or right-hand sides.
    runs: bool,
    times: u64,
}

impl Asked {
    fn read(words: &[String]) -> Self {
        let number = |i: usize| words[i].parse::<u64>().expect("a number");
        Self {
            pair: number(0) as usize,
            whole: number(1) == 1,
            runs: number(2) == 1,
            times: number(3),
        }
    }

    /// Instructions of one call.
    fn each(self) -> f64 {
        let twice = Self {
            times: 2 * self.times,
            ..self
        };
        (twice.counted() - self.counted()) / self.times as f64
    }

    /// Instructions of a process that does it.
    fn counted(self) -> f64 {
        let program = std::env::current_exe().expect("this program");
        let flag = |yes: bool| u64::from(yes).to_string();
        let output = Command::new("valgrind")
            .args([
                "--tool=cachegrind",
                "--cache-sim=no",
                "--cachegrind-out-file=/dev/null",
            ])
            .arg(program)
            .args([
                "--count",
                &self.pair.to_string(),
                &flag(self.whole),
                &flag(self.runs),
            ])
            .arg(self.times.to_string())
            .output()
            .expect("valgrind");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        let line = said.lines().find(|line| line.contains("refs:"));
        let digits = line.and_then(|line| line.rsplit(':').next());
        let digits: String = digits
            .unwrap_or_default()
            .chars()
            .filter(char::is_ascii_digit)
            .collect();
        digits
            .parse()
            .unwrap_or_else(|_| panic!("no count in {said}"))
    }
}

/// Does what is asked.
struct Work {
    asked: Asked,
    pairs: usize,
}

impl Visitor for Work {
    fn pair<Whole, Part>(&mut self, pair: &Pair, whole: &Whole, part: &Part)
    where
        Whole: Derived<Scalar = f64> + Starts,
        Part: Derived<Scalar = f64> + Starts,
    {
        self.pairs += 1;
        if self.pairs != self.asked.pair {
            return;
        }
        let start = part.at(StartId(0));
        match self.asked.whole {
            true => work(
                self.asked,
                whole,
                &pair.without,
                &start,
                &all(Part::DESCRIPTION),
            ),
            false => work(
                self.asked,
                part,
                &Effects::all(),
                &start,
                &all(Part::DESCRIPTION),
            ),
        }
    }
}

fn work<S: Derived<Scalar = f64>>(
    asked: Asked,
    system: &S,
    effects: &Effects,
    start: &State<f64>,
    modes: &[Mode],
) {
    if asked.runs {
        let simulation = Simulation::new(system)
            .effects(effects.clone())
            .record(false);
        let mut runner = simulation.runner();
        for _ in 0..asked.times {
            // A run that fails does so on both sides.
            let _ = runner.run(start, 0.0..UNTIL);
        }
        return;
    }
    for mode in modes {
        let mut wide = Mode::open(S::DESCRIPTION);
        wide.contacts[..mode.contacts.len()].copy_from_slice(&mode.contacts);
        wide.frictions[..mode.frictions.len()].copy_from_slice(&mode.frictions);
        let number = |i: usize| 0.4 + 0.17 * i as f64;
        let n = S::DESCRIPTION.coordinates.len();
        let place = Place {
            mode: wide,
            time: 0.2,
            state: State::new(
                (0..n).map(number).collect(),
                (0..n).map(|i| -number(i)).collect(),
            ),
        };
        if let Some(mut side) = RightSide::new(system, effects, &place) {
            side.chain(asked.times);
        }
    }
}

/// Prints a line for every pair.
struct Table(usize);

impl Visitor for Table {
    fn pair<Whole, Part>(&mut self, pair: &Pair, _: &Whole, _: &Part)
    where
        Whole: Derived<Scalar = f64> + Starts,
        Part: Derived<Scalar = f64> + Starts,
    {
        self.0 += 1;
        let count = |whole, runs| {
            let asked = Asked {
                pair: self.0,
                whole,
                runs,
                times: if runs { RUNS } else { CALLS },
            };
            asked.each()
        };
        let modes = all(Part::DESCRIPTION).len() as f64;
        let [side, plain_side] = [true, false].map(|whole| count(whole, false) / modes);
        let [run, plain_run] = [true, false].map(|whole| count(whole, true));
        // A function asks which of its blocks take part: nothing else may be left of them. Without a constraint the interpreter runs.
        let mut left_out = pair.without.left_out();
        let interpreted = left_out.any(|item| matches!(item, Item::Constraint(_)));
        let same = interpreted || (side / plain_side - 1.0).abs() < 0.03;
        assert!(same, "{}: {side} instructions, not {plain_side}", pair.name);
        println!(
            "{:<44}{side:>12.1}{plain_side:>12.1}{:>+9.2} %{run:>14.0}{plain_run:>12.0}{:>+9.2} %",
            pair.name,
            100.0 * (side / plain_side - 1.0),
            100.0 * (run / plain_run - 1.0),
        );
    }
}
