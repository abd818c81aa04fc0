//! Random runs: whether estimates of errors are right, and whether an error that was asked for is met.
//!
//! The truth is a run of the Taylor method at tolerance 1e-15; how far it can be trusted is told by other tight runs. Where those
//! part, what follows the last digit that they share is not determined by the declaration.

use crate::families::Family;
use crate::fuzz::{Question, Trial};
use lagrange_core::prelude::*;
use lagrange_core::trajectory::Summary;

/// Errors that are asked for.
const ERRORS: [f64; 4] = [1e-4, 1e-6, 1e-9, 1e-11];

/// The truth, and what it is checked by.
const TIGHT: [(Method, f64); 4] = [
    (Method::Taylor, 1e-15),
    (Method::Taylor, 1e-13),
    (Method::Verner98, 1e-13),
    (Method::DormandPrince853, 1e-13),
];

/// A true error this many times larger than what the reference can be trusted to can be told.
const RESOLVED: f64 = 3.0;

/// What an estimate, or an error that was asked for, is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Estimated {
    /// Estimated error and true error.
    Known(f64, f64),
    /// The true error is too small to be told.
    Unresolved,
    /// The estimate says that nothing is known, or the run ends early.
    Refused,
}

/// What is found of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Exactness {
    /// Of the estimate.
    pub estimate: Estimated,
    /// Of `Simulation::error`: the error asked for and the true one.
    pub error: Estimated,
}

/// Asks how exact runs are.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

impl Question for Exact {
    type Answer = Exactness;

    fn ask<F: Family>(trial: &Trial<F>) -> Exactness {
        let run = |simulation: Simulation<'_, F>| {
            let run = simulation.run(trial.start.clone(), 0.0..trial.until);
            run.map(|run| (Summary::of(&run), run.estimate().cloned()))
        };
        let plain = |method, tolerance| run(trial.simulation().method(method).tolerance(tolerance));
        let mut tight = TIGHT
            .into_iter()
            .map(|(method, tolerance)| plain(method, tolerance));
        let truth = tight.next().and_then(Result::ok);
        let checks: Option<Vec<_>> = tight.map(Result::ok).collect();
        let (Some((truth, _)), Some(checks)) = (truth, checks) else {
            return Exactness {
                estimate: Estimated::Unresolved,
                error: Estimated::Unresolved,
            };
        };
        let differences = checks.iter().map(|(check, _)| truth.compare(check).error());
        let floor = differences.fold(f64::EPSILON, f64::max);
        let judged = |found: &Summary, told: f64| {
            let error = found.compare(&truth).error();
            match error > RESOLVED * floor {
                _ if !told.is_finite() => Estimated::Refused,
                true => Estimated::Known(told, error),
                false => Estimated::Unresolved,
            }
        };
        let estimate = match run(trial.simulation().estimate(true)) {
            Ok((found, Some(estimate))) => judged(&found, estimate.difference.error()),
            _ => Estimated::Refused,
        };
        let asked = ERRORS[(trial.until * 1e6) as usize % ERRORS.len()];
        let error = match run(trial.simulation().error(asked)) {
            Ok((found, _)) => judged(&found, asked),
            Err(_) => Estimated::Refused,
        };
        Exactness { estimate, error }
    }
}
