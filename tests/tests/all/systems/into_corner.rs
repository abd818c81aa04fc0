//! What lands with several of its points at one instant, which rounding tells apart.

use super::state;
use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{all_agree, certified, methods_at, run_by};

/// A box that leans against a wall and slides on the floor, pushed: it falls back flat into the corner.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, lean),
    define(
        left = [x - half * cos(lean) + lower * sin(lean), y - half * sin(lean) - lower * cos(lean)],
        right = [x + half * cos(lean) + lower * sin(lean), y + half * sin(lean) - lower * cos(lean)],
        top = [x - half * cos(lean) - lower * sin(lean), y - half * sin(lean) + lower * cos(lean)],
    ),
    kinetic = (der(x)^2 + der(y)^2) / 2 + (half^2 + lower^2) / 6 * der(lean)^2,
    potential = 9.81 * y + 20 * x,
    contact(floor_left: left[1] >= 0, restitution = bounce),
    contact(floor_right: right[1] >= 0, restitution = bounce),
    contact(wall_top: top[0] >= 0, restitution = bounce),
    contact(wall_left: left[0] >= 0, restitution = bounce),
    friction(grip_top on wall_top: slip = der(top[1]), static = mu),
    friction(grip_left on wall_left: slip = der(left[1]), static = mu),
)]
struct Leaning {
    half: f64,
    lower: f64,
    mu: f64,
    bounce: f64,
}

/// The slip on the wall vanishes at the instant at which the other two corners strike, and all rates are reversed: v⁺ = −e v⁻.
#[test]
fn a_box_falls_back_into_its_corner() {
    for (half, lower, mu, bounce, lean) in [
        (1.0, 0.5, 0.2, 0.0, 0.1_f64),
        (0.5, 0.5, 0.3, 0.5, 0.1),
        (1.0, 1.0, 0.4, 0.5, 0.1),
        (0.7, 0.4, 0.25, 0.3, 0.13),
    ] {
        let leaning = Leaning {
            half,
            lower,
            mu,
            bounce,
        };
        let by_default = methods_at([Method::Auto], [1e-6, 1e-9]);
        for (method, tolerance) in by_default.chain([(Method::DormandPrince853, 1e-9)]) {
            let (sin, cos) = lean.sin_cos();
            let start = [half * cos + lower * sin, half * sin + lower * cos, lean];
            let start = state(&start, &[0.0; 3]);
            let run = run_by(&leaning, (method, tolerance), start, 0.5);
            let what = format!("{leaning:?} by {method} at {tolerance}");
            let impacts = run.events().iter();
            let impacts = impacts.filter(|event| event.kind == EventKind::Impact);
            let first = impacts.clone().next().expect("an impact");
            let at_once = impacts.take_while(|event| event.time < first.time + 1e-9);
            let last = at_once.last().expect("an impact");
            assert!(first.state.q[2].abs() < 1e-8, "{what}: lands flat");
            let reversed: Vec<f64> = first.state.v.iter().map(|v| -bounce * v).collect();
            all_agree(&what, &last.state_after.v, &reversed, 1e-4);
        }
    }
}

/// A box with eight corners that tips from its edge and turns and slides meanwhile.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p[3]),
    attitude(body: q),
    define(
        x = [1, 1, 1, 1, -1, -1, -1, -1],
        y = [1, 1, -1, -1, 1, 1, -1, -1],
        z = [1, -1, 1, -1, 1, -1, 1, -1],
        speed = [der(p[0]), der(p[1]), der(p[2])],
        corner[k in 0..8] = (length * x[k] * body.axes[0] + width * y[k] * body.axes[1] + height * z[k] * body.axes[2]) / 2,
        at_corner[k in 0..8] = speed + cross(body.space_rate, corner[k]),
    ),
    kinetic = dot(speed, speed) / 2 + ((width^2 + height^2) * body.body_rate[0]^2 + (length^2 + height^2) * body.body_rate[1]^2
        + (length^2 + width^2) * body.body_rate[2]^2) / 24,
    potential = 9.81 * p[2],
    contact(foot[k in 0..8]: p[2] + corner[k][2] >= 0),
    friction(grip[k in 0..8] on foot[k]: slip = (at_corner[k][0], at_corner[k][1]), static = mu),
    start(on_edge: p = [0, 0, (width * sin(0.1) + height * cos(0.1)) / 2], der(p[0]) = 0.7412501942249211, body.turn = (0.1, 0, 0),
        body.space_rate = (0, 0, 1)),
)]
struct Tipping {
    length: f64,
    width: f64,
    height: f64,
    mu: f64,
}

/// It lands on all four of its feet, none of which is left open by what the run has left of the rates of those that held on. The place of rest was found by
/// another program, which integrates the sliding in the plane with loads linear in the places of the feet.
#[test]
fn a_box_lands_on_all_of_its_feet() {
    let tipping = Tipping {
        length: 0.6308831224375897,
        width: 1.0,
        height: 0.43784269581732027,
        mu: 0.42137449727654896,
    };
    for pair in methods_at(
        [Method::Auto, Method::DormandPrince853, Method::Verner98],
        [1e-9],
    ) {
        let what = format!("by {pair:?}");
        let run = run_by(&tipping, pair, tipping.at(Tipping::ON_EDGE), 0.8);
        certified(&what, &run);
        let q = &run.final_state().q;
        all_agree(&what, &q[..2], &[0.09184675, -0.00041468], 1e-7);
    }
}

/// A foot on a leg that shortens: its speed is the difference of two.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, s),
    kinetic = der(y)^2 / 2 + mass/2 * der(y - s)^2,
    potential = mass * 9.81 * (y - s),
    contact(floor: y - s >= 0, restitution = 0.3),
)]
struct Pogo {
    mass: f64,
}

/// The balance of an impact is measured beside the momenta that cancel in the foot.
#[test]
fn a_foot_bounces_to_rest_below_a_body_that_moves_on() {
    for (mass, speed) in [(0.3, -2.3), (1.7, 5.0), (0.05, -11.0)] {
        let pogo = Pogo { mass };
        for pair in methods_at([Method::Auto, Method::DormandPrince853], [1e-6, 1e-9]) {
            let start = state(&[10.0, 9.6], &[speed, speed]);
            let run = run_by(&pogo, pair, start, 1.0);
            certified(format!("{pogo:?} by {pair:?}"), &run);
        }
    }
}
