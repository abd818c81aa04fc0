//! Frictions that can hold nothing, for good or for an instant, beside others that hold the same slip.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, TOLERANCES, agree, certified, event, methods_at, root, run_by, times, words,
};

/// A block on two feet, one of them on ice.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + mass/20*der(turn)^2,
    potential = 9.81*mass*y,
    contact(front: y - turn/2 >= 0),
    contact(rear: y + turn/2 >= 0),
    friction(sole on front: slip = der(x), static = mu, kinetic = rub),
    friction(skate on rear: slip = der(x), static = ice),
    force(pull: x = -strength),
    start(go: der(x) = speed),
)]
struct OnIce {
    mass: f64,
    mu: f64,
    rub: f64,
    ice: f64,
    strength: f64,
    speed: f64,
}

/// The other foot carries half of the weight, stops the block, and holds it there.
#[test]
fn a_foot_on_ice_lets_the_other_one_hold() {
    for (mass, mu, rub, strength, speed) in [
        (1.0, 0.3, 0.1, 1.0, 1.0),
        (2.5, 0.5, 0.5, 4.0, 0.7),
        (0.6, 0.8, 0.2, 0.9, 1.3),
        (1.0, 0.4, 0.3, 1.2, 0.0),
    ] {
        let block = OnIce {
            mass,
            mu,
            rub,
            ice: 0.0,
            strength,
            speed,
        };
        let slows = (rub * 9.81 * mass / 2.0 + strength) / mass;
        let goes = speed * speed / (2.0 * slows);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{block:?} by {method} at {tolerance:e}");
            let run = run_by(&block, (method, tolerance), block.at(OnIce::GO), 3.0);
            agree(&what, run.final_state().q[0], goes, 100.0 * tolerance);
            assert!(times(&run, "sole", "reverses").is_empty(), "{what}");
            if speed > 0.0 {
                let stops = event(&run, "sole", "sticks").time;
                agree(&what, stops, speed / slows, 100.0 * tolerance);
            }
            certified(&what, &run);
        }
    }
}

/// A mass that a brake of constant strength holds, and one that fades away, against a force that comes and goes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = der(x)^2/2,
    force(push: x = strength*sin(t)^8),
    friction(fades: slip = der(x), limit = max(0, 1 - fade*t)),
    friction(holds: slip = der(x), limit = 1),
)]
struct Fades {
    strength: f64,
    fade: f64,
}

/// An overload of half a per cent lasts for a tenth of a second. sin⁸t = (35 − 56 cos 2t + 28 cos 4t − 8 cos 6t + cos 8t)/128.
#[test]
fn an_overload_is_felt_beside_a_brake_that_has_faded_away() {
    for (strength, fade) in [(1.005, 1.0), (1.001, 0.8), (1.02, 2.0), (1.3, 1.0)] {
        let scene = Fades { strength, fade };
        let slips = f64::asin(f64::powf(1.0 / strength, 0.125));
        let impulse = |t: f64| {
            let harmonics = [(2.0, -28.0), (4.0, 7.0), (6.0, -4.0 / 3.0), (8.0, 0.125)];
            let parts = harmonics.map(|(k, part)| part * f64::sin(k * t));
            strength * (35.0 * t + parts.iter().sum::<f64>()) / 128.0 - t
        };
        let sticks = root(
            |t| impulse(t) - impulse(slips),
            PI - slips,
            PI - slips + 0.7,
        );
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), state(&[0.0], &[0.0]), 3.0);
            agree(&what, event(&run, "holds", "slips").time, slips, 1e-7);
            agree(&what, event(&run, "holds", "sticks").time, sticks, 1e-5);
            certified(&what, &run);
        }
    }
}

/// The same mass, which the second brake could always hold by itself, but hardly.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = der(x)^2/2 + der(y)^2/2,
    force(push: x = strength*cos(5*(t - 1) + phase)),
    force(pulls: y = strength*cos(5*(t - 1) + phase)),
    friction(fades: slip = der(x), limit = max(0, 1 - t)),
    friction(holds: slip = der(x), limit = (1, 1/2)),
    friction(touches: slip = der(y) - der(x), limit = abs(t - 1)),
    friction(keeps: slip = der(y), limit = (1, 1/2)),
)]
struct Hardly {
    strength: f64,
    phase: f64,
}

