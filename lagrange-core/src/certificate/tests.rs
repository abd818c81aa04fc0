//! What is wrong with a run is found, and named.

use super::motion::against;
use super::{Certificate, Subject};
use crate::prelude::*;

/// A block that is thrown onto a rough incline, bounces, slides, comes to rest and is pushed on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential(weight: mass * 9.81 * (n * cos(slope) - s * sin(slope))),
    contact(plane: n >= 0, restitution = bounce),
    friction(grip on plane: slip = der(s), static = mu),
    force(wind: s = push * sin(2 * t)),
    start(thrown: n = 1/20, der(s) = 1/5),
    mark(passes: s >= 1/4),
    stop(far: s >= 2/5),
)]
struct Block {
    mass: f64,
    slope: f64,
    bounce: f64,
    mu: f64,
    push: f64,
}

/// The same with a wind that is stronger by a millionth.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential(weight: mass * 9.81 * (n * cos(slope) - s * sin(slope))),
    contact(plane: n >= 0, restitution = bounce),
    friction(grip on plane: slip = der(s), static = mu),
    force(wind: s = 1.000001 * push * sin(2 * t)),
    start(thrown: n = 1/20, der(s) = 1/5),
    mark(passes: s >= 1/4),
    stop(far: s >= 2/5),
)]
struct Windier {
    mass: f64,
    slope: f64,
    bounce: f64,
    mu: f64,
    push: f64,
}

const BLOCK: Block = Block {
    mass: 2.0,
    slope: 0.3,
    bounce: 0.3,
    mu: 0.7,
    push: 10.0,
};

fn run(effects: Effects) -> Trajectory {
    let simulation = Simulation::new(&BLOCK).effects(effects);
    simulation
        .run(BLOCK.at(Block::THROWN), 0.0..8.0)
        .expect("a run")
}

#[track_caller]
fn certificate(trajectory: &Trajectory) -> Certificate {
    trajectory.verify(1).expect("a certificate")
}

/// Asserts that the worst check is one of these and beyond its bound.
#[track_caller]
fn finds(certificate: &Certificate, subjects: &[Subject]) {
    let beyond = certificate.checks.iter().filter(|check| !check.holds());
    let beyond: Vec<Subject> = beyond.map(|check| check.subject).collect();
    assert!(
        subjects.iter().all(|subject| beyond.contains(subject)),
        "{subjects:?} are not all in {beyond:?}: {certificate}"
    );
}

#[test]
fn what_is_right_is_certified() {
    let certificate = certificate(&run(Effects::all()));
    assert!(certificate.holds(), "{certificate}");
    let looked: Vec<Subject> = certificate.checks.iter().map(|c| c.subject).collect();
    use Subject::*;
    for subject in [
        Equations,
        Motion,
        Gaps,
        NormalForces,
        Cones,
        Sliding,
        Impacts,
        Stops,
        Marks,
    ] {
        assert!(looked.contains(&subject), "{subject:?} not in {looked:?}");
    }
}

/// A bullet that friction brings to rest: its last velocity is known to a rounding of the first.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(press: y = -load),
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = mu),
)]
struct Bullet {
    load: f64,
    mu: f64,
}

#[test]
fn what_comes_to_rest_from_afar_is_certified() {
    let bullet = Bullet {
        load: 1e13,
        mu: 0.3,
    };
    for k in 0..25 {
        let speed = 1e7 * 1.7f64.powi(k);
        let stops = speed / (bullet.mu * bullet.load);
        let start = State::new(vec![0.0, 0.0], vec![speed, 0.0]);
        let simulation = Simulation::new(&bullet).tolerance(1e-10);
        let run = simulation.run(start, 0.0..2.0 * stops).expect("a run");
        let (at, way) = (run.events()[0].time, run.final_state().q[0]);
        assert!((at / stops - 1.0).abs() < 1e-10, "{at:e}, not {stops:e}");
        let expected = 0.5 * speed * stops;
        assert!(
            (way / expected - 1.0).abs() < 1e-10,
            "{way:e}, not {expected:e}"
        );
        let certificate = certificate(&run);
        assert!(certificate.holds(), "{certificate}");
    }
}

