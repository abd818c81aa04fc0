//! Pulses, hills and gates that are nothing at all where a step begins: their exponents are followed.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at, root, run_by, runge_kutta, times};

/// A motion in one coordinate from a position and a velocity.
fn moved(
    scene: &impl System<Scalar = f64>,
    method: Method,
    [x, v]: [f64; 2],
    until: f64,
) -> Trajectory<f64> {
    let simulation = Simulation::new(scene).method(method).tolerance(1e-9);
    let run = simulation.run(state(&[x], &[v]), 0.0..until);
    run.expect("runs")
}

/// A body that one pulse pushes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    force(push: x = blow / (sqrt(2*pi) * width) * exp(-((t - centre)/width)^2/2)),
)]
struct Pushed {
    mass: f64,
    blow: f64,
    centre: f64,
    width: f64,
}

/// What the pulse has given is Δv = J/m, from its centre on.
#[test]
fn pulses_however_short_give_their_momentum() {
    for width in [0.3, 1e-2, 1e-5] {
        let scene = Pushed {
            mass: 2.0,
            blow: 3.0,
            centre: 4.0,
            width,
        };
        for method in METHODS {
            let run = moved(&scene, method, [0.0, 0.1], 10.0);
            let (x, v) = (run.final_state().q[0], run.final_state().v[0]);
            assert!((v - 1.6).abs() < 1e-6, "{method:?}, {width}: v = {v}");
            assert!((x - 10.0).abs() < 1e-5, "{method:?}, {width}: x = {x}");
        }
    }
}

/// A body that runs against a hill V₀/cosh²(kx), written so that it overflows nowhere.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = height * (1 - tanh(steepness * x)^2),
)]
struct Hill {
    mass: f64,
    height: f64,
    steepness: f64,
}

/// With E < V₀ it turns back: sinh kx = −√(V₀/E − 1) cosh kv₀(t − t₀), far from the hill with the speed v₀ both before and after.
#[test]
fn no_body_passes_a_hill_that_it_cannot_climb() {
    for steepness in [3.0, 40.0, 500.0] {
        let scene = Hill {
            mass: 1.0,
            height: 5.0,
            steepness,
        };
        // E = 2
        let speed = 2.0;
        let bend = f64::sqrt(5.0 / 2.0 - 1.0);
        // ln of the large cosh at a distance of 3.
        let far = 3.0 * steepness - f64::ln(bend);
        let turned = far / (steepness * speed);
        for method in METHODS {
            let run = moved(&scene, method, [-3.0, speed], 2.0 * turned);
            let (x, v) = (run.final_state().q[0], run.final_state().v[0]);
            assert!((x + 3.0).abs() < 1e-5, "{method:?}, {steepness}: x = {x}");
            assert!((v + speed).abs() < 1e-5, "{method:?}, {steepness}: v = {v}");
        }
    }
}

/// A body in resistance that is −μmg tanh(v/ε), a regularised friction.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    force(drag: x = -friction * mass * gravity * tanh(der(x)/slow)),
)]
struct Dragged {
    mass: f64,
    gravity: f64,
    friction: f64,
    slow: f64,
}

/// sinh(v/ε) = sinh(v₀/ε) exp(−μgt/ε)
#[test]
fn a_regularised_friction_ends_a_slide() {
    let scene = Dragged {
        mass: 1.0,
        gravity: 10.0,
        friction: 0.5,
        slow: 1e-3,
    };
    for method in METHODS {
        for last in [0.1, 0.1999, 0.2, 0.2003] {
            let run = moved(&scene, method, [0.0, 1.0], last);
            let logarithm = 1e3 - f64::ln(2.0) - 0.5 * 10.0 * last / 1e-3;
            let expected = match logarithm < 300.0 {
                true => 1e-3 * f64::asinh(f64::exp(logarithm)),
                false => 1e-3 * (logarithm + f64::ln(2.0)),
            };
            let v = run.final_state().v[0];
            assert!(
                (v - expected).abs() < 1e-7,
                "{method:?}, {last}: {v} {expected}"
            );
        }
    }
}

/// A wheel that turns past a narrow gate.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(phi),
    kinetic = inertia/2 * der(phi)^2,
    stop(gate: exp(-((phi - place)/width)^2) >= 0.5),
)]
struct Wheel {
    inertia: f64,
    place: f64,
    width: f64,
}

