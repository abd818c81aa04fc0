//! The methods by name.

use core::fmt;
use core::str::FromStr;

/// A way to integrate.
///
/// All of them locate the same events. Whatever the method, the mode that follows a switch is decided by Taylor series of the
/// candidates, and friction in space begins and comes to rest by Taylor series: a few steps of a method with fixed steps are
/// not of the length asked for there. Where such friction hardly slips the equations are stiff, and steps are many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// Taylor series, and Radau IIA where stability bounds their steps and not accuracy. `auto`
    #[default]
    Auto,
    /// Taylor series of the whole constrained system, order from the tolerance. `taylor`
    Taylor,
    /// Dormand–Prince 8(5,3). `dop853`
    DormandPrince853,
    /// Dormand–Prince 5(4). `dopri5`
    DormandPrince54,
    /// Verner 9(8). `verner98`
    Verner98,
    /// Radau IIA of order 5, implicit, for stiff systems. `radau5`
    Radau5,
    /// The classical method of order 4. `rk4:0.001`
    RungeKutta4 {
        /// Its fixed step.
        step: f64,
    },
    /// The Gauss method of order 6, implicit and symplectic, for long conservative runs. `gauss6:0.001`
    Gauss6 {
        /// Its fixed step.
        step: f64,
    },
}

/// Names of the methods that choose their steps, in the order in which help texts list them.
const NAMES: [(&str, Method); 6] = [
    ("auto", Method::Auto),
    ("taylor", Method::Taylor),
    ("dop853", Method::DormandPrince853),
    ("dopri5", Method::DormandPrince54),
    ("verner98", Method::Verner98),
    ("radau5", Method::Radau5),
];

/// From a step to a method.
type WithStep = fn(f64) -> Method;

/// Names of the methods with fixed steps.
const FIXED: [(&str, WithStep); 2] = [
    ("rk4", |step| Method::RungeKutta4 { step }),
    ("gauss6", |step| Method::Gauss6 { step }),
];

impl Method {
    /// The names that text can begin with.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let fixed = FIXED.iter().map(|(name, _)| *name);
        NAMES.iter().map(|(name, _)| *name).chain(fixed)
    }

    /// Whether its steps are fixed, not chosen by the tolerance.
    pub(crate) fn has_fixed_steps(self) -> bool {
        matches!(self, Self::RungeKutta4 { .. } | Self::Gauss6 { .. })
    }
}

/// `rk4:0.001`, or `rk4:1e-6` where there would be many zeros.
fn with_step(name: &str, step: f64, f: &mut fmt::Formatter) -> fmt::Result {
    match (1e-5..1e5).contains(&step) {
        true => write!(f, "{name}:{step}"),
        false => write!(f, "{name}:{step:e}"),
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::RungeKutta4 { step } => with_step("rk4", *step, f),
            Self::Gauss6 { step } => with_step("gauss6", *step, f),
            Self::Auto => f.write_str("auto"),
            Self::Taylor => f.write_str("taylor"),
            Self::DormandPrince853 => f.write_str("dop853"),
            Self::DormandPrince54 => f.write_str("dopri5"),
            Self::Verner98 => f.write_str("verner98"),
            Self::Radau5 => f.write_str("radau5"),
        }
    }
}

/// A text that names no method.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ParseMethodError {
    /// No method has this name.
    Unknown {
        /// What was given.
        name: String,
    },
    /// A method with fixed steps was named without a positive step.
    Step {
        /// The method.
        name: String,
        /// What was given as its step.
        step: String,
    },
    /// A method that chooses its steps was given one.
    NoStep {
        /// The method.
        name: String,
    },
}

impl fmt::Display for ParseMethodError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unknown { name } => {
                write!(f, "no method is called `{name}`; there are ")?;
                for (name, _) in NAMES {
                    write!(f, "{name}, ")?;
                }
                let [explicit, symplectic] = FIXED.map(|(name, _)| name);
                write!(f, "{explicit}:STEP, {symplectic}:STEP")
            }
            Self::Step { name, step } if step.is_empty() => {
                write!(f, "`{name}` has fixed steps: give one as {name}:0.001")
            }
            Self::Step { name, step } => {
                write!(
                    f,
                    "`{step}` is no step size for `{name}`: give a positive number, as {name}:0.001"
                )
            }
            Self::NoStep { name } => {
                write!(
                    f,
                    "`{name}` chooses its steps by the tolerance: leave out the step size"
                )
            }
        }
    }
}

impl core::error::Error for ParseMethodError {}

impl FromStr for Method {
    type Err = ParseMethodError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, given) = match text.split_once(':') {
            Some((name, step)) => (name, Some(step)),
            None => (text, None),
        };
        if let Some((_, method)) = FIXED.iter().find(|(known, _)| *known == name) {
            let given = given.unwrap_or_default();
            let step = given
                .parse()
                .ok()
                .filter(|step: &f64| *step > 0.0 && step.is_finite());
            return step.map(method).ok_or_else(|| ParseMethodError::Step {
                name: name.into(),
                step: given.into(),
            });
        }
        match NAMES.iter().find(|(known, _)| *known == name) {
            None => Err(ParseMethodError::Unknown { name: name.into() }),
            Some(_) if given.is_some() => Err(ParseMethodError::NoStep { name: name.into() }),
            Some((_, method)) => Ok(*method),
        }
    }
}
