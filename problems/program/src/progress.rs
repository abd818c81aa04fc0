//! How far a piece of work has come, told from the thread that does it to one that watches; and back, that it is to end.
//!
//! Work is a number of stages of about the same length. A stage that is one run up to a known time also counts in part.

use core::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use lagrange_core::Monitor;
use std::sync::Arc;

/// A handle of what is shared; a clone is another one of the same.
#[derive(Clone, Debug, Default)]
pub struct Progress {
    monitor: Monitor,
    counts: Arc<Counts>,
}

#[derive(Debug, Default)]
struct Counts {
    stages: AtomicUsize,
    done: AtomicUsize,
    /// Bits of the time at which the run in hand ends; 0 if the stage is no such run.
    until: AtomicU64,
}

impl Progress {
    /// There are this many more stages.
    pub fn expect(&self, stages: usize) {
        self.counts.stages.fetch_add(stages, Relaxed);
    }

    /// The stage in hand is a run that ends at this time, s, or earlier.
    pub fn runs_until(&self, time: f64) {
        self.counts.until.store(time.to_bits(), Relaxed);
    }

    /// So many stages more are done.
    pub fn advance(&self, stages: usize) {
        self.counts.until.store(0, Relaxed);
        self.counts.done.fetch_add(stages, Relaxed);
    }

    /// The part that is done, from 0 to 1; `None` while nobody has said how much there is to do.
    pub fn part(&self) -> Option<f64> {
        let stages = self.counts.stages.load(Relaxed);
        let until = f64::from_bits(self.counts.until.load(Relaxed));
        let share = match until > 0.0 {
            true => (self.monitor.time() / until).clamp(0.0, 1.0),
            false => 0.0,
        };
        let done = self.counts.done.load(Relaxed) as f64 + share;
        (stages > 0).then(|| (done / stages as f64).min(1.0))
    }

    /// What a run tells its time to.
    pub fn monitor(&self) -> &Monitor {
        &self.monitor
    }

    /// The work is to end as soon as it can.
    pub fn stop(&self) {
        self.monitor.stop();
    }

    /// Whether it is.
    pub fn is_stopped(&self) -> bool {
        self.monitor.is_stopped()
    }
}

#[cfg(test)]
mod tests {
    use super::Progress;

    #[test]
    fn stages_and_parts_of_a_run_add_up() {
        let progress = Progress::default();
        assert_eq!(progress.part(), None);
        progress.expect(4);
        assert_eq!(progress.part(), Some(0.0));
        progress.advance(1);
        progress.runs_until(10.0);
        assert_eq!(progress.part(), Some(0.25));
        progress.expect(1);
        assert_eq!(progress.part(), Some(0.2));
        progress.stop();
        assert!(progress.is_stopped() && progress.clone().monitor().is_stopped());
    }
}
