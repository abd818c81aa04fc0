//! Shared kit of the tests: seeded numbers, roots and quadrature for closed forms, and short ways to run a scene.
//!
//! Nothing here computes as the library does: what it is compared with is written again from the textbook.

pub mod declarations;
pub mod equations;
pub mod exactness;
pub mod families;
pub mod fuzz;
pub mod modes;
pub mod pairs;

use core::fmt::Display;
use lagrange_core::prelude::*;
pub use lagrange_problems::reference::{agm, extrapolate, integral, root};

/// Methods that choose their steps.
pub const METHODS: [Method; 5] = [
    Method::Auto,
    Method::DormandPrince853,
    Method::DormandPrince54,
    Method::Verner98,
    Method::Radau5,
];

/// The same with Taylor's method throughout, also where [`Method::Auto`] would change it for a stiff one.
pub const SINGLE_METHODS: [Method; 5] = [
    Method::Taylor,
    Method::DormandPrince853,
    Method::DormandPrince54,
    Method::Verner98,
    Method::Radau5,
];

/// Tolerances that runs are asked for.
pub const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// Each method with each tolerance.
pub fn methods_at<M: Copy, const N: usize>(
    methods: impl IntoIterator<Item = M>,
    tolerances: [f64; N],
) -> impl Iterator<Item = (M, f64)> {
    let methods = methods.into_iter();
    methods.flat_map(move |method| tolerances.map(|tolerance| (method, tolerance)))
}

/// Seeded random numbers (splitmix64, Steele, Lea & Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for every seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let z = self.bits();
        low + (high - low) * (z >> 11) as f64 / (1u64 << 53) as f64
    }

    /// One of 0, 1, …, n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// +1 or −1.
    pub fn sign(&mut self) -> f64 {
        self.between(-1.0, 1.0).signum()
    }
}

/// |a − b| relative to the larger of |b| and 1.
pub fn error(a: f64, b: f64) -> f64 {
    (a - b).abs() / b.abs().max(1.0)
}

/// Asserts that two numbers agree to `tolerance`, relative to the larger of the second and 1.
#[track_caller]
pub fn agree(what: impl Display, a: f64, b: f64, tolerance: f64) {
    assert!(
        error(a, b) <= tolerance,
        "{what}: {a} instead of {b}, error {:.1e}",
        error(a, b)
    );
}

/// [`agree`] for lists, relative to the largest of 1 and the second list.
#[track_caller]
pub fn all_agree(what: impl Display, a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{what}: length");
    let size = b.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        agree(
            format!("{what}[{i}] over {size}"),
            a / size,
            b / size,
            tolerance,
        );
    }
}

/// Runs a scene from a state at tolerance 1e-12.
#[track_caller]
pub fn run<S: System<Scalar = f64>>(
    scene: &S,
    start: State<f64>,
    until: f64,
) -> Trajectory<S::Scalar> {
    run_by(scene, ("taylor", 1e-12), start, until)
}

/// Runs a scene from a state by a method, or that of a name, at a tolerance.
#[track_caller]
pub fn run_by<S: System<Scalar = f64>>(
    scene: &S,
    (method, tolerance): (impl Display, f64),
    start: State<f64>,
    until: f64,
) -> Trajectory<S::Scalar> {
    let simulation = Simulation::new(scene)
        .method(method.to_string().parse().expect("a method"))
        .tolerance(tolerance);
    match simulation.run(start, 0.0..until) {
        Ok(trajectory) => trajectory,
        Err(failure) => panic!("{method}: {failure}; {:?}", words(&failure.trajectory)),
    }
}

/// Asserts that a recorded run obeys its declaration, by its certificate.
#[track_caller]
pub fn certified(what: impl Display, trajectory: &Trajectory) {
    let certificate = trajectory.verify(1).expect("a recorded run");
    let name = trajectory.description().name;
    assert!(certificate.holds(), "{name} {what}: {certificate}");
}

/// One step `h` of the classical Runge–Kutta method from (`t`, `y`), for reduced equations that results are compared with.
pub fn runge_kutta<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    (t, y): (f64, [f64; N]),
    h: f64,
) -> [f64; N] {
    let along = |k: [f64; N], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
    let k1 = slope(t, y);
    let k2 = slope(t + h / 2.0, along(k1, h / 2.0));
    let k3 = slope(t + h / 2.0, along(k2, h / 2.0));
    let k4 = slope(t + h, along(k3, h));
    core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

/// The state that the first start of a scene sets.
pub fn first_start<S: System<Scalar = f64>>(scene: &S) -> State<f64> {
    let n = scene.description().coordinates.len();
    let mut start = State::new(vec![0.0; n], vec![0.0; n]);
    scene.start(0, 0.0, &mut start.q, &mut start.v);
    start
}

/// The events as `item kind`.
pub fn words(trajectory: &Trajectory) -> Vec<String> {
    let events = trajectory.events().iter();
    events
        .map(|e| format!("{} {}", e.subject.name(trajectory.description()), e.kind))
        .collect()
}

/// The events of an item and kind, `("shell", "lost")`.
fn events<'a>(
    trajectory: &'a Trajectory,
    item: &str,
    kind: &str,
) -> impl Iterator<Item = &'a Event<f64>> {
    let events = trajectory.events().iter();
    events
        .filter(move |e| e.subject.name(trajectory.description()) == item && e.kind.word() == kind)
}

/// The first event of an item and kind.
#[track_caller]
pub fn event<'a>(trajectory: &'a Trajectory, item: &str, kind: &str) -> &'a Event<f64> {
    let found = events(trajectory, item, kind).next();
    found.unwrap_or_else(|| panic!("no `{item} {kind}` in {:?}", words(trajectory)))
}

/// When the events of an item and kind happen, s.
pub fn times(trajectory: &Trajectory, item: &str, kind: &str) -> Vec<f64> {
    events(trajectory, item, kind).map(|e| e.time).collect()
}

/// Closure of the energy ledger relative to its scale.
#[track_caller]
pub fn closure(trajectory: &Trajectory) -> f64 {
    let ledger = trajectory.ledger().expect("the trajectory can be sampled");
    ledger.closure.abs() / ledger.scale
}
