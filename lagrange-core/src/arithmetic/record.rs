//! A tape written down once per mode, to be run as data: for values, and for Taylor coefficients k = 1, 2, ….
//!
//! A tape asks at every operation what is held, and knows nothing of the mode. Written down, it is a plain list of what
//! really runs: what is zero in the mode (the velocity of a pinned coordinate, the force of an open contact) disappears,
//! what does not depend on time is computed once per series, and equal operations run once. The size of the tape
//! does not matter: it runs in one loop over the list, whoever wrote the tape.

use super::instruction::{Instruction, Op};
use super::numbers::Numbers;
use super::program::room;
use super::{Arithmetic, Scalar};
use std::collections::BTreeMap;

/// A register of a recorded tape. Register 0 is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Slot(pub(super) u32);

impl Slot {
    /// Register number `index`.
    #[inline(always)]
    pub fn new(index: usize) -> Self {
        Slot(index as u32)
    }

    /// Its number.
    #[inline(always)]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// How a number of a recorded tape depends on time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variation {
    /// It is zero.
    Zero,
    /// It does not depend on time.
    Constant,
    /// It may depend on time.
    Varying,
}

/// A number of a recorded tape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recorded {
    /// Where it is.
    pub slot: Slot,
    /// How it depends on time.
    pub variation: Variation,
}

impl Recorded {
    /// Zero.
    pub const ZERO: Self = Self {
        slot: Slot(0),
        variation: Variation::Zero,
    };

    /// A number that may depend on time.
    pub fn varying(slot: Slot) -> Self {
        Self {
            slot,
            variation: Variation::Varying,
        }
    }

    /// Whether it is zero.
    pub fn is_zero(self) -> bool {
        self.variation == Variation::Zero
    }

    /// Whether it may depend on time.
    pub fn varies(self) -> bool {
        self.variation == Variation::Varying
    }
}

/// An operation and its operands, to be found again.
type Key = (Op, u32, u32);

/// Part of a tape: what does not depend on time apart from what does, both in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Part {
    /// Runs once per series.
    pub fixed: Vec<Instruction>,
    /// Runs for every coefficient.
    pub varying: Vec<Instruction>,
}

/// A tape written down, as it comes. [`super::Program`] makes it short.
#[derive(Clone, Debug)]
pub struct Recording<T> {
    pub(super) parts: Vec<Part>,
    /// (factor, register) of the sums.
    pub(super) terms: Vec<(Slot, Slot)>,
    /// Registers that hold numbers known when the tape was recorded.
    pub(super) numbers: Numbers<T>,
    /// Results by operation.
    known: BTreeMap<Key, Recorded>,
    registers: usize,
}

impl<T: Scalar> Recording<T> {
    /// An empty recording; registers from `registers` on are free for the recorder's own use. `given` are all the numbers that
    /// the tape will be given: with others in their place it can be [renewed](Numbers::renew).
    pub fn new(registers: usize, given: &[T]) -> Self {
        let mut recording = Self {
            parts: vec![Part::default()],
            terms: Vec::new(),
            numbers: Numbers::default(),
            known: BTreeMap::new(),
            registers,
        };
        for number in [T::one(), -T::one()] {
            let slot = recording.fresh();
            recording.numbers.put(slot, number);
        }
        for &number in given {
            let slot = if number.is_zero() {
                Recorded::ZERO.slot
            } else {
                recording.register(number)
            };
            recording.numbers.note_given(slot);
        }
        recording
    }

