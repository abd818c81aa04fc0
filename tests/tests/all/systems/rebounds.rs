//! Impacts that carry velocities across a condition, and coefficients whose conditions nothing watches while their contact is open.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, event, run_by};

/// A ball bounces in air whose drag is quadratic.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2/2,
    potential = gravity * y,
    force(air: y = -drag * der(y) * abs(der(y))),
    contact(floor: y >= 0, restitution = bounce),
    start(drop: y = height),
)]
struct Ball {
    gravity: f64,
    drag: f64,
    bounce: f64,
    height: f64,
}

/// Fall and rise with quadratic drag: v = v∞ tanh, and v = v∞ tan.
#[test]
fn drag_is_against_the_motion_after_a_rebound_too() {
    let ball = Ball {
        gravity: 9.81,
        drag: 0.27,
        bounce: 0.83,
        height: 1.7,
    };
    let limit = (ball.gravity / ball.drag).sqrt();
    let pace = (ball.gravity * ball.drag).sqrt();
    // Time of a fall from a height, and speed at its end.
    let fall = |height: f64| {
        let time = (ball.drag * height).exp().acosh() / pace;
        (time, limit * (pace * time).tanh())
    };
    let (first, speed) = fall(ball.height);
    let up = ball.bounce * speed;
    let rise = (up / limit).atan() / pace;
    let apex = (1.0 + (up / limit).powi(2)).ln() / (2.0 * ball.drag);
    let (again, _) = fall(apex);
    for method in METHODS {
        let motion = run_by(&ball, (method, 1e-10), ball.at(Ball::DROP), 2.0);
        let mut impacts = motion
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Impact);
        let mut next = || impacts.next().map_or(f64::NAN, |e| e.time);
        agree("first", next(), first, 1e-8);
        agree("second", next(), first + rise + again, 1e-8);
        certified(method, &motion);
    }
}

/// A block on a belt runs against a wall; what grips it grows weaker with the speed of the slip.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    contact(wall: edge - x >= 0, restitution = bounce),
    friction(grip: slip = der(x) - belt, normal = load, static = still, kinetic = fast + (still - fast)*exp(-abs(slip)/fades)),
    start(go: der(x) = speed),
)]
struct Block {
    mass: f64,
    edge: f64,
    bounce: f64,
    belt: f64,
    load: f64,
    still: f64,
    fast: f64,
    fades: f64,
    speed: f64,
}

#[test]
fn the_speed_of_a_slip_is_its_size_on_either_side() {
    let block = Block {
        mass: 1.3,
        edge: 0.9,
        bounce: 0.8,
        belt: 0.4,
        load: 6.0,
        still: 0.45,
        fast: 0.25,
        fades: 0.35,
        speed: 2.6,
    };
    for method in METHODS {
        let motion = run_by(&block, (method, 1e-9), block.at(Block::GO), 1.0);
        let turn = event(&motion, "grip", "reverses");
        let slip = turn.v_after(Block::X) - block.belt;
        let share = block.fast + (block.still - block.fast) * (slip / block.fades).exp();
        let grip = turn.force_after(Block::GRIP);
        agree("grip", grip, block.load * share, 1e-12);
        certified(method, &motion);
    }
}

/// A ball is thrown onto ground with a patch, which takes its spin otherwise and lets it bounce otherwise; and onto ground that softens.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity * y,
    contact(ground: y >= 0, restitution = if(x >= edge, there, here) - softens*max(t - 0.1, 0)),
    friction(rub on ground: slip = der(x), static = if(x >= edge, rough, smooth)),
    start(throw: y = height, der(x) = speed),
)]
struct Throw {
    gravity: f64,
    edge: f64,
    here: f64,
    there: f64,
    softens: f64,
    rough: f64,
    smooth: f64,
    height: f64,
    speed: f64,
}

#[test]
fn an_impact_has_the_coefficients_of_where_it_is() {
    let throw = Throw {
        gravity: 9.81,
        edge: 1.0,
        here: 0.7,
        there: 0.3,
        softens: 0.2,
        rough: 0.11,
        smooth: 0.02,
        height: 1.5,
        speed: 2.9,
    };
    let time = (2.0 * throw.height / throw.gravity).sqrt();
    assert!(throw.speed * time > throw.edge);
    let restitution = throw.there - throw.softens * (time - 0.1);
    let fall = throw.gravity * time;
    let press = (1.0 + restitution) * fall;
    for method in METHODS {
        let motion = run_by(&throw, (method, 1e-10), throw.at(Throw::THROW), 0.7);
        let impact = event(&motion, "ground", "impact");
        agree("time", impact.time, time, 1e-9);
        agree("rise", impact.v_after(Throw::Y), restitution * fall, 1e-8);
        let rest = throw.speed - throw.rough * press;
        agree("speed", impact.v_after(Throw::X), rest, 1e-8);
        certified(method, &motion);
    }
}

