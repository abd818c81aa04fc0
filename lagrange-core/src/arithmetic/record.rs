//! A tape written down once per mode, to be run for k = 0, 1, … as data.
//!
//! A tape asks at every operation what is held, and knows nothing of the mode. Written down, it is a plain list of what
//! really runs: what is zero in the mode (the velocity of a pinned coordinate, the force of an open contact) disappears,
//! what is constant is computed for k = 0 only, and a product with a constant is no convolution. The size of the
//! tape does not matter: its Taylor coefficients run in one loop over the list, whoever wrote the tape.

use super::{Arithmetic, Jet, Scalar, Slot};

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
    /// Where its coefficients are. Slot 0 of the table is zero.
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

    /// A number that does not depend on time.
    pub fn constant(slot: Slot) -> Self {
        Self {
            slot,
            variation: Variation::Constant,
        }
    }

    fn is_zero(self) -> bool {
        self.variation == Variation::Zero
    }

    fn varies(self) -> bool {
        self.variation == Variation::Varying
    }
}

/// An operation with its operands.
#[derive(Clone, Copy, Debug)]
enum Op<T> {
    Constant(T),
    Add(Slot, Slot),
    Sub(Slot, Slot),
    Neg(Slot),
    Offset(T, Slot),
    Scale(T, Slot),
    Mul(Slot, Slot),
    /// By a number that does not depend on time.
    MulConstant(Slot, Slot),
    Square(Slot),
    Div(Slot, Slot),
    /// By a number that does not depend on time.
    DivConstant(Slot, Slot),
    Ratio(T, Slot),
    Sqrt(Slot),
    Powf(Slot, f64),
    Exp(Slot),
    Ln(Slot),
    SinCos(Slot),
    SinhCosh(Slot),
    Tan(Slot),
    Tanh(Slot),
    Asin(Slot),
    Acos(Slot),
    Atan(Slot),
    Atan2(Slot, Slot),
    /// Σ over a range of the terms.
    Sum(usize, usize),
}

/// A tape written down: operations with the slot that they write.
#[derive(Clone, Debug, Default)]
pub struct Recording<T> {
    /// What does not depend on time; needs nothing of what does.
    constant: Vec<(usize, Op<T>)>,
    varying: Vec<(usize, Op<T>)>,
    /// (factor, number) of the sums.
    terms: Vec<(T, Slot)>,
}

impl<T: Scalar> Recording<T> {
    /// Forgets everything, but for the memory.
    pub fn clear(&mut self) {
        self.constant.clear();
        self.varying.clear();
        self.terms.clear();
    }

    /// The arithmetic that records a tape whose slots begin at `base`, in a table with `stride` coefficients per slot.
    pub fn record(&mut self, base: usize, stride: usize) -> Recorder<'_, T> {
        Recorder {
            recording: self,
            base,
            stride,
        }
    }

    /// Appends the next coefficient of every number. `a` counts slots from the start of the table.
    pub fn run(&self, a: &mut Jet<'_, T>) {
        if a.coefficient() == 0 {
            self.run_list(a, &self.constant);
        }
        self.run_list(a, &self.varying);
    }

    fn run_list(&self, a: &mut Jet<'_, T>, list: &[(usize, Op<T>)]) {
        for &(to, op) in list {
            match op {
                Op::Constant(c) => a.constant(to, c),
                Op::Add(x, y) => a.add(to, x, y),
                Op::Sub(x, y) => a.sub(to, x, y),
                Op::Neg(x) => a.neg(to, x),
                Op::Offset(c, x) => a.offset(to, c, x),
                Op::Scale(c, x) => a.scale(to, c, x),
                Op::Mul(x, y) => a.mul(to, x, y),
                Op::MulConstant(x, y) => a.scale(to, a.start(x), y),
                Op::Square(x) => a.square(to, x),
                Op::Div(x, y) => a.div(to, x, y),
                Op::DivConstant(x, y) => a.div_constant(to, x, y),
                Op::Ratio(c, x) => a.ratio(to, c, x),
                Op::Sqrt(x) => a.sqrt(to, x),
                Op::Powf(x, c) => a.powf(to, x, c),
                Op::Exp(x) => a.exp(to, x),
                Op::Ln(x) => a.ln(to, x),
                Op::SinCos(x) => a.sin_cos(to, x).0,
                Op::SinhCosh(x) => a.sinh_cosh(to, x).0,
                Op::Tan(x) => a.tan(to, x),
                Op::Tanh(x) => a.tanh(to, x),
                Op::Asin(x) => a.asin(to, x),
                Op::Acos(x) => a.acos(to, x),
                Op::Atan(x) => a.atan(to, x),
                Op::Atan2(y, x) => a.atan2(to, y, x),
                Op::Sum(first, end) => {
                    let terms = self.terms[first..end].iter();
                    let sum = terms.fold(T::zero(), |sum, &(factor, x)| sum + factor * a.at(x));
                    a.put(to, sum)
                }
            };
        }
    }
}

/// Records a tape; made by [`Recording::record`].
#[derive(Debug)]
pub struct Recorder<'a, T> {
    recording: &'a mut Recording<T>,
    base: usize,
    stride: usize,
}