/// exp(−z²) is ½ at z = −√ln 2.
#[test]
fn a_narrow_gate_stops_what_turns_past_it() {
    for width in [0.1, 1e-2, 1e-4] {
        let scene = Wheel {
            inertia: 1.0,
            place: 2.0 * PI,
            width,
        };
        for method in METHODS {
            let run = moved(&scene, method, [0.0, 2.0], 20.0);
            let expected = (2.0 * PI - width * f64::ln(2.0).sqrt()) / 2.0;
            let time = run.last_time();
            assert!(
                (time - expected).abs() < 1e-8,
                "{method:?}, {width}: {time} {expected}"
            );
        }
    }
}

/// What is left out is not followed.
#[test]
fn exponents_of_what_is_left_out_cost_no_steps() {
    let scene = Pushed {
        mass: 2.0,
        blow: 3.0,
        centre: 4.0,
        width: 1e-3,
    };
    let steps = |simulation: Simulation<Pushed>| {
        let run = simulation
            .run(state(&[0.0], &[0.1]), 0.0..10.0)
            .expect("runs");
        run.work().steps
    };
    assert_eq!(
        steps(Simulation::new(&scene).effects(Effects::all().without(Pushed::PUSH))),
        1
    );
    assert!(steps(Simulation::new(&scene)) > 10);
}

/// A block that friction holds, under a load that comes and goes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    force(shake: x = load * sin(rate*t)^20),
    friction(rub: slip = der(x), limit = limit),
)]
struct Knocked {
    load: f64,
    rate: f64,
    limit: f64,
}

/// Where it is zero the load has no series but zeros, and nothing moves that bounds a step.
#[test]
fn each_knock_moves_what_rests() {
    let knocked = Knocked {
        load: 10.1,
        rate: 3.0,
        limit: 9.81,
    };
    let first = (9.81_f64 / 10.1).powf(1.0 / 20.0).asin() / 3.0;
    for (method, tolerance) in [
        ("taylor", 1e-6),
        ("taylor", 1e-9),
        ("taylor", 1e-12),
        ("dop853", 1e-9),
        ("radau5", 1e-6),
    ] {
        for until in [3.0, 60.0] {
            let run = run_by(&knocked, (method, tolerance), state(&[0.0], &[0.0]), until);
            let slips = times(&run, "rub", "slips");
            let asked = format!("{method} {tolerance:e} {until}");
            let pulses = ((until - first) * 3.0 / PI).floor() as usize + 1;
            assert_eq!(slips.len(), pulses, "{asked}");
            for (k, slips) in slips.iter().enumerate() {
                agree(
                    &asked,
                    *slips,
                    first + k as f64 * PI / 3.0,
                    100.0 * tolerance,
                );
            }
        }
    }
}

/// A block that rubs under a load which beats.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    force(push: x = load * sin(rate*t) * sin(1.37*rate*t)),
    friction(rub: slip = der(x), limit = limit),
)]
struct Beaten {
    load: f64,
    rate: f64,
    limit: f64,
}

impl Beaten {
    /// load/2 (cos (a − b) t − cos (a + b) t).
    fn push(&self, t: f64) -> f64 {
        0.5 * self.load * ((0.37 * self.rate * t).cos() - (2.37 * self.rate * t).cos())
    }

    /// Its integral.
    fn pushed(&self, t: f64) -> f64 {
        let part = |rate: f64| (rate * t).sin() / rate;
        0.5 * self.load * (part(0.37 * self.rate) - part(2.37 * self.rate))
    }

    /// When it begins to slip and comes to rest again.
    fn slips(&self, until: f64) -> Vec<[f64; 2]> {
        const STEP: f64 = 1e-3;
        let (mut t, mut slips) = (0.0, Vec::new());
        while t < until {
            if self.push(t + STEP).abs() <= self.limit {
                t += STEP;
                continue;
            }
            let begins = root(|t| self.limit - self.push(t).abs(), t, t + STEP);
            let along = self.push(begins).signum();
            let speed =
                |t: f64| along * (self.pushed(t) - self.pushed(begins)) - self.limit * (t - begins);
            t = begins + STEP;
            while speed(t + STEP) > 0.0 {
                t += STEP;
            }
            let rests = root(speed, t, t + STEP);
            slips.push([begins, rests]);
            t = rests;
        }
        slips
    }
}

