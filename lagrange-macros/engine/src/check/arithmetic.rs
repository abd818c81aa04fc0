//! What numbers a check can be worked out in: a finite field (exact), or floating point with error bounds.

use crate::symbolic::field::{Point, Trouble};
use crate::symbolic::{ExprId, Pool, Rational, Symbol};

/// A state in the making, and arithmetic on its numbers.
pub(super) trait Arithmetic {
    /// A number.
    type Number: Copy;

    /// Values of expressions with the symbols bound so far.
    fn values(&mut self, pool: &Pool, e: &[ExprId]) -> Result<Vec<Self::Number>, Trouble>;
    /// Gives a symbol its value.
    fn bind(&mut self, symbol: Symbol, value: Self::Number);
    /// The value of a symbol.
    fn symbol(&self, symbol: Symbol) -> Self::Number;
    /// n
    fn integer(&self, n: i64) -> Self::Number;
    /// a + b
    fn add(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// a − b
    fn sub(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// a b
    fn mul(&self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// a / b
    fn div(&self, a: Self::Number, b: Self::Number) -> Result<Self::Number, Trouble>;
    /// √a
    fn sqrt(&self, a: Self::Number) -> Result<Self::Number, Trouble>;
    /// How good a pivot it is: 0 for what may be zero.
    fn size(&self, a: Self::Number) -> f64;
}

/// A point of a finite field.
pub(super) struct Exact<'a>(pub Point<'a>);

impl Arithmetic for Exact<'_> {
    type Number = u64;

    fn values(&mut self, pool: &Pool, e: &[ExprId]) -> Result<Vec<u64>, Trouble> {
        pool.at_point(e, &mut self.0).into_iter().collect()
    }

    fn bind(&mut self, symbol: Symbol, value: u64) {
        self.0.bind(symbol, value);
    }

    fn symbol(&self, symbol: Symbol) -> u64 {
        self.0.symbol(symbol)
    }

    fn integer(&self, n: i64) -> u64 {
        self.0.field().integer(i128::from(n))
    }

    fn add(&self, a: u64, b: u64) -> u64 {
        self.0.field().add(a, b)
    }

    fn sub(&self, a: u64, b: u64) -> u64 {
        self.0.field().sub(a, b)
    }

    fn mul(&self, a: u64, b: u64) -> u64 {
        self.0.field().mul(a, b)
    }

    fn div(&self, a: u64, b: u64) -> Result<u64, Trouble> {
        let below = self.0.field().inverse(b).ok_or(Trouble::Division)?;
        Ok(self.mul(a, below))
    }

    fn sqrt(&self, a: u64) -> Result<u64, Trouble> {
        let root = self.0.field().power(a, Rational::HALF);
        root.ok_or(Trouble::NotSquare)
    }

    fn size(&self, a: u64) -> f64 {
        f64::from(u8::from(a != 0))
    }
}
