//! Order 0: every operation as a line of Rust on numbers.

use super::super::names::{self, Locals, local, plain};
use super::super::operation::{Notation, expression, select};
use super::super::scalar;
use crate::model::System;
use crate::plan::mode::ModeProgram;
use crate::plan::mode::products::Row;
use crate::plan::{Block, Coefficient, Mode, Operation, Step, Value, ValueRef};
use crate::sorted::{SortedMap, SortedSet};
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Writes values.
pub struct Writer<'a> {
    pub mode: &'a ModeProgram,
    pub locals: Locals,
    /// The type parameter of the function.
    pub number: Ident,
    /// Declared before all blocks, since code outside their own block reads them.
    pub declared: BTreeSet<Value>,
    /// Outputs that several writes enter.
    pub sums: SortedSet<usize>,
    /// What the constants of the mode are called.
    constants: Vec<Ident>,
    /// Those that what has been written so far reads.
    read: RefCell<BTreeSet<usize>>,
}

/// The type parameter of emitted functions: not that of the struct.
pub fn number(system: &System) -> Ident {
    let taken = system.scalar.as_ref().is_some_and(|scalar| scalar == "N");
    plain(if taken { "M" } else { "N" })
}

/// What time, positions and velocities are called.
pub fn state_names(system: &System) -> impl Iterator<Item = String> + '_ {
    let of_coordinates = |kind: char| {
        let coordinates = system.coordinates.iter();
        coordinates.map(move |coordinate| format!("{kind}_{}", coordinate.name.text))
    };
    let time = core::iter::once("t_now".to_owned());
    time.chain(of_coordinates('q')).chain(of_coordinates('v'))
}

/// What the inputs of a mode are called: `q_theta`, `v_theta`, `a_theta` whether it is an unknown of the linear system or read after it
/// has been solved, and forces by their rows.
fn locals(system: &System, mode: &ModeProgram) -> Locals {
    let writes = mode.tape.blocks.iter().flat_map(|block| &block.writes);
    let written: SortedMap<usize, Value> =
        writes.map(|write| (write.output, write.value)).collect();
    let unknowns = (0..mode.inputs.unknowns).map(|i| {
        let is_found = |place: &ValueRef| match place {
            ValueRef::Node(output) => written.get(output) == Some(&mode.inputs.unknown(i)),
            ValueRef::Zero | ValueRef::Constant(_) => false,
        };
        match mode.results.accelerations.iter().position(is_found) {
            Some(j) => format!("a_{}", system.coordinates[j].name.text),
            None => format!("x_{i}"),
        }
    });
    let slips = system.frictions.iter().flat_map(|friction| {
        let components = friction.slip.len();
        (0..components).map(move |i| match components {
            1 => format!("f_{}", friction.name.text),
            _ => format!("f_{}_{}", friction.name.text, i + 1),
        })
    });
    let constraints = system
        .constraints
        .iter()
        .map(|item| format!("f_{}", item.name.text));
    let contacts = system
        .contacts
        .iter()
        .map(|item| format!("f_{}", item.name.text));
    let accelerations = system.coordinates.iter();
    let accelerations = accelerations.map(|coordinate| format!("a_{}", coordinate.name.text));
    let results = accelerations
        .chain(constraints)
        .chain(contacts)
        .chain(slips);
    Locals::new(state_names(system).chain(unknowns).chain(results)).naming_pairs(&mode.tape)
}

/// Numbers of one motion or of several; the trait in scope says what their functions are.
impl Notation for Writer<'_> {
    fn value(&self, value: Value) -> Ident {
        self.locals.value(value)
    }

    fn coefficient(&self, coefficient: Coefficient) -> TokenStream {
        let number = &self.number;
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
                self.read.borrow_mut().insert(at);
                let name = &self.constants[at];
                quote!(*#name)
            }
            Coefficient::Parameter(_) => unreachable!("a mode reads its own constants only"),
        }
    }

    fn call(&self, function: &str, x: Ident, more: Option<TokenStream>) -> TokenStream {
        let (function, more) = (plain(function), more.into_iter());
        quote!(#x.#function(#(#more),*))
    }

    fn choice(&self, operation: Operation) -> TokenStream {
        select(operation, self)
    }
}