#[test]
fn a_force_a_millionth_too_weak_is_found() {
    let trajectory = run(Effects::all());
    let windier = against(&trajectory, <Windier as Derived>::DECLARATION, 1, 1.0);
    finds(&windier, &[Subject::Equations]);
    let equations = windier.worst().expect("checks");
    assert_eq!(
        (equations.subject, equations.item),
        (Subject::Equations, "s")
    );
}

#[test]
fn a_nudged_state_is_found() {
    let mut trajectory = run(Effects::all());
    let segment = trajectory.segments[trajectory.segments.len() / 2];
    trajectory.coefficients[segment.offset] += 1e-6;
    finds(&certificate(&trajectory), &[Subject::Joins]);
}

#[test]
fn a_velocity_that_is_not_the_rate_of_the_position_is_found() {
    let mut trajectory = run(Effects::all());
    let segment = trajectory.segments[1];
    let n = trajectory.description().coordinates.len();
    let velocity = segment.offset + n * (segment.degree + 1);
    trajectory.coefficients[velocity] += 1e-5;
    finds(
        &certificate(&trajectory),
        &[Subject::Motion, Subject::Joins],
    );
}

#[test]
fn other_parameters_than_those_of_the_run_are_found() {
    let mut trajectory = run(Effects::all());
    let heavier = Block {
        mass: 2.001,
        ..BLOCK
    };
    trajectory.system = std::sync::Arc::new(heavier);
    finds(&certificate(&trajectory), &[Subject::Motion]);
}

#[test]
fn what_was_left_out_is_missed() {
    let cases: [(Item, Subject); 4] = [
        (Block::PLANE.into(), Subject::Gaps),
        (Block::GRIP.into(), Subject::Sliding),
        (Block::FAR.into(), Subject::Stops),
        (Block::PASSES.into(), Subject::Marks),
    ];
    for (item, subject) in cases {
        let mut trajectory = run(Effects::all().without(item));
        assert!(
            certificate(&trajectory).holds(),
            "{}",
            certificate(&trajectory)
        );
        trajectory.effects = Effects::all();
        finds(&certificate(&trajectory), &[subject]);
    }
}

#[test]
fn an_impact_that_bounces_too_high_is_found() {
    let mut trajectory = run(Effects::all());
    let events: Vec<Event<f64>> = trajectory.events().to_vec();
    let record = &mut trajectory;
    record.events.clear();
    for mut event in events {
        if event.kind == EventKind::Impact {
            event.state_after.v[1] *= 1.01;
        }
        record.events.push(&event);
    }
    let found = certificate(&trajectory);
    finds(
        &found,
        &[Subject::Impulses, Subject::Impacts, Subject::Joins],
    );
}

/// A mass that falls onto the ground where no direction leads around it, within a rail on which it would rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = weight * y,
    contact(rail: x^2 + y^2 <= 4),
    friction(rub on rail: slip = (y * der(x) - x * der(y)) / sqrt(x^2 + y^2), static = 1/5),
    contact(ground: y >= 0),
    start(top: y = 1),
)]
struct Centred {
    weight: f64,
}

#[test]
fn slips_that_have_no_value_where_something_else_is_struck_do_not_matter() {
    let mass = Centred { weight: 10.0 };
    for effects in [
        Effects::all(),
        Effects::all().without(Centred::RAIL),
        Effects::all().without(Centred::RUB),
    ] {
        let run = Simulation::new(&mass)
            .effects(effects)
            .run(mass.at(Centred::TOP), 0.0..1.0)
            .expect("a run");
        assert_eq!(run.final_state().q, [0.0, 0.0]);
        assert!(certificate(&run).holds(), "{}", certificate(&run));
    }
}

