//! Derivatives of states and of the instants of events by parameters and start, through switches and impacts.

use lagrange_core::arithmetic::Dual;
use lagrange_core::prelude::*;

/// A mass slides down a smooth shell and leaves it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r, theta),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(shell: r >= radius),
    start(rest: r = radius, theta = angle),
    stop(floor: y <= -radius),
)]
struct Shell<T = f64> {
    mass: T,
    gravity: T,
    radius: T,
    angle: T,
}

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
struct Ball<T = f64> {
    mass: T,
    gravity: T,
    bounce: T,
    height: T,
    speed: T,
}

/// A mass rides on a wheel that is free to roll away under it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r, theta),
    define(px = x + r * sin(theta), py = r * cos(theta)),
    kinetic   = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    potential = mass * gravity * py,
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius, restitution = 0),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius, theta = angle),
    stop(floor: py <= -radius),
)]
struct Wheel<T = f64> {
    wheel: T,
    inertia: T,
    mass: T,
    radius: T,
    gravity: T,
    mu_static: T,
    mu_kinetic: T,
    angle: T,
}

/// A puck slides on a table until friction stops it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = 0,
    friction(rub: slip = (der(x), der(y)), normal = mass * gravity, static = mu, kinetic = mu),
    start(push: der(x) = u, der(y) = w),
)]
struct Puck<T = f64> {
    mass: T,
    gravity: T,
    mu: T,
    u: T,
    w: T,
}

fn run<S: System>(
    scene: &S,
    start: State<S::Scalar>,
    until: f64,
    settings: (f64, Method),
) -> Trajectory<S> {
    let simulation = Simulation::new(scene)
        .tolerance(settings.0)
        .method(settings.1);
    match simulation.run(start, 0.0..until) {
        Ok(trajectory) => trajectory,
        Err(failure) => panic!("{failure}"),
    }
}

/// Instants of all events, states after them, final state.
fn all<T: Scalar>(record: &Record<T>) -> Vec<T> {
    let mut list = Vec::new();
    for event in record.events() {
        list.push(event.time);
        list.extend_from_slice(&event.state_after.q);
        list.extend_from_slice(&event.state_after.v);
    }
    list.extend_from_slice(&record.final_state().q);
    list.extend_from_slice(&record.final_state().v);
    list
}

fn seeded<const N: usize>(p: [f64; N]) -> [Dual<f64, N>; N] {
    core::array::from_fn(|i| Dual::variable(p[i], i))
}

#[track_caller]
fn agree(what: &str, a: f64, b: f64, tolerance: f64) {
    assert!(
        (a - b).abs() <= tolerance * b.abs().max(1.0),
        "{what}: {a} and {b}"
    );
}

/// Derivatives against central differences of the fourth order, in steps of `h` times the parameter.
fn compare<const N: usize>(
    p: [f64; N],
    plain: impl Fn([f64; N]) -> Vec<f64>,
    dual: &[Dual<f64, N>],
    h: f64,
    tolerance: f64,
) {
    let at = plain(p);
    assert_eq!(at.len(), dual.len());
    for (i, (a, b)) in at.iter().zip(dual).enumerate() {
        agree(&format!("value {i}"), b.value, *a, 1e-9);
    }
    for k in 0..N {
        let shifted = |by: f64| {
            let mut p = p;
            p[k] *= 1.0 + by;
            plain(p)
        };
        let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(shifted);
        for i in 0..at.len() {
            let slope = (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h * p[k]);
            agree(
                &format!("d out {i} / d parameter {k}"),
                dual[i].derivative[k],
                slope,
                tolerance,
            );
        }
    }
}

const TIGHT: (f64, Method) = (1e-14, Method::Taylor);
const USUAL: (f64, Method) = (1e-9, Method::Taylor);

fn shell<T: Scalar>(
    [mass, gravity, radius, angle]: [T; 4],
    settings: (f64, Method),
) -> Trajectory<Shell<T>> {
    let scene = Shell {
        mass,
        gravity,
        radius,
        angle,
    };
    run(&scene, scene.at(<Shell>::REST), 20.0, settings)
}

