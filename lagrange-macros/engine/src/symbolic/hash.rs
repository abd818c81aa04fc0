//! A fast deterministic hash. The standard one is slow in the unoptimised builds that macros run in.

use super::{ExprId, Node, Rational};
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

/// Hash of a form.
pub(super) fn hash_of(node: &Node) -> u64 {
    let mut mix = Mix::default();
    let rational = |mix: &mut Mix, r: Rational| {
        mix.wide(r.numerator());
        mix.wide(r.denominator());
    };
    let pairs = |mix: &mut Mix, list: &[(ExprId, Rational)]| {
        for &(e, r) in list {
            mix.word(u64::from(e.0));
            rational(mix, r);
        }
    };
    match node {
        Node::Number(n) => {
            mix.word(1);
            rational(&mut mix, *n);
        }
        Node::Pi => mix.word(2),
        Node::Symbol(symbol) => {
            mix.word(3);
            mix.word(u64::from(symbol.0));
        }
        Node::Sum { constant, terms } => {
            mix.word(4);
            rational(&mut mix, *constant);
            pairs(&mut mix, terms);
        }
        Node::Product(factors) => {
            mix.word(5);
            pairs(&mut mix, factors);
        }
        Node::Power(base, exponent) => {
            mix.word(6);
            mix.word(u64::from(base.0));
            mix.word(u64::from(exponent.0));
        }
        Node::Call(f, arguments) => {
            mix.word(7 + 16 * (*f as u64));
            for e in arguments {
                mix.word(u64::from(e.0));
            }
        }
        Node::Group(e) => {
            mix.word(9);
            mix.word(u64::from(e.0));
        }
        Node::Select {
            branch,
            then,
            otherwise,
        } => {
            mix.word(8);
            mix.word(*branch as u64);
            mix.word(u64::from(then.0));
            mix.word(u64::from(otherwise.0));
        }
    }
    mix.finish()
}
