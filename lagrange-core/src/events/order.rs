//! The zeros of several guards in order of time, and which of them cannot be told apart.

use super::Root;

/// A zero of one of several guards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the guard, as the caller counts them.
    pub guard: usize,
    /// Its zero.
    pub root: Root,
}

impl Hit {
    fn lower(&self) -> f64 {
        self.root.s - 0.5 * self.root.width
    }

    fn upper(&self) -> f64 {
        self.root.s + 0.5 * self.root.width
    }
}

/// Sorts by time, equal times by guard.
pub fn sort(hits: &mut [Hit]) {
    hits.sort_unstable_by(|a, b| a.root.s.total_cmp(&b.root.s).then(a.guard.cmp(&b.guard)));
}

/// How many of the first of these sorted `hits` happen at one instant: their enclosures form a chain of overlaps.
/// 0 only for an empty slice.
pub fn simultaneous(hits: &[Hit]) -> usize {
    let mut reach = f64::NEG_INFINITY;
    hits.iter()
        .enumerate()
        .position(|(i, hit)| {
            let apart = i > 0 && hit.lower() > reach;
            reach = reach.max(hit.upper());
            apart
        })
        .unwrap_or(hits.len())
}
