//! Numbers side by side: one operation on all of them at once.

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// `L` numbers, each of a motion of its own. An operation gives each what it would give it alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Pack<T, const L: usize>(pub [T; L]);

/// The number of each lane, given which it is. Neither closures nor `array::from_fn` are always inlined into code for other registers.
macro_rules! each_lane {
    ($lane:ident => $value:expr) => {{
        let mut numbers = [T::zero(); L];
        let mut $lane = 0;
        while $lane < L {
            numbers[$lane] = $value;
            $lane += 1;
        }
        Pack(numbers)
    }};
}
pub(super) use each_lane;

macro_rules! lane_by_lane {
    ($($operation:ident $method:ident $sign:tt,)*) => {$(
        impl<T: Scalar, const L: usize> $operation for Pack<T, L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, y: Self) -> Self {
                each_lane!(lane => self.0[lane] $sign y.0[lane])
            }
        }
    )*};
}

lane_by_lane! { Add add +, Sub sub -, Mul mul *, Div div /, }

impl<T: Scalar, const L: usize> Neg for Pack<T, L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each_lane!(lane => -self.0[lane])
    }
}
