//! Derivatives of states and of the instants of events by parameters and start, through switches and impacts.

mod ball;
mod instants;
mod platform;
mod rest_in_space;
mod shared_loads;
mod switches;

use lagrange_core::Runnable;
use lagrange_core::arithmetic::Dual;
use lagrange_core::prelude::*;
use lagrange_tests::agree;

fn run<S: System<Scalar: Runnable>>(
    scene: &S,
    start: State<S::Scalar>,
    until: f64,
    settings: (f64, Method),
) -> Trajectory<S::Scalar> {
    let simulation = Simulation::new(scene)
        .tolerance(settings.0)
        .method(settings.1);
    match simulation.run(start, 0.0..until) {
        Ok(trajectory) => trajectory,
        Err(failure) => panic!("{failure}"),
    }
}

/// Instants of all events, states after them, final state.
fn all<T: Scalar>(record: &Trajectory<T>) -> Vec<T> {
    let mut list = Vec::new();
    for event in record.events() {
        list.push(event.time);
        list.extend_from_slice(&event.state_after.q);
        list.extend_from_slice(&event.state_after.v);
    }
    list.extend_from_slice(&record.final_state().q);
    list.extend_from_slice(&record.final_state().v);
    list
}

/// Most parameters that derivatives are by.
pub const MOST: usize = 6;

/// A number with its derivatives. For another number of them the whole core would be compiled once more.
pub type Slopes = Dual<f64, MOST>;

fn seeded<const N: usize>(p: [f64; N]) -> [Slopes; N] {
    core::array::from_fn(|i| Dual::variable(p[i], i))
}

/// Equal derivatives.
#[track_caller]
fn same_slopes(what: &str, a: Slopes, b: Slopes, tolerance: f64) {
    for k in 0..MOST {
        agree(what, a.derivative[k], b.derivative[k], tolerance);
    }
}

/// Derivatives against central differences of the fourth order, in steps of `h` times the parameter.
fn compare<const N: usize>(
    p: [f64; N],
    plain: impl Fn([f64; N]) -> Vec<f64>,
    dual: &[Slopes],
    h: f64,
    tolerance: f64,
) {
    let at = plain(p);
    assert_eq!(at.len(), dual.len());
    for (i, (a, b)) in at.iter().zip(dual).enumerate() {
        agree(format!("value {i}"), b.value, *a, 1e-9);
    }
    for k in 0..N {
        let shifted = |by: f64| {
            let mut p = p;
            p[k] *= 1.0 + by;
            plain(p)
        };
        let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(shifted);
        for i in 0..at.len() {
            let slope = (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * h * p[k]);
            agree(
                format!("d out {i} / d parameter {k}"),
                dual[i].derivative[k],
                slope,
                tolerance,
            );
        }
    }
}

const TIGHT: (f64, Method) = (1e-14, Method::Taylor);
const USUAL: (f64, Method) = (1e-9, Method::Taylor);
