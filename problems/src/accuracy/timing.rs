//! Times of all rows, taken in turn.

use super::{Measured, Row, Setting};

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

/// Times every row that has a result: `repeat` rounds, or a number that does not take too long. A clock gives the seconds
/// that one of a number of runs takes.
pub(super) fn fill<C: FnMut(usize) -> f64>(
    rows: &mut [Row],
    repeat: Option<usize>,
    clock: impl Fn(Setting) -> C,
) {
    struct Timed<'r, C> {
        measured: &'r mut Measured,
        clock: C,
        samples: Vec<f64>,
        spent: f64,
    }
    let timed = rows.iter_mut().filter_map(|row| {
        Some(Timed {
            measured: row.result.as_mut().ok()?,
            clock: clock(row.setting),
            samples: Vec::new(),
            spent: 0.0,
        })
    });
    let mut timed: Vec<Timed<C>> = timed.collect();
    for _ in 0..repeat.unwrap_or(ROUNDS) {
        for row in &mut timed {
            if repeat.is_none() && row.spent > SHARE {
                continue;
            }
            // The first run of a burst meets the caches that another method has left, and tells how long the burst is.
            let first = (row.clock)(1);
            let runs = (BURST / first.max(1e-9)).min(1000.0) as usize;
            let each = match runs {
                0 => first,
                _ => (row.clock)(runs),
            };
            row.spent += first + each * runs as f64;
            row.samples.push(each);
        }
    }
    for row in timed {
        row.measured.time = Timing::of(row.samples);
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
