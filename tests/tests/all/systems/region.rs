//! Contacts limited to a region: a table with an edge, a wall with a hole, two tables in a row.

use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, SINGLE_METHODS, TOLERANCES, agree, certified, event, methods_at, run, run_by,
};

const G: f64 = 9.81;

/// A block on a table of finite length, which stands on a floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(table: y >= height, where x <= length, restitution = bounce),
    contact(floor: y >= 0),
    friction(grip on table: slip = der(x), static = mu),
)]
struct Table {
    mass: f64,
    gravity: f64,
    height: f64,
    length: f64,
    bounce: f64,
    mu: f64,
}

const TABLE: Table = Table {
    mass: 1.3,
    gravity: G,
    height: 0.8,
    length: 1.0,
    bounce: 0.5,
    mu: 0.1,
};

/// A ball and a wall with a hole.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(upper: x <= wall, where y >= top, restitution = bounce),
    contact(lower: x <= wall, where y <= bottom, restitution = bounce),
)]
struct Hole {
    mass: f64,
    gravity: f64,
    wall: f64,
    top: f64,
    bottom: f64,
    bounce: f64,
}

/// Two smooth tables of one height that meet at x = 0.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(left: y >= 0, where x <= 0),
    contact(right: y >= 0, where x >= 0),
)]
struct Tables {
    mass: f64,
    gravity: f64,
}

fn state(q: [f64; 2], v: [f64; 2]) -> State<f64> {
    State::new(q.to_vec(), v.to_vec())
}

fn story(trajectory: &Trajectory) -> Vec<(&'static str, String)> {
    let events = trajectory.events().iter();
    events
        .map(|e| (e.subject.name(trajectory.description()), e.kind.to_string()))
        .collect()
}

