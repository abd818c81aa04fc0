//! A fast deterministic hash. The standard one is slow in the unoptimised builds that macros run in.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Multiplicative hash: h ← (rotate(h) ⊕ word) · K with an odd K.
#[derive(Clone, Copy, Default)]
pub(super) struct Mix(u64);

impl Mix {
    pub(super) fn word(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    pub(super) fn wide(&mut self, word: i128) {
        self.word(word as u64);
        // A small number of either sign has a trivial upper half.
        if word != i128::from(word as i64) {
            self.word((word >> 64) as u64);
        }
    }
}

impl Hasher for Mix {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 29)
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.word(u64::from(byte));
        }
    }

    fn write_u32(&mut self, word: u32) {
        self.word(u64::from(word));
    }

    fn write_i128(&mut self, word: i128) {
        self.wide(word);
    }

    fn write_u64(&mut self, word: u64) {
        self.word(word);
    }
}

/// For look-ups only: never iterated.
pub(super) type Memo<K, V> = HashMap<K, V, BuildHasherDefault<Mix>>;
