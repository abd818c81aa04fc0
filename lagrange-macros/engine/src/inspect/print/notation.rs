//! What the printers of formulas share: which parts need parentheses, and in which order pieces come.

use crate::inspect::formula::{Formula, Relation, Statement};
use crate::inspect::letter::Letter;
use crate::symbolic::{Function, Rational};

/// How tightly a formula binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Power,
    Atom,
}

/// Sums with no more than this to read are not broken.
const SHORT: usize = 12;

/// How the pieces of formulas are written in one language.
pub trait Notation {
    /// A symbol.
    fn letter(&self, letter: &Letter) -> String;
    /// A whole number, or a fraction.
    fn number(&self, n: Rational) -> String;
    /// A number with a decimal point.
    fn decimal(&self, digits: &str) -> String {
        digits.to_owned()
    }
    /// A sign between terms (`leading`: before the first).
    fn sign(&self, minus: bool, leading: bool) -> &'static str;
    /// = ≥ ≤ > <
    fn relation(&self, relation: Relation) -> &'static str;
    /// Factors side by side.
    fn product(&self, factors: &[String]) -> String;
    /// a over b; in a line, they come in the parentheses that they need.
    fn fraction(&self, above: &str, below: &str) -> String;
    /// Whether fractions are written in a line.
    fn in_line(&self) -> bool;
    /// Whether a fraction that was written has one number over the other, so that it shows where it ends.
    fn stacked(&self, _fraction: &str) -> bool {
        !self.in_line()
    }
    /// A base with a raised exponent.
    fn power(&self, base: &str, exponent: &str) -> String;
    /// √
    fn root(&self, inner: &str) -> String;
    /// |…|
    fn absolute(&self, inner: &str) -> String;
    /// (…)
    fn group(&self, inner: &str) -> String;
    /// f(…) or `f x`, with a raised exponent if there is one.
    fn call(&self, name: &str, exponent: Option<&str>, argument: &str, bare: bool) -> String;
    /// d/dt of a group.
    fn rate(&self, inner: &str, order: u8) -> String;
    /// One value if the condition holds, else the other.
    fn cases(&self, rows: &[(String, String)], otherwise: &str) -> String;
    /// Σ
    fn sum_over(&self, index: &str, from: &str, to: &str, body: &str) -> String;
    /// A comma-separated list.
    fn list(&self, elements: &[String]) -> String;
    /// `base[index]`
    fn element(&self, base: &str, index: &str) -> String;
    /// Terms that are not shown.
    fn more(&self, count: usize) -> String;
    /// Pieces that belong together.
    fn row(&self, pieces: &[String]) -> String {
        pieces.concat()
    }
}

/// A formula in a notation.
pub fn formula(n: &dyn Notation, f: &Formula) -> String {
    match f {
        Formula::Number(number) => match short_decimal(*number) {
            Some(digits) => n.decimal(&digits),
            None => n.number(*number),
        },
        Formula::Decimal(number) => n.decimal(&number.to_string()),
        Formula::Pi => n.letter(&Letter::of("π", "")),
        Formula::Letter(letter) => n.letter(letter),
        Formula::Sum(_) => n.row(&terms(n, f)),
        Formula::Product(factors) => match over_one_stroke(n, factors) {
            Some(fraction) => formula(n, &fraction),
            None => product(n, factors, |last| bound(n, last, Strength::Product)),
        },
        Formula::Negative(inner) => n.row(&[
            n.sign(true, true).to_owned(),
            bound(n, inner, Strength::Product),
        ]),
        Formula::Fraction(above, below) if n.in_line() => {
            n.fraction(&followed(n, above), &divisor(n, below))
        }
        Formula::Fraction(above, below) => n.fraction(&formula(n, above), &formula(n, below)),
        Formula::Power(base, exponent) => {
            let raised = formula(n, exponent);
            match &**base {
                Formula::Call(name, arguments) if arguments.len() == 1 => {
                    call(n, name, Some(&raised), arguments, true)
                }
                base => n.power(&bound(n, base, Strength::Atom), &raised),
            }
        }
        Formula::Root(inner) => n.root(&formula(n, inner)),
        Formula::Absolute(inner) => n.absolute(&formula(n, inner)),
        Formula::Call(name, arguments) => call(n, name, None, arguments, true),
        Formula::Rate(inner, order) => n.rate(&formula(n, inner), *order),
        Formula::Cases(condition, then, otherwise) => {
            let row = |condition, then| (statement(n, condition), formula(n, then));
            let mut rows = vec![row(condition, then)];
            let mut otherwise = otherwise;
            while let Formula::Cases(condition, then, rest) = &**otherwise {
                rows.push(row(condition, then));
                otherwise = rest;
            }
            n.cases(&rows, &formula(n, otherwise))
        }
        Formula::SumOver(index, parts) => {
            let [from, to, body] = &**parts;
            let last = bound_by_one(to);
            n.sum_over(
                &n.letter(index),
                &formula(n, from),
                &formula(n, &last),
                &bound(n, body, Strength::Product),
            )
        }
        Formula::List(elements) => {
            let elements: Vec<String> = elements.iter().map(|e| formula(n, e)).collect();
            n.list(&elements)
        }
        Formula::Element(base, index) => {
            n.element(&bound(n, base, Strength::Atom), &formula(n, index))
        }
        Formula::More(count) => n.more(*count),
    }
}

