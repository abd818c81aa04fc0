//! A rank that works.

use super::crew::Crew;
use super::{ANSWER, ASK, BYE, DONE, END, GLANCE, PATIENCE, PAUSE, STOP, WRITING};
use crate::sweep::Sweep;
use mpi::Tag;
use mpi::topology::SimpleCommunicator;
use mpi::traits::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Works until it is told to stop, and waits until it is told to end; ends the process if rank 0 no longer answers.
pub(super) fn work(world: &SimpleCommunicator, sweep: &Arc<Sweep>, workers: usize) {
    let leader = world.process_at_rank(0);
    let crew = Crew::new(sweep, workers);
    let mut hand = 0;
    // When it asked, if it waits for an answer; and when to ask next.
    let mut asked: Option<Instant> = None;
    let mut next = Instant::now();
    loop {
        let idle = match asked {
            None if hand < crew.most && Instant::now() >= next => Duration::ZERO,
            _ => GLANCE,
        };
        if let Some((chunk, mut rows)) = crew.finished(idle) {
            rows.insert(0, chunk as f64);
            send(world, DONE, &rows);
            hand -= 1;
        }
        if let Some((message, _)) = leader.immediate_matched_probe_with_tag(ANSWER) {
            let (answer, _) = message.matched_receive::<i64>();
            asked = None;
            match usize::try_from(answer) {
                Ok(chunk) => {
                    crew.begin(chunk);
                    hand += 1;
                }
                Err(_) if answer == STOP => break,
                Err(_) => next = Instant::now() + PAUSE,
            }
        }
        match asked {
            None if hand < crew.most && Instant::now() >= next => {
                send(world, ASK, &[]);
                asked = Some(Instant::now());
            }
            Some(since) if since.elapsed() > PATIENCE => gone(world),
            _ => {}
        }
    }
    send(world, BYE, &[]);
    let since = Instant::now();
    while since.elapsed() < WRITING {
        match leader.immediate_matched_probe_with_tag(ANSWER) {
            None => std::thread::sleep(GLANCE),
            Some((message, _)) => {
                let (answer, _) = message.matched_receive::<i64>();
                if answer == END {
                    return;
                }
            }
        }
    }
    gone(world);
}

/// Sends to rank 0, which may have died.
fn send(world: &SimpleCommunicator, tag: Tag, numbers: &[f64]) {
    let leader = world.process_at_rank(0);
    let since = Instant::now();
    mpi::request::scope(|scope| {
        let mut sending = leader.immediate_send_with_tag(scope, numbers, tag);
        while let Err(still) = sending.test() {
            sending = still;
            if since.elapsed() > PATIENCE {
                gone(world);
            }
            std::thread::sleep(GLANCE / 10);
        }
    });
}

/// Ends the process: a message under way cannot be given up otherwise.
fn gone(world: &SimpleCommunicator) -> ! {
    let rank = world.rank();
    eprintln!(
        "lagrange: rank {rank}: rank 0 no longer answers; the same command goes on from what it has kept"
    );
    std::process::exit(1);
}
