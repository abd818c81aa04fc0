//! Expressions as text that parses back to the same tree.

use super::{Comparison, Decimal, Expr, ExprKind, Factor, Relation, Sign};
use core::fmt::{self, Display, Formatter};

/// Binding strength, weakest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Negative,
    Power,
    Atom,
}

fn strength(expr: &Expr) -> Strength {
    match &expr.kind {
        ExprKind::Sum(_) => Strength::Sum,
        ExprKind::Product(_) => Strength::Product,
        ExprKind::Negative(_) => Strength::Negative,
        ExprKind::Power(..) => Strength::Power,
        _ => Strength::Atom,
    }
}

/// In parentheses if it binds more weakly than its surroundings need.
fn within(expr: &Expr, least: Strength, f: &mut Formatter<'_>) -> fmt::Result {
    if strength(expr) < least {
        write!(f, "({expr})")
    } else {
        write!(f, "{expr}")
    }
}

impl Expr {
    /// As an index may follow it, in parentheses if it is no atom: `(a + b)`.
    pub fn as_base(&self) -> String {
        match strength(self) {
            Strength::Atom => self.to_string(),
            _ => format!("({self})"),
        }
    }
}

fn list(elements: &[Expr], f: &mut Formatter<'_>) -> fmt::Result {
    for (i, element) in elements.iter().enumerate() {
        write!(f, "{}{element}", if i == 0 { "" } else { ", " })?;
    }
    Ok(())
}

impl Display for Expr {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ExprKind::Number(number) => number.fmt(f),
            ExprKind::Name(name) => f.write_str(&name.text),
            ExprKind::Sum(terms) => {
                for (i, (sign, term)) in terms.iter().enumerate() {
                    f.write_str(match (i, sign) {
                        (0, _) => "",
                        (_, Sign::Plus) => " + ",
                        (_, Sign::Minus) => " - ",
                    })?;
                    within(term, Strength::Product, f)?;
                }
                Ok(())
            }
            ExprKind::Product(factors) => {
                for (i, (side, factor)) in factors.iter().enumerate() {
                    f.write_str(match (i, side) {
                        (0, _) => "",
                        (_, Factor::Times) => "*",
                        (_, Factor::Over) => "/",
                    })?;
                    within(factor, Strength::Negative, f)?;
                }
                Ok(())
            }
            ExprKind::Negative(inner) => {
                f.write_str("-")?;
                within(inner, Strength::Negative, f)
            }
            ExprKind::Power(base, exponent) => {
                within(base, Strength::Atom, f)?;
                f.write_str("^")?;
                within(exponent, Strength::Negative, f)
            }
            ExprKind::Call(name, arguments) => {
                write!(f, "{}(", name.text)?;
                list(arguments, f)?;
                f.write_str(")")
            }
            ExprKind::If(condition, then, otherwise) => {
                write!(f, "if({condition}, {then}, {otherwise})")
            }
            ExprKind::SumOver(index, body) => {
                let range = &index.range;
                write!(
                    f,
                    "sum({} in {}..{}: {body})",
                    index.name.text, range.from, range.to
                )
            }
            ExprKind::ListOver(index, body) => {
                let range = &index.range;
                write!(
                    f,
                    "list({} in {}..{}: {body})",
                    index.name.text, range.from, range.to
                )
            }
            ExprKind::List(elements) => {
                f.write_str("[")?;
                list(elements, f)?;
                f.write_str("]")
            }
            ExprKind::Element(base, index) => {
                within(base, Strength::Atom, f)?;
                write!(f, "[{index}]")
            }
            ExprKind::Member(base, name) => {
                within(base, Strength::Atom, f)?;
                write!(f, ".{}", name.text)
            }
        }
    }
}

impl Display for Comparison {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let relation = match self.relation {
            Relation::AtLeast => ">=",
            Relation::AtMost => "<=",
        };
        write!(f, "{} {relation} {}", self.left, self.right)
    }
}

impl Display for Decimal {
    /// Plain digits, as many as it needs; with an exponent where exact numbers end.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let digits = self.digits.to_string();
        if self.exponent.unsigned_abs() > 38 {
            // The point stands where people write it, behind the first digit.
            let sign = usize::from(self.digits < 0);
            let (first, part) = digits.split_at(sign + 1);
            let point = if part.is_empty() { "" } else { "." };
            let exponent = i64::from(self.exponent) + part.len() as i64;
            return write!(f, "{first}{point}{part}e{exponent}");
        }
        let Ok(places) = usize::try_from(-i64::from(self.exponent)) else {
            return write!(f, "{digits}{:0<width$}", "", width = self.exponent as usize);
        };
        if places == 0 {
            return f.write_str(&digits);
        }
        let padded = format!("{digits:0>width$}", width = places + 1);
        let (whole, part) = padded.split_at(padded.len() - places);
        write!(f, "{whole}.{part}")
    }
}
