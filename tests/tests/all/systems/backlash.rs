//! Two gears with a play between their teeth: the gap is a small difference of large angles.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, event, methods_at, run_by};

/// One gear is driven; the other is taken along once the play is used up.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b),
    kinetic = driving/2 * der(a)^2 + driven/2 * der(b)^2,
    contact(tooth: b - a >= -play, restitution = e),
    force(drive: a = torque * cos(rate * t)),
)]
struct Gears {
    driving: f64,
    driven: f64,
    play: f64,
    torque: f64,
    rate: f64,
    e: f64,
}

const METHODS: [&str; 4] = ["auto", "dopri5", "dop853", "verner98"];

/// Whatever the blows are, the momentum is the impulse of the drive, and once the teeth stay together so is that of each gear.
#[test]
fn gears_that_have_met_turn_as_one() {
    for (e, begin, rate) in [(0.3, 0.0, 3.0), (0.5, 0.7, 2.0), (0.15, -2.0, 4.0)] {
        let gears = Gears {
            driving: 0.1,
            driven: 0.2,
            play: 0.05,
            torque: 1.0,
            rate,
            e,
        };
        let (whole, until) = (gears.driving + gears.driven, 0.38);
        // While the torque is positive the teeth stay together.
        let speed = gears.torque / (rate * whole) * (rate * until).sin();
        let turned = gears.torque / (rate * rate * whole) * (1.0 - (rate * until).cos());
        for by in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("e = {e}, {by:?}");
            let start = state(&[begin, begin], &[0.0, 0.0]);
            let trajectory = run_by(&gears, by, start, until);
            let rest = event(&trajectory, "tooth", "accumulates");
            assert!(rest.time < until, "{what}: {}", rest.time);
            assert!(trajectory.events().len() < 60, "{what}");
            let end = trajectory.final_state();
            let bound = (30.0 * by.1).max(1e-11);
            agree(&what, end.v[0], speed, bound);
            agree(&what, end.v[1], speed, bound);
            agree(&what, end.q[1] - end.q[0], -gears.play, bound);
            let mean = (gears.driving * end.q[0] + gears.driven * end.q[1]) / whole;
            agree(&what, mean - begin, turned, bound);
        }
    }
}

/// An engine pulls and pushes a wagon through a coupling with play, far down the line.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = engine/2 * der(x)^2 + wagon/2 * der(y)^2,
    contact(buffer: x - y >= length, restitution = e),
    contact(hook: x - y <= length + play, restitution = e),
    force(drive: x = pull * sin(rate * t)),
    dissipation(bearings: drag/2 * der(y)^2),
)]
struct Train {
    engine: f64,
    wagon: f64,
    length: f64,
    play: f64,
    pull: f64,
    rate: f64,
    drag: f64,
    e: f64,
}

/// The play is used up forth and back, and each time the bounces end, in the same number of events whatever the method: the last of them
/// are lower than the gap is rounded.
#[test]
fn bounces_below_the_rounding_of_the_gap_accumulate() {
    let train = Train {
        engine: 2.0,
        wagon: 3.0,
        length: 4.0,
        play: 0.1,
        pull: 20.0,
        rate: 2.0,
        drag: 1.0,
        e: 0.4,
    };
    for tolerance in TOLERANCES {
        let runs = METHODS.map(|method| {
            let start = state(&[104.05, 100.0], &[3.0, 3.0]);
            let run = run_by(&train, (method, tolerance), start, 20.0);
            let accumulates = |e: &&Event<f64>| matches!(e.kind, EventKind::Accumulates { .. });
            (
                run.events().len(),
                run.events().iter().filter(accumulates).count(),
            )
        });
        let (events, ends) = runs[0];
        assert!(ends > 8 && events < 600, "{tolerance:e}: {runs:?}");
        assert!(
            runs.iter().all(|run| *run == runs[0]),
            "{tolerance:e}: {runs:?}"
        );
    }
}
