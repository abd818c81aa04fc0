//! Tables as the derive writes them, `Description { name: "Pendulum", … }` → the types of the core.
//!
//! Where a system is a struct, rustc reads these literals; where it is a file, this reads the same. What is read lives as long as the
//! program.

use lagrange_core::__private::declaration::{self, Declaration, Draw, Form, Turn, Worked};
use lagrange_core::__private::places::*;
use lagrange_core::__private::program::{Encoded, ValueRef};
use lagrange_core::system::*;
use syn::{Expr, Lit, Member};

/// What can be read from a literal.
pub(super) trait Literal: Sized {
    /// Reads an expression that is made of literals only; a bug of the derive, or of this, is the text of what is not understood.
    fn read(expr: &Expr) -> Result<Self, String>;
}

fn unexpected<T>(expr: &Expr, expected: &str) -> Result<T, String> {
    let found = quote::quote!(#expr);
    Err(format!("`{found}` stands in a table for {expected}"))
}

fn literal(expr: &Expr) -> Option<&Lit> {
    match expr {
        Expr::Lit(literal) => Some(&literal.lit),
        _ => None,
    }
}

impl Literal for bool {
    fn read(expr: &Expr) -> Result<Self, String> {
        match literal(expr) {
            Some(Lit::Bool(truth)) => Ok(truth.value),
            _ => unexpected(expr, "a truth value"),
        }
    }
}

impl Literal for usize {
    fn read(expr: &Expr) -> Result<Self, String> {
        match literal(expr) {
            Some(Lit::Int(number)) => number.base10_parse().map_err(|error| error.to_string()),
            _ => unexpected(expr, "a whole number"),
        }
    }
}

impl Literal for f64 {
    fn read(expr: &Expr) -> Result<Self, String> {
        if let Expr::Unary(negative) = expr {
            return Ok(-f64::read(&negative.expr)?);
        }
        let digits = match literal(expr) {
            Some(Lit::Float(number)) => number.base10_digits(),
            Some(Lit::Int(number)) => number.base10_digits(),
            _ => return unexpected(expr, "a number"),
        };
        digits.parse().or_else(|_| unexpected(expr, "a number"))
    }
}

impl Literal for &'static str {
    fn read(expr: &Expr) -> Result<Self, String> {
        match literal(expr) {
            Some(Lit::Str(text)) => Ok(text.value().leak()),
            _ => unexpected(expr, "a text"),
        }
    }
}

impl Literal for &'static [u8] {
    fn read(expr: &Expr) -> Result<Self, String> {
        match literal(expr) {
            Some(Lit::ByteStr(bytes)) => Ok(bytes.value().leak()),
            _ => unexpected(expr, "bytes"),
        }
    }
}

impl<T: Literal> Literal for &'static [T] {
    fn read(expr: &Expr) -> Result<Self, String> {
        let Expr::Reference(reference) = expr else {
            return unexpected(expr, "a list");
        };
        let Expr::Array(array) = &*reference.expr else {
            return unexpected(expr, "a list");
        };
        let elements: Result<Vec<T>, String> = array.elems.iter().map(T::read).collect();
        Ok(elements?.leak())
    }
}

impl<T: Literal> Literal for Option<T> {
    fn read(expr: &Expr) -> Result<Self, String> {
        match variant(expr) {
            Some((name, None)) if name == "None" => Ok(None),
            Some((name, Some(value))) if name == "Some" => Ok(Some(T::read(value)?)),
            _ => unexpected(expr, "an option"),
        }
    }
}

impl<A: Literal, B: Literal> Literal for (A, B) {
    fn read(expr: &Expr) -> Result<Self, String> {
        match expr {
            Expr::Tuple(tuple) if tuple.elems.len() == 2 => {
                Ok((A::read(&tuple.elems[0])?, B::read(&tuple.elems[1])?))
            }
            _ => unexpected(expr, "a pair"),
        }
    }
}

