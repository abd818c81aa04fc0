//! Symbolic mechanics: tokens of a declaration → equations → tokens of Rust.

pub mod ast;
pub mod check;
pub mod derive;
pub mod diagnostics;
pub mod emit;
pub mod inspect;
pub mod interpret;
pub mod model;
pub mod modes;
pub mod parse;
pub mod plan;
pub mod sorted;
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
    let program = declaration
        .as_ref()
        .and_then(|declaration| of_struct(declaration, &mut sink));
    match (&declaration, program) {
        (Some(declaration), Some((mut program, verdicts))) if sink.is_empty() => {
            let declared = model::declared(declaration);
            let mut tokens = emit::emit(&program, &declared, &verdicts);
            if emit::is_large(&program) {
                let system = &program.equations.system;
                tokens.extend(emit::derivation_on_request(system, &input.to_string()));
            } else if let Ok(derivation) =
                inspect::derivation(declaration, &mut program, &verdicts, None)
            {
                let system = &program.equations.system;
                tokens.extend(emit::derivation(system, &derivation, &input.to_string()));
            }
            tokens
        }
        _ => {
            let mut tokens = sink.into_compile_errors();
            tokens.extend(emit::fallback(input));
            tokens
        }
    }
}

/// What the derive macro expands to as formatted Rust; what of it is data follows in words.
pub fn readable(input: TokenStream) -> String {
    let expansion = expand(input.clone());
    let mut text = match syn::parse2::<syn::File>(expansion.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        Err(_) => expansion.to_string(),
    };
    if let Ok(program) = program(input) {
        text.push_str(&emit::listing(&program));
    }
    text
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
    match declaration.and_then(|declaration| of_struct(&declaration, &mut sink)) {
        Some(found) if sink.is_empty() => Ok(found),
        _ => Err(sink),
    }
}

/// A system that is declared in a file, derived.
pub struct FromFile {
    /// The named starts, for [`interpret::start`].
    pub starts: Vec<plan::Start>,
    /// The tables of the core.
    pub tables: emit::Tables,
    /// Values of the parameters, in the order of the description.
    pub defaults: Vec<f64>,
    /// Time at which a run ends if the file says so, s.
    pub until: Option<f64>,
    /// Parameters, coordinates and items by name, each with its line and column, from 1.
    pub places: Vec<(String, usize, usize)>,
    /// Remarks on what is not wrong, each with its line and column.
    pub hints: Vec<(String, usize, usize)>,
    /// The struct with its `#[lagrange(…)]` that declares the same; [`inspect()`] and [`readable`] read it.
    pub declaration: String,
    /// A Rust file with that struct, its derive and its default values; none where names would become one constant there.
    pub rust: Result<String, Diagnostics>,
}

/// Derives the system that a text declares; `name` is that of the system, an identifier.
///
/// # Errors
/// All mistakes that the first stage with mistakes has found, at their lines and columns of the text.
pub fn file(text: &str, name: &str) -> Result<FromFile, Diagnostics> {
    let mut sink = Diagnostics::new();
    match from_file(text, name, &mut sink) {
        Some(found) if sink.is_empty() => Ok(found),
        _ => Err(sink),
    }
}

/// The value of an expression without names, as `2*pi`.
///
/// # Errors
/// It is no expression, has names, or has no value.
pub fn number(text: &str) -> Result<f64, Diagnostics> {
    let mut sink = Diagnostics::new();
    let value = parse::lone_expression(text, &mut sink);
    let value = value.and_then(|value| model::number(&Declaration::nothing(), &value, &mut sink));
    match value {
        Some(value) if sink.is_empty() => Ok(value),
        _ => Err(sink),
    }
}