fn words(list: &[(&'static str, &str)]) -> Vec<(&'static str, String)> {
    list.iter().map(|(a, b)| (*a, (*b).to_owned())).collect()
}

#[test]
fn a_block_slides_off_a_table_onto_the_floor() {
    for method in SINGLE_METHODS {
        let trajectory = Simulation::new(&TABLE)
            .tolerance(1e-12)
            .method(method)
            .run(state([0.0, 0.8], [2.0, 0.0]), 0.0..2.0)
            .expect("runs");
        let expected = [("table", "lost"), ("floor", "impact"), ("floor", "closed")];
        assert_eq!(story(&trajectory), words(&expected));
        let events = trajectory.events();
        // x = v t − μ g t²/2 up to the edge, then a fall from the table's height.
        let deceleration = TABLE.mu * G;
        let speed = (4.0 - 2.0 * deceleration).sqrt();
        let edge = (2.0 - speed) / deceleration;
        let fall = (2.0 * TABLE.height / G).sqrt();
        agree("time of the edge", events[0].time, edge, 1e-12);
        agree("time of the floor", events[1].time, edge + fall, 1e-12);
        agree("where", events[1].state.q[0], 1.0 + speed * fall, 1e-12);
        agree("at the end", trajectory.final_state().q[1], 0.0, 1e-14);
    }
}

#[test]
fn what_comes_from_below_passes_and_lands_from_above() {
    // From under the overhang's far side it flies up through the table and falls on it.
    let trajectory = run(&TABLE, state([1.5, 0.3], [-2.0, 6.0]), 1.5);
    assert_eq!(story(&trajectory)[..1], words(&[("table", "impact")])[..]);
    let down = (6.0 + (36.0 - 2.0 * G * 0.5_f64).sqrt()) / G;
    agree("time", trajectory.events()[0].time, down, 1e-12);
}

#[test]
fn what_passes_below_the_table_is_not_hit_by_it() {
    let trajectory = run(&TABLE, state([1.5, 0.5], [-4.0, 0.0]), 0.3);
    assert!(trajectory.events().is_empty());
    agree("x", trajectory.final_state().q[0], 0.3, 1e-14);
}

#[test]
fn a_start_inside_the_table_is_refused_but_not_beside_it() {
    let inside = Simulation::new(&TABLE).run(state([0.5, 0.7], [0.0, 0.0]), 0.0..0.1);
    let error = inside.expect_err("penetrates").error;
    assert!(
        matches!(error, Error::Penetrates { item: "table", .. }),
        "{error}"
    );
    let beside = Simulation::new(&TABLE).run(state([1.5, 0.7], [0.0, 0.0]), 0.0..0.1);
    assert!(beside.is_ok());
}

#[test]
fn a_ball_flies_through_a_hole_or_bounces_beside_it() {
    let hole = Hole {
        mass: 1.0,
        gravity: G,
        wall: 1.0,
        top: 1.2,
        bottom: 0.8,
        bounce: 0.5,
    };
    // It is at the wall after 0.2 s, 0.2 m − 0.1962 m higher.
    for (y, hit) in [
        (1.0, None),
        (1.19, None),
        (1.2, Some("upper")),
        (2.0, Some("upper")),
        (0.79, Some("lower")),
        (0.1, Some("lower")),
    ] {
        let trajectory = run(&hole, state([0.0, y], [5.0, 1.0]), 0.5);
        let names: Vec<_> = story(&trajectory).iter().map(|(name, _)| *name).collect();
        assert_eq!(names, Vec::from_iter(hit), "from y = {y}");
        let x = if hit.is_some() { 1.0 - 2.5 * 0.3 } else { 2.5 };
        agree("x", trajectory.final_state().q[0], x, 1e-12);
    }
}

#[test]
fn one_table_hands_over_to_the_next() {
    let tables = Tables {
        mass: 1.0,
        gravity: G,
    };
    for speed in [1.0, -1.0] {
        let trajectory = run(&tables, state([-speed, 0.0], [speed, 0.0]), 2.0);
        agree("x", trajectory.final_state().q[0], speed, 1e-14);
        agree("y", trajectory.final_state().q[1], 0.0, 1e-14);
        assert_eq!(trajectory.final_mode().contacts, [speed < 0.0, speed > 0.0]);
        agree("time", trajectory.events()[0].time, 1.0, 1e-14);
    }
}

#[test]
fn a_block_at_rest_on_the_edge_stays() {
    let trajectory = run(&TABLE, state([1.0, 0.8], [0.0, 0.0]), 5.0);
    assert!(trajectory.events().is_empty());
    assert_eq!(trajectory.final_state().q, [1.0, 0.8]);
}

#[test]
fn a_certificate_knows_what_passes_outside_a_region() {
    // The block is thrown over the edge and falls past the table in the middle of long steps.
    let scene = Table { mu: 0.0, ..TABLE };
    let start = State::new(vec![2.0, 2.0], vec![0.3, -1.0]);
    let run = run(&scene, start, 0.4);
    for seed in 0..20 {
        let certificate = run.verify(seed).expect("recorded");
        assert!(certificate.holds(), "{seed}: {certificate}");
    }
}

/// A door that pushes a bolt aside with a bevel, which ends where the door is nearly shut.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(door, bolt),
    kinetic   = inertia/2 * der(door)^2 + mass/2 * der(bolt)^2,
    potential = stiffness/2 * bolt^2 + preload * bolt,
    contact(bevel: bolt >= reach - slope * door, where door >= edge),
    contact(rest: bolt >= 0),
    contact(frame: door >= 0, restitution = bounce),
)]
struct Latch {
    inertia: f64,
    mass: f64,
    stiffness: f64,
    preload: f64,
    reach: f64,
    slope: f64,
    edge: f64,
    bounce: f64,
}

/// It springs back behind the bolt that has snapped into place, beyond the bevel, and the first steps of that need not be looked at.
#[test]
fn a_certificate_of_a_few_steps_knows_what_has_passed_outside_a_region() {
    let scene = Latch {
        inertia: 1.0,
        mass: 0.01,
        stiffness: 3.0,
        preload: 0.2,
        reach: 0.05,
        slope: 0.5,
        edge: 0.02,
        bounce: 0.3,
    };
    for method in ["taylor", "dop853", "verner98"] {
        let start = state([0.4, 0.0], [-1.5, 0.0]);
        let run = run_by(&scene, (method, 1e-9), start, 0.45);
        assert_eq!(run.final_mode().contacts, [false, true, false]);
        assert!(run.final_state().q[0] > scene.edge);
        for seed in 0..20 {
            let certificate = run.verify_share(seed, 0.25).expect("recorded");
            assert!(certificate.holds(), "{method}, {seed}: {certificate}");
        }
    }
}

