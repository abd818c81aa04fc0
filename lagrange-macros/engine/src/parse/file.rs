//! A declaration in a text file: the items of `#[lagrange(…)]` with commas between them, and what stands for the struct.
//!
//! ```text
//! //! A mass on a spring.
//! parameters(mass: "kg" = 1, stiffness: "N/m" = 40),
//! coordinates(x: "m"),
//! kinetic = mass/2 * der(x)^2,
//! potential = stiffness/2 * x^2,
//! ```

use super::cursor::{Cursor, DEEPEST};
use super::expression;
use super::item::{self, Items, Parameters, attributes};
use super::leftover::leftover;
use super::structure;
use super::words::{DEGREES, SINGLE_QUOTES};
use crate::ast::{Declaration, Expr, Field, Home};
use crate::diagnostics::{Code, Diagnostics, Extent};
use core::ops::Range;
use proc_macro2::{Ident, LexError, Span, TokenStream, TokenTree};

/// Most bytes of a file.
const LARGEST: usize = 1 << 20;

/// A file as it was read.
pub struct File {
    /// What it declares; the parameters are its fields.
    pub declaration: Declaration,
    /// Values of the parameters, one expression for each field.
    pub defaults: Vec<Expr>,
    /// Time at which a run ends, s.
    pub until: Option<Expr>,
    /// Where in the text the items of the struct's attribute are, in bytes, with their commas and comments.
    pub items: Vec<Range<usize>>,
}

/// Reads the text of a file; `name` is that of the system. Mistakes go to the sink.
pub fn file(text: &str, name: &str, sink: &mut Diagnostics) -> Option<File> {
    let before = sink.count();
    if text.len() > LARGEST {
        sink.report(Code::FileSize, Span::call_site(), &[&LARGEST]);
        return None;
    }
    let tokens = tokens(text, sink)?;
    shallow(&tokens, sink)?;
    let begin = tokens.clone().into_iter().next();
    let begin = begin.map_or(Span::call_site(), |token| token.span());
    let end = tokens.clone().into_iter().last();
    let end = end.map_or(begin, |token| token.span());
    let mut cursor = Cursor::new(tokens, end.into(), 0);
    let head = attributes(&mut cursor, sink)?;
    let mut read = Items {
        parameters: Some(Parameters::default()),
        ..Items::default()
    };
    let mut items = Vec::new();
    if cursor.is_at_end() {
        sink.report(
            Code::Expected,
            begin,
            &[&"items, as `coordinates(x)` and `kinetic = …`", &"none"],
        );
    }
    let mut from = match head.is_empty() {
        true => 0,
        false => behind(text, cursor.behind()),
    };
    for mut part in cursor.parts("an item, as `coordinates(x)`", sink) {
        let before = read.items.len();
        item::items(&mut part, &mut read, sink);
        part.skip_all();
        let to = behind(text, part.here());
        if read.items.len() > before {
            items.push(from..to);
        }
        from = to;
    }
    let Parameters { fields, until } = read.parameters.unwrap_or_default();
    let (fields, defaults): (Vec<Field>, Vec<Expr>) = fields.into_iter().unzip();
    let file = File {
        declaration: Declaration {
            name: Ident::new(name, begin),
            documentation: structure::documentation(&head),
            scalar: None,
            fields,
            items: read.items,
            core: read.core,
            home: Home::File,
        },
        defaults,
        until,
        items,
    };
    (sink.count() == before).then_some(file)
}

/// Reads a text that is an expression alone. Mistakes go to the sink.
pub fn lone_expression(text: &str, sink: &mut Diagnostics) -> Option<Expr> {
    let tokens = tokens(text, sink)?;
    shallow(&tokens, sink)?;
    let mut cursor = Cursor::new(tokens, Span::call_site().into(), 0);
    let value = expression::expression(&mut cursor, sink)?;
    if let Some(comma) = cursor.take(",") {
        let hint = "decimals are written with a point: `1.5`";
        sink.report(Code::Operator, comma, &[&",", &hint]);
        return None;
    }
    leftover(&mut cursor, sink)?;
    Some(value)
}

