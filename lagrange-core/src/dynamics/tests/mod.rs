//! Values against matrices written by hand, series against values along them.

mod pendulum;
mod rank;
pub(crate) mod wheel;

use super::*;
use crate::arithmetic::Scalar;
use crate::mode::{FrictionMode, Sliding};
use nalgebra::{DMatrix, DVector};
use wheel::{GRIP, RIM, ROLLING, WHEEL, Wheel};

const Q: [f64; 4] = [0.3, 0.2, 1.1, 0.6];
const V: [f64; 4] = [0.55, 0.5, 0.0, 0.7];

fn mode(closed: bool, friction: FrictionMode) -> Mode {
    Mode {
        contacts: vec![closed],
        frictions: vec![friction],
        branches: vec![],
    }
}

fn modes() -> [Mode; 4] {
    [
        mode(false, FrictionMode::Inactive),
        mode(true, FrictionMode::Stick),
        mode(true, FrictionMode::Slip(Sliding::sign(1.0))),
        mode(true, FrictionMode::Slip(Sliding::sign(-1.0))),
    ]
}

/// Every mode by the emitted functions and by the interpreter.
fn in_both_ways() -> impl Iterator<Item = (Mode, Equations)> {
    let ways = [Equations::Emitted, Equations::Interpreted];
    modes()
        .into_iter()
        .flat_map(move |mode| ways.map(|equations| (mode.clone(), equations)))
}

/// The equations as one dense system, written by hand.
fn by_hand(mode: &Mode, t: f64, q: &[f64], v: &[f64]) -> ([f64; 4], [f64; 3]) {
    let w = Wheel::<f64>::example();
    let (r, (s, c)) = (q[2], q[3].sin_cos());
    let (vr, vth, m, g) = (v[2], v[3], w.mass, w.gravity);
    let mut mass = DMatrix::zeros(4, 4);
    mass.copy_from_slice(&[
        w.wheel + m,
        0.0,
        m * s,
        m * r * c,
        0.0,
        w.inertia,
        0.0,
        0.0,
        m * s,
        0.0,
        m,
        0.0,
        m * r * c,
        0.0,
        0.0,
        m * r * r,
    ]);
    let f = [
        m * (r * vth * vth * s - 2.0 * vr * vth * c),
        0.3 * t,
        m * (r * vth * vth - g * c),
        m * r * (g * s - 2.0 * vr * vth),
    ];
    let rows = [
        [1.0, -w.radius, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -w.radius, 0.0, w.radius],
    ];
    let mut columns = rows;
    let mut acting = vec![ROLLING];
    let mut slide = 0.0;
    if mode.contacts[0] {
        acting.push(RIM);
    }
    match mode.frictions[0] {
        FrictionMode::Stick => acting.push(GRIP),
        FrictionMode::Slip(Sliding {
            direction: crate::mode::Direction::Fixed(d),
            ..
        }) => {
            slide = -w.mu_kinetic * d[0];
            for j in 0..4 {
                columns[RIM][j] += slide * rows[GRIP][j];
            }
        }
        _ => {}
    }
    let size = 4 + acting.len();
    let mut k = DMatrix::zeros(size, size);
    k.view_mut((0, 0), (4, 4)).copy_from(&mass);
    let mut b = DVector::zeros(size);
    b.rows_mut(0, 4).copy_from_slice(&f);
    for (i, &row) in acting.iter().enumerate() {
        for j in 0..4 {
            k[(4 + i, j)] = rows[row][j];
            k[(j, 4 + i)] = -columns[row][j];
        }
    }
    let x = k.lu().solve(&b).expect("regular");
    let mut force = [0.0; 3];
    for (i, &row) in acting.iter().enumerate() {
        force[row] = x[4 + i];
    }
    if slide != 0.0 {
        force[GRIP] = slide * force[RIM];
    }
    ([x[0], x[1], x[2], x[3]], force)
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * (1.0 + expected.abs()),
        "{found:e} is not {expected:e}"
    );
}

#[test]
fn values_agree_with_a_dense_solution() {
    let mut dynamics = Dynamics::new(&Wheel::<f64>::example(), &Effects::all());
    for (mode, equations) in in_both_ways() {
        dynamics.set_equations(equations);
        dynamics.set_mode(&mode);
        dynamics.value(0.4, &Q, &V).expect("regular");
        let (acceleration, force) = by_hand(&mode, 0.4, &Q, &V);
        for (&found, expected) in dynamics.acceleration().iter().zip(acceleration) {
            close(found, expected, 1e-14);
        }
        for (row, expected) in force.into_iter().enumerate() {
            close(dynamics.force(row), expected, 1e-14);
        }
    }
}