/// A pendulum in x and y.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = weight * y,
    constraint(rod: x^2 + y^2 == 1),
    start(level: x = 1),
)]
struct Hung {
    weight: f64,
}

/// Between the ends of fixed steps the rod has another length, by far more than the tolerance with which switches would be found, and by less than the error
/// that was asked for.
#[test]
fn fixed_steps_within_an_error_are_held_to_that_error() {
    let bob = Hung { weight: 10.0 };
    let simulation = Simulation::new(&bob).method(Method::Gauss6 { step: 0.05 });
    for error in [1e-3, 1e-6, 1e-10] {
        let run = simulation.clone().error(error);
        let mut run = run.run(bob.at(Hung::LEVEL), 0.0..3.0).expect("a run");
        assert_eq!(run.tolerance(), error);
        let found = certificate(&run);
        assert!(found.holds(), "{found}");
        run.coefficients[0] += 1e3 * error;
        finds(&certificate(&run), &[Subject::Constraints]);
    }
}

/// A mass that drifts past a narrow peak.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    start(pushed: der(x) = 1),
    mark(peak: exp(-((x - place) / width)^2) >= 1/2),
)]
struct Drift {
    place: f64,
    width: f64,
}

#[test]
fn a_guard_that_is_true_for_a_thousandth_of_a_step_is_found() {
    let drift = Drift {
        place: 0.3,
        width: 1e-3,
    };
    let effects = Effects::all().without(Drift::PEAK);
    let simulation = Simulation::new(&drift).effects(effects);
    let mut trajectory = simulation
        .run(drift.at(Drift::PUSHED), 0.0..1.0)
        .expect("a run");
    assert_eq!(trajectory.segments.len(), 1);
    assert!(certificate(&trajectory).holds());
    trajectory.effects = Effects::all();
    finds(&certificate(&trajectory), &[Subject::Marks]);
}

/// A block that friction holds against a pull that grows with what drifts away.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(pull: x = y),
    friction(grip: slip = der(x), normal = 1, static = mu),
)]
struct Held {
    mu: f64,
}

/// The same on a smoother floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(pull: x = y),
    friction(grip: slip = der(x), normal = 1, static = 0.95 * mu),
)]
struct Smoother {
    mu: f64,
}

#[test]
fn a_slip_that_is_missed_late_in_a_long_step_is_found() {
    let start = State::new(vec![0.0; 2], vec![0.0, 1.0]);
    let run = Simulation::new(&Held { mu: 1.0 }).run(start, 0.0..1.0);
    let run = run.expect("a run");
    assert_eq!(run.segments.len(), 1);
    for seed in 0..20 {
        let smoother = against(&run, <Smoother as Derived>::DECLARATION, seed, 1.0);
        finds(&smoother, &[Subject::Cones]);
    }
}

/// A mass on a spring, seen only where it turns.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = x^2 / 2,
    start(pushed: der(x) = 1),
    stop(top: x >= reach),
    mark(there: x - reach),
)]
struct Swing {
    reach: f64,
}

#[test]
fn what_is_true_only_just_is_missed() {
    let methods = ["auto", "dop853", "dopri5", "verner98", "radau5"];
    for (method, depth) in methods.into_iter().flat_map(|m| [(m, 1e-7), (m, 5e-9)]) {
        let swing = Swing { reach: 1.0 - depth };
        for (item, subject) in [
            (Item::from(Swing::TOP), Subject::Stops),
            (Swing::THERE.into(), Subject::Marks),
        ] {
            let neither = Effects::all().without(Swing::TOP).without(Swing::THERE);
            let simulation = Simulation::new(&swing).effects(neither).tolerance(1e-12);
            let simulation = simulation.method(method.parse().expect("a method"));
            let start = swing.at(Swing::PUSHED);
            let mut trajectory = simulation.run(start, 0.0..3.0).expect("a run");
            assert!(certificate(&trajectory).holds());
            let other = if subject == Subject::Stops {
                Swing::THERE.into()
            } else {
                Item::from(Swing::TOP)
            };
            trajectory.effects = Effects::all().without(other);
            assert!(trajectory.effects.includes(trajectory.description(), item));
            let found = certificate(&trajectory);
            let check = found.checks.iter().find(|check| check.subject == subject);
            assert!(
                check.is_some_and(|c| !c.holds()),
                "{method}, {depth:e}: {found}"
            );
        }
    }
}

