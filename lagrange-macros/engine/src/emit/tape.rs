//! A tape as a method generic over the arithmetic: one call per operation, one `if` per block.

use super::code;
use super::names::{self, local};
use crate::derive::Stage;
use crate::model::System;
use crate::plan::{Block, Mode, Operation, Program, Tape, Value, Write};
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::BTreeSet;

/// `fn motion` or `fn report`.
pub fn tape(program: &Program, stage: Stage) -> TokenStream {
    let system = &program.equations.system;
    let core = &system.core;
    let (name, tape) = match stage {
        Stage::Motion => (quote!(motion), &program.motion),
        Stage::Report => (quote!(report), &program.report),
    };
    let (a, held, c, x, y) = (
        local("a"),
        local("held"),
        local("c"),
        local("x"),
        local("y"),
    );
    // A type parameter is not hygienic: the struct's own must not have this name.
    let arithmetic = names::plain("LagrangeArithmetic");
    let body = if code::is_large(tape) {
        code::run(system, tape, quote!(#a), quote!(#x), quote!(#y), quote!(#c))
    } else {
        let prologue = prologue(program, tape);
        let blocks = Writer::new(system, tape).blocks();
        quote!(#prologue #blocks)
    };
    quote! {
        #[inline]
        fn #name<#arithmetic: #core::arithmetic::Arithmetic<Scalar = Self::Scalar>>(
            &self,
            #a: &mut #arithmetic,
            #held: &#core::system::Held,
            #c: &[Self::Scalar],
            #x: &[#arithmetic::Node],
            #y: &mut [#arithmetic::Node],
        ) {
            #body
        }
    }
}

/// Binds inputs, constants, outputs and the mask with lengths that are known from here on.
fn prologue(program: &Program, tape: &Tape) -> TokenStream {
    let (c, x, y) = (local("c"), local("x"), local("y"));
    let (constants, outputs) = (
        names::index(program.constants.outputs),
        names::index(tape.outputs),
    );
    let c = names::array(&c, quote!(#c.first_chunk::<#constants>()));
    let y = names::array(&y, quote!(#y.first_chunk_mut::<#outputs>()));
    let needs = names::needs(program.equations.needs.len());
    let read = names::read(tape);
    let inputs = (0..tape.inputs).map(|input| {
        let name = names::value(Value(input));
        // The first one stands for values of blocks that do not run.
        if input == 0 || read.contains(&Value(input)) {
            quote!(#name)
        } else {
            quote!(_)
        }
    });
    quote! {
        let &[#(#inputs,)* ..] = #x else {
            ::core::panic!("the length of a tape's argument is not that of the description")
        };
        #c
        #y
        #needs
    }
}

struct Writer<'a> {
    system: &'a System,
    tape: &'a Tape,
    /// Declared before their block, since another one reads them.
    crossing: BTreeSet<Value>,
    /// Outputs that several writes enter.
    sums: BTreeSet<usize>,
}

impl<'a> Writer<'a> {
    fn new(system: &'a System, tape: &'a Tape) -> Writer<'a> {
        let writes = tape.blocks.iter().flat_map(|block| &block.writes);
        let sums = writes
            .filter(|write| write.mode != Mode::Set)
            .map(|write| write.output)
            .collect();
        Writer {
            system,
            tape,
            crossing: names::crossing(tape),
            sums,
        }
    }

    fn blocks(&self) -> TokenStream {
        // A block that does not run leaves its values at a node that nobody reads.
        let (idle, declared) = (
            names::value(Value(0)),
            self.crossing.iter().map(|value| names::value(*value)),
        );
        let blocks = self.tape.blocks.iter().map(|block| self.block(block));
        let y = local("y");
        let sums = self.sums.iter().map(|output| {
            let (sum, output) = (names::sum(*output), names::index(*output));
            quote!(#y[#output] = #sum;)
        });
        quote! {
            #(let mut #declared = #idle;)*
            #(#blocks)*
            #(#sums)*
        }
    }

    fn block(&self, block: &Block) -> TokenStream {
        let steps = block.steps.iter().map(|step| {
            let call = self.call(step.operation, step.to);
            let first = step.value;
            if step.operation.values() == 1 {
                return self.bind(first, call);
            }
            let second = Value(first.0 + 1);
            let (one, two) = (names::value(first), names::value(second));
            if self.crossing.contains(&first) {
                quote!((#one, #two) = #call;)
            } else {
                quote!(let (#one, #two) = #call;)
            }
        });
        let writes = block.writes.iter().map(|write| self.write(write));
        let body = quote!(#(#steps)* #(#writes)*);
        if block.needs.is_always() {
            return body;
        }
        let condition = names::condition(&block.needs);
        quote!(if #condition { #body })
    }

    fn bind(&self, value: Value, call: TokenStream) -> TokenStream {
        let name = names::value(value);
        if self.crossing.contains(&value) {
            quote!(#name = #call;)
        } else {
            quote!(let #name = #call;)
        }
    }

    fn write(&self, write: &Write) -> TokenStream {
        let (a, y, value) = (local("a"), local("y"), names::value(write.value));
        let sum = names::sum(write.output);
        match write.mode {
            Mode::Set if self.sums.contains(&write.output) => quote!(let mut #sum = #value;),
            Mode::Set => {
                let output = names::index(write.output);
                quote!(#y[#output] = #value;)
            }
            Mode::Add(to) => {
                let to = names::index(to);
                quote!(#sum = #a.add(#to, #sum, #value);)
            }
            Mode::Sub(to) => {
                let to = names::index(to);
                quote!(#sum = #a.sub(#to, #sum, #value);)
            }
        }
    }

    fn call(&self, operation: Operation, to: usize) -> TokenStream {
        let (a, to) = (local("a"), names::index(to));
        let n = names::value;
        let fixed = |c| names::coefficient(self.system, c);
        let one = |method: &str, x: Value| {
            let (method, x) = (names::plain(method), n(x));
            quote!(#a.#method(#to, #x))
        };
        let two = |method: &str, x: Value, y: Value| {
            let (method, x, y) = (names::plain(method), n(x), n(y));
            quote!(#a.#method(#to, #x, #y))
        };
        let scaled = |method: &str, c, x: Value| {
            let (method, c, x) = (names::plain(method), fixed(c), n(x));
            quote!(#a.#method(#to, #c, #x))
        };
        match operation {
            Operation::Constant(c) => {
                let c = fixed(c);
                quote!(#a.constant(#to, #c))
            }
            Operation::Add(x, y) => two("add", x, y),
            Operation::Sub(x, y) => two("sub", x, y),
            Operation::Neg(x) => one("neg", x),
            Operation::Offset(c, x) => scaled("offset", c, x),
            Operation::Scale(c, x) => scaled("scale", c, x),
            Operation::Mul(x, y) => two("mul", x, y),
            Operation::Square(x) => one("square", x),
            Operation::Div(x, y) => two("div", x, y),
            Operation::Ratio(c, x) => scaled("ratio", c, x),
            Operation::Sqrt(x) => one("sqrt", x),
            Operation::Powf(x, c) => {
                let (x, c) = (n(x), names::float(c));
                quote!(#a.powf(#to, #x, #c))
            }
            Operation::Exp(x) => one("exp", x),
            Operation::Ln(x) => one("ln", x),
            Operation::SinCos(x) => one("sin_cos", x),
            Operation::SinhCosh(x) => one("sinh_cosh", x),
            Operation::Tan(x) => one("tan", x),
            Operation::Tanh(x) => one("tanh", x),
            Operation::Asin(x) => one("asin", x),
            Operation::Acos(x) => one("acos", x),
            Operation::Atan(x) => one("atan", x),
            Operation::Atan2(y, x) => two("atan2", y, x),
            Operation::Select(branch, x, y) => {
                let (held, branch, x, y) = (local("held"), names::index(branch), n(x), n(y));
                quote!(if #held.branch(#branch) { #x } else { #y })
            }
            Operation::Choose(..) => unreachable!("only starts choose by value"),
        }
    }
}
