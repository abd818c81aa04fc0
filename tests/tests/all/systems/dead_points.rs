//! A slider-crank whose rod is as long as its crank: wherever both are upright the slider is at the pivot, and the constraints lose
//! rank. Passing there costs no more digits than other steps do.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, SINGLE_METHODS, TOLERANCES, agree, integral, methods_at, run_by, times,
};

/// Crank a and rod b of length 1, the slider at x on a line through the pivot.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b, x),
    kinetic = crank/2 * der(a)^2 + rod/2 * der(b)^2 + slider/2 * der(x)^2,
    constraint(lengthwise: cos(a) + cos(b) == x),
    constraint(crosswise: sin(a) + sin(b) == 0),
    stop(turned: a >= end),
)]
struct Slider {
    crank: f64,
    rod: f64,
    slider: f64,
    end: f64,
}

/// b = −a and x = 2 cos a, so that (J + 4 m sin² a) ȧ² stays what it is, and the time is an integral over the angle.
#[test]
fn passages_of_dead_points_keep_the_tolerance() {
    for tolerance in [1e-6, 1e-9] {
        for (k, slider) in [0.1, 0.4, 1.5].into_iter().enumerate() {
            let turns = 12.0;
            let scene = Slider {
                crank: 1.0,
                rod: 0.5,
                slider,
                end: 2.0 * PI * turns + 0.4,
            };
            let (a, rate) = (0.4, 2.0 + k as f64);
            let inertia = |a: f64| scene.crank + scene.rod + 4.0 * slider * a.sin().powi(2);
            let start = state(
                &[a, -a, 2.0 * a.cos()],
                &[rate, -rate, -2.0 * a.sin() * rate],
            );
            let run = run_by(&scene, ("taylor", tolerance), start, 100.0);
            let period = integral(|a| (inertia(a) / inertia(0.4)).sqrt() / rate, 0.0, 2.0 * PI);
            // Twenty-four passages.
            let asked = format!("{tolerance:e}, slider {slider}");
            agree(
                &asked,
                run.last_time() / (turns * period),
                1.0,
                10.0 * tolerance,
            );
            let end = run.final_state();
            agree(&asked, end.v(Slider::A) / rate, 1.0, 10.0 * tolerance);
            agree(
                &asked,
                end.q(Slider::B),
                -end.q(Slider::A),
                10.0 * tolerance,
            );
        }
    }
}

/// A crank drives a piston that rubs, by a rod without mass: in the dead centres angle b has no inertia, and only the constraint tells
/// its acceleration.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b),
    define(x = r * cos(a) + l * cos(b)),
    kinetic = crank/2 * der(a)^2 + piston/2 * der(x)^2,
    constraint(wrist: r * sin(a) == l * sin(b)),
    friction(ring: slip = der(x), limit = dry),
    stop(turned: a >= end),
)]
struct Engine {
    r: f64,
    l: f64,
    crank: f64,
    piston: f64,
    dry: f64,
    end: f64,
}

impl Engine {
    /// b, and the derivatives of b and x by a.
    fn geometry(&self, a: f64) -> (f64, f64, f64) {
        let b = (self.r * a.sin() / self.l).asin();
        let turn = self.r * a.cos() / (self.l * b.cos());
        (b, turn, -self.r * a.sin() - self.l * b.sin() * turn)
    }

    fn inertia(&self, a: f64) -> f64 {
        self.crank + self.piston * self.geometry(a).2.powi(2)
    }

    fn place(&self, a: f64) -> f64 {
        self.r * a.cos() + self.l * self.geometry(a).0.cos()
    }
}

