//! Timing side by side: contestants take turns, so that whatever else the machine does hits all of them.

use std::time::{Duration, Instant};

/// Runs every contestant in turn, some runs in a row, until `budget` is spent, but five turns at least; the shortest time of each.
///
/// The minimum is what the work itself takes: anything that disturbs a run makes it longer. The first run of a turn is disturbed by
/// whoever had the turn before, whose code and numbers are in the caches.
pub fn shortest(
    contestants: &mut [&mut dyn FnMut() -> Duration],
    budget: Duration,
) -> Vec<Duration> {
    const LEAST: usize = 5;
    const IN_A_ROW: usize = 5;
    let mut times = vec![Duration::MAX; contestants.len()];
    let begin = Instant::now();
    for round in 0.. {
        if round >= LEAST && begin.elapsed() > budget {
            break;
        }
        for (time, contestant) in times.iter_mut().zip(contestants.iter_mut()) {
            for _ in 0..IN_A_ROW {
                *time = contestant().min(*time);
            }
        }
    }
    times
}