/// A wheel that rolls against a kerb, turns about its edge, and rolls on upon the pavement.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(far = sqrt((x - place)^2 + (y - height)^2)),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(road: y >= radius, where x <= place),
    contact(edge: far >= radius),
    contact(pavement: y >= radius + height, where x >= place),
    friction(on_road on road: slip = der(x) - radius * der(phi), static = mu),
    friction(on_edge on edge: slip = ((y - height) * der(x) - (x - place) * der(y))/far - radius * der(phi), static = mu),
    friction(on_pavement on pavement: slip = der(x) - radius * der(phi), static = mu),
)]
struct Kerb {
    mass: f64,
    inertia: f64,
    radius: f64,
    gravity: f64,
    height: f64,
    place: f64,
    mu: f64,
}

/// Where the wheel stands upon the edge the gap above the pavement is zero to rounding, on either side of it.
#[test]
fn a_wheel_climbs_a_kerb_and_stays_on_top() {
    let kerb = Kerb {
        mass: 4.0,
        inertia: 0.1,
        radius: 0.3,
        gravity: G,
        height: 0.04,
        place: 1.0,
        mu: 2.0,
    };
    for speed in [1.3, 1.35, 1.4, 1.5] {
        // The angular momentum about the edge is kept when it is met, the energy while the wheel turns about it.
        let (m, j, r, h) = (kerb.mass, kerb.inertia, kerb.radius, kerb.height);
        let about = j + m * r * r;
        let rate = (j + m * r * (r - h)) * speed / (r * about);
        let left = r * (rate * rate - 2.0 * m * G * h / about).sqrt();
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = State::new(vec![0.0, r, 0.0], vec![speed, 0.0, speed / r]);
            let run = run_by(&kerb, (method, tolerance), start, 1.5);
            let what = format!("{speed} by {method} at {tolerance:e}");
            assert!(
                run.final_mode().closed(Kerb::PAVEMENT),
                "{what}: {:?}",
                story(&run)
            );
            assert!(run.final_mode().sticks(Kerb::ON_PAVEMENT), "{what}");
            let end = run.final_state();
            let bound = (100.0 * tolerance).max(1e-11);
            agree(&what, end.v(Kerb::X), left, bound);
            agree(&what, end.q(Kerb::Y), r + h, bound);
        }
    }
}

/// A hoop of radius `radius` that rolls against a kerb of height `kerb`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    define(away = sqrt(x^2 + (y - kerb)^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/2 * radius^2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(road: y >= radius, where x <= 0),
    contact(corner: away >= radius),
    contact(walk: y >= kerb + radius, where x >= 0),
    friction(grip on road: slip = der(x) - radius * der(theta), static = mu),
    friction(bite on corner: slip = ((y - kerb) * der(x) - x * der(y)) / away - radius * der(theta), static = mu),
    friction(tread on walk: slip = der(x) - radius * der(theta), static = mu),
    mark(up: x >= 0),
)]
struct Hoop {
    mass: f64,
    radius: f64,
    kerb: f64,
    gravity: f64,
    mu: f64,
}

/// About the corner the impact keeps m r² ω + m r ω (r − h) = 2 m r² ω′, and the energy is kept from there on. The mark stands where the
/// corner hands over to the walk, and is written once.
#[test]
fn a_mark_where_regions_meet_is_written_once() {
    let hoop = Hoop {
        mass: 2.0,
        radius: 0.35,
        kerb: 0.08,
        gravity: G,
        mu: 3.0,
    };
    let Hoop { radius, kerb, .. } = hoop;
    let before: f64 = 1.6 / radius;
    let turned = before * (2.0 * radius - kerb) / (2.0 * radius);
    let after = (turned * turned - G * kerb / (radius * radius)).sqrt();
    for (method, tolerance) in methods_at(SINGLE_METHODS, [1e-4, 1e-7, 1e-10, 1e-12]) {
        let asked = format!("{method} at {tolerance:e}");
        let start = super::state(&[-1.0, radius, 0.0], &[1.6, 0.0, before]);
        let run = run_by(&hoop, (method, tolerance), start, 1.2);
        let marks = run.events().iter().filter(|e| e.kind == EventKind::Mark);
        assert_eq!(marks.count(), 1, "{asked}");
        let end = run.final_state();
        agree(&asked, end.v(Hoop::THETA) / after, 1.0, 10.0 * tolerance);
    }
}