impl<'a> Writer<'a> {
    /// Of the functions of a mode.
    pub fn new(system: &System, mode: &'a ModeProgram, declared: BTreeSet<Value>) -> Writer<'a> {
        Writer {
            mode,
            locals: locals(system, mode),
            number: number(system),
            declared,
            sums: sums(mode),
            constants: constants(system, mode),
            read: RefCell::default(),
        }
    }

    /// Takes the arguments apart: inputs that are `read`, angles, and the constants that what has been written before reads. rustc checks the
    /// types of names faster than those of elements. Constants are borrowed, and so read where they enter: all at once, they would not fit
    /// into the registers of a processor.
    pub fn prologue(&self, read: impl Fn(Value) -> bool) -> TokenStream {
        let (t, c) = (local("t"), local("c"));
        let n = self.mode.inputs.coordinates;
        let time = self.value(Value(0));
        let names = |first: usize| {
            let inputs = (first..first + n).map(|input| {
                let name = self.value(Value(input));
                if_named(name, read(Value(input)))
            });
            quote!(&[#(#inputs),*])
        };
        let (q, v) = (local("q"), local("v"));
        let (positions, velocities) = (names(1), names(1 + n));
        let constants = self.constants.iter().enumerate();
        let constants =
            constants.map(|(at, name)| if_named(name, self.read.borrow().contains(&at)));
        let turns = local("turns");
        let angles = turns_of(self.mode).map(turn);
        let time = read(Value(0)).then(|| quote!(let #time = #t;));
        quote! {
            #time
            let #positions = first(#q);
            let #velocities = first(#v);
            let [#(#constants),*] = first(#c);
            let [#(#angles),*] = first_mut(#turns);
        }
    }

    /// Declares what leaves its block.
    pub fn declarations(&self) -> TokenStream {
        let number = &self.number;
        let declared = self.declared.iter().map(|value| self.value(*value));
        quote!(#(let mut #declared = #number::of(0.0);)*)
    }

    /// An output of the tape, or a constant.
    pub fn place(&self, place: ValueRef) -> TokenStream {
        let number = &self.number;
        match place {
            ValueRef::Zero => quote!(#number::of(0.0)),
            ValueRef::Constant(at) => self.coefficient(Coefficient::Constant(at)),
            ValueRef::Node(output) => {
                let name = self.output(output);
                quote!(#name)
            }
        }
    }

    /// What all names of what is given in a row begin with.
    pub fn stem(&self, row: Row) -> String {
        match row {
            Row::Value(value) => self.locals.stem(value),
            Row::Sum(output) => format!("sum{output}"),
            Row::Fixed(constant) => format!("c{constant}"),
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
        self.value(set.next().unwrap_or(Value(0)))
    }

    /// `name = value;`, with `let` unless it is declared.
    pub fn bind(&self, value: Value, result: TokenStream) -> TokenStream {
        let name = self.value(value);
        if self.declared.contains(&value) {
            quote!(#name = #result;)
        } else {
            quote!(let #name = #result;)
        }
    }

    /// A step; its values are bound.
    pub fn step(&self, step: &Step) -> TokenStream {
        let result = match step.operation {
            Operation::SinCos(angle) => self.sin_cos(step.value, angle),
            operation => expression(operation, self),
        };
        if step.operation.values() == 1 {
            return self.bind(step.value, result);
        }
        let second = Value(step.value.0 + 1);
        let (one, two) = (self.value(step.value), self.value(second));
        match (
            self.declared.contains(&step.value),
            self.declared.contains(&second),
        ) {
            (false, false) => quote!(let (#one, #two) = #result;),
            _ => quote!((#one, #two) = #result;),
        }
    }

    /// Sine and cosine, which are the first of these two values, from what is kept of the last angle.
    fn sin_cos(&self, value: Value, angle: Value) -> TokenStream {
        let (turn, angle) = (turn(value), self.value(angle));
        quote!(#turn.sin_cos(#angle))
    }

    /// The writes of a block that enter sums.
    pub fn writes(&self, block: &Block) -> TokenStream {
        let writes = block
            .writes
            .iter()
            .filter(|write| self.sums.contains(&write.output));
        let lines = writes.map(|write| {
            let (sum, value) = (names::sum(write.output), self.value(write.value));
            match write.mode {
                Mode::Set => quote!(let mut #sum = #value;),
                Mode::Add => quote!(#sum = #sum + #value;),
                Mode::Sub => quote!(#sum = #sum - #value;),
            }
        });
        quote!(#(#lines)*)
    }
}

/// The inputs of the constants of modes by the names of their parameters and frictions.
pub fn constant_inputs(system: &System) -> Locals {
    let frictions = system.frictions.iter();
    let signs = frictions.flat_map(|friction| {
        let of = |what: &str| format!("s_{}_{what}", friction.name.text);
        [of("direction"), of("pressing")]
    });
    Locals::new(scalar::parameter_names(system).chain(signs))
}

/// What the constants of a mode are called: one that is a parameter like that, others by their numbers.
fn constants(system: &System, mode: &ModeProgram) -> Vec<Ident> {
    let (tape, locals) = (&mode.constants, constant_inputs(system));
    let writes = tape.blocks.iter().flat_map(|block| &block.writes);
    let inputs = writes.filter(|write| write.value.0 < tape.inputs);
    let mut of_input: SortedMap<Value, usize> = SortedMap::new();
    for write in inputs {
        of_input.insert(write.value, write.output);
    }
    let mut names: Vec<Ident> = (0..tape.outputs)
        .map(|at| local(&format!("c{at}")))
        .collect();
    for (&value, &at) in &of_input {
        names[at] = locals.value(value);
    }
    names
}

/// What is kept of the angle whose sine this is.
fn turn(sine: Value) -> Ident {
    local(&format!("turn{}", sine.0))
}

/// A name in a pattern, if what it is bound to is read.
pub fn if_named(name: impl ToTokens, is_read: bool) -> TokenStream {
    match is_read {
        true => name.to_token_stream(),
        false => quote!(_),
    }
}

/// The sines that a mode has, each with its cosine.
pub fn turns_of(mode: &ModeProgram) -> impl Iterator<Item = Value> {
    let steps = mode.tape.blocks.iter().flat_map(|block| &block.steps);
    let turns = steps.filter(|step| matches!(step.operation, Operation::SinCos(_)));
    turns.map(|step| step.value)
}

/// Outputs that several writes enter.
fn sums(mode: &ModeProgram) -> SortedSet<usize> {
    let writes = mode.tape.blocks.iter().flat_map(|block| &block.writes);
    writes
        .filter(|write| write.mode != Mode::Set)
        .map(|write| write.output)
        .collect()
}
