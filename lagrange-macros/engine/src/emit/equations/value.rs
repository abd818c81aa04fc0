//! `value`: accelerations, and forces and what guards read if they are asked for, at one state.

use super::super::names::{self, local};
use super::solve::Elimination;
use super::writer::{Writer, if_named};
use crate::emit::operation::Notation;
use crate::plan::mode::products::{Plan, force_row, zero_row};
use crate::plan::mode::{ModeProgram, Phase};
use crate::plan::{Block, OutputMask, Program, Value, ValueRef};
use crate::sorted::{SortedMap, SortedSet};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// `fn value_…`
pub fn function(
    name: &Ident,
    heading: &str,
    program: &Program,
    mode: &ModeProgram,
    plan: &Plan,
) -> TokenStream {
    let writer = Writer::new(&program.equations.system, mode, names::crossing(&mode.tape));
    let elimination = Elimination::new(&writer, &mode.results.system);
    let (rates, values) = (local("rates"), local("values"));
    let (c, held, turns) = (local("c"), local("held"), local("turns"));
    let (t, q, v) = (local("t"), local("q"), local("v"));
    let number = &writer.number;
    let needs = names::needs(program.equations.needs.len());
    let declarations = writer.declarations();
    let solved = solved(&writer, &elimination, mode);
    let reported = reported(&writer, mode, plan);
    let projection = projection(&writer, &elimination, program, plan);
    let read = names::read(&mode.tape);
    let prologue = writer.prologue(|input| read.contains(&input));
    let rates_of = (0..mode.inputs.coordinates).map(|j| rate(&writer, j));
    let names = numbers_of(&writer, plan).into_iter().enumerate();
    let used = used(mode, plan);
    let numbers = names.map(|(row, name)| if_named(name, used.contains(&row)));
    let safe = local("safe");
    quote! {
        #[doc = #heading]
        fn #name<#number: Number>(
            #c: &[#number],
            #held: &Selection,
            (#t, #q, #v): Arguments<'_, #number>,
            #rates: &mut [#number],
            #values: ::core::option::Option<&mut [#number]>,
            #turns: &mut [Turn<#number>],
        ) -> bool {
            #prologue
            let [#(#rates_of),*] = first_mut(#rates);
            #needs
            #declarations
            #solved
            if let ::core::option::Option::Some(#values) = #values {
                let [#(#numbers),*] = first_mut(#values);
                #reported
                #projection
            }
            #safe
        }
    }
}

/// Solves the linear system, and writes the accelerations.
fn solved(writer: &Writer, elimination: &Elimination, mode: &ModeProgram) -> TokenStream {
    let nothing = |_: &Block| TokenStream::new();
    let assembly = blocks(writer, Phase::Assembly, nothing);
    let factors = &elimination.code;
    let (solve, solution) = elimination.solve_system(writer);
    let unknowns = solution.iter().enumerate().map(|(i, x)| {
        let name = writer.value(mode.inputs.unknown(i));
        quote!(let #name = #x;)
    });
    let serves = mode.serves_values();
    let shared = mode.blocks(Phase::Balance).map(|block| {
        let steps = block.steps.iter().filter(|step| serves[step.value.0]);
        let steps = steps.map(|step| writer.step(step));
        in_block(block, quote!(#(#steps)*))
    });
    let accelerations = blocks(writer, Phase::Accelerations, nothing);
    let places = mode.results.accelerations.iter().enumerate();
    let rates = places.map(|(j, place)| {
        let (rate, value) = (rate(writer, j), writer.place(*place));
        quote!(*#rate = #value;)
    });
    quote! {
        #assembly
        #factors
        #solve
        #(#unknowns)*
        #(#shared)*
        #accelerations
        #(#rates)*
    }
}

/// The local that borrows the rate of velocity j.
fn rate(writer: &Writer, j: usize) -> Ident {
    let velocity = writer.mode.inputs.velocity(j);
    local(&format!("rate_{}", writer.locals.stem(velocity)))
}

/// Writes the forces and what guards read.
fn reported(writer: &Writer, mode: &ModeProgram, plan: &Plan) -> TokenStream {
    let names = numbers_of(writer, plan);
    let store = |row: usize, place: ValueRef| {
        let (name, value) = (&names[row], writer.place(place));
        quote!(*#name = #value;)
    };
    let forces = blocks(writer, Phase::Forces, |_| TokenStream::new());
    let places = mode.results.forces.iter().enumerate();
    let of_rows = places.filter_map(|(r, place)| Some(store(force_row(mode, r), (*place)?)));
    let results = results(mode).into_iter().map(|(value, place)| {
        let (name, result) = (writer.value(value), writer.place(place));
        quote!(let #name = #result;)
    });
    let kept = kept(mode, plan);
    let outputs = blocks(writer, Phase::Outputs, |block| {
        let writes = block.writes.iter();
        let single = writes.filter(|write| !writer.sums.contains(&write.output));
        let rows = single.filter_map(|write| {
            let place = ValueRef::Node(write.output);
            Some(store(*kept.get(&place)?, place))
        });
        quote!(#(#rows)*)
    });
    let whole = kept.iter().filter(|(place, _)| match place {
        ValueRef::Node(output) => writer.sums.contains(output),
        ValueRef::Constant(_) => true,
        ValueRef::Zero => false,
    });
    let whole = whole.map(|(place, row)| store(*row, *place));
    quote! {
        #forces
        #(#of_rows)*
        #(#results)*
        #outputs
        #(#whole)*
    }
}

/// How many numbers `value` writes: the first coefficients of the rows, then the changes of the velocities by a projection.
pub fn numbers(mode: &ModeProgram, plan: &Plan) -> usize {
    let changes = match mode.projects_velocities() {
        true => mode.inputs.coordinates,
        false => 0,
    };
    plan.rows + changes
}

/// What borrows them, by the names of what they are.
fn numbers_of(writer: &Writer, plan: &Plan) -> Vec<Ident> {
    let inputs = writer.mode.inputs;
    let changes = (0..inputs.coordinates)
        .map(|j| format!("change_{}", writer.locals.stem(inputs.velocity(j))));
    let mut names: Vec<String> = (0..plan.rows).map(|at| format!("value{at}")).collect();
    for (&row, &at) in plan.kept() {
        names[at] = format!("value_{}", writer.stem(row));
    }
    names.extend(changes);
    names.truncate(numbers(writer.mode, plan));
    names.iter().map(|name| local(name)).collect()
}

/// Which of them are written, or read by the projection.
fn used(mode: &ModeProgram, plan: &Plan) -> SortedSet<usize> {
    let forces = mode.results.forces.iter().enumerate();
    let forces = forces.filter(|(_, place)| place.is_some());
    let forces = forces.map(|(r, _)| force_row(mode, r));
    let changes = plan.rows..numbers(mode, plan);
    let kept = kept(mode, plan).into_iter().map(|(_, row)| row);
    let extras = mode.results.extras.iter();
    let rates = extras
        .filter(|_| mode.projects_velocities())
        .filter_map(|extra| plan.extra_row(mode, extra));
    forces.chain(kept).chain(changes).chain(rates).collect()
}

/// The least change of the velocities, in the mass metric, that takes them onto the rows that act: by the same factors, from the rates
/// that have been written.
fn projection(
    writer: &Writer,
    elimination: &Elimination,
    program: &Program,
    plan: &Plan,
) -> TokenStream {
    let mode = writer.mode;
    if !mode.projects_velocities() {
        return TokenStream::new();
    }
    let names = numbers_of(writer, plan);
    let structure = &program.equations.structure;
    let mut right = vec![None; mode.inputs.coordinates];
    let mut needs = OutputMask::default();
    for &row in &mode.kept {
        let rate = structure.rows[row].velocity;
        let extra = mode
            .results
            .extras
            .iter()
            .find(|extra| extra.output == rate);
        let at = extra.and_then(|extra| plan.extra_row(mode, extra));
        right.push(at.map(|at| {
            let rate = &names[at];
            quote!((-*#rate))
        }));
        let [.., need] = structure.rows[row].needs;
        needs.join(&OutputMask::single(need));
    }
    let (solve, changes) = elimination.solve(writer, right, "d_");
    let store = changes.iter().enumerate().take(mode.inputs.coordinates);
    let store = store.map(|(j, change)| {
        let name = &names[plan.rows + j];
        quote!(*#name = #change;)
    });
    let condition = names::condition(&needs);
    quote!(if #condition { #solve #(#store)* })
}

/// What guards read beside the forces, and in which row of a series it stands.
fn kept(mode: &ModeProgram, plan: &Plan) -> SortedMap<ValueRef, usize> {
    let extras = mode.results.extras.iter();
    extras
        .filter_map(|extra| Some((extra.place, plan.extra_row(mode, extra)?)))
        .filter(|(_, row)| *row < force_row(mode, 0) || *row > zero_row(mode))
        .collect()
}

/// The blocks of a phase, each with what is `then` done at its end.
fn blocks(writer: &Writer, phase: Phase, then: impl Fn(&Block) -> TokenStream) -> TokenStream {
    let blocks = writer.mode.blocks(phase).map(|block| {
        let steps = block.steps.iter().map(|step| writer.step(step));
        let writes = writer.writes(block);
        let end = then(block);
        in_block(block, quote!(#(#steps)* #writes #end))
    });
    quote!(#(#blocks)*)
}

/// What is done under the needs of a block.
pub fn in_block(block: &Block, body: TokenStream) -> TokenStream {
    if block.needs.is_always() || body.is_empty() {
        return body;
    }
    let condition = names::condition(&block.needs);
    quote!(if #condition { #body })
}

/// The inputs of the last phase: accelerations and forces.
pub fn results(mode: &ModeProgram) -> Vec<(Value, ValueRef)> {
    let accelerations = mode.results.accelerations.iter().enumerate();
    let accelerations = accelerations.map(|(j, place)| (mode.inputs.acceleration(j), *place));
    let forces = mode.results.forces.iter().enumerate();
    let forces = forces.map(|(r, place)| (mode.inputs.force(r), place.unwrap_or(ValueRef::Zero)));
    let read = names::read(&mode.tape);
    accelerations
        .chain(forces)
        .filter(|(value, _)| read.contains(value))
        .collect()
}
