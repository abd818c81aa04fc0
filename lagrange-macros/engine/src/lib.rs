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

use ast::Declaration;
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
        Some(program) if sink.is_empty() => emit::emit(&program),
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
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input, &mut sink);
    match declaration.and_then(|declaration| planned(&declaration, &mut sink)) {
        Some(program) if sink.is_empty() => Ok(program),
        _ => Err(sink),
    }
}

fn planned(declaration: &Declaration, sink: &mut Diagnostics) -> Option<Program> {
    let system = model::system(declaration, sink);
    if system.as_ref().is_some_and(|system| system.pool.is_full()) {
        return too_large(declaration, sink);
    }
    let equations = system.and_then(|system| derive::equations(system, sink));
    if equations
        .as_ref()
        .is_some_and(|equations| equations.system.pool.is_full())
    {
        return too_large(declaration, sink);
    }
    let program = equations.map(plan::plan);
    match &program {
        Some(program) if program.equations.system.pool.overflowed() => {
            sink.report(Code::Overflow, &declaration.name, &[]);
        }
        None if sink.is_empty() => sink.report(Code::Bug, &declaration.name, &[]),
        _ => {}
    }
    program
}

fn too_large(declaration: &Declaration, sink: &mut Diagnostics) -> Option<Program> {
    let most = symbolic::MOST_OPERANDS;
    sink.report(
        Code::TooLarge,
        &declaration.name,
        &[&declaration.name, &most],
    );
    None
}
