//! Names and small pieces that all emitted code shares. Locals are hygienic: no name of the user can meet them.

use crate::model::{Parameter, System};
use crate::plan::{Coefficient, Operation, OutputMask, Tape, Value, ValueRef};
use crate::sorted::SortedMap;
use crate::symbolic::Rational;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};
use std::collections::BTreeSet;

/// A local variable. It ends in `_`: rustc takes a pattern that is called as a `const c` of the user for that constant, and warns of a
/// `p` beside the user's `ρ`.
pub fn local(name: &str) -> Ident {
    Ident::new(&format!("{name}_"), Span::mixed_site())
}

/// A name that is not hygienic: a method, a type parameter, `_`.
pub fn plain(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// The locals that hold the values of a program: an input is called what the declaration calls it, a result by its number.
pub struct Locals {
    inputs: Vec<String>,
    /// What some results are called before their number.
    kinds: SortedMap<Value, &'static str>,
}

impl Locals {
    /// For inputs of these names, which begin with a letter and `_`, so that no item of the user is one of them.
    pub fn new(names: impl Iterator<Item = String>) -> Locals {
        let mut inputs: Vec<String> = Vec::new();
        for name in names {
            let plain = |c: char| {
                if c.is_ascii_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '_'
                }
            };
            let name: String = name.chars().map(plain).collect();
            let mut name = name.trim_end_matches('_').to_owned();
            // Names that differ in other letters only are told apart by their number.
            while name.len() < 2 || inputs.contains(&name) {
                name = format!("{name}_{}", inputs.len());
            }
            inputs.push(name);
        }
        let kinds = SortedMap::new();
        Locals { inputs, kinds }
    }

    /// Sines and cosines of this tape are called so.
    pub fn naming_pairs(mut self, tape: &Tape) -> Locals {
        for step in tape.blocks.iter().flat_map(|block| &block.steps) {
            let kinds = match step.operation {
                Operation::SinCos(_) => ["sin_", "cos_"],
                Operation::SinhCosh(_) => ["sinh_", "cosh_"],
                _ => continue,
            };
            let values = [step.value, Value(step.value.0 + 1)];
            self.kinds.extend(values.into_iter().zip(kinds));
        }
        self
    }

    /// What all names of a value begin with.
    pub fn stem(&self, value: Value) -> String {
        let kind = self.kinds.get(&value).copied().unwrap_or("n");
        let input = self.inputs.get(value.0).cloned();
        input.unwrap_or_else(|| format!("{kind}{}", value.0))
    }

    /// The local that holds a value.
    pub fn value(&self, value: Value) -> Ident {
        local(&self.stem(value))
    }
}

/// The local that an output is summed in.
pub fn sum(output: usize) -> Ident {
    local(&format!("sum{output}"))
}

/// An integer without suffix.
pub fn index(index: usize) -> Literal {
    Literal::usize_unsuffixed(index)
}

/// An exact number as the nearest f64.
pub fn float(number: Rational) -> TokenStream {
    f64(number.to_f64())
}