/// Terms of a sum with their signs.
fn terms(n: &dyn Notation, f: &Formula) -> Vec<String> {
    match f {
        Formula::Sum(list) => list
            .iter()
            .enumerate()
            .map(|(i, (minus, term))| {
                // Side by side, so that a sign stands between two terms.
                format!(
                    "{}{}",
                    n.sign(*minus, i == 0),
                    bound(n, term, Strength::Product)
                )
            })
            .collect(),
        other => vec![formula(n, other)],
    }
}

/// The same, broken also inside of a sum that is the one long factor of a product.
pub fn pieces(n: &dyn Notation, f: &Formula) -> Vec<String> {
    match f {
        Formula::Sum(list) => {
            let mut all = Vec::new();
            for (i, (minus, term)) in list.iter().enumerate() {
                let mut own = match term {
                    Formula::Product(_) | Formula::Fraction(..) => pieces(n, term),
                    term => vec![bound(n, term, Strength::Product)],
                };
                own[0] = format!("{}{}", n.sign(*minus, i == 0), own[0]);
                all.append(&mut own);
            }
            all
        }
        Formula::Negative(inner) => {
            let mut own = pieces(n, inner);
            own[0] = format!("{}{}", n.sign(true, true), own[0]);
            own
        }
        Formula::Product(factors) => match over_one_stroke(n, factors) {
            Some(fraction) => pieces(n, &fraction),
            None => product_pieces(n, factors, |last| bound(n, last, Strength::Product))
                .unwrap_or_else(|| vec![formula(n, f)]),
        },
        Formula::Fraction(above, below) if n.in_line() => {
            let above = match &**above {
                Formula::Product(factors) => product_pieces(n, factors, |last| followed(n, last)),
                _ => None,
            };
            let Some(mut all) = above else {
                return vec![formula(n, f)];
            };
            if let Some(last) = all.last_mut() {
                *last = n.fraction(last, &divisor(n, below));
            }
            all
        }
        other => vec![formula(n, other)],
    }
}

/// Pieces of a product that has one long sum.
fn product_pieces(
    n: &dyn Notation,
    factors: &[Formula],
    last: impl Fn(&Formula) -> String,
) -> Option<Vec<String>> {
    let mut sums = (0..factors.len()).filter(|&i| matches!(factors[i], Formula::Sum(_)));
    let at = sums.next().filter(|&at| factors[at].size() > SHORT)?;
    if sums.next().is_some() {
        return None;
    }
    let mut all = pieces(n, &factors[at]);
    if at > 0 {
        let before = product(n, &factors[..at], |last| followed(n, last));
        all[0] = format!("{before} ({}", all[0]);
    } else {
        all[0] = format!("({}", all[0]);
    }
    let end = all.last_mut()?;
    *end += ")";
    if at + 1 < factors.len() {
        *end = format!("{end} {}", product(n, &factors[at + 1..], last));
    }
    Some(all)
}

/// `left relation right`
pub fn statement(n: &dyn Notation, s: &Statement) -> String {
    let pieces = [
        formula(n, &s.left),
        n.relation(s.relation).to_owned(),
        formula(n, &s.right),
    ];
    n.row(&pieces)
}

fn call(
    n: &dyn Notation,
    name: &str,
    exponent: Option<&str>,
    arguments: &[Formula],
    bare: bool,
) -> String {
    match arguments {
        [one] => {
            let short = matches!(
                one,
                Formula::Letter(_) | Formula::Pi | Formula::Number(_) | Formula::Decimal(_)
            );
            // `slip(grip)` is no function of numbers.
            let known = Function::from_name(name.trim_start_matches("arc")).is_some();
            n.call(name, exponent, &formula(n, one), bare && short && known)
        }
        many => {
            let list: Vec<String> = many.iter().map(|a| formula(n, a)).collect();
            n.row(&[n.letter(&Letter::of(name, "")), n.list(&list)])
        }
    }
}

