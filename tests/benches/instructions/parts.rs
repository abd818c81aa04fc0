//! Instructions of a run, part by part, beside what they were and what they may be.
//!
//! callgrind tells what each function costs by itself and by each of the functions that it calls. A part is what is spent in some
//! functions and in whatever they call that is not another part; what a function costs on behalf of two callers is shared out in
//! the ratio of the calls' costs.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::{
    CartesianPendulum, DoublePendulum, Kepler, MassOnWheel, RollingSlippingSphere,
};
use std::collections::BTreeMap;
use std::process::Command;

/// Runs in the shorter of two counts.
const RUNS: u64 = 50;

/// A part: its name, and the functions that it begins with (ends of their paths).
type Part = (&'static str, &'static [&'static str]);

/// Parts of a step beside series and right-hand side, in its order.
const STEP: [Part; 7] = [
    ("step size", &["::step_size"]),
    ("scaling", &["::write_polynomial"]),
    ("guard polynomials", &["::take_series"]),
    ("exclusion of roots", &["::nothing_happens"]),
    (
        "refinement of roots",
        &["::first_hit", "::hides_a_start", "taylor::defect"],
    ),
    ("check of the end", &["Curves::defect", "::defect_at_end"]),
    ("rest of the step", &["::make_step", "::write_step"]),
];
/// What stands beside it.
const OTHERS: [Part; 6] = [
    ("series", &["::begin_series", "::end_series"]),
    ("right-hand sides", &["Dynamics<T>>::value"]),
    ("decision", &["Decider<T>::decide_with"]),
    ("rest of a switch", &["Run<T>>::leave_mode"]),
    ("rest of the start", &["Run<T>>::launch"]),
    (
        "change of parameters",
        &["::set_scene", "::set_system", "Compiled<T>::renew"],
    ),
];

/// What belongs to no part.
const ELSE: &str = "anything else";

/// A scene: its name, the figures of the day when the budget was made (a step, a switch, a change of parameters, the whole run; not a number where there is
/// none), and its runs.
struct Scene {
    name: &'static str,
    before: [f64; 4],
    run: fn(u64) -> [usize; 2],
}

const SCENES: [Scene; 5] = [
    Scene {
        name: "rolling-slipping sphere, 2.2 s",
        before: [10_400.0, 13_768.0, 22_059.0, 168_310.0],
        run: |times| run(&RollingSlippingSphere::default(), 2.2, times),
    },
    Scene {
        name: "mass on wheel, 2.9 s",
        before: [11_073.0, 14_168.0, 47_073.0, 334_864.0],
        run: |times| run(&MassOnWheel::default(), 2.9, times),
    },
    Scene {
        name: "double pendulum, 1 s",
        before: [3_907.0, f64::NAN, 3_508.0, 294_832.0],
        run: |times| run(&DoublePendulum::default(), 1.0, times),
    },
    Scene {
        name: "Kepler, an orbit",
        before: [f64::NAN; 4],
        run: |times| run(&Kepler::default(), std::f64::consts::TAU, times),
    },
    Scene {
        name: "Cartesian pendulum, 2 s",
        before: [f64::NAN; 4],
        run: |times| run(&CartesianPendulum::default(), 2.0, times),
    },
];

/// Instructions that a step without a switch may take beside series and right-hand side, a switch of one contact with one friction,
/// and a change of parameters.
const BUDGET: [f64; 3] = [1500.0, 3000.0, 1000.0];

/// Runs a scene many times, with its parameters set anew each time; the steps and switches of one run.
fn run<S: System<Scalar = f64> + Starts>(scene: &S, until: f64, times: u64) -> [usize; 2] {
    let start = scene.at(StartId(0));
    let mut runner = Simulation::new(scene).runner();
    for _ in 0..times {
        runner.set_scene(scene);
        runner.run(&start, 0.0..until).expect("runs");
    }
    let trajectory = runner.trajectory();
    [trajectory.work().steps, trajectory.events().len()]
}

/// Does what a process under valgrind is asked for.
pub fn work(words: &[String]) {
    let number = |i: usize| words[i].parse::<u64>().expect("a number");
    (SCENES[number(0) as usize].run)(number(1));
}

/// Prints the table of every scene.
pub fn print() {
    let parts = STEP.iter().chain(&OTHERS).map(|(name, _)| *name);
    let mut missing: Vec<&str> = parts.collect();
    for (index, scene) in SCENES.iter().enumerate() {
        let [steps, switches] = (scene.run)(1);
        let (long, short) = (Profile::count(index, 2 * RUNS), Profile::count(index, RUNS));
        let cost = |part: &str| (long.of(part) - short.of(part)) / RUNS as f64;
        missing.retain(|part| cost(part) == 0.0);
        let [step, switch, change, whole] = scene.before;
        println!("\n{}: {steps} steps, {switches} switches", scene.name);
        let columns = ["", "a run", "each", "before", "budget"];
        let [first, rest @ ..] = columns;
        println!(
            "{first:<44}{}",
            rest.map(|word| format!("{word:>10}")).concat()
        );
        STEP.iter()
            .for_each(|(part, _)| row(part, cost(part), steps, &[]));
        let sum = STEP.iter().map(|(part, _)| cost(part)).sum();
        row(
            "= steps without the next two",
            sum,
            steps,
            &[step, BUDGET[0]],
        );
        for part in ["series", "right-hand sides"] {
            row(part, cost(part), steps, &[]);
        }
        if switches > 0 {
            let parts = ["decision", "rest of a switch"];
            for part in parts {
                row(part, cost(part), switches, &[]);
            }
            let sum = parts.map(cost).iter().sum();
            row(
                "= switches without series and values",
                sum,
                switches,
                &[switch, BUDGET[1]],
            );
        }
        for part in ["rest of the start", ELSE] {
            row(part, cost(part), 1, &[]);
        }
        let part = "change of parameters";
        row(part, cost(part), 1, &[change, BUDGET[2]]);
        let all = (long.total() - short.total()) / RUNS as f64;
        row("= a run", all, 1, &[whole]);
    }
    assert!(
        missing.is_empty(),
        "no function is called as these parts say: {missing:?}"
    );
}

/// Prints what a part costs in a run and each of so many times, and numbers to compare that with.
fn row(name: &str, cost: f64, times: usize, compared: &[f64]) {
    print!("{name:<44}{cost:>10.0}{:>10.0}", cost / times as f64);
    for number in compared {
        match number.is_nan() {
            true => print!("{:>10}", ""),
            false => print!("{number:>10.0}"),
        }
    }
    println!();
}

/// What the functions of a process cost.
#[derive(Default)]
struct Profile {
    own: BTreeMap<String, f64>,
    /// By caller: what it spends in each function that it calls.
    calls: BTreeMap<String, BTreeMap<String, f64>>,
    parts: BTreeMap<&'static str, f64>,
}

impl Profile {
    fn count(scene: usize, times: u64) -> Self {
        let file = std::env::temp_dir().join(format!("lagrange-parts-{}", std::process::id()));
        let status = Command::new("valgrind")
            .args(["--quiet", "--tool=callgrind", "--dump-line=no"])
            .stderr(std::process::Stdio::null())
            .arg(format!("--callgrind-out-file={}", file.display()))
            .arg(std::env::current_exe().expect("this program"))
            .args(["--parts", &scene.to_string(), &times.to_string()])
            .status()
            .expect("valgrind");
        assert!(status.success(), "{status}");
        let text = std::fs::read_to_string(&file).expect("a profile");
        let _ = std::fs::remove_file(&file);
        let mut profile = Self::read(&text);
        profile.share_out();
        profile
    }

    /// Reads a profile: `fn=(1) name` begins a function, `cfn=(2) name` and `calls=…` a call whose cost is in the next line.
    fn read(text: &str) -> Self {
        let mut profile = Self::default();
        let mut names: BTreeMap<&str, String> = BTreeMap::new();
        let (mut function, mut called) = (String::new(), None);
        let mut calls = false;
        for line in text.lines() {
            let mut name = |written| {
                let (id, name) = str::split_once(written, ' ').unwrap_or((written, ""));
                let known = names.entry(id).or_default();
                if !name.is_empty() {
                    name.clone_into(known);
                }
                known.clone()
            };
            if let Some(written) = line.strip_prefix("fn=") {
                function = name(written);
            } else if let Some(written) = line.strip_prefix("cfn=") {
                called = Some(name(written));
            } else if line.starts_with("calls=") {
                calls = true;
            } else if line.starts_with(|c: char| c.is_ascii_digit() || "+-*".contains(c))
                && let Some(cost) = line.split(' ').nth(1).and_then(|c| c.parse::<f64>().ok())
            {
                let to = match called.take().filter(|_| calls) {
                    Some(called) => profile
                        .calls
                        .entry(function.clone())
                        .or_default()
                        .entry(called),
                    None => profile.own.entry(function.clone()),
                };
                *to.or_default() += cost;
                calls = false;
            }
        }
        profile
    }

    /// Sums up the parts, from the program's main function downwards.
    fn share_out(&mut self) {
        let main = self.calls.keys().find(|f| f.ends_with("::main"));
        let main = main.expect("a main function");
        let mut parts = BTreeMap::new();
        self.descend(
            main,
            self.inclusive(main),
            ELSE,
            &mut Vec::new(),
            &mut parts,
        );
        self.parts = parts;
    }

    fn inclusive(&self, function: &str) -> f64 {
        let own = self.own.get(function).copied().unwrap_or_default();
        own + self.calls.get(function).map_or(0.0, |to| to.values().sum())
    }

    /// Books `cost` instructions that `function` takes within `part`.
    fn descend<'a>(
        &'a self,
        function: &'a str,
        cost: f64,
        part: &'static str,
        above: &mut Vec<&'a str>,
        parts: &mut BTreeMap<&'static str, f64>,
    ) {
        /// Less than this is not followed any further.
        const LITTLE: f64 = 0.5;
        let part = part_of(function).unwrap_or(part);
        let inclusive = self.inclusive(function);
        let share = if inclusive > 0.0 {
            cost / inclusive
        } else {
            0.0
        };
        let own = self.own.get(function).copied().unwrap_or_default();
        *parts.entry(part).or_default() += own * share;
        above.push(function);
        for (called, spent) in self.calls.get(function).into_iter().flatten() {
            if spent * share < LITTLE || above.contains(&called.as_str()) {
                *parts.entry(part).or_default() += spent * share;
            } else {
                self.descend(called, spent * share, part, above, parts);
            }
        }
        above.pop();
    }

    fn of(&self, part: &str) -> f64 {
        self.parts.get(part).copied().unwrap_or_default()
    }

    fn total(&self) -> f64 {
        self.parts.values().sum()
    }
}

/// The part that begins with a function.
fn part_of(function: &str) -> Option<&'static str> {
    let begins = |(_, ends): &&Part| ends.iter().any(|end| function.ends_with(end));
    let mut parts = STEP.iter().chain(&OTHERS);
    parts.find(begins).map(|(name, _)| *name)
}
