//! [`Program`] → tokens: the tapes, the table that says what their numbers mean, and the handles.
//! The only place that uses `quote`.

mod checks;
mod code;
mod declared;
mod derivation;
mod description;
mod equations;
mod fallback;
mod handles;
mod names;
mod scalar;
mod tape;
#[cfg(test)]
mod tests;

use crate::check::Verdict;
use crate::derive::Stage;
use crate::model::Declared;
use crate::plan::Program;
use proc_macro2::TokenStream;
use quote::quote;

pub use derivation::{derivation, on_request as derivation_on_request};
pub use fallback::fallback;

/// Whether the equations of motion are emitted as data.
pub fn is_large(program: &Program) -> bool {
    code::is_large(&program.motion)
}

/// `impl System` and the handles of a program; [`derivation()`] belongs to it.
pub fn emit(program: &Program, declared: &Declared, verdicts: &[Verdict]) -> TokenStream {
    let system = &program.equations.system;
    let (name, core) = (&system.name, &system.core);
    let (generics, arguments, scalar) = match &system.scalar {
        Some(scalar) => (
            quote!(<#scalar: #core::arithmetic::Scalar>),
            quote!(<#scalar>),
            quote!(#scalar),
        ),
        None => (quote!(), quote!(), quote!(f64)),
    };
    let inherent = match &system.scalar {
        Some(_) => quote!(#name::<f64>),
        None => quote!(#name),
    };
    let handles = handles::handles(program);
    let checks = checks::checks(program, verdicts);
    let description = description::description(program);
    let declaration = declared::declaration(declared, system);
    let access = scalar::access(system);
    let start = scalar::starts(program);
    let constants = scalar::constants(program);
    let motion = tape::tape(program, Stage::Motion);
    let report = tape::tape(program, Stage::Report);
    let equations = equations::equations(program);
    quote! {
        #handles
        #checks

        #[automatically_derived]
        #[allow(unused, clippy::all, clippy::pedantic, clippy::nursery)]
        impl #generics #core::system::System for #name #arguments {
            type Scalar = #scalar;
            const DESCRIPTION: &'static #core::system::Description = &#description;
            const DECLARATION: &'static #core::declaration::Declaration = &#declaration;
            fn derivation() -> &'static #core::Derivation {
                #inherent::derivation()
            }
            #access
            #start
            #constants
            #motion
            #report
            #equations
        }
    }
}
