//! A drawer that jams in its guides, with a stop behind it: all loads are zero to begin with, and how they are shared is not determined.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at, run_by};

/// Pulled aside its middle, so that it presses against a guide in front and against one behind.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    kinetic = (der(x)^2 + der(y)^2 + der(turn)^2) / 2,
    force(hand: x = pull * t),
    force(twist: turn = arm * abs(pull) * t),
    constraint(front: y + half * turn == 0),
    constraint(behind: y - half * turn == 0),
    contact(stop: x >= 0),
    friction(rubs_in_front on front: slip = der(x), static = mu),
    friction(rubs_behind on behind: slip = der(x), static = mu),
    start(go),
)]
struct Drawer {
    pull: f64,
    arm: f64,
    half: f64,
    mu: f64,
}

/// Each guide carries a p t/2b: it jams from μ a ≥ b on, and slides by (1 − μ a/b) p t otherwise. Pushed in it stays.
#[test]
fn a_drawer_jams_by_its_arm() {
    for (pull, arm, half, mu) in [
        (7.0, 0.9, 0.3, 0.4),
        (7.0, 0.9, 0.3, 0.3),
        (3.0, 0.5, 0.4, 0.9),
        (3.0, 0.5, 0.4, 0.6),
        (-5.0, 0.9, 0.3, 0.4),
        (-5.0, 0.9, 0.3, 0.1),
    ] {
        let scene = Drawer {
            pull,
            arm,
            half,
            mu,
        };
        for pair in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("{scene:?} by {pair:?}");
            let run = run_by(&scene, pair, state(&[0.0; 3], &[0.0; 3]), 3.0);
            certified(&what, &run);
            let moves = (1.0 - mu * arm / half).max(0.0);
            let x = pull.max(0.0) * moves * 27.0 / 6.0;
            agree(&what, run.final_state().q[0], x, 10.0 * pair.1);
        }
    }
}
