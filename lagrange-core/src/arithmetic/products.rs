//! Sums of products of series, four products at a time.
//!
//! ```text
//! (x y)ₖ = x₀ yₖ + xₖ y₀ + Σ xⱼ yₖ₋ⱼ,  0 < j < k
//! ```
//!
//! The factors of four products lie side by side, so that a processor multiplies and adds four terms at once. The newest
//! coefficients, j = 1 and j = k − 1, enter last: a processor can begin with the others before those are known. They are not read
//! from memory: what has just been written there in parts would have to be waited for.

use super::fours::{Fours, GROUP};
use super::{Dual, Number, Pack, Registers, Scalar};

/// Coefficients that are kept of a series at most, a power of two: the highest order is 28, and velocities are known to one order more.
pub const STRIDE: usize = 32;

/// Coefficients 0, 1, … of one series.
pub type Row<N> = [N; ROW];

/// Places of a [`Row`]. Rows that lie a power of two apart share few lines of the cache: a chain of five links took a third longer.
pub const ROW: usize = STRIDE + 1;

/// Four machine numbers in a register.
#[cfg(target_arch = "x86_64")]
macro_rules! in_registers {
    ($type:ident, $four:ident, $set:ident.[$setter:ident $mul:ident $add:ident], $fma:ident) => {
        impl Fours for $type {
            type Four = core::arch::x86_64::$four;
            const IN_REGISTERS: bool = true;
            #[inline(always)]
            fn zeros() -> Self::Four {
                pulp::cast([0.0 as $type; GROUP])
            }
            #[inline(always)]
            fn four(registers: Registers, x: [Self; GROUP]) -> Self::Four {
                registers.$set.$setter(x[0], x[1], x[2], x[3])
            }
            #[inline(always)]
            fn numbers(four: Self::Four) -> [Self; GROUP] {
                pulp::cast(four)
            }
            #[inline(always)]
            fn product(r: Registers, x: Self::Four, y: Self::Four) -> Self::Four {
                r.$set.$mul(x, y)
            }
            #[inline(always)]
            fn sum(r: Registers, x: Self::Four, y: Self::Four) -> Self::Four {
                r.$set.$add(x, y)
            }
            #[inline(always)]
            fn add_products(
                r: Registers,
                x: Self::Four,
                y: Self::Four,
                z: Self::Four,
            ) -> Self::Four {
                r.fma.$fma(x, y, z)
            }
        }
    };
}

/// Four numbers in memory.
macro_rules! one_by_one {
    () => {
        type Four = [Self; GROUP];
        #[inline(always)]
        fn zeros() -> Self::Four {
            [Self::of(0.0); GROUP]
        }
        #[inline(always)]
        fn four(_: Registers, numbers: Self::Four) -> Self::Four {
            numbers
        }
        #[inline(always)]
        fn numbers(four: Self::Four) -> Self::Four {
            four
        }
        #[inline(always)]
        fn product(_: Registers, x: Self::Four, y: Self::Four) -> Self::Four {
            let mut products = x;
            let mut number = 0;
            while number < GROUP {
                products[number] = x[number] * y[number];
                number += 1;
            }
            products
        }
        #[inline(always)]
        fn sum(_: Registers, x: Self::Four, y: Self::Four) -> Self::Four {
            let mut sums = x;
            let mut number = 0;
            while number < GROUP {
                sums[number] = x[number] + y[number];
                number += 1;
            }
            sums
        }
        #[inline(always)]
        fn add_products(
            _: Registers,
            x: Self::Four,
            y: Self::Four,
            mut z: Self::Four,
        ) -> Self::Four {
            let mut number = 0;
            while number < GROUP {
                z[number] = Number::fused(x[number], y[number], z[number]);
                number += 1;
            }
            z
        }
    };
}

