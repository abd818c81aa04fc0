//! [`Program`] → tokens: the functions of the modes, the programs as data with the table that says what their numbers mean, and the
//! handles.
//! The only place that uses `quote`.

mod checks;
mod constants;
mod declared;
mod derivation;
mod description;
mod encoded;
mod equations;
mod exact;
mod export;
mod fallback;
mod handles;
mod listing;
mod names;
mod operation;
mod scalar;
#[cfg(test)]
mod tests;

use crate::check::Verdict;
use crate::model::Declared;
use crate::plan::Program;
use proc_macro2::TokenStream;
use quote::quote;

pub use constants::clashes;
pub use derivation::{derivation, on_request as derivation_on_request};
pub use export::{declared_struct, export};
pub use fallback::fallback;
pub use listing::listing;

/// Systems with more operations are not written out at every build.
const LARGEST: usize = 500;

/// Whether the equations would fill books.
pub fn is_large(program: &Program) -> bool {
    let blocks = program.motion.blocks.iter();
    blocks.map(|block| block.steps.len()).sum::<usize>() > LARGEST
}

/// The tables of a system, as literals of the types of the core.
pub struct Tables {
    /// `Description { … }`
    pub description: TokenStream,
    /// `Declaration { … }`
    pub declaration: TokenStream,
}

/// The tables of a program: what is read, of a system that is derived when a program starts, instead of compiled.
pub fn tables(program: &Program, declared: &Declared) -> Tables {
    Tables {
        description: description::description(program),
        declaration: declared::declaration(declared, &program.equations.system),
    }
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
    let Tables {
        description,
        declaration,
    } = tables(program, declared);
    let read_tables = names::read_tables(core);
    let access = scalar::access(system);
    let start = scalar::starts(program);
    let equations = equations::equations(program);
    quote! {
        #handles
        #checks

        #[automatically_derived]
        #[allow(unused, deprecated, clippy::all, clippy::pedantic, clippy::nursery)]
        impl #generics #core::system::System for #name #arguments {
            type Scalar = #scalar;
            fn copy(&self) -> Self {
                Self { ..*self }
            }
            #read_tables
            fn derivation(&self) -> &'static #core::Derivation {
                #inherent::derivation()
            }
            #access
            #start
            #equations
        }

        #[automatically_derived]
        #[allow(unused, deprecated, clippy::all, clippy::pedantic, clippy::nursery)]
        impl #generics #core::system::Derived for #name #arguments {
            const DESCRIPTION: &'static #core::system::Description = &#description;
            const DECLARATION: &'static #core::__private::declaration::Declaration = &#declaration;
        }
    }
}
