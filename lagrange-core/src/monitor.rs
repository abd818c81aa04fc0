//! A run seen, and stopped, from another thread.

use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::Arc;

/// What other threads see of a run, and how they stop it. A clone is another handle of the same.
///
/// Given to [`Simulation::monitor`](crate::Simulation::monitor); one run at a time tells it its time.
#[derive(Clone, Debug, Default)]
pub struct Monitor(Arc<Shared>);

#[derive(Debug, Default)]
struct Shared {
    /// Bits of the time.
    time: AtomicU64,
    stopped: AtomicBool,
}

impl Monitor {
    /// Ends the run after the step in hand, with [`Error::Interrupted`](crate::Error::Interrupted), and every run that begins later.
    pub fn stop(&self) {
        self.0.stopped.store(true, Relaxed);
    }

    /// Whether it was stopped.
    pub fn is_stopped(&self) -> bool {
        self.0.stopped.load(Relaxed)
    }

    /// How far the run has come, s; 0 before it begins. After the run, while its energy is booked
    /// ([`Trajectory::ledger`](crate::trajectory::Trajectory::ledger)), how far the books are.
    pub fn time(&self) -> f64 {
        f64::from_bits(self.0.time.load(Relaxed))
    }

    pub(crate) fn tell(&self, time: f64) {
        self.0.time.store(time.to_bits(), Relaxed);
    }
}
