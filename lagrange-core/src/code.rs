//! A tape as data: what the derive emits for large systems, whose equations as Rust code would take rustc minutes.
//!
//! The operations are those of [`Arithmetic`], in the same order and with the same slots as in the code of a small
//! system, so whatever runs or records a tape gets the same from both. Steppers do not notice: they run what has been
//! recorded once for the mode.
//!
//! # Format
//! Little-endian words of four bytes. A block is
//!
//! ```text
//! k  k·(low, high)  m  first value  first slot  m·(operation | branch·256, x, y)
//! ```
//!
//! and runs if one of its needs (k words of a mask; k = 0: always) is held. Values are numbered in the order in which
//! they are computed, the inputs first, and so are slots. A coefficient is a number by place · 4 + kind: a constant (0), a
//! parameter (1), an exact number of the table (2).

use crate::arithmetic::{Arithmetic, Scalar};
use crate::system::Held;

/// A tape as data.
#[derive(Clone, Copy, Debug)]
pub struct Code {
    /// The blocks.
    pub words: &'static [u8],
    /// Exact numbers.
    pub numbers: &'static [f64],
    /// Number of values, with the inputs.
    pub values: usize,
}

/// Number of each operation; those of the macro are the same.
mod op {
    pub const CONSTANT: u32 = 0;
    pub const ADD: u32 = 1;
    pub const SUB: u32 = 2;
    pub const NEG: u32 = 3;
    pub const OFFSET: u32 = 4;
    pub const SCALE: u32 = 5;
    pub const MUL: u32 = 6;
    pub const SQUARE: u32 = 7;
    pub const DIV: u32 = 8;
    pub const RATIO: u32 = 9;
    pub const SQRT: u32 = 10;
    pub const POWF: u32 = 11;
    pub const EXP: u32 = 12;
    pub const LN: u32 = 13;
    pub const SIN_COS: u32 = 14;
    pub const SINH_COSH: u32 = 15;
    pub const TAN: u32 = 16;
    pub const TANH: u32 = 17;
    pub const ASIN: u32 = 18;
    pub const ACOS: u32 = 19;
    pub const ATAN: u32 = 20;
    pub const ATAN2: u32 = 21;
    pub const SELECT: u32 = 22;
    pub const SET: u32 = 23;
    pub const ADD_TO: u32 = 24;
    pub const SUBTRACT_FROM: u32 = 25;
}

/// Reads words one by one.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    /// The next word; None at the end.
    #[inline(always)]
    fn word(&mut self) -> Option<u32> {
        let (word, rest) = self.0.split_first_chunk::<4>()?;
        self.0 = rest;
        Some(u32::from_le_bytes(*word))
    }

    /// The next word as a place.
    #[inline(always)]
    fn place(&mut self) -> Option<usize> {
        self.word().map(|word| word as usize)
    }

    /// Whether the block whose needs come next is to run.
    fn runs(&mut self, held: &Held) -> Option<bool> {
        let count = self.place()?;
        let mut runs = count == 0;
        for word in 0..count {
            let needs = u64::from(self.word()?) | u64::from(self.word()?) << 32;
            runs |= held.needs.get(word).is_some_and(|held| held & needs != 0);
        }
        Some(runs)
    }
}

impl Code {
    /// Runs the tape: constants `c`, parameters by number, inputs `x`, outputs `y`. As `System::motion`.
    pub fn run<A: Arithmetic>(
        &self,
        a: &mut A,
        held: &Held,
        c: &[A::Scalar],
        parameter: impl Fn(usize) -> A::Scalar,
        x: &[A::Node],
        y: &mut [A::Node],
    ) {
        let Some(&idle) = x.first() else { return };
        let mut nodes = a.lend();
        nodes.clear();
        nodes.extend_from_slice(x);
        // What is not computed stays at a node that nobody reads.
        nodes.resize(self.values.max(x.len()), idle);
        let coefficient = |code: u32| {
            let place = code as usize / 4;
            match code % 4 {
                0 => c[place],
                1 => parameter(place),
                _ => A::Scalar::from_f64(self.numbers[place]),
            }
        };
        let mut reader = Reader(self.words);
        while let Some(runs) = reader.runs(held) {
            if self
                .block(a, held, &coefficient, &mut reader, runs, &mut nodes, y)
                .is_none()
            {
                break;
            }
        }
        a.give_back(nodes);
    }

    /// Runs or skips one block. None at the end of the words.
    #[allow(clippy::too_many_arguments)]
    fn block<A: Arithmetic>(
        &self,
        a: &mut A,
        held: &Held,
        coefficient: &impl Fn(u32) -> A::Scalar,
        reader: &mut Reader,
        runs: bool,
        n: &mut [A::Node],
        y: &mut [A::Node],
    ) -> Option<()> {
        let count = reader.place()?;
        let (mut value, mut to) = (reader.place()?, reader.place()?);
        if !runs {
            reader.0 = reader.0.get(12 * count..)?;
            return Some(());
        }
        for _ in 0..count {
            let (code, first, second) = (reader.word()?, reader.word()?, reader.word()?);
            let (i, j) = (first as usize, second as usize);
            let (result, slots) = match code & 255 {
                op::CONSTANT => (a.constant(to, coefficient(first)), 1),
                op::ADD => (a.add(to, n[i], n[j]), 1),
                op::SUB => (a.sub(to, n[i], n[j]), 1),
                op::NEG => (a.neg(to, n[i]), 1),
                op::OFFSET => (a.offset(to, coefficient(first), n[j]), 1),
                op::SCALE => (a.scale(to, coefficient(first), n[j]), 1),
                op::MUL => (a.mul(to, n[i], n[j]), 1),
                op::SQUARE => (a.square(to, n[i]), 1),
                op::DIV => (a.div(to, n[i], n[j]), 1),
                op::RATIO => (a.ratio(to, coefficient(first), n[j]), 1),
                op::SQRT => (a.sqrt(to, n[i]), 1),
                op::POWF => (a.powf(to, n[i], self.numbers[j / 4]), 1),
                op::EXP => (a.exp(to, n[i]), 1),
                op::LN => (a.ln(to, n[i]), 1),
                op::SIN_COS | op::SINH_COSH => {
                    let (one, two) = match code & 255 {
                        op::SIN_COS => a.sin_cos(to, n[i]),
                        _ => a.sinh_cosh(to, n[i]),
                    };
                    n[value] = one;
                    value += 1;
                    (two, 2)
                }
                op::TAN => (a.tan(to, n[i]), 2),
                op::TANH => (a.tanh(to, n[i]), 2),
                op::ASIN => (a.asin(to, n[i]), 2),
                op::ACOS => (a.acos(to, n[i]), 2),
                op::ATAN => (a.atan(to, n[i]), 2),
                op::ATAN2 => (a.atan2(to, n[i], n[j]), 2),
                op::SELECT => {
                    let then = held.branch((code >> 8) as usize);
                    (n[if then { i } else { j }], 0)
                }
                op::SET => {
                    y[i] = n[j];
                    continue;
                }
                op::ADD_TO => {
                    y[i] = a.add(to, y[i], n[j]);
                    to += 1;
                    continue;
                }
                op::SUBTRACT_FROM => {
                    y[i] = a.sub(to, y[i], n[j]);
                    to += 1;
                    continue;
                }
                _ => return None,
            };
            n[value] = result;
            value += 1;
            to += slots;
        }
        Some(())
    }
}
