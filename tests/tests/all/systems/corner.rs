//! Forces that are not determined where directions of friction turn: guards of such forces are those of one instant.

use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, event, methods_at, run_by, times, words,
};

/// A ball rolls along the corner of a tub's wall and floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    attitude(ball: q),
    define(
        far = sqrt(x[0]^2 + x[1]^2),
        inward = [-x[0]/far, -x[1]/far, 0],
        ahead = [x[1]/far*(-1), x[0]/far, 0],
        at_wall = der(x) - radius*cross(ball.space_rate, inward),
        at_floor = der(x) - radius*cross(ball.space_rate, [0, 0, 1]),
    ),
    kinetic = mass/2*dot(der(x), der(x)) + mass*radius^2/5*dot(ball.body_rate, ball.body_rate),
    potential = mass*gravity*x[2],
    contact(wall: tub - radius - far >= 0),
    contact(floor: x[2] >= 0),
    friction(wall_grip on wall: slip = (dot(at_wall, ahead), at_wall[2]), static = wall_mu),
    friction(floor_grip on floor: slip = (at_floor[0], at_floor[1]), static = floor_mu),
    start(roll: x[0] = tub - radius, der(x[1]) = speed, ball.body_rate = (-speed/radius, 0, -speed/radius)),
)]
struct Tub {
    mass: f64,
    radius: f64,
    tub: f64,
    gravity: f64,
    wall_mu: f64,
    floor_mu: f64,
    speed: f64,
}

/// Of all forces that keep it rolling only one is open, the load that wall and floor pass to one another. Where there are loads with which both frictions
/// hold, it rolls on round the tub for ever.
#[test]
fn a_ball_rolls_in_a_corner_where_some_forces_hold_it() {
    for (wall_mu, floor_mu, speed) in [
        (0.6953, 0.7816, 0.8391),
        (0.4023, 0.4321, 0.899),
        (0.9, 0.2, 0.31),
    ] {
        let tub = Tub {
            mass: 1.2,
            radius: 0.02,
            tub: 0.054,
            gravity: 9.81,
            wall_mu,
            floor_mu,
            speed,
        };
        let path = tub.tub - tub.radius;
        // In units of the mass: the wall pushes by v²/r and the floor by g; the friction at the wall carries s, and what turns the spin is 2/5 of v²/r.
        let push = speed * speed / path;
        let turn = 0.4 * push;
        let holds = |s: f64| {
            let (wall, floor) = (push - (s - turn), tub.gravity - s);
            s.abs() <= wall_mu * wall && (s - turn).abs() <= floor_mu * floor
        };
        assert!((-2000..=2000).any(|k| holds(f64::from(k) * 0.005)));
        for method in METHODS {
            let motion = run_by(&tub, (method, 1e-9), tub.at(Tub::ROLL), 0.5);
            assert!(words(&motion).is_empty(), "{method}: {:?}", words(&motion));
            let angle = speed / path * 0.5;
            let State { q, .. } = motion.final_state();
            agree("x", q[0], path * angle.cos(), 1e-6);
            agree("y", q[1], path * angle.sin(), 1e-6);
        }
    }
}

/// Faster than any forces can hold, it begins to slip at both at once: down the wall, which carries it by its friction, and inward on the floor.
#[test]
fn a_ball_begins_to_slip_at_wall_and_floor_at_once() {
    let tub = Tub {
        mass: 1.2,
        radius: 0.02,
        tub: 0.054,
        gravity: 9.81,
        wall_mu: 0.06,
        floor_mu: 1.2,
        speed: 1.18,
    };
    let push = tub.speed * tub.speed / (tub.tub - tub.radius);
    let wall = (push + tub.floor_mu * tub.gravity) / (1.0 + tub.wall_mu * tub.floor_mu);
    let floor = tub.gravity - tub.wall_mu * wall;
    for method in METHODS {
        let motion = run_by(&tub, (method, 1e-9), tub.at(Tub::ROLL), 0.02);
        let slips = motion.events().iter();
        let slips = slips.filter(|e| e.time == 0.0 && e.kind == EventKind::Slips);
        assert_eq!(slips.count(), 2, "{method}: {:?}", words(&motion));
        let now = motion.sampler().at(0.0).expect("recorded");
        agree("wall", now.force(Tub::WALL), tub.mass * wall, 1e-6);
        agree("floor", now.force(Tub::FLOOR), tub.mass * floor, 1e-6);
        certified(method, &motion);
    }
}

