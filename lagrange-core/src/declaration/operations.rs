//! The operations that declared values are made of, and what they alone tell of the values: which of them may grow or jump where a series does
//! not show it.

use super::series::{ACOS, ASIN, ATAN, COSH, EXP, LN, SINH, TAN, TANH};
use super::{BYTES, Declaration, op};
use core::f64::consts::{PI, TAU};
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug)]
pub(super) struct Operation {
    /// The value that it defines.
    pub(super) value: usize,
    pub(super) code: u32,
    /// The operand that chooses.
    pub(super) guard: usize,
    pub(super) x: usize,
    pub(super) y: usize,
}

impl Operation {
    /// An operation from its words.
    fn read((value, words): (usize, &[u8])) -> Self {
        let word = |k: usize| {
            let bytes = [words[k], words[k + 1], words[k + 2], words[k + 3]];
            u32::from_le_bytes(bytes)
        };
        Self {
            value,
            code: word(0) & 255,
            guard: (word(0) >> 8) as usize,
            x: word(4) as usize,
            y: word(8) as usize,
        }
    }

    /// Operands that are values.
    pub(super) fn operands(&self) -> impl Iterator<Item = usize> {
        let (x, y, guard) = (Some(self.x), Some(self.y), Some(self.guard));
        let values = match self.code {
            op::NUMBER | op::PARAMETER | op::TIME | op::POSITION | op::FORCE | op::LOAD => {
                [None; 3]
            }
            op::ADD | op::MULTIPLY | op::ATAN2 => [x, y, None],
            op::SELECT => [x, y, guard],
            _ => [x, None, None],
        };
        values.into_iter().flatten()
    }

    /// The function that it calls.
    fn function(&self) -> Option<u32> {
        self.code.checked_sub(op::FUNCTIONS)
    }
}

/// The operations that some values of a declaration are made of, in the order of evaluation.
#[derive(Clone, Debug)]
pub(crate) struct Operations {
    declaration: &'static Declaration,
    list: Vec<Operation>,
}

impl Operations {
    /// The operations that the wanted values are made of.
    pub(crate) fn of(
        declaration: &'static Declaration,
        wanted: impl IntoIterator<Item = usize>,
    ) -> Self {
        let words = declaration.words.chunks_exact(BYTES).enumerate();
        let list = words.map(Operation::read).collect();
        Self { declaration, list }.within(wanted)
    }

    /// The operations among these that the wanted values are made of.
    fn within(&self, wanted: impl IntoIterator<Item = usize>) -> Self {
        let mut needed = vec![false; self.declaration.len()];
        wanted.into_iter().for_each(|value| needed[value] = true);
        for operation in self.list.iter().rev() {
            if needed[operation.value] {
                operation.operands().for_each(|x| needed[x] = true);
            }
        }
        let list = self.list.iter().filter(|o| needed[o.value]);
        Self {
            declaration: self.declaration,
            list: list.copied().collect(),
        }
    }

    /// The operations, by ascending values.
    pub(super) fn iter(&self) -> impl Iterator<Item = Operation> {
        self.list.iter().copied()
    }

    /// Arguments of the functions that fall off exponentially, and by how much the exponent changes with each.
    pub(crate) fn exponents(&self) -> impl Iterator<Item = (usize, f64)> {
        let mut exponents: BTreeMap<usize, f64> = BTreeMap::new();
        for operation in &self.list {
            let factor = match operation.function() {
                Some(SINH | COSH | EXP) => 1.0,
                Some(TANH) => 2.0,
                _ => continue,
            };
            let known = exponents.entry(operation.x).or_default();
            *known = known.max(factor);
        }
        exponents.into_iter()
    }

    /// The bases of powers, with the power to which each is a factor all in all: −12 for (s/x)¹² of x, and of (1 + cos t)⁴⁰ the sum with 40.
    pub(crate) fn powers(&self) -> impl Iterator<Item = (usize, f64)> {
        // To which power each value is raised where it is a factor.
        let mut raised = vec![1.0_f64; self.declaration.len()];
        let mut powers: BTreeMap<(usize, bool), f64> = BTreeMap::new();
        for operation in self.list.iter().rev() {
            let (times, x) = (raised[operation.value], operation.x);
            let mut raise = |value: usize, times: f64| {
                if times.abs() > raised[value].abs() {
                    raised[value] = times;
                }
            };
            match operation.code {
                op::MULTIPLY => {
                    raise(x, times);
                    raise(operation.y, times);
                }
                op::POWER => {
                    let times = times * self.exponent(operation);
                    raise(x, times);
                    let known = powers.entry((x, times < 0.0)).or_default();
                    if times.abs() > known.abs() {
                        *known = times;
                    }
                }
                _ => {}
            }
        }
        let powers = powers.into_iter();
        powers.map(|((base, _), power)| (base, power))
    }