#[test]
fn where_and_when_a_mass_leaves_a_shell() {
    let p = [1.0, 9.81, 0.7, 0.1];
    for (settings, tolerance) in [
        (TIGHT, 1e-11),
        (USUAL, 1e-7),
        ((1e-11, Method::DormandPrince853), 1e-7),
    ] {
        let motion = shell(seeded(p), settings);
        let [lost, floor] = motion.events() else {
            panic!("{:?}", motion.events().len())
        };
        let theta = lost.state.q[1];
        agree(
            "θ",
            theta.value,
            (2.0 / 3.0 * 0.1_f64.cos()).acos(),
            tolerance,
        );
        // cos θ = ⅔ cos θ₀
        let slope = 2.0 / 3.0 * 0.1_f64.sin() / theta.value.sin();
        agree("dθ/dθ₀", theta.derivative[3], slope, tolerance);
        for event in [lost, floor] {
            let t = event.time;
            // Times go as √(R/g), whatever the mass.
            agree("dt/dm", t.derivative[0], 0.0, tolerance);
            agree("dt/dg", t.derivative[1], -0.5 * t.value / 9.81, tolerance);
            agree("dt/dR", t.derivative[2], 0.5 * t.value / 0.7, tolerance);
        }
        // On the floor y = −R.
        let [r, theta] = floor.state.q[..] else {
            panic!()
        };
        let y = r * Scalar::sin_cos(theta).1;
        agree("dy/dR", y.derivative[2], -1.0, tolerance);
        agree("dy/dθ₀", y.derivative[3], 0.0, tolerance);
    }
    let plain = |p| all(&shell(p, TIGHT));
    compare(p, plain, &all(&shell(seeded(p), TIGHT)), 1e-3, 1e-8);
}

fn ball<T: Scalar>(
    [gravity, bounce, height, speed]: [T; 4],
    until: f64,
    settings: (f64, Method),
) -> Trajectory<Ball<T>> {
    let scene = Ball {
        mass: T::one(),
        gravity,
        bounce,
        height,
        speed,
    };
    run(&scene, scene.at(<Ball>::DROP), until, settings)
}

#[test]
fn impacts_of_a_bouncing_ball() {
    let p = [9.81, 0.8, 1.0, 0.3];
    for (settings, tolerance) in [(USUAL, 1e-9), ((1e-9, Method::DormandPrince54), 1e-9)] {
        let motion = ball(seeded(p), 3.0, settings);
        // t = √(2h/g) (1 + 2 Σ eⁱ)
        let [g, e, h, u] = seeded::<4>(p);
        let two: Dual<f64, 4> = Scalar::from_f64(2.0);
        let fall: Dual<f64, 4> = (two * h / g).sqrt();
        let mut expected = fall;
        let mut power = e;
        let mut count = 0;
        // The velocity also passes zero where it jumps.
        let mut hit = 0.0;
        for event in motion.events() {
            if event.kind == EventKind::Impact {
                for k in 0..4 {
                    agree(
                        "impact",
                        event.time.derivative[k],
                        expected.derivative[k],
                        tolerance,
                    );
                    agree(
                        "x",
                        event.state.q[0].derivative[k],
                        (u * expected).derivative[k],
                        tolerance,
                    );
                    let after = power * g * fall;
                    agree(
                        "ẏ",
                        event.state_after.v[1].derivative[k],
                        after.derivative[k],
                        tolerance,
                    );
                }
                expected += two * fall * power;
                power *= e;
                count += 1;
                hit = event.time.value;
            } else if event.time.value > hit {
                let top = expected - fall * power / e;
                for k in 0..4 {
                    agree(
                        "top",
                        event.time.derivative[k],
                        top.derivative[k],
                        tolerance,
                    );
                }
            }
        }
        assert_eq!(count, 6);
        // In flight, by the last impact.
        let state = motion.final_state();
        let left = <Dual<f64, 4> as Scalar>::from_f64(3.0) - (expected - two * fall * power / e);
        let y = (power / e * g * fall - g * left / two) * left;
        let instant = motion.sampler().at(3.0).expect("within");
        for k in 0..4 {
            agree("y", state.q[1].derivative[k], y.derivative[k], tolerance);
            agree(
                "y sampled",
                instant.q[1].derivative[k],
                y.derivative[k],
                tolerance,
            );
            agree(
                "x",
                state.q[0].derivative[k],
                if k == 3 { 3.0 } else { 0.0 },
                tolerance,
            );
        }
    }
}

