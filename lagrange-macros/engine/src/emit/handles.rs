//! Handles: one associated constant for each named item, `MassOnWheel::RIM`, with its equation as documentation.

use super::constants::{OF_SYSTEMS, OUTPUT, screaming};
use crate::model::{ItemName, Normal, System};
use crate::plan::Program;
use crate::sorted::SortedSet;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::names::{index, plain};

/// An item that gets a handle.
struct Handle<'a> {
    name: &'a ItemName,
    /// Type of the handle.
    kind: &'static str,
    /// Index in the description.
    index: usize,
    /// One line of documentation.
    text: String,
}

/// `impl X { pub const … }`
pub fn handles(program: &Program) -> TokenStream {
    let system = &program.equations.system;
    let (name, core) = (&system.name, &system.core);
    let arguments = system.scalar.as_ref().map(|_| quote!(<f64>));
    let items = items(system);
    let mut constants = Vec::new();
    let mut taken: SortedSet<String> = OF_SYSTEMS.map(str::to_owned).into_iter().collect();
    let mut rest = &items[..];
    while let Some(first) = rest.first() {
        // The elements of an indexed item follow each other.
        let count = first
            .name
            .element
            .map_or(1, |(_, count)| count)
            .clamp(1, rest.len());
        let (elements, after) = rest.split_at(count);
        rest = after;
        let Some(ident) = &first.name.ident else {
            continue;
        };
        let indices: Vec<usize> = elements.iter().map(|element| element.index).collect();
        let indices = first
            .name
            .element
            .map_or(Indices::One(first.index), |_| Indices::Many(&indices));
        let constant = screaming(ident);
        if taken.insert(constant.to_string()) || first.kind != OUTPUT {
            constants.push(handle(core, &constant, first.kind, indices, &first.text));
        }
    }
    inherent(quote!(#name #arguments), &constants)
}

/// Indices of a handle.
pub(super) enum Indices<'a> {
    /// An item.
    One(usize),
    /// The elements of an indexed item.
    Many(&'a [usize]),
}

/// One associated constant.
pub(super) fn handle(
    core: &TokenStream,
    name: &Ident,
    kind: &str,
    indices: Indices,
    text: &str,
) -> TokenStream {
    let kind = plain(kind);
    match indices {
        Indices::One(at) => {
            let at = index(at);
            quote!(#[doc = #text] pub const #name: #core::handle::#kind = #core::handle::#kind(#at);)
        }
        Indices::Many(indices) => {
            let (count, indices) = (index(indices.len()), indices.iter().map(|at| index(*at)));
            quote! {
                #[doc = #text]
                pub const #name: [#core::handle::#kind; #count] = [#(#core::handle::#kind(#indices)),*];
            }
        }
    }
}

/// `impl X { … }`
pub(super) fn inherent(target: TokenStream, constants: &[TokenStream]) -> TokenStream {
    quote! {
        #[allow(dead_code, deprecated, non_upper_case_globals, clippy::all, clippy::pedantic)]
        impl #target {
            #(#constants)*
        }
    }
}

/// All named items, in the order of the description.
fn items(system: &System) -> Vec<Handle<'_>> {
    let print = |e| format!("`{}`", system.pool.print(e));
    let is = |e| format!(" = {}", print(e));
    let nothing = String::new;
    let mut items = Vec::new();
    let s = system;
    items.extend(of("CoordinateId", "Coordinate", &s.coordinates, |c| {
        (&c.name, nothing())
    }));
    items.extend(of("KineticId", "Kinetic energy", &s.kinetic, |k| {
        (&k.name, is(k.energy))
    }));
    items.extend(of("PotentialId", "Potential energy", &s.potential, |v| {
        (&v.name, is(v.energy))
    }));
    items.extend(of("ConstraintId", "Constraint", &s.constraints, |c| {
        (&c.name, format!(": `{} == 0`", s.pool.print(c.residual)))
    }));
    items.extend(of("ContactId", "Contact", &s.contacts, |c| {
        (&c.name, format!(": `{} >= 0`", s.pool.print(c.gap)))
    }));
    items.extend(of("FrictionId", "Friction", &s.frictions, |f| {
        let slip: Vec<String> = f.slip.iter().map(|&(slip, _)| print(slip)).collect();
        let on = match f.normal {
            Normal::Contact(c) => format!(" on contact `{}`", s.contacts[c].name.text),
            Normal::Constraint(c) => format!(" on constraint `{}`", s.constraints[c].name.text),
            Normal::Resultant(r) => {
                let names = s.resultants[r].iter();
                let names = names.map(|&c| format!("`{}`", s.constraints[c].name.text));
                format!(" on constraints {}", names.collect::<Vec<_>>().join(", "))
            }
            Normal::Given(_) => String::new(),
        };
        (&f.name, format!("{on}: slip {}", slip.join(", ")))
    }));
    items.extend(of("ForceId", "Force", &s.forces, |f| {
        (&f.name, is(f.value))
    }));
    items.extend(of("DissipationId", "Dissipation", &s.dissipations, |d| {
        (&d.name, is(d.rayleigh))
    }));
    items.extend(of("StartId", "Start", &s.starts, |start| {
        (&start.name, nothing())
    }));
    items.extend(of("StopId", "Stop", &s.stops, |stop| {
        (&stop.name, nothing())
    }));
    items.extend(of("MarkId", "Mark", &s.marks, |mark| {
        (&mark.name, nothing())
    }));
    items.extend(of(OUTPUT, "Output", &s.observes, |o| {
        (&o.name, is(o.value))
    }));
    items
}

/// Handles of a list: "Word `name`", and what `tell` says of each.
fn of<'a, T>(
    kind: &'static str,
    word: &str,
    list: &'a [T],
    tell: impl Fn(&'a T) -> (&'a ItemName, String),
) -> impl Iterator<Item = Handle<'a>> {
    list.iter().enumerate().map(move |(index, item)| {
        let (name, rest) = tell(item);
        let text = format!("{word} `{}`{rest}.", name.text);
        Handle {
            name,
            kind,
            index,
            text,
        }
    })
}
