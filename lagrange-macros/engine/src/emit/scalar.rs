//! Programs on plain scalars: the constants of modes, the motion, the starts, and access to the parameters.

use super::names::{self, Locals, local};
use super::operation::{Notation, expression, select};
use crate::model::System;
use crate::plan::{Coefficient, Mode, Operation, Program, StartTarget, Tape, Value};
use proc_macro2::{Ident, TokenStream};
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

/// The local that borrows output i of a slice.
pub fn output(out: &str, at: usize) -> Ident {
    local(&format!("{out}{at}"))
}

/// A masked program that writes its outputs into the slice `out`; what is `then` done with each value that enters one.
pub fn masked(
    program: &Program,
    tape: &Tape,
    (out, then): (&str, impl Fn(&Ident) -> TokenStream),
    locals: &Locals,
    input: impl Fn(usize) -> TokenStream,
) -> TokenStream {
    let system = &program.equations.system;
    let outputs = (0..tape.outputs).map(|at| output(out, at));
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
            let (output, value) = (output(out, write.output), locals.value(write.value));
            let then = then(&value);
            match write.mode {
                Mode::Set => quote!(*#output = #value; #then),
                Mode::Add => quote!(*#output += #value; #then),
                Mode::Sub => quote!(*#output -= #value; #then),
            }
        });
        let body = quote!(#steps #(#writes)*);
        if block.needs.is_always() || body.is_empty() {
            return body;
        }
        let condition = names::condition(&block.needs);
        quote!(if #condition { #body })
    });
    let all = local(out);
    quote! {
        let [#(#outputs),*] = first_mut(#all);
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
    let notation = OfScalar { system, locals };
    let lines = steps.map(|(first, operation)| {
        let result = expression(operation, &notation);
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

/// One number of the type of the parameters; its functions are those of the core, also where `f64` has some of the same names.
struct OfScalar<'a> {
    system: &'a System,
    locals: &'a Locals,
}

impl Notation for OfScalar<'_> {
    fn value(&self, value: Value) -> Ident {
        self.locals.value(value)
    }

    fn coefficient(&self, coefficient: Coefficient) -> TokenStream {
        names::coefficient(self.system, coefficient)
    }

    fn call(&self, function: &str, x: Ident, more: Option<TokenStream>) -> TokenStream {
        let (function, more) = (names::plain(function), more.into_iter());
        quote!(Scalar::#function(#x #(, #more)*))
    }

    fn choice(&self, operation: Operation) -> TokenStream {
        match operation {
            Operation::Choose(guard, x, y) => {
                let [guard, x, y] = [guard, x, y].map(|value| self.value(value));
                quote!(if Scalar::value(#guard) >= 0.0 { #x } else { #y })
            }
            _ => select(operation, self),
        }
    }
}
