//! What the user wrote → formulas, term by term as written: `der(x)^2` is ẋ².

use super::formula::{Formula, Relation, Statement};
use super::letter::Letter;
use super::names::Names;
use crate::ast::{self, Comparison, Decimal, Expr, ExprKind, Factor, Reference, Sign};
use crate::symbolic::Rational;

impl Names {
    /// An expression as written.
    pub fn written(&self, expr: &Expr) -> Formula {
        let all = |list: &[Expr]| list.iter().map(|e| self.written(e)).collect::<Vec<_>>();
        match &expr.kind {
            ExprKind::Number(number) => decimal(*number),
            ExprKind::Name(name) if name.text == "pi" => Formula::Pi,
            ExprKind::Name(name) => Formula::Letter(self.declared(&name.text)),
            ExprKind::Sum(terms) => {
                let signed = |(sign, term): &(Sign, Expr)| {
                    let (minus, term) = self.written(term).signed();
                    (minus != (*sign == Sign::Minus), term)
                };
                Formula::Sum(terms.iter().map(signed).collect())
            }
            ExprKind::Product(factors) => self.product(factors),
            ExprKind::Negative(inner) => self.written(inner).negated(),
            ExprKind::Power(base, exponent) => {
                let (base, exponent) = (self.written(base), self.written(exponent));
                Formula::Power(Box::new(base), Box::new(exponent))
            }
            ExprKind::Call(name, arguments) => self.call(&name.text, all(arguments)),
            ExprKind::If(condition, then, otherwise) => Formula::Cases(
                Box::new(self.comparison(condition)),
                Box::new(self.written(then)),
                Box::new(self.written(otherwise)),
            ),
            ExprKind::SumOver(index, body) => {
                let range = &index.range;
                let parts = [
                    self.written(&range.from),
                    self.written(&range.to),
                    self.written(body),
                ];
                Formula::SumOver(Letter::new(&index.name.text), Box::new(parts))
            }
            ExprKind::ListOver(index, body) => {
                let range = &index.range;
                let over = [
                    Formula::Letter(Letter::new(&index.name.text)),
                    self.written(&range.from),
                    self.written(&range.to),
                    self.written(body),
                ];
                self.call("list", over.into())
            }
            ExprKind::List(elements) => Formula::List(all(elements)),
            ExprKind::Element(base, index) => match (self.axis(base, index), self.written(base)) {
                (Some(axis), _) => Formula::Letter(axis),
                (None, Formula::Letter(letter)) => {
                    Formula::Letter(letter.element(&index.to_string().replace(' ', "")))
                }
                (None, base) => Formula::Element(Box::new(base), Box::new(self.written(index))),
            },
            ExprKind::Member(base, name) => {
                if let ExprKind::Name(body) = &base.kind {
                    return Formula::Letter(self.member(&body.text, &name.text));
                }
                self.written(base)
            }
        }
    }

    /// The letter of what a body has.
    pub fn member(&self, name: &str, member: &str) -> Letter {
        match (self.body(name), member) {
            (Some(body), "body_rate") => Letter::of("ω", body),
            (Some(body), "axes") => Letter::of("e", body),
            _ => Letter::new(&format!("{}.{member}", self.declared(name).base)),
        }
    }

    /// The letter of `body.axes[i][j]`.
    fn axis(&self, base: &Expr, index: &Expr) -> Option<Letter> {
        let ExprKind::Element(base, axis) = &base.kind else {
            return None;
        };
        let ExprKind::Member(base, member) = &base.kind else {
            return None;
        };
        let (ExprKind::Name(body), "axes") = (&base.kind, member.text.as_str()) else {
            return None;
        };
        let [i, j] = [&**axis, index].map(|index| index.to_string().replace(' ', ""));
        Some(Letter::axis(self.body(&body.text)?, &i, &j))
    }

    /// A comparison as written.
    pub fn comparison(&self, comparison: &Comparison) -> Statement {
        let relation = match comparison.relation {
            ast::Relation::AtLeast => Relation::AtLeast,
            ast::Relation::AtMost => Relation::AtMost,
        };
        let (left, right) = (&comparison.left, &comparison.right);
        Statement::new(self.written(left), relation, self.written(right))
    }

    /// The use of a name, `ball[k]` too.
    pub fn reference(&self, reference: &Reference) -> Formula {
        let letter = self.declared(&reference.name.text);
        Formula::Letter(match &reference.element {
            Some(element) => letter.element(&element.to_string().replace(' ', "")),
            None => letter,
        })
    }

    /// From left to right: what follows a divisor multiplies the fraction.
    fn product(&self, factors: &[(Factor, Expr)]) -> Formula {
        let mut done: Vec<Formula> = Vec::new();
        let mut minus = false;
        for (side, factor) in factors {
            let (negative, factor) = self.written(factor).signed();
            minus ^= negative;
            match side {
                Factor::Times => done.push(factor),
                Factor::Over => {
                    let above = match done.len() {
                        0 => Formula::Number(Rational::ONE),
                        1 => done.remove(0),
                        _ => Formula::Product(std::mem::take(&mut done)),
                    };
                    done.clear();
                    done.push(quotient(above, factor));
                }
            }
        }
        // Functions come last: `sin θ ẋ` would be misread.
        done.sort_by_key(is_function);
        let whole = match done.len() {
            1 => done.remove(0),
            _ => Formula::Product(done),
        };
        if minus { whole.negated() } else { whole }
    }

    fn call(&self, name: &str, mut arguments: Vec<Formula>) -> Formula {
        match (name, arguments.as_mut_slice()) {
            ("der", [Formula::Letter(letter)]) if letter.rate < 2 => {
                letter.rate += 1;
                Formula::Letter(letter.clone())
            }
            ("der", [Formula::Rate(inner, order)]) => Formula::Rate(inner.clone(), *order + 1),
            ("der", [inner]) => Formula::Rate(Box::new(inner.clone()), 1),
            ("sqrt", [inner]) => Formula::Root(Box::new(inner.clone())),
            ("abs", [inner]) => Formula::Absolute(Box::new(inner.clone())),
            ("sign", _) => Formula::Call("sgn".to_owned(), arguments),
            ("asin" | "acos" | "atan", _) => Formula::Call(format!("arc{}", &name[1..]), arguments),
            _ => Formula::Call(name.to_owned(), arguments),
        }
    }
}

fn is_function(formula: &Formula) -> bool {
    match formula {
        Formula::Call(..) => true,
        Formula::Power(base, _) => is_function(base),
        _ => false,
    }
}

/// a/b, numbers as one number.
fn quotient(above: Formula, below: Formula) -> Formula {
    if let (Formula::Number(a), Formula::Number(b)) = (&above, &below)
        && let Some(ratio) = a.checked_div(*b)
    {
        return Formula::Number(ratio);
    }
    Formula::Fraction(Box::new(above), Box::new(below))
}

fn decimal(number: Decimal) -> Formula {
    if number.exponent < 0 {
        return Formula::Decimal(number);
    }
    let exact = Rational::parse(&number.to_string());
    exact.map_or_else(
        || Formula::Letter(Letter::of(&number.to_string(), "")),
        Formula::Number,
    )
}
