//! Times of all rows, taken in turn.

use super::{Row, Setting};

/// Rounds, if the user does not say.
const ROUNDS: usize = 15;
/// Time that a row may take before it sits out the other rounds, s; if the user does not say how many.
const SHARE: f64 = 0.1;
/// Length of a burst, s: short runs are timed many at a time, long enough for clocks and caches.
const BURST: f64 = 4e-4;

/// Time of one run, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// The shortest of the rounds: what else a machine does only adds to it.
    pub best: f64,
    /// The median of the rounds.
    pub median: f64,
    /// Rounds.
    pub rounds: usize,
}

/// Times every row that has a result: `repeat` rounds, or a number that does not take too long. `run` gives the seconds
/// that one of a number of runs takes.
pub(super) fn fill(rows: &mut [Row], repeat: Option<usize>, run: impl Fn(Setting, usize) -> f64) {
    let mut samples: Vec<Vec<f64>> = vec![Vec::new(); rows.len()];
    let mut spent = vec![0.0; rows.len()];
    for _ in 0..repeat.unwrap_or(ROUNDS) {
        for (index, row) in rows.iter().enumerate() {
            let over = repeat.is_none() && spent[index] > SHARE;
            if row.result.is_err() || over {
                continue;
            }
            // The first run of a burst meets the caches that another method has left, and tells how long the burst is.
            let first = run(row.setting, 1);
            let runs = (BURST / first.max(1e-9)).min(1000.0) as usize;
            let each = match runs {
                0 => first,
                _ => run(row.setting, runs),
            };
            spent[index] += first + each * runs as f64;
            samples[index].push(each);
        }
    }
    for (row, samples) in rows.iter_mut().zip(samples) {
        if let Ok(measured) = &mut row.result {
            measured.time = Timing::of(samples);
        }
    }
}

impl Timing {
    fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        Timing {
            best: samples.first().copied().unwrap_or(0.0),
            median: samples.get(samples.len() / 2).copied().unwrap_or(0.0),
            rounds: samples.len(),
        }
    }
}