/// A sledge on a level track that ends where a round hill begins to fall off.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(track: y >= 0, where x <= 0),
    contact(hill: sqrt(x^2 + (y + radius)^2) >= radius),
)]
struct Brow {
    gravity: f64,
    radius: f64,
}

/// The hill touches the track at its edge, without a root of its gap. The sledge leaves it where g cos θ = v²/R, cos θ = (2 + v₀²/(g R))/3, or at once.
#[test]
fn a_surface_that_touches_the_edge_of_another_takes_over() {
    let scene = Brow {
        gravity: 10.0,
        radius: 0.4,
    };
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        for speed in [0.3, 0.7, 1.3, 1.9, 2.5] {
            let asked = format!("{method} {tolerance:e} {speed}");
            let start = State::new(vec![-0.31, 0.0], vec![speed, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 0.31 / speed + 1.0);
            let stays = speed * speed < 4.0;
            let after = motion.sampler().at(0.31 / speed + 1e-3).expect("beyond");
            assert_eq!(after.mode.closed(Brow::HILL), stays, "{asked}");
            assert!(!after.mode.closed(Brow::TRACK), "{asked}");
            let lost = motion.events().last().expect("an event");
            let cos = (2.0 + speed * speed / 4.0).min(3.0) / 3.0;
            agree(&asked, lost.q(Brow::Y), 0.4 * (cos - 1.0), 10.0 * tolerance);
        }
    }
}

/// A seesaw that ends on two blocks, and a ball that falls on it. The plank is one-sided and as long as it is.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(tilt, x, y, turn),
    kinetic = plank/2 * der(tilt)^2 + mass/2 * (der(x)^2 + der(y)^2) + mass * radius^2/4 * der(turn)^2,
    potential = mass * gravity * y,
    contact(left: length * sin(tilt) >= -height, restitution = bounce),
    contact(right: length * sin(tilt) <= height, restitution = bounce),
    contact(hit: y * cos(tilt) - x * sin(tilt) >= radius, where x^2 <= length^2, restitution = bounce),
    friction(rub on hit:
        slip = der(x) * cos(tilt) + der(y) * sin(tilt) + radius * (der(tilt) - der(turn)), static = mu),
    stop(aside: x^2 >= length^2),
)]
struct Seesaw {
    plank: f64,
    mass: f64,
    radius: f64,
    length: f64,
    height: f64,
    gravity: f64,
    bounce: f64,
    mu: f64,
}

/// The end of the plank and the ball bounce ever less, together; neither falls through, however near to zero their gaps are rounded.
#[test]
fn a_ball_on_a_seesaw_does_not_fall_through() {
    let mut random = lagrange_tests::Random::new(3);
    for _ in 0..12 {
        let seesaw = Seesaw {
            plank: random.between(0.6, 1.5),
            mass: random.between(2.0, 6.0),
            radius: random.between(0.05, 0.15),
            length: 1.0,
            height: random.between(0.2, 0.3),
            gravity: random.between(8.0, 19.0),
            bounce: random.between(0.05, 0.4),
            mu: random.between(0.3, 0.8),
        };
        let tilt = seesaw.height.asin();
        let start = State::new(vec![tilt, 0.7, 1.2, 0.0], vec![0.0; 4]);
        for (method, tolerance) in [("taylor", 1e-12), ("verner98", 1e-12), ("dop853", 1e-9)] {
            let trajectory = run_by(&seesaw, (method, tolerance), start.clone(), 2.0);
            let end = trajectory.final_state();
            let gap = end.q[2] * end.q[0].cos() - end.q[1] * end.q[0].sin() - seesaw.radius;
            assert!(gap > -1e-6, "{method}: {gap:e}, {seesaw:?}");
            certified(method, &trajectory);
        }
    }
}

