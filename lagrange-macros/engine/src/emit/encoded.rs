//! A tape as data: one literal that the core's `program` loads. Its format is described there.

use super::exact::Exact;
use super::names;
use crate::model::System;
use crate::plan::{Coefficient, Mode, Operation, OutputMask, Tape, Value};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// `Encoded { … }`
pub fn encoded(system: &System, tape: &Tape) -> TokenStream {
    let core = &system.core;
    let writer = Writer::written(tape);
    let words = Literal::byte_string(&writer.bytes);
    let numbers = writer.numbers.table();
    let (values, outputs) = (names::index(tape.values), names::index(tape.outputs));
    quote! {
        #core::__private::program::Encoded {
            words: #words,
            numbers: #numbers,
            values: #values,
            outputs: #outputs,
        }
    }
}

// Numbers of the operations that only writing needs; all as in the core's `program`.
const SET: usize = 23;
const ADD_TO: usize = 24;
const SUBTRACT_FROM: usize = 25;

#[derive(Default)]
pub(super) struct Writer {
    pub(super) bytes: Vec<u8>,
    numbers: Exact,
}

impl Writer {
    /// The words and numbers of a tape.
    pub(super) fn written(tape: &Tape) -> Writer {
        let mut writer = Writer::default();
        for block in &tape.blocks {
            writer.needs(&block.needs);
            writer.word(block.steps.len() + block.writes.len());
            writer.word(block.steps.first().map_or(0, |step| step.value.0));
            for step in &block.steps {
                writer.operation(step.operation);
            }
            for write in &block.writes {
                let operation = match write.mode {
                    Mode::Set => SET,
                    Mode::Add => ADD_TO,
                    Mode::Sub => SUBTRACT_FROM,
                };
                writer.words([operation, write.output, write.value.0]);
            }
        }
        writer
    }

    fn word(&mut self, word: usize) {
        // A tape has fewer than 2³⁰ values: the node budget sees to that.
        self.bytes.extend_from_slice(&(word as u32).to_le_bytes());
    }

    fn words(&mut self, words: [usize; 3]) {
        for word in words {
            self.word(word);
        }
    }

    fn needs(&mut self, needs: &OutputMask) {
        if needs.is_always() {
            return self.word(0);
        }
        self.word(needs.words().len());
        self.word(needs.first());
        for word in needs.words() {
            self.bytes.extend_from_slice(&word.to_le_bytes());
        }
    }

    fn number(&mut self, number: f64) -> usize {
        4 * self.numbers.place(number) + 2
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
