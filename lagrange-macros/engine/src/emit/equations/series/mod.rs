//! `series`: Taylor coefficients of the motion and of everything that guards read, order by order.
//!
//! ```text
//! (x y)ₖ = x₀ yₖ + xₖ y₀ + Σ xⱼ yₖ₋ⱼ        K₀ wₖ = bₖ − Kₖ w₀ − Σ Kⱼ wₖ₋ⱼ        vₖ₊₁ = v̇ₖ/(k+1), qₖ = vₖ₋₁/k
//! ```
//!
//! Where the balance of forces is kept whole, K₀ wₖ = −(K w − b)ₖ with wₖ = 0 on the right: no element of K has a series of its own.
//! That is inverse dynamics, order by order (Luh, Walker & Paul 1980, J. Dyn. Syst. Meas. Control 102, for values).
//!
//! The sums over earlier coefficients come first, several in one loop; one factorization serves every order. Rules: Jorba & Zou
//! 2005, Experimental Mathematics 14, section 2; Griewank & Walther 2008, section 13.2.

mod first;
mod next;
mod rules;
mod sums;

use super::super::names::{self, index, local};
use super::solve::Elimination;
use super::writer::Writer;
use crate::ast::Emit;
use crate::plan::mode::ModeProgram;
use crate::plan::mode::products::{Plan, Row};
use crate::plan::{Program, Step, Value, ValueRef};
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use std::collections::BTreeSet;

/// Writes the coefficients of one mode.
struct Expansion<'a> {
    writer: Writer<'a>,
    plan: &'a Plan,
    mode: &'a ModeProgram,
    /// Values whose coefficient leaves its block.
    crossing: BTreeSet<Value>,
}

/// Coefficients up to this order have code of their own in unrolled series, and later ones loops.
const UNROLLED: usize = 21;
/// Series of more products have loops in any case: rustc would take minutes for what no run gains from.
const MOST_UNROLLED: usize = 100;

fn sum_coefficient(output: usize) -> Ident {
    local(&format!("dsum{output}"))
}