impl<T: Scalar> Recorder<'_, T> {
    fn push(&mut self, to: usize, op: Op<T>, operands: &[Recorded]) -> Recorded {
        let to = self.base + to;
        let varies = operands.iter().any(|x| x.varies());
        let list = if varies {
            &mut self.recording.varying
        } else {
            &mut self.recording.constant
        };
        list.push((to, op));
        let slot = Slot::new(to, self.stride);
        if varies {
            Recorded::varying(slot)
        } else {
            Recorded::constant(slot)
        }
    }

    /// A function with a second result in the slot after the first.
    fn push_pair(&mut self, to: usize, op: Op<T>, x: Recorded) -> (Recorded, Recorded) {
        let first = self.push(to, op, &[x]);
        (
            first,
            Recorded {
                slot: Slot::new(self.base + to + 1, self.stride),
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
        let mut varies = Recorded::ZERO;
        for (factor, x) in terms {
            if !x.is_zero() {
                self.recording.terms.push((factor, x.slot));
                varies = if varies.varies() { varies } else { x };
            }
        }
        match self.recording.terms[first..] {
            [] => Recorded::ZERO,
            [(factor, slot)] => {
                self.recording.terms.truncate(first);
                self.scale(to, factor, Recorded { slot, ..varies })
            }
            _ => self.push(to, Op::Sum(first, self.recording.terms.len()), &[varies]),
        }
    }
}

impl<T: Scalar> Arithmetic for Recorder<'_, T> {
    type Scalar = T;
    type Node = Recorded;

    fn origin(&mut self, base: usize) {
        self.base = base;
    }

    fn constant(&mut self, to: usize, c: T) -> Recorded {
        if c.is_zero() {
            Recorded::ZERO
        } else {
            self.push(to, Op::Constant(c), &[])
        }
    }

    fn add(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        match (x.is_zero(), y.is_zero()) {
            (true, _) => y,
            (_, true) => x,
            _ => self.push(to, Op::Add(x.slot, y.slot), &[x, y]),
        }
    }

    fn sub(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        match (x.is_zero(), y.is_zero()) {
            (_, true) => x,
            (true, _) => self.neg(to, y),
            _ => self.push(to, Op::Sub(x.slot, y.slot), &[x, y]),
        }
    }

    fn neg(&mut self, to: usize, x: Recorded) -> Recorded {
        if x.is_zero() {
            x
        } else {
            self.push(to, Op::Neg(x.slot), &[x])
        }
    }

    fn offset(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        if x.is_zero() {
            self.constant(to, c)
        } else {
            self.push(to, Op::Offset(c, x.slot), &[x])
        }
    }

    fn scale(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        if x.is_zero() || c.is_zero() {
            Recorded::ZERO
        } else if c == T::one() {
            x
        } else {
            self.push(to, Op::Scale(c, x.slot), &[x])
        }
    }

    fn mul(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        if x.is_zero() || y.is_zero() {
            return Recorded::ZERO;
        }
        let op = match (x.varies(), y.varies()) {
            (false, _) => Op::MulConstant(x.slot, y.slot),
            (_, false) => Op::MulConstant(y.slot, x.slot),
            _ => Op::Mul(x.slot, y.slot),
        };
        self.push(to, op, &[x, y])
    }

    fn square(&mut self, to: usize, x: Recorded) -> Recorded {
        if x.is_zero() {
            x
        } else {
            self.push(to, Op::Square(x.slot), &[x])
        }
    }

    fn div(&mut self, to: usize, x: Recorded, y: Recorded) -> Recorded {
        let op = if y.varies() {
            Op::Div(x.slot, y.slot)
        } else {
            Op::DivConstant(x.slot, y.slot)
        };
        self.push(to, op, &[x, y])
    }

    fn ratio(&mut self, to: usize, c: T, x: Recorded) -> Recorded {
        self.push(to, Op::Ratio(c, x.slot), &[x])
    }

    fn sqrt(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Sqrt(x.slot), &[x])
    }

    fn powf(&mut self, to: usize, x: Recorded, c: f64) -> Recorded {
        self.push(to, Op::Powf(x.slot, c), &[x])
    }

    fn exp(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Exp(x.slot), &[x])
    }

    fn ln(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Ln(x.slot), &[x])
    }

    fn sin_cos(&mut self, to: usize, x: Recorded) -> (Recorded, Recorded) {
        self.push_pair(to, Op::SinCos(x.slot), x)
    }

    fn sinh_cosh(&mut self, to: usize, x: Recorded) -> (Recorded, Recorded) {
        self.push_pair(to, Op::SinhCosh(x.slot), x)
    }

    fn tan(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Tan(x.slot), &[x])
    }

    fn tanh(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Tanh(x.slot), &[x])
    }

    fn asin(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Asin(x.slot), &[x])
    }

    fn acos(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Acos(x.slot), &[x])
    }

    fn atan(&mut self, to: usize, x: Recorded) -> Recorded {
        self.push(to, Op::Atan(x.slot), &[x])
    }

    fn atan2(&mut self, to: usize, y: Recorded, x: Recorded) -> Recorded {
        self.push(to, Op::Atan2(y.slot, x.slot), &[x, y])
    }
}
