//! Running a scene from its declaration.

use crate::scenes::Scene;
use lagrange_core::prelude::*;

/// A way to run the scene from its first start again and again, without a record of the motion in between: what is
/// made ready once per mode is kept, as the others keep their compiled equations.
pub fn runs<S: Scene>(method: Method, tolerance: f64) -> impl FnMut() -> Option<Vec<f64>> {
    let scene = S::Declared::default();
    let n = scene.description().coordinates.len();
    let mut start = State::new(vec![0.0; n], vec![0.0; n]);
    scene.start(0, 0.0, &mut start.q, &mut start.v);
    let simulation = Simulation::new(&scene).method(method).tolerance(tolerance);
    let mut runner = simulation.record(false).runner();
    move || S::seen(runner.run(&start, 0.0..S::UNTIL).ok()?)
}
