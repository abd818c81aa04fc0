//! Coefficient k of a series: sums over the earlier coefficients, what is linear, the linear system, what follows from it.

use super::rules::needs_auxiliary;
use super::{Expansion, sum_coefficient};
use crate::emit::equations::solve::Elimination;
use crate::emit::equations::value;
use crate::emit::names::{self, index, local};
use crate::plan::mode::Phase;
use crate::plan::mode::products::{Factor, GROUP, Group, Product, Row};
use crate::plan::{Block, Mode, Operation, Step, Value};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// So many groups of products are summed together at most: a processor has sixteen registers for their sums and what they add.
const TOGETHER: usize = 8;

fn system_product(i: usize, j: usize) -> Ident {
    local(&format!("earlier_k{i}_{j}"))
}

impl Expansion<'_> {
    /// The loop over the orders from `first` on.
    pub(super) fn orders_from(&self, first: usize, elimination: &Elimination) -> TokenStream {
        let (k, order, first) = (local("k"), local("order"), index(first));
        let body = self.next(elimination);
        quote! {
            for #k in #first..=#order {
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
        let (mode, plan) = (self.mode, self.plan);
        let number = &self.writer.number;
        let n = mode.inputs.coordinates;
        let (k, p, weight, share) = (local("k"), local("p"), local("weight"), local("share"));
        let mut body = TokenStream::new();
        // Sums over earlier coefficients.
        let always = plan.always(mode).into_iter();
        let mut products: Vec<_> = always.map(|one| self.named(one)).collect();
        for (i, j, product) in plan.system_products(mode) {
            products.push((system_product(i, j), product));
        }
        body.extend(self.sums(0, &products, true));
        body.extend(self.optional_sums());
        let crossing = self.crossing.iter().filter(|value| plan.varying[value.0]);
        for value in crossing {
            let name = self.coefficient_of(*value);
            body.extend(quote!(let mut #name = #number::of(0.0);));
        }
        for step in self
            .optional_steps()
            .filter(|step| needs_auxiliary(step.operation))
        {
            let name = self.auxiliary_coefficient(step.value);
            body.extend(quote!(let mut #name = #number::of(0.0);));
        }
        // Coefficient k of the inputs.
        let read = names::read(&mode.tape);
        if read.contains(&Value(0)) {
            let name = self.coefficient_of(Value(0));
            body.extend(quote!(let #name = #number::of(if #k == 1 { 1.0 } else { 0.0 });));
        }
        for j in 0..n {
            let (q, v) = (mode.inputs.position(j), mode.inputs.velocity(j));
            if !plan.varying[q.0] {
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
        body.extend(self.next_of(Phase::Assembly));
        for (&output, &varies) in &plan.sums {
            if varies && self.is_in(output, Phase::Assembly) {
                let d = sum_coefficient(output);
                body.extend(self.store(Row::Sum(output), quote!(#p), quote!(#d)));
            }
        }
        // The linear system.
        let mut right: Vec<Option<TokenStream>> = mode
            .results
            .system
            .right
            .iter()
            .map(|place| self.d_of_place(*place))
            .collect();
        if let Some(balance) = &mode.results.system.balance {
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
        for (i, j, _) in plan.system_products(mode) {
            let w = self.writer.value(mode.inputs.unknown(j));
            let Some(d) = self.d_of_place(mode.results.system.matrix[i][j]) else {
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
        body.extend(self.next_of(Phase::Accelerations));
        for (j, place) in mode.results.accelerations.iter().enumerate() {
            if let Some(d) = self.d_of_place(*place) {
                let velocity = mode.inputs.velocity(j);
                let (before, now) = (self.before(velocity), self.now(velocity));
                let next = quote!(#d * #number::of(INVERSES[(#k + 1) & 31]));
                body.extend(quote!((#before, #now) = (#now, #next);));
                body.extend(self.store(Row::Value(velocity), quote!((#k + 1) & 31), quote!(#now)));
            }
        }
        body.extend(self.next_of(Phase::Forces));
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
        body.extend(self.next_of(Phase::Outputs));
        for (&output, &varies) in &plan.sums {
            if varies && !self.is_in(output, Phase::Assembly) {
                let d = sum_coefficient(output);
                body.extend(self.store(Row::Sum(output), quote!(#p), quote!(#d)));
            }
        }
        body.extend(self.keep_factors(0, &products));
        body.extend(self.keep_optional_factors());
        quote! {
            let #p = #k & 31;
            let #weight = #number::of(#k as f64);
            let #share = #number::of(INVERSES[#p]);
            #body
        }
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

    fn named(&self, (value, at, product): (Value, usize, Product)) -> (Ident, Product) {
        (self.product(value, at), product)
    }

    /// Σ xⱼ yₖ₋ⱼ for 0 < j < k of all products, which are in groups from `first` on, into new locals or into those that there are.
    fn sums(&self, first: usize, products: &[(Ident, Product)], new: bool) -> TokenStream {
        let (k, registers) = (local("k"), local("registers"));
        let (memory, newest) = (local("products"), local("newest"));
        let count = products.len().div_ceil(GROUP);
        let together = count.div_ceil(count.div_ceil(TOGETHER).max(1)).max(1);
        let loops = products.chunks(GROUP * together).enumerate();
        let loops = loops.map(|(at, products)| {
            let groups = products.chunks(GROUP).map(|group| {
                let names = group.iter().map(|(name, _)| name);
                let rest = (group.len()..GROUP).map(|_| quote!(_));
                quote!([#(#names,)* #(#rest),*])
            });
            let from = first + at * together;
            let factors = (from..from + products.len().div_ceil(GROUP)).map(|at| {
                let at = index(at);
                quote!((&#memory[#at], #newest[#at]))
            });
            let bind = new.then(|| quote!(let));
            quote! {
                #bind [#(#groups),*] = Products::sums(#registers, #k, [#(#factors),*]);
            }
        });
        quote!(#(#loops)*)
    }

    /// The groups of blocks under needs: runs of those that the same needs ask for, with the number of the first.
    fn optional_groups(&self) -> impl Iterator<Item = (usize, &[Group])> {
        let optional = &self.plan.optional;
        let mut next = self.plan.groups - optional.len();
        let runs = optional.chunk_by(|a, b| a.needs == b.needs);
        runs.map(move |run| {
            let first = next;
            next += run.len();
            (first, run)
        })
    }

    /// The products of such groups.
    fn named_products(&self, run: &[Group]) -> Vec<(Ident, Product)> {
        let products = run.iter().flat_map(|group| &group.products);
        products.map(|&one| self.named(one)).collect()
    }

    /// Sums of the products of blocks under needs; zero where nothing asks for a group.
    fn optional_sums(&self) -> TokenStream {
        let number = &self.writer.number;
        let runs = self.optional_groups().map(|(first, run)| {
            let condition = names::condition(&run[0].needs);
            let products = self.named_products(run);
            let names = products.iter().map(|(name, _)| name);
            let sums = self.sums(first, &products, false);
            quote!(#(let mut #names = #number::of(0.0);)* if #condition { #sums })
        });
        quote!(#(#runs)*)
    }

    /// Keeps coefficient k of their factors.
    fn keep_optional_factors(&self) -> TokenStream {
        let runs = self.optional_groups().map(|(first, run)| {
            let condition = names::condition(&run[0].needs);
            let factors = self.keep_factors(first, &self.named_products(run));
            quote!(if #condition { #factors })
        });
        quote!(#(#runs)*)
    }

    /// Keeps coefficient k of the factors of products.
    fn keep_factors(&self, first: usize, products: &[(Ident, Product)]) -> TokenStream {
        let registers = local("registers");
        let (memory, newest, p) = (local("products"), local("newest"), local("p"));
        let groups = products.chunks(GROUP).enumerate().map(|(at, group)| {
            let at = index(first + at);
            // Nobody reads the sums of what a group lacks: it repeats its last product.
            let filled = |place: usize| group[place.min(group.len() - 1)].1;
            let x = (0..GROUP).map(|place| self.factor(filled(place).0));
            let y = (0..GROUP).map(|place| self.factor(filled(place).1));
            quote!(#newest[#at] = #memory[#at].keep(#registers, #p, [#(#x),*], [#(#y),*]);)
        });
        quote!(#(#groups)*)
    }

    /// Coefficient k of a factor.
    fn factor(&self, factor: Factor) -> TokenStream {
        let number = &self.writer.number;
        let of = |value| self.d(value).unwrap_or(quote!(#number::of(0.0)));
        match factor {
            Factor::Value(value) => of(value),
            Factor::Weighted(value) => {
                let (d, weight) = (of(value), local("weight"));
                quote!(#d * #weight)
            }
            Factor::Auxiliary(value) => {
                let name = self.auxiliary_coefficient(value);
                quote!(#name)
            }
            Factor::Sum(output) => {
                let name = sum_coefficient(output);
                quote!(#name)
            }
        }
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
