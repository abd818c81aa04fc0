//! Why a run failed, as a number that is kept with its results and as a word.

use lagrange_core::prelude::Error;

/// Words for reasons; the number of a reason is its place, from 1.
const REASONS: [&str; 15] = [
    "other",
    "start",
    "projection",
    "singular",
    "not finite",
    "no mode",
    "endless impacts",
    "energy gain",
    "step too small",
    "step too large",
    "no progress",
    "limit",
    "domain",
    "no impact",
    "force without bound",
];

/// The number of a reason; 0 is kept where a run did not fail.
pub(super) fn code(error: &Error) -> f64 {
    let word = match error {
        Error::Start { .. } | Error::Penetrates { .. } => "start",
        Error::Projection { .. } => "projection",
        Error::Singular { .. } => "singular",
        Error::NotFinite { .. } => "not finite",
        Error::NoMode { .. } => "no mode",
        Error::NoImpact { .. } => "no impact",
        Error::EndlessImpacts { .. } => "endless impacts",
        Error::EnergyGain { .. } => "energy gain",
        Error::StepTooSmall { .. } => "step too small",
        Error::StepTooLarge { .. } => "step too large",
        Error::Unbounded { .. } => "force without bound",
        Error::NoProgress { .. } => "no progress",
        Error::Limit { .. } | Error::OutOfReach { .. } => "limit",
        Error::Domain { .. } => "domain",
        _ => "other",
    };
    let place = REASONS.iter().position(|reason| *reason == word);
    place.map_or(1.0, |place| (place + 1) as f64)
}

/// The word for a kept number: `None` if the run did not fail.
pub fn reason(code: f64) -> Option<&'static str> {
    if code == 0.0 {
        return None;
    }
    let reason = REASONS
        .iter()
        .zip(1..)
        .find(|(_, place)| code == f64::from(*place));
    Some(reason.map_or("other", |(reason, _)| reason))
}
