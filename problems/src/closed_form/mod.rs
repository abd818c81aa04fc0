//! Motions that are known in closed form, as references for [`accuracy`](crate::accuracy).
//!
//! Each is evaluated for the state and the parameters that a run begins with, as they are in double precision. What
//! grows with time (a mean anomaly, the argument of an elliptic function) is reduced to one period with twice the
//! digits, so that the hundredth period is as exact as the first.

// Without the scenes nobody evaluates one.
#![cfg_attr(not(feature = "scenes"), allow(dead_code))]

mod double_double;
pub(crate) mod elliptic;
pub(crate) mod orbit;
pub(crate) mod pendulum;
pub(crate) mod slide;

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
