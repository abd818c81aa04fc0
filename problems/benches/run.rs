//! What running costs: one right-hand side in each mode that a scene goes through, and the whole run.
//!
//! `right-hand side/<scene>/<mode>` is one evaluation of accelerations and forces; `run/<scene>/<tolerance>` the run
//! from the scene's first start to its end, with everything that it records.

use criterion::{BenchmarkId, Criterion};
use lagrange_core::dynamics::Dynamics;
use lagrange_core::mode::Mode;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;
use std::hint::black_box;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    scene::<MassOnShell>(&mut criterion, "mass-on-shell");
    scene::<RollingSphere>(&mut criterion, "rolling-sphere");
    scene::<RollingSlippingSphere>(&mut criterion, "rolling-slipping-sphere");
    scene::<MassOnWheel>(&mut criterion, "mass-on-wheel");
    scene::<SphereInBowl>(&mut criterion, "sphere-in-bowl");
    criterion.final_summary();
}

fn scene<S: System<Scalar = f64> + Default>(criterion: &mut Criterion, name: &str) {
    let system = S::default();
    let n = S::DESCRIPTION.coordinates.len();
    let mut start = State {
        q: vec![0.0; n],
        v: vec![0.0; n],
    };
    system.start(0, 0.0, &mut start.q, &mut start.v);

    let mut group = criterion.benchmark_group("right-hand side");
    for (mode, time, state) in modes(&system, &start) {
        let id = BenchmarkId::new(name, mode.display(S::DESCRIPTION));
        let mut dynamics = Dynamics::new(&system, &Effects::all());
        dynamics.set_mode(&mode);
        group.bench_function(id, |bench| {
            bench.iter(|| {
                let (q, v) = (black_box(&state.q), black_box(&state.v));
                let done = dynamics.value(time, q, v).is_ok();
                black_box(dynamics.acceleration());
                done
            });
        });
    }
    group.finish();

    let mut group = criterion.benchmark_group("run");
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let simulation = Simulation::new(&system).tolerance(tolerance);
        group.bench_function(BenchmarkId::new(name, format!("{tolerance:e}")), |bench| {
            bench.iter(|| simulation.run(start.clone(), 0.0..10.0).is_ok());
        });
    }
    group.finish();
}

/// Each mode of the run once, with a state in the middle of it.
fn modes<S: System<Scalar = f64>>(system: &S, start: &State<f64>) -> Vec<(Mode, f64, State<f64>)> {
    let trajectory = match Simulation::new(system).run(start.clone(), 0.0..10.0) {
        Ok(trajectory) => trajectory,
        Err(stopped) => *stopped.trajectory,
    };
    let mut sampler = trajectory.sampler();
    let mut modes: Vec<(Mode, f64, State<f64>)> = Vec::new();
    for phase in trajectory.phases() {
        let time = 0.5 * (phase.from + phase.to);
        let known = modes.iter().any(|(mode, ..)| *mode == phase.mode);
        if let (false, Ok(instant)) = (known, sampler.at(time)) {
            modes.push((
                phase.mode,
                time,
                State {
                    q: instant.q.clone(),
                    v: instant.v.clone(),
                },
            ));
        }
    }
    modes
}
