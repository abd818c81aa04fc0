//! Radau IIA on stiff and other problems; Gauss on long conservative runs.

use core::f64::consts::TAU;

use super::from;
use super::problems::{Coefficients, Kepler, Pendulum, Problem, Prothero, convolve};
use super::runge_kutta::run;
use crate::integrate::{
    Acceleration, Gauss, Integrator, Method, Radau, StepError, StepPolynomial, Tolerance,
};

#[test]
fn stiffness_costs_radau_nothing() {
    let tolerance = Tolerance::both(1e-7);
    let evaluations = [1e2, 1e4, 1e6, 1e8].map(|stiffness| {
        let mut problem = Prothero { stiffness };
        let run = run(&mut problem, Method::Radau5, tolerance, 10.0);
        let error = run.error(problem.solution(10.0));
        assert!(error < 1e-5, "{error:e} at stiffness {stiffness:e}");
        run.evaluations
    });
    assert!(evaluations.iter().all(|n| *n < 2500), "{evaluations:?}");
    let explicit = run(
        &mut Prothero { stiffness: 1e6 },
        Method::DormandPrince54,
        tolerance,
        10.0,
    );
    assert!(explicit.evaluations > 10 * evaluations[2]);
}

#[test]
fn radau_follows_the_tolerance() {
    for digits in [4, 6, 8, 10] {
        let tolerance = 10f64.powi(-digits);
        let mut orbit = Kepler { eccentricity: 0.5 };
        let error = run(&mut orbit, Method::Radau5, Tolerance::both(tolerance), TAU)
            .error(orbit.solution(TAU));
        assert!(error < 300.0 * tolerance, "{error:e} at {tolerance:e}");
    }
}

#[test]
fn radau_has_order_five() {
    let until = 0.5 * Pendulum { start: 1.2 }.period();
    let at = |tolerance| {
        let mut pendulum = Pendulum { start: 1.2 };
        let run = run(
            &mut pendulum,
            Method::Radau5,
            Tolerance::both(tolerance),
            until,
        );
        (run.steps as f64, run.error(pendulum.solution(until)))
    };
    let ((few, coarse), (many, fine)) = (at(1e-5), at(1e-8));
    let order = (coarse / fine).ln() / (many / few).ln();
    assert!(
        order > 4.5,
        "order {order}: {coarse:e} in {few}, {fine:e} in {many} steps"
    );
}

/// ÿ = 6, ẍ = y³ from rest in 0: y = 3t², x = 27/56 t⁸.
///
/// Extrapolated stages of y are exact, and those of x after one correction: then an iteration seems to converge without end.
struct Chain;

impl Acceleration<f64> for Chain {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv.copy_from_slice(&[q[1].powi(3), 6.0]);
        Ok(())
    }
}

impl Problem for Chain {
    const COORDINATES: usize = 2;

    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let x = 27.0 / 56.0 * t.powi(8);
        let rate = 27.0 / 7.0 * t.powi(7);
        (vec![x, 3.0 * t * t], vec![rate, 6.0 * t])
    }

    fn acceleration_series(&self, _: f64, series: &mut Coefficients, k: usize) -> Vec<f64> {
        let y = &series.q[1];
        let square: Vec<f64> = (0..=k).map(|j| convolve(y, y, j)).collect();
        vec![convolve(&square, y, k), if k == 0 { 6.0 } else { 0.0 }]
    }
}

#[test]
fn repeated_steps_of_radau_are_as_good_as_others() {
    let mut rejected = 0;
    for digits in 4..=11 {
        let tolerance = 10f64.powi(-digits);
        let run = run(&mut Chain, Method::Radau5, Tolerance::both(tolerance), 1.5);
        let error = run.error(Chain.solution(1.5));
        assert!(error < tolerance, "{error:e} at {tolerance:e}");
        rejected += run.rejected;
    }
    assert!(rejected > 0);
}

/// The oscillator of Prothero and Robinson with its exact Jacobian.
struct Exact(Prothero);

impl Acceleration<f64> for Exact {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        self.0.acceleration(t, q, v, dv)
    }

    fn jacobian(
        &mut self,
        _: f64,
        _: &[f64],
        _: &[f64],
        by_position: &mut [f64],
        by_velocity: &mut [f64],
    ) -> Result<bool, Self::Error> {
        by_position[0] = -self.0.stiffness;
        by_velocity[0] = -2.0 * self.0.stiffness.sqrt();
        Ok(true)
    }
}

