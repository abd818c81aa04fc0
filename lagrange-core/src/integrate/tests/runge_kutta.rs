//! What the driver of the Runge–Kutta methods promises beside accuracy.

use super::from;
use super::problems::{Falling, Harmonic, Kepler, Problem};
use crate::integrate::{
    Acceleration, Integrator, Method, ParseMethodError, RungeKutta, StepError, StepPolynomial,
    Tolerance,
};

const ADAPTIVE: [Method; 3] = [
    Method::DormandPrince853,
    Method::DormandPrince54,
    Method::Verner98,
];

/// Integrates to `until`; the final state.
pub fn run<P: Problem>(problem: &mut P, method: Method, tolerance: Tolerance, until: f64) -> Run {
    let mut stepper = Integrator::new(method, P::COORDINATES).expect("not the Taylor method");
    let mut step = StepPolynomial::new(P::COORDINATES, stepper.degree());
    let (mut q, mut v) = problem.solution(0.0);
    let mut t = 0.0;
    let mut h = stepper
        .first_step(problem, from(t, &q, &v), until, tolerance)
        .expect("the start is regular");
    let mut run = Run::default();
    while t < until {
        let accepted = stepper
            .step(
                problem,
                from(t, &q, &v),
                h.min(until - t),
                tolerance,
                &mut step,
            )
            .expect("regular");
        run.steps += 1;
        run.rejected += accepted.rejected;
        run.evaluations += accepted.evaluations;
        h = accepted.h_next;
        t = if t + accepted.h >= until {
            until
        } else {
            step.time(1.0)
        };
        step.state_into(1.0, &mut q, &mut v);
    }
    (run.q, run.v) = (q, v);
    run
}

/// Where a run ended and what it cost.
#[derive(Clone, Debug, Default)]
pub struct Run {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub steps: usize,
    pub rejected: usize,
    pub evaluations: usize,
}

impl Run {
    /// Largest difference to a known state.
    pub fn error(&self, solution: (Vec<f64>, Vec<f64>)) -> f64 {
        let pairs = self
            .q
            .iter()
            .zip(&solution.0)
            .chain(self.v.iter().zip(&solution.1));
        pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    }
}

#[test]
fn the_error_follows_the_tolerance() {
    for method in ADAPTIVE {
        for digits in [4, 6, 8, 10, 12] {
            let tolerance = 10f64.powi(-digits);
            let mut oscillator = Harmonic { omega: 1.0 };
            let error = run(&mut oscillator, method, Tolerance::both(tolerance), 10.0)
                .error(oscillator.solution(10.0));
            assert!(
                error < 30.0 * tolerance,
                "{method} at {tolerance:e}: {error:e}"
            );
            // Errors of an orbit grow like the square of the time: 3π · 2π after one turn, and faster near the pericentre.
            let mut orbit = Kepler { eccentricity: 0.5 };
            let turn = core::f64::consts::TAU;
            let error = run(&mut orbit, method, Tolerance::both(tolerance), turn)
                .error(orbit.solution(turn));
            assert!(
                error < 600.0 * tolerance,
                "{method} at {tolerance:e}: {error:e}"
            );
        }
    }
}

#[test]
fn parabolas_are_exact() {
    for method in ADAPTIVE {
        let run = run(&mut Falling, method, Tolerance::both(1e-10), 2.0);
        assert!(run.error(Falling.solution(2.0)) < 1e-13, "{method}");
        assert_eq!(run.rejected, 0);
    }
}

#[test]
fn the_polynomial_ends_where_the_step_ends() {
    for method in ADAPTIVE
        .into_iter()
        .chain([Method::RungeKutta4 { step: 0.3 }])
    {
        let mut orbit = Kepler { eccentricity: 0.3 };
        let mut stepper = RungeKutta::new(method, 2).expect("an explicit method");
        let mut step = StepPolynomial::new(2, 0);
        let (mut q, mut v) = orbit.solution(0.0);
        for i in 0..20 {
            let t = 0.3 * i as f64;
            stepper
                .step(
                    &mut orbit,
                    from(t, &q, &v),
                    0.3,
                    Tolerance::both(1.0),
                    &mut step,
                )
                .expect("regular");
            assert_eq!((step.position(0, 0.0), step.velocity(1, 0.0)), (q[0], v[1]));
            step.state_into(1.0, &mut q, &mut v);
            assert_eq!(stepper.end(), (&q[..], &v[..]));
        }
    }
}

