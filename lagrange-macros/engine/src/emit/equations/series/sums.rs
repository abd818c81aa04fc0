//! Sums over earlier coefficients, in groups of four products, and the factors that they are made of.

use super::{Expansion, sum_coefficient};
use crate::emit::names::{self, index, local};
use crate::plan::Value;
use crate::plan::mode::products::{Factor, GROUP, Group, Product};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// So many groups of products are summed together at most: a processor has sixteen registers for their sums and what they add.
const TOGETHER: usize = 8;

/// The name of the sum that an element of the linear system has with an unknown.
pub(super) fn system_product(i: usize, j: usize) -> Ident {
    local(&format!("earlier_k{i}_{j}"))
}

/// The newest coefficients of the factors of a group.
pub(super) fn newest(group: usize) -> Ident {
    local(&format!("newest{group}"))
}

/// The products that are summed in one loop, with the number of their first group, of those whose groups begin with `first`.
fn loops(
    first: usize,
    products: &[(Ident, Product)],
) -> impl Iterator<Item = (usize, &[(Ident, Product)])> {
    let count = products.len().div_ceil(GROUP);
    let together = count.div_ceil(count.div_ceil(TOGETHER).max(1)).max(1);
    let loops = products.chunks(GROUP * together).enumerate();
    loops.map(move |(at, products)| (first + at * together, products))
}

impl Expansion<'_> {
    /// The sums over earlier coefficients that count whatever is held, with their names.
    pub(super) fn always_summed(&self) -> Vec<(Ident, Product)> {
        let always = self.plan.always(self.mode).into_iter();
        let of_system = self.plan.system_products(self.mode).into_iter();
        let of_system = of_system.map(|(i, j, product)| (system_product(i, j), product));
        always.map(|one| self.named(one)).chain(of_system).collect()
    }

    fn named(&self, (value, at, product): (Value, usize, Product)) -> (Ident, Product) {
        (self.product(value, at), product)
    }

    /// Σ xⱼ yₖ₋ⱼ for 0 < j < k of all products, which are in groups from `first` on, into new locals or into those that there are.
    pub(super) fn sums(
        &self,
        first: usize,
        products: &[(Ident, Product)],
        new: bool,
    ) -> TokenStream {
        let (k, registers, memory) = (local("k"), local("registers"), local("products"));
        let loops = loops(first, products).map(|(from, products)| {
            let groups = products.chunks(GROUP).map(|group| {
                let names = group.iter().map(|(name, _)| name);
                let rest = (group.len()..GROUP).map(|_| quote!(_));
                quote!([#(#names,)* #(#rest),*])
            });
            let last = (from..from + products.len().div_ceil(GROUP)).map(newest);
            let (bind, from) = (new.then(|| quote!(let)), index(from));
            quote! {
                #bind [#(#groups),*] = Factors::sums(#registers, #k, #memory, #from, [#(#last),*]);
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
    pub(super) fn optional_sums(&self) -> TokenStream {
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
    pub(super) fn keep_optional_factors(&self) -> TokenStream {
        let runs = self.optional_groups().map(|(first, run)| {
            let condition = names::condition(&run[0].needs);
            let factors = self.keep_factors(first, &self.named_products(run));
            quote!(if #condition { #factors })
        });
        quote!(#(#runs)*)
    }

    /// Keeps coefficient k of the factors of products.
    pub(super) fn keep_factors(&self, first: usize, products: &[(Ident, Product)]) -> TokenStream {
        let (memory, p, registers) = (local("products"), local("p"), local("registers"));
        let loops = loops(first, products).map(|(from, products)| {
            let last = (from..from + products.len().div_ceil(GROUP)).map(newest);
            let (x, y): (Vec<_>, Vec<_>) = products.chunks(GROUP).map(|group| {
                // Nobody reads the sums of what a group lacks: it repeats its last product.
                let filled = |place: usize| group[place.min(group.len() - 1)].1;
                let x = (0..GROUP).map(|place| self.factor(filled(place).0));
                let y = (0..GROUP).map(|place| self.factor(filled(place).1));
                (quote!([#(#x),*]), quote!([#(#y),*]))
            }).unzip();
            let from = index(from);
            quote! {
                [#(#last),*] = Factors::keep(#registers, &mut #memory[#p], #from, [#(#x),*], [#(#y),*]);
            }
        });
        quote!(#(#loops)*)
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
}
