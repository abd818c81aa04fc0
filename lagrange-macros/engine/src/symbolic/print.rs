//! Plain text in the language of declarations, with the fewest parentheses.

use super::{ExprId, Node, Pool, Rational};

/// How tightly a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tightness {
    Sum,
    Product,
    Power,
    Atom,
}

impl Pool {
    /// Plain text, parseable by the language.
    pub fn print(&self, e: ExprId) -> String {
        self.text(e).0
    }

    fn text(&self, e: ExprId) -> (String, Tightness) {
        match self.node(e) {
            Node::Number(n) => number(*n),
            Node::Pi => ("pi".to_owned(), Tightness::Atom),
            Node::Symbol(symbol) => (self.name(*symbol).to_owned(), Tightness::Atom),
            Node::Sum { constant, terms } => self.sum_text(*constant, terms),
            Node::Product(factors) => self.product_text(Rational::ONE, factors),
            Node::Power(base, exponent) => {
                let text = self.bound(*base, Tightness::Atom)
                    + "^"
                    + &self.bound(*exponent, Tightness::Atom);
                (text, Tightness::Power)
            }
            Node::Call(f, arguments) => {
                let arguments: Vec<String> = arguments.iter().map(|&e| self.print(e)).collect();
                (
                    format!("{}({})", f.name(), arguments.join(", ")),
                    Tightness::Atom,
                )
            }
            Node::Group(e) => (format!("({})", self.print(*e)), Tightness::Atom),
            Node::Select {
                branch,
                then,
                otherwise,
            } => {
                let text = format!(
                    "select({branch}, {}, {})",
                    self.print(*then),
                    self.print(*otherwise)
                );
                (text, Tightness::Atom)
            }
        }
    }

    /// Text in parentheses if it binds less tightly than needed.
    fn bound(&self, e: ExprId, least: Tightness) -> String {
        let (text, tightness) = self.text(e);
        if tightness < least {
            format!("({text})")
        } else {
            text
        }
    }

    fn sum_text(&self, constant: Rational, terms: &[(ExprId, Rational)]) -> (String, Tightness) {
        let mut parts: Vec<(bool, String)> = terms
            .iter()
            .map(|&(term, c)| (c.is_negative(), self.term_text(term, c)))
            .collect();
        if parts.len() == 1 && constant.is_zero() {
            let (negative, text) = parts.remove(0);
            let product = if negative { format!("-{text}") } else { text };
            return (
                product,
                if negative {
                    Tightness::Sum
                } else {
                    Tightness::Product
                },
            );
        }
        if !constant.is_zero() {
            parts.push((constant.is_negative(), size_text(constant)));
        }
        // Begin with a term that needs no sign, if there is one.
        if let Some(first) = parts.iter().position(|&(negative, _)| !negative) {
            let first = parts.remove(first);
            parts.insert(0, first);
        }
        let mut text = String::new();
        for (i, (negative, part)) in parts.iter().enumerate() {
            text += match (i, negative) {
                (0, true) => "-",
                (0, false) => "",
                (_, true) => " - ",
                (_, false) => " + ",
            };
            text += part;
        }
        (text, Tightness::Sum)
    }

    /// |c| · term
    fn term_text(&self, term: ExprId, c: Rational) -> String {
        match self.node(term) {
            Node::Product(factors) => self.product_text(c, factors).0,
            _ => self.product_text(c, &[(term, Rational::ONE)]).0,
        }
    }

    /// |c| · Π baseᵢ^exponentᵢ: numbers, then parameters, then the rest, divisors last.
    fn product_text(&self, c: Rational, factors: &[(ExprId, Rational)]) -> (String, Tightness) {
        let mut ordered = factors.to_vec();
        ordered.sort_by_key(|&(base, _)| (self.rank(base), base));
        let mut above = Vec::new();
        let mut below = Vec::new();
        for (base, exponent) in ordered {
            let list = if exponent.is_negative() {
                &mut below
            } else {
                &mut above
            };
            list.push(self.power_text(base, exponent));
        }
        if above.is_empty() {
            if c.denominator() != 1 {
                below.insert(0, (c.denominator().to_string(), Tightness::Atom));
            }
            above.push((c.numerator().unsigned_abs().to_string(), Tightness::Atom));
        } else if !c.is_unit() {
            above.insert(0, (size_text(c), Tightness::Product));
        }
        let alone = above.len() + below.len() == 1;
        let tightness = if alone {
            above[0].1
        } else {
            Tightness::Product
        };
        let join = |list: &[(String, Tightness)]| {
            let texts: Vec<String> = list
                .iter()
                .map(|(text, tightness)| {
                    if *tightness < Tightness::Product && !alone {
                        format!("({text})")
                    } else {
                        text.clone()
                    }
                })
                .collect();
            texts.join("*")
        };
        let mut text = join(&above);
        if below.len() > 1
            || below
                .iter()
                .any(|(_, tightness)| *tightness < Tightness::Power)
        {
            text = format!("{text}/({})", join(&below));
        } else if let Some((divisor, _)) = below.first() {
            text = format!("{text}/{divisor}");
        }
        (text, tightness)
    }

    /// base^|exponent|
    fn power_text(&self, base: ExprId, exponent: Rational) -> (String, Tightness) {
        let size = size_text(exponent);
        if size == "1" {
            self.text(base)
        } else if size == "1/2" {
            (format!("sqrt({})", self.print(base)), Tightness::Atom)
        } else {
            let size = if exponent.is_integer() {
                size
            } else {
                format!("({size})")
            };
            (
                self.bound(base, Tightness::Atom) + "^" + &size,
                Tightness::Power,
            )
        }
    }

    /// Numbers, π, symbols, the rest.
    fn rank(&self, e: ExprId) -> u8 {
        match self.node(e) {
            Node::Number(_) => 0,
            Node::Pi => 1,
            Node::Symbol(_) => 2,
            _ => 3,
        }
    }
}

/// A number with its sign.
fn number(n: Rational) -> (String, Tightness) {
    let tightness = match (n.is_negative(), n.is_integer()) {
        (true, _) => Tightness::Sum,
        (false, true) => Tightness::Atom,
        (false, false) => Tightness::Product,
    };
    (n.to_string(), tightness)
}

/// |n|
fn size_text(n: Rational) -> String {
    let above = n.numerator().unsigned_abs();
    if n.is_integer() {
        above.to_string()
    } else {
        format!("{above}/{}", n.denominator())
    }
}
