//! Halving the step divides the error by 2^order, for the step's result and for the dense output.

use super::from;
use super::problems::{Kepler, Pendulum, Problem};
use crate::integrate::{Method, RungeKutta, StepPolynomial, Tolerance};

/// Every step is accepted, so that its size is the one asked for.
const ANYTHING: Tolerance<'static> = Tolerance::both(1e30);

fn distance(a: &(Vec<f64>, Vec<f64>), b: &(Vec<f64>, Vec<f64>)) -> f64 {
    let pairs = a.0.iter().zip(&b.0).chain(a.1.iter().zip(&b.1));
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// Errors at the end and, where `dense` asks for it, within all steps, of `steps` steps to `until`.
fn errors<P: Problem>(
    mut problem: P,
    method: Method,
    until: f64,
    steps: usize,
    dense: &[f64],
) -> [f64; 2] {
    let mut stepper = RungeKutta::new(method, P::COORDINATES).expect("an explicit method");
    let mut step = StepPolynomial::new(P::COORDINATES, stepper.degree());
    let (mut q, mut v) = problem.solution(0.0);
    let h = until / steps as f64;
    let mut within = 0.0f64;
    for i in 0..steps {
        let t = i as f64 * h;
        let accepted = stepper
            .step(&mut problem, from(t, &q, &v), h, ANYTHING, &mut step)
            .expect("no obstacle");
        // A step is what time advances by.
        assert!((accepted.h - h).abs() <= f64::EPSILON * until);
        for &s in dense {
            let mut inside = (q.clone(), v.clone());
            step.state_into(s, &mut inside.0, &mut inside.1);
            within = within.max(distance(&inside, &problem.solution(t + s * h)));
        }
        step.state_into(1.0, &mut q, &mut v);
    }
    [distance(&(q, v), &problem.solution(until)), within]
}

#[track_caller]
fn check_order(coarse: f64, fine: f64, order: f64) {
    let slope = (coarse / fine).log2();
    // From above the slope may come down to the order, from below it may not stay.
    assert!(
        slope > order - 0.3 && slope < order + 0.8,
        "slope {slope} from {coarse:e} to {fine:e}, not {order}"
    );
}

fn check(method: Method, steps: usize, order: f64) {
    let with = |steps| match method {
        Method::RungeKutta4 { .. } => Method::RungeKutta4 {
            step: 2.0 / steps as f64,
        },
        method => method,
    };
    let orbit = |steps| {
        errors(
            Kepler { eccentricity: 0.2 },
            with(steps),
            2.0,
            steps,
            &[0.1, 0.35, 0.6, 0.85],
        )
    };
    let [coarse, coarse_within] = orbit(steps);
    let [fine, fine_within] = orbit(2 * steps);
    check_order(coarse, fine, order);
    check_order(coarse_within, fine_within, order);

    let start = 1.2;
    let half = 0.5 * Pendulum { start }.period();
    let swing = |steps| {
        let method = match method {
            Method::RungeKutta4 { .. } => Method::RungeKutta4 {
                step: half / steps as f64,
            },
            method => method,
        };
        errors(Pendulum { start }, method, half, steps, &[])[0]
    };
    let (coarse, fine) = (swing(steps), swing(2 * steps));
    let slope = (coarse / fine).log2();
    // Symmetry of a half swing may give an order more.
    assert!(
        slope > order - 0.4,
        "slope {slope} from {coarse:e} to {fine:e}"
    );
}

#[test]
fn dormand_prince_853() {
    check(Method::DormandPrince853, 12, 8.0);
}

#[test]
fn dormand_prince_54() {
    check(Method::DormandPrince54, 30, 5.0);
}

#[test]
fn verner_98() {
    check(Method::Verner98, 8, 9.0);
}

#[test]
fn runge_kutta_4() {
    check(Method::RungeKutta4 { step: 0.0 }, 100, 4.0);
}