#[test]
fn the_last_stage_is_used_again_only_where_it_belongs() {
    let mut orbit = Kepler { eccentricity: 0.3 };
    let mut stepper = RungeKutta::new(Method::DormandPrince54, 2).expect("an explicit method");
    let mut step = StepPolynomial::new(2, stepper.degree());
    let (mut q, mut v) = orbit.solution(0.0);
    let mut cost = |stepper: &mut RungeKutta<f64>, t, q: &[f64], v: &[f64], step: &mut _| {
        stepper
            .step(&mut orbit, from(t, q, v), 1e-3, Tolerance::both(1.0), step)
            .expect("regular")
            .evaluations
    };
    assert_eq!(cost(&mut stepper, 0.0, &q, &v, &mut step), 7);
    step.state_into(1.0, &mut q, &mut v);
    assert_eq!(cost(&mut stepper, 1e-3, &q, &v, &mut step), 6);
    step.state_into(1.0, &mut q, &mut v);
    // Projection moved the state.
    q[0] += 1e-15;
    assert_eq!(cost(&mut stepper, 2e-3, &q, &v, &mut step), 7);
    step.state_into(1.0, &mut q, &mut v);
    stepper.restart();
    assert_eq!(cost(&mut stepper, 3e-3, &q, &v, &mut step), 7);
}

/// q̈ = 6 q², q = 1/(1 − t)²: infinite at t = 1.
struct BlowUp;

impl Acceleration<f64> for BlowUp {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv[0] = 6.0 * q[0] * q[0];
        Ok(())
    }
}

/// Exists for q < 2 only, which q = t reaches at t = 2.
struct Border;

impl Acceleration<f64> for Border {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv[0] = 0.0;
        if q[0] < 2.0 {
            Ok(())
        } else {
            Err("beyond the border")
        }
    }
}

fn obstacle<A: Acceleration<f64>>(
    system: &mut A,
    method: Method,
    q: f64,
    v: f64,
) -> (f64, StepError<A::Error>) {
    let mut stepper = RungeKutta::new(method, 1).expect("an explicit method");
    let mut step = StepPolynomial::new(1, stepper.degree());
    let (mut t, mut h) = (0.0, 0.1);
    let (mut q, mut v) = ([q], [v]);
    for _ in 0..100_000 {
        match stepper.step(system, from(t, &q, &v), h, Tolerance::both(1e-9), &mut step) {
            Ok(accepted) => {
                (t, h) = (step.time(1.0), accepted.h_next);
                step.state_into(1.0, &mut q, &mut v);
                assert!(q[0].is_finite() && v[0].is_finite());
            }
            Err(error) => return (t, error),
        }
    }
    panic!("{method} goes on for ever at {t}");
}

#[test]
fn a_singularity_is_an_error_with_its_time() {
    for method in ADAPTIVE {
        let (t, error) = obstacle(&mut BlowUp, method, 1.0, 2.0);
        assert!((t - 1.0).abs() < 1e-6, "{method} stops at {t}");
        assert!(
            matches!(error, StepError::TooSmall { time, .. } if time == t),
            "{error:?}"
        );
        assert!(error.to_string().contains("larger tolerance"));
    }
}

#[test]
fn an_error_of_the_system_is_handed_on_where_it_begins() {
    for method in ADAPTIVE {
        let (t, error) = obstacle(&mut Border, method, 0.0, 1.0);
        assert!((t - 2.0).abs() < 1e-12, "{method} stops at {t}");
        assert_eq!(error, StepError::Acceleration("beyond the border"));
    }
}

#[test]
fn methods_have_names() {
    let methods = ADAPTIVE
        .into_iter()
        .chain([Method::Taylor, Method::Radau5])
        .chain([
            Method::RungeKutta4 { step: 0.001 },
            Method::Gauss6 { step: 0.25 },
            Method::Gauss6 { step: 3e-300 },
        ]);
    for method in methods {
        assert_eq!(method.to_string().parse(), Ok(method));
    }
    let short = Method::RungeKutta4 { step: 1e-300 };
    assert_eq!(short.to_string(), "rk4:1e-300");
    let message = |text: &str| text.parse::<Method>().expect_err(text).to_string();
    assert_eq!(
        message("euler"),
        "no method is called `euler`; there are auto, taylor, dop853, dopri5, verner98, radau5, rk4:STEP, gauss6:STEP"
    );
    assert_eq!(
        message("rk4"),
        "`rk4` has fixed steps: give one as rk4:0.001"
    );
    assert_eq!(
        message("rk4:-1"),
        "`-1` is no step size for `rk4`: give a positive number, as rk4:0.001"
    );
    assert_eq!(
        "dop853:1".parse::<Method>(),
        Err(ParseMethodError::NoStep {
            name: "dop853".into()
        })
    );
    assert!(RungeKutta::<f64>::new(Method::Taylor, 1).is_none());
}
