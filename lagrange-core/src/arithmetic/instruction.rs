//! The operations of a recorded tape, and their values.

use super::Scalar;
use super::record::Slot;

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
    /// Σ factor · number over terms x..y of the list of terms
    Sum,
    /// The same over the two terms from x on
    Sum2,
}

/// An operation, where its operands are, and where its result goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Instruction {
    pub op: Op,
    pub to: Slot,
    pub x: Slot,
    pub y: Slot,
}

impl Instruction {
    /// The registers that it reads.
    pub(super) fn operands<'a>(
        &self,
        terms: &'a [(Slot, Slot)],
    ) -> impl Iterator<Item = Slot> + use<'a> {
        let (own, terms) = match self.op {
            Op::Copy => ([self.x, Slot(0)], &terms[..0]),
            Op::Sum | Op::Sum2 => ([Slot(0); 2], &terms[self.x.index()..self.y.index()]),
            _ => ([self.x, self.y], &terms[..0]),
        };
        let listed = terms.iter().flat_map(|&(factor, slot)| [factor, slot]);
        own.into_iter().chain(listed).filter(|slot| slot.0 > 0)
    }

    /// Arithmetic operations and function calls that it takes.
    pub(super) fn operations(&self) -> usize {
        match self.op {
            Op::Copy => 0,
            Op::Sum | Op::Sum2 => 2 * (self.y.index() - self.x.index()) - 1,
            _ => 1,
        }
    }

    /// Whether its coefficients are sums of its operands' with factors that do not depend on time.
    pub(super) fn is_linear(&self) -> bool {
        matches!(
            self.op,
            Op::Copy
                | Op::Add
                | Op::Sub
                | Op::Neg
                | Op::Offset
                | Op::Scale
                | Op::DivConstant
                | Op::Sum
        )
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

/// Runs a list for values. The number of registers is a power of two, `N` if that many: then no index needs a check.
#[inline(always)]
pub(super) fn evaluate<T: Scalar, const N: usize>(
    list: &[Instruction],
    terms: &[(Slot, Slot)],
    r: &mut [T; N],
) {
    for &Instruction { op, to, x, y } in list {
        let at = |slot: Slot| r[slot.index() & (N - 1)];
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
                    .fold(T::zero(), |sum, &(factor, x)| sum + at(factor) * at(x))
            }
            Op::Sum2 => {
                let [(f, x), (g, y)] = [terms[x.index()], terms[x.index() + 1]];
                at(f) * at(x) + at(g) * at(y)
            }
            _ => {
                let (first, second) = pair(op, at(x), at(y));
                r[(to.index() + 1) & (N - 1)] = second;
                first
            }
        };
        r[to.index() & (N - 1)] = value;
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