/// Factors side by side, the last of them written by `last`.
fn product(n: &dyn Notation, factors: &[Formula], last: impl Fn(&Formula) -> String) -> String {
    let next = factors.iter().skip(1).map(Some).chain([None]);
    let parts: Vec<String> = factors
        .iter()
        .zip(next)
        .map(|(factor, next)| match next {
            None => last(factor),
            // A function ends where another one begins.
            Some(next) if is_function(factor) && is_function(next) => {
                bound(n, factor, Strength::Product)
            }
            Some(_) => followed(n, factor),
        })
        .collect();
    n.product(&parts)
}

/// In a line, what stands behind a fraction stands above its stroke: (a/b) c is a c/b.
fn over_one_stroke(n: &dyn Notation, factors: &[Formula]) -> Option<Formula> {
    let [Formula::Fraction(above, below), behind @ ..] = factors else {
        return None;
    };
    if !n.in_line() || behind.is_empty() {
        return None;
    }
    let above = match &**above {
        Formula::Product(factors) => factors.clone(),
        Formula::Number(number) if number.is_one() => Vec::new(),
        other => vec![other.clone()],
    };
    let above = Formula::Product([&above, behind].concat());
    Some(Formula::Fraction(Box::new(above), below.clone()))
}

/// A factor that something follows: it shows where it ends.
fn followed(n: &dyn Notation, f: &Formula) -> String {
    match f {
        Formula::Call(name, arguments) => call(n, name, None, arguments, false),
        Formula::Power(base, exponent) => match &**base {
            Formula::Call(name, arguments) if arguments.len() == 1 => {
                call(n, name, Some(&formula(n, exponent)), arguments, false)
            }
            _ => bound(n, f, Strength::Product),
        },
        Formula::Product(factors) if over_one_stroke(n, factors).is_none() => {
            product(n, factors, |last| followed(n, last))
        }
        Formula::Product(_) | Formula::Fraction(..) => {
            let text = formula(n, f);
            match n.stacked(&text) {
                true => text,
                false => n.group(&text),
            }
        }
        f => bound(n, f, Strength::Product),
    }
}

/// What stands under a stroke in a line.
fn divisor(n: &dyn Notation, below: &Formula) -> String {
    match below {
        Formula::Call(name, arguments) => call(n, name, None, arguments, false),
        other => bound(n, other, Strength::Power),
    }
}

/// In parentheses if it binds less tightly than needed.
fn bound(n: &dyn Notation, f: &Formula, least: Strength) -> String {
    let text = formula(n, f);
    match strength(f) < least {
        true => n.group(&text),
        false => text,
    }
}

fn strength(f: &Formula) -> Strength {
    match f {
        Formula::Sum(_) | Formula::Negative(_) | Formula::SumOver(..) => Strength::Sum,
        Formula::Number(number) if short_decimal(*number).is_some() => Strength::Atom,
        Formula::Number(number) if !number.is_integer() => Strength::Product,
        Formula::Product(_) | Formula::Fraction(..) | Formula::Call(..) => Strength::Product,
        Formula::Power(..) => Strength::Power,
        _ => Strength::Atom,
    }
}

fn is_function(f: &Formula) -> bool {
    match f {
        Formula::Call(..) => true,
        Formula::Power(base, _) => is_function(base),
        _ => false,
    }
}

/// A number as a decimal where that is exact and short, and the fraction is none that one knows: 49/50 is 0.98, and 7/10 stays.
fn short_decimal(number: Rational) -> Option<String> {
    /// Denominators of fractions that textbooks write.
    const KNOWN: i128 = 16;
    /// Digits behind the point.
    const PLACES: u32 = 4;
    if number.denominator() <= KNOWN {
        return None;
    }
    let places = (1..=PLACES).find(|&places| 10_i128.pow(places) % number.denominator() == 0)?;
    let scale = 10_i128.pow(places);
    let digits = number
        .numerator()
        .checked_mul(scale / number.denominator())?;
    let (whole, part) = (digits / scale, (digits % scale).abs());
    Some(format!("{whole}.{part:0width$}", width = places as usize))
}

/// The last value of an index that stays below a bound.
fn bound_by_one(to: &Formula) -> Formula {
    let one = Formula::Number(Rational::ONE);
    match to {
        Formula::Number(n) => n
            .checked_sub(Rational::ONE)
            .map_or_else(|| to.clone(), Formula::number),
        Formula::Sum(terms) if terms.last() == Some(&(false, one.clone())) => Formula::sum(
            terms[..terms.len() - 1]
                .iter()
                .map(|(minus, term)| match minus {
                    true => term.clone().negated(),
                    false => term.clone(),
                }),
        ),
        other => Formula::sum([other.clone(), one.negated()]),
    }
}
