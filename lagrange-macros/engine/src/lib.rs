//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod check;
pub mod derive;
pub mod diagnostics;
pub mod emit;
pub mod interpret;
pub mod model;
pub mod parse;
pub mod plan;
pub mod symbolic;

use ast::Declaration;
use check::Verdict;
use diagnostics::{Code, Diagnostics};
use plan::Program;
use proc_macro2::TokenStream;

/// What the derive macro expands to: the implementation, or the mistakes and an implementation without equations.
pub fn expand(input: TokenStream) -> TokenStream {
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input.clone(), &mut sink);
    match declaration
        .as_ref()
        .and_then(|declaration| planned(declaration, &mut sink))
    {
        Some((program, verdicts)) if sink.is_empty() => emit::emit(&program, &verdicts),
        _ => {
            let mut tokens = sink.into_compile_errors();
            tokens.extend(emit::fallback(input, declaration.as_ref()));
            tokens
        }
    }
}

/// The program of a struct with its `#[lagrange(…)]` attributes.
///
/// # Errors
/// All mistakes that the first stage with mistakes has found.
pub fn program(input: TokenStream) -> Result<Program, Diagnostics> {
    Ok(checked(input)?.0)
}

/// The program of a struct with its `#[lagrange(…)]` attributes, and what is known of its checks.
///
/// # Errors
/// All mistakes that the first stage with mistakes has found; a check that is false is one.
pub fn checked(input: TokenStream) -> Result<(Program, Vec<Verdict>), Diagnostics> {
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input, &mut sink);
    match declaration.and_then(|declaration| planned(&declaration, &mut sink)) {
        Some(found) if sink.is_empty() => Ok(found),
        _ => Err(sink),
    }
}

fn planned(declaration: &Declaration, sink: &mut Diagnostics) -> Option<(Program, Vec<Verdict>)> {
    let system = model::scoped(declaration, sink);
    let program = system.and_then(|(system, scope)| {
        let equations = derive::equations(system, sink)?;
        Some((plan::plan(equations), scope))
    });
    match program {
        Some((program, _)) if program.equations.system.pool.overflowed() => {
            sink.report(Code::Overflow, &declaration.name, &[]);
            None
        }
        Some((mut program, scope)) => {
            // What is planned does not change any more, so checks cannot change what is emitted.
            let (equations, verdicts) =
                check::verdicts(declaration, program.equations, scope, sink);
            program.equations = equations;
            Some((program, verdicts))
        }
        None => {
            if sink.is_empty() {
                sink.report(Code::Bug, &declaration.name, &[]);
            }
            None
        }
    }
}
