//! Four numbers of one series side by side, for what a step does to all coefficients alike.
//!
//! The same code is compiled for registers of four numbers ([`Registers`]) and for a processor that has none ([`Memory`]): see
//! [`side_by_side`]. Closures and `array::from_fn` are not inlined into code for other registers, loops are.

use super::Scalar;
use super::registers::{Body, Registers, across};

/// How four numbers are kept side by side.
pub(crate) trait Quad: Copy {
    /// Four numbers.
    type Four<T: Scalar>: Copy;
    /// Takes four numbers.
    fn four<T: Scalar>(self, numbers: [T; 4]) -> Self::Four<T>;
    /// The numbers again.
    fn numbers<T: Scalar>(self, four: Self::Four<T>) -> [T; 4];
    /// x y of each.
    fn product<T: Scalar>(self, x: Self::Four<T>, y: Self::Four<T>) -> Self::Four<T>;
    /// x + y of each.
    fn sum<T: Scalar>(self, x: Self::Four<T>, y: Self::Four<T>) -> Self::Four<T>;
    /// |x| of the first `count`, 0 in the place of the others.
    fn first_magnitudes(self, x: Self::Four<f64>, count: usize) -> Self::Four<f64>;
    /// The larger of x and y of each, y where one of them is not a number.
    fn larger(self, x: Self::Four<f64>, y: Self::Four<f64>) -> Self::Four<f64>;
    /// The smaller of x and y of each, y where one of them is not a number.
    fn lesser(self, x: Self::Four<f64>, y: Self::Four<f64>) -> Self::Four<f64>;

    /// |x| of each.
    #[inline(always)]
    fn magnitudes(self, x: Self::Four<f64>) -> Self::Four<f64> {
        self.first_magnitudes(x, 4)
    }

    /// The same number four times.
    #[inline(always)]
    fn splat<T: Scalar>(self, x: T) -> Self::Four<T> {
        self.four([x; 4])
    }

    /// The largest of the four.
    #[inline(always)]
    fn largest(self, four: Self::Four<f64>) -> f64 {
        let [a, b, c, d] = self.numbers(four);
        let larger = |x: f64, y: f64| if x > y { x } else { y };
        larger(larger(a, b), larger(c, d))
    }

    /// The sum of the four.
    #[inline(always)]
    fn total<T: Scalar>(self, four: Self::Four<T>) -> T {
        let [a, b, c, d] = self.numbers(four);
        (a + c) + (b + d)
    }
}

/// The values of four numbers.
#[inline(always)]
pub(crate) fn values<T: Scalar>([a, b, c, d]: [T; 4]) -> [f64; 4] {
    [a.value(), b.value(), c.value(), d.value()]
}

/// Four numbers in memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Memory;

/// The same of each of four numbers.
macro_rules! each {
    ($number:ident => $value:expr) => {{
        let mut numbers = [Default::default(); 4];
        let mut $number = 0;
        while $number < 4 {
            numbers[$number] = $value;
            $number += 1;
        }
        numbers
    }};
}

/// What is done in memory.
macro_rules! in_memory {
    () => {
        #[inline(always)]
        fn first_magnitudes(self, x: [f64; 4], count: usize) -> [f64; 4] {
            each!(i => if i < count { x[i].abs() } else { 0.0 })
        }
        #[inline(always)]
        fn larger(self, x: [f64; 4], y: [f64; 4]) -> [f64; 4] {
            each!(i => if x[i] > y[i] { x[i] } else { y[i] })
        }
        #[inline(always)]
        fn lesser(self, x: [f64; 4], y: [f64; 4]) -> [f64; 4] {
            each!(i => if x[i] < y[i] { x[i] } else { y[i] })
        }
    };
}

impl Quad for Memory {
    type Four<T: Scalar> = [T; 4];
    #[inline(always)]
    fn four<T: Scalar>(self, numbers: [T; 4]) -> [T; 4] {
        numbers
    }
    #[inline(always)]
    fn numbers<T: Scalar>(self, four: [T; 4]) -> [T; 4] {
        four
    }
    #[inline(always)]
    fn product<T: Scalar>(self, x: [T; 4], y: [T; 4]) -> [T; 4] {
        each!(i => x[i] * y[i])
    }
    #[inline(always)]
    fn sum<T: Scalar>(self, x: [T; 4], y: [T; 4]) -> [T; 4] {
        each!(i => x[i] + y[i])
    }
    in_memory!();
}

/// Four machine numbers in a register.
#[cfg(target_arch = "x86_64")]
type FourDoubles = <f64 as super::fours::Fours>::Four;

/// The bits of the magnitudes of the first numbers of four, for 0 to 4 of them.
#[cfg(target_arch = "x86_64")]
const MAGNITUDES: [[u64; 4]; 5] = {
    const ALL: u64 = u64::MAX >> 1;
    [
        [0; 4],
        [ALL, 0, 0, 0],
        [ALL, ALL, 0, 0],
        [ALL, ALL, ALL, 0],
        [ALL; 4],
    ]
};

impl Quad for Registers {
    type Four<T: Scalar> = T::Four;
    #[inline(always)]
    fn four<T: Scalar>(self, numbers: [T; 4]) -> T::Four {
        T::four(self, numbers)
    }
    #[inline(always)]
    fn numbers<T: Scalar>(self, four: T::Four) -> [T; 4] {
        T::numbers(four)
    }
    #[inline(always)]
    fn product<T: Scalar>(self, x: T::Four, y: T::Four) -> T::Four {
        T::product(self, x, y)
    }
    #[inline(always)]
    fn sum<T: Scalar>(self, x: T::Four, y: T::Four) -> T::Four {
        T::sum(self, x, y)
    }
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn first_magnitudes(self, x: FourDoubles, count: usize) -> FourDoubles {
        self.avx
            ._mm256_and_pd(x, pulp::cast(MAGNITUDES[count.min(4)]))
    }
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn larger(self, x: FourDoubles, y: FourDoubles) -> FourDoubles {
        self.avx._mm256_max_pd(x, y)
    }
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn lesser(self, x: FourDoubles, y: FourDoubles) -> FourDoubles {
        self.avx._mm256_min_pd(x, y)
    }
    #[cfg(not(target_arch = "x86_64"))]
    in_memory!();
}

/// A function of arguments `A` that takes four numbers at a time: its implementation is `#[inline(always)]`.
pub(crate) trait QuadBody<A> {
    /// What it returns.
    type Output;
    /// The function.
    fn run<Q: Quad>(quad: Q, arguments: A) -> Self::Output;
}

/// Calls a function, compiled for registers of four numbers where the processor has them.
#[inline(always)]
pub(crate) fn side_by_side<B: QuadBody<A>, A>(arguments: A) -> B::Output {
    struct InRegisters<B>(core::marker::PhantomData<B>);

    impl<A, B: QuadBody<A>> Body<A> for InRegisters<B> {
        type Output = B::Output;

        #[inline(always)]
        fn run(registers: Registers, arguments: A) -> B::Output {
            B::run(registers, arguments)
        }
    }
    match across::<InRegisters<B>, A>(arguments) {
        Ok(output) => output,
        Err(arguments) => B::run(Memory, arguments),
    }
}
