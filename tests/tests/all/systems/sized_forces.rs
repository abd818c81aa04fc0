//! Marks, stops and outputs of the size of a force, or of the larger of two: they read forces that jump, and change nothing.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, all_agree, certified, methods_at, times};

/// A sledge on a spring, its parameters and more, and the items by which it is watched.
macro_rules! sledge {
    ($(#[$words:meta])* $name:ident { $($other:ident)? } $($watches:tt)*) => {
        $(#[$words])*
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
                emit = data,
            coordinates(x, y),
            kinetic = mass/2 * (der(x)^2 + der(y)^2),
            potential = mass * 9.81 * y + spring/2 * x^2,
            contact(track: y >= 0),
            friction(runner on track: slip = der(x), static = hold, kinetic = rub),
            force(shake: x = drive * cos(beat * t)),
            force(load: y = -press * sin(swell * t)),
            $($watches)*
        )]
        struct $name {
            mass: f64,
            spring: f64,
            hold: f64,
            rub: f64,
            drive: f64,
            beat: f64,
            press: f64,
            swell: f64,
            $($other: f64,)?
        }
    };
}

sledge! {
    /// A sledge on a spring is shaken along its track, and pressed onto it by a load that comes and goes: its runner sticks, slips and turns back.
    Sledge { level }
    observe(size = abs(runner)),
    mark(large: abs(runner) >= level),
    mark(rises: runner >= level),
    mark(falls: runner <= -level),
    mark(larger: max(runner, -track) - level),
    stop(never: abs(runner) <= -level/10),
}

sledge! {
    /// The same without anything that is watched.
    Unwatched {}
}

/// A pendulum in wind that begins to blow; how hard its rod is pulled.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 9.81 * y,
    constraint(rod: x^2 + y^2 == length^2),
    force(wind: x = if(t >= begin, gust, 0)),
    observe(load = abs(rod)),
)]
struct Pendulum {
    length: f64,
    begin: f64,
    gust: f64,
}

#[test]
fn what_watches_the_size_of_a_friction_tells_its_levels_and_moves_nothing() {
    let mut random = Random::new(61);
    for _ in 0..12 {
        let sledge = Sledge {
            mass: random.between(0.5, 2.0),
            spring: random.between(3.0, 9.0),
            hold: random.between(0.4, 0.6),
            rub: random.between(0.1, 0.3),
            drive: random.between(2.0, 7.0),
            beat: random.between(1.0, 4.0),
            press: random.between(1.0, 4.0),
            swell: random.between(1.0, 4.0),
            level: random.between(0.5, 3.0),
        };
        let bare = Unwatched {
            mass: sledge.mass,
            spring: sledge.spring,
            hold: sledge.hold,
            rub: sledge.rub,
            drive: sledge.drive,
            beat: sledge.beat,
            press: sledge.press,
            swell: sledge.swell,
        };
        let start = || state(&[random_start(&sledge), 0.0], &[0.0, 0.0]);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("{sledge:?} by {method:?} at {tolerance:e}");
            let by = (method, tolerance);
            let run = Simulation::new(&sledge).method(by.0).tolerance(by.1);
            let run = run.run(start(), 0.0..5.0).expect("a run");
            let plain = Simulation::new(&bare).method(by.0).tolerance(by.1);
            let plain = plain.run(start(), 0.0..5.0).expect("a run");
            assert_eq!(run.last_time(), 5.0, "{what}");
            let (here, there) = (run.final_state(), plain.final_state());
            all_agree(&what, &here.q, &there.q, 1e3 * tolerance);
            // Where the friction turns back its size stays, and one level is left as the other one is reached.
            let turns = [
                times(&run, "runner", "reverses"),
                times(&run, "runner", "sticks"),
            ]
            .concat();
            let apart = |t: &f64| turns.iter().all(|turn| (t - turn).abs() > 1e-5);
            let of = |mark: &str| {
                let mut found = times(&run, mark, "mark");
                found.retain(apart);
                found
            };
            let mut both = [of("rises"), of("falls")].concat();
            both.sort_by(f64::total_cmp);
            all_agree(&what, &of("large"), &both, 1e3 * tolerance);
            let mut sampler = run.sampler();
            for k in 0..=40 {
                let now = sampler.at(0.1234 * f64::from(k)).expect("recorded");
                let size = now.force(Sledge::RUNNER).abs();
                agree(&what, now.observe(Sledge::SIZE), size, 1e-9 * (1.0 + size));
            }
            certified(&what, &run);
        }
    }
}

/// Somewhere on the track, another place for every sledge.
fn random_start(sledge: &Sledge) -> f64 {
    (sledge.drive * 12.9898).sin()
}

#[test]
fn the_size_of_a_tension_is_told_beside_a_force_that_changes() {
    for (length, begin, gust) in [(0.7, 0.4, 3.0), (1.0, 1.1, -6.0), (2.5, 0.0, 1.0)] {
        let pendulum = Pendulum {
            length,
            begin,
            gust,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("{pendulum:?} by {method:?} at {tolerance:e}");
            let simulation = Simulation::new(&pendulum)
                .method(method)
                .tolerance(tolerance);
            let start = state(&[0.6 * length, -0.8 * length], &[0.0, 0.0]);
            let run = simulation.run(start, 0.0..3.0).expect("a run");
            let mut sampler = run.sampler();
            for k in 1..30 {
                let now = sampler.at(0.0987 * f64::from(k)).expect("recorded");
                let rod = now.force(Pendulum::ROD).abs();
                agree(&what, now.observe(Pendulum::LOAD), rod, 1e-9 * (1.0 + rod));
            }
            certified(&what, &run);
        }
    }
}
