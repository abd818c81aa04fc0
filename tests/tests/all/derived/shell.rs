//! The point mass in polar coordinates r, θ.

use super::{HandRow, STATES, Textbook, check_inertia, check_motion, check_row};
use lagrange_problems::scenes::MassOnShell;
use lagrange_tests::Random;
use lagrange_tests::modes::{flight, stuck};

fn scene(random: &mut Random) -> MassOnShell {
    MassOnShell {
        mass: random.between(0.1, 5.0),
        radius: random.between(0.2, 3.0),
        gravity: random.between(1.0, 20.0),
        start_angle: 0.1,
    }
}

#[test]
fn inertia_and_rows() {
    let mut random = Random::new(1);
    for _ in 0..STATES {
        let scene = scene(&mut random);
        let (m, g) = (scene.mass, scene.gravity);
        let (r, theta) = (random.between(0.3, 4.0), random.between(-3.0, 3.0));
        let (rd, td) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
        let (q, v) = ([r, theta], [rd, td]);
        let mass = [vec![m, 0.0], vec![0.0, m * r * r]];
        let forcing = [
            m * r * td * td - m * g * theta.cos(),
            -2.0 * m * r * rd * td + m * g * r * theta.sin(),
        ];
        let shell = HandRow {
            jacobian: vec![1.0, 0.0],
            bias: 0.0,
            position: r - scene.radius,
            velocity: rd,
        };
        for mode in [flight::<MassOnShell>(), stuck::<MassOnShell>()] {
            check_inertia(&scene, &mode, &q, &v, &mass, &forcing);
            check_row(&scene, &mode, &q, &v, 0, &shell);
        }
    }
}

#[test]
fn slides() {
    let mut random = Random::new(2);
    for _ in 0..STATES {
        let scene = scene(&mut random);
        let (m, radius, g) = (scene.mass, scene.radius, scene.gravity);
        let (theta, td) = (random.between(-1.5, 1.5), random.between(-3.0, 3.0));
        let book = Textbook {
            acceleration: vec![0.0, g * theta.sin() / radius],
            force: vec![m * g * theta.cos() - m * radius * td * td],
        };
        check_motion(
            &scene,
            &stuck::<MassOnShell>(),
            &[radius, theta],
            &[0.0, td],
            &book,
        );
    }
}

/// In flight ẍ = 0 and ÿ = −g, written in polar components.
#[test]
fn flies() {
    let mut random = Random::new(3);
    for _ in 0..STATES {
        let scene = scene(&mut random);
        let (r, theta) = (random.between(0.3, 4.0), random.between(-3.0, 3.0));
        let (rd, td) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
        let book = Textbook {
            acceleration: vec![
                r * td * td - scene.gravity * theta.cos(),
                (scene.gravity * theta.sin() - 2.0 * rd * td) / r,
            ],
            force: vec![0.0],
        };
        check_motion(
            &scene,
            &flight::<MassOnShell>(),
            &[r, theta],
            &[rd, td],
            &book,
        );
    }
}
