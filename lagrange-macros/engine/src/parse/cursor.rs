//! A walk over tokens: operators of several characters, parts between commas, invisible groups.
//!
//! `macro_rules!` wraps what it substitutes in `Delimiter::None` groups. One that holds a single token, or a name
//! with its parentheses, is dissolved; any other is kept where it may hide an operator, and is then read like
//! parentheses.

use crate::ast::Name;
use crate::diagnostics::{Code, Diagnostics, Extent};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// Operators, longest first.
const OPERATORS: &[&str] = &[
    "..=", "**", "==", ">=", "<=", "!=", "&&", "||", "=>", "->", "::", "..", "+", "-", "*", "/",
    "^", "=", "<", ">", "!", "&", "|", "%", ".", ":", ",", ";", "?", "#", "@", "$", "~", "'",
];

/// How deep groups may nest: what recursion in the parser and later stages certainly survives.
pub(super) const DEEPEST: usize = 100;

/// Tokens and a position among them.
#[derive(Clone)]
pub(super) struct Cursor {
    tokens: Vec<TokenTree>,
    at: usize,
    /// What follows the last token.
    end: Extent,
    /// The same in words.
    end_word: &'static str,
    depth: usize,
}

/// What follows the last token of a group.
const END: &str = "the end";

impl Cursor {
    /// The tokens of a stream that `end` closes.
    pub fn new(stream: TokenStream, end: Extent, depth: usize) -> Cursor {
        Cursor {
            tokens: dissolved(stream),
            at: 0,
            end,
            end_word: END,
            depth,
        }
    }

    /// The inside of a group; too deep a nesting is reported.
    pub fn inside(&self, group: &Group, sink: &mut Diagnostics) -> Option<Cursor> {
        if self.depth >= DEEPEST {
            sink.report(Code::TooDeep, group.span_open(), &[]);
            return None;
        }
        Some(Cursor::new(
            group.stream(),
            group.span_close().into(),
            self.depth + 1,
        ))
    }

    /// Goes one level deeper without a group (`a^b^c`).
    pub fn deeper(&mut self, sink: &mut Diagnostics) -> Option<()> {
        if self.depth >= DEEPEST {
            sink.report(Code::TooDeep, self.here(), &[]);
            return None;
        }
        self.depth += 1;
        Some(())
    }

    /// Comes back from [`Self::deeper`].
    pub fn shallower(&mut self) {
        self.depth -= 1;
    }

    /// The tokens between commas. One trailing comma is free; other empty parts are reported.
    pub fn parts(self, expected: &str, sink: &mut Diagnostics) -> Vec<Cursor> {
        let Cursor {
            tokens,
            at,
            end,
            end_word,
            depth,
        } = self;
        let mut parts = Vec::new();
        let mut part = Vec::new();
        let mut close = |part: Vec<TokenTree>, end: Extent, end_word, sink: &mut Diagnostics| {
            let part = unwrapped(part);
            if part.is_empty() {
                sink.report(Code::EmptyPart, end, &[&expected]);
            } else {
                parts.push(Cursor {
                    tokens: part,
                    at: 0,
                    end,
                    end_word,
                    depth,
                });
            }
        };
        for token in tokens.into_iter().skip(at) {
            match &token {
                TokenTree::Punct(punct) if punct.as_char() == ',' => {
                    close(std::mem::take(&mut part), (&token).into(), "`,`", sink);
                }
                _ => part.push(token),
            }
        }
        if !part.is_empty() {
            close(part, end, end_word, sink);
        }
        parts
    }

    /// The current token.
    pub fn peek(&self) -> Option<&TokenTree> {
        self.tokens.get(self.at)
    }

    /// The token after the current one.
    pub fn second(&self) -> Option<&TokenTree> {
        self.tokens.get(self.at + 1)
    }

    /// Steps over the current token.
    pub fn next(&mut self) -> Option<TokenTree> {
        let token = self.peek().cloned();
        self.at += usize::from(token.is_some());
        token
    }

    /// Steps to the end.
    pub fn skip_all(&mut self) {
        self.at = self.tokens.len();
    }

    /// Whether nothing is left.
    pub fn is_at_end(&self) -> bool {
        self.at >= self.tokens.len()
    }

    /// The current token, or what follows the last one.
    pub fn here(&self) -> Extent {
        self.peek().map_or(self.end, Extent::from)
    }

    /// The last token that was stepped over.
    pub fn behind(&self) -> Extent {
        match self.at.checked_sub(1).and_then(|i| self.tokens.get(i)) {
            Some(token) => token.into(),
            None => self.here(),
        }
    }

    /// The current token for a message.
    pub fn found(&self) -> String {
        match self.peek() {
            None => self.end_word.into(),
            Some(TokenTree::Group(group)) => match group.delimiter() {
                Delimiter::Parenthesis => "`(`".into(),
                Delimiter::Bracket => "`[`".into(),
                Delimiter::Brace => "`{`".into(),
                Delimiter::None => "an expression".into(),
            },
            Some(TokenTree::Punct(_)) => format!("`{}`", self.operator().unwrap_or("?")),
            Some(token) => format!("`{token}`"),
        }
    }

