//! Programs on plain scalars: the constants of modes, the starts, and access to the parameters.

use super::names::{self, Locals, local};
use crate::model::System;
use crate::plan::{Mode, Operation, Program, StartTarget, Tape, Value};
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::BTreeSet;

/// `fn parameter` and `fn set_parameter`.
pub fn access(system: &System) -> TokenStream {
    let (at, value) = (local("index"), local("value"));
    let fields: Vec<_> = system.parameters.iter().map(names::field).collect();
    let indices: Vec<_> = (0..fields.len()).map(names::index).collect();
    quote! {
        fn parameter(&self, #at: usize) -> Self::Scalar {
            match #at {
                #(#indices => #fields,)*
                _ => ::core::panic!("there is no parameter {}", #at),
            }
        }
        fn set_parameter(&mut self, #at: usize, #value: Self::Scalar) {
            match #at {
                #(#indices => #fields = #value,)*
                _ => ::core::panic!("there is no parameter {}", #at),
            }
        }
    }
}

/// Names of the parameters.
pub fn parameter_names(system: &System) -> impl Iterator<Item = String> + '_ {
    let parameters = system.parameters.iter();
    parameters.map(|parameter| format!("p_{}", parameter.name))
}

/// A masked program whose outputs are the constants `c`.
pub fn masked(
    program: &Program,
    tape: &Tape,
    locals: &Locals,
    input: impl Fn(usize) -> TokenStream,
) -> TokenStream {
    let system = &program.equations.system;
    let c = local("c");
    let outputs = names::index(tape.outputs);
    let needs = names::needs(program.equations.needs.len());
    let crossing = names::crossing(tape);
    let declared = crossing.iter().map(|value| locals.value(*value));
    let read = names::read(tape);
    let inputs = (0..tape.inputs).filter(|at| read.contains(&Value(*at)));
    let inputs = inputs.map(|at| {
        let (name, input) = (locals.value(Value(at)), input(at));
        quote!(let #name = #input;)
    });
    let blocks = tape.blocks.iter().map(|block| {
        let steps = steps(
            system,
            locals,
            block.steps.iter().map(|step| (step.value, step.operation)),
            &crossing,
        );
        let writes = block.writes.iter().map(|write| {
            let (output, value) = (names::index(write.output), locals.value(write.value));
            match write.mode {
                Mode::Set => quote!(#c[#output] = #value;),
                Mode::Add => quote!(#c[#output] += #value;),
                Mode::Sub => quote!(#c[#output] -= #value;),
            }
        });
        let body = quote!(#steps #(#writes)*);
        if block.needs.is_always() || body.is_empty() {
            return body;
        }
        let condition = names::condition(&block.needs);
        quote!(if #condition { #body })
    });
    quote! {
        let #c = first_mut::<#outputs, _>(#c);
        #needs
        #(#inputs)*
        #(let mut #declared = <Self::Scalar as ::core::default::Default>::default();)*
        #(#blocks)*
    }
}

/// `fn start`.
pub fn starts(program: &Program) -> TokenStream {
    let system = &program.equations.system;
    let core = &system.core;
    let (at, t, q, v) = (local("index"), local("t"), local("q"), local("v"));
    let arms = program.starts.iter().enumerate().map(|(number, start)| {
        let number = names::index(number);
        let locals = Locals::new(parameter_names(system).chain(["t_start".to_owned()]));
        let inputs = parameters(system, &locals, &start.tape);
        let time = locals.value(Value(start.tape.inputs - 1));
        let all = start.tape.blocks.iter().flat_map(|block| &block.steps);
        let steps = steps(
            system,
            &locals,
            all.map(|step| (step.value, step.operation)),
            &BTreeSet::new(),
        );
        let writes = start
            .tape
            .blocks
            .iter()
            .flat_map(|block| &block.writes)
            .map(|write| {
                let value = locals.value(write.value);
                match start.targets[write.output] {
                    StartTarget::Position(at) => {
                        let at = names::index(at);
                        quote!(#q[#at] = #value;)
                    }
                    StartTarget::Velocity(at) => {
                        let at = names::index(at);
                        quote!(#v[#at] = #value;)
                    }
                }
            });
        quote! {
            #number => {
                #inputs
                let #time = #t;
                #steps
                #(#writes)*
            }
        }
    });
    quote! {
        fn start(&self, #at: usize, #t: Self::Scalar, #q: &mut [Self::Scalar], #v: &mut [Self::Scalar]) {
            use #core::arithmetic::Scalar;
            #q.fill(<Self::Scalar as ::core::default::Default>::default());
            #v.fill(<Self::Scalar as ::core::default::Default>::default());
            match #at {
                #(#arms)*
                _ => ::core::panic!("there is no start {}", #at),
            }
        }
    }
}

/// Binds the parameters that a program reads.
fn parameters(system: &System, locals: &Locals, tape: &Tape) -> TokenStream {
    let read = names::read(tape);
    let bindings = system
        .parameters
        .iter()
        .enumerate()
        .filter(|(index, _)| read.contains(&Value(*index)));
    let bindings = bindings.map(|(index, parameter)| {
        let (name, field) = (locals.value(Value(index)), names::field(parameter));
        quote!(let #name = #field;)
    });
    quote!(#(#bindings)*)
}

fn steps(
    system: &System,
    locals: &Locals,
    steps: impl Iterator<Item = (Value, Operation)>,
    crossing: &BTreeSet<Value>,
) -> TokenStream {
    let lines = steps.map(|(first, operation)| {
        let result = expression(system, locals, operation);
        let (one, two) = (locals.value(first), locals.value(Value(first.0 + 1)));
        match (operation.values(), crossing.contains(&first)) {
            (1, false) => quote!(let #one = #result;),
            (1, true) => quote!(#one = #result;),
            (_, false) => quote!(let (#one, #two) = #result;),
            (_, true) => quote!((#one, #two) = #result;),
        }
    });
    quote!(#(#lines)*)
}

fn expression(system: &System, locals: &Locals, operation: Operation) -> TokenStream {
    let n = |value| locals.value(value);
    let fixed = |c| names::coefficient(system, c);
    let call = |method: &str, x: Value| {
        let (method, x) = (names::plain(method), n(x));
        quote!(Scalar::#method(#x))
    };
    match operation {
        Operation::Constant(c) => fixed(c),
        Operation::Add(x, y) => {
            let (x, y) = (n(x), n(y));
            quote!(#x + #y)
        }
        Operation::Sub(x, y) => {
            let (x, y) = (n(x), n(y));
            quote!(#x - #y)
        }
        Operation::Neg(x) => {
            let x = n(x);
            quote!(-#x)
        }
        Operation::Offset(c, x) => {
            let (c, x) = (fixed(c), n(x));
            quote!(#c + #x)
        }
        Operation::Scale(c, x) => {
            let (c, x) = (fixed(c), n(x));
            quote!(#c * #x)
        }
        Operation::Mul(x, y) => {
            let (x, y) = (n(x), n(y));
            quote!(#x * #y)
        }
        Operation::Square(x) => {
            let x = n(x);
            quote!(#x * #x)
        }
        Operation::Div(x, y) => {
            let (x, y) = (n(x), n(y));
            quote!(#x / #y)
        }
        Operation::Ratio(c, x) => {
            let (c, x) = (fixed(c), n(x));
            quote!(#c / #x)
        }
        Operation::Sqrt(x) => call("sqrt", x),
        Operation::Powf(x, c) => {
            let (x, c) = (n(x), names::float(c));
            quote!(Scalar::powf(#x, #c))
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
            quote!(Scalar::atan2(#y, #x))
        }
        Operation::Choose(guard, x, y) => {
            let (guard, x, y) = (n(guard), n(x), n(y));
            quote!(if Scalar::value(#guard) >= 0.0 { #x } else { #y })
        }
        Operation::Select(..) => unreachable!("only tapes select by branch"),
    }
}
