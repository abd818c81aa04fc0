//! What one right-hand side costs in each mode, beside the closed form that one would work out by hand.
//!
//! Ours is what the steppers call: the accelerations of all coordinates, from the declaration. By hand it is those of as few
//! coordinates as the mode has. Calls form a chain, each on the state that the last one has moved
//! (by less than rounding): what is measured is the latency, which is what an integrator waits for.
//!
//! Prints a table with the ratios, both sides taking turns, then measures each by criterion.

#[path = "kit/clock.rs"]
mod clock;
#[path = "kit/hand.rs"]
mod hand;

use criterion::Criterion;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;
use lagrange_program::cost::{MOVE, Place, RightSide, places};
use std::hint::black_box;
use std::time::{Duration, Instant};

fn main() {
    let mut bench = Bench {
        criterion: Criterion::default().configure_from_args(),
        table: std::env::args().all(|a| a != "--test" && a != "--list"),
    };
    println!("ns per right-hand side: by hand, ours, ratio");
    bench.closed_forms();
    bench.criterion.final_summary();
}

struct Bench {
    criterion: Criterion,
    table: bool,
}

impl Bench {
    fn closed_forms(&mut self) {
        let shell = MassOnShell::default();
        self.mode(&shell, "slide", 0, [1], hand::on_shell(hand::G));
        self.mode(&shell, "flight", 1, [0, 1], hand::flight);
        let rate = 5.0 / 7.0 * hand::G / hand::sphere::REACH;
        let rolling = RollingSphere::default();
        self.mode(&rolling, "roll", 0, [1], hand::on_shell(rate));
        let slipping = RollingSlippingSphere::default();
        self.mode(&slipping, "roll", 0, [1], hand::on_shell(rate));
        self.mode(&slipping, "slip", 1, [1, 2], hand::sphere_slips);
        let wheel = MassOnWheel::default();
        self.mode(&wheel, "stuck", 0, [3], hand::wheel_sticks);
        self.mode(&wheel, "slip", 1, [3, 1], hand::wheel_slips);
        self.mode(&wheel, "flight", 2, [2, 3], hand::flight);
        let double = DoublePendulum::default();
        self.mode(&double, "", 0, [0, 1], hand::double_pendulum);
        self.mode(
            &FiveLinkChain::default(),
            "",
            0,
            [0, 1, 2, 3, 4],
            hand::chain,
        );
        let pendulum = CartesianPendulum::default();
        self.mode(&pendulum, "", 0, [0, 1], hand::cartesian_pendulum);
        self.mode(&Kepler::default(), "", 0, [0, 1], hand::kepler);
        let spring = StiffSpringPendulum::default();
        self.mode(&spring, "", 0, [0, 1], hand::spring_pendulum);
    }

    /// The mode number `mode` that a scene's run from its first start meets, and its closed form in some of the coordinates.
    fn mode<S: Derived<Scalar = f64> + Starts, const K: usize, const N: usize>(
        &mut self,
        system: &S,
        name: &str,
        mode: usize,
        coordinates: [usize; K],
        by_hand: impl Fn(&[f64; N], &mut [f64; N]) + Copy,
    ) {
        let name = format!("{} {name}", S::DESCRIPTION.name);
        let place = place(system, mode);
        let state = &place.state;
        let mut side = RightSide::new(system, &Effects::all(), &place).expect("a place on the way");
        let mut start = [0.0; N];
        for (i, &j) in coordinates.iter().enumerate() {
            (start[i], start[K + i]) = (state.q[j], state.v[j]);
        }
        let mut slope = [0.0; N];
        by_hand(&start, &mut slope);
        for (i, &j) in coordinates.iter().enumerate() {
            let ours = side.accelerations()[j];
            let difference = (ours - slope[K + i]).abs() / ours.abs().max(1.0);
            assert!(difference < 1e-9, "{name}: {ours}, not {}", slope[K + i]);
        }

        let mut hand = |calls: u64| chain_by_hand(by_hand, start, calls);
        let mut ours = |calls: u64| side.chain(calls);
        if self.table {
            const CALLS: u64 = 10_000;
            let mut contestants: [&mut dyn FnMut() -> Duration; 2] =
                [&mut || hand(CALLS), &mut || ours(CALLS)];
            let times = clock::shortest(&mut contestants, Duration::from_millis(400));
            let [hand, ours] = [0, 1].map(|i| times[i].as_secs_f64() * 1e9 / CALLS as f64);
            println!("{name:<34}{hand:8.1}{ours:8.1}{:8.2}", ours / hand);
        }
        let mut group = self.criterion.benchmark_group(format!("rhs/{name}"));
        group.bench_function("by hand", |bench| bench.iter_custom(&mut hand));
        group.bench_function("ours", |bench| bench.iter_custom(&mut ours));
        group.finish();
    }
}

fn chain_by_hand<const N: usize>(
    slope: impl Fn(&[f64; N], &mut [f64; N]),
    start: [f64; N],
    calls: u64,
) -> Duration {
    let mut y = black_box(start);
    let mut d = [0.0; N];
    let begin = Instant::now();
    for _ in 0..calls {
        slope(&y, &mut d);
        for (y, d) in y.iter_mut().zip(&d) {
            *y += MOVE * d;
        }
    }
    black_box(y);
    begin.elapsed()
}

/// The first mode number `index` of the run from the first start, in the middle of its first phase.
fn place<S: Derived<Scalar = f64> + Starts>(system: &S, index: usize) -> Place {
    let trajectory = Simulation::new(system)
        .tolerance(1e-12)
        .run(system.at(StartId(0)), 0.0..4.0)
        .unwrap_or_else(|failure| panic!("{failure}"));
    places(&trajectory).swap_remove(index)
}