    /// The functions that grow exponentially.
    pub(crate) fn exponentials(&self) -> impl Iterator<Item = usize> {
        let grows = |o: &&Operation| matches!(o.function(), Some(SINH | COSH | EXP));
        self.list.iter().filter(grows).map(|o| o.value)
    }

    /// The arguments of the logarithms.
    pub(crate) fn logarithms(&self) -> impl Iterator<Item = usize> {
        self.arguments_of(&[LN])
    }

    /// The arguments of `atan` that have no poles.
    pub(crate) fn arctangents(&self) -> impl Iterator<Item = usize> {
        let arguments = self.arguments_of(&[ATAN]);
        arguments.filter(|&argument| !self.has_poles(argument))
    }

    /// The arguments of `asin` and `acos`, which have a corner where these are ±1.
    pub(crate) fn arcs(&self) -> impl Iterator<Item = usize> {
        self.arguments_of(&[ASIN, ACOS])
    }

    fn arguments_of(&self, functions: &'static [u32]) -> impl Iterator<Item = usize> {
        let calls = self.list.iter();
        let calls = calls.filter(|o| o.function().is_some_and(|f| functions.contains(&f)));
        calls.map(|o| o.x)
    }

    /// The angles that jump, and by how much: those of `atan2` by 2π at a cut, and those of `atan` by π where their argument has a pole.
    pub(crate) fn angles(&self) -> impl Iterator<Item = (usize, f64)> {
        self.list.iter().filter_map(|o| match o.code {
            op::ATAN2 => Some((o.value, TAU)),
            _ if o.function() == Some(ATAN) && self.has_poles(o.x) => Some((o.value, PI)),
            _ => None,
        })
    }

    /// Whether a value may be infinite between finite ones: the tangent of what varies is in it, or what varies is divided by.
    pub(crate) fn has_poles(&self, value: usize) -> bool {
        let varies = |value: usize| {
            let mut parts = self.within([value]).list.into_iter();
            parts.any(|o| matches!(o.code, op::TIME | op::POSITION | op::FORCE | op::LOAD))
        };
        self.within([value]).list.iter().any(|o| match o.code {
            op::POWER => self.exponent(o) < 0.0 && varies(o.x),
            _ => o.function() == Some(TAN) && varies(o.x),
        })
    }

    /// Whether there are logarithms: below zero they have derivatives, and no values.
    pub(crate) fn has_logarithms(&self) -> bool {
        self.logarithms().next().is_some()
    }

    /// Why an operation has no value for this operand, in words; nothing where one is beyond all numbers.
    pub(super) fn no_value(&self, operation: &Operation, x: f64) -> Option<String> {
        let of = |name: &str| Some(format!("{name}({x})"));
        match operation.code {
            op::POWER if self.exponent(operation) < 0.0 && x == 0.0 => {
                Some("a division by 0".to_owned())
            }
            op::POWER if x < 0.0 => Some(format!("({x})^{}", self.exponent(operation))),
            _ => match operation.function()? {
                LN => of("ln"),
                ASIN => of("asin"),
                ACOS => of("acos"),
                _ => None,
            },
        }
    }

    /// The bases of the roots, with an exponent of a half and whole numbers, and whether velocities or the time are in them: those a motion often takes
    /// through zero, as it takes |v| of a body that turns back.
    pub(crate) fn roots(&self) -> impl Iterator<Item = (usize, bool)> {
        let is_root =
            |o: &&Operation| o.code == op::POWER && (2.0 * self.exponent(o)).rem_euclid(2.0) == 1.0;
        let turns = |base: usize| {
            let mut parts = self.within([base]).list.into_iter();
            parts.any(|o| matches!(o.code, op::DERIVATIVE | op::TIME))
        };
        let mut bases: Vec<usize> = self.list.iter().filter(is_root).map(|o| o.x).collect();
        bases.dedup();
        bases.into_iter().map(move |base| (base, turns(base)))
    }

    /// Whether values, or their gradients, may jump where no branch says so: at the cut of an `atan2`, at the ends of `asin` and `acos`, where what a
    /// root is taken of vanishes, or at the poles of what `atan`, `tanh` and `exp` have different limits for on both sides.
    pub(crate) fn may_jump(&self) -> bool {
        self.list.iter().any(|o| match o.code {
            _ if matches!(o.function(), Some(ASIN | ACOS)) => true,
            _ if matches!(o.function(), Some(ATAN | TANH | EXP)) => self.has_poles(o.x),
            op::ATAN2 => true,
            op::POWER => self.exponent(o).fract() != 0.0,
            _ => false,
        })
    }

    /// Whether the time is in the values.
    pub(crate) fn reads_time(&self) -> bool {
        self.list.iter().any(|o| o.code == op::TIME)
    }

    /// The exponent of a power.
    fn exponent(&self, power: &Operation) -> f64 {
        self.declaration.numbers[power.y]
    }
}
