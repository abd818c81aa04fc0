//! The sums Σ xⱼ yₖ₋ⱼ in which Taylor coefficients spend their time.
//!
//! At orders up to some 30 these are short: one running sum in a plain loop costs the fewest instructions, and the
//! processor overlaps it with the sums of the operations before and after. So that it can, the newest
//! coefficients, which the operation before has only just made, come last.

use crate::arithmetic::Scalar;

/// Σ xⱼ yₙ₋₁₋ⱼ over two series of the same length n (the shorter one counts if they differ: no panic, no read beyond).
#[inline(always)]
pub(crate) fn convolution<T: Scalar>(x: &[T], y: &[T]) -> T {
    x.iter()
        .zip(y.iter().rev())
        .fold(T::zero(), |sum, (&x, &y)| sum + x * y)
}

/// The same, with the two products of a first and a last coefficient last.
#[inline(always)]
pub(crate) fn convolution_ends_last<T: Scalar>(x: &[T], y: &[T]) -> T {
    match (x, y) {
        ([x0, x @ .., xk], [y0, y @ .., yk]) => convolution(x, y) + *x0 * *yk + *xk * *y0,
        _ => convolution(x, y),
    }
}

/// Σ xⱼ xₙ₋₁₋ⱼ: pairs are equal, so half of them twice and the middle one; the ends last.
#[inline(always)]
pub(crate) fn convolution_square<T: Scalar>(x: &[T]) -> T {
    let [first, inner @ .., last] = x else {
        return x.first().map_or(T::zero(), |&x| x * x);
    };
    let half = inner.len() / 2;
    let sum = convolution(&inner[..half], &inner[inner.len() - half..]) + *first * *last;
    let twice = sum + sum;
    if inner.len() % 2 == 1 {
        twice + inner[half] * inner[half]
    } else {
        twice
    }
}

/// Σ wⱼ xⱼ yₙ₋₁₋ⱼ
#[inline(always)]
pub(crate) fn weighted<T: Scalar>(w: &[T], x: &[T], y: &[T]) -> T {
    let terms = w.iter().zip(x).zip(y.iter().rev());
    terms.fold(T::zero(), |sum, ((&w, &x), &y)| sum + w * x * y)
}
