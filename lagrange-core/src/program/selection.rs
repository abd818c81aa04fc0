//! What of a program is asked for, and where its numbers are found.

use crate::arithmetic::Scalar;

/// Where a number of the description is found after a program has run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueRef {
    /// Structurally zero: never computed, never multiplied.
    Zero,
    /// Depends on parameters only: index into the constants.
    Constant(usize),
    /// Index into the outputs of the program.
    Node(usize),
}

impl ValueRef {
    /// Whether the number changes with the state; others depend on parameters only.
    #[inline]
    pub(crate) fn varies(self) -> bool {
        matches!(self, ValueRef::Node(_))
    }

    /// The number there, given the constants and the outputs.
    #[inline]
    pub(crate) fn read<T: Scalar>(self, constants: &[T], outputs: &[T]) -> T {
        match self {
            ValueRef::Zero => T::zero(),
            ValueRef::Constant(index) => constants[index],
            ValueRef::Node(index) => outputs[index],
        }
    }
}

/// A set of needs: which parts of a program must run. Bit `i` is need `i` of the description.
pub type Needs = [u64];

/// What of a program runs.
#[derive(Clone, Copy, Debug)]
pub struct Selection<'a> {
    /// The needs to be met; a block runs only if one of its needs is here.
    pub needs: &'a Needs,
    /// Bit `i`: piecewise branch `i` is on its `then` side (its guard is ≥ 0).
    pub branches: &'a [u64],
}

impl Selection<'_> {
    /// Whether branch `index` is on its `then` side.
    #[inline(always)]
    pub fn branch(&self, index: usize) -> bool {
        self.branches[index / 64] >> (index % 64) & 1 == 1
    }
}
