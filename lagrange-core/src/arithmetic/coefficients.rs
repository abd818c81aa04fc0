//! Storage of Taylor coefficients, slot by slot.

use super::convolution::{convolution, convolution_ends_last};
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

    /// Σ_{j=1..k} xⱼ yₖ₋ⱼ: what coefficient k of a product takes from earlier coefficients of y.
    #[inline(always)]
    pub fn tail_product(&self, x: Slot, y: Slot, k: usize) -> T {
        convolution(&self.table[x.0 + 1..=x.0 + k], &self.table[y.0..y.0 + k])
    }

    /// Coefficient `k` of the product of two slots.
    #[inline(always)]
    pub fn product(&self, x: Slot, y: Slot, k: usize) -> T {
        convolution_ends_last(&self.table[x.0..=x.0 + k], &self.table[y.0..=y.0 + k])
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

    /// The arithmetic that appends coefficient `k`; its operations write the slots from `base` on.
    #[inline(always)]
    pub fn jet(&mut self, k: usize, base: usize) -> Jet<'_, T> {
        let base = base * self.stride;
        Jet::new(&mut self.table, &self.weights, self.stride, k, base)
    }
}
