//! Messages of rank 0, which must not wait for anybody: over a network MPI keeps who sends to a dead rank waiting for ever.

use super::{ANSWER, END, PATIENCE, WAIT};
use mpi::Tag;
use mpi::request::{Request, StaticScope};
use mpi::topology::{Rank, SimpleCommunicator};
use mpi::traits::*;
use std::time::Instant;

/// What rank 0 has to say, and what of it is still under way.
pub(super) struct Post {
    world: SimpleCommunicator,
    /// END, STOP, WAIT, 0, 1, … They stay where they are: a message that never arrives keeps
    /// its place in memory.
    answers: &'static [i64],
    sending: Vec<Request<'static, i64, StaticScope>>,
}

impl Post {
    /// With answers up to this number of chunks.
    pub(super) fn new(world: SimpleCommunicator, chunks: usize) -> Self {
        let answers: Vec<i64> = (END..chunks as i64).collect();
        Self {
            world,
            answers: answers.leak(),
            sending: Vec::new(),
        }
    }

    /// Number of ranks.
    pub(super) fn ranks(&self) -> Rank {
        self.world.size()
    }

    /// Answers with a chunk, or that there is none.
    pub(super) fn give(&mut self, rank: Rank, chunk: Option<usize>) {
        self.say(rank, chunk.map_or(WAIT, |chunk| chunk as i64));
    }

    /// Says something to a rank, which may have died.
    pub(super) fn say(&mut self, rank: Rank, answer: i64) {
        let place = usize::try_from(answer - END).ok();
        if let Some(answer) = place.and_then(|place| self.answers.get(place)) {
            let rank = self.world.process_at_rank(rank);
            let sending = rank.immediate_send_with_tag(StaticScope, answer, ANSWER);
            self.sending.push(sending);
        }
        self.sending = self
            .sending
            .drain(..)
            .filter_map(|s| s.test().err())
            .collect();
    }

    /// Takes a message, if there is one: who sends it, what it is, what is in it.
    pub(super) fn receive(&self) -> Option<(Rank, Tag, Vec<f64>)> {
        let (message, status) = self.world.any_process().immediate_matched_probe()?;
        let count = status.count(f64::equivalent_datatype());
        let mut numbers = vec![0.0; usize::try_from(count).unwrap_or(0)];
        let since = Instant::now();
        mpi::request::scope(|scope| {
            let mut coming = message.immediate_matched_receive_into(scope, &mut numbers[..]);
            while let Err(still) = coming.test() {
                coming = still;
                if since.elapsed() > PATIENCE {
                    // A message that has begun to come cannot be given up.
                    eprintln!(
                        "lagrange: a process died while it sent results; the same command goes on from what is kept"
                    );
                    std::process::exit(1);
                }
            }
        });
        Some((status.source_rank(), status.tag(), numbers))
    }

    /// Leaves messages behind that nobody takes.
    pub(super) fn leave(&mut self) {
        self.sending.drain(..).for_each(std::mem::forget);
    }
}