/// A slat that is pushed over the edge of a table, on which its tail lies.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, tilt),
    define(face = [cos(tilt), -sin(tilt)], up = [sin(tilt), cos(tilt)]),
    define(tail = [x, y] - half * face, place = x * face[0] + y * face[1]),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * half^2/6 * der(tilt)^2,
    potential = mass * gravity * y,
    contact(edge: x * up[0] + y * up[1] >= 0, where abs(place) <= half),
    contact(table: tail[1] >= 0),
    friction(rub on edge: slip = der(x) * face[0] + der(y) * face[1], static = mu),
    friction(drag on table: slip = der(tail[0]), static = mu),
)]
struct Slat {
    mass: f64,
    half: f64,
    gravity: f64,
    mu: f64,
}

/// It begins to tip at the instant at which the kink of its region is passed, or a rounding error before or after it.
#[test]
fn a_region_with_a_kink_does_not_disturb_what_happens_there() {
    let slat = Slat {
        mass: 0.05,
        half: 0.05,
        gravity: 9.81,
        mu: 0.25,
    };
    for k in 0..20 {
        let (x, speed) = (-0.02 - 0.0007 * f64::from(k), 0.5);
        let slowing = slat.mu * slat.gravity;
        let tips = (speed - (speed * speed + 2.0 * slowing * x).sqrt()) / slowing;
        let start = State::new(vec![x, 0.0, 0.0], vec![speed, 0.0, 0.0]);
        for how in [
            ("taylor", 1e-6),
            ("taylor", 1e-9),
            ("taylor", 1e-12),
            ("dop853", 1e-9),
        ] {
            let motion = run_by(&slat, how, start.clone(), tips + 0.05);
            let lost = lagrange_tests::event(&motion, "table", "lost");
            lagrange_tests::agree(format!("{how:?} from {x}"), lost.time, tips, 10.0 * how.1);
            let tilt = motion.final_state().q[2];
            assert!(tilt > 1e-3, "{how:?} from {x}: tilted by {tilt}");
        }
    }
}

/// What is thrown below the edge of a table passes under it, however long the step is in which it does.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(table: y >= 0, where x >= edge),
)]
struct Below {
    mass: f64,
    gravity: f64,
    edge: f64,
}

#[test]
fn what_passes_below_an_edge_is_certified() {
    let scene = Below {
        mass: 0.7,
        gravity: G,
        edge: 1.0,
    };
    let start = State::new(vec![0.0, 0.1], vec![5.0, 0.0]);
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let motion = run_by(&scene, (method, tolerance), start.clone(), 0.6);
        assert!(motion.events().is_empty(), "{method}");
        certified(method, &motion);
    }
}

/// A smooth ramp that ends at the edge of a table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(ramp: y + tan(slope)*x >= 0, where x <= 0),
    contact(table: y >= 0, where x <= 0),
    start(above: x = -way*cos(slope), y = way*sin(slope)),
)]
struct Ramp {
    gravity: f64,
    slope: f64,
    way: f64,
}

/// What slides down it reaches the table and its edge at once, and flies off in the direction of the ramp.
#[test]
fn what_reaches_a_surface_at_its_edge_passes_by_it() {
    let ramps = [
        (0.3, 0.4),
        (0.333, 1.0319),
        (0.6435, 1.0),
        (0.9, 0.7),
        (1.2, 2.0),
        (1.2815, 1.605),
    ];
    for (slope, way) in ramps {
        let ramp = Ramp {
            gravity: G,
            slope,
            way,
        };
        let drop = way * slope.sin();
        let (speed, flies) = ((2.0 * G * drop).sqrt(), 0.3);
        let leaves = 2.0 * way / speed;
        let [vx, vy] = [speed * slope.cos(), -speed * slope.sin()];
        let end = [vx * flies, vy * flies - G * flies * flies / 2.0];
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{ramp:?} by {method} at {tolerance:e}");
            let start = ramp.at(Ramp::ABOVE);
            let motion = run_by(&ramp, (method, tolerance), start, leaves + flies);
            assert_eq!(story(&motion), words(&[("ramp", "lost")]), "{what}");
            for (q, expected) in motion.final_state().q.iter().zip(end) {
                agree(&what, *q, expected, 20.0 * tolerance.max(1e-11));
            }
            certified(&what, &motion);
        }
    }
}