/// What friction takes is its limit times the way of the piston, which moves one way from a dead centre to the next.
#[test]
fn a_rod_without_mass_passes_its_dead_centres() {
    for (k, a) in [-0.4, -1e-3, -1e-6, -1e-9, 0.0, 3e-10, 2e-7, PI - 1e-5]
        .into_iter()
        .enumerate()
    {
        let r = 0.2 + 0.04 * k as f64;
        let engine = Engine {
            r,
            l: 0.75,
            crank: 0.05,
            piston: 1.2,
            dry: 2.0,
            end: 3.5,
        };
        let rate = 20.0;
        let (b, turn, _) = engine.geometry(a);
        let energy = |to: f64| {
            let dead = [0.0, PI].into_iter().filter(|dead| a < *dead && *dead < to);
            let turns: Vec<f64> = [a].into_iter().chain(dead).chain([to]).collect();
            let ways = turns.windows(2);
            let way: f64 = ways
                .map(|w| (engine.place(w[1]) - engine.place(w[0])).abs())
                .sum();
            0.5 * engine.inertia(a) * rate * rate - engine.dry * way
        };
        let speed = |to: f64| (2.0 * energy(to) / engine.inertia(to)).sqrt();
        // The root has a bend in each dead centre.
        let bends = [a, 0.0_f64.max(a), PI, engine.end];
        let times = bends
            .windows(2)
            .map(|w| integral(|way| 1.0 / speed(w[0] + way), w[0], w[1]));
        let time: f64 = times.sum();
        for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
            let asked = format!("{method} at {tolerance:e} from {a:e}");
            let start = state(&[a, b], &[rate, rate * turn]);
            let run = run_by(&engine, (method, tolerance), start, 1.0);
            let bound = 30.0 * tolerance;
            agree(&asked, run.last_time() / time, 1.0, bound);
            let end = run.final_state();
            agree(&asked, end.v(Engine::A) / speed(3.5), 1.0, bound);
            agree(&asked, end.q(Engine::B), engine.geometry(3.5).0, bound);
        }
    }
}

/// A crank turns a yoke that rubs on its guide.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(theta, x),
    kinetic = inertia/2 * der(theta)^2 + mass/2 * der(x)^2,
    constraint(slot: x == crank * cos(theta)),
    friction(rub: slip = der(x), limit = dry),
    force(motor: theta = torque),
    start(dead: x = crank),
)]
struct Yoke {
    inertia: f64,
    mass: f64,
    crank: f64,
    dry: f64,
    torque: f64,
}

/// In its dead centre the yoke is at rest whether it sticks or not, and no friction holds the crank. What the motor does is kinetic energy
/// and friction over the way of the yoke.
#[test]
fn what_rubs_does_not_stick_in_its_dead_centre() {
    let yoke = Yoke {
        inertia: 0.3,
        mass: 2.0,
        crank: 0.5,
        dry: 1.5,
        torque: 2.0,
    };
    for (method, tolerance) in [
        ("taylor", 1e-12),
        ("taylor", 1e-6),
        ("dop853", 1e-9),
        ("radau5", 1e-9),
    ] {
        let run = run_by(&yoke, (method, tolerance), yoke.at(Yoke::DEAD), 1.0);
        let end = run.final_state();
        let (theta, rate) = (end.q(Yoke::THETA), end.v(Yoke::THETA));
        assert!(theta > 1.5 && theta < PI, "{theta}");
        let inertia = yoke.inertia + yoke.mass * (yoke.crank * theta.sin()).powi(2);
        let way = yoke.crank * (1.0 - theta.cos());
        let work = yoke.torque * theta - yoke.dry * way;
        agree(
            method,
            0.5 * inertia * rate * rate / work,
            1.0,
            10.0 * tolerance,
        );
    }
}

/// Slower by any factor the motion is the same, with forces less by its square: what tells that the rows come apart has no unit of time.
#[test]
fn nor_does_it_however_slowly_it_begins() {
    for scale in [1e-10, 1e-5, 1e5, 1e10] {
        let yoke = Yoke {
            inertia: 0.3,
            mass: 2.0,
            crank: 0.5,
            dry: 1.5 * scale,
            torque: 2.0 * scale,
        };
        let rate_of_time = scale.sqrt();
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let asked = format!("forces times {scale:e} by {method} at {tolerance:e}");
            let start = yoke.at(Yoke::DEAD);
            let run = run_by(&yoke, (method, tolerance), start, 1.0 / rate_of_time);
            assert_eq!(run.events().len(), 1, "{asked}");
            assert_eq!(times(&run, "rub", "slips"), [0.0], "{asked}");
            let end = run.final_state();
            let (theta, rate) = (end.q(Yoke::THETA), end.v(Yoke::THETA));
            assert!(theta > 1.5 && theta < PI, "{asked}: {theta}");
            let inertia = yoke.inertia + yoke.mass * (yoke.crank * theta.sin()).powi(2);
            let way = yoke.crank * (1.0 - theta.cos());
            let work = yoke.torque * theta - yoke.dry * way;
            // The tolerance of velocities is that of a rate of 1.
            let bound = 10.0 * tolerance * (1.0 / rate_of_time).clamp(1.0, 100.0);
            agree(&asked, 0.5 * inertia * rate * rate / work, 1.0, bound);
        }
    }
}

