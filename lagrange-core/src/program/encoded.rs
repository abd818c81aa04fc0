//! A program as the derive writes it: one literal, which costs rustc nothing however long the program is.
//!
//! # Format
//! Little-endian words of four bytes. A block is
//!
//! ```text
//! k  place  k·(low, high)  m  first value  m·(operation | branch·256, x, y)
//! ```
//!
//! and runs if one of its needs (k words of a mask from this place on; k = 0, without a place: always) is held. Values are numbered in the order in which
//! they are computed, the inputs first. A coefficient is a number by place · 4 + kind: a constant (0), a parameter (1), an exact
//! number of the table (2).

use super::{Needs, Op};

/// A program as data.
#[derive(Clone, Copy, Debug)]
pub struct Encoded {
    /// The blocks.
    pub words: &'static [u8],
    /// Exact numbers.
    pub numbers: &'static [f64],
    /// Number of values, with the inputs.
    pub values: usize,
    /// Number of outputs.
    pub outputs: usize,
}

/// A number that is fixed during a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coefficient {
    /// A constant of the system.
    Constant(usize),
    /// A parameter.
    Parameter(usize),
    /// An exact number of the table.
    Exact(usize),
}

/// One word of a program, read; values and outputs by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    /// c
    Constant(Coefficient),
    /// c + x
    Offset(Coefficient, usize),
    /// c x
    Scale(Coefficient, usize),
    /// c / x
    Ratio(Coefficient, usize),
    /// xᶜ
    Powf(usize, Coefficient),
    /// An operation on one or two values; numbered as in the format.
    Apply(u32, usize, usize),
    /// The first value while the branch is on its `then` side, else the second.
    Select(usize, usize, usize),
    /// The output becomes the value.
    Set(usize, usize),
    /// The value is added to the output.
    AddTo(usize, usize),
    /// The value is subtracted from the output.
    SubtractFrom(usize, usize),
}

impl Encoded {
    /// A program that computes nothing.
    pub const NONE: Self = Self {
        words: &[],
        numbers: &[],
        values: 0,
        outputs: 0,
    };

    /// Products and functions of what varies along a motion, in the blocks that one of the needs asks for: each is a sum over
    /// earlier coefficients for every new one of a Taylor series.
    pub(crate) fn products(&self, needs: &Needs) -> usize {
        let mut products = 0;
        self.read(needs, |_, word| products += word.products());
        products
    }

    /// Reads the blocks that one of the needs asks for, and those without needs: to `take` go the words, each with the number of
    /// the value that it computes, if it does.
    pub(crate) fn read(&self, held: &Needs, mut take: impl FnMut(usize, Word)) {
        let (words, _) = self.words.as_chunks::<4>();
        let mut words = words.iter().map(|word| u32::from_le_bytes(*word));
        while let Some(count) = words.next() {
            let mut runs = count == 0;
            let first = match count {
                0 => 0,
                _ => words.next().unwrap_or(0) as usize,
            };
            for place in first..first + count as usize {
                let (low, high) = (words.next(), words.next());
                let needs = u64::from(low.unwrap_or(0)) | u64::from(high.unwrap_or(0)) << 32;
                runs |= held.get(place).is_some_and(|held| held & needs != 0);
            }
            let (length, first) = (words.next().unwrap_or(0), words.next().unwrap_or(0));
            if !runs {
                if length > 0 {
                    words.nth(3 * length as usize - 1);
                }
                continue;
            }
            let mut value = first as usize;
            for _ in 0..length {
                let (Some(code), Some(x), Some(y)) = (words.next(), words.next(), words.next())
                else {
                    return;
                };
                let word = word(code, x, y);
                take(value, word);
                value += word.values();
            }
        }
    }
}

/// Numbers of the operations that are not [`Word::Apply`]; those of the derive are the same.
fn word(code: u32, x: u32, y: u32) -> Word {
    let (i, j) = (x as usize, y as usize);
    let coefficient = |word: u32| {
        let place = word as usize / 4;
        match word % 4 {
            0 => Coefficient::Constant(place),
            1 => Coefficient::Parameter(place),
            _ => Coefficient::Exact(place),
        }
    };
    match code & 255 {
        0 => Word::Constant(coefficient(x)),
        4 => Word::Offset(coefficient(x), j),
        5 => Word::Scale(coefficient(x), j),
        9 => Word::Ratio(coefficient(x), j),
        11 => Word::Powf(i, coefficient(y)),
        22 => Word::Select((code >> 8) as usize, i, j),
        23 => Word::Set(i, j),
        24 => Word::AddTo(i, j),
        25 => Word::SubtractFrom(i, j),
        operation => Word::Apply(operation, i, j),
    }
}

impl Word {
    /// Sums over earlier coefficients for each new one of a series.
    fn products(self) -> usize {
        match self {
            Word::Ratio(..) | Word::Powf(..) => 1,
            Word::Apply(number, ..) => match Op::of_format(number) {
                Op::Add | Op::Sub | Op::Neg => 0,
                op if op.is_pair() => 2,
                _ => 1,
            },
            _ => 0,
        }
    }

    /// Number of values that it computes.
    fn values(self) -> usize {
        match self {
            Word::Set(..) | Word::AddTo(..) | Word::SubtractFrom(..) => 0,
            Word::Apply(number, ..) if Op::of_format(number).has_two_values() => 2,
            _ => 1,
        }
    }
}
