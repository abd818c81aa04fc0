//! The other integrators, behind two functions: integrate to a time, or until an event.

use differential_equations::prelude as de;
use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, VectorCommon};
use ode_solvers::SVector;
use ode_solvers::dop_shared::OutputType;
use std::ops::Range;

/// y′ = f(y), into the second argument.
pub trait Slope<const N: usize>: Fn(&[f64; N], &mut [f64; N]) + Copy {}
impl<const N: usize, F: Fn(&[f64; N], &mut [f64; N]) + Copy> Slope<N> for F {}

/// An integrator and its method.
pub trait Peer: Copy + 'static {
    /// What the table calls it.
    fn name(self) -> &'static str;

    /// The state at the end of a time span.
    fn until<const N: usize>(
        self,
        slope: impl Slope<N>,
        y: [f64; N],
        span: Range<f64>,
        tolerance: f64,
    ) -> Option<[f64; N]>;

    /// Time and state of the first zero of `guard`, which is positive at first.
    fn until_zero<const N: usize>(
        self,
        slope: impl Slope<N>,
        guard: impl Fn(&[f64; N]) -> f64,
        y: [f64; N],
        from: f64,
        tolerance: f64,
    ) -> Option<(f64, [f64; N])>;
}

/// No scene has a mode that lasts longer, s.
const LONGEST: f64 = 20.0;

/// diffsol: Tsitouras 5(4).
#[derive(Clone, Copy)]
pub struct Diffsol;

fn array<const N: usize>(y: &[f64]) -> Option<[f64; N]> {
    y.try_into().ok()
}

impl Peer for Diffsol {
    fn name(self) -> &'static str {
        "diffsol tsit45"
    }

    fn until<const N: usize>(
        self,
        slope: impl Slope<N>,
        y: [f64; N],
        span: Range<f64>,
        tolerance: f64,
    ) -> Option<[f64; N]> {
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .t0(span.start)
            .rtol(tolerance)
            .atol(vec![tolerance; N])
            .rhs(|y: &[f64], _: &[f64], _, d: &mut [f64]| on_slices(slope, y, d))
            .init(
                move |_: &[f64], _, out: &mut [f64]| out.copy_from_slice(&y),
                N,
            )
            .build()
            .ok()?;
        let mut solver = problem.tsit45().ok()?;
        solver.set_stop_time(span.end).ok()?;
        loop {
            if let OdeSolverStopReason::TstopReached = solver.step().ok()? {
                return array(solver.state().y.inner().as_slice());
            }
        }
    }

    fn until_zero<const N: usize>(
        self,
        slope: impl Slope<N>,
        guard: impl Fn(&[f64; N]) -> f64,
        y: [f64; N],
        from: f64,
        tolerance: f64,
    ) -> Option<(f64, [f64; N])> {
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .t0(from)
            .rtol(tolerance)
            .atol(vec![tolerance; N])
            .rhs(|y: &[f64], _: &[f64], _, d: &mut [f64]| on_slices(slope, y, d))
            .init(
                move |_: &[f64], _, out: &mut [f64]| out.copy_from_slice(&y),
                N,
            )
            .root(
                |y: &[f64], _: &[f64], _, out: &mut [f64]| {
                    out[0] = array(y).map_or(f64::NAN, |y| guard(&y));
                },
                1,
            )
            .build()
            .ok()?;
        let mut solver = problem.tsit45().ok()?;
        solver.set_stop_time(from + LONGEST).ok()?;
        loop {
            match solver.step().ok()? {
                OdeSolverStopReason::RootFound(time, _) => {
                    let y = solver.interpolate(time).ok()?;
                    return Some((time, array(y.inner().as_slice())?));
                }
                OdeSolverStopReason::TstopReached => return None,
                _ => {}
            }
        }
    }
}

fn on_slices<const N: usize>(slope: impl Slope<N>, y: &[f64], d: &mut [f64]) {
    if let (Ok(y), Ok(d)) = (y.try_into(), d.try_into()) {
        slope(y, d);
    }
}

/// ode_solvers: Dormand–Prince 8(5,3). It cannot locate events.
#[derive(Clone, Copy)]
pub struct OdeSolvers;

struct Equations<F>(F);

