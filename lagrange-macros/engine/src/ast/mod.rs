//! What the user wrote: a struct and the items of its `#[lagrange(…)]` attributes, spans kept.
//!
//! Nothing is resolved here: names are text, ranges are expressions, levels of constraints are unknown.
//! Indices run over half-open ranges `k in a..b`.

mod draw;
mod expression;
mod item;
mod places;
mod print;
mod without;

use crate::diagnostics::Extent;
use proc_macro2::{Ident, Span, TokenStream};

pub use draw::{Detail, Draw, Form};
pub use expression::{Comparison, Decimal, Expr, ExprKind, Factor, Relation, Sign};
pub use item::{
    Action, Attitude, Check, Claim, Clause, Constraint, Contact, Coordinate, Definition,
    Dissipation, Element, Emit, Energy, Force, Friction, FrictionLaw, Impacts, Item, ItemKind,
    ModeWord, Observe, Premise, Restitution, Start, StartQuantity, StartValue, Trigger, Watch,
};

/// A struct with its declaration.
#[derive(Debug)]
pub struct Declaration {
    /// The struct.
    pub name: Ident,
    /// Doc comment of the struct.
    pub documentation: String,
    /// The one type parameter, if there is one.
    pub scalar: Option<Ident>,
    /// Parameters.
    pub fields: Vec<Field>,
    /// Items in order, of all attributes.
    pub items: Vec<Item>,
    /// `crate = path`.
    pub core: Option<TokenStream>,
    /// Where it stands.
    pub home: Home,
}

impl Declaration {
    /// One that declares nothing.
    pub fn nothing() -> Self {
        Self {
            name: Ident::new("Nothing", Span::call_site()),
            documentation: String::new(),
            scalar: None,
            fields: Vec::new(),
            items: Vec::new(),
            core: None,
            home: Home::Line,
        }
    }
}

/// Where a declaration stands, which decides how a parameter is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Home {
    /// On a struct, whose fields are the parameters.
    Struct,
    /// In a text file.
    File,
    /// Nowhere: an expression of numbers stands alone, as on a command line.
    Line,
}

impl Home {
    /// How a parameter is declared with this unit: `a field with …`.
    pub fn with_unit(self, unit: &str) -> String {
        match self {
            Home::Struct => format!("a field with `#[lagrange(unit = \"{unit}\")]`"),
            Home::File | Home::Line => {
                format!("a parameter, `parameters(name: \"{unit}\" = …)`")
            }
        }
    }

    /// What to do about a name that is not known.
    pub fn unknown(self) -> &'static str {
        match self {
            Home::Struct => {
                "declare it as a parameter (a field of the struct), a coordinate, or with `define`"
            }
            Home::File => {
                "declare it as a parameter, `parameters(name = 1)`, a coordinate, or with `define`"
            }
            Home::Line => "only numbers and `pi` stand here",
        }
    }
}

/// A field of the struct.
#[derive(Debug)]
pub struct Field {
    /// Name.
    pub name: Name,
    /// N of `[T; N]`.
    pub length: Option<usize>,
    /// Doc comment.
    pub documentation: String,
    /// `tex = "…"`, or empty.
    pub tex: String,
    /// `unit = "…"`
    pub unit: Option<Unit>,
    /// `symbol = "…"`, or empty.
    pub letter: String,
    /// `domain = "…"`
    pub domain: Option<Domain>,
}

/// What the value of a field may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Above 0.
    Positive,
    /// 0 or above.
    NonNegative,
}

impl Domain {
    /// All, with the words for them.
    pub const ALL: [(&'static str, Domain); 2] = [
        ("positive", Domain::Positive),
        ("nonnegative", Domain::NonNegative),
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        let found = Domain::ALL.iter().find(|(_, domain)| *domain == self);
        found.map_or("", |(word, _)| word)
    }
}

/// A unit as written.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Without the quotation marks.
    pub text: String,
    /// Where it is.
    pub extent: Extent,
}

/// A name as written; `r#type` reads as `type`.
#[derive(Clone, Debug)]
pub struct Name {
    /// Without `r#`.
    pub text: String,
    /// As it came.
    pub ident: Ident,
}

impl Name {
    /// Reads an identifier, raw or keyword too.
    pub fn new(ident: &Ident) -> Name {
        let text = ident.to_string();
        Name {
            text: text.strip_prefix("r#").map_or(text.clone(), str::to_string),
            ident: ident.clone(),
        }
    }

    /// Where it is.
    pub fn span(&self) -> Span {
        self.ident.span()
    }
}

impl From<&Name> for Extent {
    fn from(name: &Name) -> Extent {
        name.span().into()
    }
}

/// `from..to`, half open.
#[derive(Clone, Debug)]
pub struct Range {
    /// First value.
    pub from: Expr,
    /// One past the last value.
    pub to: Expr,
}

/// `name in from..to`
#[derive(Clone, Debug)]
pub struct Index {
    /// The index.
    pub name: Name,
    /// Its values.
    pub range: Range,
}

/// Name of an item: `rim`, or `ball[k in 0..63]`.
#[derive(Clone, Debug)]
pub struct Head {
    /// Name.
    pub name: Name,
    /// Where it is indexed.
    pub index: Option<Index>,
}

/// A use of an item's name: `rim`, or `ball[k]`.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Name.
    pub name: Name,
    /// Which element.
    pub element: Option<Expr>,
}
