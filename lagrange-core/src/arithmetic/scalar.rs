//! The machine numbers as [`Scalar`].

use super::{Scalar, within_one};

macro_rules! machine_number {
    ($type:ident) => {
        impl Scalar for $type {
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $type
            }
            #[inline(always)]
            fn value(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $type::sqrt(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $type::exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $type::ln(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $type::sin_cos(self)
            }
            #[inline(always)]
            fn tan(self) -> Self {
                $type::tan(self)
            }
            #[inline(always)]
            fn asin(self) -> Self {
                $type::asin(within_one(self))
            }
            #[inline(always)]
            fn acos(self) -> Self {
                $type::acos(within_one(self))
            }
            #[inline(always)]
            fn atan(self) -> Self {
                $type::atan(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $type::atan2(self, x)
            }
            #[inline(always)]
            fn sinh_cosh(self) -> (Self, Self) {
                ($type::sinh(self), $type::cosh(self))
            }
            #[inline(always)]
            fn tanh(self) -> Self {
                $type::tanh(self)
            }
            #[inline(always)]
            fn powf(self, c: f64) -> Self {
                $type::powf(self, c as $type)
            }
            #[inline(always)]
            fn mul_add(self, y: Self, z: Self) -> Self {
                if cfg!(target_feature = "fma") {
                    $type::mul_add(self, y, z)
                } else {
                    self * y + z
                }
            }
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
            #[inline(always)]
            fn fused(self, y: Self, z: Self) -> Self {
                $type::mul_add(self, y, z)
            }
        }
    };
}

machine_number!(f64);
machine_number!(f32);
