//! `value`: accelerations, and forces if they are asked for, at one state.

use super::super::names::{self, index, local};
use super::number;
use super::solve::Elimination;
use super::writer::Writer;
use crate::plan::mode::{ModeProgram, Phase};
use crate::plan::{Mode, Place, Program, Value};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Outputs that several writes enter.
pub fn sums(mode: &ModeProgram) -> BTreeSet<usize> {
    let writes = mode.tape.blocks.iter().flat_map(|block| &block.writes);
    writes
        .filter(|write| write.mode != Mode::Set)
        .map(|write| write.output)
        .collect()
}

/// `fn value_…`
pub fn function(name: &Ident, heading: &str, program: &Program, mode: &ModeProgram) -> TokenStream {
    let system = &program.equations.system;
    let core = &system.core;
    let writer = Writer {
        system,
        mode,
        declared: names::crossing(&mode.tape),
        sums: sums(mode),
    };
    let elimination = Elimination::new(&writer, &mode.system);
    let right = mode.system.right.iter().map(|place| match place {
        Place::Zero => None,
        place => Some(writer.place(*place)),
    });
    let (solve, solution) = elimination.solve(&writer, right.collect(), "");
    let factors = &elimination.code;
    let unknowns = solution.iter().enumerate().map(|(i, x)| {
        let name = names::value(mode.inputs.unknown(i));
        quote!(let #name = #x;)
    });
    let [assembly, accelerations, forces] =
        [Phase::Assembly, Phase::Accelerations, Phase::Forces].map(|phase| blocks(&writer, phase));
    let n = mode.inputs.coordinates;
    let (rates, lambda) = (local("rates"), local("lambda"));
    let results = mode.accelerations.iter().enumerate().map(|(j, place)| {
        let (j, value) = (index(j), writer.place(*place));
        quote!(#rates[#j] = #value;)
    });
    let of_rows = mode.forces.iter().enumerate().filter_map(|(r, place)| {
        let (r, value) = (index(r), writer.place((*place)?));
        Some(quote!(#lambda[#r] = #value;))
    });
    let (c, held, asked) = (local("c"), local("held"), local("forces"));
    let (t, q, v) = (local("t"), local("q"), local("v"));
    let number = number();
    let prologue = writer.prologue();
    let declarations = writer.declarations();
    let needs = names::needs(program.equations.needs.len());
    let (count, rows) = (index(n), index(mode.forces.len()));
    let bound = names::array(&rates, quote!(#rates.first_chunk_mut::<#count>()));
    let bound_forces = names::array(&lambda, quote!(#asked.first_chunk_mut::<#rows>()));
    let safe = local("safe");
    quote! {
        #[doc = #heading]
        fn #name<#number: #core::arithmetic::Number>(
            #c: &[#number],
            #held: &#core::system::Held,
            (#t, #q, #v): (#number, &[#number], &[#number]),
            #rates: &mut [#number],
            #asked: ::core::option::Option<&mut [#number]>,
        ) -> bool {
            #prologue
            #bound
            #needs
            #declarations
            #assembly
            #factors
            #solve
            #(#unknowns)*
            #accelerations
            #(#results)*
            if let ::core::option::Option::Some(#asked) = #asked {
                #bound_forces
                #forces
                #(#of_rows)*
            }
            #safe
        }
    }
}

/// The blocks of a phase.
fn blocks(writer: &Writer, phase: Phase) -> TokenStream {
    let blocks = writer.mode.blocks(phase).map(|block| {
        let steps = block.steps.iter().map(|step| writer.step(step));
        let writes = writer.writes(block);
        let body = quote!(#(#steps)* #writes);
        if block.needs.is_always() {
            return body;
        }
        let condition = names::condition(&block.needs);
        quote!(if #condition { #body })
    });
    quote!(#(#blocks)*)
}

/// The inputs of the last phase: accelerations and forces.
pub fn results(mode: &ModeProgram) -> Vec<(Value, Place)> {
    let accelerations = mode.accelerations.iter().enumerate();
    let accelerations = accelerations.map(|(j, place)| (mode.inputs.acceleration(j), *place));
    let forces = mode.forces.iter().enumerate();
    let forces = forces.map(|(r, place)| (mode.inputs.force(r), place.unwrap_or(Place::Zero)));
    let read = names::read(&mode.tape);
    accelerations
        .chain(forces)
        .filter(|(value, _)| read.contains(value))
        .collect()
}