/// A shaft that rubs in its hub, and by an eccentric in the place where that is in its dead centre.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(theta),
    kinetic = inertia/2 * der(theta)^2,
    force(motor: theta = torque),
    friction(hub: slip = der(theta), limit = drag),
    friction(rub: slip = sin(theta) * der(theta), limit = dry),
    start(dead: theta = pi),
)]
struct Eccentric {
    inertia: f64,
    torque: f64,
    drag: f64,
    dry: f64,
}

/// The sine of π is 1e-16 in numbers, so that the slip of the eccentric reverses at once, while that in the hub is still below the tolerance: it
/// does not end with it, again and again.
#[test]
fn a_slip_that_is_zero_in_its_dead_centre_ends_no_other() {
    for inertia in [0.3, 3e2, 3e5] {
        let shaft = Eccentric {
            inertia,
            torque: 2.0,
            drag: 0.4,
            dry: 0.5,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-5, 1e-6, 1e-7, 1e-9, 1e-12]) {
            let asked = format!("{inertia} kg m² by {method} at {tolerance:e}");
            let start = shaft.at(Eccentric::DEAD);
            let run = run_by(&shaft, (method, tolerance), start, 1.2 * inertia.sqrt());
            assert_eq!(times(&run, "rub", "reverses").len(), 1, "{asked}");
            assert_eq!(run.events().len(), 3, "{asked}");
            let end = run.final_state();
            let (theta, rate) = (end.q(Eccentric::THETA), end.v(Eccentric::THETA));
            assert!(theta > 4.0 && theta < 5.0, "{asked}: {theta}");
            let work = (shaft.torque - shaft.drag) * (theta - PI) - shaft.dry * (1.0 + theta.cos());
            let kinetic = 0.5 * inertia * rate * rate;
            agree(&asked, kinetic / work, 1.0, 100.0 * tolerance);
        }
    }
}

/// A crank that rubs by the way of its pin across, at the side where the pin turns.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = inertia/2 * der(theta)^2,
    friction(rub: slip = der(crank * sin(theta)), limit = dry),
    force(motor: theta = torque),
)]
struct Pin {
    inertia: f64,
    crank: f64,
    dry: f64,
    torque: f64,
}

/// The cosine of π/2 is 6e-17 in numbers: a friction that stuck would have to be torque/(crank 6e-17), and would stop a crank that turns.
#[test]
fn no_friction_sticks_where_rounding_is_all_that_it_acts_by() {
    let pin = Pin {
        inertia: 0.3,
        crank: 0.5,
        dry: 1.5,
        torque: 2.0,
    };
    for (method, tolerance) in [("taylor", 1e-12), ("taylor", 1e-6), ("dop853", 1e-9)] {
        for (speed, besides) in [(0.0, 0.0), (3.0, 0.0), (3.0, 1e-11)] {
            let start = state(&[0.5 * PI - besides], &[speed]);
            let run = run_by(&pin, (method, tolerance), start, 0.6);
            for event in run.events() {
                let forces = event.forces.iter().chain(&event.forces_after);
                let largest = forces.fold(0.0_f64, |largest, f| largest.max(f.abs()));
                assert!(largest <= pin.dry * (1.0 + 1e-12), "{largest} N");
            }
            let end = run.final_state();
            let (theta, rate) = (end.q(Pin::THETA), end.v(Pin::THETA));
            assert!(theta > 2.0 && theta < 1.5 * PI, "{theta}");
            let way = pin.crank * (1.0 - theta.sin());
            let work = pin.torque * (theta - 0.5 * PI) - pin.dry * way;
            let kinetic = 0.5 * pin.inertia * (rate * rate - speed * speed);
            let asked = format!("{method} at {tolerance:e} from {speed} rad/s");
            agree(&asked, kinetic / work, 1.0, 10.0 * tolerance);
        }
    }
}