/// `impl ModeSeries for …`
pub fn implementation(
    name: &Ident,
    heading: &str,
    program: &Program,
    mode: &ModeProgram,
    plan: &Plan,
) -> TokenStream {
    let expansion = Expansion::new(program, mode, plan);
    let number = expansion.writer.number.clone();
    let elimination = Elimination::new(&expansion.writer, &mode.results.system);
    let first = expansion.first(&elimination);
    let emit = program.equations.system.emit;
    let unrolled = match emit == Emit::Unrolled && plan.convolutions() <= MOST_UNROLLED {
        true => UNROLLED,
        false => 0,
    };
    let single = (1..=unrolled).map(|k| expansion.order(k, &elimination));
    let looped = expansion.orders_from(1 + unrolled, &elimination);
    let (c, held, order, rows) = (local("c"), local("held"), local("order"), local("rows"));
    let (t, q, v, registers) = (local("t"), local("q"), local("v"), local("registers"));
    let (products, weight) = (local("products"), local("weight"));
    let newest = (0..plan.groups).map(sums::newest);
    let turns = local("turns");
    let groups = index(plan.groups);
    let rows_of = expansion.row_names();
    let memory = (plan.groups > 0).then(
        || quote!(let #products = first_mut::<STRIDE, _>(#products.as_chunks_mut::<#groups>().0);),
    );
    // Rows are kept of all positions and velocities.
    let read = names::read(&mode.tape);
    let states = 1..1 + 2 * mode.inputs.coordinates;
    let prologue =
        (expansion.writer).prologue(|input| states.contains(&input.0) || read.contains(&input));
    let needs = names::needs(program.equations.needs.len());
    let result = quote!(::core::result::Result<(), Refused>);
    quote! {
        #[doc = #heading]
        struct #name;
        impl<#number: Number> ModeSeries<#number> for #name {
            #[inline(always)]
            fn expand(
                #registers: Registers,
                #c: &[#number],
                #held: &Selection,
                #order: usize,
                (#t, #q, #v): Arguments<'_, #number>,
                (#rows, #products, #turns): Memory<'_, #number>,
            ) -> #result {
                #prologue
                let [#(#rows_of),*] = first_mut(#rows);
                #memory
                #needs
                #first
                #(let mut #newest = Factors::<#number>::none();)*
                let mut #weight = #number::of(0.0);
                #(#single)*
                #looped
                ::core::result::Result::Ok(())
            }
        }
    }
}

impl<'a> Expansion<'a> {
    fn new(program: &'a Program, mode: &'a ModeProgram, plan: &'a Plan) -> Expansion<'a> {
        let blocks = mode.tape.blocks.iter();
        let optional = blocks.filter(|block| !block.needs.is_always());
        let steps = optional.flat_map(|block| &block.steps);
        let declared = steps.flat_map(|step| {
            (0..step.operation.values()).map(|offset| Value(step.value.0 + offset))
        });
        let writer = Writer::new(&program.equations.system, mode, declared.collect());
        let mut crossing = names::crossing(&mode.tape);
        // Their series are kept behind all blocks.
        let factors = plan.optional_factors();
        crossing.extend(factors.filter(|value| writer.declared.contains(value)));
        Expansion {
            writer,
            plan,
            mode,
            crossing,
        }
    }

    /// Steps of blocks under needs whose series are expanded.
    fn optional_steps(&self) -> impl Iterator<Item = &Step> {
        let blocks = self.mode.tape.blocks.iter();
        let blocks = blocks.filter(|block| !block.needs.is_always());
        let steps = blocks.flat_map(|block| &block.steps);
        steps.filter(|step| self.plan.varying[step.value.0])
    }

    /// A local that belongs to a value. What it is stands before the name: behind it, it could be a part of a declared one.
    fn of(&self, what: &str, value: Value) -> Ident {
        local(&format!("{what}{}", self.writer.locals.stem(value)))
    }

    /// Coefficient k − 1 of a velocity, at hand: what is read back from memory is waited for.
    fn before(&self, velocity: Value) -> Ident {
        self.of("before_", velocity)
    }

    /// Coefficient k of it.
    fn now(&self, velocity: Value) -> Ident {
        self.of("now_", velocity)
    }

    /// Coefficient k of a value.
    fn coefficient_of(&self, value: Value) -> Ident {
        self.of("d", value)
    }

    /// What the rule of a function needs beside its value.
    fn auxiliary(&self, value: Value) -> Ident {
        self.of("u_", value)
    }

    /// Coefficient k of that.
    fn auxiliary_coefficient(&self, value: Value) -> Ident {
        self.of("du_", value)
    }

    /// What the rule of an operation divides by, inverted.
    fn inverse(&self, value: Value) -> Ident {
        self.of("inverse_", value)
    }

    /// Σ xⱼ yₖ₋ⱼ of a product, of several that with this number.
    fn product(&self, value: Value, at: usize) -> Ident {
        match at {
            0 => self.of("earlier_", value),
            _ => self.of(&format!("earlier{at}_"), value),
        }
    }

    /// All coefficients of a series that is kept.
    fn row(&self, row: Row) -> Ident {
        local(&format!("row_{}", self.writer.stem(row)))
    }

    /// Names the rows, in their order; those that no series is kept in have none.
    fn row_names(&self) -> Vec<TokenStream> {
        let mut names = vec![quote!(_); self.plan.rows];
        for (&row, &at) in self.plan.kept() {
            names[at] = self.row(row).to_token_stream();
        }
        names
    }

    /// `keep(row, at, value);`, if the row is kept.
    fn store(&self, row: Row, at: TokenStream, value: TokenStream) -> TokenStream {
        if self.plan.row(row).is_none() {
            return TokenStream::new();
        }
        let row = self.row(row);
        quote!(keep(#row, #at, #value);)
    }

    /// The coefficient of a value, if it has any.
    fn d(&self, value: Value) -> Option<TokenStream> {
        self.plan.varying[value.0].then(|| {
            let name = self.coefficient_of(value);
            quote!(#name)
        })
    }

    fn d_of_output(&self, output: usize) -> Option<TokenStream> {
        if self.plan.sums.contains_key(&output) {
            let name = sum_coefficient(output);
            return self.plan.sums[&output].then(|| quote!(#name));
        }
        self.d(self.plan.set[&output])
    }

    fn d_of_place(&self, place: ValueRef) -> Option<TokenStream> {
        match place {
            ValueRef::Node(output) => self.d_of_output(output),
            ValueRef::Zero | ValueRef::Constant(_) => None,
        }
    }
}
