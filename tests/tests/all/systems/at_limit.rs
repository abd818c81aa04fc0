//! Forces that are all that there is of them, to the last bit or a few less or more: blocks that friction just holds, beads that press with nothing.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agm, agree, all_agree, certified, event, methods_at,
    run_by, times, words,
};

/// A block on a spring on a rough floor, under a load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y + stiffness/2 * x^2,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = mu),
    force(pull: x = load),
)]
struct Held {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    mu: f64,
    load: f64,
}

/// Whether it is held or creeps, within rounding it stays where it is, by any method and at any tolerance.
#[test]
fn a_block_at_the_edge_of_its_dead_band_stays() {
    for (method, tolerance) in methods_at(
        [
            "taylor", "dop853", "dopri5", "verner98", "radau5", "rk4:0.01",
        ],
        TOLERANCES,
    ) {
        let mut random = Random::new(9);
        for _ in 0..50 {
            let scene = Held {
                mass: random.between(0.2, 3.0),
                gravity: random.between(1.0, 20.0),
                stiffness: random.between(1.0, 50.0),
                mu: random.between(0.1, 0.9),
                load: random.between(-5.0, 5.0),
            };
            let most = random.sign() * scene.mu * scene.mass * scene.gravity;
            let most = most * (1.0 + random.between(-1e-14, 1e-14));
            let x = (scene.load + most) / scene.stiffness;
            let start = state(&[x, 0.0], &[0.0, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 1.0);
            let moved = (motion.final_state().q[0] - x).abs();
            assert!(moved < 1e-11, "{method} {tolerance:e}: {moved}");
        }
    }
}

/// From three times as far on one side its spring carries it to the edge on the other, within half a period, and it stays there although errors of the
/// motion have put it a little beyond.
#[test]
fn a_block_that_comes_to_rest_at_the_edge_of_its_dead_band_stays() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(67);
        for _ in 0..20 {
            let scene = Held {
                mass: random.between(1.0, 10.0),
                gravity: 9.81,
                stiffness: random.between(1.0, 20.0),
                mu: random.between(0.1, 0.9),
                load: 0.0,
            };
            let edge = random.sign() * scene.mu * scene.mass * scene.gravity / scene.stiffness;
            let half = core::f64::consts::PI * (scene.mass / scene.stiffness).sqrt();
            let start = state(&[-3.0 * edge, 0.0], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), start, 3.0 * half);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            assert_eq!(words(&run), ["grip slips", "grip sticks"], "{what}");
            let within = 20.0 * tolerance.max(1e-11) * edge.abs().max(1.0);
            agree(&what, run.final_state().q[0], edge, within);
            certified(&what, &run);
        }
    }
}

/// A bead inside a hoop whose rim gives way beyond its radius: pressed against it, the bead stays where the branch of `max` changes. A force
/// across drives steps that do not end where it is at rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = gravity * y + stiffness * max(x^2 + y^2 - radius^2, 0)^2,
    contact(hoop: x^2 + y^2 <= radius^2),
    force(drive: z = sin(20 * t)),
)]
struct Rim {
    gravity: f64,
    radius: f64,
    stiffness: f64,
}

/// Let go level with the centre it comes back to that height, at rest and pressing with nothing: whether it then parts from the rim by the error
/// of the motion or not, gap and branch agree on it. T = 2π √(r/g) / agm(1, √½).
#[test]
fn a_bead_comes_back_to_where_it_presses_with_nothing() {
    let rim = Rim {
        gravity: 9.81,
        radius: 0.7,
        stiffness: 300.0,
    };
    let period =
        core::f64::consts::TAU * (rim.radius / rim.gravity).sqrt() / agm(1.0, 0.5_f64.sqrt());
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let start = state(&[rim.radius, 0.0, 0.0], &[0.0; 3]);
        let motion = run_by(&rim, (method, tolerance), start, 2.0 * period);
        let end = motion.final_state();
        let within = 200.0 * tolerance;
        let what = format!("{method} {tolerance:.0e}");
        agree(&what, end.q[0], rim.radius, within);
        agree(&what, end.q[1], 0.0, within);
        agree(&what, end.v[1], 0.0, within);
        certified(&what, &motion);
    }
}

