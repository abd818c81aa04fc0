//! Derivatives of forces that the motion does not determine, where bounds decide how they are shared, and of the instants at which no shares
//! are left.

use super::{Slopes, compare, run, same_slopes, seeded};
use lagrange_core::Runnable;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree};

/// Reference runs.
const FINE: (f64, Method) = (1e-13, Method::Taylor);

fn number(x: f64) -> Slopes {
    Scalar::from_f64(x)
}

/// All forces at a time.
fn forces<T: Runnable>(motion: &Trajectory<T>, at: f64) -> Vec<T> {
    motion.sampler().at(at).expect("a state").forces
}

/// A plank on three feet, 1 to the left of its centre and two on its right; a load wanders along it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    define(foot = [-1, inner, outer], place = from + speed*t),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(theta)^2/3),
    potential = 10 * mass * y,
    force(load: (0, -weight) at (x + place*cos(theta), y + place*sin(theta))),
    force(pull: (weight/20, 0) at (x, y)),
    contact(ground[k in 0..3]: y + foot[k]*sin(theta) >= 0),
    friction(grip[k in 0..3] on ground[k]: slip = der(x), static = 0.4),
    start(rest),
)]
struct Plank<T = f64> {
    mass: T,
    weight: T,
    inner: T,
    outer: T,
    from: T,
    speed: T,
}

fn plank<T: Runnable>(p: [T; 6], settings: (f64, Method)) -> Trajectory<T> {
    let [mass, weight, inner, outer, from, speed] = p;
    let scene = Plank {
        mass,
        weight,
        inner,
        outer,
        from,
        speed,
    };
    run(&scene, scene.at(<Plank>::REST), 4.0, settings)
}

const PLANK: [f64; 6] = [1.3, 9.0, 0.15, 0.7, 0.1, 0.6];

/// It turns about its outer foot where the moment of the load is that of its own weight, m g b = F (s − b): all other feet are free then.
#[test]
fn a_plank_tips_when_its_load_has_come_to_its_end() {
    for method in METHODS {
        let motion = plank(seeded(PLANK), (1e-9, method));
        let [mass, weight, _, outer, from, speed] = seeded::<6>(PLANK);
        let own = number(10.0) * mass;
        let tips = (outer * (number(1.0) + own / weight) - from) / speed;
        let lost = motion.events().iter().take(2);
        assert!(lost.clone().all(|e| e.kind.word() == "lost"), "{method}");
        for event in lost {
            same_slopes(&format!("{method}"), event.time, tips, 1e-7);
            let [left, inner, outer] = [0, 1, 2].map(|k| event.forces[k]);
            agree("outer", outer.value, (own + weight).value, 1e-8);
            same_slopes("left", left, number(0.0), 1e-6);
            same_slopes("inner", inner, number(0.0), 1e-6);
            same_slopes("outer", outer, own + weight, 1e-6);
        }
    }
}

/// Before that the feet share the weights by least norm, then the left one is free, and the frictions under the feet that carry little are at
/// their limits.
#[test]
fn feet_share_a_load_that_wanders() {
    for at in [0.3, 0.8, 1.4, 2.0] {
        let plain = |p| forces(&plank(p, FINE), at);
        let motion = plank(seeded(PLANK), (1e-9, Method::Auto));
        compare(PLANK, plain, &forces(&motion, at), 1e-4, 1e-6);
    }
}

/// A box on four feet that is pulled along the ground by a force that grows, and aside by one that does not.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p[3]),
    attitude(body: q),
    define(
        side = [[-long, -0.3], [-long, 0.3], [long, -0.3], [long, 0.3]],
        foot[k in 0..4] = p + side[k][0]*body.axes[0] + side[k][1]*body.axes[1] - high*body.axes[2],
    ),
    kinetic = mass/2*dot(der(p), der(p)) + 0.1*dot(body.body_rate, body.body_rate),
    potential = 10*mass*p[2],
    force(pull: (rate*t, aside, 0) at p),
    contact(ground[k in 0..4]: foot[k][2] >= 0),
    friction(rub[k in 0..4] on ground[k]: slip = (der(foot[k][0]), der(foot[k][1])), static = mu),
    start(rest: p = [0, 0, high]),
)]
struct Crate<T = f64> {
    mass: T,
    mu: T,
    long: T,
    high: T,
    rate: T,
    aside: T,
}

fn pulled<T: Runnable>(p: [T; 6], settings: (f64, Method)) -> Trajectory<T> {
    let [mass, mu, long, high, rate, aside] = p;
    let scene = Crate {
        mass,
        mu,
        long,
        high,
        rate,
        aside,
    };
    run(&scene, scene.at(<Crate>::REST), 1.48, settings)
}

const CRATE: [f64; 6] = [0.8, 0.3, 0.5, 0.35, 1.5, 0.7];

