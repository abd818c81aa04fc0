//! The linear system as a straight line: elimination in a fixed order, every pivot tested against its share.
//!
//! ```text
//! M = L D Lᵀ for the accelerations, then the Schur complement of the rows that stay, L U
//! ```
//!
//! Where a test fails the core's own solver, which looks for the best pivots, takes over.

use super::super::names::local;
use super::writer::Writer;
use crate::plan::ValueRef;
use crate::plan::mode::LinearSystem;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

/// What is left of an element during the elimination.
#[derive(Clone)]
enum Element {
    Zero,
    /// As it was.
    Whole(ValueRef),
    Reduced(Ident),
}

/// The elimination of a system, to be written down.
pub struct Elimination<'a> {
    system: &'a LinearSystem,
    /// Unknowns in the order in which they are eliminated.
    order: Vec<usize>,
    /// (row, pivot): factors of L that are not zero.
    factors: Vec<(usize, usize)>,
    /// Rows of U.
    upper: Vec<Vec<Element>>,
    /// What computes the factors, and whether the pivots are safe.
    pub code: TokenStream,
}

fn factor(i: usize, p: usize) -> Ident {
    local(&format!("l{i}_{p}"))
}

fn reciprocal(p: usize) -> Ident {
    local(&format!("r{p}"))
}

/// Rows with few elements first: they leave the others as they are.
fn order(system: &LinearSystem) -> Vec<usize> {
    let size = system.matrix.len();
    let mut order: Vec<usize> = (0..size).collect();
    let filled = |i: usize, j: usize| system.matrix[i][j] != ValueRef::Zero;
    order.sort_by_key(|&i| {
        let others = (0..size).filter(|&j| j != i && (filled(i, j) || filled(j, i)));
        let varies = matches!(system.matrix[i][i], ValueRef::Node(_));
        (i >= system.accelerations, others.count(), varies, i)
    });
    order
}

