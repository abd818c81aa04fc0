//! Whole scenes, ours beside other integrators for Rust, at equal errors and in one process.
//!
//! ```console
//! $ cargo bench -p lagrange-problems --features peers --bench peers              # all scenes
//! $ cargo bench -p lagrange-problems --features peers --bench peers -- wheel     # those whose name has `wheel`
//! ```
//!
//! Ours runs from the declaration: all coordinates, all forces, all modes; without ledger and record, which the others do
//! not have. The others know neither constraints nor
//! modes: they are given the hand-reduced equations of [`hand`], hand-derived event functions and hand-written switching.
//! An error is the largest of all compared numbers (event times, states at events, end of the run), relative to the
//! larger of 1 and the reference. A table has, per threshold, the shortest time of all runs whose error is below.
//!
//! heyoka takes part, in turn with the others, where `HEYOKA_PYTHON` names a Python that has it:
//!
//! ```console
//! $ python3 -m venv heyoka && heyoka/bin/pip install heyoka
//! $ HEYOKA_PYTHON=$PWD/heyoka/bin/python cargo bench -p lagrange-problems --features peers --bench peers
//! ```
//!
//! Its column stands beside that of the best other peer; both tables are of one run.

#[path = "../kit/clock.rs"]
mod clock;
mod crates;
#[path = "../kit/hand.rs"]
mod hand;
mod heyoka;
mod ours;
mod references;
mod scenes;
mod textbook;

use crates::{DifferentialEquations, Diffsol, OdeSolvers, Peer};
use heyoka::Heyoka;
use lagrange_core::prelude::Method;
use scenes::Scene;
use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

const THRESHOLDS: [f64; 7] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 2e-15];
const BUDGET: Duration = Duration::from_secs(3);

fn main() {
    let asked: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    let asked = |name: &str| asked.is_empty() || asked.iter().any(|a| name.contains(a.as_str()));
    let heyoka = Heyoka::start().map(|heyoka| Rc::new(RefCell::new(heyoka)));
    let heyoka = heyoka.as_ref();
    compare::<textbook::Slide>(&asked, heyoka);
    compare::<textbook::Roll>(&asked, heyoka);
    compare::<textbook::Slip>(&asked, heyoka);
    compare::<textbook::Wheel>(&asked, heyoka);
    compare::<scenes::Double>(&asked, heyoka);
    compare::<scenes::FiveLinks>(&asked, heyoka);
    compare::<scenes::Rod>(&asked, heyoka);
    compare::<scenes::Orbit>(&asked, heyoka);
    compare::<scenes::Spring>(&asked, heyoka);
}

/// Who runs a scene.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Ours,
    Crate,
    Heyoka,
}

/// One way to run a scene.
struct Candidate {
    name: String,
    side: Side,
    error: f64,
    time: Duration,
    /// One run, and what it took.
    run: Box<dyn FnMut() -> Duration>,
}

fn compare<S: Scene>(asked: &impl Fn(&str) -> bool, heyoka: Option<&Rc<RefCell<Heyoka>>>) {
    if !asked(S::NAME) {
        return;
    }
    let mut candidates = candidates::<S>();
    if let Some(heyoka) = heyoka {
        add_heyoka::<S>(&mut candidates, heyoka);
    }
    // What is far behind something as exact on its own side is not worth its time.
    let known: Vec<(Side, f64, Duration)> = candidates
        .iter()
        .map(|c| (c.side, c.error, c.time))
        .collect();
    candidates.retain(|c| {
        known
            .iter()
            .all(|&(side, error, time)| side != c.side || error > c.error || 3 * time > c.time)
    });
    let mut contestants: Vec<&mut dyn FnMut() -> Duration> = candidates
        .iter_mut()
        .map(|candidate| &mut *candidate.run as &mut dyn FnMut() -> Duration)
        .collect();
    let times = clock::shortest(&mut contestants, BUDGET);
    for (candidate, time) in candidates.iter_mut().zip(times) {
        candidate.time = time;
    }
    print(S::NAME, Side::Crate, "best crate", &candidates);
    if heyoka.is_some() {
        print(S::NAME, Side::Heyoka, "heyoka", &candidates);
    }
}