/// Strings that hang in columns, each knot by one to the knot below it, four columns side by side.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y[24], z[24]),
    kinetic = sum(k in 0..24: der(y[k])^2 + der(z[k])^2) / 100,
    potential(weight: 981/5000 * sum(k in 0..24: z[k])),
    potential(strings: stiffness/2
        * sum(k in 0..20: (norm([length + y[k + 4] - y[k], z[k + 4] - z[k]]) - length)^2)),
    potential(ends: stiffness/2 * sum(k in 0..4: (norm([length + y[k], z[k]]) - length)^2)),
    start(flat: z[0] = 0),
)]
struct Columns {
    stiffness: f64,
    length: f64,
}

#[test]
fn forces_of_stiff_strings_cancel_to_rounding_of_their_lengths() {
    for (stiffness, length) in [(1e3, 0.1), (1e4, 0.1), (1e4, 1.0)] {
        let columns = Columns { stiffness, length };
        let run = Simulation::new(&columns).run(columns.at(Columns::FLAT), 0.0..0.1);
        let certificate = certificate(&run.expect("a run"));
        assert!(certificate.holds(), "{columns:?}: {certificate}");
    }
}

/// A body that flies by, as it is seen from a cart that drives a flywheel.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(phi, x, r, theta),
    define(px = x + r * sin(theta), py = r * cos(theta)),
    kinetic = cart/2 * der(x)^2 + inertia/2 * der(phi)^2 + (der(px)^2 + der(py)^2) / 2,
    potential = 10 * py,
    constraint(gear: der(x) == radius * der(phi)),
    start(thrown: r = radius, theta = 1, der(r) = speed, der(theta) = 2 * speed / radius,
        der(x) = speed, der(phi) = speed / radius),
)]
struct Flywheel {
    cart: f64,
    inertia: f64,
    radius: f64,
    speed: f64,
}

#[test]
fn balances_are_measured_alike_in_all_units() {
    for radius in [1.0, 1e4, 1e6] {
        let flywheel = Flywheel {
            cart: 0.01,
            inertia: 0.5 * radius * radius,
            radius,
            speed: f64::sqrt(radius),
        };
        let run = Simulation::new(&flywheel);
        let run = run.run(flywheel.at(Flywheel::THROWN), 0.0..3.0 * radius.sqrt());
        let certificate = certificate(&run.expect("a run"));
        assert!(certificate.holds(), "{flywheel:?}: {certificate}");
    }
}

/// A bar that falls over on its end.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    kinetic = (der(x)^2 + der(y)^2) / 2 + length^2 / 24 * der(theta)^2,
    potential = 9.81 * y,
    contact(heel: y >= length/2 * sin(theta)),
    start(leaning: theta = 6/5, y = length/2 * sin(6/5)),
    stop(down: y <= 0),
)]
struct Bar {
    length: f64,
}

#[test]
fn a_step_that_ends_at_zero_was_made_beside_where_it_began() {
    for length in [1.0, 1e3, 1e5] {
        let bar = Bar { length };
        for method in ["auto", "dop853", "dopri5", "radau5"] {
            let run = Simulation::new(&bar).method(method.parse().expect("a method"));
            let run = run.run(bar.at(Bar::LEANING), 0.0..3.0 * length.sqrt());
            let certificate = certificate(&run.expect("a run"));
            assert!(certificate.holds(), "{method}, {length}: {certificate}");
        }
    }
}