    /// The arithmetic that records a tape; slots are numbered from register `base` on.
    pub fn record(&mut self, base: usize) -> Recorder<'_, T> {
        Recorder {
            recording: self,
            base,
        }
    }

    /// Number of registers.
    pub fn registers(&self) -> usize {
        self.registers
    }

    /// A register of its own.
    pub(super) fn fresh(&mut self) -> Slot {
        self.registers += 1;
        Slot::new(self.registers - 1)
    }

    /// A register with a known number.
    pub(super) fn number(&mut self, value: T) -> Slot {
        self.numbers.find(value).unwrap_or_else(|| {
            self.numbers.note_foreign();
            self.register(value)
        })
    }

    /// The register of a number, a new one if it is not known yet.
    fn register(&mut self, value: T) -> Slot {
        self.numbers.find(value).unwrap_or_else(|| {
            let slot = self.fresh();
            self.numbers.put(slot, value);
            slot
        })
    }

    /// The register of the product of two known numbers.
    pub(super) fn known_product(&mut self, x: Slot, y: Slot) -> Option<Slot> {
        let (a, b) = (self.numbers.value(x)?, self.numbers.value(y)?);
        let to = self.register(a * b);
        self.numbers.note_product(x, y, to);
        Some(to)
    }

    /// All registers with the numbers that are known, and what renews these.
    pub fn finish(self) -> (Vec<T>, Numbers<T>) {
        let mut registers = vec![T::zero(); room(self.registers)];
        self.numbers.write(&mut registers);
        (registers, self.numbers)
    }
}

/// Records a tape; made by [`Recording::record`].
#[derive(Debug)]
pub struct Recorder<'a, T> {
    recording: &'a mut Recording<T>,
    base: usize,
}

impl<T: Scalar> Recorder<'_, T> {
    /// A register of its own.
    pub(crate) fn fresh(&mut self) -> Slot {
        self.recording.fresh()
    }

    /// Ends a part of the recording.
    pub(crate) fn cut(&mut self) {
        self.recording.parts.push(Part::default());
    }

    /// A register with a known number.
    fn number(&mut self, value: T) -> Recorded {
        Recorded {
            slot: self.recording.number(value),
            variation: Variation::Constant,
        }
    }

    fn push(&mut self, to: usize, op: Op, x: Recorded, y: Recorded) -> Recorded {
        let key = (op, x.slot.0, y.slot.0);
        let to = Slot::new(self.base + to);
        self.push_key(to, key, x.varies() || y.varies())
    }

    fn push_key(&mut self, to: Slot, key: Key, varies: bool) -> Recorded {
        if let Some(&known) = self.recording.known.get(&key) {
            return known;
        }
        let (op, x, y) = key;
        let Some(part) = self.recording.parts.last_mut() else {
            return Recorded::ZERO;
        };
        let (list, variation) = if varies {
            (&mut part.varying, Variation::Varying)
        } else {
            (&mut part.fixed, Variation::Constant)
        };
        list.push(Instruction {
            op,
            to,
            x: Slot(x),
            y: Slot(y),
        });
        let result = Recorded {
            slot: to,
            variation,
        };
        self.recording.known.insert(key, result);
        result
    }

    /// A function with a second result in the register after the first.
    fn push_pair(&mut self, to: usize, op: Op, x: Recorded) -> (Recorded, Recorded) {
        let first = self.push(to, op, x, Recorded::ZERO);
        let second = Slot(first.slot.0 + 1);
        (
            first,
            Recorded {
                slot: second,
                ..first
            },
        )
    }

    /// Σ factor · number
    pub(crate) fn push_sum(
        &mut self,
        to: usize,
        terms: impl Iterator<Item = (T, Recorded)>,
    ) -> Recorded {
        let first = self.recording.terms.len();
        let mut varies = false;
        let mut only = None;
        for (factor, x) in terms {
            if !x.is_zero() && !factor.is_zero() {
                let number = self.recording.number(factor);
                self.recording.terms.push((number, x.slot));
                varies |= x.varies();
                only = Some((factor, x));
            }
        }
        let end = self.recording.terms.len();
        match (end - first, only) {
            (1, Some((factor, x))) => {
                self.recording.terms.truncate(first);
                self.scale(to, factor, x)
            }
            (0, _) | (_, None) => Recorded::ZERO,
            _ => {
                let key = (Op::Sum, first as u32, end as u32);
                self.push_key(Slot::new(self.base + to), key, varies)
            }
        }
    }

    /// The same number in a register of choice.
    pub(crate) fn assign(&mut self, to: Slot, x: Recorded) -> Recorded {
        if x.is_zero() || x.slot == to {
            return x;
        }
        self.push_key(to, (Op::Copy, x.slot.0, to.0), x.varies())
    }
}

