//! Pieces of a long run as one run: what is told of it is kept, not the motion.

use super::{Outcome, Sample};
use lagrange_core::certificate::Certificate;
use lagrange_core::prelude::*;
use lagrange_core::trajectory::Entry;

impl Outcome {
    /// Goes on with the next piece, which begins in the mode in which this one ends.
    pub(crate) fn join(&mut self, next: Outcome) {
        (self.work, self.failure) = (next.work, next.failure);
        self.estimate = next.estimate;
        let (Some(phase), [first, rest @ ..]) = (self.phases.last_mut(), &next.phases[..]) else {
            return;
        };
        let at = first.from;
        phase.to = first.to;
        let before = self.phases.len() - 1;
        self.phases.extend_from_slice(rest);
        self.events.extend(next.events);
        self.around.extend(next.around);
        self.stiff.extend(next.stiff);
        self.stiff.dedup_by(|next, last| {
            let same = next.start == last.end;
            if same {
                last.end = next.end;
            }
            same
        });
        // What is between the pieces is no instant to be told.
        let inner = |sample: &Sample| sample.time != at;
        let kept = self.samples.iter().filter(|sample| inner(sample)).count();
        let skipped = next.samples.iter().filter(|s| !inner(s)).count();
        self.samples.truncate(kept);
        self.ledgers.truncate(kept);
        let samples = next.samples.into_iter().skip(skipped);
        let placed = |sample: Sample| Sample {
            phase: sample.phase + before,
            ..sample
        };
        self.samples.extend(samples.map(placed));
        let drawn = self.curve.iter().filter(|sample| inner(sample)).count();
        let undrawn = next.curve.iter().filter(|s| !inner(s)).count();
        self.curve.truncate(drawn);
        self.curve_ledgers.truncate(drawn);
        let curve = next.curve.into_iter().skip(undrawn);
        self.curve.extend(curve.map(placed));
        if let Some(ledger) = &self.ledger {
            let after = |piece: &Ledger| add(ledger, piece);
            let ledgers = next.curve_ledgers.iter().skip(undrawn).map(after);
            self.curve_ledgers.extend(ledgers);
            let ledgers = next.ledgers.iter().skip(skipped).map(after);
            self.ledgers.extend(ledgers);
            let ledgers = next.event_ledgers.iter().map(after);
            self.event_ledgers.extend(ledgers);
        }
        let books = self.ledger.take().zip(next.ledger);
        self.ledger = books.map(|(ledger, piece)| add(&ledger, &piece));
        if let Some(ledger) = &self.ledger {
            let all = self.ledgers.iter_mut().chain(&mut self.event_ledgers);
            let all = all.chain(&mut self.curve_ledgers);
            all.for_each(|earlier| list(&mut earlier.work, &ledger.work));
        }
        let certificates = self.certificate.take().zip(next.certificate);
        self.certificate = certificates.map(|(whole, piece)| both(whole, &piece));
    }
}

/// The ledger of a run up to some time and that of a piece from there on.
fn add(ledger: &Ledger, piece: &Ledger) -> Ledger {
    let mut work = ledger.work.clone();
    list(&mut work, &piece.work);
    for entry in &piece.work {
        let is = |known: &&mut Entry| (known.name, known.kind) == (entry.name, entry.kind);
        if let Some(known) = work.iter_mut().find(is) {
            known.work += entry.work;
        }
    }
    let (start, end) = (ledger.start, piece.end);
    let changes = [
        start.kinetic,
        end.kinetic,
        end.potential - start.potential,
        end.jacobi - start.jacobi,
    ];
    let sizes = changes.into_iter().chain(work.iter().map(|e| e.work));
    Ledger {
        scale: sizes.fold(0.0, |largest, size| size.abs().max(largest)),
        closure: ledger.closure + piece.closure,
        start,
        end,
        work,
    }
}

/// Adds the entries that are not there yet.
fn list(work: &mut Vec<Entry>, entries: &[Entry]) {
    for entry in entries {
        let is = |known: &Entry| (known.name, known.kind) == (entry.name, entry.kind);
        if !work.iter().any(is) {
            work.push(Entry {
                work: 0.0,
                ..entry.clone()
            });
        }
    }
}

/// The certificate of a run that consists of two.
fn both(mut whole: Certificate, piece: &Certificate) -> Certificate {
    whole.steps += piece.steps;
    whole.looked += piece.looked;
    whole.unevaluated += piece.unevaluated;
    for check in &piece.checks {
        let mut known = whole.checks.iter_mut();
        match known.find(|known| known.subject == check.subject) {
            None => whole.checks.push(*check),
            Some(known) => {
                let count = known.count + check.count;
                if check.figure > known.figure {
                    *known = *check;
                }
                known.count = count;
            }
        }
    }
    whole.checks.sort_by_key(|check| check.subject as usize);
    whole
}
