//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod derive;
pub mod diagnostics;
pub mod emit;
pub mod interpret;
pub mod model;
pub mod parse;
pub mod plan;
pub mod symbolic;

use diagnostics::Diagnostics;
use plan::Program;
use proc_macro2::TokenStream;

/// The program of a struct with its `#[lagrange(…)]` attributes.
///
/// # Errors
/// All mistakes that the first stage with mistakes has found.
pub fn program(input: TokenStream) -> Result<Program, Diagnostics> {
    let mut sink = Diagnostics::new();
    let program = stages(input, &mut sink);
    match program {
        Some(program) if sink.is_empty() => Ok(program),
        _ => Err(sink),
    }
}

fn stages(input: TokenStream, sink: &mut Diagnostics) -> Option<Program> {
    let declaration = parse::declaration(input, sink)?;
    let system = model::system(&declaration, sink)?;
    let equations = derive::equations(system, sink)?;
    Some(plan::plan(equations))
}

/// What the derive macro expands to: the implementation, or the mistakes and an implementation without equations.
pub fn expand(input: TokenStream) -> TokenStream {
    match program(input.clone()) {
        Ok(program) => emit::emit(&program),
        Err(mistakes) => {
            let mut tokens = mistakes.into_compile_errors();
            tokens.extend(emit::fallback(input));
            tokens
        }
    }
}
