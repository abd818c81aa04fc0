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

/// The factors of four products, coefficient by coefficient.
#[derive(Clone, Debug)]
pub struct Products<N: Number> {
    x: [N::Four; STRIDE],
    y: [N::Four; STRIDE],
}

/// Coefficient k of the factors of four products.
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
}

impl<N: Number> Default for Products<N> {
    fn default() -> Self {
        Self {
            x: [N::zeros(); STRIDE],
            y: [N::zeros(); STRIDE],
        }
    }
}

impl<N: Number> Products<N> {
    /// Keeps coefficient k of the factors.
    #[inline(always)]
    pub fn keep(
        &mut self,
        registers: Registers,
        k: usize,
        x: [N; GROUP],
        y: [N; GROUP],
    ) -> Factors<N> {
        let (x, y) = (N::four(registers, x), N::four(registers, y));
        (self.x[k % STRIDE], self.y[k % STRIDE]) = (x, y);
        Factors { x, y }
    }

    /// Σ xⱼ yₖ₋ⱼ for 0 < j < k of several groups, whose newest coefficients are those of k − 1.
    #[inline(always)]
    pub fn sums<const G: usize>(
        registers: Registers,
        k: usize,
        groups: [(&Self, Factors<N>); G],
    ) -> [[N; GROUP]; G] {
        let mut sums = [[N::of(0.0); GROUP]; G];
        let mut group = 0;
        if N::IN_REGISTERS {
            let all = side_by_side(registers, k, groups);
            while group < G {
                sums[group] = N::numbers(all[group]);
                group += 1;
            }
        } else {
            while group < G {
                let [one] = side_by_side(registers, k, [groups[group]]);
                sums[group] = N::numbers(one);
                group += 1;
            }
        }
        sums
    }
}

/// The sums of groups in one loop over their terms.
#[inline(always)]
fn side_by_side<N: Number, const G: usize>(
    registers: Registers,
    k: usize,
    groups: [(&Products<N>, Factors<N>); G],
) -> [N::Four; G] {
    let mut sums = [N::zeros(); G];
    let middle = k / 2;
    if k == 2 * middle {
        sums = one_more(registers, groups, (middle, middle), sums);
    }
    let mut j = k - middle;
    while j > 2 {
        j -= 1;
        sums = one_more(registers, groups, (j, k - j), sums);
        sums = one_more(registers, groups, (k - j, j), sums);
    }
    if k > 2 {
        let mut group = 0;
        while group < G {
            let (products, newest) = groups[group];
            let sum = N::add_products(registers, products.x[1], newest.y, sums[group]);
            sums[group] = N::add_products(registers, newest.x, products.y[1], sum);
            group += 1;
        }
    }
    sums
}

/// The sums with the terms xⱼ yᵢ.
#[inline(always)]
fn one_more<N: Number, const G: usize>(
    registers: Registers,
    groups: [(&Products<N>, Factors<N>); G],
    (j, i): (usize, usize),
    mut sums: [N::Four; G],
) -> [N::Four; G] {
    let mut group = 0;
    while group < G {
        let products = groups[group].0;
        let (x, y) = (products.x[j % STRIDE], products.y[i % STRIDE]);
        sums[group] = N::add_products(registers, x, y, sums[group]);
        group += 1;
    }
    sums
}
