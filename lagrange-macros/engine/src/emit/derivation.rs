//! What was derived, as strings: `MassOnWheel::derivation()`, and the equations in the documentation.

use crate::inspect::{Derivation, print};
use crate::model::System;
use proc_macro2::TokenStream;
use quote::quote;

/// `impl X { pub fn derivation() … }`, with the equations of motion as MathML in its documentation.
///
/// The strings are in a function that is not generic, so that a program that never asks for them does not contain them.
pub fn derivation(system: &System, derivation: &Derivation, declaration: &str) -> TokenStream {
    let (name, core) = (&system.name, &system.core);
    let arguments = system.scalar.as_ref().map(|_| quote!(<f64>));
    let title = name.to_string();
    let text = print::plain(derivation);
    let latex = print::paper(derivation);
    let equations = print::equations(derivation);
    let graph = match derivation.modes.len() {
        0 | 1 => String::new(),
        _ => print::mermaid(derivation),
    };
    let mut on_page = format!("Equations of motion, as derived:\n\n{equations}");
    for hint in &derivation.hints {
        on_page.push_str(&format!("\n\nHint: {hint}"));
    }
    let hover = format!(
        "What was derived: equations of motion, rows, modes, impacts, conserved quantities.\n\n```text\n{}```",
        print::brief(derivation)
    );
    quote! {
        #[doc = #on_page]
        #[allow(dead_code, deprecated, clippy::all, clippy::pedantic)]
        impl #name #arguments {
            #[doc = #hover]
            pub fn derivation() -> &'static #core::Derivation {
                &#core::Derivation {
                    name: #title,
                    declaration: #declaration,
                    text: #text,
                    latex: #latex,
                    equations: #equations,
                    graph: #graph,
                }
            }
        }
    }
}

/// The same for a large system, whose equations would fill books: what is said of it says where to ask.
pub fn on_request(system: &System, declaration: &str) -> TokenStream {
    let (name, core) = (&system.name, &system.core);
    let arguments = system.scalar.as_ref().map(|_| quote!(<f64>));
    let title = name.to_string();
    let text = format!(
        "{title} has {} coordinates: its equations are not written out at every build. \
         `lagrange inspect` and `lagrange_engine::inspect` make them of the declaration.\n",
        system.coordinates.len()
    );
    quote! {
        #[allow(dead_code, deprecated)]
        impl #name #arguments {
            #[doc = #text]
            pub fn derivation() -> &'static #core::Derivation {
                &#core::Derivation {
                    name: #title,
                    declaration: #declaration,
                    text: #text,
                    ..#core::Derivation::NONE
                }
            }
        }
    }
}

/// The same where nothing was derived.
pub fn nothing(target: TokenStream, core: &TokenStream) -> TokenStream {
    quote! {
        #[allow(dead_code, deprecated)]
        impl #target {
            #[doc = "Not derived."]
            pub fn derivation() -> &'static #core::Derivation {
                &#core::Derivation::NONE
            }
        }
    }
}