/// What is found of a jump of a position by this share of the length.
fn jump(share: f64) -> Certificate {
    let bar = Bar { length: 1e3 };
    let run = Simulation::new(&bar).run(bar.at(Bar::LEANING), 0.0..90.0);
    let mut run = run.expect("a run");
    run.last.q[0] += share * bar.length;
    certificate(&run)
}

#[test]
fn a_jump_of_a_thousand_tolerances_is_found_beside_a_long_way() {
    assert!(jump(0.0).holds());
    finds(&jump(1e-6), &[Subject::Joins]);
}

/// A body on two rough planes: the second is approached, and the impulse is that of the first, at which the body is held.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + der(phi)^2 / 2,
    contact(floor: y - 4/5 * sin(phi) + 4/5 * (1 - cos(phi)) >= 0),
    contact(slope: cos(tilt) * (x + sin(phi)/2 - (1 - cos(phi))/2)
        + sin(tilt) * (y + sin(phi)/2 + (1 - cos(phi))/2) >= 0),
    friction(grip on floor: slip = der(x + 4/5 * sin(phi) + 4/5 * (1 - cos(phi))), static = 2),
    friction(hold on slope: slip = -sin(tilt) * der(x + sin(phi)/2 - (1 - cos(phi))/2)
        + cos(tilt) * der(y + sin(phi)/2 + (1 - cos(phi))/2), static = 7/2),
)]
struct Wedged {
    mass: f64,
    tilt: f64,
}

#[test]
fn an_impulse_of_what_is_held_alone_is_an_impact() {
    for mass in [1.6, 1.8, 2.5] {
        let start = State::new(vec![0.0; 3], vec![-1.3, 0.8 * 0.8, 0.8]);
        let run = Simulation::new(&Wedged { mass, tilt: 0.4 }).run(start, 0.0..1e-9);
        let run = run.expect("a run");
        assert_eq!(run.events()[0].kind, EventKind::Impact);
        let certificate = certificate(&run);
        assert!(certificate.holds(), "{mass}: {certificate}");
    }
}

/// A body that nothing pushes, and a telescope without inertia that follows it, with its worm gear.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, telescope, worm),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(sight: x * sin(telescope) == y * cos(telescope)),
    constraint(gear: worm == 40 * telescope),
    contact(wall: x <= 2 * length, restitution = 1/2),
)]
struct Telescope {
    mass: f64,
    length: f64,
}

/// The same where a billionth of the body's energy holds the worm.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, telescope, worm),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(sight: x * sin(telescope) == y * cos(telescope)),
    constraint(gear: worm == 40 * telescope),
    contact(wall: x <= 2 * length, restitution = 1/2),
    force(held: worm = -mass * length^2 / 1000000000),
)]
struct HeldTelescope {
    mass: f64,
    length: f64,
}

/// The body flies from (1, y) lengths with velocity (3, v) lengths per second.
fn seen(telescope: &Telescope, y: f64, v: f64) -> Trajectory {
    let (angle, rate) = (y.atan(), (v - 3.0 * y) / (1.0 + y * y));
    let l = telescope.length;
    let start = State::new(
        vec![l, y * l, angle, 40.0 * angle],
        vec![3.0 * l, v * l, rate, 40.0 * rate],
    );
    let run = Simulation::new(telescope).run(start, 0.0..1.0);
    run.expect("a run")
}

const TELESCOPES: [Telescope; 3] = [
    Telescope {
        mass: 700.0,
        length: 1e-3,
    },
    Telescope {
        mass: 0.6,
        length: 1.0,
    },
    Telescope {
        mass: 0.03,
        length: 1e4,
    },
];

