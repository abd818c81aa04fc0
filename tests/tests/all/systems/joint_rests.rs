//! Slips of one motion that end at one instant, whatever the errors of the run say of each.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, event, integral, methods_at, root, run, run_by, times,
};

/// A bob on a rod rubs along two walls and is pushed ever more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    constraint(rod: sqrt(x^2 + y^2) == 1),
    friction(floor: slip = der(x), limit = (a, 4/5 * a)),
    friction(wall: slip = der(y), limit = (b, 4/5 * b)),
    force(push: x = rise * t^2),
)]
struct Bob {
    a: f64,
    b: f64,
    rise: f64,
}

/// Both slips end together, and begin again where the push along the circle exceeds what both hold: (a |cos φ| + b |sin φ|).
#[test]
fn frictions_that_come_to_rest_together_hold_together() {
    let mut random = Random::new(45);
    let mut rested = 0;
    for _ in 0..12 {
        let bob = Bob {
            a: random.between(0.8, 2.0),
            b: random.between(0.8, 2.0),
            rise: random.between(1.0, 1.6),
        };
        let speed = -random.between(1.2, 1.7);
        let (sin, cos) = random.between(0.02, 0.3).sin_cos();
        let start = state(&[sin, -cos], &[speed * cos, speed * sin]);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&bob, (method, tolerance), start.clone(), 3.0);
            let sticks = motion.events().iter().find(|event| {
                event.kind == EventKind::Sticks && event.subject == Subject::Friction(1)
            });
            let Some(rest) = sticks else {
                continue;
            };
            rested += 1;
            let what = format!("{bob:?} {speed} by {method} at {tolerance:e}");
            agree(
                &what,
                event(&motion, "floor", "sticks").time,
                rest.time,
                1e-15,
            );
            let [x, y] = [0, 1].map(|j| rest.state_after.q[j].abs());
            let time = ((bob.a * y + bob.b * x) / (bob.rise * y)).sqrt();
            for friction in ["floor", "wall"] {
                let slips = event(&motion, friction, "slips").time;
                agree(&what, slips, time, 100.0 * tolerance);
            }
        }
    }
    assert!(rested > 100, "{rested} runs come to rest");
}

/// A block on a wedge that stands on a floor, in coordinates of which none is that of a surface. One of its three rows follows from the others: only the
/// numbers sin 1 and cos 1 hide it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, x, w),
    define(y = a + w),
    kinetic = der(w)^2/2 + (der(x)^2 + der(y)^2)/2,
    contact(face: y*cos(1) + (x - w)*sin(1) >= 0),
    friction(grip on face: slip = der(x) - der(w) - der(y), static = mu),
    dissipation(drag: der(w)^2/2),
    contact(floor: y >= 0),
)]
struct Wedge {
    mu: f64,
}

/// Both move as one: 2 ẅ = −ẇ.
#[test]
fn a_row_that_follows_from_others_in_sines_is_no_divisor() {
    let start = state(&[0.0; 3], &[1.0, -1.0, -1.0]);
    let motion = run(&Wedge { mu: 1.0 }, start, 2.0);
    let gone = 2.0 * (1.0 - (-1.0_f64).exp());
    for (j, expected) in [gone, -gone, -gone].into_iter().enumerate() {
        agree("position", motion.final_state().q[j], expected, 1e-9);
    }
}

/// A crank moves two slides by cams that are in their dead centres at one instant, and both slides rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(q, x, y),
    kinetic = (der(q)^2 + der(x)^2 + der(y)^2) / 2,
    constraint(first: x == cos(a*q)),
    constraint(second: y == c*cos(b*q)),
    friction(on_first: slip = der(x), limit = f),
    friction(on_second: slip = der(y), limit = g),
    start(turning: q = -q0, x = cos(a*q0), y = c*cos(b*q0), der(q) = w, der(x) = w*a*sin(a*q0), der(y) = w*b*c*sin(b*q0)),
)]
struct Cams {
    a: f64,
    b: f64,
    c: f64,
    f: f64,
    g: f64,
    q0: f64,
    w: f64,
}

