//! Numbers side by side: one operation on all of them at once.

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// What coefficients of a Taylor series are made of: a number, or a number of each of several motions.
pub trait Coefficient:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same number in every place.
    fn of(x: f64) -> Self;
    /// x y + z, rounded as [`Scalar::mul_add`] rounds.
    fn mul_add(self, y: Self, z: Self) -> Self;
}

impl<T: Scalar> Coefficient for T {
    #[inline(always)]
    fn of(x: f64) -> Self {
        T::from_f64(x)
    }

    #[inline(always)]
    fn mul_add(self, y: Self, z: Self) -> Self {
        Scalar::mul_add(self, y, z)
    }
}

/// `L` numbers, each of a motion of its own. An operation gives each what it would give it alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Pack<T, const L: usize>(pub [T; L]);

impl<T: Scalar, const L: usize> Pack<T, L> {
    #[inline(always)]
    fn zip(self, y: Self, f: impl Fn(T, T) -> T) -> Self {
        Self(core::array::from_fn(|lane| f(self.0[lane], y.0[lane])))
    }
}

macro_rules! lane_by_lane {
    ($($operation:ident $method:ident $sign:tt,)*) => {$(
        impl<T: Scalar, const L: usize> $operation for Pack<T, L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, y: Self) -> Self {
                self.zip(y, |x, y| x $sign y)
            }
        }
    )*};
}

lane_by_lane! { Add add +, Sub sub -, Mul mul *, Div div /, }

impl<T: Scalar, const L: usize> Neg for Pack<T, L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl<T: Scalar, const L: usize> Coefficient for Pack<T, L> {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self([T::from_f64(x); L])
    }

    #[inline(always)]
    fn mul_add(self, y: Self, z: Self) -> Self {
        Self(core::array::from_fn(|lane| {
            Scalar::mul_add(self.0[lane], y.0[lane], z.0[lane])
        }))
    }
}