impl<T: Scalar> Arithmetic for Recorder<'_, T> {
    type Scalar = T;
    type Node = Recorded;

    fn origin(&mut self, base: usize) {
        self.base = base;
    }

    fn constant(&mut self, _: usize, c: T) -> Recorded {
        if c.is_zero() {
            Recorded::ZERO
        } else {
            self.number(c)
        }
    }

    fn add(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        match (x.is_zero(), y.is_zero()) {
            (true, _) => y,
            (_, true) => x,
            _ => self.push(to, Op::Add, x, y),
        }
    }

    fn sub(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        match (x.is_zero(), y.is_zero()) {
            (_, true) => x,
            (true, _) => self.neg(to, y),
            _ => self.push(to, Op::Sub, x, y),
        }
    }

    fn neg(&mut self, to: usize, x: Recorded) -> Recorded {
        if x.is_zero() {
            x
        } else {
            self.push(to, Op::Neg, x, Recorded::ZERO)
        }
    }

    fn offset(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        let c = self.constant(to, c);
        if x.varies() && !c.is_zero() {
            self.push(to, Op::Offset, c, x)
        } else {
            self.add(to, c, x)
        }
    }

    fn scale(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        if x.is_zero() || c == T::one() {
            x
        } else if c == -T::one() {
            self.neg(to, x)
        } else {
            let c = self.constant(to, c);
            self.mul(to, c, x)
        }
    }

    fn mul(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        if x.is_zero() || y.is_zero() {
            return Recorded::ZERO;
        }
        match (x.varies(), y.varies()) {
            (false, _) => self.push(to, Op::Scale, x, y),
            (_, false) => self.push(to, Op::Scale, y, x),
            _ => self.push(to, Op::Mul, x, y),
        }
    }

    fn square(&mut self, to: usize, x: Recorded) -> Recorded {
        if x.is_zero() {
            x
        } else {
            self.push(to, Op::Square, x, Recorded::ZERO)
        }
    }

    fn div(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        let op = match (x.varies(), y.varies()) {
            (_, false) => Op::DivConstant,
            (false, _) => Op::Ratio,
            _ => Op::Div,
        };
        self.push(to, op, x, y)
    }

    fn ratio(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        let c = self.constant(to, c);
        self.div(to, c, x)
    }

    fn sqrt(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Sqrt, x, Recorded::ZERO)
    }

    fn powf(&mut self, to: usize, x: Recorded, c: f64) -> Recorded {
        let exponent = self.number(T::from_f64(c));
        self.push(to, Op::Powf, x, exponent)
    }

    fn exp(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Exp, x, Recorded::ZERO)
    }

    fn ln(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Ln, x, Recorded::ZERO)
    }

    fn sin_cos(&mut self, to: usize, x: Recorded) -> (Recorded, Recorded) {
        self.push_pair(to, Op::SinCos, x)
    }

    fn sinh_cosh(&mut self, to: usize, x: Recorded) -> (Recorded, Recorded) {
        self.push_pair(to, Op::SinhCosh, x)
    }

    fn tan(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Tan, x, Recorded::ZERO)
    }

    fn tanh(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Tanh, x, Recorded::ZERO)
    }

    fn asin(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Asin, x, Recorded::ZERO)
    }

    fn acos(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Acos, x, Recorded::ZERO)
    }

    fn atan(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Atan, x, Recorded::ZERO)
    }

    fn atan2(&mut self, to: usize, y: Recorded, x: Recorded) -> Recorded {
        self.push(to, Op::Atan2, y, x)
    }
}
