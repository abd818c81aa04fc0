//! The value and the derivative reading: nodes are numbers, slots are ignored.
//!
//! With everything inlined a tape over [`Value`] is the right-hand side that one would write by hand.

use super::{Arithmetic, Dual, Scalar};

/// Runs a tape on plain numbers.
#[derive(Clone, Debug, Default)]
pub struct Value<T>(Vec<T>);

impl<T> Value<T> {
    /// The arithmetic; it keeps a list for tapes that are data.
    pub fn new() -> Self {
        Self(Vec::new())
    }
}

/// Runs a tape of `T` on dual numbers: Jacobian columns with respect to its inputs, `N` at a time.
#[derive(Clone, Debug, Default)]
pub struct Derivative<T, const N: usize>(Vec<Dual<T, N>>);

impl<T, const N: usize> Derivative<T, N> {
    /// The arithmetic; it keeps a list for tapes that are data.
    pub fn new() -> Self {
        Self(Vec::new())
    }
}

macro_rules! direct {
    ([$($generics:tt)*] $reading:ty, $node:ty, $lift:expr) => {
        impl<$($generics)*> Arithmetic for $reading {
            type Scalar = T;
            type Node = $node;
            #[inline(always)]
            fn lend(&mut self) -> Vec<$node> {
                core::mem::take(&mut self.0)
            }
            #[inline(always)]
            fn give_back(&mut self, list: Vec<$node>) {
                self.0 = list;
            }
            #[inline(always)]
            fn constant(&mut self, _: usize, c: T) -> $node {
                $lift(c)
            }
            #[inline(always)]
            fn add(&mut self, _: usize, x: $node, y: $node) -> $node {
                x + y
            }
            #[inline(always)]
            fn sub(&mut self, _: usize, x: $node, y: $node) -> $node {
                x - y
            }
            #[inline(always)]
            fn neg(&mut self, _: usize, x: $node) -> $node {
                -x
            }
            #[inline(always)]
            fn offset(&mut self, _: usize, c: T, x: $node) -> $node {
                $lift(c) + x
            }
            #[inline(always)]
            fn scale(&mut self, _: usize, c: T, x: $node) -> $node {
                $lift(c) * x
            }
            #[inline(always)]
            fn mul(&mut self, _: usize, x: $node, y: $node) -> $node {
                x * y
            }
            #[inline(always)]
            fn square(&mut self, _: usize, x: $node) -> $node {
                x * x
            }
            #[inline(always)]
            fn div(&mut self, _: usize, x: $node, y: $node) -> $node {
                x / y
            }
            #[inline(always)]
            fn ratio(&mut self, _: usize, c: T, x: $node) -> $node {
                $lift(c) / x
            }
            #[inline(always)]
            fn sqrt(&mut self, _: usize, x: $node) -> $node {
                x.sqrt()
            }
            #[inline(always)]
            fn powf(&mut self, _: usize, x: $node, c: f64) -> $node {
                x.powf(c)
            }
            #[inline(always)]
            fn exp(&mut self, _: usize, x: $node) -> $node {
                x.exp()
            }
            #[inline(always)]
            fn ln(&mut self, _: usize, x: $node) -> $node {
                x.ln()
            }
            #[inline(always)]
            fn sin_cos(&mut self, _: usize, x: $node) -> ($node, $node) {
                x.sin_cos()
            }
            #[inline(always)]
            fn sinh_cosh(&mut self, _: usize, x: $node) -> ($node, $node) {
                x.sinh_cosh()
            }
            #[inline(always)]
            fn tan(&mut self, _: usize, x: $node) -> $node {
                x.tan()
            }
            #[inline(always)]
            fn tanh(&mut self, _: usize, x: $node) -> $node {
                x.tanh()
            }
            #[inline(always)]
            fn asin(&mut self, _: usize, x: $node) -> $node {
                x.asin()
            }
            #[inline(always)]
            fn acos(&mut self, _: usize, x: $node) -> $node {
                x.acos()
            }
            #[inline(always)]
            fn atan(&mut self, _: usize, x: $node) -> $node {
                x.atan()
            }
            #[inline(always)]
            fn atan2(&mut self, _: usize, y: $node, x: $node) -> $node {
                y.atan2(x)
            }
        }
    };
}

direct!([T: Scalar] Value<T>, T, |c| c);
direct!([T: Scalar, const N: usize] Derivative<T, N>, Dual<T, N>, Dual::constant);
