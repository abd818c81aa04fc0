//! The wheel of `dynamics::tests`, run through all its modes.

use crate::Simulation;
use crate::dynamics::tests::wheel::Wheel;
use crate::trajectory::State;

#[test]
fn the_mass_on_the_wheel_slips_and_leaves_where_the_reference_says() {
    let wheel = Wheel {
        wheel: 1.0,
        inertia: 0.125,
        mass: 0.2,
        radius: 0.5,
        gravity: 9.81,
        mu_static: 0.6,
        mu_kinetic: 0.5,
    };
    let start = State {
        q: vec![0.0, 0.0, 0.5, 0.05],
        v: vec![0.0; 4],
    };
    for tolerance in [1e-6, 1e-9, 1e-12, 1e-15] {
        let run = Simulation::new(&wheel)
            .tolerance(tolerance)
            .run(start.clone(), 0.0..2.9);
        let trajectory = run.unwrap_or_else(|f| panic!("{f} {:?}", f.trajectory.events()));
        for event in trajectory.events() {
            println!("{event} {:?} {:?}", event.state, event.forces);
        }
        println!("{:?} {:?}", trajectory.work(), trajectory.final_state());
    }
}