/// A table that was tipped about the edge between two of its feet falls back.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    attitude(table: q),
    define(
        reach = [half_length, half_length, -half_length, -half_length],
        across = [half_width, -half_width, half_width, -half_width],
        leg[k in 0..4] = reach[k]*table.axes[0] + across[k]*table.axes[1] - height*table.axes[2],
        foot[k in 0..4] = der(x) + cross(table.space_rate, leg[k]),
    ),
    kinetic = mass/2*dot(der(x), der(x)) + sum(k in 0..3: inertia[k]/2*table.body_rate[k]^2),
    potential = mass*gravity*x[2],
    contact(stand[k in 0..4]: x[2] + leg[k][2] >= 0),
    friction(grip[k in 0..4] on stand[k]: slip = (foot[k][0], foot[k][1]), static = mu),
    observe(turned = table.axes[0][1]),
    start(tipped: x[2] = height*cos(tilt) + half_width*sin(tilt), table.turn = (tilt, 0, 0)),
)]
struct Table {
    mass: f64,
    inertia: [f64; 3],
    gravity: f64,
    half_length: f64,
    half_width: f64,
    height: f64,
    mu: f64,
    tilt: f64,
}

/// Both feet land at one instant, whatever the errors of the others make of their gaps: by symmetry with equal impulses.
#[test]
fn a_table_falls_back_on_both_of_its_feet() {
    let table = Table {
        mass: 1.0,
        inertia: [0.02, 0.03, 0.04],
        gravity: 9.81,
        half_length: 0.2,
        half_width: 0.15,
        height: 0.15,
        mu: 0.4,
        tilt: 0.2,
    };
    for tolerance in [1e-6, 1e-8, 1e-9, 1e-11] {
        for method in ["taylor", "dop853"] {
            let what = (method, tolerance);
            let motion = run_by(&table, what, table.at(Table::TIPPED), 1.0);
            let impacts = motion
                .events()
                .iter()
                .filter(|e| e.kind == EventKind::Impact);
            let impulse = |k: usize| {
                let mut struck = impacts.clone();
                let first = struck.next().expect("an impact");
                first.impulse(Table::STAND[k])
            };
            agree(format!("{what:?}"), impulse(0), impulse(2), 1e-9);
            let end = motion.sampler().at(1.0).expect("recorded");
            agree("turned", end.observe(Table::TURNED), 0.0, 1e-9);
            certified(format!("{what:?}"), &motion);
        }
    }
}

/// A block that a wall pushes to and fro falls onto a rough floor that moves with the wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(face = reach*sin(rate*t)),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    force(pushes: -press along der(x)),
    contact(floor: y >= 0),
    contact(wall: x >= face),
    friction(rub on floor: slip = der(x) - der(face), static = mu_static, kinetic = mu),
    start(falls: y = height, der(x) = der(face)),
)]
struct Lift {
    press: f64,
    gravity: f64,
    mu_static: f64,
    mu: f64,
    height: f64,
    reach: f64,
    rate: f64,
}

