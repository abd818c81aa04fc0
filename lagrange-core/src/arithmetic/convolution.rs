//! The sums Σ xⱼ yₖ₋ⱼ in which Taylor coefficients spend their time.
//!
//! An addition takes some four cycles before the next one can use its result, but several can be under way at
//! once: four partial sums keep the adders busy, and the compiler can put two of them in one register.

use crate::arithmetic::Scalar;

/// Σ xⱼ yₙ₋₁₋ⱼ over two series of the same length n (the shorter one counts if they differ: no panic, no read beyond).
#[inline]
pub(crate) fn convolution<T: Scalar>(x: &[T], y: &[T]) -> T {
    let mut sums = [T::zero(); 4];
    let (x4, y4) = (x.chunks_exact(4), y.rchunks_exact(4));
    let (x_rest, y_rest) = (x4.remainder(), y4.remainder());
    for (x, y) in x4.zip(y4) {
        sums[0] += x[0] * y[3];
        sums[1] += x[1] * y[2];
        sums[2] += x[2] * y[1];
        sums[3] += x[3] * y[0];
    }
    let mut rest = T::zero();
    for (&x, &y) in x_rest.iter().zip(y_rest.iter().rev()) {
        rest += x * y;
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Σ xⱼ xₙ₋₁₋ⱼ: pairs are equal, so half of them twice and the middle one.
#[inline]
pub(crate) fn convolution_square<T: Scalar>(x: &[T]) -> T {
    let half = x.len() / 2;
    let sum = convolution(&x[..half], &x[x.len() - half..]);
    let twice = sum + sum;
    if x.len() % 2 == 1 {
        twice + x[half] * x[half]
    } else {
        twice
    }
}

/// Σ wⱼ xⱼ yₙ₋₁₋ⱼ
#[inline]
pub(crate) fn weighted<T: Scalar>(w: &[T], x: &[T], y: &[T]) -> T {
    let mut sums = [T::zero(); 2];
    for (j, ((&w, &x), &y)) in w.iter().zip(x).zip(y.iter().rev()).enumerate() {
        sums[j & 1] += w * x * y;
    }
    sums[0] + sums[1]
}

/// (Σ wⱼ xⱼ yₙ₋₁₋ⱼ, Σ wⱼ xⱼ zₙ₋₁₋ⱼ)
#[inline]
pub(crate) fn weighted_pair<T: Scalar>(w: &[T], x: &[T], y: &[T], z: &[T]) -> (T, T) {
    let mut sums = (T::zero(), T::zero());
    for (((&w, &x), &y), &z) in w.iter().zip(x).zip(y.iter().rev()).zip(z.iter().rev()) {
        let wx = w * x;
        sums.0 += wx * y;
        sums.1 += wx * z;
    }
    sums
}