/// Series from (Q, v) at t = 0.4 against values along them.
fn follow(dynamics: &mut Dynamics<f64>, v: [f64; 4]) {
    dynamics.series(0.4, &Q, &v, 20).expect("analytic");
    let along = dynamics.clone();
    let at = |series: &[f64], tau: f64| series.iter().rev().fold(0.0, |sum, c| sum * tau + c);
    for tau in [0.0, 0.01, 0.05] {
        let q = [0, 1, 2, 3].map(|i| at(along.position_series(i), tau));
        let v = [0, 1, 2, 3].map(|i| at(along.velocity_series(i), tau));
        dynamics.value(0.4 + tau, &q, &v).expect("regular");
        dynamics.report_value();
        for (i, &acceleration) in dynamics.acceleration().iter().enumerate() {
            close(at(&along.acceleration_series(i), tau), acceleration, 1e-13);
        }
        for row in 0..3 {
            close(at(along.force_series(row), tau), dynamics.force(row), 1e-13);
        }
        let gap = WHEEL.rows[RIM].position.expect("a gap");
        for place in [WHEEL.rows[GRIP].velocity, WHEEL.rows[RIM].velocity, gap] {
            close(
                at(along.motion_series(place), tau),
                dynamics.motion(place),
                1e-13,
            );
        }
        // Emitted functions give series of what guards read, and no more.
        let outputs = [WHEEL.observes[0].place, WHEEL.energy.jacobi];
        for place in outputs.into_iter().filter(|_| along.in_use().is_none()) {
            close(
                at(along.report_series(place), tau),
                dynamics.report(place),
                1e-13,
            );
        }
    }
}

#[test]
fn series_follow_the_motion() {
    let mut dynamics = Dynamics::new(&Wheel::<f64>::example(), &Effects::all());
    let mut report = OutputMask::new(WHEEL);
    report.insert(WHEEL.observes[0].need);
    report.insert(WHEEL.energy.need);
    dynamics.set_report_needs(&report);
    let mut needs = OutputMask::new(WHEEL);
    for row in WHEEL.rows {
        needs.insert(row.needs.position);
        needs.insert(row.needs.velocity);
    }
    dynamics.set_extra_needs(&needs);
    // With a closed rim r̈ = 0: at rest r is constant, else it drifts, and it must be constant again.
    let drifting = [0.55, 0.5, 0.1, 0.7];
    for (mode, equations) in in_both_ways() {
        dynamics.set_equations(equations);
        dynamics.set_mode(&mode);
        for v in [V, drifting, V] {
            follow(&mut dynamics, v);
        }
    }
}

#[test]
fn needs_asked_for_later_are_met() {
    let mut dynamics = Dynamics::new(&Wheel::<f64>::example(), &Effects::all());
    dynamics.series(0.4, &Q, &V, 8).expect("analytic");
    let slip = &WHEEL.rows[GRIP];
    let mut needs = OutputMask::new(WHEEL);
    needs.insert(slip.needs.velocity);
    dynamics.set_extra_needs(&needs);
    dynamics.series(0.4, &Q, &V, 8).expect("analytic");
    let expected: Vec<f64> = {
        let (turn, roll) = (dynamics.velocity_series(3), dynamics.velocity_series(1));
        turn.iter().zip(roll).map(|(a, b)| 1.1 * (a - b)).collect()
    };
    for (&found, expected) in dynamics.motion_series(slip.velocity).iter().zip(expected) {
        close(found, expected, 1e-15);
    }
}

#[test]
fn jacobians_agree_with_differences() {
    let mut dynamics = Dynamics::new(&Wheel::<f64>::example(), &Effects::all());
    for mode in modes() {
        dynamics.set_mode(&mode);
        let mut columns = [0.0; 32];
        dynamics
            .jacobian(0.4, &Q, &V, &mut columns)
            .expect("regular");
        for column in 0..8 {
            let mut at = |h: f64| {
                let mut x = [Q, V];
                x[column / 4][column % 4] += h;
                dynamics.value(0.4, &x[0], &x[1]).expect("regular");
                dynamics.acceleration().to_vec()
            };
            // Central differences of fourth order.
            let h = 1e-3;
            let [two_back, back, forth, two_forth] = [-2.0, -1.0, 1.0, 2.0].map(|m| at(m * h));
            for i in 0..4 {
                let expected =
                    (8.0 * (forth[i] - back[i]) - (two_forth[i] - two_back[i])) / (12.0 * h);
                close(columns[column * 4 + i], expected, 1e-9);
            }
        }
    }
}

#[test]
fn sensitivities_come_from_jets_over_dual_numbers() {
    use crate::arithmetic::Dual;
    type D = Dual<f64, 1>;
    let with = |mass: D| Wheel {
        mass,
        ..Wheel::<D>::example()
    };
    let lift = |q: [D; 4], scene: &Wheel<D>| {
        let mut dynamics = Dynamics::new(scene, &Effects::all());
        dynamics.set_mode(&modes()[2]);
        dynamics
            .series(D::from_f64(0.4), &q, &V.map(D::from_f64), 5)
            .expect("analytic");
        dynamics.force_series(RIM)[5]
    };
    let q = Q.map(D::from_f64);
    let exact = lift(q, &with(D::variable(0.7, 0))).derivative[0];
    let h = 1e-5;
    let difference =
        lift(q, &with(D::from_f64(0.7 + h))).value - lift(q, &with(D::from_f64(0.7 - h))).value;
    close(exact, difference / (2.0 * h), 1e-8);
}