/// What floor and wall carry together moves it as they move. It never slips, and errors of the wall's rate must not be a slip where it lands.
#[test]
fn a_block_that_lands_in_a_corner_that_moves_sticks_there() {
    for (press, height, reach, rate) in [
        (11.0, 0.4, 1.0, 2.0),
        (17.0, 0.9, 0.5, 1.3),
        (9.0, 0.2, 0.3, 1.7),
    ] {
        let lift = Lift {
            press,
            gravity: 9.81,
            mu_static: 0.63,
            mu: 0.48,
            height,
            reach,
            rate,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let motion = run_by(&lift, (method, tolerance), lift.at(Lift::FALLS), 1.5);
            let asked = format!("{method} {tolerance:e}");
            assert_eq!(words(&motion), ["floor impact", "floor closed"], "{asked}");
            let now = motion.sampler().at(1.5).expect("recorded");
            let acceleration = -reach * rate * rate * (rate * 1.5).sin();
            let carried = now.force(Lift::WALL) + now.force(Lift::RUB);
            agree(&asked, carried, press + acceleration, 100.0 * tolerance);
            agree(
                &asked,
                now.state.q[0],
                reach * (rate * 1.5).sin(),
                10.0 * tolerance,
            );
        }
    }
}

/// A cube lies flat on the floor and flat against a wall that pushes it, and then withdraws.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    attitude(cube: q),
    define(face = -reach*sin(rate*t)),
    kinetic = mass/2*dot(der(x), der(x)) + inertia/2*dot(cube.body_rate, cube.body_rate),
    potential = mass*gravity*x[2],
    contact(floor[k in 0..4]: x[2] + half*(ahead[k]*cube.axes[0][2] + aside[k]*cube.axes[1][2] - cube.axes[2][2]) >= 0),
    contact(wall[k in 0..4]: x[0] + half*(ahead[k]*cube.axes[2][0] + aside[k]*cube.axes[1][0] - cube.axes[0][0]) >= face),
    start(pushed: x[0] = half, x[2] = half, der(x[0]) = -reach*rate),
)]
struct Cube {
    mass: f64,
    inertia: f64,
    gravity: f64,
    half: f64,
    reach: f64,
    rate: f64,
    ahead: [f64; 4],
    aside: [f64; 4],
}

/// All four forces of the wall end together, with the push, however they were shared; the cube slides on with the wall's speed and does not tip. At its
/// attitude the first number of the quaternion moves nothing, so that its inertia says nothing of forces.
#[test]
fn a_cube_that_a_wall_has_pushed_slides_on() {
    for (half, reach, rate) in [(0.2, 0.05, 6.0), (0.1, 0.08, 4.0)] {
        let cube = Cube {
            mass: 1.0,
            inertia: 0.0267,
            gravity: 9.81,
            half,
            reach,
            rate,
            ahead: [1.0, 1.0, -1.0, -1.0],
            aside: [1.0, -1.0, 1.0, -1.0],
        };
        for (method, tolerance) in methods_at(["taylor", "dop853", "radau5"], TOLERANCES) {
            let asked = format!("{half} {method} {tolerance:e}");
            let motion = run_by(&cube, (method, tolerance), cube.at(Cube::PUSHED), 1.2);
            let left = core::f64::consts::PI / rate;
            for k in 0..4 {
                let lost = times(&motion, &format!("wall[{k}]"), "lost");
                assert_eq!(lost.len(), 1, "{asked}: {:?}", words(&motion));
                agree(&asked, lost[0], left, 20.0 * tolerance);
            }
            let State { q, .. } = motion.final_state();
            agree(
                &asked,
                q[0],
                half + reach * rate * (1.2 - left),
                20.0 * tolerance,
            );
            agree(&asked, q[2], half, 20.0 * tolerance);
            certified(asked, &motion);
        }
    }
}

/// A rod that is pushed into a corner lies all but flat on the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, p),
    kinetic = (der(x)^2 + der(y)^2)/2 + der(p)^2/6,
    potential = 9.81*y,
    contact(heel: y - sin(p) >= 0),
    friction(heel_grip on heel: slip = der(x) - der(cos(p)), static = floor_mu),
    contact(wall: 1 - x - cos(p) >= 0),
    friction(wall_grip on wall: slip = der(y) + der(sin(p)), static = wall_mu),
    contact(tip: y + sin(p) >= 0),
    force(pushes: x = push),
    start(lies: x = 1 - cos(lift), y = sin(lift), p = lift),
)]
struct Rod {
    floor_mu: f64,
    wall_mu: f64,
    push: f64,
    lift: f64,
}