/// It slips by forces that exceed what holds it by 3 parts in 10,000 and by more, for some hundredths of a second, once or twice in ten.
#[test]
fn no_method_misses_a_load_that_beats() {
    let beaten = Beaten {
        load: 10.0,
        rate: 2.1,
        limit: 9.81,
    };
    let expected = beaten.slips(200.0);
    assert_eq!(expected.len(), 30);
    for method in METHODS {
        let simulation = Simulation::new(&beaten).method(method).tolerance(1e-6);
        let found = simulation.run(state(&[0.0], &[0.0]), 0.0..200.0);
        let found = found.expect("runs");
        let slips = times(&found, "rub", "slips");
        let rests = times(&found, "rub", "sticks");
        assert_eq!((slips.len(), rests.len()), (30, 30), "{method:?}");
        for ((slips, rests), [begins, ends]) in slips.into_iter().zip(rests).zip(&expected) {
            agree("load", beaten.push(slips).abs(), beaten.limit, 1e-4);
            let off = (slips - begins).abs().max((rests - ends).abs());
            assert!(
                off < 5e-3,
                "{method:?}: {slips} and {rests} instead of {begins} and {ends}"
            );
        }
    }
}

/// A bead that slides down a wire which is pressed by next to nothing.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    force(press: y = load * sin(rate*t)^8),
    force(weight: x = gravity),
    constraint(wire: y == 0),
    friction(rub on wire: slip = der(x), static = 1),
)]
struct Bead {
    load: f64,
    rate: f64,
    gravity: f64,
}

/// The force of the wire is exact to its own size, however small it is beside the weight.
#[test]
fn a_small_force_that_friction_carries_is_exact() {
    let bead = Bead {
        load: 12.0,
        rate: 1.3,
        gravity: 9.81,
    };
    let until = 0.01_f64;
    for method in ["taylor", "dop853", "radau5"] {
        let run = run_by(&bead, (method, 1e-9), state(&[0.0; 2], &[0.0; 2]), until);
        certified(method, &run);
        let force = run.sampler().at(until).expect("the end").force(Bead::WIRE);
        let expected = -12.0 * (1.3 * until).sin().powi(8);
        agree(method, force / expected, 1.0, 1e-12);
    }
}

/// Two atoms that fly at one another, by the distance between them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r),
    kinetic = der(r)^2/2,
    potential = 4*depth*((size/r)^12 - (size/r)^6),
)]
struct Atoms {
    depth: f64,
    size: f64,
}

/// They feel nothing of one another until they touch, and nothing again beyond the pole: a step may not pass it.
#[test]
fn atoms_do_not_pass_through_one_another() {
    // In units of the size: how long it takes from 50 to the turn and back again.
    let slope = |_: f64, [r, v]: [f64; 2]| [v, 24.0 * (2.0 * r.powi(-13) - r.powi(-7))];
    let (mut t, mut y) = (0.0, [50.0, -1.0]);
    while y[0] < 50.0 || y[1] < 0.0 {
        let h = if y[0] > 5.0 { 1e-3 } else { 1e-5 };
        y = runge_kutta(slope, (t, y), h);
        t += h;
    }
    let turned = t - (y[0] - 50.0) / y[1];
    for size in [1e-2, 3e-3, 1e-4] {
        let atoms = Atoms { depth: 1.0, size };
        let expected = 3.0 + size * (100.0 - turned);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let simulation = Simulation::new(&atoms).method(method).tolerance(tolerance);
            let found = simulation.run(state(&[3.0], &[-1.0]), 0.0..6.0);
            let found = found.expect("runs");
            let far = (found.final_state().q[0] - expected).abs();
            assert!(
                far < 1e3 * tolerance + 1e-7,
                "{method:?} {tolerance:e} {size}: {far:e}"
            );
        }
    }
}

/// A body that runs against a hill V s²/(s² + x²).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    potential = height * width^2 / (width^2 + x^2),
    force(knock: x = blow/pi * width / (width^2 + (t - 15)^2)),
)]
struct Thorn {
    height: f64,
    width: f64,
    blow: f64,
}

