//! Order 0: every operation as a line of Rust on numbers.

use super::super::names::{self, index, local};
use super::number;
use crate::model::System;
use crate::plan::mode::ModeProgram;
use crate::plan::{Block, Coefficient, Mode, Operation, Step, Value, ValueRef};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Writes values.
pub struct Writer<'a> {
    pub system: &'a System,
    pub mode: &'a ModeProgram,
    /// Declared before all blocks, since code outside their own block reads them.
    pub declared: BTreeSet<Value>,
    /// Outputs that several writes enter.
    pub sums: BTreeSet<usize>,
}

/// A number that is fixed during a run.
pub fn coefficient(coefficient: Coefficient) -> TokenStream {
    let number = number();
    match coefficient {
        Coefficient::Number(value) => {
            let value = names::float(value);
            quote!(#number::of(#value))
        }
        Coefficient::Pi(multiple) => {
            let value = names::f64(Coefficient::multiple_of_pi(multiple));
            quote!(#number::of(#value))
        }
        Coefficient::Constant(at) => {
            let (c, at) = (local("c"), index(at));
            quote!(#c[#at])
        }
        Coefficient::Parameter(_) => unreachable!("a mode reads its own constants only"),
    }
}

impl Writer<'_> {
    /// Binds arguments to names: inputs that are read, constants, needs.
    pub fn prologue(&self) -> TokenStream {
        let read = names::read(&self.mode.tape);
        let (t, c) = (local("t"), local("c"));
        let n = self.mode.inputs.coordinates;
        let time = names::value(Value(0));
        let names = |first: usize| {
            let inputs = (first..first + n).map(|input| {
                let name = names::value(Value(input));
                if read.contains(&Value(input)) {
                    quote!(#name)
                } else {
                    quote!(_)
                }
            });
            quote!(&[#(#inputs,)* ..])
        };
        let (q, v) = (local("q"), local("v"));
        let (positions, velocities) = (names(1), names(1 + n));
        let count = index(self.mode.constants.outputs);
        let c = names::array(&c, quote!(#c.first_chunk::<#count>()));
        quote! {
            let #time = #t;
            let (#positions, #velocities) = (#q, #v) else {
                ::core::panic!("the length of a state is not that of the description")
            };
            #c
        }
    }

    /// Declares what leaves its block.
    pub fn declarations(&self) -> TokenStream {
        let idle = names::value(Value(0));
        let declared = self.declared.iter().map(|value| names::value(*value));
        quote!(#(let mut #declared = #idle;)*)
    }

    /// An output of the tape, or a constant.
    pub fn place(&self, place: ValueRef) -> TokenStream {
        let number = number();
        match place {
            ValueRef::Zero => quote!(#number::of(0.0)),
            ValueRef::Constant(at) => coefficient(Coefficient::Constant(at)),
            ValueRef::Node(output) => {
                let name = self.output(output);
                quote!(#name)
            }
        }
    }

    /// The local of an output.
    pub fn output(&self, output: usize) -> Ident {
        if self.sums.contains(&output) {
            return names::sum(output);
        }
        let writes = self.mode.tape.blocks.iter().flat_map(|block| &block.writes);
        let mut set = writes
            .filter(|write| write.output == output)
            .map(|write| write.value);
        names::value(set.next().unwrap_or(Value(0)))
    }

    /// `name = value;`, with `let` unless it is declared.
    pub fn bind(&self, value: Value, result: TokenStream) -> TokenStream {
        let name = names::value(value);
        if self.declared.contains(&value) {
            quote!(#name = #result;)
        } else {
            quote!(let #name = #result;)
        }
    }

    /// A step; its values are bound.
    pub fn step(&self, step: &Step) -> TokenStream {
        let result = self.operation(step.operation);
        if step.operation.values() == 1 {
            return self.bind(step.value, result);
        }
        let second = Value(step.value.0 + 1);
        let (one, two) = (names::value(step.value), names::value(second));
        match (
            self.declared.contains(&step.value),
            self.declared.contains(&second),
        ) {
            (false, false) => quote!(let (#one, #two) = #result;),
            _ => quote!((#one, #two) = #result;),
        }
    }

    /// The writes of a block that enter sums.
    pub fn writes(&self, block: &Block) -> TokenStream {
        let writes = block
            .writes
            .iter()
            .filter(|write| self.sums.contains(&write.output));
        let lines = writes.map(|write| {
            let (sum, value) = (names::sum(write.output), names::value(write.value));
            match write.mode {
                Mode::Set => quote!(let mut #sum = #value;),
                Mode::Add => quote!(#sum = #sum + #value;),
                Mode::Sub => quote!(#sum = #sum - #value;),
            }
        });
        quote!(#(#lines)*)
    }

    fn operation(&self, operation: Operation) -> TokenStream {
        let n = names::value;
        let number = number();
        let call = |name: &str, x: Value| {
            let (name, x) = (names::plain(name), n(x));
            quote!(#number::#name(#x))
        };
        let infix = |x: TokenStream, sign: TokenStream, y: Value| {
            let y = n(y);
            quote!(#x #sign #y)
        };
        let value = |x: Value| {
            let x = n(x);
            quote!(#x)
        };
        match operation {
            Operation::Constant(c) => coefficient(c),
            Operation::Add(x, y) => infix(value(x), quote!(+), y),
            Operation::Sub(x, y) => infix(value(x), quote!(-), y),
            Operation::Neg(x) => {
                let x = n(x);
                quote!(-#x)
            }
            Operation::Offset(c, x) => infix(coefficient(c), quote!(+), x),
            Operation::Scale(c, x) => infix(coefficient(c), quote!(*), x),
            Operation::Mul(x, y) => infix(value(x), quote!(*), y),
            Operation::Square(x) => infix(value(x), quote!(*), x),
            Operation::Div(x, y) => infix(value(x), quote!(/), y),
            Operation::Ratio(c, x) => infix(coefficient(c), quote!(/), x),
            Operation::Sqrt(x) => call("sqrt", x),
            Operation::Powf(x, c) => {
                let (x, c) = (n(x), names::float(c));
                quote!(#number::powf(#x, #c))
            }
            Operation::Exp(x) => call("exp", x),
            Operation::Ln(x) => call("ln", x),
            Operation::SinCos(x) => call("sin_cos", x),
            Operation::SinhCosh(x) => call("sinh_cosh", x),
            Operation::Tan(x) => call("tan", x),
            Operation::Tanh(x) => call("tanh", x),
            Operation::Asin(x) => call("asin", x),
            Operation::Acos(x) => call("acos", x),
            Operation::Atan(x) => call("atan", x),
            Operation::Atan2(y, x) => {
                let (y, x) = (n(y), n(x));
                quote!(#number::atan2(#y, #x))
            }
            Operation::Select(branch, x, y) => {
                let (held, branch, x, y) = (local("held"), index(branch), n(x), n(y));
                quote!(if #held.branch(#branch) { #x } else { #y })
            }
            Operation::Choose(..) => unreachable!("only starts choose by value"),
        }
    }
}
