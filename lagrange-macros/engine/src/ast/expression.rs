//! Expressions and comparisons.

use super::{Index, Name, Range, Reference};
use crate::diagnostics::Extent;

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// Its form.
    pub kind: ExprKind,
    /// From its first to its last token.
    pub extent: Extent,
}

impl Expr {
    /// Whether it is made of numbers only.
    pub fn is_number(&self) -> bool {
        match &self.kind {
            ExprKind::Number(_) => true,
            ExprKind::Name(name) => name.text == "pi",
            ExprKind::Negative(inner) => inner.is_number(),
            ExprKind::Sum(terms) => terms.iter().all(|(_, term)| term.is_number()),
            ExprKind::Product(factors) => factors.iter().all(|(_, factor)| factor.is_number()),
            ExprKind::Power(base, exponent) => base.is_number() && exponent.is_number(),
            ExprKind::Call(_, arguments) => arguments.iter().all(Expr::is_number),
            _ => false,
        }
    }

    /// The use of a name that this is, if it is nothing more: `x`, or `x[2]`.
    pub fn as_reference(&self) -> Option<Reference> {
        let (name, element) = match &self.kind {
            ExprKind::Name(name) => (name, None),
            ExprKind::Element(base, index) => match &base.kind {
                ExprKind::Name(name) => (name, Some((**index).clone())),
                _ => return None,
            },
            _ => return None,
        };
        Some(Reference {
            name: name.clone(),
            element,
        })
    }

    /// The expression for one value of each index: a number for its name, and for sums and products of such numbers.
    pub fn at(&self, index: &dyn Fn(&str) -> Option<i64>) -> Expr {
        let at = |e: &Expr| e.at(index);
        let boxed = |e: &Expr| Box::new(e.at(index));
        let over = |inner: &Index| {
            let range = Range {
                from: at(&inner.range.from),
                to: at(&inner.range.to),
            };
            Box::new(Index {
                name: inner.name.clone(),
                range,
            })
        };
        let kind = match &self.kind {
            ExprKind::Number(number) => ExprKind::Number(*number),
            ExprKind::Name(name) => match index(&name.text) {
                Some(value) => return self.whole_number(value),
                None => ExprKind::Name(name.clone()),
            },
            ExprKind::Sum(terms) => {
                // x + k is x - 1 where k = -1.
                let signed = terms.iter().enumerate().map(|(i, (sign, e))| {
                    let e = at(e);
                    match (e.kind, sign) {
                        (ExprKind::Negative(size), Sign::Plus) if i > 0 => (Sign::Minus, *size),
                        (ExprKind::Negative(size), Sign::Minus) if i > 0 => (Sign::Plus, *size),
                        (kind, sign) => (*sign, Expr { kind, ..e }),
                    }
                });
                ExprKind::Sum(signed.collect())
            }
            ExprKind::Product(factors) => {
                ExprKind::Product(factors.iter().map(|(side, e)| (*side, at(e))).collect())
            }
            ExprKind::Negative(inner) => ExprKind::Negative(boxed(inner)),
            ExprKind::Power(base, exponent) => ExprKind::Power(boxed(base), boxed(exponent)),
            ExprKind::Call(name, parts) => {
                ExprKind::Call(name.clone(), parts.iter().map(at).collect())
            }
            ExprKind::If(condition, then, otherwise) => {
                let condition = Comparison {
                    left: at(&condition.left),
                    relation: condition.relation,
                    right: at(&condition.right),
                };
                ExprKind::If(Box::new(condition), boxed(then), boxed(otherwise))
            }
            ExprKind::SumOver(inner, body) => ExprKind::SumOver(over(inner), boxed(body)),
            ExprKind::ListOver(inner, body) => ExprKind::ListOver(over(inner), boxed(body)),
            ExprKind::List(parts) => ExprKind::List(parts.iter().map(at).collect()),
            ExprKind::Element(base, element) => ExprKind::Element(boxed(base), boxed(element)),
            ExprKind::Member(base, name) => ExprKind::Member(boxed(base), name.clone()),
        };
        let replaced = Expr {
            kind,
            extent: self.extent,
        };
        match replaced.as_whole_number() {
            Some(value) => self.whole_number(value),
            None => replaced,
        }
    }

    /// A whole number in the place of this expression.
    fn whole_number(&self, value: i64) -> Expr {
        let size = ExprKind::Number(Decimal {
            digits: i128::from(value.unsigned_abs()),
            exponent: 0,
        });
        let extent = self.extent;
        let size = Expr { kind: size, extent };
        match value < 0 {
            true => Expr {
                kind: ExprKind::Negative(Box::new(size)),
                extent,
            },
            false => size,
        }
    }

