//! `#[derive(Lagrangian)]`: the entry point. Everything it does is in `lagrange-engine`.
//!
//! # Mistakes
//!
#![doc = include_str!("mistakes.md")]

mod dump;

use proc_macro::TokenStream;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Derives the equations of a mechanical system from its Lagrangian, constraints, contacts and frictions.
///
/// # The language
///
#[doc = include_str!("language.md")]
///
/// How systems are written with it, example by example, is the chapter [language](../lagrange_core/book/language/index.html) of the
/// book.
///
/// # What is emitted
///
/// With the environment variable `LAGRANGE_DUMP=Name` the expansion for the struct `Name` is written, formatted, to a
/// file of the temporary folder, and the compiler's output says where. Where it says nothing, no struct of that name was expanded: it is written
/// otherwise, or was compiled before, since cargo expands only what it compiles (`touch` the file). The macro sees one struct at a time and
/// cannot know that there is none.
#[proc_macro_derive(Lagrangian, attributes(lagrange))]
pub fn lagrangian(input: TokenStream) -> TokenStream {
    let input = input.into();
    let expand = || {
        dump::dump(&input);
        lagrange_engine::expand(proc_macro2::TokenStream::clone(&input)).into()
    };
    catch_unwind(AssertUnwindSafe(expand)).unwrap_or_else(|panic| bug(&*panic))
}

/// A panic is a mistake of this crate, never the user's.
fn bug(panic: &(dyn std::any::Any + Send)) -> TokenStream {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message");
    let message = format!("bug in lagrange-macros: {text}; please report it with this struct");
    format!("::core::compile_error!({message:?});")
        .parse()
        .unwrap_or_default()
}
