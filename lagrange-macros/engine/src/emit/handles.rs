//! Handles: one associated constant for each named item, `MassOnWheel::RIM`, with its equation as documentation.

use crate::model::{ItemName, Normal, System, shouting};
use crate::plan::Program;
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

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
    let mut taken = BTreeSet::new();
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
        // An output may observe a coordinate or an item under its own name.
        if taken.insert(constant.to_string()) || first.kind != "ObserveId" {
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
        #[automatically_derived]
        #[allow(dead_code, non_upper_case_globals, clippy::all, clippy::pedantic)]
        impl #target {
            #(#constants)*
        }
    }
}

/// All named items, in the order of the description.
fn items(system: &System) -> Vec<Handle<'_>> {
    let mut items = Vec::new();
    let pool = &system.pool;
    let mut add = |kind, index, name, text| {
        items.push(Handle {
            name,
            kind,
            index,
            text,
        })
    };
    for (i, coordinate) in system.coordinates.iter().enumerate() {
        add(
            "CoordinateId",
            i,
            &coordinate.name,
            format!("Coordinate `{}`.", coordinate.name.text),
        );
    }
    for (i, term) in system.kinetic.iter().enumerate() {
        let text = format!(
            "Kinetic energy `{}` = `{}`.",
            term.name.text,
            pool.print(term.energy)
        );
        add("KineticId", i, &term.name, text);
    }
    for (i, term) in system.potential.iter().enumerate() {
        let text = format!(
            "Potential energy `{}` = `{}`.",
            term.name.text,
            pool.print(term.energy)
        );
        add("PotentialId", i, &term.name, text);
    }
    for (i, constraint) in system.constraints.iter().enumerate() {
        let text = format!(
            "Constraint `{}`: `{} == 0`.",
            constraint.name.text,
            pool.print(constraint.residual)
        );
        add("ConstraintId", i, &constraint.name, text);
    }
    for (i, contact) in system.contacts.iter().enumerate() {
        let text = format!(
            "Contact `{}`: `{} >= 0`.",
            contact.name.text,
            pool.print(contact.gap)
        );
        add("ContactId", i, &contact.name, text);
    }
    for (i, friction) in system.frictions.iter().enumerate() {
        let slip: Vec<String> = friction
            .slip
            .iter()
            .map(|(slip, _)| format!("`{}`", pool.print(*slip)))
            .collect();
        let on = match friction.normal {
            Normal::Contact(contact) => {
                format!(" on contact `{}`", system.contacts[contact].name.text)
            }
            Normal::Constraint(constraint) => format!(
                " on constraint `{}`",
                system.constraints[constraint].name.text
            ),
            Normal::Given(_) => String::new(),
        };
        let text = format!(
            "Friction `{}`{on}: slip {}.",
            friction.name.text,
            slip.join(", ")
        );
        add("FrictionId", i, &friction.name, text);
    }
    for (i, force) in system.forces.iter().enumerate() {
        let text = format!(
            "Force `{}` = `{}`.",
            force.name.text,
            pool.print(force.value)
        );
        add("ForceId", i, &force.name, text);
    }
    for (i, item) in system.dissipations.iter().enumerate() {
        let text = format!(
            "Dissipation `{}` = `{}`.",
            item.name.text,
            pool.print(item.rayleigh)
        );
        add("DissipationId", i, &item.name, text);
    }
    for (i, start) in system.starts.iter().enumerate() {
        add(
            "StartId",
            i,
            &start.name,
            format!("Start `{}`.", start.name.text),
        );
    }
    for (i, stop) in system.stops.iter().enumerate() {
        add(
            "StopId",
            i,
            &stop.name,
            format!("Stop `{}`.", stop.name.text),
        );
    }
    for (i, mark) in system.marks.iter().enumerate() {
        add(
            "MarkId",
            i,
            &mark.name,
            format!("Mark `{}`.", mark.name.text),
        );
    }
    for (i, observe) in system.observes.iter().enumerate() {
        let text = format!(
            "Output `{}` = `{}`.",
            observe.name.text,
            pool.print(observe.value)
        );
        add("ObserveId", i, &observe.name, text);
    }
    items
}

/// `muStatic` and `mu_static` → `MU_STATIC`; `r#static` → `STATIC`.
pub(super) fn screaming(ident: &Ident) -> Ident {
    let text = ident.to_string();
    let name = shouting(text.strip_prefix("r#").unwrap_or(&text));
    Ident::new(&name, ident.span())
}
