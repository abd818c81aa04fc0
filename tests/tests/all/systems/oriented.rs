//! Bodies that a start turns and spins, beside matrices of rotation.

use lagrange_core::prelude::*;
use lagrange_tests::all_agree;
use nalgebra::{Matrix3, Rotation3, Vector3};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(body: q),
    attitude(other: p),
    kinetic = dot(body.body_rate, body.body_rate)/2 + dot(other.body_rate, other.body_rate)/2,
    start(euler: body.turn = ((0, 0, a[0]), (a[1], 0, 0), (0, 0, a[2])), body.body_rate = rate,
        other.space_rate[1] = rate[1]),
    start(about: body.space_rate = rate, body.turn = a, other.turn = (0, -a[1], 0), other.body_rate[k in 0..2] = rate[k]),
    start(by_hand: q[0] = cos(a[0]/2), q[2] = sin(a[0]/2), body.body_rate = rate),
    observe(x = body.axes[0], y = body.axes[1], z = body.axes[2], body_rate = body.body_rate, space_rate = body.space_rate),
    observe(ox = other.axes[0], oy = other.axes[1], oz = other.axes[2], rate_of_other = other.body_rate),
)]
struct Bodies {
    a: [f64; 3],
    rate: [f64; 3],
}

/// Axes and angular velocities of both bodies at a start.
struct Seen {
    axes: Matrix3<f64>,
    body_rate: [f64; 3],
    space_rate: [f64; 3],
    other: Matrix3<f64>,
    rate_of_other: [f64; 3],
}

fn seen(scene: &Bodies, start: StartId) -> Seen {
    let run = Simulation::new(scene).run(scene.at(start), 0.0..1e-3);
    let run = run.expect("a run");
    let mut sampler = run.sampler();
    let now = sampler.at(0.0).expect("the start");
    Seen {
        axes: Matrix3::from_fn(|j, i| now.observe([Bodies::X, Bodies::Y, Bodies::Z][i][j])),
        body_rate: Bodies::BODY_RATE.map(|k| now.observe(k)),
        space_rate: Bodies::SPACE_RATE.map(|k| now.observe(k)),
        other: Matrix3::from_fn(|j, i| now.observe([Bodies::OX, Bodies::OY, Bodies::OZ][i][j])),
        rate_of_other: Bodies::RATE_OF_OTHER.map(|k| now.observe(k)),
    }
}

fn agree(what: &str, found: &Matrix3<f64>, turn: Rotation3<f64>) {
    all_agree(what, found.as_slice(), turn.matrix().as_slice(), 1e-14);
}

const ANGLES: [[f64; 3]; 5] = [
    [0.4, 1.1, -2.3],
    [-3.0, 0.2, 1e-9],
    [0.0, -2.0, 0.0],
    [1e-12, 2e-12, -1e-12],
    [0.0, 0.0, 0.0],
];

#[test]
fn turns_follow_one_another_about_the_axes_of_the_body() {
    for a in ANGLES {
        let scene = Bodies {
            a,
            rate: [0.7, -1.9, 3.1],
        };
        let seen = seen(&scene, Bodies::EULER);
        let [z, x] = [Vector3::z_axis(), Vector3::x_axis()];
        let turned = [(z, a[0]), (x, a[1]), (z, a[2])];
        let turned = turned.map(|(axis, angle)| Rotation3::from_axis_angle(&axis, angle));
        let turn = turned[0] * turned[1] * turned[2];
        agree("axes", &seen.axes, turn);
        agree(
            "axes of a body that is not turned",
            &seen.other,
            Rotation3::identity(),
        );
        all_agree("rate along the body", &seen.body_rate, &scene.rate, 1e-14);
        let in_space = turn * Vector3::from(scene.rate);
        all_agree(
            "rate in space",
            &seen.space_rate,
            in_space.as_slice(),
            1e-14,
        );
        all_agree(
            "rate by component",
            &seen.rate_of_other,
            &[0.0, -1.9, 0.0],
            1e-14,
        );
    }
}

#[test]
fn a_vector_turns_by_its_length() {
    for a in ANGLES {
        let scene = Bodies {
            a,
            rate: [0.7, -1.9, 3.1],
        };
        let seen = seen(&scene, Bodies::ABOUT);
        let turn = Rotation3::from_scaled_axis(Vector3::from(a));
        agree("axes", &seen.axes, turn);
        all_agree("rate in space", &seen.space_rate, &scene.rate, 1e-14);
        let along = turn.inverse() * Vector3::from(scene.rate);
        all_agree(
            "rate along the body",
            &seen.body_rate,
            along.as_slice(),
            1e-14,
        );
        let other = Rotation3::from_axis_angle(&Vector3::y_axis(), -a[1]);
        agree("axes turned backwards", &seen.other, other);
        all_agree(
            "rates of some components",
            &seen.rate_of_other,
            &[0.7, -1.9, 0.0],
            1e-14,
        );
    }
}

#[test]
fn a_rate_goes_with_coordinates_that_are_given() {
    let a = ANGLES[0];
    let scene = Bodies {
        a,
        rate: [0.7, -1.9, 3.1],
    };
    let seen = seen(&scene, Bodies::BY_HAND);
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), a[0]);
    agree("axes", &seen.axes, turn);
    all_agree("rate along the body", &seen.body_rate, &scene.rate, 1e-14);
}