/// A number.
pub fn f64(number: f64) -> TokenStream {
    let size = Literal::f64_unsuffixed(number.abs());
    if number < 0.0 {
        quote!(-#size)
    } else {
        quote!(#size)
    }
}

/// What may not be there, where `None` and `Some` of the user may be something else.
pub fn option(value: Option<impl ToTokens>) -> TokenStream {
    match value {
        Some(value) => quote!(::core::option::Option::Some(#value)),
        None => quote!(::core::option::Option::None),
    }
}

/// The field of a parameter.
pub fn field(parameter: &Parameter) -> TokenStream {
    let field = &parameter.field;
    match parameter.element {
        Some(element) => {
            let element = index(element);
            quote!(self.#field[#element])
        }
        None => quote!(self.#field),
    }
}

/// The methods of `System` that return the tables of `Derived`.
pub fn read_tables(core: &TokenStream) -> TokenStream {
    quote! {
        fn description(&self) -> &'static #core::system::Description {
            <Self as #core::system::Derived>::DESCRIPTION
        }
        fn declaration(&self) -> &'static #core::__private::declaration::Declaration {
            <Self as #core::system::Derived>::DECLARATION
        }
    }
}

/// A number that is fixed during a run, as a scalar.
pub fn coefficient(system: &System, coefficient: Coefficient) -> TokenStream {
    match coefficient {
        Coefficient::Number(number) => {
            let number = float(number);
            quote!(<Self::Scalar>::from_f64(#number))
        }
        Coefficient::Pi(multiple) => {
            let number = f64(Coefficient::multiple_of_pi(multiple));
            quote!(<Self::Scalar>::from_f64(#number))
        }
        Coefficient::Parameter(parameter) => field(&system.parameters[parameter]),
        Coefficient::Constant(constant) => {
            let (c, constant) = (local("c"), index(constant));
            quote!(#c[#constant])
        }
    }
}

/// Whether one of these needs is held.
pub fn condition(needs: &OutputMask) -> TokenStream {
    let words = (needs.first()..)
        .zip(needs.words())
        .filter(|(_, word)| **word != 0);
    let tests = words.map(|(word, bits)| {
        let (held, bits) = (need_word(word), Literal::u64_unsuffixed(*bits));
        quote!(#held & #bits != 0)
    });
    quote!(#(#tests)||*)
}

/// Binds the words of the need mask.
pub fn needs(program_needs: usize) -> TokenStream {
    let held = local("held");
    let words = (0..program_needs.div_ceil(64).max(1)).map(need_word);
    quote!(let &[#(#words),*] = first(#held.needs);)
}

/// A word of the need mask.
fn need_word(at: usize) -> Ident {
    local(&format!("needs{at}"))
}

/// Values that are read by a step or written to an output.
pub fn read(tape: &Tape) -> BTreeSet<Value> {
    let steps = tape.blocks.iter().flat_map(|block| &block.steps);
    let writes = tape.blocks.iter().flat_map(|block| &block.writes);
    steps
        .flat_map(|step| step.operation.operands())
        .chain(writes.map(|write| write.value))
        .collect()
}

/// Values that are computed in a block that can be left out and read in another one; of a pair
/// both or none.
pub fn crossing(tape: &Tape) -> BTreeSet<Value> {
    // Of each value the block and the first value of its step.
    let mut home: Vec<Option<(usize, Value)>> = vec![None; tape.values];
    let mut crossing = BTreeSet::new();
    for (index, block) in tape.blocks.iter().enumerate() {
        for step in block.steps.iter().filter(|_| !block.needs.is_always()) {
            for offset in 0..step.operation.values() {
                home[step.value.0 + offset] = Some((index, step.value));
            }
        }
        let operands = block
            .steps
            .iter()
            .flat_map(|step| step.operation.operands());
        for value in operands.chain(block.writes.iter().map(|write| write.value)) {
            if let Some((_, first)) = home[value.0].filter(|(home, _)| *home != index) {
                crossing.insert(first);
            }
        }
    }
    let steps = tape.blocks.iter().flat_map(|block| &block.steps);
    let pairs = steps.filter(|step| step.operation.values() == 2 && crossing.contains(&step.value));
    let second: Vec<Value> = pairs.map(|step| Value(step.value.0 + 1)).collect();
    crossing.extend(second);
    crossing
}

/// `ValueRef::…`
pub fn place(system: &System, place: ValueRef) -> TokenStream {
    let core = &system.core;
    match place {
        ValueRef::Zero => quote!(#core::__private::program::ValueRef::Zero),
        ValueRef::Constant(at) => {
            let at = index(at);
            quote!(#core::__private::program::ValueRef::Constant(#at))
        }
        ValueRef::Node(at) => {
            let at = index(at);
            quote!(#core::__private::program::ValueRef::Node(#at))
        }
    }
}
