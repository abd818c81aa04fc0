//! Motions that are known in closed form, as references for [`accuracy`](lagrange_program::accuracy).
//!
//! Each is evaluated for the state and the parameters that a run begins with, as they are in double precision. What
//! grows with time (a mean anomaly, the argument of an elliptic function) is reduced to one period with twice the
//! digits, so that the hundredth period is as exact as the first.

mod double_double;
pub(crate) mod elliptic;
pub(crate) mod orbit;
pub(crate) mod pendulum;
pub(crate) mod slide;
