//! The names in attributes that may be wrong, as far as their tokens tell: that of a mistake has uses, and those are no mistakes.

use super::cursor::Cursor;
use super::words::KEYWORDS;
use crate::ast::Name;
use crate::diagnostics::{Diagnostics, nearest};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::{DeriveInput, Meta};

/// What a struct seems to declare.
#[derive(Default)]
pub struct Glimpse {
    /// The path of `crate = path`.
    pub core: Option<TokenStream>,
    /// In their order.
    pub names: Vec<Glimpsed>,
}

/// The name of an item.
pub struct Glimpsed {
    /// The word that begins an item of its kind.
    pub keyword: &'static str,
    /// As it is written.
    pub name: Name,
    /// Whether brackets follow.
    pub indexed: bool,
}

/// Looks at the attributes of a struct.
pub fn glimpse(input: &DeriveInput) -> Glimpse {
    let mut seen = Glimpse::default();
    for attribute in input.attrs.iter().filter(|a| a.path().is_ident("lagrange")) {
        if let Meta::List(list) = &attribute.meta {
            let end = list.delimiter.span().close();
            items(Cursor::new(list.tokens.clone(), end.into(), 0), &mut seen);
        }
    }
    seen
}

/// Every word with parentheses behind it that is a keyword or nearly one.
fn items(mut cursor: Cursor, seen: &mut Glimpse) {
    while !cursor.is_at_end() {
        let word = cursor.word();
        cursor.next();
        let Some(word) = word else {
            continue;
        };
        if word.text == "crate" && cursor.take("=").is_some() {
            let path = core::iter::from_fn(|| match cursor.peek() {
                Some(TokenTree::Punct(punct)) if punct.as_char() == ',' => None,
                _ => cursor.next(),
            });
            let path: TokenStream = path.collect();
            seen.core = syn::parse2::<syn::Path>(path.clone()).ok().map(|_| path);
        } else if let Some(group) = cursor.take_group(Delimiter::Parenthesis)
            && let Some(keyword) = nearest(&word.text, KEYWORDS.iter().copied())
            && let Some(inside) = cursor.inside(&group, &mut Diagnostics::new())
        {
            names(keyword, inside, &mut seen.names);
        }
    }
}

/// The names of an item.
fn names(keyword: &'static str, inside: Cursor, seen: &mut Vec<Glimpsed>) {
    let mut parts = inside.parts("", &mut Diagnostics::new());
    match keyword {
        "define" | "check" | "draw" => {}
        "coordinates" => {
            for part in &mut parts {
                while !part.is_at_end() {
                    if let Some(name) = name(keyword, part) {
                        seen.push(name);
                    } else {
                        part.next();
                    }
                }
            }
        }
        "observe" => seen.extend(parts.iter_mut().filter_map(|part| name(keyword, part))),
        "attitude" => {
            if let Some(part) = parts.first_mut() {
                seen.extend(name("constraint", part));
                part.take(":");
                let coordinates = name("coordinates", part);
                seen.extend(coordinates.map(|name| Glimpsed {
                    indexed: true,
                    ..name
                }));
            }
        }
        _ => {
            let named = parts.first_mut().and_then(|part| {
                let name = name(keyword, part)?;
                (part.operator() == Some(":") || part.word().is_some()).then_some(name)
            });
            seen.extend(named);
        }
    }
}

/// The name here, and whether brackets follow.
fn name(keyword: &'static str, part: &mut Cursor) -> Option<Glimpsed> {
    let name = part.word()?;
    part.next();
    Some(Glimpsed {
        keyword,
        name,
        indexed: part.take_group(Delimiter::Bracket).is_some(),
    })
}
