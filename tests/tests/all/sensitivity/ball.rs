//! Derivatives of a bouncing ball: impacts, their limit, and second derivatives.

use super::{MOST, Slopes, USUAL, run, same_slopes, seeded};
use lagrange_core::Runnable;
use lagrange_core::arithmetic::Dual;
use lagrange_core::prelude::*;
use lagrange_tests::agree;

/// A ball that bounces on the floor while it moves sideways.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    start(drop: y = height, der(x) = speed),
    mark(top: der(y)),
)]
pub struct Ball<T = f64> {
    mass: T,
    gravity: T,
    bounce: T,
    height: T,
    speed: T,
}

pub fn ball<T: Runnable>(
    [gravity, bounce, height, speed]: [T; 4],
    until: f64,
    settings: (f64, Method),
) -> Trajectory<T> {
    let scene = Ball {
        mass: T::one(),
        gravity,
        bounce,
        height,
        speed,
    };
    run(&scene, scene.at(<Ball>::DROP), until, settings)
}

fn number(x: f64) -> Slopes {
    Scalar::from_f64(x)
}

#[test]
fn impacts_of_a_bouncing_ball() {
    let p = [9.81, 0.8, 1.0, 0.3];
    for (settings, tolerance) in [(USUAL, 1e-9), ((1e-9, Method::DormandPrince54), 1e-9)] {
        let motion = ball(seeded(p), 3.0, settings);
        // t = √(2h/g) (1 + 2 Σ eⁱ)
        let [g, e, h, u] = seeded(p);
        let two = number(2.0);
        let fall: Slopes = (two * h / g).sqrt();
        let mut expected = fall;
        let mut power = e;
        let mut count = 0;
        // The velocity also passes zero where it jumps.
        let mut hit = 0.0;
        for event in motion.events() {
            if event.kind == EventKind::Impact {
                same_slopes("impact", event.time, expected, tolerance);
                same_slopes("x", event.state.q[0], u * expected, tolerance);
                same_slopes("ẏ", event.state_after.v[1], power * g * fall, tolerance);
                expected += two * fall * power;
                power *= e;
                count += 1;
                hit = event.time.value;
            } else if event.time.value > hit {
                same_slopes("top", event.time, expected - fall * power / e, tolerance);
            }
        }
        assert_eq!(count, 6);
        // In flight, by the last impact.
        let state = motion.final_state();
        let left = number(3.0) - (expected - two * fall * power / e);
        let y = (power / e * g * fall - g * left / two) * left;
        let instant = motion.sampler().at(3.0).expect("within");
        same_slopes("y", state.q[1], y, tolerance);
        same_slopes("y sampled", instant.state.q[1], y, tolerance);
        same_slopes("x", state.q[0], u * number(3.0), tolerance);
    }
}

#[test]
fn the_limit_of_infinitely_many_impacts() {
    for speed in [0.0, 0.3] {
        let p = [9.81, 0.5, 1.0, speed];
        let motion = ball(seeded(p), 3.0, USUAL);
        let [g, e, h, _] = seeded(p);
        let fall: Slopes = (number(2.0) * h / g).sqrt();
        let limit = fall * (number(1.0) + e) / (number(1.0) - e);
        let mut events = motion.events().iter();
        let rest = events
            .find(|e| e.kind.word() == "accumulates")
            .expect("comes to rest");
        same_slopes("limit", rest.time, limit, 1e-7);
        assert_eq!(motion.final_state().q[1].derivative, [0.0; MOST]);
        assert_eq!(motion.final_state().v[1].derivative, [0.0; MOST]);
        agree("dx/du", motion.final_state().q[0].derivative[3], 3.0, 1e-9);
    }
}

#[test]
fn second_derivatives_nest() {
    type Second = Dual<Dual<f64, 1>, 1>;
    let bounce = Second::variable(Dual::variable(0.8, 0), 0);
    let [gravity, height, speed] = [9.81, 1.0, 0.0].map(<Second as Scalar>::from_f64);
    let motion = ball([gravity, bounce, height, speed], 2.0, USUAL);
    let fall = (2.0 / 9.81_f64).sqrt();
    let impacts = motion
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Impact);
    for (n, event) in impacts.enumerate() {
        // d²/de² of 2 Σ eⁱ
        let terms = (2..=n as i32).map(|i| f64::from(i * (i - 1)) * 0.8_f64.powi(i - 2));
        let second = event.time.derivative[0].derivative[0];
        agree("d²t/de²", second, 2.0 * fall * terms.sum::<f64>(), 1e-9);
    }
}

/// A mass on its way to a wall, and another one that is pushed harder and harder meanwhile.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, z),
    kinetic = (der(x)^2 + mass * der(z)^2) / 2,
    force(push: z = strength * t^2),
    stop(arrived: x >= stops_at),
    contact(wall: x <= length, restitution = 1/2),
    observe(clock = t),
    start(go: der(x) = speed),
)]
struct Approach<T = f64> {
    mass: T,
    strength: T,
    speed: T,
    length: T,
    stops_at: T,
}

/// At the last time, T = length/speed, everything has its derivatives at the end that moves: recorded or not, at a stop or after an event.
#[test]
fn all_at_the_end_of_a_run_moves_with_it() {
    for p in [[1.5, 0.8, 2.0, 3.0], [0.7, 1.9, 0.6, 1.1]] {
        let [mass, strength, speed, length] = seeded(p);
        let end: Slopes = length / speed;
        let far = number(100.0);
        for (wall, stops_at) in [(length, far), (far, length)] {
            let scene: Approach<Slopes> = Approach {
                mass,
                strength,
                speed,
                length: wall,
                stops_at,
            };
            for recorded in [true, false] {
                let simulation = Simulation::new(&scene).record(recorded);
                let simulation = simulation.end_after(<Approach>::WALL);
                let run = simulation.run(scene.at(<Approach>::GO), 0.0..20.0);
                let run = run.unwrap_or_else(|failure| panic!("{failure}"));
                let now = run.sampler().at(run.last_time()).expect("the end");
                let load = strength * end * end;
                let fast = load * end / (number(3.0) * mass);
                for (what, found, expected) in [
                    ("time", now.time, end),
                    ("clock", now.observe(<Approach>::CLOCK), end),
                    ("load", now.load(<Approach>::PUSH), load),
                    ("acceleration", now.a(<Approach>::Z), load / mass),
                    ("velocity", now.v(<Approach>::Z), fast),
                    ("final velocity", run.final_state().v(<Approach>::Z), fast),
                ] {
                    let what = format!("{what}, recorded: {recorded}");
                    agree(&what, found.value, expected.value, 1e-9);
                    same_slopes(&what, found, expected, 1e-8);
                }
            }
        }
    }
}