    /// Reports that something else was expected here.
    pub fn expected(&self, what: &str, sink: &mut Diagnostics) {
        sink.report(Code::Expected, self.here(), &[&what, &self.found()]);
    }

    /// The operator that starts here.
    pub fn operator(&self) -> Option<&'static str> {
        let Some(TokenTree::Punct(_)) = self.tokens.get(self.at) else {
            return None;
        };
        let fits = |operator: &&&str| {
            let last = operator.len() - 1;
            operator
                .chars()
                .enumerate()
                .all(|(i, symbol)| match self.tokens.get(self.at + i) {
                    Some(TokenTree::Punct(punct)) => {
                        punct.as_char() == symbol
                            && (i == last || punct.spacing() == proc_macro2::Spacing::Joint)
                    }
                    _ => false,
                })
        };
        OPERATORS.iter().find(fits).copied()
    }

    /// Steps over this operator if it is here.
    pub fn take(&mut self, operator: &str) -> Option<Extent> {
        if self.operator() != Some(operator) {
            return None;
        }
        let start = self.here();
        self.at += operator.len();
        Some(Extent::new(start, self.behind()))
    }

    /// Steps over this operator, or reports that it is missing.
    pub fn require(&mut self, operator: &str, sink: &mut Diagnostics) -> Option<Extent> {
        let taken = self.take(operator);
        if taken.is_none() {
            self.expected(&format!("`{operator}`"), sink);
        }
        taken
    }

    /// The word here, without stepping.
    pub fn word(&self) -> Option<Name> {
        match self.peek() {
            Some(TokenTree::Ident(ident)) => Some(Name::new(ident)),
            _ => None,
        }
    }

    /// The word that was stepped over last.
    pub fn word_behind(&self) -> Option<Name> {
        match self.at.checked_sub(1).and_then(|i| self.tokens.get(i)) {
            Some(TokenTree::Ident(ident)) => Some(Name::new(ident)),
            _ => None,
        }
    }

    /// Whether a number was stepped over last.
    pub fn literal_behind(&self) -> bool {
        let behind = self.at.checked_sub(1).and_then(|i| self.tokens.get(i));
        matches!(behind, Some(TokenTree::Literal(_)))
    }

    /// Steps over this very word if it is here.
    pub fn take_word(&mut self, word: &str) -> Option<Name> {
        let name = self.word().filter(|name| name.text == word)?;
        self.at += 1;
        Some(name)
    }

    /// Steps over a name, or reports that one is missing.
    pub fn name(&mut self, what: &str, sink: &mut Diagnostics) -> Option<Name> {
        let name = self.word();
        match name {
            Some(_) => self.at += 1,
            None => self.expected(what, sink),
        }
        name
    }

    /// Steps over a group with this delimiter if it is here.
    pub fn take_group(&mut self, delimiter: Delimiter) -> Option<Group> {
        let group = self.group(delimiter)?;
        self.at += 1;
        Some(group)
    }

    /// The group with this delimiter here, without stepping.
    pub fn group(&self, delimiter: Delimiter) -> Option<Group> {
        match self.peek() {
            Some(TokenTree::Group(group)) if group.delimiter() == delimiter => Some(group.clone()),
            _ => None,
        }
    }

    /// Whether one of these operators occurs from here on, outside of groups.
    pub fn has_operator(&self, operators: &[&str]) -> bool {
        let mut probe = Cursor {
            tokens: self.tokens[self.at.min(self.tokens.len())..].to_vec(),
            at: 0,
            end: self.end,
            end_word: self.end_word,
            depth: self.depth,
        };
        while !probe.is_at_end() {
            if let Some(operator) = probe.operator() {
                if operators.contains(&operator) {
                    return true;
                }
                probe.at += operator.len();
            } else {
                probe.at += 1;
            }
        }
        false
    }

    /// Everything from here on.
    pub fn rest(&mut self) -> TokenStream {
        let rest = self.tokens.iter().skip(self.at).cloned().collect();
        self.skip_all();
        rest
    }
}

/// Tokens with those invisible groups dissolved that cannot hide an operator.
fn dissolved(stream: TokenStream) -> Vec<TokenTree> {
    let mut tokens = Vec::new();
    for token in stream {
        match &token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                let inside = dissolved(group.stream());
                match inside.as_slice() {
                    [_] | [TokenTree::Ident(_), TokenTree::Group(_)] => tokens.extend(inside),
                    _ => tokens.push(token),
                }
            }
            _ => tokens.push(token),
        }
    }
    tokens
}

/// A part that is nothing but an invisible group is its content.
fn unwrapped(mut tokens: Vec<TokenTree>) -> Vec<TokenTree> {
    while let [TokenTree::Group(group)] = tokens.as_slice() {
        if group.delimiter() != Delimiter::None {
            break;
        }
        tokens = dissolved(group.stream());
    }
    tokens
}
