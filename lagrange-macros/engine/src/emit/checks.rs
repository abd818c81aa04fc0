//! What is known of the checks: `X::CHECKS`, with a line of documentation for each.

use super::handles::{inherent, screaming};
use super::names::index;
use crate::check::{Outcome, Verdict};
use crate::plan::Program;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// `impl X { pub const CHECKS: … }`; nothing without checks, or where an item has taken the name.
pub fn checks(program: &Program, verdicts: &[Verdict]) -> TokenStream {
    let system = &program.equations.system;
    let ours = Ident::new("CHECKS", Span::call_site());
    let coordinates = system.coordinates.iter().map(|c| &c.name);
    let contacts = system.contacts.iter().map(|c| &c.name);
    let constraints = system.constraints.iter().map(|c| &c.name);
    let frictions = system.frictions.iter().map(|f| &f.name);
    let forces = system.forces.iter().map(|f| &f.name);
    let others = system.observes.iter().map(|o| &o.name);
    let starts = system.starts.iter().map(|s| &s.name);
    let watches = system.stops.iter().chain(&system.marks).map(|w| &w.name);
    let mut names = coordinates
        .chain(contacts)
        .chain(constraints)
        .chain(frictions)
        .chain(forces)
        .chain(others)
        .chain(starts)
        .chain(watches);
    let is_ours = |ident: &Ident| screaming(ident) == ours;
    if verdicts.is_empty() || names.any(|name| name.ident.as_ref().is_some_and(is_ours)) {
        return TokenStream::new();
    }
    let (name, core) = (&system.name, &system.core);
    let arguments = system.scalar.as_ref().map(|_| quote!(<f64>));
    let mut lines = vec!["What is known of the checks of the declaration.".to_owned()];
    let mut elements = Vec::new();
    for Verdict {
        name,
        claim,
        outcome,
    } in verdicts
    {
        let (known, outcome) = match outcome {
            Outcome::Proven { modes } => {
                let (plural, count) = (if *modes == 1 { "" } else { "s" }, index(*modes));
                (
                    format!("proven in {modes} mode{plural}"),
                    quote!(Proven { modes: #count }),
                )
            }
            Outcome::Tested { states, because } => (
                format!("tested at {states} states, not proven: {because}"),
                quote!(Tested { states: #states, because: #because }),
            ),
        };
        lines.push(format!("* `{claim}`: {known}"));
        elements.push(quote! {
            #core::checks::Verdict {
                name: #name,
                claim: #claim,
                outcome: #core::checks::Outcome::#outcome,
            }
        });
    }
    let text = lines.join("\n");
    let constant = quote! {
        #[doc = #text]
        pub const CHECKS: &'static [#core::checks::Verdict] = &[#(#elements),*];
    };
    inherent(quote!(#name #arguments), &[constant])
}
