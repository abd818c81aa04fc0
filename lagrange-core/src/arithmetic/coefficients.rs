//! Storage of Taylor coefficients, slot by slot.

use super::convolution::{convolution, convolution_ends_last, convolution_square, weighted};
use super::{Jet, Scalar};

/// A slot of a coefficient table: the offset of its coefficient 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Slot(pub(super) usize);

impl Slot {
    /// Slot number `index` of a table with `stride` coefficients per slot.
    #[inline(always)]
    pub fn new(index: usize, stride: usize) -> Self {
        Slot(index * stride)
    }
}

/// Storage of Taylor coefficients: `slots` series of `order + 1` coefficients each.
#[derive(Clone, Debug, Default)]
pub struct Coefficients<T> {
    table: Vec<T>,
    /// 0, 1, 2, …: the weights j of the recurrences, as scalars.
    weights: Vec<T>,
    stride: usize,
}

impl<T: Scalar> Coefficients<T> {
    /// A table of zeros.
    pub fn new(slots: usize, order: usize) -> Self {
        let mut table = Self {
            table: Vec::new(),
            weights: Vec::new(),
            stride: 0,
        };
        table.shape(slots, order);
        table
    }

    /// Sets the shape; everything becomes zero. Allocates only beyond the largest size so far.
    pub fn shape(&mut self, slots: usize, order: usize) {
        self.stride = order + 1;
        self.table.clear();
        self.table.resize(slots * self.stride, T::zero());
        for j in self.weights.len()..=order {
            self.weights.push(T::from_f64(j as f64));
        }
    }

    /// Coefficients per slot, order + 1.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Number `index` of the slots.
    #[inline(always)]
    pub fn slot(&self, index: usize) -> Slot {
        Slot::new(index, self.stride)
    }

    /// All coefficients of a slot.
    #[inline(always)]
    pub fn series(&self, slot: Slot) -> &[T] {
        &self.table[slot.0..slot.0 + self.stride]
    }

    /// Coefficient `k` of a slot.
    #[inline(always)]
    pub fn get(&self, slot: Slot, k: usize) -> T {
        self.table[slot.0 + k]
    }

    /// Sets coefficient `k` of a slot.
    #[inline(always)]
    pub fn put(&mut self, slot: Slot, k: usize, value: T) {
        self.table[slot.0 + k] = value;
    }

    /// Coefficient `k` of x y.
    #[inline(always)]
    pub fn product(&self, x: Slot, y: Slot, k: usize) -> T {
        product(&self.table, x, y, k)
    }

    /// Σ_{j=1..k} xⱼ yₖ₋ⱼ: what coefficient `k` of x y takes from earlier coefficients of y.
    #[inline(always)]
    pub fn tail_product(&self, x: Slot, y: Slot, k: usize) -> T {
        tail_product(&self.table, x, y, k)
    }

    /// The arithmetic that appends coefficient `k`; its operations write the slots from `base` on.
    #[inline(always)]
    pub fn jet(&mut self, k: usize, base: usize) -> Jet<'_, T> {
        let base = base * self.stride;
        Jet::new(&mut self.table, &self.weights, self.stride, k, base)
    }
}

/// Coefficients `from..until` of a slot.
#[inline(always)]
fn part<T>(table: &[T], slot: Slot, from: usize, until: usize) -> &[T] {
    &table[slot.0 + from..slot.0 + until]
}

/// Coefficient `k` of x y: Σ_{j=0..k} xⱼ yₖ₋ⱼ.
#[inline(always)]
pub(super) fn product<T: Scalar>(table: &[T], x: Slot, y: Slot, k: usize) -> T {
    convolution_ends_last(part(table, x, 0, k + 1), part(table, y, 0, k + 1))
}

/// Σ_{j=1..k} xⱼ yₖ₋ⱼ
#[inline(always)]
pub(super) fn tail_product<T: Scalar>(table: &[T], x: Slot, y: Slot, k: usize) -> T {
    convolution(part(table, x, 1, k + 1), part(table, y, 0, k))
}

/// Coefficient `k` of x²: Σ_{j=0..k} xⱼ xₖ₋ⱼ.
#[inline(always)]
pub(super) fn square<T: Scalar>(table: &[T], x: Slot, k: usize) -> T {
    convolution_square(part(table, x, 0, k + 1))
}

/// Σ_{j=1..k−1} xⱼ xₖ₋ⱼ, for k > 0.
#[inline(always)]
pub(super) fn inner_square<T: Scalar>(table: &[T], x: Slot, k: usize) -> T {
    convolution_square(part(table, x, 1, k))
}

/// Σ_{j=1..last} j xⱼ yₖ₋ⱼ, for 0 < k and last ≤ k.
#[inline(always)]
pub(super) fn weighted_product<T: Scalar>(
    table: &[T],
    weights: &[T],
    x: Slot,
    y: Slot,
    k: usize,
    last: usize,
) -> T {
    let (x, y) = (part(table, x, 1, last + 1), part(table, y, k - last, k));
    weighted(&weights[1..=last], x, y)
}
