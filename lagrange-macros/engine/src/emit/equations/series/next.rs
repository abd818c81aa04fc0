//! Coefficient k of a series: sums over the earlier coefficients, what is linear, the linear system, what follows from it.

use super::rules::needs_auxiliary;
use super::sums::system_product;
use super::{Expansion, sum_coefficient};
use crate::emit::equations::solve::Elimination;
use crate::emit::equations::value;
use crate::emit::names::{self, index, local};
use crate::emit::operation::Notation;
use crate::plan::mode::Phase;
use crate::plan::mode::products::Row;
use crate::plan::{Block, Mode, Operation, Step, Value};
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::BTreeSet;

impl Expansion<'_> {
    /// The loop over the orders from `first` on.
    pub(super) fn orders_from(&self, first: usize, elimination: &Elimination) -> TokenStream {
        let (k, order, first) = (local("k"), local("order"), index(first));
        let body = self.next(elimination);
        quote! {
            for #k in #first..#order + 1 {
                #body
            }
        }
    }

    /// One order, if it is asked for.
    pub(super) fn order(&self, only: usize, elimination: &Elimination) -> TokenStream {
        let (k, order, only) = (local("k"), local("order"), index(only));
        let body = self.next(elimination);
        quote! {
            if #order < #only {
                return ::core::result::Result::Ok(());
            }
            {
                let #k: usize = #only;
                #body
            }
        }
    }

    /// Coefficient k of everything.
    fn next(&self, elimination: &Elimination) -> TokenStream {
        let number = &self.writer.number;
        let (k, p, weight, share) = (local("k"), local("p"), local("weight"), local("share"));
        let products = self.always_summed();
        let sums = self.sums(0, &products, true);
        let optional_sums = self.optional_sums();
        let optional_declarations = self.optional_declarations();
        let inputs = self.next_of_inputs();
        let assembly = self.next_of(Phase::Assembly);
        let assembled = self.next_of_sums(|output| self.is_in(output, Phase::Assembly));
        let unknowns = self.next_of_unknowns(elimination);
        let accelerations = self.next_of(Phase::Accelerations);
        let velocities = self.next_of_velocities();
        let forces = self.next_of(Phase::Forces);
        let results = self.next_of_results();
        let outputs = self.next_of(Phase::Outputs);
        let others = self.next_of_sums(|output| !self.is_in(output, Phase::Assembly));
        let factors = self.keep_factors(0, &products);
        let optional_factors = self.keep_optional_factors();
        quote! {
            let #p = #k & 31;
            #weight = #weight + #number::of(1.0);
            let #share = #number::of(INVERSES[#p]);
            #sums
            #optional_sums
            #optional_declarations
            #inputs
            #assembly
            #assembled
            #unknowns
            #accelerations
            #velocities
            #forces
            #results
            #outputs
            #others
            #factors
            #optional_factors
        }
    }

    /// What leaves a block under a need.
    fn optional_declarations(&self) -> TokenStream {
        let number = &self.writer.number;
        let crossing = self.crossing.iter();
        let crossing = crossing.filter(|value| self.plan.varying[value.0]);
        let crossing = crossing.map(|value| self.coefficient_of(*value));
        let auxiliary = self
            .optional_steps()
            .filter(|step| needs_auxiliary(step.operation))
            .map(|step| self.auxiliary_coefficient(step.value));
        let names = crossing.chain(auxiliary);
        quote!(#(let mut #names = #number::of(0.0);)*)
    }

    /// Coefficient k of time, positions and velocities.
    fn next_of_inputs(&self) -> TokenStream {
        let (mode, number) = (self.mode, &self.writer.number);
        let (k, p, share) = (local("k"), local("p"), local("share"));
        let read = names::read(&mode.tape);
        let mut body = TokenStream::new();
        if read.contains(&Value(0)) {
            let name = self.coefficient_of(Value(0));
            body.extend(quote!(let #name = #number::of(if #k == 1 { 1.0 } else { 0.0 });));
        }
        for j in 0..mode.inputs.coordinates {
            let (q, v) = (mode.inputs.position(j), mode.inputs.velocity(j));
            if !self.plan.varying[q.0] {
                continue;
            }
            let (dq, dv) = (self.coefficient_of(q), self.coefficient_of(v));
            let (before, now) = match self.d_of_place(mode.results.accelerations[j]) {
                Some(_) => {
                    let (before, now) = (self.before(v), self.now(v));
                    (quote!(#before), quote!(#now))
                }
                None => {
                    let velocity = self.row(Row::Value(v));
                    (quote!(#velocity[(#k - 1) & 31]), quote!(#velocity[#p]))
                }
            };
            body.extend(quote!(let #dq = #before * #share;));
            body.extend(self.store(Row::Value(q), quote!(#p), quote!(#dq)));
            if read.contains(&v) {
                body.extend(quote!(let #dv = #now;));
            }
        }
        body
    }

    /// Keeps coefficient k of those of the outputs that several writes enter.
    fn next_of_sums(&self, which: impl Fn(usize) -> bool) -> TokenStream {
        let p = local("p");
        let sums = self.plan.sums.iter();
        let lines = sums
            .filter(|&(&output, &varies)| varies && which(output))
            .map(|(&output, _)| {
                let d = sum_coefficient(output);
                self.store(Row::Sum(output), quote!(#p), quote!(#d))
            });
        quote!(#(#lines)*)
    }

    /// Solves the linear system for coefficient k of the unknowns.
    fn next_of_unknowns(&self, elimination: &Elimination) -> TokenStream {
        let (mode, number) = (self.mode, &self.writer.number);
        let system = &mode.results.system;
        let mut body = TokenStream::new();
        let places = system.right.iter();
        let mut right: Vec<Option<TokenStream>> =
            places.map(|place| self.d_of_place(*place)).collect();
        if let Some(balance) = &system.balance {
            // What is missing for a balance without coefficient k of the unknowns is what that must give.
            for unknown in self.added_unknowns() {
                let name = self.coefficient_of(unknown);
                body.extend(quote!(let #name = #number::of(0.0);));
            }
            body.extend(self.next_of(Phase::Balance));
            for (right, place) in right.iter_mut().zip(balance) {
                *right = self.d_of_place(*place).map(|d| quote!((-#d)));
            }
        }
        for (i, j, _) in self.plan.system_products(mode) {
            let w = self.writer.value(mode.inputs.unknown(j));
            let Some(d) = self.d_of_place(system.matrix[i][j]) else {
                continue;
            };
            let earlier = system_product(i, j);
            right[i] = Some(match right[i].take() {
                None => quote!((-(#d * #w + #earlier))),
                Some(sum) => quote!((#sum - (#d * #w + #earlier))),
            });
        }
        let (solve, solution) = elimination.solve(&self.writer, right, "d");
        body.extend(solve);
        for (i, x) in solution.iter().enumerate() {
            let value = mode.inputs.unknown(i);
            let name = self.coefficient_of(value);
            body.extend(quote!(let #name = #x;));
            body.extend(self.keep_next(value));
        }
        body.extend(self.balance_with_unknowns());
        body
    }

    /// Coefficient k + 1 of the velocities, from that of the accelerations.
    fn next_of_velocities(&self) -> TokenStream {
        let number = &self.writer.number;
        let p = local("p");
        let places = self.mode.results.accelerations.iter().enumerate();
        let lines = places.filter_map(|(j, place)| {
            let d = self.d_of_place(*place)?;
            let velocity = self.mode.inputs.velocity(j);
            let (before, now) = (self.before(velocity), self.now(velocity));
            let next = quote!(#d * #number::of(INVERSES[#p + 1]));
            let store = self.store(Row::Value(velocity), quote!(#p + 1), quote!(#now));
            Some(quote!(#before = #now; #now = #next; #store))
        });
        quote!(#(#lines)*)
    }

    /// Coefficient k of the forces, and of what is read of the results.
    fn next_of_results(&self) -> TokenStream {
        let mode = self.mode;
        let p = local("p");
        let mut body = TokenStream::new();
        for (r, place) in mode.results.forces.iter().enumerate() {
            if let Some(d) = place.and_then(|place| self.d_of_place(place)) {
                body.extend(self.store(Row::Value(mode.inputs.force(r)), quote!(#p), d));
            }
        }
        for (value, place) in value::results(mode) {
            if let Some(d) = self.d_of_place(place) {
                let name = self.coefficient_of(value);
                body.extend(quote!(let #name = #d;));
                if value.0 < mode.inputs.force(0).0 {
                    body.extend(self.keep_next(value));
                }
            }
        }
        body
    }

    /// Coefficient k of what the balance makes of the unknowns, once these are known.
    fn balance_with_unknowns(&self) -> TokenStream {
        let follows = self.mode.follows_unknowns();
        let multiplied = self.plan.multiplied(self.mode);
        let blocks = self.mode.blocks(Phase::Balance);
        let steps = blocks
            .filter(|block| block.needs.is_always())
            .flat_map(|block| &block.steps)
            .filter(|step| {
                let mut values = step.value.0..step.value.0 + step.operation.values();
                values.any(|value| follows[value] && multiplied[value])
            });
        let lines = steps.map(|step| self.kept_coefficient(step, true));
        quote!(#(#lines)*)
    }

    /// Coefficient k of a step, and into its rows. That of the unknowns is not there yet where it is not `known`.
    fn kept_coefficient(&self, step: &Step, known: bool) -> TokenStream {
        let line = self.coefficient(step, known);
        let kept =
            (0..step.operation.values()).map(|offset| self.keep_next(Value(step.value.0 + offset)));
        quote!(#line #(#kept)*)
    }

    /// Unknowns that stand in other operations of the balance than products of series.
    fn added_unknowns(&self) -> BTreeSet<Value> {
        let steps = self
            .mode
            .blocks(Phase::Balance)
            .flat_map(|block| &block.steps);
        let others = steps.filter(|step| match step.operation {
            Operation::Mul(x, y) => !(self.plan.varying[x.0] && self.plan.varying[y.0]),
            _ => true,
        });
        let operands = others.flat_map(|step| step.operation.operands());
        let writes = self
            .mode
            .blocks(Phase::Balance)
            .flat_map(|block| &block.writes);
        operands
            .chain(writes.map(|write| write.value))
            .filter(|value| self.is_unknown(*value))
            .collect()
    }

    pub(super) fn is_unknown(&self, value: Value) -> bool {
        let inputs = self.mode.inputs;
        (0..inputs.unknowns).any(|i| inputs.unknown(i) == value)
    }

    /// Whether an output belongs to a phase.
    fn is_in(&self, output: usize, phase: Phase) -> bool {
        let mut writes = self.mode.blocks(phase).flat_map(|block| &block.writes);
        writes.any(|write| write.output == output)
    }

    /// Coefficient k of the values of a phase.
    fn next_of(&self, phase: Phase) -> TokenStream {
        let blocks = self.mode.blocks(phase).map(|block| {
            let known = phase != Phase::Balance;
            let steps = block
                .steps
                .iter()
                .map(|step| self.kept_coefficient(step, known));
            let writes = self.next_writes(block);
            value::in_block(block, quote!(#(#steps)* #writes))
        });
        quote!(#(#blocks)*)
    }

    fn next_writes(&self, block: &Block) -> TokenStream {
        let number = &self.writer.number;
        let writes = block.writes.iter();
        let writes = writes.filter(|write| self.plan.sums.get(&write.output) == Some(&true));
        let lines = writes.map(|write| {
            let sum = sum_coefficient(write.output);
            match (write.mode, self.d(write.value)) {
                (Mode::Set, None) => quote!(let mut #sum = #number::of(0.0);),
                (Mode::Set, Some(d)) => quote!(let mut #sum = #d;),
                (_, None) => TokenStream::new(),
                (Mode::Add, Some(d)) => quote!(#sum = #sum + #d;),
                (Mode::Sub, Some(d)) => quote!(#sum = #sum - #d;),
            }
        });
        quote!(#(#lines)*)
    }

    fn keep_next(&self, value: Value) -> TokenStream {
        if !self.plan.varying[value.0] {
            return TokenStream::new();
        }
        let (d, p) = (self.coefficient_of(value), local("p"));
        self.store(Row::Value(value), quote!(#p), quote!(#d))
    }
}
