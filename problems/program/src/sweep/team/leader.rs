//! Rank 0: gives chunks out, keeps what comes back, and works.

use super::chunk_queue::ChunkQueue;
use super::crew::Crew;
use super::post::Post;
use super::{ASK, BYE, DONE, END, FAREWELL, GLANCE, STOP};
use crate::sweep::{Journal, Sweep, Trouble};
use mpi::topology::Rank;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

/// Has all chunks done that the journal does not have.
///
/// # Errors
/// A chunk could not be kept.
pub(super) fn work(
    post: &mut Post,
    sweep: &Sweep,
    journal: &Journal,
    workers: usize,
    mut done: impl FnMut(usize),
) -> Result<(), Trouble> {
    let open = (0..sweep.chunks()).filter(|&chunk| !journal.has(sweep, chunk));
    let mut queue = ChunkQueue::new(open);
    let crew = Crew::new(&Arc::new(sweep.clone()), workers);
    let mut keep = |queue: &mut ChunkQueue, rank, chunk: usize, rows: Vec<f64>| {
        if queue.take(rank, chunk) {
            journal.put(sweep, chunk, rows)?;
            done(sweep.chunk(chunk).len());
        }
        Ok(())
    };
    while !queue.is_done() {
        while queue.hand(0) < crew.most
            && let Some(chunk) = queue.give(0)
        {
            crew.begin(chunk);
        }
        if let Some((chunk, rows)) = crew.finished(GLANCE) {
            keep(&mut queue, 0, chunk, rows)?;
        }
        while let Some((rank, tag, mut rows)) = post.receive() {
            if tag == DONE && !rows.is_empty() {
                let chunk = rows.remove(0) as usize;
                keep(&mut queue, rank, chunk, rows)?;
            } else if tag == ASK {
                post.give(rank, queue.give(rank));
            }
        }
    }
    Ok(())
}

/// Tells all ranks to stop, and waits for their goodbyes: how many do not say it.
pub(super) fn dismiss(post: &mut Post) -> usize {
    let mut there: BTreeSet<Rank> = (1..post.ranks()).collect();
    for rank in &there {
        post.say(*rank, STOP);
    }
    let mut heard = Instant::now();
    while !there.is_empty() && heard.elapsed() < FAREWELL {
        match post.receive() {
            None => std::thread::sleep(GLANCE),
            Some((rank, BYE, _)) => {
                there.remove(&rank);
                heard = Instant::now();
            }
            Some(_) => {}
        }
    }
    there.len()
}

/// Tells all ranks that MPI may end.
pub(super) fn end(post: &mut Post) {
    for rank in 1..post.ranks() {
        post.say(rank, END);
    }
    post.leave();
}
