//! Every method on the same problems, and against what is known of them.

mod convergence;
mod implicit;
mod long_step;
mod problems;
mod runge_kutta;
mod tableaus;
mod taylor;
mod work;

use super::Start;

/// A step from this state.
fn from<'a>(t: f64, q: &'a [f64], v: &'a [f64]) -> Start<'a, f64> {
    Start { t, q, v }
}