/// A ball in a room: its floor ends at the wall. Both rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + radius^2/5 * der(phi)^2,
    potential = gravity * y,
    contact(floor: y >= 0, where x <= wide),
    contact(wall: x <= wide, restitution = throws),
    friction(rub on floor: slip = der(x) - radius*der(phi), static = mu),
    friction(scrape on wall: slip = der(y) - radius*der(phi), static = rough),
    start(rolls: x = wide - way, der(x) = speed, der(phi) = spin),
)]
struct Room {
    gravity: f64,
    radius: f64,
    wide: f64,
    way: f64,
    throws: f64,
    mu: f64,
    rough: f64,
    speed: f64,
    spin: f64,
}

/// The same with a floor that goes on behind the wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + radius^2/5 * der(phi)^2,
    potential = gravity * y,
    contact(floor: y >= 0),
    contact(wall: x <= wide, restitution = throws),
    friction(rub on floor: slip = der(x) - radius*der(phi), static = mu),
    friction(scrape on wall: slip = der(y) - radius*der(phi), static = rough),
    start(rolls: x = wide - way, der(x) = speed, der(phi) = spin),
)]
struct Endless {
    gravity: f64,
    radius: f64,
    wide: f64,
    way: f64,
    throws: f64,
    mu: f64,
    rough: f64,
    speed: f64,
    spin: f64,
}

/// The floor takes part in the impact on the wall, and carries what comes to rest at its edge.
#[test]
fn a_floor_that_ends_at_a_wall_is_as_good_as_an_endless_one() {
    let mut random = Random::new(12);
    for case in 0..60 {
        let tenths = |x: f64| (10.0 * x).round() / 10.0;
        let room = Room {
            gravity: G,
            radius: 0.1,
            wide: tenths(random.between(-1.0, 2.0)),
            way: tenths(random.between(0.3, 1.0)),
            throws: [0.0, 0.5, 1.0][case % 3],
            mu: [0.0, 0.1, 0.3][random.below(3)],
            rough: [0.0, 0.3, 0.8][random.below(3)],
            speed: tenths(random.between(1.0, 3.0)),
            spin: [0.0, 20.0, -50.0][random.below(3)],
        };
        let Room {
            gravity,
            radius,
            wide,
            way,
            throws,
            mu,
            rough,
            speed,
            spin,
        } = room;
        let endless = Endless {
            gravity,
            radius,
            wide,
            way,
            throws,
            mu,
            rough,
            speed,
            spin,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let what = format!("{room:?} by {method} at {tolerance:e}");
            let motion = run_by(&room, (method, tolerance), room.at(Room::ROLLS), 2.0);
            let other = run_by(
                &endless,
                (method, tolerance),
                endless.at(Endless::ROLLS),
                2.0,
            );
            assert_eq!(story(&motion), story(&other), "{what}");
            for (q, expected) in motion.final_state().q.iter().zip(&other.final_state().q) {
                agree(&what, *q, *expected, 100.0 * tolerance);
            }
            certified(&what, &motion);
        }
    }
}

/// The verge of a table: a floor that ends where a round edge of the same height begins.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(flat: y >= radius, where x <= 0),
    contact(edge: sqrt(x^2 + y^2) >= radius),
    start(there: y = radius, der(x) = speed),
)]
struct Verge {
    gravity: f64,
    radius: f64,
    speed: f64,
}

