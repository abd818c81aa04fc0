//! The machine numbers as [`Scalar`].

use super::Scalar;

/// Four numbers in a register.
#[cfg(target_arch = "x86_64")]
macro_rules! in_registers {
    ($type:ident, $four:ident, $set:ident.$setter:ident, $fma:ident) => {
        type Four = core::arch::x86_64::$four;
        const IN_REGISTERS: bool = true;
        #[inline(always)]
        fn zeros() -> Self::Four {
            pulp::cast([0.0 as $type; $crate::arithmetic::products::GROUP])
        }
        #[inline(always)]
        fn four(
            registers: $crate::arithmetic::Registers,
            x: [Self; $crate::arithmetic::products::GROUP],
        ) -> Self::Four {
            registers.$set.$setter(x[0], x[1], x[2], x[3])
        }
        #[inline(always)]
        fn numbers(four: Self::Four) -> [Self; $crate::arithmetic::products::GROUP] {
            pulp::cast(four)
        }
        #[inline(always)]
        fn add_products(
            registers: $crate::arithmetic::Registers,
            x: Self::Four,
            y: Self::Four,
            z: Self::Four,
        ) -> Self::Four {
            registers.fma.$fma(x, y, z)
        }
    };
}

/// Four numbers in memory.
macro_rules! one_by_one {
    () => {
        type Four = [Self; $crate::arithmetic::products::GROUP];
        #[inline(always)]
        fn zeros() -> Self::Four {
            [Self::from_f64(0.0); $crate::arithmetic::products::GROUP]
        }
        #[inline(always)]
        fn four(_: $crate::arithmetic::Registers, numbers: Self::Four) -> Self::Four {
            numbers
        }
        #[inline(always)]
        fn numbers(four: Self::Four) -> Self::Four {
            four
        }
        #[inline(always)]
        fn add_products(
            _: $crate::arithmetic::Registers,
            x: Self::Four,
            y: Self::Four,
            z: Self::Four,
        ) -> Self::Four {
            $crate::arithmetic::number::add_one_by_one(x, y, z)
        }
    };
}
pub(super) use one_by_one;

macro_rules! machine_number {
    ($type:ident, $four:ident, $set:ident.$setter:ident, $fma:ident) => {
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
                $type::asin(self)
            }
            #[inline(always)]
            fn acos(self) -> Self {
                $type::acos(self)
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
            #[cfg(target_arch = "x86_64")]
            in_registers!($type, $four, $set.$setter, $fma);
            #[cfg(not(target_arch = "x86_64"))]
            one_by_one!();
        }
    };
}

machine_number!(f64, __m256d, avx._mm256_setr_pd, _mm256_fmadd_pd);
machine_number!(f32, __m128, sse._mm_setr_ps, _mm_fmadd_ps);
