//! What is wrong with a declaration: a collector that all stages write to, so that the errors of a stage are
//! reported together, each at its token.
//!
//! Messages live in one [table](table.rs); a stage names a [`Code`] and what goes into its blanks.
//! In a compiler run the collector becomes one `compile_error!` per mistake; in process it prints
//! `line:column code message; hint`.

mod nearest;
mod table;
#[cfg(test)]
pub(crate) mod tests;

use core::fmt::{self, Display};
use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

pub use nearest::nearest;
pub use table::Code;

/// From the first to the last token of something the user wrote.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// First token.
    pub start: Span,
    /// Last token.
    pub end: Span,
}

impl Extent {
    /// From the start of `first` to the end of `last`.
    pub fn new(first: impl Into<Extent>, last: impl Into<Extent>) -> Extent {
        Extent {
            start: first.into().start,
            end: last.into().end,
        }
    }

    /// Line and column of its beginning, both counted from 1.
    pub fn place(&self) -> (usize, usize) {
        let start = self.start.start();
        (start.line, start.column + 1)
    }
}

impl From<Span> for Extent {
    fn from(span: Span) -> Extent {
        Extent {
            start: span,
            end: span,
        }
    }
}

impl From<&Ident> for Extent {
    fn from(ident: &Ident) -> Extent {
        ident.span().into()
    }
}

impl From<&TokenTree> for Extent {
    fn from(token: &TokenTree) -> Extent {
        match token {
            TokenTree::Group(group) => Extent {
                start: group.span_open(),
                end: group.span_close(),
            },
            other => other.span().into(),
        }
    }
}

/// One mistake.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// `E201`; empty for what syn reports.
    pub code: &'static str,
    /// Where.
    pub extent: Extent,
    /// What is wrong.
    pub message: String,
    /// What to do next, or empty.
    pub hint: String,
}

impl Display for Diagnostic {
    /// `line:column code message; hint`, both counted from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = self.extent.place();
        write!(f, "{line}:{column} {} {}", self.code, self.message)?;
        if !self.hint.is_empty() {
            write!(f, "; {}", self.hint)?;
        }
        Ok(())
    }
}

/// So many mistakes are told; a declaration can have as many as it has tokens.
const MOST: usize = 100;

/// Letters of what fills a blank of a message: a name in a file can have a million.
const LONGEST: usize = 1_000;

/// All mistakes found so far.
#[derive(Default, Debug)]
pub struct Diagnostics {
    /// The first [`MOST`] of them.
    found: Vec<Diagnostic>,
    /// How many there are.
    count: usize,
}

impl Diagnostics {
    /// None yet.
    pub fn new() -> Diagnostics {
        Diagnostics::default()
    }

    /// Reports a mistake: `arguments` fill `{0}`, `{1}`, … of the code's message and hint.
    pub fn report(&mut self, code: Code, at: impl Into<Extent>, arguments: &[&dyn Display]) {
        let row = code.row();
        self.add(|| Diagnostic {
            code: row.code,
            extent: at.into(),
            message: fill(row.message, arguments),
            hint: fill(row.hint, arguments),
        });
    }

    fn add(&mut self, mistake: impl FnOnce() -> Diagnostic) {
        self.count += 1;
        if !self.is_full() {
            self.found.push(mistake());
        }
    }

    /// Takes over what syn found.
    pub fn absorb(&mut self, error: syn::Error) {
        for one in error {
            self.add(|| Diagnostic {
                code: "E000",
                extent: one.span().into(),
                message: one.to_string(),
                hint: String::new(),
            });
        }
    }

    /// Takes over everything that another collector has found.
    pub fn append(&mut self, other: Diagnostics) {
        let room = MOST.saturating_sub(self.found.len());
        self.count += other.count;
        self.found.extend(other.found.into_iter().take(room));
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether further mistakes are counted, and not told.
    pub fn is_full(&self) -> bool {
        self.found.len() >= MOST
    }

    /// The number of mistakes so far; a later larger number says that something went wrong in between.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The mistakes that are told, in the order in which they were found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.found.iter()
    }

    /// One `::core::compile_error! { "…" }` per mistake, spanning its tokens.
    pub fn into_compile_errors(self) -> TokenStream {
        self.found.iter().flat_map(compile_error).collect()
    }
}

impl Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.found.iter().try_for_each(|one| writeln!(f, "{one}"))
    }
}

/// Replaces `{0}`, `{1}`, … in a template; of what is very long there the beginning is told.
fn fill(template: &str, arguments: &[&dyn Display]) -> String {
    let mut parts = template.split('{');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let blank = part
            .split_once('}')
            .and_then(|(index, rest)| Some((index.parse::<usize>().ok()?, rest)));
        match blank {
            Some((index, rest)) => {
                debug_assert!(index < arguments.len(), "nothing for a blank: {template}");
                let argument = arguments.get(index).map(ToString::to_string);
                let argument = argument.unwrap_or_default();
                text.extend(argument.chars().take(LONGEST));
                if argument.chars().nth(LONGEST).is_some() {
                    text.push('…');
                }
                text.push_str(rest);
            }
            None => text.extend(["{", part]),
        }
    }
    text
}

/// rustc underlines from the first to the last token of what it is given, so the path carries the start and
/// the braces carry the end.
fn compile_error(diagnostic: &Diagnostic) -> Vec<TokenTree> {
    let Extent { start, end } = diagnostic.extent;
    let mut text = diagnostic.message.clone();
    if !diagnostic.hint.is_empty() {
        text = format!("{text}\n{}", diagnostic.hint);
    }
    let text = format!("{text} [{}]", diagnostic.code);
    let punct = |symbol, spacing| {
        let mut punct = Punct::new(symbol, spacing);
        punct.set_span(start);
        TokenTree::from(punct)
    };
    let mut message = Literal::string(&text);
    message.set_span(end);
    let mut body = Group::new(Delimiter::Brace, TokenTree::from(message).into());
    body.set_span(end);
    vec![
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        Ident::new("core", start).into(),
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        Ident::new("compile_error", start).into(),
        punct('!', Spacing::Alone),
        body.into(),
    ]
}