fn candidates<S: Scene>() -> Vec<Candidate> {
    let mut list = Vec::new();
    let decades = |tightest: i32| (2..=tightest).map(|digits| 10f64.powi(-digits));
    for tolerance in decades(17) {
        let mut methods = vec![Method::Taylor];
        if tolerance > 1e-16 {
            methods.extend([
                Method::DormandPrince853,
                Method::DormandPrince54,
                Method::Verner98,
            ]);
        }
        for method in methods {
            let name = format!("{method} {tolerance:.0e}");
            add::<S>(
                &mut list,
                name,
                Side::Ours,
                ours::runs::<S>(method, tolerance),
            );
        }
    }
    fn peer<S: Scene, P: Peer>(list: &mut Vec<Candidate>, peer: P, tolerance: f64) {
        let name = format!("{} {tolerance:.0e}", peer.name());
        add::<S>(list, name, Side::Crate, move || S::by_hand(peer, tolerance));
    }
    for tolerance in decades(12) {
        peer::<S, _>(&mut list, Diffsol, tolerance);
    }
    for tolerance in decades(15) {
        peer::<S, _>(&mut list, OdeSolvers, tolerance);
        for method in [
            DifferentialEquations::DormandPrince5,
            DifferentialEquations::DormandPrince8,
            DifferentialEquations::Verner9,
        ] {
            peer::<S, _>(&mut list, method, tolerance);
        }
    }
    list
}

/// Runs once to see how exact it is; what fails does not take part.
fn add<S: Scene>(
    list: &mut Vec<Candidate>,
    name: String,
    side: Side,
    mut run: impl FnMut() -> Option<Vec<f64>> + 'static,
) {
    let begin = Instant::now();
    let Some(found) = run() else { return };
    let time = begin.elapsed();
    let run = move || {
        let begin = Instant::now();
        std::hint::black_box(run());
        begin.elapsed()
    };
    include::<S>(list, name, side, &found, time, Box::new(run));
}

/// heyoka at tolerances from 1e-3 to the rounding of its numbers.
fn add_heyoka<S: Scene>(list: &mut Vec<Candidate>, heyoka: &Rc<RefCell<Heyoka>>) {
    let tolerances = (3..=15).step_by(2).map(|digits| 10f64.powi(-digits));
    for tolerance in tolerances.chain([f64::EPSILON]) {
        let (run, found) = heyoka.borrow_mut().prepare(S::NAME, tolerance);
        let time = heyoka.borrow_mut().time(run);
        let name = format!("heyoka {tolerance:.0e}");
        let process = heyoka.clone();
        let again = move || process.borrow_mut().time(run);
        include::<S>(list, name, Side::Heyoka, &found, time, Box::new(again));
    }
}

/// Takes a candidate whose numbers are those of the scene.
fn include<S: Scene>(
    list: &mut Vec<Candidate>,
    name: String,
    side: Side,
    found: &[f64],
    time: Duration,
    run: Box<dyn FnMut() -> Duration>,
) {
    let pairs = found.iter().zip(S::REFERENCE);
    let errors = pairs.map(|(x, exact)| (x - exact).abs() / exact.abs().max(1.0));
    let error = errors.fold(0.0, |worst: f64, e| if e <= worst { worst } else { e });
    if error.is_finite() && found.len() == S::REFERENCE.len() {
        list.push(Candidate {
            name,
            side,
            error,
            time,
            run,
        });
    }
}

fn print(scene: &str, side: Side, peer: &str, candidates: &[Candidate]) {
    println!("\n{scene}");
    println!(
        "{:>8} {peer:>10} {:>10} {:>7}   {peer:<32} ours",
        "error", "ours", "ratio"
    );
    for threshold in THRESHOLDS {
        let best = |side: Side| {
            candidates
                .iter()
                .filter(|c| c.side == side && c.error <= threshold)
                .min_by_key(|c| c.time)
        };
        let micro = |c: Option<&Candidate>| {
            c.map_or("–".to_owned(), |c| {
                format!("{:.1} µs", c.time.as_secs_f64() * 1e6)
            })
        };
        let name = |c: Option<&Candidate>| {
            c.map_or("–".to_owned(), |c| {
                format!("{} ({:.0e})", c.name, c.error)
            })
        };
        let (peer, ours) = (best(side), best(Side::Ours));
        let ratio = match (peer, ours) {
            (Some(p), Some(o)) => format!("{:.2}", o.time.as_secs_f64() / p.time.as_secs_f64()),
            _ => "–".to_owned(),
        };
        println!(
            "{threshold:>8.0e} {:>10} {:>10} {ratio:>7}   {:<32} {}",
            micro(peer),
            micro(ours),
            name(peer),
            name(ours)
        );
    }
}