/// A start at its very end, where both surfaces touch and bend otherwise: back along the floor, or over the edge, which is left where 3 cos θ = 2 + v²/(g r), or
/// at once.
#[test]
fn a_start_between_two_surfaces_follows_one_of_them() {
    for radius in [0.3, 1.0, 1.7] {
        for part in [-0.8, -0.1, 0.2, 0.5, 0.9, 1.3] {
            let verge = Verge {
                gravity: G,
                radius,
                speed: part * (G * radius).sqrt(),
            };
            for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
                let what = format!("{verge:?} by {method} at {tolerance:e}");
                let until = 3.0 * (radius / G).sqrt();
                let motion = run_by(&verge, (method, tolerance), verge.at(Verge::THERE), until);
                let end = motion.final_state();
                if part < 0.0 {
                    agree(&what, end.q[0], verge.speed * until, 10.0 * tolerance);
                    agree(&what, end.q[1], radius, 10.0 * tolerance);
                } else if part > 1.0 {
                    agree(&what, end.q[0], verge.speed * until, 10.0 * tolerance);
                    let falls = radius - G * until * until / 2.0;
                    agree(&what, end.q[1], falls, 10.0 * tolerance);
                } else {
                    let left = event(&motion, "edge", "lost");
                    let height = radius * (2.0 + part * part) / 3.0;
                    agree(&what, left.state.q[1], height, 100.0 * tolerance);
                }
                certified(&what, &motion);
            }
        }
    }
}

/// A mass that is pushed against a wall, which leans and moves away, and slides down it onto a floor that ends there.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y - push * x,
    define(end = lean * y + drift * t),
    contact(floor: y >= 0, where x <= end),
    contact(wall: x <= end),
    start(there: x = lean * high, y = high, der(x) = drift),
)]
struct Leaning {
    gravity: f64,
    push: f64,
    lean: f64,
    drift: f64,
    high: f64,
}

/// What rounding, or the error of a step, makes of its place at the wall does not decide whether there is a floor: it lands after √(2 h (1 + k²)/(g − F k)),
/// and is on the floor then.
#[test]
fn a_floor_is_there_along_the_wall_that_it_ends_at() {
    for (lean, drift) in [(0.5, 0.0), (0.2, 0.0), (0.7, 0.3), (0.0, 0.4), (0.3, -0.2)] {
        for high in [0.3, 1.0, 1.7] {
            let scene = Leaning {
                gravity: G,
                push: 6.0,
                lean,
                drift,
                high,
            };
            let slope = 1.0 + lean * lean;
            let lands = (2.0 * high * slope / (G - scene.push * lean)).sqrt();
            for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
                let what = format!("{scene:?} by {method} at {tolerance:e}");
                let until = lands + 0.02;
                let run = run_by(&scene, (method, tolerance), scene.at(Leaning::THERE), until);
                let landed = event(&run, "floor", "impact").time;
                agree(&what, landed, lands, 100.0 * tolerance);
                agree(&what, run.final_state().q[1], 0.0, 10.0 * tolerance);
                certified(&what, &run);
            }
        }
    }
}

/// A floor in two parts, and a wall at the end of the second one; along it by u + v, turning by u − v.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(u, y, v),
    kinetic = der((u + v)/2)^2/2 + der(y)^2/2 + inertia/2*der((u - v)/2)^2,
    potential = 9.81*y,
    contact(near: y >= 0, where (u + v)/2 <= seam),
    contact(far: y >= 0, where (u + v)/2 >= seam),
    contact(wall: (u + v)/2 <= seam + wide, restitution = bounce),
    start(go: u = seam - 1, v = seam - 1, der(u) = speed, der(v) = speed),
)]
struct Seam {
    inertia: f64,
    seam: f64,
    wide: f64,
    bounce: f64,
    speed: f64,
}

/// At the wall nothing is known of the part that ended half a metre before it.
#[test]
fn a_wall_behind_a_seam_brings_nothing_back() {
    for (seam, wide, bounce, speed) in [
        (0.0, 0.5, 0.3, 1.0),
        (2.0, 0.7, 0.1, 1.3),
        (0.4, 0.25, 1.0, 0.8),
    ] {
        let scene = Seam {
            inertia: 0.01,
            seam,
            wide,
            bounce,
            speed,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let until = (1.0 + 1.1 * wide) / speed;
            let run = run_by(&scene, (method, tolerance), scene.at(Seam::GO), until);
            assert_eq!(
                lagrange_tests::words(&run),
                ["near lost", "far closed", "wall impact"],
                "{what}"
            );
            certified(&what, &run);
        }
    }
}
