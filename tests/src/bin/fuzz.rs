//! Random runs held to their certificates, and to the errors that they claim.
//!
//! ```console
//! $ cargo run --release -p lagrange-tests --bin fuzz -- 10000            # runs 0 … 9999
//! $ cargo run --release -p lagrange-tests --bin fuzz -- 1 --from 4711    # one of them again
//! $ cargo run --release -p lagrange-tests --bin fuzz -- catalogue        # all scenes, methods and tolerances
//! $ cargo run --release -p lagrange-tests --bin fuzz -- errors 1000      # estimated and true errors
//! ```

use lagrange_problems::catalogue::scenes;
use lagrange_tests::exactness::{Estimated, Exact};
use lagrange_tests::fuzz::{self, Report, Verdict};
use lagrange_tests::{METHODS, TOLERANCES};
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
        ["errors", count] => {
            return match count.parse() {
                Ok(count) => errors(count),
                Err(_) => ExitCode::from(2),
            };
        }
        [count] => numbers(count, "0"),
        [count, "--from", from] => numbers(count, from),
        _ => None,
    };
    match asked {
        Some((count, from)) => all(count, |k| fuzz::run(from + k as u64)),
        None => {
            eprintln!("fuzz COUNT [--from NUMBER] | fuzz catalogue | fuzz errors COUNT");
            ExitCode::from(2)
        }
    }
}

/// Makes all runs, and tells those that fall short.
fn all(count: usize, run: impl Fn(usize) -> Report + Sync) -> ExitCode {
    let mut counts = [0; 3];
    each(count, run, |report| match report.verdict {
        Verdict::Certified => counts[0] += 1,
        Verdict::Refused(reason) => {
            counts[1] += 1;
            println!("refused {}\n  {reason}", report.run);
        }
        Verdict::Short(reason) => {
            counts[2] += 1;
            println!("SHORT {}\n  {reason}", report.run);
        }
    });
    let [certified, refused, short] = counts;
    println!("{count} runs: {certified} certified, {refused} refused, {short} fell short.");
    ExitCode::from(u8::from(short > 0))
}

/// Compares estimated with true errors, and tells estimates that are wrong and errors that are not met.
fn errors(count: usize) -> ExitCode {
    let ([mut right, mut wrong, mut unresolved, mut refused], mut missed) = ([0; 4], 0);
    let mut met = 0;
    let run = |k: usize| fuzz::ask::<Exact>(k as u64);
    each(count, run, |(run, found)| {
        match found.estimate {
            Estimated::Refused => refused += 1,
            Estimated::Unresolved => unresolved += 1,
            Estimated::Known(told, error) if (0.3..=10.0).contains(&(told / error)) => right += 1,
            Estimated::Known(told, error) => {
                wrong += 1;
                println!("WRONG {run}\n  estimated {told:.1e} instead of {error:.1e}");
            }
        }
        match found.error {
            Estimated::Known(asked, error) if error > asked => {
                missed += 1;
                println!("MISSED {run}\n  asked {asked:.1e}, got {error:.1e}");
            }
            Estimated::Refused => {}
            _ => met += 1,
        }
    });
    println!(
        "{count} runs. Estimates: {right} within 0.3 to 10 of the true error, {wrong} not, {unresolved} below what can be told, \
         {refused} refused. Errors asked for: {met} met, {missed} missed."
    );
    ExitCode::from(u8::from(missed > 0 || 20 * wrong > right))
}

/// Makes all runs on all processors, and takes what comes of them.
fn each<R>(count: usize, run: impl Fn(usize) -> R + Sync, take: impl FnMut(R) + Send) {
    // What panics is told with what it ran.
    std::panic::set_hook(Box::new(|_| {}));
    let (next, take) = (AtomicUsize::new(0), Mutex::new(take));
    let work = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= count {
                return;
            }
            let done = run(k);
            take.lock().unwrap_or_else(|broken| broken.into_inner())(done);
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
}