/// The tokens of the text, if it is made of tokens.
fn tokens(text: &str, sink: &mut Diagnostics) -> Option<TokenStream> {
    let error = match text.parse() {
        Ok(tokens) => return Some(tokens),
        Err(error) => error,
    };
    let at = |error: &LexError| {
        let begin = error.span().byte_range().start;
        text.split_at_checked(begin).unwrap_or_default()
    };
    let error = match at(&error).1.starts_with('"') {
        true => unclosed(text).unwrap_or(error),
        false => error,
    };
    let (before, rest) = at(&error);
    let hint = match rest.starts_with('\'') && is_quoted(before) {
        true => SINGLE_QUOTES.to_owned(),
        false => unreadable(rest),
    };
    sink.report(Code::Unreadable, error.span(), &[&hint]);
    None
}

/// The error at the first quotation mark that is not closed: the line ends, or a comma or `=` follows, which no unit has. Where marks are
/// read in pairs, it is the last one that is left over.
fn unclosed(text: &str) -> Option<LexError> {
    let (mut open, mut in_remark) = (None, false);
    for (at, sign) in text.char_indices() {
        match (sign, open) {
            ('\n', None) => in_remark = false,
            _ if in_remark => {}
            ('/', None) => in_remark = text[at..].starts_with("//"),
            ('"', None) => open = Some(at),
            ('"', Some(_)) => open = None,
            ('\n' | ',' | '=', Some(from)) if sign == '\n' || begins_unit(&text[..from]) => {
                return text[..=from].parse::<TokenStream>().err();
            }
            _ => {}
        }
    }
    None
}

/// Whether a unit stands behind this text.
fn begins_unit(text: &str) -> bool {
    text.trim_end().ends_with(':')
}

/// Whether a `'` behind this text is one of the two around a unit.
fn is_quoted(before: &str) -> bool {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let opened = line.rsplit_once('\'');
    begins_unit(line) || opened.is_some_and(|(text, _)| begins_unit(text))
}

/// What to do about a text that begins with what cannot be read.
fn unreadable(rest: &str) -> String {
    // A number that ends before a sign with which none does cannot be read from its beginning.
    let number = rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || "._".contains(c));
    let rest = match rest.starts_with(|c: char| c.is_ascii_digit()) {
        true => number,
        false => rest,
    };
    let Some(first) = rest.chars().next() else {
        return "a bracket, a quotation mark or a comment is not closed".to_owned();
    };
    let advice = match first {
        '(' | '[' | '{' => return format!("`{first}` is not closed"),
        ')' | ']' | '}' => return format!("no bracket is open that `{first}` could close"),
        '"' => return "the quotation mark is not closed".to_owned(),
        '/' => return "the remark is not closed: `/*` ends with `*/`".to_owned(),
        '\'' => "the velocity of `x` is written `der(x)`",
        '²' | '³' | '⁴' => "a power is written `x^2`",
        '×' | '∙' | '⋅' | '·' => "a product is written `a*b`",
        '\\' => "a letter is written by its name alone: `theta`",
        '÷' => "a quotient is written `a/b`",
        '−' | '–' | '—' => "a minus is the sign of the keyboard: `-`",
        '√' => "a root is written `sqrt(x)`",
        '½' | '¼' | '¾' | '⅓' | '⅔' => "a fraction is written `1/2`",
        '≥' => "write `>=`",
        '≤' => "write `<=`",
        '°' => DEGREES,
        '“' | '”' | '„' | '‘' | '’' => {
            "units stand in straight quotation marks: `\"kg\"`"
        }
        // Characters that cannot be seen are told by their numbers.
        _ => return format!("`{}` is no character of the language", first.escape_debug()),
    };
    format!("`{first}` is no character of the language; {advice}")
}

/// Where in the text the line ends whose last token this is; the end of the token if others follow it there.
fn behind(text: &str, token: Extent) -> usize {
    let end = token.end.byte_range().end;
    let rest = text.get(end..).unwrap_or_default();
    let line = rest.split('\n').next().unwrap_or_default();
    match line.trim_start() {
        "" => end + line.len(),
        comment if comment.starts_with("//") => end + line.len(),
        _ => end,
    }
}

/// Whether groups nest no deeper than is read; looked at without recursion, since a file may nest them as deep as it likes.
fn shallow(tokens: &TokenStream, sink: &mut Diagnostics) -> Option<()> {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(innermost) = open.last_mut() {
        match innermost.next() {
            Some(TokenTree::Group(group)) if open.len() > DEEPEST => {
                sink.report(Code::TooDeep, group.span_open(), &[]);
                return None;
            }
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(_) => {}
            None => {
                open.pop();
            }
        }
    }
    Some(())
}
