//! What a program is made of: straight-line operations in masked blocks.
//!
//! The operations are those of the core's `program`, so emission is a transcription. A tape is
//! in single assignment: value `i < inputs` is input `i`, every step defines the next value (or two).

use super::needs::OutputMask;
use crate::symbolic::Rational;

/// A value of a tape.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Value(pub usize);

/// A number that is fixed during a run.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Coefficient {
    /// An exact number.
    Number(Rational),
    /// An exact multiple of π.
    Pi(Rational),
    /// Parameter i of the struct.
    Parameter(usize),
    /// Element i of the constants.
    Constant(usize),
}

impl Coefficient {
    /// The number nearest to c π.
    pub fn multiple_of_pi(c: Rational) -> f64 {
        std::f64::consts::PI * c.to_f64()
    }
}

/// One operation. In the constants and starts a value is a scalar, in the tapes a node.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Operation {
    /// c
    Constant(Coefficient),
    /// x + y
    Add(Value, Value),
    /// x − y
    Sub(Value, Value),
    /// −x
    Neg(Value),
    /// c + x
    Offset(Coefficient, Value),
    /// c x
    Scale(Coefficient, Value),
    /// x y
    Mul(Value, Value),
    /// x²
    Square(Value),
    /// x / y
    Div(Value, Value),
    /// c / x
    Ratio(Coefficient, Value),
    /// √x
    Sqrt(Value),
    /// xᶜ
    Powf(Value, Rational),
    /// eˣ
    Exp(Value),
    /// ln x
    Ln(Value),
    /// (sin x, cos x): two values
    SinCos(Value),
    /// (sinh x, cosh x): two values
    SinhCosh(Value),
    /// tan x
    Tan(Value),
    /// tanh x
    Tanh(Value),
    /// asin x
    Asin(Value),
    /// acos x
    Acos(Value),
    /// atan x
    Atan(Value),
    /// Angle of the point (x, y): (y, x).
    Atan2(Value, Value),
    /// The first value while the branch is on its `then` side, else the second.
    Select(usize, Value, Value),
    /// In starts: the second value if the first is ≥ 0, else the third.
    Choose(Value, Value, Value),
}

impl Operation {
    /// Number of values that it defines.
    pub fn values(self) -> usize {
        match self {
            Operation::SinCos(_) | Operation::SinhCosh(_) => 2,
            _ => 1,
        }
    }

    /// Whether it is arithmetic: setting a constant or choosing between two nodes is not.
    pub fn is_work(self) -> bool {
        !matches!(
            self,
            Operation::Constant(_) | Operation::Select(..) | Operation::Choose(..)
        )
    }

    /// The values that it reads.
    pub fn operands(self) -> Vec<Value> {
        use Operation::*;
        match self {
            Constant(_) => Vec::new(),
            Add(x, y) | Sub(x, y) | Mul(x, y) | Div(x, y) | Atan2(x, y) | Select(_, x, y) => {
                vec![x, y]
            }
            Neg(x)
            | Offset(_, x)
            | Scale(_, x)
            | Square(x)
            | Ratio(_, x)
            | Sqrt(x)
            | Powf(x, _)
            | Exp(x)
            | Ln(x)
            | SinCos(x)
            | SinhCosh(x)
            | Tan(x)
            | Tanh(x)
            | Asin(x)
            | Acos(x)
            | Atan(x) => vec![x],
            Choose(x, y, z) => vec![x, y, z],
        }
    }

    /// The coefficient that it reads.
    pub fn coefficient(self) -> Option<Coefficient> {
        match self {
            Operation::Constant(c)
            | Operation::Offset(c, _)
            | Operation::Scale(c, _)
            | Operation::Ratio(c, _) => Some(c),
            _ => None,
        }
    }

    /// The same operation with its operands renamed.
    pub fn renamed(self, name: impl Fn(Value) -> Value) -> Operation {
        use Operation::*;
        match self {
            Constant(c) => Constant(c),
            Add(x, y) => Add(name(x), name(y)),
            Sub(x, y) => Sub(name(x), name(y)),
            Neg(x) => Neg(name(x)),
            Offset(c, x) => Offset(c, name(x)),
            Scale(c, x) => Scale(c, name(x)),
            Mul(x, y) => Mul(name(x), name(y)),
            Square(x) => Square(name(x)),
            Div(x, y) => Div(name(x), name(y)),
            Ratio(c, x) => Ratio(c, name(x)),
            Sqrt(x) => Sqrt(name(x)),
            Powf(x, c) => Powf(name(x), c),
            Exp(x) => Exp(name(x)),
            Ln(x) => Ln(name(x)),
            SinCos(x) => SinCos(name(x)),
            SinhCosh(x) => SinhCosh(name(x)),
            Tan(x) => Tan(name(x)),
            Tanh(x) => Tanh(name(x)),
            Asin(x) => Asin(name(x)),
            Acos(x) => Acos(name(x)),
            Atan(x) => Atan(name(x)),
            Atan2(y, x) => Atan2(name(y), name(x)),
            Select(branch, x, y) => Select(branch, name(x), name(y)),
            Choose(g, x, y) => Choose(name(g), name(x), name(y)),
        }
    }
}

/// An operation with its place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Step {
    /// First value that it defines.
    pub value: Value,
    /// What it does.
    pub operation: Operation,
}

/// How a value enters an output.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Mode {
    /// The output becomes the value.
    Set,
    /// The value is added.
    Add,
    /// The value is subtracted.
    Sub,
}

/// A value enters an output.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Write {
    /// Index of the output.
    pub output: usize,
    /// The value.
    pub value: Value,
    /// How.
    pub mode: Mode,
}

/// Steps that run together: if one of the needs is held.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Block {
    /// Who asks.
    pub needs: OutputMask,
    /// The work, in order.
    pub steps: Vec<Step>,
    /// What it delivers, after the steps.
    pub writes: Vec<Write>,
}

/// A straight-line program. There is one block for each distinct need set, larger sets first: whoever uses a value
/// also asks for its operands, so operands have the same set or a larger one.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Tape {
    /// Number of inputs; they are the first values.
    pub inputs: usize,
    /// Number of values, with the inputs.
    pub values: usize,
    /// Number of outputs.
    pub outputs: usize,
    /// The program.
    pub blocks: Vec<Block>,
}

impl Tape {
    /// Number of arithmetic operations that run while `held` (words of a need mask) is held.
    pub fn operations(&self, held: &[u64]) -> usize {
        let blocks = self.blocks.iter().filter(|block| block.needs.runs(held));
        blocks
            .map(|block| {
                let sums = block
                    .writes
                    .iter()
                    .filter(|write| write.mode != Mode::Set)
                    .count();
                block
                    .steps
                    .iter()
                    .filter(|step| step.operation.is_work())
                    .count()
                    + sums
            })
            .sum()
    }
}
