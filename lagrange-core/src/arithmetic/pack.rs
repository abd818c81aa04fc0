//! Numbers side by side: one operation on all of them at once.

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

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
