//! Sets of needs: which parts of the core's work ask for a value.

use crate::derive::NeedId;
use std::iter::repeat_n;

/// A set of needs, canonical: need 0 is always held, so a set with it is the set `{0}`.
///
/// A mask that is as long as the needs in it are far apart: of thousands of branches most values serve a few that follow one another.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub struct OutputMask {
    /// Place of the first word.
    first: usize,
    /// 64 needs each; neither the first word nor the last one is zero.
    words: Vec<u64>,
}

impl OutputMask {
    /// The set that is always held.
    pub fn always() -> OutputMask {
        OutputMask {
            first: 0,
            words: vec![1],
        }
    }

    /// The set of one need.
    pub fn single(need: NeedId) -> OutputMask {
        match need.0 {
            0 => OutputMask::always(),
            need => OutputMask {
                first: need / 64,
                words: vec![1 << (need % 64)],
            },
        }
    }

    /// Adds another set.
    pub fn join(&mut self, other: &OutputMask) {
        if self.is_always() || other.is_empty() {
            return;
        }
        if self.is_empty() || other.is_always() {
            self.clone_from(other);
            return;
        }
        if other.first < self.first {
            let missing = self.first - other.first;
            self.words.splice(..0, repeat_n(0, missing));
            self.first = other.first;
        }
        let offset = other.first - self.first;
        let length = self.words.len().max(offset + other.words.len());
        self.words.resize(length, 0);
        for (mine, theirs) in self.words[offset..].iter_mut().zip(&other.words) {
            *mine |= theirs;
        }
    }

    /// Whether it is the set that is always held.
    pub fn is_always(&self) -> bool {
        self.first == 0 && self.words.first().is_some_and(|word| word & 1 == 1)
    }

    /// Whether nothing asks.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Number of needs in it.
    pub fn len(&self) -> usize {
        let ones = self.words.iter().map(|word| word.count_ones() as usize);
        ones.sum()
    }

    /// Place of the first word of the mask that is not zero.
    pub fn first(&self) -> usize {
        self.first
    }

    /// Words of the mask from that place on; those behind them are zero.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Whether a block with these needs runs while `held` (words of a mask) is held.
    pub fn runs(&self, held: &[u64]) -> bool {
        let held = held.get(self.first..).unwrap_or_default();
        self.is_always()
            || self
                .words
                .iter()
                .zip(held)
                .any(|(mine, held)| mine & held != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn need_zero_absorbs() {
        let mut set = OutputMask::single(NeedId(700));
        set.join(&OutputMask::single(NeedId(3)));
        set.join(&OutputMask::single(NeedId(130)));
        assert_eq!((set.first(), set.words().len(), set.len()), (0, 11, 3));
        let mut same = OutputMask::single(NeedId(130));
        same.join(&OutputMask::single(NeedId(3)));
        same.join(&OutputMask::single(NeedId(700)));
        assert_eq!(set, same);
        set.join(&OutputMask::single(NeedId(0)));
        assert_eq!(set, OutputMask::always());
        set.join(&OutputMask::single(NeedId(5)));
        assert_eq!(set, OutputMask::always());
    }

    #[test]
    fn runs_when_one_of_its_needs_is_held() {
        let set = OutputMask::single(NeedId(65));
        assert!(!set.runs(&[!0, 0]));
        assert!(!set.runs(&[!0]));
        assert!(set.runs(&[0, 2]));
        assert!(OutputMask::always().runs(&[]));
    }
}
