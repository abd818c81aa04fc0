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

/// An elimination on its way.
struct Work<'a> {
    writer: &'a Writer<'a>,
    system: &'a LinearSystem,
    order: &'a [usize],
    /// What is left of K.
    m: Vec<Vec<Element>>,
    factors: Vec<(usize, usize)>,
    code: TokenStream,
    /// Least share that a pivot before has kept of its diagonal element: later ones miss it too.
    least: Option<Ident>,
    /// Diagonal elements that pivots are compared with: of rows that stay, once the accelerations are eliminated.
    before: Vec<Element>,
    /// What coordinates add to the compliance of each row: those of constant inertia, and those that may lose nearly all of it.
    compliance: Vec<[Vec<TokenStream>; 2]>,
}

impl<'a> Work<'a> {
    fn new(writer: &'a Writer<'a>, system: &'a LinearSystem, order: &'a [usize]) -> Work<'a> {
        let size = system.matrix.len();
        let element = |place: &ValueRef| match place {
            ValueRef::Zero => Element::Zero,
            place => Element::Whole(*place),
        };
        let rows = system.matrix.iter();
        let safe = local("safe");
        let mut work = Work {
            writer,
            system,
            order,
            m: rows.map(|row| row.iter().map(element).collect()).collect(),
            factors: Vec::new(),
            code: quote!(let mut #safe = true;),
            least: None,
            before: Vec::new(),
            compliance: vec![Default::default(); size],
        };
        work.before = (0..size).map(|i| work.m[i][i].clone()).collect();
        work
    }

    fn read(&self, element: &Element) -> TokenStream {
        let number = &self.writer.number;
        match element {
            Element::Zero => quote!(#number::of(0.0)),
            Element::Whole(place) => self.writer.place(*place),
            Element::Reduced(name) => quote!(#name),
        }
    }

    /// Whether a pivot is that of an acceleration in a symmetric matrix.
    fn is_inertia(&self, p: usize) -> bool {
        p < self.system.accelerations && self.system.symmetric
    }

    fn is_constant(&self, p: usize) -> bool {
        matches!(self.m[p][p], Element::Whole(ValueRef::Constant(_)))
    }

    /// The accelerations are eliminated: from this step on pivots are those of the rows that stay.
    fn begin_rows(&mut self, step: usize) {
        let number = &self.writer.number;
        for &i in &self.order[step..] {
            self.before[i] = self.m[i][i].clone();
        }
        let safe = local("safe");
        for [constant, varying] in &self.compliance {
            if !varying.is_empty() && constant.len() + varying.len() > 1 {
                self.code.extend(
                    quote!(#safe &= #number::is_spread(&[#(#constant),*], &[#(#varying),*]);),
                );
            }
        }
    }

    /// Tests the pivot of a step.
    fn test(&mut self, step: usize) {
        let number = &self.writer.number;
        let p = self.order[step];
        // The constants have been tested.
        if self.is_inertia(p) && self.is_constant(p) {
            return;
        }
        let (pivot, safe) = (self.read(&self.m[p][p]), local("safe"));
        let before = self.read(&self.before[p]);
        if !self.is_inertia(p) {
            let below = self.order[step + 1..].iter().map(|&i| &self.m[i][p]);
            let below = below.filter(|e| !matches!(e, Element::Zero));
            let below = below.map(|element| self.read(element));
            let test = quote!(#safe &= #number::is_safe_pivot(#pivot, #before, &[#(#below),*]););
            self.code.extend(test);
            return;
        }
        let tested = match &self.least {
            None => quote!(#pivot),
            Some(least) => quote!((#least * #pivot)),
        };
        self.code
            .extend(quote!(#safe &= #number::is_positive_share(#tested, #before);));
        if matches!(self.m[p][p], Element::Reduced(_)) {
            let share = quote!(#pivot / #before);
            let name = local(&format!("least{step}"));
            self.code.extend(match &self.least {
                None => quote!(let #name = #share;),
                Some(least) => quote!(let #name = #number::lesser(#least, #share);),
            });
            self.least = Some(name);
        }
    }

    /// 1/Kₚₚ
    fn invert(&mut self, p: usize) {
        let number = &self.writer.number;
        let name = reciprocal(p);
        let known = self.system.reciprocals.get(p).copied().flatten();
        let inverse = match (&self.m[p][p], known) {
            (Element::Whole(_), Some(place)) => self.writer.place(place),
            (element, _) => {
                let pivot = self.read(element);
                quote!(#number::of(1.0) / #pivot)
            }
        };
        self.code.extend(quote!(let #name = #inverse;));
    }

    /// Takes the row of the pivot out of those below.
    fn subtract(&mut self, step: usize) {
        let (p, rest) = (self.order[step], &self.order[step + 1..]);
        let name = reciprocal(p);
        for &i in rest {
            if matches!(self.m[i][p], Element::Zero) {
                continue;
            }
            let (l, element) = (factor(i, p), self.read(&self.m[i][p]));
            self.code.extend(quote!(let #l = #element * #name;));
            if self.is_inertia(p) && i >= self.system.accelerations {
                let varies = !self.is_constant(p);
                self.compliance[i][usize::from(varies)].push(quote!(#l * #element));
            }
            self.factors.push((i, p));
            for &j in rest {
                if !matches!(self.m[p][j], Element::Zero) {
                    self.m[i][j] = self.reduced(step, i, j);
                }
            }
        }
    }

    /// Kᵢⱼ − l Kₚⱼ
    fn reduced(&mut self, step: usize, i: usize, j: usize) -> Element {
        let p = self.order[step];
        let at = |index: usize| self.order.iter().position(|&x| x == index);
        let free = self.system.accelerations;
        if self.is_inertia(p) && i < free && j < free && at(j) < at(i) {
            return self.m[j][i].clone();
        }
        let l = factor(i, p);
        let name = format_ident!("m{}_{}_{}", i, j, step, span = l.span());
        let across = self.read(&self.m[p][j]);
        let result = match &self.m[i][j] {
            Element::Zero => quote!(-(#l * #across)),
            element => {
                let element = self.read(element);
                quote!(#element - #l * #across)
            }
        };
        self.code.extend(quote!(let #name = #result;));
        Element::Reduced(name)
    }
}

impl<'a> Elimination<'a> {
    pub fn new(writer: &Writer, system: &'a LinearSystem) -> Elimination<'a> {
        let order = order(system);
        let mut work = Work::new(writer, system, &order);
        for (step, &p) in order.iter().enumerate() {
            if step == system.accelerations {
                work.begin_rows(step);
            }
            if !system.units[p] {
                work.test(step);
                work.invert(p);
                work.subtract(step);
            }
        }
        let (factors, upper, code) = (work.factors, work.m, work.code);
        Elimination {
            system,
            order,
            factors,
            upper,
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
