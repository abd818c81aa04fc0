//! The numbers that runs are made of: machine numbers, dual numbers, and several side by side.

mod dual;
pub(crate) mod fours;
#[cfg(feature = "num-dual")]
mod num_dual;
pub(crate) mod number;
mod pack;
pub(crate) mod products;
pub(crate) mod quad;
pub(crate) mod registers;
mod scalar;
#[cfg(test)]
mod tests;

pub use dual::Dual;
pub(crate) use number::{
    GOLDEN, LIGHT, Number, derivatives, epsilon, is_spread, positive_definite, rounding, uneven,
    within_one,
};
pub(crate) use pack::Pack;
pub(crate) use registers::Registers;

use core::fmt::Debug;

/// A number that parameters, states and coefficients are made of.
#[diagnostic::on_unimplemented(
    message = "systems cannot be made of `{Self}`",
    label = "not a number that runs are made of",
    note = "numbers are `f64`, `f32` and `Dual`"
)]
pub trait Scalar:
    fours::Fours
    + nalgebra::Scalar
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
    /// x y + z, rounded once, for code that is compiled for [`Registers`].
    #[doc(hidden)]
    #[inline(always)]
    fn fused(self, y: Self, z: Self) -> Self {
        self * y + z
    }
}
