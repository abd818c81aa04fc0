//! Running a scene from its declaration.

use lagrange_core::prelude::*;

/// The run from the first start. None if it fails, or has another number of events than `events`.
pub fn run<S: System<Scalar = f64>>(
    scene: &S,
    method: Method,
    tolerance: f64,
    until: f64,
    events: usize,
) -> Option<Trajectory<S>> {
    let n = S::DESCRIPTION.coordinates.len();
    let mut start = State {
        q: vec![0.0; n],
        v: vec![0.0; n],
    };
    scene.start(0, 0.0, &mut start.q, &mut start.v);
    let simulation = Simulation::new(scene).method(method).tolerance(tolerance);
    let trajectory = simulation.run(start, 0.0..until).ok()?;
    (trajectory.events().len() == events).then_some(trajectory)
}

/// Positions, then velocities, at the end of a run without events.
pub fn end<S: System<Scalar = f64>>(
    scene: &S,
    method: Method,
    tolerance: f64,
    until: f64,
) -> Option<Vec<f64>> {
    let trajectory = run(scene, method, tolerance, until, 0)?;
    let end = trajectory.final_state();
    Some([&end.q[..], &end.v].concat())
}