impl<A: Literal, B: Literal, C: Literal> Literal for (A, B, C) {
    fn read(expr: &Expr) -> Result<Self, String> {
        match expr {
            Expr::Tuple(tuple) if tuple.elems.len() == 3 => Ok((
                A::read(&tuple.elems[0])?,
                B::read(&tuple.elems[1])?,
                C::read(&tuple.elems[2])?,
            )),
            _ => unexpected(expr, "three values"),
        }
    }
}

/// Name and content of `path::Name` or `path::Name(content)`.
fn variant(expr: &Expr) -> Option<(String, Option<&Expr>)> {
    match expr {
        Expr::Path(path) => Some((path.path.segments.last()?.ident.to_string(), None)),
        Expr::Call(call) => Some((variant(&call.func)?.0, call.args.first())),
        _ => None,
    }
}

/// The value of a field.
fn field<T: Literal>(expr: &Expr, name: &str) -> Result<T, String> {
    let Expr::Struct(literal) = expr else {
        return unexpected(expr, name);
    };
    let fields = literal.fields.iter();
    let named = |member: &Member| matches!(member, Member::Named(ident) if ident == name);
    match fields.into_iter().find(|field| named(&field.member)) {
        Some(field) => T::read(&field.expr),
        None => unexpected(expr, name),
    }
}

macro_rules! structs {
    ($($type:path { $($field:ident)* })*) => {$(
        impl Literal for $type {
            fn read(expr: &Expr) -> Result<Self, String> {
                Ok(Self { $($field: field(expr, stringify!($field))?,)* })
            }
        }
    )*};
}

macro_rules! variants {
    ($($type:path { $($name:ident)* $(; $($of:ident)*)? })*) => {$(
        impl Literal for $type {
            fn read(expr: &Expr) -> Result<Self, String> {
                let (name, content) = match variant(expr) {
                    Some(found) => found,
                    None => return unexpected(expr, stringify!($type)),
                };
                match (name.as_str(), content) {
                    $((stringify!($name), None) => Ok(Self::$name),)*
                    $($((stringify!($of), Some(content)) => Ok(Self::$of(Literal::read(content)?)),)*)?
                    _ => unexpected(expr, stringify!($type)),
                }
            }
        }
    )*};
}

structs! {
    Description {
        name documentation parameters coordinates needs constants motion report mass inertia forcing rows couplings watched_rows kinetic potential
        constraints contacts frictions resultants forces dissipations branches energy momenta observes stops marks starts units impacts
    }
    Parameter { name documentation unit tex domain }
    Coordinate { name unit cyclic }
    Encoded { words numbers values outputs }
    Row { jacobian bias position velocity rheonomic needs }
    RowNeeds { jacobian bias position velocity }
    Coupling { coordinate row factor need }
    Effect { name need optional }
    Constraint { name row while_contact attitude }
    Contact { name row normal_factor restitution restitution_need restitution_parameters region }
    Friction {
        name row components normal static_coefficient kinetic_coefficient coefficients_need static_parameters kinetic_parameters
    }
    Load { name need value power report_need }
    Branch { guard need after_solve users then otherwise }
    Energy { kinetic potential jacobi time_power need }
    Momenta { places need }
    Observe { name place need unit }
    Watch { name terms conditions need zeros }
    Units { energy rows forces dissipations }
    Declaration {
        words numbers kinetic potential constraints contacts frictions forces dissipations stops marks draws
    }
    declaration::Contact { gap normal_factor restitution region }
    declaration::Friction { slip normal static_coefficient kinetic_coefficient }
    declaration::Force { value components }
    Draw { form name places size turn parts applied loads }
}

variants! {
    ValueRef { Zero; Constant Node }
    Restitution { ; Newton Poisson }
    Normal { ; Contact Constraint Resultant Given }
    Condition { ; Closed Open Sticks Slips }
    Impacts { Together InTurn }
    Domain { Any Positive NonNegative }
    Worked { ; Coordinate Point Speed }
    Turn { None; Angle Attitude About Rolled }
    Form {
        Floor Ground Shell Bowl Disc Polygon Box Sphere HalfEllipsoid Rod Rope Spring Mass Pivot Path Arrow
    }
}