/// Upright the crosswise constraint is cos a (ȧ + ḃ) = 0 with a cosine of 6e-17: its residual is nothing, and yet other velocities are
/// what satisfies it.
#[test]
fn a_start_that_other_velocities_satisfy_is_refused() {
    let scene = Slider {
        crank: 1.0,
        rod: 0.5,
        slider: 0.4,
        end: 10.0,
    };
    let upright = |b: f64| state(&[0.5 * PI, -0.5 * PI, 0.0], &[3.0, b, b - 3.0]);
    let run = |start: State| Simulation::new(&scene).run(start, 0.0..0.1);
    match run(upright(1.0)).map_err(|failure| failure.error) {
        Err(Error::Start { item, .. }) => assert_eq!(item, "crosswise"),
        other => panic!("{other:?}"),
    }
    let end = run(upright(-3.0)).expect("a start on the branch");
    assert!(end.final_state().v(Slider::A) > 2.0);
}

/// A crank that is a body in space, on a hinge, moves a cross-head that rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    attitude(crank: q),
    kinetic = inertia/2*dot(crank.body_rate, crank.body_rate) + mass/2*der(x)^2,
    constraint(hinge[k in 0..2]: crank.axes[2][k] == 0),
    constraint(yoke: x == arm*crank.axes[0][0]),
    friction(head: slip = der(x), limit = rubs),
    start(turned: crank.turn = (0, 0, 1), crank.space_rate = (0, 0, rate), x = arm*cos(1), der(x) = -arm*sin(1)*rate),
)]
struct SpatialCrank {
    inertia: f64,
    mass: f64,
    arm: f64,
    rubs: f64,
    rate: f64,
}

/// Nothing holds it in its dead centres, where four coordinates of its attitude and a friction that stuck would depend on one another; it loses what is rubbed
/// away on the way of the cross-head.
#[test]
fn a_crank_in_space_passes_its_dead_centres() {
    let mut random = Random::new(55);
    for _ in 0..6 {
        let crank = SpatialCrank {
            inertia: random.between(0.3, 0.8),
            mass: random.between(0.5, 1.5),
            arm: random.between(0.2, 0.4),
            rubs: random.between(1.0, 3.0),
            rate: random.between(15.0, 25.0),
        };
        let energy =
            |rate: f64, slip: f64| (crank.inertia * rate * rate + crank.mass * slip * slip) / 2.0;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{crank:?} by {method} at {tolerance:e}");
            let start = crank.at(SpatialCrank::TURNED);
            let motion = run_by(&crank, (method, tolerance), start, 1.0);
            let turns = motion.events().len();
            assert!(turns > 3, "{what}: {turns} events");
            let reverses = |e: &Event<f64>| e.kind == EventKind::Reverses;
            assert!(motion.events().iter().all(reverses), "{what}");
            let end = motion.final_state();
            let (x, slip) = (end.q[0], end.v[0]);
            // Out of the first turn, from one to the next, and on from the last.
            let side = if turns % 2 == 1 { -1.0 } else { 1.0 };
            let way = crank.arm * (1.0 + 1_f64.cos()) + 2.0 * crank.arm * (turns - 1) as f64;
            let way = way + (x - side * crank.arm).abs();
            let rate = slip / (crank.arm * crank.arm - x * x).sqrt();
            let lost =
                energy(crank.rate, crank.arm * 1_f64.sin() * crank.rate) - energy(rate, slip);
            agree(
                &what,
                lost / (crank.rubs * way),
                1.0,
                1e3 * tolerance.max(1e-11),
            );
        }
    }
}

