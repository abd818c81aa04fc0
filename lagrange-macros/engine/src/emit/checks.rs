//! What is known of the checks: `X::CHECKS`, with a line of documentation for each.

use super::handles::inherent;
use super::names::index;
use crate::check::{Outcome, Verdict};
use crate::plan::Program;
use proc_macro2::TokenStream;
use quote::quote;

/// `impl X { pub const CHECKS: … }`; nothing without checks.
pub fn checks(program: &Program, verdicts: &[Verdict]) -> TokenStream {
    let system = &program.equations.system;
    if verdicts.is_empty() {
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
