//! Methods as a study takes them, and the settings that follow: a tolerance each, or a step for methods without.

use crate::names::method_meant;
use crate::request::Request;
use core::fmt;
use core::str::FromStr;
use lagrange_core::error::Shortest;
use lagrange_core::integrate::ParseMethodError;
use lagrange_core::prelude::Method;

/// A method, for a study at several tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Family {
    /// A method as it is: one that heeds the tolerance, or one with a step of the user's.
    Method(Method),
    /// The classical Runge–Kutta method, its step chosen from the tolerance. `rk4`
    RungeKutta4,
    /// The Gauss method of order 6, its step chosen from the tolerance. `gauss6`
    Gauss6,
}

/// A text that names no method.
pub type ParseFamilyError = ParseMethodError;

impl Family {
    /// Every method, first what a run uses unless asked otherwise.
    pub const ALL: [Family; 8] = [
        Family::Method(Method::Auto),
        Family::Method(Method::Taylor),
        Family::Method(Method::DormandPrince853),
        Family::Method(Method::DormandPrince54),
        Family::Method(Method::Verner98),
        Family::Method(Method::Radau5),
        Family::RungeKutta4,
        Family::Gauss6,
    ];

    /// The method at a tolerance, in a motion with a time scale of `scale` seconds.
    ///
    /// Methods with fixed steps get h = τ ε^(1/p), p the order: then an error of the order of ε can be hoped for.
    fn at(self, tolerance: f64, scale: f64) -> Method {
        let step = |order: i32| round(scale * tolerance.powf(1.0 / f64::from(order)));
        match self {
            Family::Method(method) => method,
            Family::RungeKutta4 => Method::RungeKutta4 { step: step(4) },
            Family::Gauss6 => Method::Gauss6 { step: step(6) },
        }
    }
}

/// Three digits, so that a printed step is the step.
fn round(step: f64) -> f64 {
    format!("{step:.2e}").parse().unwrap_or(step)
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Family::Method(method) => method.fmt(f),
            Family::RungeKutta4 => f.write_str("rk4"),
            Family::Gauss6 => f.write_str("gauss6"),
        }
    }
}

impl FromStr for Family {
    type Err = ParseFamilyError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "rk4" => Ok(Family::RungeKutta4),
            "gauss6" => Ok(Family::Gauss6),
            other => other.parse().map(Family::Method),
        }
    }
}

/// A method and its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The method, with its step if it has fixed ones.
    pub method: Method,
    /// Tolerance; with fixed steps, which do not follow it, that of a run of which nothing else is asked: constraints are kept to it.
    pub tolerance: f64,
}

impl Setting {
    /// Name of the method, without a step.
    pub fn name(&self) -> &'static str {
        match self.method {
            Method::Auto => "auto",
            Method::Taylor => "taylor",
            Method::DormandPrince853 => "dop853",
            Method::DormandPrince54 => "dopri5",
            Method::Verner98 => "verner98",
            Method::Radau5 => "radau5",
            Method::RungeKutta4 { .. } => "rk4",
            Method::Gauss6 { .. } => "gauss6",
            _ => "another",
        }
    }

    /// The fixed step, if the method has one, s.
    pub fn step(&self) -> Option<f64> {
        match self.method {
            Method::RungeKutta4 { step } | Method::Gauss6 { step } => Some(step),
            _ => None,
        }
    }
}

/// `taylor at 1e-9`, `rk4 with steps of 0.001 s`
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.step() {
            None => write!(f, "{} at {:e}", self.name(), self.tolerance),
            Some(step) => write!(f, "{} with steps of {} s", self.name(), Shortest(step)),
        }
    }
}

/// Every method at every tolerance; a method with a step of its own once, and nothing twice.
pub(super) fn settings(methods: &[Family], tolerances: &[f64], scale: f64) -> Vec<Setting> {
    let mut settings: Vec<Setting> = Vec::new();
    for family in methods {
        for &tolerance in tolerances {
            let mut setting = Setting {
                method: family.at(tolerance, scale),
                tolerance,
            };
            if setting.step().is_some() {
                setting.tolerance = Request::default().tolerance;
            }
            if !settings.contains(&setting) {
                settings.push(setting);
            }
        }
    }
    settings
}

/// The method called `name` for a study at several tolerances.
///
/// # Errors
/// What is wrong with the name, with the nearest one that is known.
pub fn family(name: &str) -> Result<Family, String> {
    let known = Family::ALL.map(|family| family.to_string());
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    name.parse()
        .map_err(|error| method_meant(name, &error, &known))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::Request;

    #[test]
    fn tolerances_and_steps() {
        let methods =
            ["taylor", "rk4", "rk4:0.01", "taylor"].map(|name| name.parse().expect("a method"));
        let found: Vec<String> = settings(&methods, &[1e-4, 1e-8], 2.0)
            .iter()
            .map(Setting::to_string)
            .collect();
        let wanted = [
            "taylor at 1e-4",
            "taylor at 1e-8",
            "rk4 with steps of 0.2 s",
            "rk4 with steps of 0.02 s",
            "rk4 with steps of 0.01 s",
        ];
        assert_eq!(found, wanted);
        // As in a run that is given the step alone.
        let alone = settings(&methods[2..3], &[1e-3], 2.0)[0].tolerance;
        assert_eq!(alone, Request::default().tolerance);
        for family in Family::ALL {
            assert_eq!(family.to_string().parse(), Ok(family));
        }
    }

    #[test]
    fn what_a_run_uses_by_default_is_measured_first() {
        assert_eq!(Family::ALL[0], Family::Method(Request::default().method));
    }
}
