//! Frictions that can hold nothing for an instant, or from then on, while others hold the same slip.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A block that a brake holds, and a guide whose force passes through zero; and another one, at a stop.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, u, w),
    kinetic = (der(x)^2 + der(y)^2 + der(u)^2 + der(w)^2)/2,
    force(pull: x = strength),
    force(turns: y = t - zero),
    constraint(guide: y == 0),
    friction(brake: slip = der(x), limit = (held, rubs)),
    friction(rub on guide: slip = der(x), static = mu),
    force(push: u = t - 2*zero),
    force(turns_too: w = t - zero),
    constraint(rail: w == 0),
    contact(stop: u >= 0),
    friction(slide on rail: slip = der(u), static = mu, kinetic = mu/2),
)]
struct Guided {
    strength: f64,
    zero: f64,
    held: f64,
    rubs: f64,
    mu: f64,
}

/// A friction that can hold nothing for an instant leaves everything to those that can: none of them lets go. The block at the stop leaves it when what pushes it
/// is more than its friction holds, t − 2z = μ (t − z).
#[test]
fn a_guide_whose_force_passes_through_zero_leaves_its_load_to_the_brake() {
    for (strength, zero, held, rubs, mu) in [
        (2.0, 1.0, 9.0, 1.0, 0.5),
        (3.0, 0.7, 4.0, 0.5, 0.3),
        (1.5, 1.3, 1.6, 0.2, 0.6),
    ] {
        let scene = Guided {
            strength,
            zero,
            held,
            rubs,
            mu,
        };
        let leaves = zero * (2.0 - mu) / (1.0 - mu);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 4], &[0.0; 4]);
            let run = run_by(&scene, (method, tolerance), rest, leaves + 1.0);
            agree(&what, run.final_state().q[0], 0.0, 10.0 * tolerance);
            let lost = times(&run, "stop", "lost");
            agree(&what, lost[0], leaves, 100.0 * tolerance);
            // From there on half of that friction acts.
            let [weight, force] = [
                1.0 - mu / 2.0,
                leaves - 2.0 * zero - mu / 2.0 * (leaves - zero),
            ];
            let gone = force / 2.0 + weight / 6.0;
            agree(&what, run.final_state().q[2], gone, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// Two brakes on one slip, of which one fades or swings.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, u),
    kinetic = (der(x)^2 + der(u)^2)/2,
    force(pull: x = strength),
    force(pulls: u = strength),
    friction(brake: slip = der(x), limit = (held, rubs)),
    friction(fades: slip = der(x), limit = max(fade - t, 0)),
    friction(other: slip = der(u), limit = (held, rubs)),
    friction(swings: slip = der(u), limit = abs(sin(3*t))),
)]
struct TwoBrakes {
    strength: f64,
    held: f64,
    rubs: f64,
    fade: f64,
}

#[test]
fn a_brake_that_fades_leaves_its_load_to_the_other() {
    for (strength, held, rubs, fade) in [(2.0, 9.0, 1.0, 1.0), (1.0, 1.1, 0.1, 0.6)] {
        let scene = TwoBrakes {
            strength,
            held,
            rubs,
            fade,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 2], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), rest, 4.0);
            for q in &run.final_state().q {
                agree(&what, *q, 0.0, 10.0 * tolerance);
            }
            certified(&what, &run);
        }
    }
}

/// A puck on ice that a force pushes to and fro, or that is sent up a slope.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, u, w),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + der(u)^2 + der(w)^2)/2,
    potential = 9.81*z,
    contact(ice: z >= 0),
    friction(none on ice: slip = (der(x), der(y)), static = mu),
    friction(no_more: slip = (der(u), der(w)), limit = mu),
    force(push: x = strength*sin(t)),
    force(slope: u = -strength),
    start(go: der(u) = speed),
)]
struct Ice {
    mu: f64,
    strength: f64,
    speed: f64,
}

/// A slip of two components without friction comes to zero and goes on: it needs no direction there.
#[test]
fn without_friction_slips_pass_through_zero() {
    for (strength, speed) in [(1.0, 1.0), (0.3, 0.5), (2.0, 0.0)] {
        let scene = Ice {
            mu: 0.0,
            strength,
            speed,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(Ice::GO), 5.0);
            let pushed = strength * (5.0 - 5.0_f64.sin());
            let slides = 5.0 * speed - 12.5 * strength;
            let [x, .., u, _] = run.final_state().q[..] else {
                panic!("five coordinates")
            };
            agree(&what, x, pushed, 100.0 * tolerance);
            agree(&what, u, slides, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A load on a moving belt, held by two brakes that take turns, and always can hold it together.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = der(x)^2/2,
    define(belt = swing*sin(rate*t), share = (1 - cos(shift*t))/2),
    force(pull: x = strength),
    friction(first: slip = der(x) - belt, limit = (most*(1 - share), 0.3*most*(1 - share))),
    friction(second: slip = der(x) - belt, limit = (most*share, 0.3*most*share)),
)]
struct Turns {
    swing: f64,
    rate: f64,
    shift: f64,
    strength: f64,
    most: f64,
}

/// What either can hold touches zero again and again, where the other one holds all.
#[test]
fn brakes_that_take_turns_hold() {
    for (swing, rate, shift, strength) in [
        (0.6, 1.5, 4.22, 3.58),
        (0.4, 2.1, 7.0, 2.5),
        (1.0, 1.2, 5.3, 4.4),
    ] {
        let scene = Turns {
            swing,
            rate,
            shift,
            strength,
            most: 8.0,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), state(&[0.0], &[0.0]), 3.0);
            for brake in ["first", "second"] {
                assert!(times(&run, brake, "slips").is_empty(), "{what}");
            }
            let carried = swing / rate * (1.0 - (3.0 * rate).cos());
            agree(&what, run.final_state().q[0], carried, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}