/// Nothing slips as a limit reaches zero, or touches it.
#[test]
fn a_limit_that_reaches_zero_is_no_slip() {
    for (strength, phase) in [(0.99, 0.05), (0.999, 0.0), (0.9, 0.3), (0.5, -0.4)] {
        let scene = Hardly { strength, phase };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 2], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), rest, 3.0);
            let slips = words(&run)
                .into_iter()
                .filter(|word| !word.contains("branches"));
            assert_eq!(slips.collect::<Vec<_>>(), [""; 0], "{what}");
            certified(&what, &run);
        }
    }
}

/// A disc on three pads, the last of which does nothing.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, turn),
    kinetic = der(x)^2/2 + der(turn)^2/8,
    force(push: x = strength*sin(4*t)),
    friction(pad[k in 0..2]: slip = der(x), limit = 1),
    friction(worn: slip = der(x) + der(turn)/2, limit = 0),
)]
struct Worn {
    strength: f64,
}

/// The two others hold 2 N: a little more than that, for a short time, is felt.
#[test]
fn worn_pads_do_not_hide_what_the_others_hold() {
    for strength in [2.01, 2.002, 2.1] {
        let scene = Worn { strength };
        let slips = f64::asin(2.0 / strength) / 4.0;
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 2], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), rest, 0.6);
            agree(&what, event(&run, "pad[0]", "slips").time, slips, 1e-7);
            certified(&what, &run);
        }
    }
}

/// A plate on two pads that hold, and one that has faded away, pushed and turned ever harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    kinetic = (der(x)^2 + der(y)^2)/2 + der(turn)^2/20,
    friction(left: slip = (der(x), der(y) + arm*der(turn)), limit = strength),
    friction(right: slip = (der(x), der(y) - arm*der(turn)), limit = strength),
    friction(faded: slip = (der(x) + 0.5*der(turn), der(y)), limit = max(0, 0.5 - t)),
    force(push: x = t),
    force(turns: turn = twist*t),
)]
struct Plate {
    strength: f64,
    arm: f64,
    twist: f64,
}

/// Each pad takes half of the push along and twist/(2 arm) of it across: all slip when √(1/4 + twist²/(4 arm²)) t is what a pad holds.
#[test]
fn a_pad_that_has_faded_slips_with_the_others() {
    for (strength, arm, twist) in [(0.5, 0.4, 0.1), (0.7, 0.3, 0.2), (0.4, 0.5, -0.15)] {
        let plate = Plate {
            strength,
            arm,
            twist,
        };
        let slips = 2.0 * strength / f64::hypot(1.0, twist / arm);
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{plate:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 3], &[0.0; 3]);
            let run = run_by(&plate, (method, tolerance), rest, slips + 0.3);
            for pad in ["left", "right", "faded"] {
                agree(&what, event(&run, pad, "slips").time, slips, 1e-7);
            }
            certified(&what, &run);
        }
    }
}

/// A bead on a rail that is moved aside smoothly, once. Before and after that nothing presses it but the rounding of tanh.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2*(der(x)^2 + der(y)^2),
    constraint(rail: x == aside * tanh((t - middle)/lasts)),
    friction(rub on rail: slip = der(y), static = mu),
    start(go: x = -aside * tanh(middle/lasts), der(y) = 3),
)]
struct MovedRail {
    mass: f64,
    aside: f64,
    middle: f64,
    lasts: f64,
    mu: f64,
}

/// It is slowed by μ times what the velocity of the rail rises and falls by: 2 μ a/w.
#[test]
fn a_rail_that_does_not_press_rubs_as_it_is_moved() {
    for (lasts, middle) in [(0.2, 5.0), (0.1, 5.0), (0.03, 4.321), (0.004, 3.0)] {
        let scene = MovedRail {
            mass: 1.3,
            aside: 7.0 * lasts,
            middle,
            lasts,
            mu: 0.1,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = scene.at(MovedRail::GO);
            let run = run_by(&scene, (method, tolerance), start, 10.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            agree(&what, run.final_state().v[1], 1.6, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}