/// It is thrown back by what is too narrow to be seen from where it comes, and pushed by a moment: a knock beyond its tails of 1/t² gives all its momentum.
#[test]
fn quotients_are_followed_however_narrow_they_are() {
    for width in [1e-4, 1e-6, 1e-8] {
        let thorn = Thorn {
            height: 0.6,
            width,
            blow: 0.5,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let simulation = Simulation::new(&thorn).method(method).tolerance(tolerance);
            let found = simulation.run(state(&[-5.0], &[1.0]), 0.0..20.0);
            let v = found.expect("runs").final_state().v[0];
            let far = (v + 0.5).abs();
            assert!(
                far < 1e3 * tolerance + width,
                "{method:?} {tolerance:e} {width}: {v}"
            );
        }
    }
}

/// A charge that passes a screened one: the distance has a kink there, all but.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(r = norm([x - 3, y])),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = height * size/r * exp(-r/size),
)]
struct Screened {
    height: f64,
    size: f64,
}

/// It is deflected: angular momentum and energy are kept, and the methods agree.
#[test]
fn what_is_screened_deflects_what_meets_it() {
    let scene = Screened {
        height: 0.6,
        size: 1e-3,
    };
    let ends = METHODS.map(|method| {
        let simulation = Simulation::new(&scene).method(method).tolerance(1e-9);
        let run = simulation.run(state(&[0.0, 1e-3], &[1.0, 0.0]), 0.0..6.0);
        let end = run.expect("runs").final_state().clone();
        let (q, v) = (&end.q, &end.v);
        agree("energy", v[0].hypot(v[1]), 1.0, 1e-7);
        agree("momentum", (q[0] - 3.0) * v[1] - q[1] * v[0], -1e-3, 1e-7);
        end
    });
    for end in &ends {
        assert!(end.v[1] > 0.4, "{end:?}");
        agree("deflected", end.q[1], ends[0].q[1], 1e-5);
    }
}

/// A ridge that falls off as a power of its distance and is written by `atan`, whose argument is large where nothing is seen of it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = height * (1 - 2/pi*atan((x - place)^2/width^2))^3,
)]
struct Ridge {
    mass: f64,
    height: f64,
    place: f64,
    width: f64,
}

/// With half of the energy that it takes to climb it a body comes back as it went, and with twice as much it goes on as it came.
#[test]
fn no_body_passes_a_ridge_of_angles_that_it_cannot_climb() {
    for width in [0.3, 0.03, 1e-3] {
        for (energy, turns) in [(0.5, -1.0), (2.0, 1.0)] {
            let scene = Ridge {
                mass: 1.4,
                height: 0.7,
                place: 4.7,
                width,
            };
            let speed = f64::sqrt(2.0 * energy * scene.height / scene.mass);
            for method in METHODS {
                let run = moved(&scene, method, [0.0, speed], 9.4 / speed);
                let v = run.final_state().v[0];
                let what = format!("{method}, {width}, {energy}: v = {v}");
                assert!((v - turns * speed).abs() < 1e-3 * width, "{what}");
                certified(&what, &run);
            }
        }
    }
}

/// A ball that is thrown over a tower, whose roof is told by two angles.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    define(roof = height/pi * (atan((x - from)/edge) - atan((x - to)/edge))),
    contact(tower: y >= roof - 0.5),
    start(thrown: der(x) = 17.5, der(y) = 21.0),
)]
struct Tower {
    gravity: f64,
    height: f64,
    from: f64,
    to: f64,
    edge: f64,
}

#[test]
fn a_ball_hits_a_tower_however_steep_its_walls() {
    for edge in [0.15, 0.06, 2e-3] {
        let scene = Tower {
            gravity: 9.81,
            height: 32.0,
            from: 36.0,
            to: 37.0,
            edge,
        };
        let gap = |t: f64| {
            let (x, y) = (17.5 * t, 21.0 * t - 0.5 * scene.gravity * t * t);
            let angle = |place: f64| ((x - place) / edge).atan();
            y + 0.5 - scene.height / PI * (angle(scene.from) - angle(scene.to))
        };
        let hits = root(gap, 1.5, 36.5 / 17.5);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = scene.at(Tower::THROWN);
            let run = run_by(&scene, (method, tolerance), start, 2.2);
            let what = format!("{method} at {tolerance:e}, {edge}");
            let at = times(&run, "tower", "impact");
            assert!(!at.is_empty(), "{what}");
            agree(&what, at[0], hits, 10.0 * tolerance);
        }
    }
}
