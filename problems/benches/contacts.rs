//! What contacts cost, from 1 to 64 of them.
//!
//! ```console
//! $ cargo bench -p lagrange-problems --bench contacts
//! ```
//!
//! * `row`: balls on each other on a floor that shakes, all pressed together (every force follows from the others).
//! * `pile`: plates on each other with friction in every face, on a floor that is jerked away: each face slips in turn.
//! * `crowd`: blocks side by side on a rough floor, pressed together: forces that are not determined.
//!
//! For each number of contacts: one right-hand side, the decision which mode holds at the start (with one step, of no
//! length), the first such decision (which makes the mode ready), and a whole run. The exponent is that of the growth since
//! the line above; dense linear algebra has 3.

use lagrange_core::dynamics::Dynamics;
use lagrange_core::prelude::*;
use std::time::{Duration, Instant};

macro_rules! rows {
    ($($name:ident $balls:literal $pairs:literal)*) => {$(
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(y[$balls]),
            kinetic   = sum(k in 0..$balls: mass/2 * der(y[k])^2),
            potential = sum(k in 0..$balls: mass * gravity * y[k]),
            contact(floor: y[0] >= radius + amplitude * sin(rate * t)),
            contact(pair[k in 0..$pairs]: y[k+1] - y[k] >= 2 * radius),
            start(resting: y[k in 0..$balls] = (2*k + 1) * radius, der(y[k in 0..$balls]) = amplitude * rate),
        )]
        struct $name<T = f64> {
            mass: T,
            radius: T,
            gravity: T,
            amplitude: T,
            rate: T,
        }

        impl Default for $name {
            fn default() -> Self {
                Self { mass: 0.1, radius: 0.02, gravity: 9.81, amplitude: 0.01, rate: 20.0 }
            }
        }
    )*};
}

macro_rules! piles {
    ($($name:ident $plates:literal $pairs:literal)*) => {$(
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(x[$plates], y[$plates]),
            kinetic   = sum(k in 0..$plates: mass/2 * (der(x[k])^2 + der(y[k])^2)),
            potential = sum(k in 0..$plates: mass * gravity * y[k]),
            contact(floor: y[0] >= 0),
            contact(pair[k in 0..$pairs]: y[k+1] - y[k] >= height),
            friction(base on floor: slip = der(x[0]) - jerk * t^2 / 2, static = mu),
            friction(grip[k in 0..$pairs] on pair[k]:
                slip = der(x[k+1]) - der(x[k]), static = mu * (1 - (k + 1) / 100)),
            start(resting: y[k in 0..$plates] = k * height),
        )]
        struct $name<T = f64> {
            mass: T,
            height: T,
            gravity: T,
            jerk: T,
            mu: T,
        }

        impl Default for $name {
            fn default() -> Self {
                Self { mass: 0.1, height: 0.02, gravity: 9.81, jerk: 5.0, mu: 0.5 }
            }
        }
    )*};
}

macro_rules! crowds {
    ($($name:ident $blocks:literal $pairs:literal)*) => {$(
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(x[$blocks], y[$blocks]),
            kinetic   = sum(k in 0..$blocks: mass/2 * (der(x[k])^2 + der(y[k])^2)),
            potential = sum(k in 0..$blocks: mass * gravity * y[k]),
            contact(floor[k in 0..$blocks]: y[k] >= 0),
            contact(pair[k in 0..$pairs]: x[k+1] - x[k] >= width),
            friction(grip[k in 0..$blocks] on floor[k]: slip = der(x[k]), static = mu),
            force(shove[k in 0..$blocks]: x[k] = push * sin(3 * (k + 1)^2)),
            start(resting: x[k in 0..$blocks] = k * width),
        )]
        struct $name<T = f64> {
            mass: T,
            width: T,
            gravity: T,
            mu: T,
            push: T,
        }

        impl Default for $name {
            fn default() -> Self {
                Self { mass: 0.1, width: 0.02, gravity: 9.81, mu: 0.3, push: 0.2 }
            }
        }
    )*};
}

