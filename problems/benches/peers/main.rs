//! Whole scenes, ours beside other integrators for Rust, at equal errors and in one process.
//!
//! ```console
//! $ cargo bench -p lagrange-problems --features peers --bench peers              # all scenes
//! $ cargo bench -p lagrange-problems --features peers --bench peers -- wheel     # those whose name has `wheel`
//! ```
//!
//! Ours runs from the declaration: all coordinates, all forces, all modes. The others know neither constraints nor
//! modes: they are given the hand-reduced equations of [`hand`], hand-derived event functions and hand-written switching.
//! An error is the largest of all compared numbers (event times, states at events, end of the run), relative to the
//! larger of 1 and the reference. A table has, per threshold, the shortest time of all runs whose error is below.
//!
//! heyoka, a C++ library with a Python interface, cannot take part in this process.

#[path = "../kit/clock.rs"]
mod clock;
mod crates;
#[path = "../kit/hand.rs"]
mod hand;
mod ours;
mod references;
mod scenes;
mod textbook;

use crates::{DifferentialEquations, Diffsol, OdeSolvers, Peer};
use lagrange_core::prelude::Method;
use scenes::Scene;
use std::time::{Duration, Instant};

const THRESHOLDS: [f64; 7] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 2e-15];
const BUDGET: Duration = Duration::from_secs(3);

fn main() {
    let asked: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    let asked = |name: &str| asked.is_empty() || asked.iter().any(|a| name.contains(a.as_str()));
    compare::<textbook::Slide>(&asked);
    compare::<textbook::Roll>(&asked);
    compare::<textbook::Slip>(&asked);
    compare::<textbook::Wheel>(&asked);
    compare::<scenes::Double>(&asked);
    compare::<scenes::FiveLinks>(&asked);
    compare::<scenes::Rod>(&asked);
    compare::<scenes::Orbit>(&asked);
    compare::<scenes::Spring>(&asked);
}

/// One way to run a scene.
struct Candidate {
    name: String,
    ours: bool,
    error: f64,
    time: Duration,
    run: Box<dyn FnMut() -> Option<Vec<f64>>>,
}

fn compare<S: Scene>(asked: &impl Fn(&str) -> bool) {
    if !asked(S::NAME) {
        return;
    }
    let mut candidates = candidates::<S>();
    // What is far behind something as exact on its own side is not worth its time.
    let known: Vec<(bool, f64, Duration)> = candidates
        .iter()
        .map(|c| (c.ours, c.error, c.time))
        .collect();
    candidates.retain(|c| {
        known
            .iter()
            .all(|&(ours, error, time)| ours != c.ours || error > c.error || 3 * time > c.time)
    });
    let mut runs: Vec<_> = candidates
        .iter_mut()
        .map(|candidate| {
            || {
                let begin = Instant::now();
                std::hint::black_box((candidate.run)());
                begin.elapsed()
            }
        })
        .collect();
    let mut contestants: Vec<&mut dyn FnMut() -> Duration> = runs
        .iter_mut()
        .map(|run| run as &mut dyn FnMut() -> Duration)
        .collect();
    let times = clock::shortest(&mut contestants, BUDGET);
    drop(runs);
    for (candidate, time) in candidates.iter_mut().zip(times) {
        candidate.time = time;
    }
    print(S::NAME, &candidates);
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
            add::<S>(&mut list, name, true, move || S::ours(method, tolerance));
        }
    }
    fn peer<S: Scene, P: Peer>(list: &mut Vec<Candidate>, peer: P, tolerance: f64) {
        let name = format!("{} {tolerance:.0e}", peer.name());
        add::<S>(list, name, false, move || S::by_hand(peer, tolerance));
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
    ours: bool,
    mut run: impl FnMut() -> Option<Vec<f64>> + 'static,
) {
    let begin = Instant::now();
    let Some(found) = run() else { return };
    let time = begin.elapsed();
    let pairs = found.iter().zip(S::REFERENCE);
    let errors = pairs.map(|(x, exact)| (x - exact).abs() / exact.abs().max(1.0));
    let error = errors.fold(0.0, |worst: f64, e| if e <= worst { worst } else { e });
    if error.is_finite() {
        list.push(Candidate {
            name,
            ours,
            error,
            time,
            run: Box::new(run),
        });
    }
}

fn print(scene: &str, candidates: &[Candidate]) {
    println!("\n{scene}");
    println!(
        "{:>8} {:>10} {:>10} {:>7}   {:<32} ours",
        "error", "best peer", "ours", "ratio", "best peer"
    );
    for threshold in THRESHOLDS {
        let best = |ours: bool| {
            candidates
                .iter()
                .filter(|c| c.ours == ours && c.error <= threshold)
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
        let (peer, ours) = (best(false), best(true));
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