/// No friction holds a slide there; what the crank loses is what the frictions take on the ways of the slides.
#[test]
fn frictions_that_are_in_their_dead_centres_together_do_not_hold() {
    let mut random = Random::new(47);
    for _ in 0..12 {
        let cams = Cams {
            a: random.between(0.6, 1.6),
            b: random.between(0.6, 1.6),
            c: random.between(0.6, 1.6),
            f: random.between(0.1, 0.4),
            g: random.between(0.1, 0.4),
            q0: random.between(0.05, 0.6),
            w: random.between(1.5, 3.0),
        };
        let energy = |q: f64, w: f64| {
            let slides = [(cams.a, 1.0), (cams.b, cams.c)];
            let rates = slides.map(|(turns, size)| turns * size * (turns * q).sin());
            (1.0 + rates[0].powi(2) + rates[1].powi(2)) * w * w / 2.0
        };
        // Both slides go out to where they turn, and back.
        let taken = |q: f64| {
            let way = |turns: f64| 2.0 - (turns * cams.q0).cos() - (turns * q).cos();
            cams.f * way(cams.a) + cams.g * cams.c * way(cams.b)
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{cams:?} by {method} at {tolerance:e}");
            let motion = run_by(&cams, (method, tolerance), cams.at(Cams::TURNING), 0.7);
            let end = motion.final_state();
            assert!(end.q[0] > 0.0, "{what}: {}", end.q[0]);
            let lost = energy(cams.q0, cams.w) - energy(end.q[0], end.v[0]);
            agree(&what, lost, taken(end.q[0]), 100.0 * tolerance);
        }
    }
}

/// A slide that two frictions hold, one of them by a lever that turns as something else moves on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    friction(lever: slip = der(x) * sqrt(1 + y^2), limit = a),
    friction(rail: slip = der(x), limit = b),
    force(push: x = load * sin(rate * t)),
    start(moving: y = y0, der(x) = -speed, der(y) = turn),
)]
struct Levered {
    load: f64,
    y0: f64,
    rate: f64,
    a: f64,
    b: f64,
    speed: f64,
    turn: f64,
}

/// It comes to rest where the impulses of push and frictions have taken its momentum, and moves on where the push exceeds what both hold, which is for
/// a while only in the third case. What rounding leaves of its velocity does not tell the frictions apart.
#[test]
fn frictions_of_one_slide_hold_it_together_while_a_lever_turns() {
    let cases = [
        [
            3.2195803, -1.2007475, 1.2881164, 1.0799542, 0.7386282, 1.0772210, 1.4255229,
        ],
        [
            5.8681028, -1.0782588, 0.5565514, 0.5594104, 1.0848492, 0.8960450, 1.3357843,
        ],
        [
            3.1348207, -1.4223393, 0.8309541, 1.1166337, 1.1864450, 1.2418694, 1.5988072,
        ],
        [
            4.6755870, -1.1435273, 0.6009794, 0.5431272, 0.6602086, 0.8522566, 1.2923456,
        ],
        [
            4.6149157, -1.4769224, 0.6929849, 0.8875306, 1.0635868, 1.6017184, 1.4426922,
        ],
        [
            4.8543652, -1.1329025, 1.4077294, 1.1253062, 0.8163887, 0.9592995, 1.4330660,
        ],
        [
            3.4112160, -1.0848973, 1.4087743, 0.8086206, 1.0449486, 1.3293820, 1.0211257,
        ],
    ];
    for [load, y0, rate, a, b, speed, turn] in cases {
        let slide = Levered {
            load,
            y0,
            rate,
            a,
            b,
            speed,
            turn,
        };
        let push = |t: f64| load * (rate * t).sin();
        let holds = |t: f64| a * (1.0 + (y0 + turn * t).powi(2)).sqrt() + b;
        let momentum = |t: f64| integral(|t| push(t) + holds(t), 0.0, t) - speed;
        let rests = root(momentum, 0.0, 1.0);
        let mut ahead = (1..).map(|k| rests + 0.01 * f64::from(k));
        let beyond = ahead.find(|&t| push(t) > holds(t)).expect("it moves on");
        let goes_on = root(|t| push(t) - holds(t), beyond - 0.01, beyond);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&slide, (method, tolerance), slide.at(Levered::MOVING), 2.0);
            let what = format!("{slide:?} by {method} at {tolerance:e}");
            for friction in ["lever", "rail"] {
                for (kind, time) in [("sticks", rests), ("slips", goes_on)] {
                    let found = times(&motion, friction, kind);
                    agree(
                        format!("{what}: {friction} {kind}"),
                        found[0],
                        time,
                        100.0 * tolerance,
                    );
                }
            }
        }
    }
}
