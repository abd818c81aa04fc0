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
pub(super) struct Numbers<T> {
    /// Different numbers, in the order in which they came.
    values: Vec<(Slot, T)>,
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
        let found = self.values.iter().find(|(_, known)| *known == value);
        found.map(|&(slot, _)| slot)
    }

    /// The number in a register, if it is known.
    pub(super) fn value(&self, slot: Slot) -> Option<T> {
        let found = self.values.iter().find(|(known, _)| *known == slot);
        found.map(|&(_, value)| value)
    }

    /// Puts a number that is not known yet into a register.
    pub(super) fn put(&mut self, slot: Slot, value: T) {
        self.values.push((slot, value));
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
        for &(slot, value) in &self.values {
            registers[slot.index()] = value;
        }
    }

    /// Takes other numbers in the place of those that were given, and writes all into the registers. False: the recording is not
    /// the one that these would give.
    pub(super) fn renew(&mut self, given: &[T], registers: &mut [T]) -> bool {
        if self.foreign || given.len() != self.places.len() {
            return false;
        }
        // One and minus one are there from the beginning.
        let mut fresh = 2;
        let Self {
            values,
            places,
            products,
            ..
        } = self;
        let mut take = |slot: Slot, value: T, registers: &mut [T]| match values.get_mut(fresh) {
            Some((new, known)) if *new == slot => {
                *known = value;
                registers[slot.index()] = value;
                fresh += 1;
                true
            }
            _ => registers[slot.index()] == value,
        };
        for (&slot, &value) in places.iter().zip(given) {
            let zero = slot.index() == 0;
            if value.is_zero() != zero || !(zero || take(slot, value, registers)) {
                return false;
            }
        }
        for &(x, y, to) in &*products {
            let value = registers[x.index()] * registers[y.index()];
            if !take(to, value, registers) {
                return false;
            }
        }
        let mut earlier = self.values.iter().enumerate();
        earlier.all(|(i, (_, value))| self.values[..i].iter().all(|(_, other)| other != value))
    }
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
