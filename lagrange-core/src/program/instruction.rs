//! What the interpreter runs: operations on registers, for values.

use crate::arithmetic::Scalar;

/// A register of a program. Register 0 is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Register(u32);

impl Register {
    /// The register that holds zero.
    pub(crate) const ZERO: Self = Self(0);

    /// Register number `index`.
    #[inline(always)]
    pub(crate) fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// Its number.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }

    /// Whether it holds zero.
    #[inline(always)]
    pub(crate) fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// The register after it: that of a second result.
    #[inline(always)]
    pub(crate) fn next(self) -> Self {
        Self(self.0 + 1)
    }
}

/// What an instruction computes from its operands x and y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Op {
    /// x
    Copy,
    Add,
    Sub,
    Neg,
    /// x y for an x that does not depend on time
    Scale,
    Mul,
    Square,
    Div,
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
    /// Σ factor · number over terms x..y of the list of terms, the factors independent of time
    Sum,
}

impl Op {
    /// The operation with this number in an [`Encoded`](super::Encoded) program.
    pub(super) fn of_format(number: u32) -> Self {
        match number {
            1 => Op::Add,
            2 => Op::Sub,
            3 => Op::Neg,
            6 => Op::Mul,
            7 => Op::Square,
            8 => Op::Div,
            10 => Op::Sqrt,
            12 => Op::Exp,
            13 => Op::Ln,
            14 => Op::SinCos,
            15 => Op::SinhCosh,
            16 => Op::Tan,
            17 => Op::Tanh,
            18 => Op::Asin,
            19 => Op::Acos,
            20 => Op::Atan,
            21 => Op::Atan2,
            _ => unreachable!("the derive and the core of one version agree on the format"),
        }
    }

    /// Whether it reads y.
    pub(super) fn has_two_operands(self) -> bool {
        use Op::*;
        matches!(self, Add | Sub | Scale | Mul | Div | Powf | Atan2)
    }

    /// Whether it has two results, each a value of the program.
    pub(super) fn has_two_values(self) -> bool {
        matches!(self, Op::SinCos | Op::SinhCosh)
    }

    /// Whether the register after the result is written as well.
    pub(super) fn is_pair(self) -> bool {
        use Op::*;
        matches!(
            self,
            SinCos | SinhCosh | Tan | Tanh | Asin | Acos | Atan | Atan2
        )
    }
}

/// An operation, where its operands are, and where its result goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Instruction {
    pub op: Op,
    pub to: Register,
    pub x: Register,
    pub y: Register,
}

impl Instruction {
    /// The registers that it reads.
    fn operands(self, terms: &[(Register, Register)]) -> impl Iterator<Item = Register> + '_ {
        let (own, terms) = match self.op {
            Op::Sum => ([Register::ZERO; 2], &terms[self.x.index()..self.y.index()]),
            _ => ([self.x, self.y], &terms[..0]),
        };
        let listed = terms.iter().flat_map(|&(factor, x)| [factor, x]);
        own.into_iter().chain(listed)
    }

    /// Arithmetic operations and function calls that it takes.
    fn operations(self) -> usize {
        match self.op {
            Op::Copy => 0,
            Op::Sum => 2 * (self.y.index() - self.x.index()) - 1,
            _ => 1,
        }
    }
}

/// Instructions in order, in parts that run one by one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Program {
    pub(super) parts: Vec<Vec<Instruction>>,
    /// (factor, register) of the sums.
    pub(super) terms: Vec<(Register, Register)>,
}

impl Program {
    /// Per register, of so many: whether its value depends on that of `source`.
    pub(crate) fn dependents(&self, source: Register, registers: usize) -> Vec<bool> {
        let mut depends = vec![false; registers];
        depends[source.index()] = true;
        for instruction in self.parts.iter().flatten() {
            let mut operands = instruction.operands(&self.terms);
            if operands.any(|register| depends[register.index()]) {
                depends[instruction.to.index()] = true;
            }
        }
        depends
    }
}

/// Runs a method with the registers as an array of the smallest size that holds them: then no index needs a check.
macro_rules! with_registers {
    ($registers:expr, |$array:ident| $body:expr) => {{
        let registers: &mut [_] = $registers;
        if let Some($array) = registers.first_chunk_mut::<1048576>() {
            $body
        } else if let Some($array) = registers.first_chunk_mut::<65536>() {
            $body
        } else if let Some($array) = registers.first_chunk_mut::<4096>() {
            $body
        } else if let Some($array) = registers.first_chunk_mut::<512>() {
            $body
        }
    }};
}
pub(super) use with_registers;

/// The smallest size that holds so many registers.
pub(crate) fn room(registers: usize) -> usize {
    let sizes = [512, 4096, 65536, 1048576];
    let size = sizes.into_iter().find(|&size| registers <= size);
    size.expect("the macro's budget leaves a program fewer than 2²⁰ registers")
}

impl Program {
    /// The same without what nothing needs that is to be in the registers `roots`.
    pub(crate) fn needed(&self, roots: impl Iterator<Item = Register>, registers: usize) -> Self {
        let mut live = vec![false; registers + 1];
        roots.for_each(|root| live[root.index()] = true);
        let mut parts: Vec<Vec<Instruction>> = Vec::with_capacity(self.parts.len());
        for part in self.parts.iter().rev() {
            let mut kept = Vec::with_capacity(part.len());
            for &instruction in part.iter().rev() {
                let to = instruction.to;
                let second = instruction.op.is_pair() && live[to.next().index()];
                if live[to.index()] || second {
                    let operands = instruction.operands(&self.terms);
                    operands.for_each(|operand| live[operand.index()] = true);
                    kept.push(instruction);
                }
            }
            kept.reverse();
            parts.push(kept);
        }
        parts.reverse();
        Self {
            parts,
            terms: self.terms.clone(),
        }
    }

    /// Arithmetic operations and function calls of one evaluation.
    pub(crate) fn operations(&self) -> usize {
        self.parts.iter().flatten().map(|i| i.operations()).sum()
    }

    /// Values of part `index` from those of its operands. There are as many registers as [`room`] says.
    #[inline]
    pub(crate) fn evaluate<T: Scalar>(&self, index: usize, registers: &mut [T]) {
        with_registers!(registers, |array| evaluate(
            &self.parts[index],
            &self.terms,
            array
        ));
    }
}

/// Runs a list for values.
#[inline(always)]
fn evaluate<T: Scalar, const N: usize>(
    list: &[Instruction],
    terms: &[(Register, Register)],
    r: &mut [T; N],
) {
    for &Instruction { op, to, x, y } in list {
        let at = |register: Register| r[register.index() & (N - 1)];
        let value = match op {
            Op::Copy => at(x),
            Op::Add => at(x) + at(y),
            Op::Sub => at(x) - at(y),
            Op::Neg => -at(x),
            Op::Scale | Op::Mul => at(x) * at(y),
            Op::Square => at(x) * at(x),
            Op::Div => at(x) / at(y),
            Op::Sqrt => at(x).sqrt(),
            Op::Powf => at(x).powf(at(y).value()),
            Op::Exp => at(x).exp(),
            Op::Ln => at(x).ln(),
            Op::Sum => {
                let terms = terms[x.index()..y.index()].iter();
                terms.fold(T::zero(), |sum, &(factor, x)| sum + at(factor) * at(x))
            }
            _ => {
                let (first, second) = pair(op, at(x), at(y));
                r[to.next().index() & (N - 1)] = second;
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
