//! A run seen and stopped from another thread ends where it is, with the same motion until then.

use lagrange_core::Monitor;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::hard::LongPendulum;
use std::thread;

fn start(pendulum: &LongPendulum) -> State<f64> {
    let n = <LongPendulum>::DESCRIPTION.coordinates.len();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    pendulum.start(0, 0.0, &mut q, &mut v);
    State::new(q, v)
}

#[test]
fn a_stopped_run_keeps_the_motion_until_then() {
    let pendulum = LongPendulum::default();
    let monitor = Monitor::default();
    let simulation = Simulation::new(&pendulum);
    let stopped = thread::scope(|scope| {
        let watched = monitor.clone();
        scope.spawn(move || {
            while watched.time() < 10.0 {
                thread::yield_now();
            }
            watched.stop();
        });
        let watched = simulation.clone().monitor(&monitor);
        watched.run(start(&pendulum), 0.0..1e9)
    });
    let failure = stopped.expect_err("it was stopped");
    let Error::Interrupted { time } = failure.error else {
        panic!("{}", failure.error);
    };
    assert!((10.0..1e9).contains(&time) && monitor.time() == time);
    assert_eq!(failure.trajectory.last_time(), time);
    let whole = simulation.run(start(&pendulum), 0.0..12.0).expect("a run");
    let (mut some, mut all) = (failure.trajectory.sampler(), whole.sampler());
    let at = |sampler: &mut Sampler<f64>| sampler.at(9.0).expect("an instant").state.q;
    assert_eq!(at(&mut some), at(&mut all));
}

#[test]
fn what_is_stopped_does_not_begin() {
    let pendulum = LongPendulum::default();
    let monitor = Monitor::default();
    monitor.stop();
    let run = Simulation::new(&pendulum).monitor(&monitor);
    let failure = run.run(start(&pendulum), 0.0..1.0).expect_err("stopped");
    assert_eq!(failure.error, Error::Interrupted { time: 0.0 });
}

#[test]
fn a_run_that_has_ended_has_come_to_its_end() {
    let pendulum = LongPendulum::default();
    let monitor = Monitor::default();
    let simulation = Simulation::new(&pendulum).monitor(&monitor);
    for until in [3.0, 1.7] {
        let run = simulation.run(start(&pendulum), 0.0..until);
        run.expect("a run");
        assert_eq!(monitor.time(), until);
    }
}