/// The wall does not hold it up, however little its tip has to fall: forces that did would be as many times larger than the friction there is.
#[test]
fn a_rod_that_lies_all_but_flat_falls() {
    let mut random = Random::new(48);
    for _ in 0..10 {
        let rod = Rod {
            floor_mu: random.between(0.05, 0.3),
            wall_mu: random.between(0.05, 0.2),
            push: random.between(3.0, 8.0),
            lift: 10_f64.powf(random.between(-8.6, -6.0)),
        };
        // Both slip: with the loads N of the heel and W = push + floor_mu N of the wall, ÿ = p̈ = −9.81 + N + wall_mu W and p̈/3 = −N + wall_mu W.
        let fixed = rod.wall_mu * rod.push;
        let turned = rod.wall_mu * rod.floor_mu;
        let heel = (9.81 + 2.0 * fixed) / (4.0 - 2.0 * turned);
        let falls = 3.0 * (heel - fixed - turned * heel);
        let time = (2.0 * rod.lift / falls).sqrt();
        for method in METHODS {
            // What is nearer than the tolerance touches.
            for tolerance in [1e-9, 1e-12] {
                let what = format!("{rod:?} by {method} at {tolerance:e}");
                let motion = run_by(&rod, (method, tolerance), rod.at(Rod::LIES), 0.2);
                let lands = event(&motion, "tip", "impact").time;
                agree(&what, lands / time, 1.0, 1e-5);
                certified(&what, &motion);
            }
        }
    }
}

/// A wheel pressed into a rough corner, which a motor turns to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass*radius^2/4 * der(turn)^2,
    potential = mass*9.81*y - press*x,
    contact(floor: y >= radius),
    contact(wall: x <= -radius),
    friction(grip on floor: slip = der(x) - radius*der(turn), static = mu),
    friction(climb on wall: slip = der(y) - radius*der(turn), static = nu),
    force(motor: turn = torque*sin(rate*t)),
    start(corner: x = -radius, y = radius),
)]
struct Wheel {
    mass: f64,
    radius: f64,
    mu: f64,
    nu: f64,
    press: f64,
    torque: f64,
    rate: f64,
}

/// Turned backward, floor and wall hold f ≤ μ (m g + c) and c ≤ ν (F − f): together f + c with f = μ (m g + ν F)/(1 + μ ν). A motor that asks for a little
/// more than that, for a short time, turns it.
#[test]
fn a_wheel_in_a_corner_slips_however_shortly_it_is_turned_too_hard() {
    let mut random = Random::new(23);
    for case in 0..30 {
        let mut wheel = Wheel {
            mass: random.between(0.7, 1.5),
            radius: 0.3,
            mu: random.between(0.3, 0.8),
            nu: random.between(0.3, 0.8),
            press: random.between(4.0, 8.0),
            torque: 0.0,
            rate: random.between(2.0, 9.0),
        };
        let over = [1e-3, 3e-3, 1e-2][case % 3];
        let (mu, nu, press) = (wheel.mu, wheel.nu, wheel.press);
        let floor = mu * (wheel.mass * 9.81 + nu * press) / (1.0 + mu * nu);
        // Else it comes off the wall before.
        if floor > 0.98 * press {
            continue;
        }
        let most = floor + nu * (press - floor);
        wheel.torque = most * wheel.radius * (1.0 + over);
        let slips = (core::f64::consts::PI + (1.0 / (1.0 + over)).asin()) / wheel.rate;
        for (method, tolerance) in methods_at(["auto", "dop853"], [1e-9, 1e-12]) {
            let what = format!("{wheel:?} by {method} at {tolerance:e}");
            let until = 1.5 * core::f64::consts::PI / wheel.rate;
            let run = run_by(&wheel, (method, tolerance), wheel.at(Wheel::CORNER), until);
            for item in ["grip", "climb"] {
                agree(&what, event(&run, item, "slips").time, slips, 1e-6);
            }
            certified(&what, &run);
        }
    }
}
