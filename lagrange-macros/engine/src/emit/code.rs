//! A large tape as data: one literal that `lagrange_core::code` runs, where code would take rustc minutes.

use super::names::{self, local};
use crate::model::System;
use crate::plan::{Coefficient, Mode, NeedSet, Operation, Tape, Value};
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use std::collections::HashMap;

/// Tapes with more operations are data.
const LARGEST: usize = 500;

/// Whether a tape is emitted as data.
pub fn is_large(tape: &Tape) -> bool {
    tape.blocks
        .iter()
        .map(|block| block.steps.len())
        .sum::<usize>()
        > LARGEST
}

/// The tape as data in a constant, and what runs it with these inputs and outputs.
pub fn run(
    system: &System,
    tape: &Tape,
    arithmetic: TokenStream,
    inputs: TokenStream,
    outputs: TokenStream,
    constants: TokenStream,
) -> TokenStream {
    let core = &system.core;
    let (held, index) = (local("held"), local("index"));
    let mut writer = Writer::default();
    for block in &tape.blocks {
        writer.needs(&block.needs);
        let first = block.steps.first();
        let to = first.map(|step| step.to).or_else(|| {
            let sums = block.writes.iter().filter_map(|write| match write.mode {
                Mode::Set => None,
                Mode::Add(to) | Mode::Sub(to) => Some(to),
            });
            sums.min()
        });
        writer.word(block.steps.len() + block.writes.len());
        writer.word(first.map_or(0, |step| step.value.0));
        writer.word(to.unwrap_or(0));
        for step in &block.steps {
            writer.operation(step.operation);
        }
        for write in &block.writes {
            let operation = match write.mode {
                Mode::Set => SET,
                Mode::Add(_) => ADD_TO,
                Mode::Sub(_) => SUBTRACT_FROM,
            };
            writer.words([operation, write.output, write.value.0]);
        }
    }
    let words = Literal::byte_string(&writer.bytes);
    let numbers = writer.numbers.iter().map(|number| names::f64(*number));
    let values = names::index(tape.values);
    let code = local("CODE");
    quote! {
        const #code: #core::code::Code = #core::code::Code {
            words: #words,
            numbers: &[#(#numbers),*],
            values: #values,
        };
        #code.run(#arithmetic, #held, #constants, |#index| self.parameter(#index), #inputs, #outputs)
    }
}

// Numbers of the operations that only writing needs; all as in `lagrange_core::code`.
const SET: usize = 23;
const ADD_TO: usize = 24;
const SUBTRACT_FROM: usize = 25;

#[derive(Default)]
struct Writer {
    bytes: Vec<u8>,
    numbers: Vec<f64>,
    /// Places of the numbers, by their bits.
    known: HashMap<u64, usize>,
}

impl Writer {
    fn word(&mut self, word: usize) {
        // A tape has fewer than 2³⁰ values: the node budget sees to that.
        self.bytes.extend_from_slice(&(word as u32).to_le_bytes());
    }

    fn words(&mut self, words: [usize; 3]) {
        for word in words {
            self.word(word);
        }
    }

    fn needs(&mut self, needs: &NeedSet) {
        if needs.is_always() {
            return self.word(0);
        }
        self.word(needs.words().len());
        for word in needs.words() {
            self.bytes.extend_from_slice(&word.to_le_bytes());
        }
    }

    fn number(&mut self, number: f64) -> usize {
        let next = self.numbers.len();
        let place = *self.known.entry(number.to_bits()).or_insert(next);
        if place == next {
            self.numbers.push(number);
        }
        4 * place + 2
    }

    fn coefficient(&mut self, coefficient: Coefficient) -> usize {
        match coefficient {
            Coefficient::Number(number) => self.number(number.to_f64()),
            Coefficient::Pi(multiple) => self.number(Coefficient::multiple_of_pi(multiple)),
            Coefficient::Parameter(place) => 4 * place + 1,
            Coefficient::Constant(place) => 4 * place,
        }
    }

    fn operation(&mut self, operation: Operation) {
        use Operation::*;
        let one = |number, x: Value| [number, x.0, 0];
        let two = |number, x: Value, y: Value| [number, x.0, y.0];
        let words = match operation {
            Constant(c) => [0, self.coefficient(c), 0],
            Add(x, y) => two(1, x, y),
            Sub(x, y) => two(2, x, y),
            Neg(x) => one(3, x),
            Offset(c, x) => [4, self.coefficient(c), x.0],
            Scale(c, x) => [5, self.coefficient(c), x.0],
            Mul(x, y) => two(6, x, y),
            Square(x) => one(7, x),
            Div(x, y) => two(8, x, y),
            Ratio(c, x) => [9, self.coefficient(c), x.0],
            Sqrt(x) => one(10, x),
            Powf(x, c) => [11, x.0, self.number(c.to_f64())],
            Exp(x) => one(12, x),
            Ln(x) => one(13, x),
            SinCos(x) => one(14, x),
            SinhCosh(x) => one(15, x),
            Tan(x) => one(16, x),
            Tanh(x) => one(17, x),
            Asin(x) => one(18, x),
            Acos(x) => one(19, x),
            Atan(x) => one(20, x),
            Atan2(y, x) => two(21, y, x),
            Select(branch, x, y) => two(22 + 256 * branch, x, y),
            Choose(..) => unreachable!("only starts choose by value"),
        };
        self.words(words);
    }
}
