//! The Carvallo–Whipple bicycle: two wheels that roll on knife edges, a frame with its rider, a fork.
//!
//! Model, parameters and eigenvalues: Meijaard, Papadopoulos, Ruina & Schwab, "Linearized dynamics equations for the balance and steer of a
//! bicycle: a benchmark and review", Proceedings of the Royal Society A 463 (2007), tables 1 and 2. There the equations are linearized by hand;
//! here small motions are run with those of the declaration, and the eigenvalues are read off them.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified};
use nalgebra::{Complex, ComplexField, DMatrix, Matrix4};

/// x forward, y to the right, z down; SI units. The frame leans by φ, is pitched by θ, and the fork is steered by δ.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, yaw, lean, pitch, steer, rear, front),
    define(
        down = [0, 0, 1],
        ahead = [cos(yaw), sin(yaw), 0],
        side = [-sin(yaw) * cos(lean), cos(yaw) * cos(lean), sin(lean)],
        under = cross(ahead, side),
        // Axes of the frame and of the fork, whose head is tilted by π/10.
        fx = cos(pitch) * ahead - sin(pitch) * under,
        fz = sin(pitch) * ahead + cos(pitch) * under,
        head = sin(pi/10) * fx + cos(pi/10) * fz,
        level = cos(pi/10) * fx - sin(pi/10) * fz,
        turned = cos(steer) * level + sin(steer) * side,
        hx = sin(pi/10) * head + cos(pi/10) * turned,
        hy = cos(steer) * side - sin(steer) * level,
        hz = cos(pi/10) * head - sin(pi/10) * turned,
        // Places of the rear wheel, the rider, the fork and the front wheel.
        hub = [x, y, -0.3 * cos(lean)],
        rider = hub + 0.3 * fx - 0.6 * fz,
        foot = hub + 1.1 * fx + 0.3 * fz,
        fork = foot - 0.2 * hx - 0.7 * hz,
        wheel = foot - 0.08 * hx - 0.35 * hz,
        turning = der(yaw) * down + der(lean) * ahead + der(pitch) * side,
        steering = turning + der(steer) * head,
        rear_turning = turning + der(rear) * side,
        front_turning = steering + der(front) * hy,
        // Velocities of the points of the wheels that touch the ground.
        rear_slip = der(hub) + cross(rear_turning, 0.3 * (down - side[2] * side)) / sqrt(1 - side[2]^2),
        front_slip = der(wheel) + cross(front_turning, 0.35 * (down - hy[2] * hy)) / sqrt(1 - hy[2]^2),
    ),
    kinetic = dot(der(hub), der(hub)) + 85/2 * dot(der(rider), der(rider))
        + 2 * dot(der(fork), der(fork)) + 3/2 * dot(der(wheel), der(wheel))
        + 9.2/2 * dot(turning, fx)^2 + 11/2 * dot(turning, side)^2 + 2.8/2 * dot(turning, fz)^2
        + 2.4 * dot(turning, fx) * dot(turning, fz)
        + 0.05892/2 * dot(steering, hx)^2 + 0.06/2 * dot(steering, hy)^2 + 0.00708/2 * dot(steering, hz)^2
        - 0.00756 * dot(steering, hx) * dot(steering, hz)
        + 0.0603/2 * (dot(turning, fx)^2 + dot(turning, fz)^2) + 0.12/2 * dot(rear_turning, side)^2
        + 0.1405/2 * (dot(steering, hx)^2 + dot(steering, hz)^2) + 0.28/2 * dot(front_turning, hy)^2,
    potential = -9.81 * (2 * hub[2] + 85 * rider[2] + 4 * fork[2] + 3 * wheel[2]),
    constraint(ground: wheel[2] + 0.35 * sqrt(1 - hy[2]^2) == 0),
    constraint(rear_roll[k in 0..2]: rear_slip[k] == 0),
    constraint(front_roll[k in 0..2]: front_slip[k] == 0),
    check(conserved energy),
)]
struct Bicycle {}

/// Eigenvalues of small motions about upright riding at a speed, ascending in their real and imaginary parts.
fn eigenvalues(speed: f64) -> Vec<Complex<f64>> {
    const TIP: f64 = 1e-5;
    const SAMPLES: usize = 80;
    const STEP: f64 = 0.01;
    let (rear, front) = (-speed / 0.3, -speed / 0.35);
    let start = state(
        &[0.0; 8],
        &[speed, 0.3 * TIP, 0.0, TIP, 0.0, 0.0, rear, front],
    );
    let scene = Bicycle {};
    let simulation = Simulation::new(&scene).tolerance(1e-15).project_start(true);
    let run = simulation
        .run(start, 0.0..STEP * SAMPLES as f64)
        .expect("rides");
    certified("", &run);
    let mut sampler = run.sampler();
    let mut column = |k: usize| {
        let now = sampler.at(STEP * k as f64).expect("on the way");
        let (lean, steer) = (Bicycle::LEAN, Bicycle::STEER);
        [now.q(lean), now.q(steer), now.v(lean), now.v(steer)]
    };
    // x(t + h) = P x(t): the matrix P that fits all samples best, each in its own size.
    let columns: Vec<[f64; 4]> = (0..=SAMPLES).map(&mut column).collect();
    let size = |k: usize| columns[k].iter().map(|x| x * x).sum::<f64>().sqrt();
    let now = DMatrix::from_fn(SAMPLES, 4, |k, i| columns[k][i] / size(k));
    let then = DMatrix::from_fn(SAMPLES, 4, |k, i| columns[k + 1][i] / size(k));
    let fitted = now.svd(true, true).solve(&then, 1e-13).expect("a fit");
    let fitted = Matrix4::from_iterator(fitted.transpose().iter().copied());
    let mut found: Vec<Complex<f64>> = fitted
        .complex_eigenvalues()
        .iter()
        .map(|z| z.ln() / STEP)
        .collect();
    found.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).expect("numbers"));
    found
}

#[test]
fn a_bicycle_has_the_eigenvalues_of_the_benchmark() {
    let published = [
        (
            5.0,
            [
                (-14.078_389_692_798_22, 0.0),
                (-0.775_341_882_195_85, -4.464_867_713_788_23),
                (-0.775_341_882_195_85, 4.464_867_713_788_23),
                (-0.322_866_429_004_09, 0.0),
            ],
        ),
        (
            0.0,
            [
                (-5.530_943_717_653_93, 0.0),
                (-3.131_643_247_906_56, 0.0),
                (3.131_643_247_906_56, 0.0),
                (5.530_943_717_653_93, 0.0),
            ],
        ),
    ];
    for (speed, published) in published {
        for (found, (re, im)) in eigenvalues(speed).into_iter().zip(published) {
            agree("decay", found.re, re, 1e-8);
            agree("rate", found.im, im, 1e-8);
        }
    }
}
