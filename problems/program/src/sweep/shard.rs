//! Parts of a sweep, for machines that do not know of each other: shard i of n has the chunks i−1, i−1+n, i−1+2n …

use core::fmt;
use core::str::FromStr;

/// One part of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shard {
    /// How many parts there are.
    of: usize,
    /// Which of them, from 1.
    part: usize,
}

impl Shard {
    /// All of a sweep.
    pub const WHOLE: Shard = Shard { of: 1, part: 1 };

    /// The part of `of` that has a chunk.
    pub fn with(chunk: usize, of: usize) -> Self {
        Self {
            of,
            part: chunk % of + 1,
        }
    }

    /// How many parts there are.
    pub fn of(self) -> usize {
        self.of
    }

    /// Whether a chunk belongs to it.
    pub fn has(self, chunk: usize) -> bool {
        chunk % self.of == self.part - 1
    }

    /// Its chunk number `index`.
    pub(super) fn chunk(self, index: usize) -> usize {
        index * self.of + self.part - 1
    }
}

/// `i/n`
impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/');
        let numbers = parts.and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((part, of)) if (1..=of).contains(&part) => Ok(Shard { part, of }),
            _ => Err("expected I/N with I from 1 to N, for example 3/8".to_owned()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.part, self.of)
    }
}