impl<const N: usize, F: Slope<N>> ode_solvers::System<f64, SVector<f64, N>> for Equations<F> {
    fn system(&self, _: f64, y: &SVector<f64, N>, d: &mut SVector<f64, N>) {
        on_slices(self.0, y.as_slice(), d.as_mut_slice());
    }
}

impl Peer for OdeSolvers {
    fn name(self) -> &'static str {
        "ode_solvers dop853"
    }

    fn until<const N: usize>(
        self,
        slope: impl Slope<N>,
        y: [f64; N],
        span: Range<f64>,
        tolerance: f64,
    ) -> Option<[f64; N]> {
        let length = span.end - span.start;
        // Its defaults but for the limits on steps (and its rare test for stiffness, which would end some runs).
        let mut solver = ode_solvers::Dop853::from_param(
            Equations(slope),
            span.start,
            span.end,
            length,
            SVector::<f64, N>::from(y),
            tolerance,
            tolerance,
            0.9,
            0.0,
            0.333,
            6.0,
            length,
            0.0,
            10_000_000,
            1_000_000,
            OutputType::Sparse,
        );
        solver.integrate().ok()?;
        array(solver.y_out().last()?.as_slice())
    }

    fn until_zero<const N: usize>(
        self,
        _: impl Slope<N>,
        _: impl Fn(&[f64; N]) -> f64,
        _: [f64; N],
        _: f64,
        _: f64,
    ) -> Option<(f64, [f64; N])> {
        None
    }
}

/// differential-equations: three explicit methods.
#[derive(Clone, Copy)]
pub enum DifferentialEquations {
    DormandPrince5,
    DormandPrince8,
    Verner9,
}

struct Ode<F>(F);

impl<const N: usize, F: Slope<N>> de::ODE<f64, [f64; N]> for Ode<F> {
    fn diff(&self, _: f64, y: &[f64; N], d: &mut [f64; N]) {
        (self.0)(y, d);
    }
}

struct Zero<G>(G);

impl<const N: usize, G: Fn(&[f64; N]) -> f64> de::Event<f64, [f64; N]> for Zero<G> {
    fn config(&self) -> de::EventConfig {
        de::EventConfig::default().terminal()
    }

    fn event(&self, _: f64, y: &[f64; N]) -> f64 {
        (self.0)(y)
    }
}

/// The three methods have three types.
macro_rules! solve {
    ($method:expr, $tolerance:expr, $problem:expr) => {{
        let (problem, tolerance) = ($problem, $tolerance);
        let solution = match $method {
            DifferentialEquations::DormandPrince5 => problem
                .method(de::ExplicitRungeKutta::dopri5())
                .rtol(tolerance)
                .atol(tolerance)
                .solve(),
            DifferentialEquations::DormandPrince8 => problem
                .method(de::ExplicitRungeKutta::dop853())
                .rtol(tolerance)
                .atol(tolerance)
                .solve(),
            DifferentialEquations::Verner9 => problem
                .method(de::ExplicitRungeKutta::rkv988e())
                .rtol(tolerance)
                .atol(tolerance)
                .solve(),
        };
        let solution = solution.ok()?;
        Some((*solution.t.last()?, *solution.y.last()?))
    }};
}

impl Peer for DifferentialEquations {
    fn name(self) -> &'static str {
        match self {
            Self::DormandPrince5 => "diff.-equations dopri5",
            Self::DormandPrince8 => "diff.-equations dop853",
            Self::Verner9 => "diff.-equations rkv988e",
        }
    }

    fn until<const N: usize>(
        self,
        slope: impl Slope<N>,
        y: [f64; N],
        span: Range<f64>,
        tolerance: f64,
    ) -> Option<[f64; N]> {
        let ode = Ode(slope);
        let problem = de::IVP::ode(&ode, span.start, span.end, y);
        let (time, y) = solve!(self, tolerance, problem)?;
        (time == span.end).then_some(y)
    }

    fn until_zero<const N: usize>(
        self,
        slope: impl Slope<N>,
        guard: impl Fn(&[f64; N]) -> f64,
        y: [f64; N],
        from: f64,
        tolerance: f64,
    ) -> Option<(f64, [f64; N])> {
        let (ode, zero) = (Ode(slope), Zero(guard));
        let problem = de::IVP::ode(&ode, from, from + LONGEST, y).event(&zero);
        solve!(self, tolerance, problem)
    }
}