/// A leg of two links that hangs from a hip and stands on the ground, its knee at its stop.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b),
    define(
        thigh = [sin(a)/2, -cos(a)/2],
        shank = [sin(a) + sin(b)/2, -cos(a) - cos(b)/2],
        foot = [sin(a) + sin(b), -cos(a) - cos(b)],
    ),
    kinetic = (dot(der(thigh), der(thigh)) + dot(der(shank), der(shank)))/2 + (der(a)^2 + der(b)^2)/24,
    potential = gravity * (thigh[1] + shank[1]),
    contact(knee: a >= b),
    contact(ground: foot[1] >= -2 * cos(slope)),
    friction(sole on ground: slip = der(foot[0]), static = mu),
    force(hip: a = torque * sin(2*pi*t)),
    start(stand: a = slope, b = slope),
)]
struct Leg {
    gravity: f64,
    slope: f64,
    mu: f64,
    torque: f64,
}

/// Straight, it cannot bend while hip and sole are held: where the torque is all that the weight gives the knee, torque = g sin α, the sole slips, in
/// whatever order its slip begins.
#[test]
fn a_straight_leg_slips_as_its_knee_gives_way() {
    for (slope, mu, torque) in [(0.1, 0.6, 4.0), (0.1, 0.3, 2.5), (0.15, 0.5, 5.0)] {
        let leg = Leg {
            gravity: 9.81,
            slope,
            mu,
            torque,
        };
        let gives_way = (leg.gravity * slope.sin() / torque).asin() / (2.0 * PI);
        for (method, tolerance) in methods_at(METHODS, [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12]) {
            let motion = run_by(
                &leg,
                (method, tolerance),
                leg.at(Leg::STAND),
                gives_way + 0.03,
            );
            let what = format!("{leg:?} by {method} at {tolerance:e}");
            for (item, kind) in [("knee", "lost"), ("sole", "slips")] {
                let found = times(&motion, item, kind);
                assert!(!found.is_empty(), "{what}: {item} {kind}");
                agree(&what, found[0], gives_way, tolerance.max(1e-9));
            }
        }
    }
}

/// A motor turns a crank whose slider rubs on its guide, which carries its weight and the thrust of the rod.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, x, y, b),
    define(rod_x = r*cos(a) + l/2*cos(b), rod_y = r*sin(a) + l/2*sin(b)),
    kinetic = 0.006*der(a)^2 + rod/2*(der(rod_x)^2 + der(rod_y)^2) + rod*l^2/24*der(b)^2 + (der(x)^2 + der(y)^2),
    potential = 9.81*(rod*rod_y + 2*y),
    constraint(lengthwise: x == r*cos(a) + l*cos(b)),
    constraint(crosswise: y == r*sin(a) + l*sin(b)),
    constraint(guide: y == 0),
    friction(rub on guide: slip = der(x), static = 0.25, kinetic = 0.19),
    force(motor: a = 2*(speed - der(a))),
)]
struct Rubbing {
    r: f64,
    l: f64,
    rod: f64,
    speed: f64,
}

/// The slip reverses in each dead centre, which projections put at angles of 1e-13 or of 1e-20: a friction that held there would have to be 1e40 N.
#[test]
fn sliders_that_rub_do_not_stick_in_dead_centres() {
    let mut random = Random::new(17);
    for k in 0..60 {
        let (r, l, a) = (0.146, 0.5819, random.between(1.0, 2.0));
        let b = (-r * a.sin() / l).asin();
        let scene = Rubbing {
            r,
            l,
            rod: random.between(0.3, 0.5),
            speed: -random.between(5.0, 7.0),
        };
        let start = state(&[a, r * a.cos() + l * b.cos(), 0.0, b], &[0.0; 4]);
        let ends = [("taylor", 1e-9), ("taylor", 1.1e-9), ("dop853", 1e-10)].map(|by| {
            let run = run_by(&scene, by, start.clone(), 3.0);
            let reversals = times(&run, "rub", "reverses").len();
            (run.final_state().q[0], reversals)
        });
        for end in &ends[1..] {
            agree(k, end.0, ends[0].0, 1e-7);
            assert_eq!(end.1, ends[0].1, "{k}");
        }
        assert!(ends[0].1 >= 4, "{k}: {ends:?}");
    }
}