    /// The value of sums and products of whole numbers.
    fn as_whole_number(&self) -> Option<i64> {
        match &self.kind {
            ExprKind::Number(number) if number.exponent == 0 => number.digits.try_into().ok(),
            ExprKind::Negative(inner) => inner.as_whole_number()?.checked_neg(),
            ExprKind::Sum(terms) => terms.iter().try_fold(0i64, |sum, (sign, term)| {
                let term = term.as_whole_number()?;
                match sign {
                    Sign::Plus => sum.checked_add(term),
                    Sign::Minus => sum.checked_sub(term),
                }
            }),
            ExprKind::Product(factors) => factors.iter().try_fold(1i64, |product, (side, e)| {
                let factor = e.as_whole_number().filter(|_| *side == Factor::Times)?;
                product.checked_mul(factor)
            }),
            _ => None,
        }
    }

    /// The names that an expression uses, in order.
    pub fn names_into<'a>(&'a self, names: &mut Vec<&'a str>) {
        match &self.kind {
            ExprKind::Number(_) => {}
            ExprKind::Name(name) => names.push(&name.text),
            ExprKind::Sum(terms) => terms.iter().for_each(|(_, term)| term.names_into(names)),
            ExprKind::Product(factors) => factors
                .iter()
                .for_each(|(_, factor)| factor.names_into(names)),
            ExprKind::Negative(inner)
            | ExprKind::SumOver(_, inner)
            | ExprKind::ListOver(_, inner) => inner.names_into(names),
            ExprKind::Member(inner, _) | ExprKind::Element(inner, _) => inner.names_into(names),
            ExprKind::Power(base, exponent) => [base, exponent]
                .into_iter()
                .for_each(|part| part.names_into(names)),
            ExprKind::Call(_, parts) | ExprKind::List(parts) => {
                parts.iter().for_each(|part| part.names_into(names));
            }
            ExprKind::If(condition, then, otherwise) => {
                for part in [&condition.left, &condition.right, then, otherwise] {
                    part.names_into(names);
                }
            }
        }
    }
}

/// digits · 10^exponent
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Decimal {
    /// Without trailing zeros if the exponent is negative.
    pub digits: i128,
    /// Of ten.
    pub exponent: i32,
}

impl Decimal {
    /// The nearest double.
    pub fn nearest(self) -> f64 {
        let text = format!("{}e{}", self.digits, self.exponent);
        text.parse().unwrap_or(f64::NAN)
    }
}

/// Sign of a term of a sum.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// `+`
    Plus,
    /// `-`
    Minus,
}

/// Side of a factor of a product.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Factor {
    /// `*`
    Times,
    /// `/`
    Over,
}

/// Form of an expression. Sums and products are flat, so that long ones do not nest.
#[derive(Clone, Debug)]
pub enum ExprKind {
    /// An exact number.
    Number(Decimal),
    /// A name, `pi` and `t` too.
    Name(Name),
    /// a + b − c
    Sum(Vec<(Sign, Expr)>),
    /// a b / c, from left to right
    Product(Vec<(Factor, Expr)>),
    /// −a
    Negative(Box<Expr>),
    /// base^exponent
    Power(Box<Expr>, Box<Expr>),
    /// f(arguments), `der` too
    Call(Name, Vec<Expr>),
    /// if(a >= b, then, otherwise)
    If(Box<Comparison>, Box<Expr>, Box<Expr>),
    /// sum(i in a..b: body)
    SumOver(Box<Index>, Box<Expr>),
    /// list(i in a..b: body)
    ListOver(Box<Index>, Box<Expr>),
    /// [a, b] or (a, b)
    List(Vec<Expr>),
    /// `list[index]`
    Element(Box<Expr>, Box<Expr>),
    /// body.axes
    Member(Box<Expr>, Name),
}

/// `left >= right` or `left <= right`
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Left side.
    pub left: Expr,
    /// The relation.
    pub relation: Relation,
    /// Right side.
    pub right: Expr,
}

impl Comparison {
    /// (larger side, smaller side)
    pub fn sides(&self) -> (&Expr, &Expr) {
        match self.relation {
            Relation::AtLeast => (&self.left, &self.right),
            Relation::AtMost => (&self.right, &self.left),
        }
    }

    /// From its first to its last token.
    pub fn extent(&self) -> Extent {
        Extent::new(self.left.extent, self.right.extent)
    }
}

/// A relation between two values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    /// `>=`
    AtLeast,
    /// `<=`
    AtMost,
}
