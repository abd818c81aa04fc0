//! Three ways to run one tape: values, first derivatives, Taylor coefficients.
//!
//! A tape is a function generic over [`Arithmetic`]. Each operation names the slot `to` that it writes:
//! * **value**: a node is the number itself, slots are ignored, the tape compiles to plain arithmetic;
//! * **derivative**: a node is a dual number;
//! * **recording**: a node is a register. The tape is written down once per mode ([`Recording`]), made short ([`Program`]), and
//!   from then on runs as data: for values, and for Taylor coefficients k = 1, 2, … ([`Expansion`]).
//!
//! Operations with a second result or an auxiliary series (`sin_cos`, `tan`, `asin`, …) own the slots `to` and `to + 1`.

mod direct;
mod dual;
mod expansion;
mod instruction;
#[cfg(feature = "num-dual")]
mod num_dual;
mod numbers;
mod pack;
mod program;
mod record;
mod scalar;
#[cfg(test)]
mod tests;

pub use direct::{Derivative, Value};
pub use dual::Dual;
pub use expansion::{Expansion, MAX_ORDER, Operation};
pub use numbers::{Given, Numbers};
pub use pack::{Coefficient, Pack};
pub use program::Program;
pub use record::{Recorded, Recorder, Recording, Slot, Variation};

use crate::entries::Entries;
use core::fmt::Debug;

/// A number that parameters, states and coefficients are made of.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Debug
    + Default
    + PartialEq
    + num_traits::NumAssign
    + core::ops::Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// Orders of derivatives that a number carries: 0 for machine numbers, 1 for dual numbers.
    ///
    /// Decisions read [`Self::value`]; where they end in an instant or a projection, so many Newton steps give the derivatives.
    /// Equality must tell apart numbers that differ in derivatives only.
    const DERIVATIVES: usize = 0;
    /// The nearest number of this type.
    fn from_f64(x: f64) -> Self;
    /// The value, for decisions (step size, order of events). A dual number gives its real part.
    fn value(self) -> f64;
    /// √x
    fn sqrt(self) -> Self;
    /// eˣ
    fn exp(self) -> Self;
    /// ln x
    fn ln(self) -> Self;
    /// (sin x, cos x)
    fn sin_cos(self) -> (Self, Self);
    /// tan x
    fn tan(self) -> Self;
    /// asin x
    fn asin(self) -> Self;
    /// acos x
    fn acos(self) -> Self;
    /// atan x
    fn atan(self) -> Self;
    /// Angle of the point (x, y), y = self.
    fn atan2(self, x: Self) -> Self;
    /// (sinh x, cosh x)
    fn sinh_cosh(self) -> (Self, Self);
    /// tanh x
    fn tanh(self) -> Self;
    /// xᶜ for a real exponent.
    fn powf(self, c: f64) -> Self;
    /// x y + z, rounded once where the processor can do that as fast.
    #[inline(always)]
    fn mul_add(self, y: Self, z: Self) -> Self {
        self * y + z
    }

    /// What a program calls of the core for this type. Machine numbers have it compiled in this crate.
    #[doc(hidden)]
    fn entries() -> &'static Entries<Self> {
        &const { Entries::OWN }
    }
}

/// A way to run a tape.
pub trait Arithmetic {
    /// The number type.
    type Scalar: Scalar;
    /// A value of the tape.
    type Node: Copy;

    /// Slots named from here on are relative to `base` (tapes and the core's own work share one table).
    #[inline(always)]
    fn origin(&mut self, base: usize) {
        let _ = base;
    }
    /// An empty list to work in, for tapes that are [data](crate::code); the one that was given back last, if it is kept.
    #[inline(always)]
    fn lend(&mut self) -> Vec<Self::Node> {
        Vec::new()
    }
    /// Takes back what was lent.
    #[inline(always)]
    fn give_back(&mut self, list: Vec<Self::Node>) {
        drop(list);
    }
    /// c
    fn constant(&mut self, to: usize, c: Self::Scalar) -> Self::Node;
    /// x + y
    fn add(&mut self, to: usize, x: Self::Node, y: Self::Node) -> Self::Node;
    /// x − y
    fn sub(&mut self, to: usize, x: Self::Node, y: Self::Node) -> Self::Node;
    /// −x
    fn neg(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// c + x
    fn offset(&mut self, to: usize, c: Self::Scalar, x: Self::Node) -> Self::Node;
    /// c x
    fn scale(&mut self, to: usize, c: Self::Scalar, x: Self::Node) -> Self::Node;
    /// x y
    fn mul(&mut self, to: usize, x: Self::Node, y: Self::Node) -> Self::Node;
    /// x²
    fn square(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// x / y
    fn div(&mut self, to: usize, x: Self::Node, y: Self::Node) -> Self::Node;
    /// c / x
    fn ratio(&mut self, to: usize, c: Self::Scalar, x: Self::Node) -> Self::Node;
    /// √x
    fn sqrt(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// xᶜ for a constant real exponent that is not a small integer (those are products).
    fn powf(&mut self, to: usize, x: Self::Node, c: f64) -> Self::Node;
    /// eˣ
    fn exp(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// ln x
    fn ln(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// (sin x, cos x) in slots to, to + 1.
    fn sin_cos(&mut self, to: usize, x: Self::Node) -> (Self::Node, Self::Node);
    /// (sinh x, cosh x) in slots to, to + 1.
    fn sinh_cosh(&mut self, to: usize, x: Self::Node) -> (Self::Node, Self::Node);
    /// tan x; owns to, to + 1.
    fn tan(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// tanh x; owns to, to + 1.
    fn tanh(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// asin x; owns to, to + 1.
    fn asin(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// acos x; owns to, to + 1.
    fn acos(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// atan x; owns to, to + 1.
    fn atan(&mut self, to: usize, x: Self::Node) -> Self::Node;
    /// Angle of the point (x, y); owns to, to + 1.
    fn atan2(&mut self, to: usize, y: Self::Node, x: Self::Node) -> Self::Node;
}