/// A bead of 1 kg on a rough curve of second order.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(ground: steep * y + bend * x^2 / 2 + round * y^2 / 2 >= 0),
    friction(grip on ground: slip = (steep + round*y) * der(x) - bend*x * der(y), static = mu),
)]
struct Bank {
    gravity: f64,
    steep: f64,
    bend: f64,
    round: f64,
    mu: f64,
}

/// Where the slope is as steep as friction can hold, to the last bit: on hills, in bowls and on ellipses it stays.
#[test]
fn a_bead_where_a_curve_is_just_as_steep_as_friction_holds_stays() {
    for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], TOLERANCES) {
        let mut random = Random::new(31);
        for case in 0..60 {
            let (bend, round) = match case % 3 {
                0 => (random.between(0.2, 2.0), 0.0),
                1 => (random.between(-2.0, -0.2), 0.0),
                _ => (random.between(-2.0, -0.2), random.between(-2.0, -0.2)),
            };
            let scene = Bank {
                gravity: 9.81,
                steep: 1.0,
                bend,
                round,
                mu: 0.0,
            };
            let x: f64 = random.sign() * random.between(0.05, 0.4);
            // The lower one of the two places above x.
            let y = match round {
                0.0 => -bend * x * x / 2.0,
                _ => (-1.0 + (1.0 - round * bend * x * x).sqrt()) / round,
            };
            let slope = (bend * x / (1.0 + round * y)).abs();
            let ulps = random.below(3) as f64 - 1.0;
            let mu = slope * (1.0 + ulps * f64::EPSILON);
            let scene = Bank { mu, ..scene };
            let what = format!("{scene:?} at {x} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), state(&[x, y], &[0.0; 2]), 2.0);
            all_agree(&what, &run.final_state().q, &[x, y], 1e-11);
            assert!(run.work().steps < 200, "{what}: {:?}", run.work());
            certified(&what, &run);
        }
    }
}

/// A crate on two rough feet under a push that just does not tip it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, z, tilt),
    define(
        left = [x - half*cos(tilt) + low*sin(tilt), z - half*sin(tilt) - low*cos(tilt)],
        right = [x + half*cos(tilt) + low*sin(tilt), z + half*sin(tilt) - low*cos(tilt)],
    ),
    kinetic = mass/2 * (der(x)^2 + der(z)^2) + inertia/2 * der(tilt)^2,
    potential = mass * gravity * z,
    contact(heel: left[1] >= 0),
    contact(toe: right[1] >= 0),
    friction(drag on heel: slip = der(left[0]), static = hold, kinetic = rub),
    friction(grip on toe: slip = der(right[0]), static = hold, kinetic = rub),
    force(shove: (push + grows*t, 0) at (x - high*sin(tilt), z + high*cos(tilt))),
    start(rest: z = low),
)]
struct Crate {
    mass: f64,
    inertia: f64,
    gravity: f64,
    half: f64,
    low: f64,
    high: f64,
    hold: f64,
    rub: f64,
    push: f64,
    grows: f64,
}

/// m g a = F h in round numbers: nothing presses the heel, and all of the friction is the toe's.
#[test]
fn a_crate_that_is_just_not_tipped_stays() {
    for mass in [1.0, 1.5, 2.0, 3.0] {
        for half in [0.1, 0.2, 0.3, 0.6, 0.7] {
            for low in [0.3, 0.5, 1.0] {
                let height = 2.0 * low;
                let push = mass * 10.0 * half / height;
                let mu = half / height + 0.1;
                let scene = Crate {
                    mass,
                    inertia: 0.3,
                    gravity: 10.0,
                    half,
                    low,
                    high: low,
                    hold: mu,
                    rub: mu,
                    push,
                    grows: 0.0,
                };
                for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-6, 1e-9]) {
                    let what = format!("{scene:?} by {method} at {tolerance:e}");
                    let run = run_by(&scene, (method, tolerance), scene.at(Crate::REST), 1.0);
                    let end = run.final_state();
                    all_agree(&what, &end.q, &[0.0, low, 0.0], 1e-11);
                    let mut sampler = run.sampler();
                    let now = sampler.at(1.0).expect("recorded");
                    agree(&what, now.force(Crate::GRIP), -push, 1e-8 * push);
                    certified(&what, &run);
                }
            }
        }
    }
}

