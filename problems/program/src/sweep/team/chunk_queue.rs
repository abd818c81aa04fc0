//! Who has which chunk in hand.

use std::collections::{BTreeMap, VecDeque};

/// Chunks that are to be done, and those that are being done.
pub(super) struct ChunkQueue {
    fresh: VecDeque<usize>,
    /// Given out and not back, the longest ago first.
    out: VecDeque<usize>,
    /// What each rank has in hand.
    hands: BTreeMap<i32, Vec<usize>>,
}

impl ChunkQueue {
    /// With these chunks to do.
    pub(super) fn new(chunks: impl Iterator<Item = usize>) -> Self {
        Self {
            fresh: chunks.collect(),
            out: VecDeque::new(),
            hands: BTreeMap::new(),
        }
    }

    /// Whether all is done.
    pub(super) fn is_done(&self) -> bool {
        self.fresh.is_empty() && self.out.is_empty()
    }

    /// How many chunks a rank has in hand.
    pub(super) fn hand(&self, rank: i32) -> usize {
        self.hands.get(&rank).map_or(0, Vec::len)
    }

    /// A chunk for a rank: a fresh one, or, for who has nothing to do, the one that another has had longest.
    pub(super) fn give(&mut self, rank: i32) -> Option<usize> {
        let hand = self.hands.entry(rank).or_default();
        let chunk = match self.fresh.pop_front() {
            Some(chunk) => chunk,
            None if hand.is_empty() => self.out.pop_front()?,
            None => return None,
        };
        hand.push(chunk);
        self.out.push_back(chunk);
        Some(chunk)
    }

    /// A rank brings a chunk: whether it is the first to.
    pub(super) fn take(&mut self, rank: i32, chunk: usize) -> bool {
        if let Some(hand) = self.hands.get_mut(&rank) {
            hand.retain(|other| *other != chunk);
        }
        let open = self.out.len();
        self.out.retain(|other| *other != chunk);
        self.out.len() < open
    }
}

#[cfg(test)]
mod tests {
    use super::ChunkQueue;

    #[test]
    fn each_chunk_is_taken_once_whoever_dies() {
        let mut queue = ChunkQueue::new(0..4);
        assert_eq!((queue.give(1), queue.give(2)), (Some(0), Some(1)));
        assert_eq!((queue.give(2), queue.give(0)), (Some(2), Some(3)));
        // Who has something to do gets nothing that others do.
        assert_eq!(queue.give(2), None);
        assert!(queue.take(2, 1) && queue.take(2, 2));
        // Rank 1 is silent.
        assert_eq!(queue.give(2), Some(0));
        assert!(queue.take(0, 3) && !queue.is_done());
        // Rank 2 is silent, too.
        assert_eq!(queue.give(0), Some(0));
        assert!(queue.take(0, 0) && queue.is_done());
        // It was only slow.
        assert!(!queue.take(1, 0));
        assert_eq!((queue.give(1), queue.hand(1), queue.hand(2)), (None, 0, 1));
    }
}