#[test]
fn a_jacobian_of_the_system_saves_the_differences() {
    let step = |system: &mut dyn FnMut(&mut Radau<f64>, &mut StepPolynomial<f64>) -> usize| {
        let mut radau = Radau::new(1);
        let mut out = StepPolynomial::new(1, Radau::<f64>::DEGREE);
        system(&mut radau, &mut out)
    };
    let tolerance = Tolerance::both(1e-6);
    let stiffness = 1e6;
    let by_differences = step(&mut |radau, out| {
        let mut system = Prothero { stiffness };
        let accepted = radau.step(&mut system, from(0.0, &[1.0], &[0.0]), 0.01, tolerance, out);
        accepted.expect("regular").evaluations
    });
    let exact = step(&mut |radau, out| {
        let mut system = Exact(Prothero { stiffness });
        let accepted = radau.step(&mut system, from(0.0, &[1.0], &[0.0]), 0.01, tolerance, out);
        accepted.expect("regular").evaluations
    });
    assert_eq!(exact + 2, by_differences);
}

#[test]
fn gauss_has_order_six() {
    let error = |steps: f64| {
        let mut orbit = Kepler { eccentricity: 0.2 };
        let method = Method::Gauss6 { step: TAU / steps };
        run(&mut orbit, method, Tolerance::both(1.0), TAU).error(orbit.solution(TAU))
    };
    let slope = (error(40.0) / error(80.0)).log2();
    assert!((slope - 6.0).abs() < 0.3, "slope {slope}");
}

#[test]
fn gauss_keeps_the_energy() {
    let mut orbit = Kepler { eccentricity: 0.5 };
    let mut gauss = Gauss::new(TAU / 100.0, 2);
    let mut out = StepPolynomial::new(2, Gauss::<f64>::DEGREE);
    let (mut q, mut v) = orbit.solution(0.0);
    let mut t = 0.0;
    let mut largest = [0.0f64; 10];
    for turn in 0..1000 {
        for _ in 0..100 {
            gauss
                .step(&mut orbit, from(t, &q, &v), 1.0, &mut out)
                .expect("regular");
            t = out.time(1.0);
            out.state_into(1.0, &mut q, &mut v);
            let error = (Kepler::energy(&q, &v) + 0.5).abs();
            largest[turn / 100] = largest[turn / 100].max(error);
        }
    }
    // The error oscillates with each turn and does not grow over a thousand.
    assert!(largest[0] < 1e-6, "{largest:?}");
    assert!(largest[9] < 1.01 * largest[0], "{largest:?}");
}

#[test]
fn gauss_with_tiny_steps_is_exact_to_rounding() {
    let mut pendulum = Pendulum { start: 1.0 };
    let period = pendulum.period();
    let mut gauss = Gauss::new(period / 1000.0, 1);
    let mut out = StepPolynomial::new(1, Gauss::<f64>::DEGREE);
    let (mut q, mut v) = pendulum.solution(0.0);
    let mut t = 0.0;
    for _ in 0..10_000 {
        gauss
            .step(&mut pendulum, from(t, &q, &v), 1.0, &mut out)
            .expect("regular");
        t = out.time(1.0);
        out.state_into(1.0, &mut q, &mut v);
    }
    // Compensated summation leaves the rounding of the accelerations.
    let error = (q[0] - pendulum.start).abs().max(v[0].abs());
    assert!(error < 1e-13, "{error:e}");
}

#[test]
fn too_large_steps_do_not_converge() {
    let mut stiff = Prothero { stiffness: 1e6 };
    let mut gauss =
        Integrator::new(Method::Gauss6 { step: 0.1 }, 1).expect("not the Taylor method");
    let mut out = StepPolynomial::new(1, gauss.degree());
    let outcome = gauss.step(
        &mut stiff,
        from(0.0, &[1.1], &[0.0]),
        1.0,
        Tolerance::both(1.0),
        &mut out,
    );
    assert_eq!(outcome, Err(StepError::NoConvergence { time: 0.0, h: 0.1 }));
}
