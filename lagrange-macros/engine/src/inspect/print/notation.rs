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
    fn cases(&self, condition: &str, then: &str, otherwise: &str) -> String;
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
        Formula::Number(number) => n.number(*number),
        Formula::Pi => n.letter(&Letter::of("π", "")),
        Formula::Letter(letter) => n.letter(letter),
        Formula::Sum(_) => n.row(&terms(n, f)),
        Formula::Product(factors) => {
            let last = factors.len() - 1;
            let parts: Vec<String> = factors
                .iter()
                .enumerate()
                .map(|(i, factor)| match factor {
                    // A function that something follows shows where its argument ends.
                    Formula::Call(name, arguments) if i < last && !is_function(&factors[i + 1]) => {
                        call(n, name, None, arguments, false)
                    }
                    factor => bound(n, factor, Strength::Product),
                })
                .collect();
            n.product(&parts)
        }
        Formula::Negative(inner) => n.row(&[
            n.sign(true, true).to_owned(),
            bound(n, inner, Strength::Product),
        ]),
        Formula::Fraction(above, below) if n.in_line() => {
            let above = match &**above {
                Formula::Call(name, arguments) => call(n, name, None, arguments, false),
                other => bound(n, other, Strength::Product),
            };
            let below = match &**below {
                Formula::Call(name, arguments) => call(n, name, None, arguments, false),
                other => bound(n, other, Strength::Power),
            };
            n.fraction(&above, &below)
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
        Formula::Cases(condition, then, otherwise) => n.cases(
            &statement(n, condition),
            &formula(n, then),
            &formula(n, otherwise),
        ),
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
                    Formula::Product(_) => pieces(n, term),
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
        Formula::Product(factors) => {
            let sums = factors.iter().filter(|f| matches!(f, Formula::Sum(_)));
            let at = factors.iter().rposition(|f| matches!(f, Formula::Sum(_)));
            let Some(at) = at.filter(|&at| sums.count() == 1 && factors[at].size() > SHORT) else {
                return vec![formula(n, f)];
            };
            let mut all = pieces(n, &factors[at]);
            let side = |list: &[Formula]| match list {
                [] => String::new(),
                list => formula(n, &Formula::Product(list.to_vec())),
            };
            let (before, after) = (side(&factors[..at]), side(&factors[at + 1..]));
            let space = |text: &str| if text.is_empty() { "" } else { " " };
            all[0] = format!("{before}{}({}", space(&before), all[0]);
            if let Some(last) = all.last_mut() {
                *last = format!("{last}){}{after}", space(&after));
            }
            all
        }
        other => vec![formula(n, other)],
    }
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
            let short = matches!(one, Formula::Letter(_) | Formula::Pi | Formula::Number(_));
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

/// In parentheses if it binds less tightly than needed.
fn bound(n: &dyn Notation, f: &Formula, least: Strength) -> String {
    let text = formula(n, f);
    match strength(n, f) < least {
        true => n.group(&text),
        false => text,
    }
}

fn strength(n: &dyn Notation, f: &Formula) -> Strength {
    match f {
        Formula::Sum(_) | Formula::Negative(_) | Formula::SumOver(..) => Strength::Sum,
        Formula::Number(number) if !number.is_integer() => Strength::Product,
        Formula::Product(_) => Strength::Product,
        Formula::Fraction(..) if n.in_line() => Strength::Product,
        Formula::Fraction(..) | Formula::Call(..) => Strength::Product,
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