rows!(Row2 2 1 Row4 4 3 Row8 8 7 Row16 16 15 Row32 32 31 Row64 64 63);
piles!(Pile2 2 1 Pile4 4 3 Pile8 8 7 Pile16 16 15 Pile32 32 31 Pile64 64 63);
crowds!(Crowd2 2 1 Crowd4 4 3 Crowd8 8 7 Crowd16 16 15 Crowd32 32 31);

/// Seconds that each number of contacts took.
struct Line {
    contacts: usize,
    times: [f64; 4],
    events: usize,
}

/// The shortest of several.
fn shortest(budget: Duration, mut work: impl FnMut() -> Duration) -> f64 {
    let begin = Instant::now();
    let mut best = Duration::MAX;
    for round in 0.. {
        if round >= 3 && begin.elapsed() > budget {
            break;
        }
        best = work().min(best);
    }
    best.as_secs_f64()
}

fn timed(work: impl FnOnce()) -> Duration {
    let begin = Instant::now();
    work();
    begin.elapsed()
}

fn measure<S: Derived<Scalar = f64> + Default>(until: f64) -> Line {
    const REPEATED: u32 = 100;
    let budget = Duration::from_millis(100);
    let scene = S::default();
    let start = scene.at(StartId(0));
    let simulation = Simulation::new(&scene).tolerance(1e-9);
    let mut first = || {
        let mut runner = simulation.runner();
        timed(|| drop(runner.run(&start, 0.0..1e-12)))
    };
    let first = shortest(budget, &mut first);
    let mut runner = simulation.runner();
    let again = shortest(budget, || timed(|| drop(runner.run(&start, 0.0..1e-12))));
    let mut runner = simulation.runner();
    let whole = shortest(budget, || {
        timed(|| {
            let outcome = runner.run(&start, 0.0..until);
            outcome.unwrap_or_else(|error| panic!("{}: {error}", S::DESCRIPTION.name));
        })
    });
    let events = runner.trajectory().events().len();
    let mode = simulation.runner();
    drop(mode);
    let mut dynamics = Dynamics::new(&scene, &Effects::all());
    let trajectory = runner.trajectory();
    dynamics.set_mode(&trajectory.phases()[0].mode);
    let (q, mut v) = (start.q.clone(), start.v.clone());
    let value = shortest(budget, || {
        let took = timed(|| {
            for _ in 0..REPEATED {
                // Another state each time: the same would not be evaluated again.
                v[0] += 1e-12;
                let _ = std::hint::black_box(dynamics.value(0.0, &q, &v).is_ok());
            }
        });
        took / REPEATED
    });
    Line {
        contacts: S::DESCRIPTION.contacts.len(),
        times: [value, again, first, whole],
        events,
    }
}

fn print(name: &str, lines: &[Line]) {
    println!(
        "\n{name:8} contacts    right-hand side      decision again     first decision          whole run  events"
    );
    for (i, line) in lines.iter().enumerate() {
        print!("{:17}", line.contacts);
        for (k, &time) in line.times.iter().enumerate() {
            let exponent = i.checked_sub(1).map(|before| {
                let before = &lines[before];
                (time / before.times[k]).ln() / (line.contacts as f64 / before.contacts as f64).ln()
            });
            let exponent = exponent.map_or(String::new(), |e| format!("^{e:.1}"));
            print!("{:11.2} µs {exponent:>5}", 1e6 * time);
        }
        println!("{:8}", line.events);
    }
}

fn main() {
    let rows = [
        measure::<Row2>(0.3),
        measure::<Row4>(0.3),
        measure::<Row8>(0.3),
        measure::<Row16>(0.3),
        measure::<Row32>(0.3),
        measure::<Row64>(0.3),
    ];
    print("row", &rows);
    let piles = [
        measure::<Pile2>(1.2),
        measure::<Pile4>(1.2),
        measure::<Pile8>(1.2),
        measure::<Pile16>(1.2),
        measure::<Pile32>(1.2),
        measure::<Pile64>(1.2),
    ];
    print("pile", &piles);
    let crowds = [
        measure::<Crowd2>(0.1),
        measure::<Crowd4>(0.1),
        measure::<Crowd8>(0.1),
        measure::<Crowd16>(0.1),
        measure::<Crowd32>(0.1),
    ];
    print("crowd", &crowds);
}
