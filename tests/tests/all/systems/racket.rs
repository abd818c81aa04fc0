//! A racket that a drive keeps at its speed hits a ball: what the ball gains is work of the drive, and the impact only loses.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, event, run_by, words};

/// Racket and ball on a line; both kinetic energies have names.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(racket, ball),
    kinetic(of_racket: heavy/2 * der(racket)^2),
    kinetic(of_ball: mass/2 * der(ball)^2),
    constraint(drive: racket == speed * t),
    contact(strings: ball >= racket, restitution = restitution),
)]
struct Racket {
    heavy: f64,
    mass: f64,
    speed: f64,
    restitution: f64,
}

/// The ball comes with the speed u: it meets the racket at u + w, and leaves it at e (u + w). The drive's impulse is m (1 + e)(u + w).
#[test]
fn what_drives_on_through_an_impact_works_in_it() {
    let scene = Racket {
        heavy: 0.3,
        mass: 0.06,
        speed: 20.0,
        restitution: 0.8,
    };
    for (method, came) in METHODS
        .into_iter()
        .zip([15.0, 0.0, 5.0].into_iter().cycle())
    {
        let start = state(&[0.0, 1.0], &[scene.speed, -came]);
        let run = run_by(&scene, (method, 1e-9), start, 0.2);
        assert_eq!(words(&run), ["strings impact"], "{method}");
        let (m, w, e) = (scene.mass, scene.speed, scene.restitution);
        let meets = came + w;
        agree(
            "time",
            event(&run, "strings", "impact").time,
            1.0 / meets,
            1e-10,
        );
        let ledger = run.ledger().expect("a ledger");
        let work = |name: &str| {
            let entries = ledger.work.iter().filter(|entry| entry.name == name);
            entries.map(|entry| entry.work).sum::<f64>()
        };
        agree("drive", work("drive"), m * (1.0 + e) * meets * w, 1e-9);
        let lost = m / 2.0 * (1.0 - e * e) * meets * meets;
        agree("strings", work("strings"), -lost, 1e-9);
        assert!(ledger.closure.abs() < 1e-9 * ledger.scale, "{method}");
    }
}