/// Two masses on one rope, which friction presses; a motor pulls to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b),
    kinetic = first/2*der(a)^2 + second/2*der(b)^2,
    constraint(rope: a == b),
    friction(rub on rope: slip = der(a), static = mu),
    force(motor: a = sin(t)),
    start(go: der(a) = speed, der(b) = speed),
)]
struct Rope {
    first: f64,
    second: f64,
    mu: f64,
    speed: f64,
}

/// The force of the rope is f = m₂ a, and (m₁ + m₂) a = sin t − μ |f|: it passes zero with the sine, where all forces vanish at once.
#[test]
fn a_force_that_carries_friction_passes_zero_with_all_others() {
    let rope = Rope {
        first: 1.2,
        second: 0.7,
        mu: 0.15,
        speed: 9.0,
    };
    let total = rope.first + rope.second;
    let slope = |t: f64, [_, v]: [f64; 2]| {
        let pull = t.sin();
        let friction = rope.mu * rope.second * pull.signum();
        [v, pull / (total + friction)]
    };
    // Half waves, each of one sign.
    let (mut t, mut y) = (0.0, [0.0, rope.speed]);
    for _ in 0..3 {
        let h = std::f64::consts::PI / 4000.0;
        for k in 0..4000 {
            let middle = |s: f64, y| slope(s.clamp(t + 1e-12, t + 4000.0 * h - 1e-12), y);
            y = lagrange_tests::runge_kutta(middle, (t + h * f64::from(k), y), h);
        }
        t += 4000.0 * h;
    }
    for method in METHODS {
        let motion = run_by(&rope, (method, 1e-10), rope.at(Rope::GO), t);
        let State { q, v, .. } = motion.final_state();
        agree("place", q[0], y[0], 1e-7);
        agree("speed", v[0], y[1], 1e-8);
        certified(method, &motion);
    }
}

/// A brake that lets go at a given time.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    force(pull: x = 4),
    friction(brake: slip = der(x), limit = if(t >= release, 0, 5)),
)]
struct Brake {
    release: f64,
}

#[test]
fn a_brake_that_lets_go_has_held_until_then() {
    let brake = Brake { release: 0.8 };
    for method in METHODS {
        let motion = run_by(&brake, (method, 1e-9), state(&[0.0], &[0.0]), 2.0);
        agree("place", motion.final_state().q[0], 2.0 * 1.2 * 1.2, 1e-8);
        certified(method, &motion);
    }
}

/// A motor whose force is bounded drives a slide against a buffer.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p),
    kinetic = der(p)^2/2,
    force(motor: p = min(most, wish - damping*der(p))),
    contact(buffer: stroke - p >= 0, restitution = bounce),
)]
struct Slide {
    most: f64,
    wish: f64,
    damping: f64,
    stroke: f64,
    bounce: f64,
}

#[test]
fn a_bound_is_reached_by_a_blow() {
    let slide = Slide {
        most: 1.1,
        wish: 2.0,
        damping: 1.0,
        stroke: 1.0,
        bounce: 0.6,
    };
    // 2 m/s: the wish is 0 and stays below the bound until 0.9 m/s; after the blow at −v it is 2 + v.
    let (mut time, mut q) = (0.0, [0.0, 2.0]);
    let slope = |_: f64, [_, v]: [f64; 2]| [v, slide.wish - slide.damping * v];
    let step = 1e-4;
    while q[0] < slide.stroke {
        let next = lagrange_tests::runge_kutta(slope, (time, q), step);
        if next[0] >= slide.stroke {
            // v′ = wish − d v: the rest of the way by Newton's method.
            let rest = (0..5).fold(0.0, |h, _| {
                let [p, v] = lagrange_tests::runge_kutta(slope, (time, q), h);
                h - (p - slide.stroke) / v
            });
            q = lagrange_tests::runge_kutta(slope, (time, q), rest);
            time += rest;
            break;
        }
        (time, q) = (time + step, next);
    }
    let back = -slide.bounce * q[1];
    let left = 0.4;
    let expected = slide.stroke + back * left + slide.most * left * left / 2.0;
    for method in METHODS {
        let start = state(&[0.0], &[2.0]);
        let motion = run_by(&slide, (method, 1e-10), start, time + left);
        agree("place", motion.final_state().q[0], expected, 1e-8);
        certified(method, &motion);
    }
}
