//! What whole runs cost, from the first start of a scene to its end, again and again by one runner, without a record of
//! the motion in between.
//!
//! `run/<scene>/<tolerance>`, by the Taylor method. For other methods see `lagrange accuracy`, for other integrators the
//! bench `peers`.

use criterion::{BenchmarkId, Criterion};
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    scene::<MassOnShell>(&mut criterion, 20.0);
    scene::<RollingSphere>(&mut criterion, 20.0);
    scene::<RollingSlippingSphere>(&mut criterion, 20.0);
    scene::<MassOnWheel>(&mut criterion, 20.0);
    scene::<SphereInBowl>(&mut criterion, 10.0);
    scene::<DoublePendulum>(&mut criterion, 5.0);
    scene::<FiveLinkChain>(&mut criterion, 2.0);
    scene::<CartesianPendulum>(&mut criterion, 100.0);
    scene::<Kepler>(&mut criterion, 200.0 * std::f64::consts::PI);
    scene::<StiffSpringPendulum>(&mut criterion, 10.0);
    criterion.final_summary();
}

fn scene<S: Derived<Scalar = f64> + Default>(criterion: &mut Criterion, until: f64) {
    let system = S::default();
    let n = S::DESCRIPTION.coordinates.len();
    let mut start = State::new(vec![0.0; n], vec![0.0; n]);
    system.start(0, 0.0, &mut start.q, &mut start.v);
    let mut group = criterion.benchmark_group("run");
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let simulation = Simulation::new(&system).tolerance(tolerance);
        let mut runner = simulation.record(false).runner();
        let id = BenchmarkId::new(S::DESCRIPTION.name, format!("{tolerance:e}"));
        group.bench_function(id, |bench| {
            bench.iter(|| runner.run(&start, 0.0..until).is_ok());
        });
    }
    group.finish();
}