/// A push that grows tips it where m g a = F h, although both feet could slide a little later, and slide on with less friction: what holds has not been
/// overcome.
#[test]
fn a_crate_tips_a_little_before_it_would_slide() {
    for (mass, half, rub, nearly) in [
        (2.0, 0.4, 0.25, 1e-4),
        (1.0, 0.3, 0.2, 1e-5),
        (3.0, 0.5, 0.4, 1e-6),
    ] {
        let (hold, low) = (0.5, 0.5);
        let scene = Crate {
            mass,
            inertia: 0.3,
            gravity: 10.0,
            half,
            low,
            high: half / hold * (1.0 + nearly) - low,
            hold,
            rub,
            push: 0.0,
            grows: 10.0,
        };
        let tips = mass * 10.0 * half / (scene.high + low) / scene.grows;
        // Half of the time until the push is as much as the toe holds.
        let until = tips * (1.0 + 0.5 * nearly);
        for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(Crate::REST), until);
            assert_eq!(words(&run), ["heel lost"], "{what}");
            agree(
                &what,
                event(&run, "heel", "lost").time,
                tips,
                10.0 * tolerance,
            );
            certified(&what, &run);
        }
    }
}

/// A body that two brakes hold together, pushed by what a load becomes at an instant.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = der(x)^2/2,
    friction(one: slip = der(x), limit = (share, share/2)),
    friction(other: slip = der(x), limit = (1 - share, (1 - share)/2)),
    force(push: x = side*if(form <= 0, min(t, 1), 1 - abs(t - 1))),
    start(rest),
)]
struct TwoBrakes {
    share: f64,
    side: f64,
    form: f64,
}

/// A load that grows to what both hold together, exactly, and then no further: they hold it as one of that strength would.
#[test]
fn brakes_hold_a_load_that_stops_growing_at_their_limit() {
    for share in [0.75, 0.5, 1.0, 0.125] {
        for side in [1.0, -1.0] {
            for form in [0.0, 1.0] {
                let brakes = TwoBrakes { share, side, form };
                let (method, tolerance) = (SINGLE_METHODS[0], 1e-9);
                let run = run_by(
                    &brakes,
                    (method, tolerance),
                    brakes.at(TwoBrakes::REST),
                    2.0,
                );
                let what = format!("{brakes:?}");
                agree(&what, run.final_state().q[0], 0.0, 0.0);
                let slips = ["one", "other"].map(|brake| times(&run, brake, "slips"));
                assert!(slips.iter().all(Vec::is_empty), "{what}: {:?}", words(&run));
                certified(&what, &run);
            }
        }
    }
}

/// A body in two guides with friction, one of which also holds across the other: so the load of that passes zero.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + der(z)^2),
    constraint(guide: y == 0),
    constraint(base: z == 0),
    force(load: y = t - 1),
    force(weight: z = -20),
    force(push: x = strength),
    friction(side on guide: slip = der(x), static = mu),
    friction(sole on base: slip = der(x) + lean*der(y), static = mu, kinetic = rub),
    start(rest),
)]
struct Guided {
    mass: f64,
    strength: f64,
    lean: f64,
    mu: f64,
    rub: f64,
}

/// The sole alone holds up to 20 μ. That the load of the guide passes zero, where the guide holds nothing, ends nothing.
#[test]
fn a_guide_whose_load_passes_zero_lets_the_other_one_hold() {
    for (strength, lean, mu, rub) in [
        (1.9, 1.0, 0.1, 0.09),
        (1.9, 1.0, 0.1, 0.1),
        (1.5, 1.0, 0.1, 0.05),
        (1.7, -0.6, 0.1, 0.08),
        (2.7, 0.5, 0.15, 0.1),
    ] {
        let body = Guided {
            mass: 1.0,
            strength,
            lean,
            mu,
            rub,
        };
        for (method, tolerance) in SINGLE_METHODS.map(|method| (method, 1e-9)) {
            let what = format!("{body:?} by {method}");
            let run = run_by(&body, (method, tolerance), body.at(Guided::REST), 12.0);
            assert!(words(&run).is_empty(), "{what}: {:?}", words(&run));
            agree(&what, run.final_state().q[0], 0.0, 0.0);
            certified(&what, &run);
        }
    }
}
