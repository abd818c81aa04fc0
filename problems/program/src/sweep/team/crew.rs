//! Threads of a rank: numbers of chunks in, rows out.

use crate::sweep::Sweep;
use crate::sweep::work::rows;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The threads of a rank. They end with the process: nobody waits for a chunk that others have done.
pub(super) struct Crew {
    todo: Sender<usize>,
    done: Receiver<(usize, Vec<f64>)>,
    /// Chunks that may be in hand: as many again as are being done, so that no thread waits for an answer.
    pub(super) most: usize,
}

impl Crew {
    pub(super) fn new(sweep: &Arc<Sweep>, workers: usize) -> Self {
        let (todo, chunks) = channel();
        let (finished, done) = channel();
        let chunks = Arc::new(Mutex::new(chunks));
        for _ in 0..workers {
            let (sweep, chunks, finished) = (sweep.clone(), chunks.clone(), finished.clone());
            std::thread::spawn(move || {
                let work = || run(&sweep, &chunks, &finished);
                if catch_unwind(AssertUnwindSafe(work)).is_err() {
                    // Better no rank than one that keeps a chunk for ever.
                    std::process::exit(101);
                }
            });
        }
        Self {
            todo,
            done,
            most: 2 * workers,
        }
    }

    /// Hands a chunk over.
    pub(super) fn begin(&self, chunk: usize) {
        // The threads live as long as the process.
        let _ = self.todo.send(chunk);
    }

    /// A chunk that is finished, if one is within this time.
    pub(super) fn finished(&self, within: Duration) -> Option<(usize, Vec<f64>)> {
        self.done.recv_timeout(within).ok()
    }
}

fn run(sweep: &Sweep, chunks: &Mutex<Receiver<usize>>, finished: &Sender<(usize, Vec<f64>)>) {
    let mut worker = sweep.scene.worker(sweep).ok();
    loop {
        let next = chunks.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok(chunk) = next else { return };
        let rows = rows(sweep, worker.as_mut(), chunk);
        if finished.send((chunk, rows)).is_err() {
            return;
        }
    }
}
