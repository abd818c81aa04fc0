//! Printers of an [`Accuracy`].

pub mod answer;
pub mod csv;
pub mod json;
pub mod plot;
pub mod table;

use crate::accuracy::{Accuracy, Setting};

/// A time with three digits and its unit, `12.3 µs`.
fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let decimals = match value {
        v if v < 9.995 => 2,
        v if v < 99.95 => 1,
        _ => 0,
    };
    format!("{value:.decimals$} {unit}")
}

/// What errors are measured against, in a sentence.
fn reference(accuracy: &Accuracy) -> String {
    let known = &accuracy.reference;
    format!(
        "Reference: {}; {} differs by {:.1e}. Errors below {:.1e} cannot be told apart.",
        known.by, known.checked_by, known.difference, known.floor
    )
}

/// The tolerance, or the fixed step.
fn demand(setting: Setting) -> String {
    match setting.step() {
        None => format!("{:e}", setting.tolerance),
        Some(step) => format!("step {step:e}"),
    }
}
