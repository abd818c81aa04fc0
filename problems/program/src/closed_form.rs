//! What is known of a motion in closed form, as a reference for [`accuracy`](crate::accuracy).

use lagrange_core::prelude::State;

/// Where a motion ends, and what happens on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedForm {
    /// By what it is known, in a few words.
    pub by: &'static str,
    /// Events in order of time: item and kind as in the event log (`rim lost`), time in s.
    pub events: Vec<(&'static str, f64)>,
    /// Time of the end, s.
    pub time: f64,
    /// State at the end.
    pub state: State<f64>,
    /// Bound of what rounding does to these numbers, each relative to its size where that is above 1.
    pub rounding: f64,
}
