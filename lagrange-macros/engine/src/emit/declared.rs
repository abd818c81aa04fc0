//! The declared quantities as data: `Declaration` of the core, which certificates evaluate.
//!
//! A straight line of operations, one for each sub-expression of the declaration in the order of the pool. It is not planned,
//! shared between modes or optimised, so that it has nothing in common with the tapes but the declaration.

use super::exact::Exact;
use super::names::{self, index};
use crate::model::{
    Contact, Declared, Draw, Force, Friction, Normal, Restitution, System, Turn, Watch, Worked,
};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Function, Node, Rational, Symbol};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

// Numbers of the operations; all as in the core's `declaration`.
const NUMBER: usize = 0;
const PARAMETER: usize = 1;
const TIME: usize = 2;
const POSITION: usize = 3;
const FORCE: usize = 4;
const LOAD: usize = 5;
const ADD: usize = 6;
const MULTIPLY: usize = 7;
const POWER: usize = 8;
const DERIVATIVE: usize = 9;
const SELECT: usize = 10;
const ATAN2: usize = 11;
const FUNCTIONS: usize = 12;

/// `Declaration { … }`; stops and marks in the order of `system`.
pub fn declaration(declared: &Declared, system: &System) -> TokenStream {
    let of = &declared.system;
    let core = &system.core;
    let mut writer = Writer::new(declared);
    writer.write(&roots(of));
    writer.write(&drawn_roots(of));
    let kinetic = of.kinetic.iter().map(|term| writer.value(term.energy));
    let potential = of.potential.iter().map(|term| writer.value(term.energy));
    let constraints = of.constraints.iter().map(|c| writer.value(c.residual));
    let contacts = of.contacts.iter().map(|c| contact(c, core, &writer));
    let frictions = of.frictions.iter().map(|f| friction(f, core, &writer));
    let forces = of.forces.iter().map(|f| force(f, core, &writer));
    let dissipations = of.dissipations.iter().map(|d| writer.value(d.rayleigh));
    let stops = watches(&system.stops, &of.stops, &writer);
    let marks = watches(&system.marks, &of.marks, &writer);
    let draws = of.draws.iter().map(|draw| drawn(draw, core, &writer));
    let words = Literal::byte_string(&writer.bytes);
    let numbers = writer.numbers.table();
    quote! {
        #core::__private::declaration::Declaration {
            words: #words,
            numbers: #numbers,
            kinetic: &[#(#kinetic),*],
            potential: &[#(#potential),*],
            constraints: &[#(#constraints),*],
            contacts: &[#(#contacts),*],
            frictions: &[#(#frictions),*],
            forces: &[#(#forces),*],
            dissipations: &[#(#dissipations),*],
            stops: &[#(#stops),*],
            marks: &[#(#marks),*],
            draws: &[#(#draws),*],
        }
    }
}

/// `Contact { … }`
fn contact(contact: &Contact, core: &TokenStream, writer: &Writer) -> TokenStream {
    let gap = writer.value(contact.gap);
    let region = writer.option(contact.region);
    let factor = writer.option(contact.normal_factor);
    let (Restitution::Newton(e) | Restitution::Poisson(e)) = contact.restitution;
    let restitution = writer.value(e);
    quote! {
        #core::__private::declaration::Contact {
            gap: #gap, normal_factor: #factor, restitution: #restitution, region: #region,
        }
    }
}

/// `Friction { … }`
fn friction(friction: &Friction, core: &TokenStream, writer: &Writer) -> TokenStream {
    let slip = friction.slip.iter().map(|(slip, _)| writer.value(*slip));
    let normal = writer.option(match friction.normal {
        Normal::Given(e) => Some(e),
        _ => None,
    });
    let stick = writer.value(friction.static_coefficient);
    let slide = writer.value(friction.kinetic_coefficient);
    quote! {
        #core::__private::declaration::Friction {
            slip: &[#(#slip),*], normal: #normal, static_coefficient: #stick, kinetic_coefficient: #slide,
        }
    }
}

/// `Force { … }`
fn force(force: &Force, core: &TokenStream, writer: &Writer) -> TokenStream {
    let components = force.components.iter().map(|(f, worked)| {
        let f = writer.value(*f);
        let (along, value) = match worked {
            Worked::Coordinate(j) => (quote!(Coordinate), index(*j)),
            Worked::Point(p) => (quote!(Point), writer.value(*p)),
            Worked::Speed(s) => (quote!(Speed), writer.value(*s)),
        };
        quote!((#f, #core::__private::declaration::Worked::#along(#value)))
    });
    let reported = writer.value(force.value);
    quote!(#core::__private::declaration::Force { value: #reported, components: &[#(#components),*] })
}

/// The terms of those stops or marks that are `known` by their names.
fn watches(all: &[Watch], known: &[Watch], writer: &Writer) -> Vec<TokenStream> {
    let same = |watch: &Watch| known.iter().find(|k| k.name.text == watch.name.text);
    let terms = all.iter().map(|watch| {
        let terms = same(watch).map(|known| {
            let terms = known.terms.iter().map(|e| writer.value(*e));
            quote!(&[#(#terms),*])
        });
        names::option(terms)
    });
    terms.collect()
}

/// `Draw { … }`
fn drawn(draw: &Draw, core: &TokenStream, writer: &Writer) -> TokenStream {
    let values = |all: &[ExprId]| {
        let all = all.iter().map(|e| writer.value(*e));
        quote!(&[#(#all),*])
    };
    let form = names::plain(&format!("{:?}", draw.form));
    let name = &draw.name;
    let places = draw.places.iter().map(|place| values(place));
    let (size, applied) = (values(&draw.size), values(&draw.applied));
    let turn = match &draw.turn {
        Turn::None => quote!(None),
        Turn::Angle(angle) => {
            let angle = writer.value(*angle);
            quote!(Angle(#angle))
        }
        Turn::Attitude(first) => {
            let first = index(*first);
            quote!(Attitude(#first))
        }
        Turn::About(vectors) => {
            let vectors = values(vectors);
            quote!(About(#vectors))
        }
        Turn::Rolled(angles) => {
            let angles = values(angles);
            quote!(Rolled(#angles))
        }
    };
    let parts = draw.parts.iter().map(|(row, slope)| {
        let (row, slope) = (index(*row), values(slope));
        quote!((#row, #slope))
    });
    let loads = draw.loads.iter().map(|load| index(*load));
    quote! {
        #core::__private::declaration::Draw {
            form: #core::__private::declaration::Form::#form,
            name: #name,
            places: &[#(#places),*],
            size: #size,
            turn: #core::__private::declaration::Turn::#turn,
            parts: &[#(#parts),*],
            applied: #applied,
            loads: &[#(#loads),*],
        }
    }
}

/// Everything that is evaluated but for pictures.
fn roots(system: &System) -> Vec<ExprId> {
    let energies = system.kinetic.iter().chain(&system.potential);
    let mut roots: Vec<ExprId> = energies.map(|term| term.energy).collect();
    roots.extend(system.constraints.iter().map(|c| c.residual));
    for contact in &system.contacts {
        let (Restitution::Newton(e) | Restitution::Poisson(e)) = contact.restitution;
        roots.extend([contact.gap, e]);
        roots.extend(contact.normal_factor.iter().chain(&contact.region));
    }
    for friction in &system.frictions {
        roots.extend(friction.slip.iter().map(|(slip, _)| slip));
        roots.extend([friction.static_coefficient, friction.kinetic_coefficient]);
        if let Normal::Given(e) = friction.normal {
            roots.push(e);
        }
    }
    for force in &system.forces {
        roots.push(force.value);
        for &(f, worked) in &force.components {
            roots.push(f);
            if let Worked::Point(e) | Worked::Speed(e) = worked {
                roots.push(e);
            }
        }
    }
    roots.extend(system.dissipations.iter().map(|d| d.rayleigh));
    let watches = system.stops.iter().chain(&system.marks);
    roots.extend(watches.flat_map(|watch| &watch.terms));
    roots
}

/// What is evaluated for pictures only.
fn drawn_roots(system: &System) -> Vec<ExprId> {
    let mut roots = Vec::new();
    for draw in &system.draws {
        roots.extend(draw.places.iter().flatten());
        roots.extend(draw.size.iter().chain(&draw.applied));
        roots.extend(draw.parts.iter().flat_map(|(_, slope)| slope));
        match &draw.turn {
            Turn::None | Turn::Attitude(_) => {}
            Turn::Angle(angle) => roots.push(*angle),
            Turn::About(numbers) | Turn::Rolled(numbers) => roots.extend(numbers),
        }
    }
    roots
}

struct Writer<'a> {
    declared: &'a Declared,
    /// What each symbol but those of rates is.
    symbols: SortedMap<Symbol, Input>,
    values: SortedMap<ExprId, usize>,
    count: usize,
    bytes: Vec<u8>,
    numbers: Exact,
}

#[derive(Clone, Copy)]
enum Input {
    Read(usize, usize),
    /// Derivatives of a position, how many.
    Rate(usize, usize),
}

impl<'a> Writer<'a> {
    fn new(declared: &'a Declared) -> Writer<'a> {
        let system = &declared.system;
        let mut symbols = SortedMap::from([(system.time, Input::Read(TIME, 0))]);
        for (i, parameter) in system.parameters.iter().enumerate() {
            symbols.insert(parameter.symbol, Input::Read(PARAMETER, i));
        }
        for (i, coordinate) in system.coordinates.iter().enumerate() {
            symbols.insert(coordinate.position, Input::Read(POSITION, i));
            symbols.insert(coordinate.velocity, Input::Rate(i, 1));
            symbols.insert(coordinate.acceleration, Input::Rate(i, 2));
        }
        for (row, &force) in system.multipliers().iter().enumerate() {
            symbols.insert(force, Input::Read(FORCE, row));
        }
        for (i, force) in system.forces.iter().enumerate() {
            symbols.insert(force.force, Input::Read(LOAD, i));
        }
        Writer {
            declared,
            symbols,
            values: SortedMap::new(),
            count: 0,
            bytes: Vec::new(),
            numbers: Exact::default(),
        }
    }

    /// Where the value of an expression is, once it has been written.
    fn value(&self, e: ExprId) -> Literal {
        index(self.values[&e])
    }

    /// The same, where there may be none.
    fn option(&self, e: Option<ExprId>) -> TokenStream {
        names::option(e.map(|e| self.value(e)))
    }

    /// Writes everything that the roots are made of, ascending: operands first. A rate comes after its expression and a
    /// selection after its guard, since they were made in that order.
    fn write(&mut self, roots: &[ExprId]) {
        let pool = &self.declared.system.pool;
        let mut all: SortedSet<ExprId> = SortedSet::new();
        let mut stack = roots.to_vec();
        while let Some(e) = stack.pop() {
            if self.values.contains_key(&e) || !all.insert(e) {
                continue;
            }
            let node = pool.node(e);
            node.for_each_child(|child| stack.push(child));
            match node {
                Node::Symbol(symbol) => stack.extend(self.declared.rates.get(symbol)),
                Node::Select { branch, .. } => {
                    stack.push(self.declared.system.branches[*branch].guard);
                }
                _ => {}
            }
        }
        for e in all {
            let value = self.node(pool.node(e));
            self.values.insert(e, value);
        }
    }

    fn node(&mut self, node: &Node) -> usize {
        match node {
            Node::Number(number) => self.number(number.to_f64()),
            Node::Pi => self.number(std::f64::consts::PI),
            Node::Symbol(symbol) => match self.declared.rates.get(symbol) {
                Some(e) => self.push(DERIVATIVE, self.values[e], 0),
                None => match self.symbols[symbol] {
                    Input::Read(operation, place) => self.push(operation, place, 0),
                    Input::Rate(coordinate, times) => {
                        let position = self.push(POSITION, coordinate, 0);
                        (0..times).fold(position, |x, _| self.push(DERIVATIVE, x, 0))
                    }
                },
            },
            Node::Sum { constant, terms } => {
                let mut sum = (!constant.is_zero()).then(|| self.number(constant.to_f64()));
                for (e, c) in terms {
                    let mut term = self.values[e];
                    if *c != Rational::ONE {
                        let c = self.number(c.to_f64());
                        term = self.push(MULTIPLY, c, term);
                    }
                    sum = Some(match sum {
                        Some(sum) => self.push(ADD, sum, term),
                        None => term,
                    });
                }
                sum.unwrap_or_else(|| self.number(0.0))
            }
            Node::Product(factors) => {
                let mut product = None;
                for (e, exponent) in factors {
                    let mut factor = self.values[e];
                    if *exponent != Rational::ONE {
                        let place = self.numbers.place(exponent.to_f64());
                        factor = self.push(POWER, factor, place);
                    }
                    product = Some(match product {
                        Some(product) => self.push(MULTIPLY, product, factor),
                        None => factor,
                    });
                }
                product.unwrap_or_else(|| self.number(1.0))
            }
            Node::Power(base, exponent) => {
                let (base, exponent) = (self.values[base], self.values[exponent]);
                let logarithm = self.call(Function::Ln, base);
                let product = self.push(MULTIPLY, exponent, logarithm);
                self.call(Function::Exp, product)
            }
            Node::Call(Function::Atan2, arguments) => {
                let (y, x) = (self.values[&arguments[0]], self.values[&arguments[1]]);
                self.push(ATAN2, y, x)
            }
            Node::Call(function, arguments) => self.call(*function, self.values[&arguments[0]]),
            Node::Group(e) => self.values[e],
            Node::Select {
                branch,
                then,
                otherwise,
            } => {
                let guard = self.values[&self.declared.system.branches[*branch].guard];
                let (then, otherwise) = (self.values[then], self.values[otherwise]);
                self.push(SELECT | guard << 8, then, otherwise)
            }
        }
    }

    fn call(&mut self, function: Function, x: usize) -> usize {
        let number = match function {
            Function::Sin => 0,
            Function::Cos => 1,
            Function::Tan => 2,
            Function::Asin => 3,
            Function::Acos => 4,
            Function::Atan | Function::Atan2 => 5,
            Function::Sinh => 6,
            Function::Cosh => 7,
            Function::Tanh => 8,
            Function::Exp => 9,
            Function::Ln => 10,
        };
        self.push(FUNCTIONS + number, x, 0)
    }

    fn number(&mut self, number: f64) -> usize {
        let place = self.numbers.place(number);
        self.push(NUMBER, place, 0)
    }

    fn push(&mut self, operation: usize, x: usize, y: usize) -> usize {
        for word in [operation, x, y] {
            // The node budget keeps numbers of values below 2²⁴.
            self.bytes.extend_from_slice(&(word as u32).to_le_bytes());
        }
        self.count += 1;
        self.count - 1
    }
}
