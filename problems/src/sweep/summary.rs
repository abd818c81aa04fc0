//! What came out of a sweep, in a few numbers.

use super::{Journal, Sweep, Trouble};

/// One column of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Runs that have it.
    pub count: usize,
    /// Smallest value.
    pub least: f64,
    /// Largest value.
    pub greatest: f64,
    /// Mean.
    pub mean: f64,
    /// Sum of squared deviations from the mean.
    squares: f64,
}

impl Column {
    /// Standard deviation.
    pub fn deviation(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// Takes a value (Welford 1962).
    fn take(&mut self, value: f64) {
        if value.is_nan() {
            return;
        }
        self.count += 1;
        self.least = self.least.min(value);
        self.greatest = self.greatest.max(value);
        let off = value - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (value - self.mean);
    }
}

/// All columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of runs.
    pub runs: usize,
    /// Runs that failed.
    pub failed: usize,
    /// What was observed.
    pub columns: Vec<Column>,
}

impl Summary {
    /// Of everything in a journal.
    ///
    /// # Errors
    /// It is not complete.
    pub fn new(sweep: &Sweep, journal: &Journal) -> Result<Self, Trouble> {
        let column = |name: &str| Column {
            name: name.to_owned(),
            count: 0,
            least: f64::INFINITY,
            greatest: f64::NEG_INFINITY,
            mean: 0.0,
            squares: 0.0,
        };
        let mut summary = Self {
            runs: sweep.points.len(),
            failed: 0,
            columns: sweep.observed.iter().map(|o| column(&o.name)).collect(),
        };
        journal.read(sweep, |_, rows| -> Result<(), Trouble> {
            for row in rows.chunks_exact(sweep.width()) {
                summary.failed += usize::from(row[sweep.width() - 1] != 0.0);
                for (column, value) in summary.columns.iter_mut().zip(row) {
                    column.take(*value);
                }
            }
            Ok(())
        })?;
        Ok(summary)
    }
}