#[test]
fn the_limit_of_infinitely_many_impacts() {
    for speed in [0.0, 0.3] {
        let motion = ball(seeded([9.81, 0.5, 1.0, speed]), 3.0, USUAL);
        let [g, e, h, _] = seeded::<4>([9.81, 0.5, 1.0, speed]);
        let one = <Dual<f64, 4> as Scalar>::from_f64(1.0);
        let two: Dual<f64, 4> = Scalar::from_f64(2.0);
        let limit = (two * h / g).sqrt() * (one + e) / (one - e);
        let mut events = motion.events().iter();
        let rest = events
            .find(|e| e.kind.word() == "accumulates")
            .expect("comes to rest");
        for k in 0..4 {
            agree("limit", rest.time.derivative[k], limit.derivative[k], 1e-7);
        }
        assert_eq!(motion.final_state().q[1].derivative, [0.0; 4]);
        assert_eq!(motion.final_state().v[1].derivative, [0.0; 4]);
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

fn wheel<T: Scalar>(
    [inertia, mass, radius, mu_static, mu_kinetic, angle]: [T; 6],
    settings: (f64, Method),
) -> Trajectory<Wheel<T>> {
    let scene = Wheel {
        wheel: T::one(),
        inertia,
        mass,
        radius,
        gravity: T::from_f64(9.81),
        mu_static,
        mu_kinetic,
        angle,
    };
    run(&scene, scene.at(<Wheel>::REST), 20.0, settings)
}

const WHEEL: [f64; 6] = [0.125, 0.2, 0.5, 0.6, 0.5, 0.05];

#[test]
fn a_mass_on_a_wheel_sticks_slips_and_is_thrown() {
    let dual = all(&wheel(seeded(WHEEL), TIGHT));
    compare(WHEEL, |p| all(&wheel(p, TIGHT)), &dual, 1e-3, 1e-7);
    let usual = all(&wheel(seeded(WHEEL), USUAL));
    for (a, b) in usual.iter().zip(&dual) {
        for k in 0..6 {
            agree("tolerance", a.derivative[k], b.derivative[k], 1e-6);
        }
    }
}

#[test]
fn friction_stops_a_puck() {
    let p = [9.81, 0.2, 0.6, 0.8];
    let [g, mu, u, w] = seeded(p);
    let scene = Puck {
        mass: Scalar::from_f64(1.0),
        gravity: g,
        mu,
        u,
        w,
    };
    let motion = run(&scene, scene.at(<Puck>::PUSH), 2.0, USUAL);
    let speed = (u * u + w * w).sqrt();
    let time = speed / (mu * g);
    let half: Dual<f64, 4> = Scalar::from_f64(0.5);
    let [event] = motion.events() else {
        panic!("{}", motion.events().len())
    };
    for k in 0..4 {
        agree("t", event.time.derivative[k], time.derivative[k], 1e-9);
        agree(
            "x",
            motion.final_state().q[0].derivative[k],
            (half * u * time).derivative[k],
            1e-9,
        );
        agree(
            "y",
            motion.final_state().q[1].derivative[k],
            (half * w * time).derivative[k],
            1e-9,
        );
    }
}

#[test]
fn single_precision() {
    let single = wheel(WHEEL.map(|x| x as f32), (1e-6, Method::Taylor));
    let double = wheel(WHEEL, TIGHT);
    assert_eq!(single.events().len(), double.events().len());
    for (a, b) in all(&single).iter().zip(all(&double)) {
        agree("single", f64::from(*a), b, 1e-5);
    }
    let motion = ball([9.81_f32, 0.8, 1.0, 0.3], 1.0, (1e-6, Method::Taylor));
    agree(
        "impact",
        f64::from(motion.events()[0].time),
        (2.0 / 9.81_f64).sqrt(),
        1e-6,
    );
}
