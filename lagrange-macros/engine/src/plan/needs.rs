//! Sets of needs: which parts of the core's work ask for a value.

use crate::derive::NeedId;

/// A set of needs, canonical: need 0 is always held, so a set with it is the set `{0}`.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub struct OutputMask(Vec<u64>);

impl OutputMask {
    /// The set that is always held.
    pub fn always() -> OutputMask {
        OutputMask(vec![1])
    }

    /// The set of one need.
    pub fn single(need: NeedId) -> OutputMask {
        OutputMask::default().with(need)
    }

    /// This set and one need more.
    pub fn with(mut self, need: NeedId) -> OutputMask {
        if need.0 == 0 || self.is_always() {
            return OutputMask::always();
        }
        let (word, bit) = (need.0 / 64, need.0 % 64);
        if self.0.len() <= word {
            self.0.resize(word + 1, 0);
        }
        self.0[word] |= 1 << bit;
        self
    }

    /// Adds another set; says whether this one grew.
    pub fn join(&mut self, other: &OutputMask) -> bool {
        if self.is_always() {
            return false;
        }
        if other.is_always() {
            *self = OutputMask::always();
            return true;
        }
        if self.0.len() < other.0.len() {
            self.0.resize(other.0.len(), 0);
        }
        let mut grew = false;
        for (mine, theirs) in self.0.iter_mut().zip(&other.0) {
            grew |= theirs & !*mine != 0;
            *mine |= theirs;
        }
        grew
    }

    /// Whether it is the set that is always held.
    pub fn is_always(&self) -> bool {
        self.0.first().is_some_and(|word| word & 1 == 1)
    }

    /// Whether nothing asks.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }

    /// Number of needs in it.
    pub fn len(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Bits of each word of the mask; trailing words that are zero are left out.
    pub fn words(&self) -> &[u64] {
        &self.0
    }

    /// Whether a block with these needs runs while `held` (words of a mask) is held.
    pub fn runs(&self, held: &[u64]) -> bool {
        self.is_always() || self.0.iter().zip(held).any(|(mine, held)| mine & held != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn need_zero_absorbs() {
        let mut set = OutputMask::single(NeedId(70)).with(NeedId(3));
        assert_eq!(set.len(), 2);
        assert!(!set.join(&OutputMask::single(NeedId(3))));
        assert!(set.join(&OutputMask::single(NeedId(0))));
        assert_eq!(set, OutputMask::always());
        assert_eq!(OutputMask::always().with(NeedId(5)), OutputMask::always());
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
