//! A body on a quaternion: its kinetic energy is singular along the quaternion itself, so that the last pivot of the inertia is
//! what rounding leaves. A certificate has found that a pivot was judged without those before it.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::hard::TumblingBody;
use lagrange_tests::all_agree;

#[test]
fn accelerations_soon_after_the_start() {
    let scene = TumblingBody::default();
    let simulation = Simulation::new(&scene).tolerance(1e-12);
    let run = simulation.run(scene.at(TumblingBody::SPUN), 0.0..0.1);
    let trajectory = run.expect("a run");
    let mut sampler = trajectory.sampler();
    // Pivots that have lost ten digits of sixteen are accepted.
    for k in 1..200 {
        let now = sampler.at(5e-4 * f64::from(k)).expect("an instant");
        let mut solved = trajectory.dynamics();
        solved.set_equations(Equations::Interpreted);
        solved
            .value(now.time, &now.state.q, &now.state.v)
            .expect("accelerations");
        let what = format!("accelerations at t = {}", now.time);
        all_agree(&what, &now.acceleration, solved.acceleration(), 1e-5);
    }
}
