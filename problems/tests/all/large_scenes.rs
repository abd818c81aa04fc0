//! The large scenes against formulas written by hand, and the balance of their energy.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;

/// The trajectory from a start.
fn run<S: System<Scalar = f64>>(
    system: &S,
    start: State<f64>,
    until: f64,
) -> Trajectory<S::Scalar> {
    Simulation::new(system)
        .tolerance(1e-12)
        .run(start, 0.0..until)
        .unwrap_or_else(|stopped| panic!("{stopped}"))
}

/// Calls `compare(q, v, v̇)` at times all over a run.
fn along(trajectory: &Trajectory, mut compare: impl FnMut(&[f64], &[f64], &[f64])) {
    let mut sampler = trajectory.sampler();
    for k in 0..=20 {
        let time = trajectory.last_time() * f64::from(k) / 20.0;
        let instant = sampler.at(time).expect("a time of the run");
        compare(&instant.state.q, &instant.state.v, &instant.acceleration);
    }
}

fn balance(trajectory: &Trajectory, tolerance: f64) {
    let closure = trajectory.ledger().expect("a ledger").closure;
    assert!(closure < tolerance, "energy is off by {closure:e}");
}

/// Each point's acceleration from the angles, then the torque of gravity and inertia about each joint: zero.
#[test]
fn chain() {
    let scene = Chain20::default();
    let (m, l, g) = (scene.mass, scene.length, scene.gravity);
    let trajectory = run(&scene, scene.at(<Chain20>::ARC), 1.5);
    along(&trajectory, |q, v, a| {
        let mut points = Vec::new();
        let (mut x, mut y, mut ax, mut ay) = (0.0, 0.0, 0.0, 0.0);
        for ((q, v), a) in q.iter().zip(v).zip(a) {
            let joint = (x, y);
            let (s, c) = q.sin_cos();
            (x, y) = (x + l * s, y - l * c);
            ax += l * (c * a - s * v * v);
            ay += l * (s * a + c * v * v);
            points.push((joint, x, y, ax, ay));
        }
        let (mut below, mut size) = ((0.0, 0.0, 0.0), 0.0_f64);
        for &((jx, jy), x, y, ax, ay) in points.iter().rev() {
            // Force and torque about the origin that everything from here down needs.
            let force = (m * ax, m * (ay + g));
            below.0 += force.0;
            below.1 += force.1;
            below.2 += x * force.1 - y * force.0;
            size = size.max(below.0.abs() + below.1.abs());
            let about_joint = below.2 - (jx * below.1 - jy * below.0);
            assert!(about_joint.abs() < 1e-11 * size, "{about_joint:e}");
        }
    });
    balance(&trajectory, 1e-11);
}

#[test]
fn a_chain_of_fifty_is_declared_like_one_of_ten() {
    let scene = Chain50::default();
    let trajectory = run(&scene, scene.at(<Chain50>::ARC), 0.2);
    balance(&trajectory, 1e-11);
}

/// Spring by spring.
#[test]
fn net() {
    let scene = Net::default();
    let length = scene.length;
    let trajectory = run(&scene, scene.at(<Net>::FLAT), 1.0);
    along(&trajectory, |q, v, a| {
        let place = |k: usize| {
            let (column, row) = ((k % 8) as f64, (k / 8) as f64);
            [q[k] + column * length, q[64 + k] + row * length, q[128 + k]]
        };
        let mut force = vec![[0.0; 3]; 64];
        let pull = |from: [f64; 3], to: [f64; 3]| {
            let d = [0, 1, 2].map(|i| to[i] - from[i]);
            let distance = d.iter().map(|d| d * d).sum::<f64>().sqrt();
            d.map(|d| scene.stiffness * (distance - length) * d / distance)
        };
        for k in 0..64 {
            let neighbours = [(k % 8 < 7, k + 1), (k < 56, k + 8)];
            for (_, other) in neighbours.into_iter().filter(|(there, _)| *there) {
                let f = pull(place(k), place(other));
                for i in 0..3 {
                    force[k][i] += f[i];
                    force[other][i] -= f[i];
                }
            }
            if [0, 7, 56, 63].contains(&k) {
                let (column, row) = ((k % 8) as f64, (k / 8) as f64);
                let f = pull(place(k), [column * length, row * length, length]);
                for i in 0..3 {
                    force[k][i] += f[i];
                }
            }
            force[k][2] -= scene.mass * scene.gravity;
        }
        for k in 0..64 {
            for i in 0..3 {
                let total = force[k][i] - scene.drag * v[64 * i + k];
                let missing = total - scene.mass * a[64 * i + k];
                assert!(missing.abs() < 1e-10, "knot {k}: {missing:e} N");
            }
        }
    });
    balance(&trajectory, 1e-11);
}
