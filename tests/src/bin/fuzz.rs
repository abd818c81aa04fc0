//! Random runs held to their certificates.
//!
//! ```console
//! $ cargo run --release -p lagrange-tests --bin fuzz -- 10000            # runs 0 … 9999
//! $ cargo run --release -p lagrange-tests --bin fuzz -- 1 --from 4711    # one of them again
//! $ cargo run --release -p lagrange-tests --bin fuzz -- catalogue        # all scenes, methods and tolerances
//! ```

use lagrange_problems::catalogue::scenes;
use lagrange_tests::fuzz::{self, METHODS, Report, TOLERANCES, Verdict};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let numbers = |count: &str, from: &str| -> Option<(usize, u64)> {
        Some((count.parse().ok()?, from.parse().ok()?))
    };
    let asked = match words[..] {
        ["catalogue"] => {
            let scenes: Vec<_> = scenes().collect();
            let (methods, tolerances) = (METHODS.len(), TOLERANCES.len());
            let run = |k: usize| {
                let (scene, rest) = (k / (methods * tolerances), k % (methods * tolerances));
                fuzz::scene(
                    scenes[scene],
                    METHODS[rest / tolerances],
                    TOLERANCES[rest % tolerances],
                )
            };
            return all(scenes.len() * methods * tolerances, run);
        }
        [count] => numbers(count, "0"),
        [count, "--from", from] => numbers(count, from),
        _ => None,
    };
    match asked {
        Some((count, from)) => all(count, |k| fuzz::run(from + k as u64)),
        None => {
            eprintln!("fuzz COUNT [--from NUMBER] | fuzz catalogue");
            ExitCode::from(2)
        }
    }
}

/// Makes all runs on all processors, and tells those that fall short.
fn all(count: usize, run: impl Fn(usize) -> Report + Sync) -> ExitCode {
    // What panics is told with what it ran.
    std::panic::set_hook(Box::new(|_| {}));
    let (next, told) = (AtomicUsize::new(0), Mutex::new([0; 3]));
    let work = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= count {
                return;
            }
            let report = run(k);
            let mut counts = told.lock().unwrap_or_else(|broken| broken.into_inner());
            match report.verdict {
                Verdict::Certified => counts[0] += 1,
                Verdict::Refused(reason) => {
                    counts[1] += 1;
                    println!("refused {}\n  {reason}", report.run);
                }
                Verdict::Short(reason) => {
                    counts[2] += 1;
                    println!("SHORT {}\n  {reason}", report.run);
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let [certified, refused, short] = told.into_inner().unwrap_or_default();
    println!("{count} runs: {certified} certified, {refused} refused, {short} fell short.");
    ExitCode::from(u8::from(short > 0))
}
