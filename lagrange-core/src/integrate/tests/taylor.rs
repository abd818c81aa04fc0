//! Order, step size and check of the Taylor method, on series made by hand.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::problems::{Coefficients, Falling, Harmonic, Kepler, Pendulum, Problem, series};
use super::runge_kutta::Run;
use crate::integrate::taylor::{Costs, DefectControl, Verdict, defect, order};
use crate::integrate::{StepPolynomial, Tolerance};

/// Of an orbit.
const COSTS: Costs = Costs {
    products: 7,
    coordinates: 2,
    constraints: 0,
};

/// Integrates to `until` with series from the problem.
pub fn run<P: Problem>(problem: &mut P, tolerance: Tolerance, until: f64, h_max: f64) -> Run {
    let order = order(tolerance, COSTS);
    let n = P::COORDINATES;
    let mut step = StepPolynomial::new(n, order);
    let (mut q, mut v) = problem.solution(0.0);
    let mut a = vec![0.0; n];
    let mut t = 0.0;
    let mut run = Run::default();
    while t < until {
        let coefficients = series(problem, t, &q, &v, order);
        run.evaluations += 1;
        let h = coefficients
            .step_size(order, tolerance)
            .expect("finite coefficients");
        let mut h = h.min(h_max).min(until - t);
        let mut check = DefectControl::default();
        loop {
            fill(&mut step, &coefficients, t, h);
            step.state_into(1.0, &mut q, &mut v);
            problem
                .acceleration(t + h, &q, &v, &mut a)
                .expect("regular");
            match check.judge(h, defect(&step, 1.0, &a, tolerance), order, false) {
                Verdict::Accept => break,
                Verdict::Redo { h: smaller } => h = smaller,
            }
            run.rejected += 1;
        }
        run.steps += 1;
        t = if t + h >= until { until } else { t + h };
    }
    (run.q, run.v) = (q, v);
    run
}

fn fill(step: &mut StepPolynomial<f64>, coefficients: &Coefficients, t: f64, h: f64) {
    (step.t, step.h) = (t, h);
    for i in 0..coefficients.q.len() {
        let (q, v) = step.rows_mut(i);
        let mut power = 1.0;
        for k in 0..q.len() {
            q[k] = coefficients.q[i][k] * power;
            v[k] = coefficients.v[i][k] * power;
            power *= h;
        }
    }
}

#[test]
fn the_order_follows_the_digits_and_the_cost_of_a_series() {
    let at = |tolerance, costs| order(Tolerance::both(tolerance), costs);
    let digits = [1e-3, 1e-6, 1e-9, 1e-12, 1e-16];
    assert_eq!(digits.map(|t| at(t, COSTS)), [12, 16, 19, 20, 26]);
    let many = Costs {
        products: 1000,
        ..COSTS
    };
    assert_eq!(digits.map(|t| at(t, many)), [8, 12, 16, 20, 26]);
    // A body in space that rolls without slipping.
    let projected = Costs {
        products: 34,
        coordinates: 6,
        constraints: 3,
    };
    assert_eq!(digits.map(|t| at(t, projected)), [13, 17, 20, 20, 26]);
    assert_eq!([1.0, 100.0, 0.0].map(|t| at(t, COSTS)), [4, 4, 28]);
}

#[test]
fn the_error_follows_the_tolerance() {
    for digits in [3, 5, 7, 9, 11, 13, 15, 16] {
        let tolerance = 10f64.powi(-digits);
        // What rounding does in some ten steps cannot be asked away.
        let rounding = 1e-15;
        let mut oscillator = Harmonic { omega: 1.0 };
        let run_ = run(&mut oscillator, Tolerance::both(tolerance), 10.0, 1e3);
        let error = run_.error(oscillator.solution(10.0));
        assert!(
            error < 3.0 * tolerance + 4.0 * rounding,
            "oscillator at {tolerance:e}: {error:e}"
        );
        let mut orbit = Kepler { eccentricity: 0.5 };
        let run_ = run(&mut orbit, Tolerance::both(tolerance), TAU, 1e3);
        let error = run_.error(orbit.solution(TAU));
        // Errors of an orbit grow like its length times the time.
        assert!(
            error < 60.0 * tolerance + 60.0 * rounding,
            "orbit at {tolerance:e}: {error:e}"
        );
        assert_eq!(run_.rejected, 0, "orbit at {tolerance:e}");
    }
}

#[test]
fn steps_are_not_wasted() {
    // The local error of a step lies within the limit, but not by more than a few orders.
    for digits in [4, 8, 12] {
        let tolerance = Tolerance::both(10f64.powi(-digits));
        let mut orbit = Kepler { eccentricity: 0.5 };
        let order = order(tolerance, COSTS);
        let mut step = StepPolynomial::new(2, order);
        for i in 0..12 {
            let t = 0.5 * f64::from(i);
            let (q, v) = orbit.solution(t);
            let coefficients = series(&orbit, t, &q, &v, order);
            let h = coefficients.step_size(order, tolerance).expect("finite");
            fill(&mut step, &coefficients, t, h);
            let (mut q, mut v) = orbit.solution(t + h);
            let exact = (q.clone(), v.clone());
            step.state_into(1.0, &mut q, &mut v);
            let error = q
                .iter()
                .zip(&exact.0)
                .chain(v.iter().zip(&exact.1))
                .map(|(x, y)| (x - y).abs() / (1.0 + y.abs()));
            let error = error.fold(0.0, f64::max) / tolerance.relative;
            assert!(
                error < 0.5 && error > 1e-5,
                "{digits} digits at {t}: {error:e} of the limit"
            );
            let mut a = vec![0.0; 2];
            use crate::integrate::Acceleration;
            orbit.acceleration(t + h, &q, &v, &mut a).expect("regular");
            let seen = defect(&step, 1.0, &a, tolerance);
            assert!(
                seen < 1.0 && seen > 0.1 * error - 0.01,
                "{digits} digits at {t}: {seen:e} seen of {error:e}"
            );
        }
    }
}