fn from_file(text: &str, name: &str, sink: &mut Diagnostics) -> Option<FromFile> {
    let file = parse::file(text, name, sink)?;
    let (program, _) = planned(&file.declaration, sink)?;
    let defaults = model::defaults(&file.declaration, &file.defaults, sink)?;
    let until = file.until.as_ref();
    let until = until.and_then(|until| {
        let seconds = model::number(&file.declaration, until, sink)?;
        if seconds <= 0.0 {
            let found = format!("`{until}`");
            let wanted = "a time after the start, which is at 0, as in `until = 5`";
            sink.report(Code::Expected, until.extent, &[&wanted, &found]);
        }
        Some(seconds)
    });
    let mut clashes = Diagnostics::new();
    emit::clashes(&file.declaration, &mut clashes);
    let hints = program.equations.system.hints.iter().map(|hint| {
        let (line, column) = hint.extent.place();
        (hint.text.clone(), line, column)
    });
    Some(FromFile {
        hints: hints.collect(),
        tables: emit::tables(&program, &model::declared(&file.declaration)),
        declaration: emit::declared_struct(&file, text),
        rust: match clashes.is_empty() {
            true => Ok(emit::export(&file, text, &defaults)),
            false => Err(clashes),
        },
        places: file.declaration.places(),
        starts: program.starts,
        defaults,
        until,
    })
}

/// The program of a struct, whose names become constants.
fn of_struct(declaration: &Declaration, sink: &mut Diagnostics) -> Option<(Program, Vec<Verdict>)> {
    emit::clashes(declaration, sink);
    planned(declaration, sink)
}

fn planned(declaration: &Declaration, sink: &mut Diagnostics) -> Option<(Program, Vec<Verdict>)> {
    let system = model::scoped(declaration, sink);
    if system
        .as_ref()
        .is_some_and(|(system, _)| system.pool.is_full())
    {
        return too_large(declaration, sink);
    }
    let equations = system.and_then(|(system, scope)| {
        let equations = derive::equations(system, sink)?;
        Some((equations, scope))
    });
    if equations
        .as_ref()
        .is_some_and(|(equations, _)| equations.system.pool.is_full())
    {
        return too_large(declaration, sink);
    }
    match equations.map(|(equations, scope)| (plan::plan(equations), scope)) {
        Some((mut program, scope)) => {
            if let Some(outgrown) = program.equations.system.pool.outgrown() {
                let what = outgrown.of(&"the equations");
                sink.report(Code::Overflow, &declaration.name, &[&what]);
                return None;
            }
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

fn too_large<T>(declaration: &Declaration, sink: &mut Diagnostics) -> Option<T> {
    let most = symbolic::MOST_OPERANDS;
    sink.report(
        Code::TooLarge,
        &declaration.name,
        &[&declaration.name, &most],
    );
    None
}

/// What is derived from a struct with its `#[lagrange(…)]` attributes, to be read: in one mode, or in all.
///
/// # Errors
/// The declaration has mistakes, or there is no such mode.
pub fn inspect(input: TokenStream, mode: Option<&str>) -> Result<inspect::Derivation, Refusal> {
    inspect_without(input, &[], mode)
}

/// The same where the items of these names are left out.
///
/// # Errors
/// As [`inspect()`]; something that stays speaks of what is left out.
pub fn inspect_without(
    input: TokenStream,
    left_out: &[&str],
    mode: Option<&str>,
) -> Result<inspect::Derivation, Refusal> {
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input, &mut sink);
    let planned = declaration.and_then(|mut declaration| {
        declaration.leave_out(left_out);
        let (program, verdicts) = planned(&declaration, &mut sink)?;
        Some((declaration, program, verdicts))
    });
    match planned {
        Some((declaration, mut program, verdicts)) if sink.is_empty() => {
            let derivation = inspect::derivation(&declaration, &mut program, &verdicts, mode);
            derivation.map_err(Refusal::Mode)
        }
        _ => Err(Refusal::Declaration(sink)),
    }
}

/// What the letters of a struct with its `#[lagrange(…)]` attributes mean; nothing is derived.
///
/// # Errors
/// All mistakes that the first stage with mistakes has found.
pub fn meanings(input: TokenStream) -> Result<Vec<inspect::Meaning>, Diagnostics> {
    let mut sink = Diagnostics::new();
    let declaration = parse::declaration(input, &mut sink);
    let meanings = declaration.and_then(|declaration| {
        let system = model::system(&declaration, &mut sink)?;
        Some(inspect::meanings(&declaration, &system))
    });
    meanings.ok_or(sink)
}

/// Why there is nothing to inspect.
#[derive(Debug)]
pub enum Refusal {
    /// Mistakes in the declaration.
    Declaration(Diagnostics),
    /// No such mode.
    Mode(inspect::UnknownMode),
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Refusal::Declaration(mistakes) => mistakes.fmt(f),
            Refusal::Mode(unknown) => unknown.fmt(f),
        }
    }
}

impl std::error::Error for Refusal {}
