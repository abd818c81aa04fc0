//! A sweep by many processes, on one machine or many (MPI).
//!
//! ```text
//! rank 0                 keeps the journal, gives chunks out one by one, and works
//! ranks 1, 2, …    ASK → a chunk, WAIT or STOP
//!                 DONE → number and rows of a chunk
//!                  BYE → after STOP, then END
//! ```
//!
//! Only rank 0 needs to see the folder of the sweep. When no fresh chunk is left, who has nothing to do gets one that another rank has
//! in hand, the oldest first: a rank that has died, or hangs, or is slow, is made up for without anybody having to know which it is.
//! The same chunk done twice is the same rows.

mod chunk_queue;
mod crew;
mod leader;
mod member;
mod post;

use super::launch::Place;
use super::{Journal, Sweep, Trouble};
use mpi::environment::Universe;
use mpi::topology::SimpleCommunicator;
use mpi::traits::*;
use mpi::{Tag, Threading};
use post::Post;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Asks for a chunk.
const ASK: Tag = 1;
/// Brings the rows of a chunk, its number first.
const DONE: Tag = 2;
/// Says that a rank has stopped.
const BYE: Tag = 3;
/// Answers: the number of a chunk, or one of the next.
const ANSWER: Tag = 4;
const WAIT: i64 = -1;
const STOP: i64 = -2;
/// After STOP: nothing is left to do, MPI may end.
const END: i64 = -3;

/// Between two looks for messages. Waiting in MPI itself would keep a core busy.
const GLANCE: Duration = Duration::from_millis(1);
/// Between two questions of a rank that has nothing to do.
const PAUSE: Duration = Duration::from_millis(200);
/// After this long without an answer rank 0 is taken to have died. It answers at once.
const PATIENCE: Duration = Duration::from_secs(60);
/// After this long without a word on STOP a rank is taken to have died.
const FAREWELL: Duration = Duration::from_secs(3);
/// After this long between STOP and END, which is when results are written if a rank was lost, rank 0 is taken to have died.
const WRITING: Duration = Duration::from_secs(1800);

/// The processes of a sweep.
pub struct Team {
    /// None when it has ended.
    universe: Option<Universe>,
    world: SimpleCommunicator,
    post: Post,
    /// Number of ranks that no longer answer.
    lost: usize,
}

impl Team {
    /// All processes that were started together with this one, for a sweep.
    ///
    /// # Errors
    /// The MPI library cannot be used.
    pub fn gather(place: Place, sweep: &Sweep) -> Result<Self, String> {
        let (universe, _) = mpi::initialize_with_threading(Threading::Funneled)
            .ok_or("the MPI library could not be started")?;
        let world = universe.world();
        if world.size() as usize != place.of {
            return Err(format!(
                "{} processes were started, but the MPI library that this program was built with knows of {}; build it with the \
                 one that this mpirun belongs to",
                place.of,
                world.size()
            ));
        }
        Ok(Self {
            post: Post::new(universe.world(), sweep.chunks()),
            universe: Some(universe),
            world,
            lost: 0,
        })
    }

    /// Whether this is the process that keeps the journal and writes the results.
    pub fn leads(&self) -> bool {
        self.world.rank() == 0
    }

    /// Works as any rank but the leader, with so many threads, until there is nothing left to do. The process ends if the leader no
    /// longer answers.
    pub fn follow(mut self, sweep: &Sweep, workers: usize) {
        member::work(&self.world, &Arc::new(sweep.clone()), workers);
        self.end(0);
    }

    /// Works off the chunks that the journal does not have, with all ranks; this one with so many threads. `done` is told how many
    /// points each adds. The others are free then.
    ///
    /// # Errors
    /// A chunk could not be kept.
    pub fn lead(
        &mut self,
        sweep: &Sweep,
        journal: &Journal,
        workers: usize,
        done: impl FnMut(usize),
    ) -> Result<(), Trouble> {
        let outcome = leader::work(&mut self.post, sweep, journal, workers, done);
        self.dismiss();
        outcome
    }

    /// Sends the others home.
    pub fn dismiss(&mut self) {
        self.lost = leader::dismiss(&mut self.post);
        if self.lost == 0 {
            self.end(0);
        }
    }

    /// Number of ranks that no longer answered when they were sent home.
    pub fn lost(&self) -> usize {
        self.lost
    }

    /// Ends MPI, when nothing else is left to do, with the exit code if the process must end with it. MPI waits for all ranks to end it,
    /// and has to be left behind if one hangs.
    pub fn end(&mut self, code: u8) {
        let Some(universe) = self.universe.take() else {
            return;
        };
        if self.leads() {
            leader::end(&mut self.post);
        }
        let (ended, waits) = channel::<()>();
        std::thread::spawn(move || {
            if waits.recv_timeout(3 * FAREWELL) == Err(RecvTimeoutError::Timeout) {
                std::process::exit(code.into());
            }
        });
        drop(universe);
        drop(ended);
    }
}
