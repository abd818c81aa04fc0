//! Steps do not allocate: what a longer run allocates more is the doubling of its recording.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::hard::{CueBall, HoopBead, InclineBlock, TurningPush};
use lagrange_problems::scenes::*;
use lagrange_tests::{first_start, run_by};
use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    // A thread that is being torn down has no counter any more.
    let _ = ALLOCATIONS.try_with(|n| n.set(n.get() + 1));
}

// SAFETY: every request goes to the system's allocator unchanged; counting does not allocate.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { Heap.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { Heap.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { Heap.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Steps of every method, from a scene's first start.
fn steps_do_not_allocate<S: Derived<Scalar = f64>>(scene: &S) {
    let methods = [
        "taylor",
        "dop853",
        "dopri5",
        "verner98",
        "radau5",
        "rk4:0.01",
        "gauss6:0.01",
    ];
    for method in methods {
        let counted = |until: f64| {
            let start = first_start(scene);
            let before = ALLOCATIONS.get();
            let run = run_by(scene, (method, 1e-9), start, until);
            (ALLOCATIONS.get() - before, run.work().steps)
        };
        counted(1.0);
        let (short, few) = counted(5.0);
        let (long, many) = counted(80.0);
        assert!(many > 5 * few, "{method}: {few} and {many} steps");
        // Two vectors grow by doubling: at most 2·log₂(80/5) + 2 reallocations more. A step of another degree makes the
        // interpolation of guards anew, which happens where a slip begins or ends.
        assert!(
            long <= short + 30,
            "{method}: {short} allocations in {few} steps, {long} in {many}"
        );
    }
}

#[test]
fn a_step_does_not_allocate() {
    steps_do_not_allocate(&SphereInBowl {
        mu_static: 1e6,
        mu_kinetic: 1e6,
        ..SphereInBowl::default()
    });
    // A constraint that is solved for and projected onto.
    steps_do_not_allocate(&CartesianPendulum::default());
    // A slip in space that turns for ever.
    steps_do_not_allocate(&TurningPush {
        begin: 0.0,
        jump: 1.0,
        growth: 0.0,
        turn: 12.0,
        ..TurningPush::default()
    });
}

/// All modes of the textbook's scenes and impacts, events and recording included.
#[test]
fn a_second_run_does_not_allocate() {
    fn check<S: Derived<Scalar = f64>>(scene: &S) {
        let start = first_start(scene);
        for record in [true, false] {
            let mut runner = Simulation::new(scene).record(record).runner();
            runner.run(&start, 0.0..20.0).expect("runs");
            let before = ALLOCATIONS.get();
            runner.run(&start, 0.0..20.0).expect("runs");
            let allocations = ALLOCATIONS.get() - before;
            assert_eq!(allocations, 0, "{}", S::DESCRIPTION.name);
        }
    }
    check(&MassOnShell::default());
    check(&RollingSphere::default());
    check(&RollingSlippingSphere::default());
    check(&MassOnWheel::default());
    check(&SphereInBowl::default());
    // Infinitely many impacts, also with friction.
    check(&hard::BouncingBall::default());
    check(&hard::ThrownBall::default());
    check(&InclineBlock::default());
    check(&CueBall::default());
    check(&TurningPush::default());
    check(&HoopBead::default());
}
