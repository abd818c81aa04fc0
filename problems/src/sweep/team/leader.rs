//! Rank 0: gives chunks out, keeps what comes back, and works.

use super::crew::Crew;
use super::office::Office;
use super::{ANSWER, ASK, BYE, DONE, END, FAREWELL, GLANCE, STOP, WAIT};
use crate::sweep::{Journal, Sweep, Trouble};
use mpi::Tag;
use mpi::topology::{Rank, SimpleCommunicator};
use mpi::traits::*;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

/// Has all chunks done that the journal does not have.
///
/// # Errors
/// A chunk could not be kept.
pub(super) fn work(
    world: &SimpleCommunicator,
    sweep: &Sweep,
    journal: &Journal,
    workers: usize,
    mut done: impl FnMut(usize),
) -> Result<(), Trouble> {
    let open = (0..sweep.chunks()).filter(|&chunk| !journal.has(sweep, chunk));
    let mut office = Office::new(open);
    let crew = Crew::new(&Arc::new(sweep.clone()), workers);
    let mut keep = |office: &mut Office, rank, chunk: usize, rows: Vec<f64>| {
        if office.take(rank, chunk) {
            journal.put(sweep, chunk, rows)?;
            done(sweep.chunk(chunk).len());
        }
        Ok(())
    };
    while !office.is_done() {
        while office.hand(0) < crew.most
            && let Some(chunk) = office.give(0)
        {
            crew.begin(chunk);
        }
        if let Some((chunk, rows)) = crew.finished(GLANCE) {
            keep(&mut office, 0, chunk, rows)?;
        }
        while let Some((rank, tag, mut rows)) = receive(world) {
            if tag == DONE && !rows.is_empty() {
                let chunk = rows.remove(0) as usize;
                keep(&mut office, rank, chunk, rows)?;
            } else if tag == ASK {
                let chunk = office.give(rank);
                answer(world, rank, chunk.map_or(WAIT, |chunk| chunk as i64));
            }
        }
    }
    Ok(())
}

/// Tells all ranks to stop, and waits for their goodbyes: how many do not say it.
pub(super) fn dismiss(world: &SimpleCommunicator) -> usize {
    let mut there: BTreeSet<Rank> = (1..world.size()).collect();
    for rank in &there {
        answer(world, *rank, STOP);
    }
    let mut heard = Instant::now();
    while !there.is_empty() && heard.elapsed() < FAREWELL {
        match receive(world) {
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
pub(super) fn end(world: &SimpleCommunicator) {
    for rank in 1..world.size() {
        answer(world, rank, END);
    }
}

/// A short message, which is on its way at once, also to a rank that has died.
fn answer(world: &SimpleCommunicator, rank: Rank, answer: i64) {
    world.process_at_rank(rank).send_with_tag(&answer, ANSWER);
}

/// Takes a message, if there is one: who sends it, what it is, what is in it.
fn receive(world: &SimpleCommunicator) -> Option<(Rank, Tag, Vec<f64>)> {
    let message = world.any_process().immediate_matched_probe()?;
    let (numbers, status) = message.matched_receive_vec();
    Some((status.source_rank(), status.tag(), numbers))
}