impl<'a> Elimination<'a> {
    pub fn new(writer: &Writer, system: &'a LinearSystem) -> Elimination<'a> {
        let size = system.matrix.len();
        let order = order(system);
        let number = &writer.number;
        let mut m: Vec<Vec<Element>> = system
            .matrix
            .iter()
            .map(|row| {
                let element = |place: &ValueRef| match place {
                    ValueRef::Zero => Element::Zero,
                    place => Element::Whole(*place),
                };
                row.iter().map(element).collect()
            })
            .collect();
        let read = |element: &Element| match element {
            Element::Zero => quote!(#number::of(0.0)),
            Element::Whole(place) => writer.place(*place),
            Element::Reduced(name) => quote!(#name),
        };
        let safe = local("safe");
        let mut code = quote!(let mut #safe = true;);
        let mut factors = Vec::new();
        // Least share that a pivot before has kept of its diagonal element: later ones miss it too.
        let mut least: Option<Ident> = None;
        // Diagonal elements that pivots are compared with: of rows that stay, once the accelerations are eliminated.
        let mut before: Vec<TokenStream> = (0..size).map(|i| read(&m[i][i])).collect();
        // What coordinates add to the compliance of each row: those of constant inertia, and those that may lose nearly all of it.
        let mut compliance: Vec<[Vec<TokenStream>; 2]> = vec![Default::default(); size];
        for (step, &p) in order.iter().enumerate() {
            let rest = &order[step + 1..];
            if step == system.accelerations {
                rest.iter()
                    .chain([&p])
                    .for_each(|&i| before[i] = read(&m[i][i]));
                for [constant, varying] in &compliance {
                    if !varying.is_empty() && constant.len() + varying.len() > 1 {
                        code.extend(
                            quote!(#safe &= #number::is_spread(&[#(#constant),*], &[#(#varying),*]);),
                        );
                    }
                }
            }
            let pivot = read(&m[p][p]);
            let leading = p < system.accelerations;
            if system.units[p] {
                continue;
            }
            let name = reciprocal(p);
            if leading
                && system.symmetric
                && matches!(m[p][p], Element::Whole(ValueRef::Constant(_)))
            {
                // The constants have been tested.
            } else if leading && system.symmetric {
                let original = &before[p];
                let tested = match &least {
                    None => quote!(#pivot),
                    Some(least) => quote!((#least * #pivot)),
                };
                code.extend(quote!(#safe &= #number::is_positive_share(#tested, #original);));
                if matches!(m[p][p], Element::Reduced(_)) {
                    let share = quote!(#pivot / #original);
                    let name = local(&format!("least{step}"));
                    code.extend(match &least {
                        None => quote!(let #name = #share;),
                        Some(least) => quote!(let #name = #number::lesser(#least, #share);),
                    });
                    least = Some(name);
                }
            } else {
                let below = rest.iter().map(|&i| &m[i][p]);
                let below = below.filter(|e| !matches!(e, Element::Zero)).map(read);
                let before = &before[p];
                code.extend(
                    quote!(#safe &= #number::is_safe_pivot(#pivot, #before, &[#(#below),*]);),
                );
            }
            let known = system.reciprocals.get(p).copied().flatten();
            match (&m[p][p], known) {
                (Element::Whole(_), Some(place)) => {
                    let inverse = writer.place(place);
                    code.extend(quote!(let #name = #inverse;));
                }
                _ => code.extend(quote!(let #name = #number::of(1.0) / #pivot;)),
            }
            for &i in rest {
                if matches!(m[i][p], Element::Zero) {
                    continue;
                }
                let (l, element) = (factor(i, p), read(&m[i][p]));
                code.extend(quote!(let #l = #element * #name;));
                if leading && system.symmetric && i >= system.accelerations {
                    let varies = !matches!(m[p][p], Element::Whole(ValueRef::Constant(_)));
                    compliance[i][usize::from(varies)].push(quote!(#l * #element));
                }
                factors.push((i, p));
                for &j in rest {
                    if matches!(m[p][j], Element::Zero) {
                        continue;
                    }
                    let mirrored = system.symmetric
                        && leading
                        && i < system.accelerations
                        && j < system.accelerations
                        && order.iter().position(|&x| x == j) < order.iter().position(|&x| x == i);
                    if mirrored {
                        m[i][j] = m[j][i].clone();
                        continue;
                    }
                    let name = format_ident!("m{}_{}_{}", i, j, step, span = l.span());
                    let across = read(&m[p][j]);
                    let line = match &m[i][j] {
                        Element::Zero => quote!(let #name = -(#l * #across);),
                        element => {
                            let element = read(element);
                            quote!(let #name = #element - #l * #across;)
                        }
                    };
                    code.extend(line);
                    m[i][j] = Element::Reduced(name);
                }
            }
        }
        Elimination {
            system,
            order,
            factors,
            upper: m,
            code,
        }
    }

    /// Solves the system itself.
    pub fn solve_system(&self, writer: &Writer) -> (TokenStream, Vec<Ident>) {
        let right = self.system.right.iter().map(|place| match place {
            ValueRef::Zero => None,
            place => Some(writer.place(*place)),
        });
        self.solve(writer, right.collect(), "")
    }

    /// Solves for right-hand sides, none of which stands for zero; the results have names that begin with `prefix`.
    pub fn solve(
        &self,
        writer: &Writer,
        right: Vec<Option<TokenStream>>,
        prefix: &str,
    ) -> (TokenStream, Vec<Ident>) {
        let number = &writer.number;
        let mut code = TokenStream::new();
        let mut b = right;
        let name = |kind: &str, i: usize, step: usize| local(&format!("{prefix}{kind}{i}_{step}"));
        for (step, &p) in self.order.iter().enumerate() {
            let Some(pivot) = b[p].clone() else { continue };
            for &(i, _) in self.factors.iter().filter(|&&(_, q)| q == p) {
                let (l, to) = (factor(i, p), name("b", i, step));
                let line = match &b[i] {
                    None => quote!(let #to = -(#l * #pivot);),
                    Some(before) => quote!(let #to = #before - #l * #pivot;),
                };
                code.extend(line);
                b[i] = Some(quote!(#to));
            }
        }
        let mut solution: Vec<Option<Ident>> = vec![None; b.len()];
        for (step, &p) in self.order.iter().enumerate().rev() {
            let mut sum = b[p].clone();
            for &j in &self.order[step + 1..] {
                let across = match &self.upper[p][j] {
                    Element::Zero => continue,
                    Element::Whole(place) => writer.place(*place),
                    Element::Reduced(name) => quote!(#name),
                };
                let x = solution[j].clone();
                sum = Some(match sum {
                    None => quote!((-(#across * #x))),
                    Some(sum) => quote!((#sum - #across * #x)),
                });
            }
            let to = name("x", p, step);
            let line = match sum {
                None => quote!(let #to = #number::of(0.0);),
                // A pivot of a force that the motion keeps constant (the l² of a rod) would have the same rounding error in
                // every solve if it were multiplied by its inverse.
                Some(sum) if p >= self.system.accelerations => {
                    let pivot = match &self.upper[p][p] {
                        Element::Zero => quote!(#number::of(0.0)),
                        Element::Whole(place) => writer.place(*place),
                        Element::Reduced(name) => quote!(#name),
                    };
                    quote!(let #to = #sum / #pivot;)
                }
                Some(sum) if self.system.units[p] => quote!(let #to = #sum;),
                Some(sum) => {
                    let inverse = reciprocal(p);
                    quote!(let #to = #sum * #inverse;)
                }
            };
            code.extend(line);
            solution[p] = Some(to);
        }
        (code, solution.into_iter().flatten().collect())
    }

    /// What rounding leaves of b − K w, row by row.
    pub fn residuals(&self, writer: &Writer, solution: &[Ident]) -> Vec<Option<TokenStream>> {
        let rows = self
            .system
            .matrix
            .iter()
            .zip(&self.system.right)
            .enumerate();
        rows.map(|(i, (row, right))| {
            if self.system.units[i] {
                return None;
            }
            let mut sum = writer.place(*right);
            for (place, x) in row.iter().zip(solution) {
                if *place != ValueRef::Zero {
                    let element = writer.place(*place);
                    sum = quote!((-#element).mul_add(#x, #sum));
                }
            }
            Some(sum)
        })
        .collect()
    }
}