#[cfg(target_arch = "x86_64")]
in_registers!(f64, __m256d, avx.[_mm256_setr_pd _mm256_mul_pd _mm256_add_pd], _mm256_fmadd_pd);
#[cfg(target_arch = "x86_64")]
in_registers!(f32, __m128, sse.[_mm_setr_ps _mm_mul_ps _mm_add_ps], _mm_fmadd_ps);
#[cfg(not(target_arch = "x86_64"))]
impl Fours for f64 {
    one_by_one!();
}
#[cfg(not(target_arch = "x86_64"))]
impl Fours for f32 {
    one_by_one!();
}
impl<T: Scalar, const N: usize> Fours for Dual<T, N> {
    one_by_one!();
}
impl<T: Scalar, const L: usize> Fours for Pack<T, L> {
    one_by_one!();
}

/// One coefficient of the factors of four products. Those of several such groups lie side by side, and behind them those of the next coefficient: sums
/// go along them from the middle to both ends.
#[derive(Clone, Copy, Debug)]
pub struct Factors<N: Number> {
    x: N::Four,
    y: N::Four,
}

impl<N: Number> Factors<N> {
    /// Of what has no coefficients yet.
    #[inline(always)]
    pub fn none() -> Self {
        Self {
            x: N::zeros(),
            y: N::zeros(),
        }
    }

    /// Keeps a coefficient of the factors of the groups from `first` on.
    #[inline(always)]
    pub fn keep<const P: usize, const G: usize>(
        registers: Registers,
        all: &mut [Self; P],
        first: usize,
        x: [[N; GROUP]; G],
        y: [[N; GROUP]; G],
    ) -> [Self; G] {
        let mut newest = [Self::none(); G];
        let mut group = 0;
        while group < G {
            let (x, y) = (N::four(registers, x[group]), N::four(registers, y[group]));
            newest[group] = Self { x, y };
            all[first + group] = newest[group];
            group += 1;
        }
        newest
    }

    /// Σ xⱼ yₖ₋ⱼ for 0 < j < k of the groups from `first` on, whose newest coefficients are those of k − 1.
    #[inline(always)]
    pub fn sums<const P: usize, const G: usize>(
        registers: Registers,
        k: usize,
        products: &[[Self; P]; STRIDE],
        first: usize,
        newest: [Self; G],
    ) -> [[N; GROUP]; G] {
        let mut sums = [[N::of(0.0); GROUP]; G];
        let mut group = 0;
        if N::IN_REGISTERS {
            let all = side_by_side(registers, k, products, first, newest);
            while group < G {
                sums[group] = N::numbers(all[group]);
                group += 1;
            }
        } else {
            while group < G {
                let newest = [newest[group]];
                let [one] = side_by_side(registers, k, products, first + group, newest);
                sums[group] = N::numbers(one);
                group += 1;
            }
        }
        sums
    }
}

/// The sums of groups in one loop over their terms.
#[inline(always)]
fn side_by_side<N: Number, const P: usize, const G: usize>(
    registers: Registers,
    k: usize,
    products: &[[Factors<N>; P]; STRIDE],
    first: usize,
    newest: [Factors<N>; G],
) -> [N::Four; G] {
    let mut sums = [N::zeros(); G];
    let k = k % STRIDE;
    let (before, mut later) = products.split_at(k.div_ceil(2));
    if let (0, [middle, others @ ..]) = (k % 2, later) {
        let mut group = 0;
        while group < G {
            let Factors { x, y } = middle[first + group];
            sums[group] = N::add_products(registers, x, y, sums[group]);
            group += 1;
        }
        later = others;
    }
    if let [_, oldest, earlier @ ..] = before {
        for (earlier, later) in earlier.iter().rev().zip(later) {
            let mut group = 0;
            while group < G {
                let pair = [earlier[first + group], later[first + group]];
                sums[group] = both_ways(registers, pair, sums[group]);
                group += 1;
            }
        }
        let mut group = 0;
        while group < G {
            let pair = [oldest[first + group], newest[group]];
            sums[group] = both_ways(registers, pair, sums[group]);
            group += 1;
        }
    }
    sums
}

/// A sum with the terms xⱼ yᵢ and xᵢ yⱼ.
#[inline(always)]
fn both_ways<N: Number>(registers: Registers, [j, i]: [Factors<N>; 2], sum: N::Four) -> N::Four {
    let sum = N::add_products(registers, j.x, i.y, sum);
    N::add_products(registers, i.x, j.y, sum)
}