/// The pull presses the feet in front, and all let go at 1.53. Those behind hold as much as they can, in directions that follow from all others.
#[test]
fn the_feet_of_a_crate_share_a_pull_near_its_limit() {
    for at in [0.4, 1.0, 1.3, 1.4, 1.45] {
        let plain = |p| forces(&pulled(p, FINE), at);
        let motion = pulled(seeded(CRATE), (1e-9, Method::Auto));
        let shared = forces(&motion, at);
        // Forces are in proportion to mass, pull and what pulls aside (Euler's theorem). Their values on the border of cones are known to 5e-8.
        for force in &shared {
            let by = |k: usize| CRATE[k] * force.derivative[k];
            agree("sum", by(0) + by(4) + by(5), force.value, 1e-7);
        }
        // Together they hold the weight and the pull.
        let [mass, mu, _, _, rate, aside] = seeded::<6>(CRATE);
        let sum = |first: usize, step: usize| {
            let forces = shared[first..].iter().step_by(step);
            forces.fold(number(0.0), |sum, &force| sum + force)
        };
        let weight = shared[1..5].iter().fold(number(0.0), |sum, &n| sum + n);
        same_slopes("weight", weight, number(10.0) * mass, 1e-9);
        same_slopes("along", sum(5, 2), -rate * number(at), 1e-9);
        same_slopes("aside", sum(6, 2), -aside, 1e-9);
        for k in 0..4 {
            let [x, y] = [5, 6].map(|first| shared[first + 2 * k]);
            let (holds, limit): (Slopes, Slopes) = ((x * x + y * y).sqrt(), mu * shared[1 + k]);
            if limit.value - holds.value < 1e-6 {
                same_slopes("at its limit", holds, limit, 1e-6);
            }
        }
        // Differences over steps of 3e-4 know that to 2e-4, and near the limit they would come to other bounds.
        if at < 1.4 {
            compare(CRATE, plain, &shared, 1e-3, 2e-4);
        }
    }
}

/// Two brakes hold a slider that is pushed more and more; that of one grows with the time.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = mass/2*der(x)^2,
    force(push: x = rate*t),
    friction(first: slip = der(x), limit = (hold*(1 + growth*t), hold/2)),
    friction(second: slip = der(x), limit = (other, other/2)),
    start(rest),
)]
struct Brakes<T = f64> {
    mass: T,
    rate: T,
    hold: T,
    growth: T,
    other: T,
}

/// It slips at t = (f₁ + f₂)/(r − f₁ b), when each brake holds as much as it can. Before that the weaker one does, and the other one the rest.
#[test]
fn brakes_that_share_a_push_let_go_when_both_have_reached_their_limits() {
    for method in METHODS {
        let p: [Slopes; 5] = seeded([1.7, 1.2, 1.1, 0.15, 2.6]);
        let [mass, rate, hold, growth, other] = p;
        let scene = Brakes {
            mass,
            rate,
            hold,
            growth,
            other,
        };
        let motion = run(&scene, scene.at(<Brakes>::REST), 5.0, (1e-9, method));
        let slips = (hold + other) / (rate - hold * growth);
        let most = |t| hold * (number(1.0) + growth * t);
        let event = &motion.events()[0];
        same_slopes(&format!("{method}"), event.time, slips, 1e-8);
        same_slopes("first at its limit", event.forces[0], -most(slips), 1e-7);
        same_slopes("second at its limit", event.forces[1], -other, 1e-7);
        let at = number(3.0);
        let before = motion.sampler().at(at.value).expect("a state");
        same_slopes("first", before.forces[0], -most(at), 1e-9);
        same_slopes("second", before.forces[1], most(at) - rate * at, 1e-9);
    }
}

/// A rod whose ends strike a rough floor at once and stick, one of them at its limit.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    define(
        side = [-1, 1],
        end[k in 0..2] = (x + side[k]*half*cos(theta), y + side[k]*half*sin(theta)),
    ),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + half^2/3*der(theta)^2),
    potential = 10*mass*y,
    contact(floor[k in 0..2]: end[k][1] >= 0),
    friction(near on floor[0]: slip = der(end[0][0]), static = mu),
    friction(far on floor[1]: slip = der(end[1][0]), static = 3*mu),
    start(drop: y = height, der(x) = speed),
)]
struct Rod<T = f64> {
    mass: T,
    half: T,
    mu: T,
    height: T,
    speed: T,
}

/// It lands flat, so that both ends press with half of m √(2 g h). The near one holds as much as it can, and the far one the rest.
#[test]
fn ends_of_a_rod_share_an_impulse() {
    let p: [Slopes; 5] = seeded([1.2, 0.6, 0.25, 0.2, 0.9]);
    let [mass, half, mu, height, speed] = p;
    let scene = Rod {
        mass,
        half,
        mu,
        height,
        speed,
    };
    let motion = run(&scene, scene.at(<Rod>::DROP), 1.0, (1e-9, Method::Auto));
    let impulses = &motion.events()[0].impulses;
    let presses = mass * (number(5.0) * height).sqrt();
    same_slopes("near", impulses[2], -mu * presses, 1e-9);
    same_slopes("far", impulses[3], mu * presses - mass * speed, 1e-9);
}
