//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod derive;
pub mod diagnostics;
pub mod emit;
pub mod inspect;
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
    let equations = system.and_then(|system| derive::equations(system, sink));
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

/// What is derived from a struct with its `#[lagrange(…)]` attributes, to be read: in one mode, or in all.
///
/// # Errors
/// The mistakes of the declaration, or that there is no such mode; in words.
pub fn inspect(input: TokenStream, mode: Option<&str>) -> Result<inspect::Derivation, String> {
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input, &mut sink);
    let planned = declaration.and_then(|declaration| {
        let program = planned(&declaration, &mut sink)?;
        Some((declaration, program))
    });
    match planned {
        Some((declaration, mut program)) if sink.is_empty() => {
            inspect::derivation(&declaration, &mut program, mode).map_err(|e| e.to_string())
        }
        _ => Err(sink.to_string()),
    }
}
