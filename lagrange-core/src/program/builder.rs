//! Makes a program: encoded ones are loaded, and what a mode adds to them is written after.
//!
//! What is known to be zero in the mode does not become an instruction.

use super::encoded::{Coefficient, Encoded, Word};
use super::instruction::{Instruction, Op, Program, Register};
use super::selection::Selection;

/// Where the numbers are that a program reads: each list in registers that follow one another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    /// The first constant.
    pub constants: usize,
    /// The first parameter.
    pub parameters: usize,
    /// The first of the exact numbers of the encoded program.
    pub exact: usize,
}

impl Numbers {
    fn register(&self, coefficient: Coefficient) -> Register {
        Register::new(match coefficient {
            Coefficient::Constant(place) => self.constants + place,
            Coefficient::Parameter(place) => self.parameters + place,
            Coefficient::Exact(place) => self.exact + place,
        })
    }
}

/// A program that is being made.
#[derive(Clone, Debug)]
pub(crate) struct Builder {
    program: Program,
    registers: usize,
    /// Of the first registers, those whose number is zero for the parameters at hand.
    vanishing: Vec<bool>,
}

impl Builder {
    /// An empty program whose results go to registers from number `registers` on.
    pub(crate) fn new(registers: usize) -> Self {
        let program = Program {
            parts: vec![Vec::new()],
            terms: Vec::new(),
        };
        Self {
            program,
            registers,
            vanishing: Vec::new(),
        }
    }

    /// The same where the first registers with `true` hold zero: an effect whose factor vanishes is not there.
    pub(crate) fn vanishing(mut self, vanishing: Vec<bool>) -> Self {
        self.vanishing = vanishing;
        self
    }

    /// The register, or that of zero if it holds zero.
    fn known(&self, x: Register) -> Register {
        match self.vanishing.get(x.index()) {
            Some(true) => Register::ZERO,
            _ => x,
        }
    }

    /// The program, and the number of registers that it uses.
    pub(crate) fn finish(self) -> (Program, usize) {
        (self.program, self.registers)
    }

    /// Begins the next part.
    pub(crate) fn cut(&mut self) {
        self.program.parts.push(Vec::new());
    }

    /// A register of its own.
    pub(crate) fn fresh(&mut self) -> Register {
        self.registers += 1;
        Register::new(self.registers - 1)
    }

    fn write(&mut self, op: Op, to: Register, x: Register, y: Register) {
        if let Some(part) = self.program.parts.last_mut() {
            part.push(Instruction { op, to, x, y });
        }
    }

    /// The result of an operation.
    pub(crate) fn push(&mut self, op: Op, x: Register, y: Register) -> Register {
        let (x, y) = (self.known(x), self.known(y));
        let known = match (op, x.is_zero(), y.is_zero()) {
            (Op::Add, true, _) => Some(y),
            (Op::Add | Op::Sub, _, true) => Some(x),
            (Op::Sub, true, _) => return self.push(Op::Neg, y, Register::ZERO),
            (Op::Scale | Op::Mul, true, _) | (Op::Scale | Op::Mul, _, true) => Some(Register::ZERO),
            (Op::Neg | Op::Square, true, _) => Some(x),
            _ => None,
        };
        known.unwrap_or_else(|| {
            let to = self.fresh();
            if op.is_pair() {
                self.fresh();
            }
            self.write(op, to, x, y);
            to
        })
    }

    /// The same number in a register of choice; zero stays where it is.
    pub(crate) fn copy(&mut self, to: Register, x: Register) {
        if !x.is_zero() && x != to {
            self.write(Op::Copy, to, x, Register::ZERO);
        }
    }

    /// Σ factor · number
    pub(crate) fn sum(&mut self, terms: impl Iterator<Item = (Register, Register)>) -> Register {
        let first = self.program.terms.len();
        for (factor, x) in terms {
            let (factor, x) = (self.known(factor), self.known(x));
            if !factor.is_zero() && !x.is_zero() {
                self.program.terms.push((factor, x));
            }
        }
        match self.program.terms[first..] {
            [] => Register::ZERO,
            [(factor, x)] => {
                self.program.terms.truncate(first);
                self.push(Op::Scale, factor, x)
            }
            _ => {
                let end = self.program.terms.len();
                let to = self.fresh();
                self.write(Op::Sum, to, Register::new(first), Register::new(end));
                to
            }
        }
    }

    /// Appends an encoded program for what is held, with its inputs in these registers; gives those of its outputs, none for what is
    /// not asked for.
    pub(crate) fn load(
        &mut self,
        encoded: &Encoded,
        held: &Selection,
        numbers: Numbers,
        inputs: &[Register],
    ) -> Vec<Option<Register>> {
        let mut values = inputs.to_vec();
        values.resize(encoded.values.max(inputs.len()), Register::ZERO);
        let mut outputs = vec![None; encoded.outputs];
        encoded.read(held.needs, |value, word| {
            let result = match word {
                Word::Constant(c) => numbers.register(c),
                Word::Offset(c, x) => self.push(Op::Add, numbers.register(c), values[x]),
                Word::Scale(c, x) => self.push(Op::Scale, numbers.register(c), values[x]),
                Word::Ratio(c, x) => self.push(Op::Div, numbers.register(c), values[x]),
                Word::Powf(x, c) => self.push(Op::Powf, values[x], numbers.register(c)),
                Word::Select(branch, x, y) => values[if held.branch(branch) { x } else { y }],
                Word::Apply(number, x, y) => {
                    let op = Op::of_format(number);
                    let y = if op.has_two_operands() {
                        values[y]
                    } else {
                        Register::ZERO
                    };
                    let result = self.push(op, values[x], y);
                    if op.has_two_values() {
                        values[value + 1] = result.next();
                    }
                    result
                }
                Word::Set(output, x) => {
                    outputs[output] = Some(values[x]);
                    return;
                }
                Word::AddTo(output, x) => {
                    let sum = outputs[output].unwrap_or_default();
                    outputs[output] = Some(self.push(Op::Add, sum, values[x]));
                    return;
                }
                Word::SubtractFrom(output, x) => {
                    let sum = outputs[output].unwrap_or_default();
                    outputs[output] = Some(self.push(Op::Sub, sum, values[x]));
                    return;
                }
            };
            values[value] = result;
        });
        outputs
    }
}
