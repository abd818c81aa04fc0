//! Times of all rows, taken in turn.

use super::Row;
use crate::progress::Progress;

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

/// A row and its clock, which gives the seconds that one of a number of runs takes.
pub(super) struct Timed<C> {
    row: Row,
    clock: C,
    samples: Vec<f64>,
    spent: f64,
}

impl<C: FnMut(usize) -> f64> Timed<C> {
    /// A row that has not been timed.
    pub(super) fn new(row: Row, clock: C) -> Self {
        Self {
            row,
            clock,
            samples: Vec::new(),
            spent: 0.0,
        }
    }

    /// One round, if the row has a result.
    pub(super) fn round(&mut self) {
        if self.row.result.is_err() {
            return;
        }
        // The first run of a burst meets the caches that another method has left, and tells how long the burst is.
        let first = (self.clock)(1);
        let runs = (BURST / first.max(1e-9)).min(1000.0) as usize;
        let each = match runs {
            0 => first,
            _ => (self.clock)(runs),
        };
        self.spent += first + each * runs as f64;
        self.samples.push(each);
    }

    /// The row with its time.
    pub(super) fn done(self) -> Row {
        let mut row = self.row;
        if let Ok(measured) = &mut row.result {
            measured.time = Timing::of(self.samples);
        }
        row
    }
}

/// Rounds in all.
pub(super) fn rounds(repeat: Option<usize>) -> usize {
    repeat.unwrap_or(ROUNDS)
}

/// Times all rows in turn: the rounds after the first, or as many as do not take too long. Ends early if it is stopped.
pub(super) fn rest<C: FnMut(usize) -> f64>(
    rows: &mut [Timed<C>],
    repeat: Option<usize>,
    progress: &Progress,
) {
    for _ in 1..rounds(repeat) {
        for row in &mut *rows {
            if repeat.is_some() || row.spent <= SHARE {
                let before = row.samples.len();
                row.round();
                if progress.is_stopped() {
                    // A run that was cut short says nothing.
                    row.samples.truncate(before);
                    return;
                }
            }
            progress.advance(1);
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
