//! Balls that turn in space, each of which may meet each other one with friction: many slips of many terms.

use lagrange_program::file::scene;
use lagrange_program::request::Request;
use std::fmt::Write;

/// Balls.
const BALLS: usize = 6;
/// Their mass, kg, and moment of inertia, kg m².
const MASS: f64 = 0.17;
const INERTIA: f64 = 5.5e-5;

/// The declaration: one ball flies into the others, which rest about a point.
fn declaration() -> String {
    let mut text = format!("parameters(mass = {MASS}, radius = 0.0286, inertia = {INERTIA}),\n");
    let sum = |term: &dyn Fn(usize) -> String| {
        let terms: Vec<String> = (0..BALLS).map(term).collect();
        terms.join(" + ")
    };
    for i in 0..BALLS {
        let _ = writeln!(text, "coordinates(x{i}[3]), attitude(B{i}: q{i}),");
        for j in 0..i {
            let _ = writeln!(
                text,
                "define(
                    d{i}{j} = x{i} - x{j}, n{i}{j} = d{i}{j} / norm(d{i}{j}), h{i}{j} = sqrt(n{i}{j}[0]^2 + n{i}{j}[1]^2),
                    e{i}{j} = [-n{i}{j}[1] / h{i}{j}, n{i}{j}[0] / h{i}{j}, 0], f{i}{j} = cross(n{i}{j}, e{i}{j}),
                    s{i}{j} = der(x{i}) - der(x{j}) - cross(radius * B{i}.space_rate + radius * B{j}.space_rate, n{i}{j}),
                ),
                contact(c{i}{j}: norm(d{i}{j}) >= 2 * radius, restitution = 0.9),
                friction(g{i}{j} on c{i}{j}: slip = (dot(s{i}{j}, e{i}{j}), dot(s{i}{j}, f{i}{j})), static = 0.2, kinetic = 0.2),"
            );
        }
    }
    let kinetic = |i| {
        format!(
            "mass/2 * dot(der(x{i}), der(x{i})) + inertia/2 * dot(B{i}.body_rate, B{i}.body_rate)"
        )
    };
    let moved = |k: usize| move |i| format!("mass * der(x{i})[{k}]");
    let turned = |k: usize| {
        move |i| format!("mass * cross(x{i}, der(x{i}))[{k}] + inertia * B{i}.space_rate[{k}]")
    };
    let _ = writeln!(text, "kinetic = {},", sum(&kinetic));
    for k in 0..3 {
        let [moved, turned] = [sum(&moved(k)), sum(&turned(k))];
        let _ = writeln!(text, "observe(p{k} = {moved}, l{k} = {turned}),");
    }
    text.push_str(
        "start(shot: x0 = [-0.3, 0.01, 0.02], der(x0) = [2, 0, 0], B0.space_rate = (3, -20, 40),
            x1 = [0, 0, 0], x2 = [0.06, 0.032, 0.004], x3 = [0.063, -0.031, 0], x4 = [0.05, 0.003, 0.065], x5 = [0.13, 0.01, 0.01]),
        impacts = in_turn, until = 0.6,",
    );
    text
}

/// Whatever happens where two of them meet, momentum and angular momentum stay, and the energy does not grow.
#[test]
fn what_happens_between_balls_keeps_momentum() {
    let read = scene("balls.lagrange", &declaration());
    let read = read.unwrap_or_else(|refused| panic!("{refused}"));
    let request = Request {
        samples: 50,
        ..Request::default()
    };
    let run = read.run(&request).expect("a start");
    assert!(run.failure.is_none(), "{:?}", run.failure);
    assert!(run.events.len() > 3, "{} events", run.events.len());
    let certificate = run.certificate.as_ref().expect("a certificate");
    assert!(certificate.holds(), "{certificate:?}");
    // The first ball is declared first: p = m v, and l = m x × v + I ω.
    let [vx, y, z] = [2.0, 0.01, 0.02];
    let expected = [
        MASS * vx,
        3.0 * INERTIA,
        0.0,
        MASS * z * vx - 20.0 * INERTIA,
        0.0,
        -MASS * y * vx + 40.0 * INERTIA,
    ];
    let mut energy = f64::INFINITY;
    for sample in &run.samples {
        for (found, expected) in sample.observes.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-10, "{sample:?}");
        }
        assert!(sample.energies.kinetic < energy + 1e-12, "{sample:?}");
        energy = sample.energies.kinetic;
    }
}
