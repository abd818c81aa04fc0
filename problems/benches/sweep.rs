//! What a run of a sweep costs on one core: every run with parameters of its own, one after the other (`one by one`), and several at
//! a time (`side by side`), which gives the same numbers.
//!
//! `sweep/<scene>/…`, at 1e-9. For all cores see `lagrange sweep`, which says how many runs it made in a second.

use criterion::{BenchmarkId, Criterion, Throughput};
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;

/// Runs of one measurement.
const RUNS: usize = 512;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    // The three numbers that vary are spread evenly (Roberts 2018, R₃).
    let spread = |index: usize, k: usize| ((index + 1) as f64 * [0.819, 0.671, 0.549][k]).fract();
    let lost = Some((Subject::Contact(0), EventKind::Lost));
    scene(
        &mut criterion,
        20.0,
        lost,
        |sphere: &mut RollingSlippingSphere, index| {
            sphere.sphere_radius = 0.1 + 0.2 * spread(index, 0);
            sphere.mu_static = 0.35 + 0.15 * spread(index, 1);
            sphere.start_angle = 0.01 + 0.04 * spread(index, 2);
        },
    );
    scene(
        &mut criterion,
        20.0,
        None,
        |wheel: &mut MassOnWheel, index| {
            wheel.mu_static = 0.5 + 0.5 * spread(index, 0);
            wheel.mass = 0.5 + spread(index, 1);
        },
    );
    scene(
        &mut criterion,
        5.0,
        None,
        |pendulum: &mut DoublePendulum, index| {
            pendulum.upper_mass = 1.0 + spread(index, 0);
        },
    );
    scene(
        &mut criterion,
        2.0,
        None,
        |chain: &mut FiveLinkChain, index| {
            chain.gravity = 9.0 + spread(index, 0);
        },
    );
    criterion.final_summary();
}

fn scene<S: Derived<Scalar = f64> + Clone + Default>(
    criterion: &mut Criterion,
    until: f64,
    last: Option<(Subject, EventKind)>,
    vary: impl Fn(&mut S, usize),
) {
    let mut system = S::default();
    let start = |system: &S| {
        let n = S::DESCRIPTION.coordinates.len();
        let mut start = State::new(vec![0.0; n], vec![0.0; n]);
        system.start(0, 0.0, &mut start.q, &mut start.v);
        start
    };
    let simulated = system.clone();
    let mut simulation = Simulation::new(&simulated).tolerance(1e-9).record(false);
    if let Some((subject, kind)) = last {
        simulation = simulation.end_after((subject, kind));
    }
    let (mut runner, mut ensemble) = (simulation.runner(), simulation.ensemble());
    let mut group = criterion.benchmark_group("sweep");
    group.throughput(Throughput::Elements(RUNS as u64));
    group.bench_function(
        BenchmarkId::new(S::DESCRIPTION.name, "one by one"),
        |bench| {
            bench.iter(|| {
                for index in 0..RUNS {
                    vary(&mut system, index);
                    runner.set_scene(&system);
                    runner.run(&start(&system), 0.0..until).expect("runs");
                }
            });
        },
    );
    group.bench_function(
        BenchmarkId::new(S::DESCRIPTION.name, "side by side"),
        |bench| {
            bench.iter(|| {
                let prepare = |index, runner: &mut Runner<S>| {
                    vary(&mut system, index);
                    runner.set_scene(&system);
                    Some(start(&system))
                };
                let take = |_, outcome: Result<(), Error>, _: &Trajectory<S::Scalar>| {
                    outcome.expect("runs")
                };
                ensemble.run(RUNS, 0.0..until, prepare, take);
            });
        },
    );
    group.finish();
}