#[test]
fn a_pendulum_from_rest_at_a_right_angle() {
    // q₂, q₆, q₁₀ … are its only coefficients: every order sees the last one or two vanish sooner or later.
    for digits in 3..=16 {
        let tolerance = 10f64.powi(-digits);
        let mut pendulum = Pendulum { start: FRAC_PI_2 };
        let period = pendulum.period();
        let run = run(&mut pendulum, Tolerance::both(tolerance), period, 1e3);
        let error = run.error(pendulum.solution(period));
        assert!(
            error < 60.0 * tolerance + 1e-14,
            "at {tolerance:e}: {error:e}"
        );
        let energy = Pendulum::energy(&run.q, &run.v) - Pendulum::energy(&[FRAC_PI_2], &[0.0]);
        assert!(
            energy.abs() < 10.0 * tolerance + 3e-15,
            "at {tolerance:e}: energy {energy:e}"
        );
    }
}

#[test]
fn symmetric_starts_cost_no_more_than_others() {
    let tolerance = Tolerance::both(1e-12);
    let steps = |start| {
        let mut pendulum = Pendulum { start };
        let period = pendulum.period();
        run(&mut pendulum, tolerance, period, 1e3).steps
    };
    let (right_angle, near) = (steps(FRAC_PI_2), steps(FRAC_PI_2 - 0.01));
    assert!(
        right_angle <= near + 1,
        "{right_angle} steps, nearby {near}"
    );
}

#[test]
fn series_that_end_leave_the_step_to_others() {
    let (q, v) = Falling.solution(0.0);
    let coefficients = series(&Falling, 0.0, &q, &v, 20);
    assert_eq!(
        coefficients.step_size(20, Tolerance::both(1e-16)),
        Some(f64::INFINITY)
    );
    let run = run(&mut Falling, Tolerance::both(1e-12), 2.0, 0.5);
    assert_eq!((run.steps, run.rejected), (4, 0));
    assert!(run.error(Falling.solution(2.0)) < 1e-14);
}

#[test]
fn wide_gaps_are_caught_by_the_defect() {
    // q̈ = −q¹¹ from (0, 1): q₁, q₁₃, q₂₅ …; at order 10 nothing limits the step.
    struct Stiffening;
    let tolerance = Tolerance::both(1e-8);
    let mut step = StepPolynomial::new(1, 10);
    let coefficients = Coefficients {
        q: vec![[0.0, 1.0].into_iter().chain([0.0; 9]).collect()],
        v: vec![[1.0].into_iter().chain([0.0; 10]).collect()],
        more: Vec::new(),
    };
    let _ = Stiffening;
    assert_eq!(coefficients.step_size(10, tolerance), Some(f64::INFINITY));
    let mut check = DefectControl::default();
    let mut h = 2.0;
    let mut tries = 0;
    loop {
        fill(&mut step, &coefficients, 0.0, h);
        let a = -step.position(0, 1.0).powi(11);
        match check.judge(h, defect(&step, 1.0, &[a], tolerance), 10, false) {
            Verdict::Accept => break,
            Verdict::Redo { h: smaller } => h = smaller,
        }
        tries += 1;
    }
    // v = 1 − t¹²/12: the step's true error is within the tolerance now, and not far below.
    let error = h.powi(12) / 12.0;
    assert!(
        error < 2.0 * 2e-8 && error > 1e-11,
        "{error:e} with h = {h}"
    );
    assert!(tries < 6, "{tries}");
}

#[test]
fn coefficients_that_are_not_finite_give_no_step() {
    let mut coefficients = series(&Harmonic { omega: 1.0 }, 0.0, &[1.0], &[0.0], 12);
    coefficients.v[0][11] = f64::NAN;
    assert_eq!(coefficients.step_size(12, Tolerance::both(1e-9)), None);
    coefficients.v[0][11] = f64::INFINITY;
    assert_eq!(coefficients.step_size(12, Tolerance::both(1e-9)), None);
}

#[test]
fn rounding_in_the_accelerations_does_not_shrink_steps_for_ever() {
    let mut check = DefectControl::default();
    assert!(matches!(
        check.judge(0.1, 20.0, 15, false),
        Verdict::Redo { .. }
    ));
    let jumps = check.clone().judge(0.05, 19.0, 15, true);
    assert!(
        matches!(jumps, Verdict::Redo { .. }),
        "a jump is no rounding"
    );
    assert_eq!(check.judge(0.05, 19.0, 15, false), Verdict::Accept);
    assert!(matches!(check.judge(0.1, f64::NAN, 15, false), Verdict::Redo { h } if h < 0.011));
}
