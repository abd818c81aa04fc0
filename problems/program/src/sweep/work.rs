//! Workers: the chunks that are not done yet, shared out over the cores.

use super::{Journal, Sweep, Trouble, Worker};
use rayon::prelude::*;

/// Works off the chunks that the journal does not have and that are `ours`. `done` is told how many points each adds.
///
/// # Errors
/// A chunk could not be kept.
pub fn work(
    sweep: &Sweep,
    journal: &Journal,
    ours: impl Fn(usize) -> bool + Sync,
    done: impl Fn(usize) + Sync,
) -> Result<(), Trouble> {
    let missing: Vec<usize> = (0..sweep.chunks())
        .filter(|&chunk| ours(chunk) && !journal.has(sweep, chunk))
        .collect();
    missing.into_par_iter().with_max_len(1).try_for_each_init(
        // Names and numbers were checked when the sweep was made.
        || sweep.scene.worker(sweep).ok(),
        |worker, chunk| {
            journal.put(sweep, chunk, rows(sweep, worker.as_mut(), chunk))?;
            done(sweep.chunk(chunk).len());
            Ok(())
        },
    )
}

/// The rows of a chunk.
pub(super) fn rows(sweep: &Sweep, worker: Option<&mut Worker>, chunk: usize) -> Vec<f64> {
    let points = sweep.chunk(chunk);
    let mut rows = vec![f64::NAN; points.len() * sweep.width()];
    if let Some(worker) = worker {
        worker(points, &mut rows);
    }
    rows
}
