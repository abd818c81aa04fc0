//! The operations of a recorded tape, and their values.

use super::record::Slot;
use super::Scalar;

/// What an instruction computes from its operands x and y.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Op {
    /// x; y only tells copies apart
    Copy,
    Add,
    Sub,
    Neg,
    /// x + y for an x that does not depend on time
    Offset,
    /// x y for an x that does not depend on time
    Scale,
    Mul,
    Square,
    Div,
    /// x / y for a y that does not depend on time
    DivConstant,
    /// x / y for an x that does not depend on time
    Ratio,
    Sqrt,
    /// xʸ, y a known real number
    Powf,
    Exp,
    Ln,
    /// sin x, and cos x in the next register
    SinCos,
    /// sinh x, and cosh x in the next register
    SinhCosh,
    /// tan x, and 1 + tan² x in the next register
    Tan,
    /// tanh x, and 1 − tanh² x in the next register
    Tanh,
    /// asin x, and √(1 − x²) in the next register
    Asin,
    /// acos x, and √(1 − x²) in the next register
    Acos,
    /// atan x, and 1 + x² in the next register
    Atan,
    /// Angle of the point (y, x), and x² + y² in the next register
    Atan2,
    /// Σ over terms x..y of the list of terms
    Sum,
}

/// An operation, where its operands are, and where its result goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction {
    pub op: Op,
    pub to: Slot,
    pub x: Slot,
    pub y: Slot,
}

impl Instruction {
    /// The registers that it reads.
    pub(super) fn operands<'a, T>(
        &self,
        terms: &'a [(T, Slot)],
    ) -> impl Iterator<Item = Slot> + use<'a, T> {
        let (own, terms) = match self.op {
            Op::Copy => ([self.x, self.x], &terms[..0]),
            Op::Sum => ([Slot(0); 2], &terms[self.x.index()..self.y.index()]),
            _ => ([self.x, self.y], &terms[..0]),
        };
        own.into_iter().chain(terms.iter().map(|&(_, slot)| slot))
    }

    /// Whether the register after `to` is written as well.
    pub(super) fn is_pair(&self) -> bool {
        matches!(
            self.op,
            Op::SinCos
                | Op::SinhCosh
                | Op::Tan
                | Op::Tanh
                | Op::Asin
                | Op::Acos
                | Op::Atan
                | Op::Atan2
        )
    }
}

/// Runs a list for values.
#[inline]
pub(super) fn evaluate<T: Scalar>(list: &[Instruction], terms: &[(T, Slot)], r: &mut [T]) {
    for &Instruction { op, to, x, y } in list {
        let at = |slot: Slot| r[slot.index()];
        let value = match op {
            Op::Copy => at(x),
            Op::Add | Op::Offset => at(x) + at(y),
            Op::Sub => at(x) - at(y),
            Op::Neg => -at(x),
            Op::Scale | Op::Mul => at(x) * at(y),
            Op::Square => at(x) * at(x),
            Op::Div | Op::DivConstant | Op::Ratio => at(x) / at(y),
            Op::Sqrt => at(x).sqrt(),
            Op::Powf => at(x).powf(at(y).value()),
            Op::Exp => at(x).exp(),
            Op::Ln => at(x).ln(),
            Op::Sum => {
                let terms = &terms[x.index()..y.index()];
                terms
                    .iter()
                    .fold(T::zero(), |sum, &(factor, x)| sum + factor * at(x))
            }
            _ => {
                let (first, second) = pair(op, at(x), at(y));
                r[to.index() + 1] = second;
                first
            }
        };
        r[to.index()] = value;
    }
}

/// Values of the operations with two results.
#[inline(always)]
fn pair<T: Scalar>(op: Op, x: T, y: T) -> (T, T) {
    let one = T::one();
    match op {
        Op::SinCos => x.sin_cos(),
        Op::SinhCosh => x.sinh_cosh(),
        Op::Tan => {
            let z = x.tan();
            (z, one + z * z)
        }
        Op::Tanh => {
            let z = x.tanh();
            (z, one - z * z)
        }
        Op::Asin => (x.asin(), ((one - x) * (one + x)).sqrt()),
        Op::Acos => (x.acos(), ((one - x) * (one + x)).sqrt()),
        Op::Atan => (x.atan(), one + x * x),
        _ => (x.atan2(y), x * x + y * y),
    }
}
