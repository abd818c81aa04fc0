//! `LAGRANGE_DUMP=Name`: one expansion as a formatted file. What the macro returns does not depend on it.

use proc_macro2::{TokenStream, TokenTree};
use std::path::PathBuf;

/// Writes the expansion to a file if its struct is asked for, and says where.
pub fn dump(input: &TokenStream) {
    let Ok(wanted) = std::env::var("LAGRANGE_DUMP") else {
        return;
    };
    if struct_name(input).as_deref() != Some(wanted.trim()) {
        return;
    }
    let path: PathBuf = std::env::temp_dir().join(format!("lagrange-{}.rs", wanted.trim()));
    match std::fs::write(&path, lagrange_engine::readable(input.clone())) {
        Ok(()) => eprintln!(
            "lagrange: the expansion of {wanted} is in {}",
            path.display()
        ),
        Err(error) => eprintln!("lagrange: cannot write {}: {error}", path.display()),
    }
}

/// The name after `struct`.
fn struct_name(input: &TokenStream) -> Option<String> {
    let mut tokens = input.clone().into_iter();
    tokens.find(|token| matches!(token, TokenTree::Ident(ident) if ident == "struct"))?;
    match tokens.next() {
        Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
        _ => None,
    }
}
