//! A recorded tape made short: what nothing needs is left out, and sums of sums are one sum.
//!
//! Most operations of equations of motion are linear in what depends on time: scalings by parameters, additions, a
//! division by an inertia. A number that is used once, by such an operation, is never formed: its terms go into the sum
//! that uses it, with factors that are products of what does not depend on time.

use super::Scalar;
use super::instruction::{Instruction, Op, evaluate};
use super::record::{Part, Recording, Slot};
use std::collections::BTreeMap;

/// A term of a sum: factor · number.
type Term = (Slot, Slot);

/// A recorded tape, ready to run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    pub(super) parts: Vec<Part>,
    pub(super) terms: Vec<Term>,
}

/// Runs a method with the registers as an array of the smallest size that holds them.
macro_rules! with_registers {
    ($registers:expr, |$array:ident| $body:expr) => {{
        let registers: &mut [T] = $registers;
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
pub(super) fn room(registers: usize) -> usize {
    let sizes = [512, 4096, 65536, 1048576];
    let size = sizes.into_iter().find(|&size| registers <= size);
    size.expect("the macro's budget leaves a tape fewer than 2²⁰ registers")
}

impl Program {
    /// What `recording` needs to give the registers `roots`. New registers of the recording hold the factors.
    pub fn new<T: Scalar>(recording: &mut Recording<T>, roots: &[Slot]) -> Self {
        let mut shortening = Shortening::new(recording, roots);
        let parts = recording.parts.clone();
        for part in &parts {
            shortening.part(recording, part);
        }
        Self {
            parts: shortening.parts,
            terms: shortening.terms,
        }
    }

    /// Arithmetic operations and function calls of one evaluation.
    pub fn operations(&self) -> usize {
        let lists = self
            .parts
            .iter()
            .flat_map(|p| p.fixed.iter().chain(&p.varying));
        lists.map(Instruction::operations).sum()
    }

    /// Values of part `index` from those of its operands. As many registers as [`Recording::finish`] made.
    #[inline]
    pub fn evaluate<T: Scalar>(&self, index: usize, registers: &mut [T]) {
        let part = &self.parts[index];
        with_registers!(registers, |array| {
            evaluate(&part.fixed, &self.terms, array);
            evaluate(&part.varying, &self.terms, array);
        });
    }
}

/// The work of [`Program::new`].
struct Shortening {
    live: Vec<bool>,
    /// Numbers that are used once, by a linear operation.
    inlined: Vec<bool>,
    /// Their terms.
    forms: BTreeMap<Slot, Vec<Term>>,
    products: BTreeMap<Term, Slot>,
    one: Slot,
    minus_one: Slot,
    parts: Vec<Part>,
    terms: Vec<Term>,
}

impl Shortening {
    fn new<T: Scalar>(recording: &mut Recording<T>, roots: &[Slot]) -> Self {
        let (one, minus_one) = (recording.number(T::one()), recording.number(-T::one()));
        let count = recording.registers();
        let mut live = vec![false; count];
        let mut uses = vec![0_u32; count];
        let mut linear_use = vec![false; count];
        for root in roots {
            live[root.index()] = true;
            uses[root.index()] += 2;
        }
        for part in recording.parts.iter().rev() {
            for instruction in part.varying.iter().rev().chain(part.fixed.iter().rev()) {
                let to = instruction.to.index();
                if !(live[to] || (instruction.is_pair() && live[to + 1])) {
                    continue;
                }
                for operand in instruction.operands(&recording.terms) {
                    live[operand.index()] = true;
                    uses[operand.index()] += 1;
                    linear_use[operand.index()] = instruction.is_linear();
                }
            }
        }
        let once = uses.iter().zip(&linear_use);
        Self {
            live,
            inlined: once.map(|(&uses, &linear)| uses == 1 && linear).collect(),
            forms: BTreeMap::new(),
            products: BTreeMap::new(),
            one,
            minus_one,
            parts: Vec::new(),
            terms: Vec::new(),
        }
    }

    fn part<T: Scalar>(&mut self, recording: &mut Recording<T>, part: &Part) {
        let live = |i: &&Instruction, live: &[bool]| {
            live[i.to.index()] || (i.is_pair() && live[i.to.index() + 1])
        };
        let mut fixed = Vec::new();
        for instruction in part.fixed.iter().filter(|i| live(i, &self.live)) {
            let mut instruction = *instruction;
            if instruction.op == Op::Sum {
                let terms = instruction.x.index()..instruction.y.index();
                instruction.x = Slot::new(self.terms.len());
                self.terms.extend_from_slice(&recording.terms[terms]);
                instruction.y = Slot::new(self.terms.len());
            }
            fixed.push(instruction);
        }
        self.parts.push(Part {
            fixed,
            varying: Vec::new(),
        });
        for instruction in &part.varying {
            if !live(&instruction, &self.live) {
                continue;
            }
            if instruction.is_linear() {
                let form = self.form(recording, instruction);
                if self.inlined[instruction.to.index()] {
                    self.forms.insert(instruction.to, form);
                } else {
                    let instruction = self.sum(instruction.to, &form);
                    self.varying(instruction);
                }
            } else {
                self.varying(*instruction);
            }
        }
    }

    fn varying(&mut self, instruction: Instruction) {
        if let Some(part) = self.parts.last_mut() {
            part.varying.push(instruction);
        }
    }

    /// The terms of a linear operation.
    fn form<T: Scalar>(&mut self, recording: &mut Recording<T>, i: &Instruction) -> Vec<Term> {
        let (one, minus) = (self.one, self.minus_one);
        let direct = match i.op {
            Op::Copy => vec![(one, i.x)],
            Op::Add | Op::Offset => vec![(one, i.x), (one, i.y)],
            Op::Sub => vec![(one, i.x), (minus, i.y)],
            Op::Neg => vec![(minus, i.x)],
            Op::Scale => vec![(i.x, i.y)],
            Op::DivConstant => {
                let inverse = self.fixed(recording, Op::DivConstant, one, i.y);
                vec![(inverse, i.x)]
            }
            _ => recording.terms[i.x.index()..i.y.index()].to_vec(),
        };
        let mut form: Vec<Term> = Vec::with_capacity(direct.len());
        for (factor, number) in direct {
            match self.forms.remove(&number) {
                None => form.push((factor, number)),
                Some(parts) => {
                    for (inner, number) in parts {
                        let factor = self.product(recording, factor, inner);
                        form.push((factor, number));
                    }
                }
            }
        }
        form
    }

    /// The product of two factors.
    fn product<T: Scalar>(&mut self, recording: &mut Recording<T>, x: Slot, y: Slot) -> Slot {
        if x == self.one {
            return y;
        }
        if y == self.one {
            return x;
        }
        match recording.known_product(x, y) {
            Some(product) => product,
            None => self.fixed(recording, Op::Mul, x.min(y), x.max(y)),
        }
    }

    /// A number that does not depend on time.
    fn fixed<T: Scalar>(&mut self, recording: &mut Recording<T>, op: Op, x: Slot, y: Slot) -> Slot {
        let key = if op == Op::Mul { (x, y) } else { (Slot(0), y) };
        if let Some(&known) = self.products.get(&key) {
            return known;
        }
        let to = recording.fresh();
        if let Some(part) = self.parts.last_mut() {
            part.fixed.push(Instruction { op, to, x, y });
        }
        self.products.insert(key, to);
        to
    }

    /// The shortest operation for a sum.
    fn sum(&mut self, to: Slot, form: &[Term]) -> Instruction {
        let (one, minus) = (self.one, self.minus_one);
        let (op, x, y) = match *form {
            [(f, x)] if f == one => (Op::Copy, x, x),
            [(f, x)] if f == minus => (Op::Neg, x, Slot(0)),
            [(f, x)] => (Op::Scale, f, x),
            [(f, x), (g, y)] if f == one && g == one => (Op::Add, x, y),
            [(f, x), (g, y)] if f == one && g == minus => (Op::Sub, x, y),
            [(f, x), (g, y)] if f == minus && g == one => (Op::Sub, y, x),
            _ => {
                let first = self.terms.len();
                self.terms.extend_from_slice(form);
                let op = if form.len() == 2 { Op::Sum2 } else { Op::Sum };
                (op, Slot::new(first), Slot::new(self.terms.len()))
            }
        };
        Instruction { op, to, x, y }
    }
}
