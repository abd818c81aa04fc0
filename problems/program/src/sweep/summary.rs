//! What came out of a sweep, in a few numbers.

use super::quantile::{READINGS, Search};
use super::{Journal, Sweep, Trouble, reason};
use std::collections::BTreeMap;

/// The quantiles that are told.
pub const QUANTILES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// One column of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Runs that have it; where there is none, the numbers below mean nothing.
    pub count: usize,
    /// Smallest value, and the number of the first point that has it.
    pub least: (f64, usize),
    /// Largest value, and the number of the first point that has it.
    pub greatest: (f64, usize),
    /// Mean.
    pub mean: f64,
    /// What parts of the values are below, for each of [`QUANTILES`].
    pub quantiles: Vec<f64>,
    /// Of an observation that is a sequence of switches: the sequences, the most frequent first; the numbers mean nothing.
    pub sequences: Vec<Sequence>,
    /// Sum of squared deviations from the mean.
    squares: f64,
}

impl Column {
    fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            count: 0,
            least: (f64::INFINITY, 0),
            greatest: (f64::NEG_INFINITY, 0),
            mean: 0.0,
            quantiles: Vec::new(),
            sequences: Vec::new(),
            squares: 0.0,
        }
    }

    /// Standard deviation of the values themselves, not an estimate for more of them.
    pub fn deviation(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// Takes the value of a point (Welford 1962).
    fn take(&mut self, value: f64, point: usize) {
        self.count += 1;
        if value < self.least.0 {
            self.least = (value, point);
        }
        if value > self.greatest.0 {
            self.greatest = (value, point);
        }
        let off = value - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (value - self.mean);
    }
}

/// Runs that have the same switches in the same order.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// The number that stands for them.
    pub number: f64,
    /// How many runs.
    pub count: usize,
    /// Number of the first such point.
    pub first: usize,
}

/// Runs that failed for one reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failed {
    /// The reason, in a word.
    pub reason: &'static str,
    /// The message of the first such run.
    pub message: String,
    /// How many.
    pub count: usize,
    /// Number of the first such point.
    pub first: usize,
}

/// All columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of runs.
    pub runs: usize,
    /// Runs that failed, by reason, the most frequent first.
    pub failed: Vec<Failed>,
    /// What was observed.
    pub columns: Vec<Column>,
}

impl Summary {
    /// Of everything in a journal.
    ///
    /// # Errors
    /// It is not complete.
    pub fn new(sweep: &Sweep, journal: &Journal) -> Result<Self, Trouble> {
        let names = sweep.observed.iter().map(|o| o.name.as_str());
        let mut columns: Vec<Column> = names.map(Column::new).collect();
        let mut failed: BTreeMap<&'static str, Failed> = BTreeMap::new();
        let mut sequences: Vec<BTreeMap<u64, Sequence>> = vec![BTreeMap::new(); columns.len()];
        rows(sweep, journal, |point, observed, code| {
            if let Some(reason) = reason(code) {
                let failed = failed.entry(reason).or_insert(Failed {
                    reason,
                    message: String::new(),
                    count: 0,
                    first: point,
                });
                failed.count += 1;
            }
            for (index, &value) in observed
                .iter()
                .enumerate()
                .filter(|(_, value)| !value.is_nan())
            {
                columns[index].take(value, point);
                if sweep.observed[index].is_sequence() {
                    let new = Sequence {
                        number: value,
                        count: 0,
                        first: point,
                    };
                    sequences[index].entry(value as u64).or_insert(new).count += 1;
                }
            }
        })?;
        let searches = columns.iter().map(|c| Search::new(&QUANTILES, c.count));
        let mut searches: Vec<Search> = searches.collect();
        for _ in 0..READINGS {
            rows(sweep, journal, |_, observed, _| {
                for (search, value) in searches.iter_mut().zip(observed) {
                    if !value.is_nan() {
                        search.take(*value);
                    }
                }
            })?;
            searches.iter_mut().for_each(Search::narrow);
        }
        for (column, search) in columns.iter_mut().zip(&searches) {
            column.quantiles = search.found();
        }
        for (column, sequences) in columns.iter_mut().zip(sequences) {
            column.sequences = sequences.into_values().collect();
            column
                .sequences
                .sort_by_key(|sequence| std::cmp::Reverse(sequence.count));
        }
        let mut failed: Vec<Failed> = failed.into_values().collect();
        failed.sort_by_key(|failed| std::cmp::Reverse(failed.count));
        for failed in &mut failed {
            failed.message = sweep.message(failed.first).unwrap_or_default();
        }
        Ok(Self {
            runs: sweep.points.len(),
            failed,
            columns,
        })
    }

    /// Number of runs that failed.
    pub fn failures(&self) -> usize {
        self.failed.iter().map(|failed| failed.count).sum()
    }
}

/// Calls `each` with the number of every point, what was observed, and how it failed.
fn rows(
    sweep: &Sweep,
    journal: &Journal,
    mut each: impl FnMut(usize, &[f64], f64),
) -> Result<(), Trouble> {
    journal.read(sweep, |first, rows| -> Result<(), Trouble> {
        for (index, row) in rows.chunks_exact(sweep.width()).enumerate() {
            let (observed, code) = row.split_at(sweep.observed.len());
            each(first + index, observed, code[0]);
        }
        Ok(())
    })
}
