//! A random point: what every symbol is worth there, and which side of every branch holds.

use super::super::Symbol;
use super::{Angles, Prime};
use crate::sorted::SortedMap;

/// Why an expression has no value at a point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Trouble {
    /// A divisor is 0 here.
    Division,
    /// What is under a root is no square here; about half of all points are better.
    NotSquare,
    /// Nothing in the field stands for it.
    Beyond,
}

/// A value, or why there is none.
pub type FieldValue = Result<u64, Trouble>;

/// A random point of a field.
#[derive(Clone, Debug)]
pub struct Point<'a> {
    pub(super) field: Prime,
    seed: u64,
    pub(super) angles: &'a Angles,
    bound: SortedMap<Symbol, u64>,
    /// Branches on their `then` side; the others are on the other.
    pub(super) branches: Vec<usize>,
    pub(super) exact: bool,
    pub(super) roots: bool,
}

impl<'a> Point<'a> {
    /// The point of a seed.
    pub fn new(field: Prime, seed: u64, angles: &'a Angles) -> Point<'a> {
        Point {
            field,
            seed,
            angles,
            bound: SortedMap::new(),
            branches: Vec::new(),
            exact: true,
            roots: false,
        }
    }

    /// The field.
    pub fn field(&self) -> Prime {
        self.field
    }

    /// A random element, always the same for the same words.
    pub fn random(&self, kind: u64, key: u64) -> u64 {
        let mut x = self.seed ^ kind.wrapping_mul(0xd6e8_feb8_6659_fd93);
        for word in [key, key.rotate_left(32), kind] {
            // splitmix64 (Steele, Lea & Flood, OOPSLA 2014)
            x = (x ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
            x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            x ^= x >> 31;
        }
        self.field.element(x)
    }

    /// Gives a symbol a value.
    pub fn bind(&mut self, symbol: Symbol, value: u64) {
        self.bound.insert(symbol, value);
    }

    /// Value of a symbol: bound, or random.
    pub fn symbol(&self, symbol: Symbol) -> u64 {
        match self.bound.get(&symbol) {
            Some(&value) => value,
            None => self.random(SYMBOL, symbol.index() as u64),
        }
    }

    /// Puts a branch on its `then` side.
    pub fn choose(&mut self, branch: usize) {
        self.branches.push(branch);
    }

    /// Whether all values so far were made of independent atoms: then an expression that is not zero here is not zero.
    /// Values of inverse functions, logarithms and general powers are atoms that may depend on others.
    pub fn is_exact(&self) -> bool {
        self.exact
    }

    /// Whether roots of what is not a number have been taken. A root of a perfect square has a random sign, so such
    /// expressions need as many points as there should be signs.
    pub fn has_roots(&self) -> bool {
        self.roots
    }
}

/// Key of symbols in [`Point::random`].
const SYMBOL: u64 = 1;