/// What follows it without inertia does not turn a body from its straight line. Errors of the force by which it does not are no larger than rounding of what
/// would hold it.
#[test]
fn what_follows_without_inertia_is_certified() {
    for telescope in &TELESCOPES {
        for k in 0..20 {
            let (y, v) = (-0.9 + 0.11 * f64::from(k), 1.3 - 0.17 * f64::from(k));
            let run = seen(telescope, y, v);
            let wide = 2.0 - 1.5 * (1.0 - 1.0 / 3.0);
            let expected = (y + v).atan2(wide);
            let angle = run.final_state().q[2];
            assert!((angle - expected).abs() < 1e-9, "{angle}, not {expected}");
            let certificate = certificate(&run);
            assert!(certificate.holds(), "{telescope:?} {k}: {certificate}");
        }
    }
}

#[test]
fn a_force_on_what_has_no_inertia_is_found() {
    for telescope in &TELESCOPES {
        let run = seen(telescope, 0.4, -0.3);
        let held = against(&run, <HeldTelescope as Derived>::DECLARATION, 1, 1.0);
        finds(&held, &[Subject::Equations]);
        assert_eq!(held.worst().expect("checks").item, "worm");
    }
}

#[test]
fn an_impulse_on_what_has_no_inertia_is_found() {
    for telescope in &TELESCOPES {
        let mut run = seen(telescope, 0.4, -0.3);
        let mut event = run.events()[0].clone();
        assert_eq!(event.kind, EventKind::Impact);
        let gear = run.description().constraints[1].row;
        event.impulses[gear] += 1e-9 * telescope.mass * telescope.length.powi(2);
        run.events.clear();
        run.events.push(&event);
        let found = certificate(&run);
        finds(&found, &[Subject::Impulses]);
    }
}

/// A body on a ramp that is given as the least angle at which a telescope sees it, and a bumper across it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, telescope),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(sight: x * sin(telescope) == y * cos(telescope)),
    contact(ramp: telescope >= slope),
    contact(bumper: x * cos(slope) + y * sin(slope) >= length, restitution = bounce),
    start(sent: x = 2 * length * cos(slope), y = 2 * length * sin(slope), telescope = slope,
        der(x) = -speed * cos(slope), der(y) = -speed * sin(slope)),
)]
struct Ramp {
    mass: f64,
    gravity: f64,
    slope: f64,
    length: f64,
    speed: f64,
    bounce: f64,
}

/// The run until 1 s, with one impact.
fn bumped(length: f64, gravity: f64, slope: f64) -> (Ramp, Trajectory) {
    let ramp = Ramp {
        mass: 0.3,
        gravity: gravity * length,
        slope,
        length,
        speed: 2.0 * length,
        bounce: 0.6,
    };
    let run = Simulation::new(&ramp).run(ramp.at(Ramp::SENT), 0.0..0.8);
    (ramp, run.expect("a run"))
}

/// The ramp has no part in a blow along it, and without gravity bears no load at all.
#[test]
fn what_is_held_without_inertia_and_not_struck_is_certified() {
    for length in [1e-3, 1.0, 1e4] {
        for gravity in [0.0, 9.81] {
            for k in 1..14 {
                let slope = 0.1 * f64::from(k);
                let (ramp, run) = bumped(length, gravity, slope);
                let along = gravity * slope.sin();
                let after = ramp.bounce * (4.0 + 2.0 * along).sqrt();
                let blow = &run.events()[0];
                let speed = blow.state_after.v[0].hypot(blow.state_after.v[1]) / length;
                assert!((speed - after).abs() < 1e-9, "{speed}, not {after}");
                let certificate = certificate(&run);
                assert!(certificate.holds(), "{ramp:?}: {certificate}");
            }
        }
    }
}

#[test]
fn a_blow_of_what_is_not_struck_is_found() {
    for length in [1e-3, 1.0, 1e4] {
        let (ramp, mut run) = bumped(length, 9.81, 0.7);
        let mut events = run.events().to_vec();
        let row = run.description().contacts[0].row;
        events[0].impulses[row] -= 1e-3 * ramp.mass * length.powi(2);
        run.events.clear();
        events.iter().for_each(|event| run.events.push(event));
        finds(&certificate(&run), &[Subject::Impulses, Subject::Impacts]);
    }
}
