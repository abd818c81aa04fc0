//! The numbers that a recorded tape has been given: parameters and what depends on parameters only.
//!
//! A tape is recorded once; for other parameters its numbers alone are renewed. What a recording looks like depends on which
//! of its numbers are zero, which are one or minus one, and which are equal: where that is as it was, the renewed tape is, bit
//! for bit, the tape that recording anew would give. Where it is not, the tape must be recorded anew.

use super::record::Slot;
use super::{Arithmetic, Scalar};

/// Runs a tape for the numbers that it is given, in order.
#[derive(Clone, Debug, Default)]
pub struct Given<T> {
    /// The numbers so far.
    pub list: Vec<T>,
    nodes: Vec<()>,
}

/// Where the numbers of a recording are.
#[derive(Clone, Debug, Default)]
pub struct Numbers<T> {
    /// Different numbers, in the order in which they came, and their registers.
    values: Vec<T>,
    slots: Vec<Slot>,
    /// Of each number that was given: its register; register 0 if it is zero.
    places: Vec<Slot>,
    /// Products of known numbers: x, y, x y.
    products: Vec<(Slot, Slot, Slot)>,
    /// Whether it holds a number that was neither given nor a product.
    foreign: bool,
}

impl<T: Scalar> Numbers<T> {
    /// The register of a number, if it is known.
    pub(super) fn find(&self, value: T) -> Option<Slot> {
        let found = self.values.iter().position(|known| *known == value);
        found.map(|index| self.slots[index])
    }

    /// The number in a register, if it is known.
    pub(super) fn value(&self, slot: Slot) -> Option<T> {
        let found = self.slots.iter().position(|known| *known == slot);
        found.map(|index| self.values[index])
    }

    /// Puts a number that is not known yet into a register.
    pub(super) fn put(&mut self, slot: Slot, value: T) {
        self.slots.push(slot);
        self.values.push(value);
    }

    /// Notes where a given number is.
    pub(super) fn note_given(&mut self, slot: Slot) {
        self.places.push(slot);
    }

    /// Notes where a product is.
    pub(super) fn note_product(&mut self, x: Slot, y: Slot, to: Slot) {
        self.products.push((x, y, to));
    }

    /// Notes that the numbers cannot be renewed: one came from elsewhere.
    pub(super) fn note_foreign(&mut self) {
        self.foreign = true;
    }

    /// Writes all numbers into the registers.
    pub(super) fn write(&self, registers: &mut [T]) {
        for (slot, &value) in self.slots.iter().zip(&self.values) {
            registers[slot.index()] = value;
        }
    }

    /// Takes other numbers in the place of those that were given, and writes all into the registers. False: with these numbers
    /// recording gives another tape, and the registers are of no use.
    pub fn renew(&mut self, given: &[T], registers: &mut [T]) -> bool {
        if self.foreign || given.len() != self.places.len() {
            return false;
        }
        // One and minus one are there from the beginning.
        let mut fresh = 2;
        let mut same = true;
        let Self {
            values,
            slots,
            places,
            products,
            ..
        } = self;
        let mut take = |slot: Slot, value: T, registers: &mut [T]| {
            let register = &mut registers[slot.index()];
            if slots.get(fresh) == Some(&slot) {
                *register = value;
                values[fresh] = value;
                fresh += 1;
            }
            same &= *register == value;
        };
        for (&slot, &value) in places.iter().zip(given) {
            // Register 0 is zero.
            take(slot, value, registers);
        }
        for &(x, y, to) in &*products {
            let value = registers[x.index()] * registers[y.index()];
            take(to, value, registers);
        }
        same && all_different(values)
    }
}

/// Whether no number is zero, nor equal to another.
fn all_different<T: Scalar>(values: &[T]) -> bool {
    let mut rest = values;
    let mut different = true;
    while let Some((value, others)) = rest.split_first() {
        // All are looked at, which takes less time than to stop at the first.
        let equal = others
            .iter()
            .fold(false, |found, other| found | (other == value));
        different &= !equal & !value.is_zero();
        rest = others;
    }
    different
}

impl<T: Scalar> Arithmetic for Given<T> {
    type Scalar = T;
    type Node = ();

    fn lend(&mut self) -> Vec<()> {
        core::mem::take(&mut self.nodes)
    }

    fn give_back(&mut self, list: Vec<()>) {
        self.nodes = list;
    }

    #[inline(always)]
    fn constant(&mut self, _: usize, c: T) {
        self.list.push(c);
    }

    #[inline(always)]
    fn offset(&mut self, _: usize, c: T, (): ()) {
        self.list.push(c);
    }

    #[inline(always)]
    fn scale(&mut self, _: usize, c: T, (): ()) {
        self.list.push(c);
    }

    #[inline(always)]
    fn ratio(&mut self, _: usize, c: T, (): ()) {
        self.list.push(c);
    }

    #[inline(always)]
    fn powf(&mut self, _: usize, (): (), c: f64) {
        self.list.push(T::from_f64(c));
    }

    #[inline(always)]
    fn add(&mut self, _: usize, (): (), (): ()) {}
    #[inline(always)]
    fn sub(&mut self, _: usize, (): (), (): ()) {}
    #[inline(always)]
    fn neg(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn mul(&mut self, _: usize, (): (), (): ()) {}
    #[inline(always)]
    fn square(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn div(&mut self, _: usize, (): (), (): ()) {}
    #[inline(always)]
    fn sqrt(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn exp(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn ln(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn tan(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn tanh(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn asin(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn acos(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn atan(&mut self, _: usize, (): ()) {}
    #[inline(always)]
    fn atan2(&mut self, _: usize, (): (), (): ()) {}

    #[inline(always)]
    fn sin_cos(&mut self, _: usize, (): ()) -> ((), ()) {
        ((), ())
    }

    #[inline(always)]
    fn sinh_cosh(&mut self, _: usize, (): ()) -> ((), ()) {
        ((), ())
    }
}
