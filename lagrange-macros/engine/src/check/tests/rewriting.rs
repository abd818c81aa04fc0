//! Textbook transformations of expressions, and mistakes in them; values in plain f64.

use crate::ast::{Claim, Decimal, Expr, ExprKind, Factor, ItemKind, Sign};
use crate::diagnostics::Diagnostics;
use std::collections::BTreeMap;

/// An expression of the language.
pub fn expr(text: &str) -> Expr {
    let tokens = format!("#[lagrange(check({text} == 0))] struct S {{}}");
    let mut sink = Diagnostics::new();
    let declaration = crate::parse::declaration(tokens.parse().unwrap(), &mut sink);
    let items = declaration
        .unwrap_or_else(|| panic!("{text}: {sink}"))
        .items;
    match items.into_iter().next().map(|item| item.kind) {
        Some(ItemKind::Check(check)) => match check.claim {
            Claim::Equal(left, _) => left,
            Claim::Conserved(_) => panic!("{text}"),
        },
        _ => panic!("{text}"),
    }
}

/// Values by name; a velocity is `der(x)`.
pub type State = BTreeMap<String, f64>;

/// The plain meaning.
pub fn value(e: &Expr, state: &State) -> f64 {
    let at = |e: &Expr| value(e, state);
    match &e.kind {
        ExprKind::Number(n) => n.digits as f64 * 10f64.powi(n.exponent),
        ExprKind::Name(name) if name.text == "pi" => std::f64::consts::PI,
        ExprKind::Name(name) => state[&name.text],
        ExprKind::Sum(terms) => terms
            .iter()
            .map(|(sign, e)| if *sign == Sign::Plus { at(e) } else { -at(e) })
            .sum(),
        ExprKind::Product(factors) => factors.iter().fold(1.0, |p, (side, e)| match side {
            Factor::Times => p * at(e),
            Factor::Over => p / at(e),
        }),
        ExprKind::Negative(e) => -at(e),
        ExprKind::Power(a, b) => at(a).powf(at(b)),
        ExprKind::Call(name, arguments) => {
            let u = &arguments[0];
            match name.text.as_str() {
                "der" => state[&format!("der({u})")],
                "sin" => at(u).sin(),
                "cos" => at(u).cos(),
                "tan" => at(u).tan(),
                "exp" => at(u).exp(),
                "sqrt" => at(u).sqrt(),
                other => panic!("{other}"),
            }
        }
        other => panic!("{other:?}"),
    }
}

/// A seeded choice.
pub struct Dice(fastrand::Rng);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    pub fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }

    pub fn unit(&mut self) -> f64 {
        self.0.f64()
    }
}

fn with(e: &Expr, kind: ExprKind) -> Expr {
    Expr {
        kind,
        extent: e.extent,
    }
}

fn number(e: &Expr, digits: i128) -> Expr {
    with(
        e,
        ExprKind::Number(Decimal {
            digits,
            exponent: 0,
        }),
    )
}

fn product(e: &Expr, factors: Vec<Expr>) -> Expr {
    let factors = factors.into_iter().map(|f| (Factor::Times, f)).collect();
    with(e, ExprKind::Product(factors))
}

/// Number of sub-expressions, arguments of `der` left out.
pub fn size(e: &Expr) -> usize {
    let mut count = 0;
    visit(&mut e.clone(), &mut |_| count += 1);
    count
}

/// Calls f for every sub-expression.
fn visit(e: &mut Expr, f: &mut impl FnMut(&mut Expr)) {
    match &mut e.kind {
        ExprKind::Sum(terms) => terms.iter_mut().for_each(|(_, e)| visit(e, f)),
        ExprKind::Product(factors) => factors.iter_mut().for_each(|(_, e)| visit(e, f)),
        ExprKind::Negative(inner) => visit(inner, f),
        ExprKind::Power(base, _) => visit(base, f),
        ExprKind::Call(name, arguments) if name.text != "der" => {
            arguments.iter_mut().for_each(|e| visit(e, f));
        }
        _ => {}
    }
    f(e);
}

/// Replaces the nth sub-expression by what `change` makes of it; whether there was something to change.
fn change_at(e: &mut Expr, n: usize, change: impl Fn(&Expr) -> Option<Expr>) -> bool {
    let (mut at, mut done) = (0, false);
    visit(e, &mut |part| {
        if at == n
            && let Some(new) = change(part)
        {
            *part = new;
            done = true;
        }
        at += 1;
    });
    done
}

/// An equal expression in another form. `other`: an angle to split others with; `zeros`: what vanishes in the mode.
pub fn transformed(e: &Expr, dice: &mut Dice, other: &str, zeros: &[&str]) -> Expr {
    let mut e = e.clone();
    let mut left = 3;
    while left > 0 {
        let (n, kind, coin) = (dice.below(size(&e)), dice.below(9), dice.below(1 << 16));
        left -= usize::from(change_at(&mut e, n, |part| {
            rewritten(part, kind, coin, other, zeros)
        }));
    }
    e
}

fn rewritten(e: &Expr, kind: usize, coin: usize, other: &str, zeros: &[&str]) -> Option<Expr> {
    let circular = match &e.kind {
        ExprKind::Call(name, arguments) if matches!(&*name.text, "sin" | "cos") => {
            Some((name.text == "sin", &arguments[0]))
        }
        _ => None,
    };
    let is_scalar = !matches!(e.kind, ExprKind::Number(_));
    match kind {
        // Half angles.
        0 => {
            let (sine, u) = circular?;
            Some(expr(&match (sine, coin % 2) {
                (true, _) => format!("(2*sin(({u})/2)*cos(({u})/2))"),
                (false, 0) => format!("(1 - 2*sin(({u})/2)^2)"),
                (false, _) => format!("(2*cos(({u})/2)^2 - 1)"),
            }))
        }
        // Another angle added and taken away.
        1 => {
            let (sine, u) = circular?;
            Some(expr(&if sine {
                format!("(sin({u} + {other})*cos({other}) - cos({u} + {other})*sin({other}))")
            } else {
                format!("(cos({u} + {other})*cos({other}) + sin({u} + {other})*sin({other}))")
            }))
        }
        // A quarter turn.
        2 => {
            let (sine, u) = circular?;
            Some(expr(&if sine {
                format!("cos({u} - pi/2)")
            } else {
                format!("sin({u} + 5*pi/2)")
            }))
        }
        // sin² = 1 − cos², on a square of anything: a² = (a + b)(a − b) + b².
        3 => match &e.kind {
            ExprKind::Power(base, exponent) if exponent.to_string() == "2" => {
                Some(expr(&match &base.kind {
                    ExprKind::Call(f, u) if f.text == "sin" => format!("(1 - cos({})^2)", u[0]),
                    ExprKind::Call(f, u) if f.text == "cos" => {
                        format!("((1 + cos(2*({})))/2)", u[0])
                    }
                    _ => format!("((({base}) + {other})*(({base}) - {other}) + {other}^2)"),
                }))
            }
            _ => None,
        },
        // Sums in another order.
        4 => match &e.kind {
            ExprKind::Sum(terms) => {
                let mut terms = terms.clone();
                terms.rotate_left(1);
                // A leading minus is written as a product.
                let first = &mut terms[0];
                if first.0 == Sign::Minus {
                    let minus = with(e, ExprKind::Negative(Box::new(number(e, 1))));
                    *first = (Sign::Plus, product(e, vec![minus, first.1.clone()]));
                }
                Some(with(e, ExprKind::Sum(terms)))
            }
            _ => None,
        },
        // A product over a sum multiplied out.
        5 => match &e.kind {
            ExprKind::Product(factors) => {
                let at = factors.iter().position(|(side, f)| {
                    *side == Factor::Times && matches!(f.kind, ExprKind::Sum(_))
                })?;
                let ExprKind::Sum(terms) = &factors[at].1.kind else {
                    return None;
                };
                let terms = terms.iter().map(|(sign, term)| {
                    let mut factors = factors.clone();
                    factors[at].1 = term.clone();
                    (*sign, with(e, ExprKind::Product(factors)))
                });
                Some(with(e, ExprKind::Sum(terms.collect())))
            }
            _ => None,
        },
        // Numerator and denominator times the same.
        6 if is_scalar => Some(expr(&format!("(({e})*(1 + {other}^2)/(1 + {other}^2))"))),
        7 if is_scalar => Some(expr(&match coin % 3 {
            0 => format!("(({e})*(sin({other})^2 + cos({other})^2))"),
            1 => format!("(({e})*(1/cos({other})^2 - tan({other})^2))"),
            _ => format!("(({e})*exp({other}/3)^3*exp(-{other}))"),
        })),
        // What vanishes, times anything.
        8 if is_scalar && !zeros.is_empty() => {
            let zero = zeros[coin % zeros.len()];
            Some(expr(&format!("({e} + ({zero})*({other} + 7*({e})))")))
        }
        _ => None,
    }
}

/// The same with one mistake.
pub fn mistaken(e: &Expr, dice: &mut Dice) -> Expr {
    loop {
        let mut e = e.clone();
        let (n, kind, coin) = (dice.below(size(&e)), dice.below(6), dice.below(1 << 16));
        if change_at(&mut e, n, |part| mistake(part, kind, coin)) {
            return e;
        }
    }
}

fn mistake(e: &Expr, kind: usize, coin: usize) -> Option<Expr> {
    match (kind, &e.kind) {
        // A sign.
        (0, ExprKind::Sum(terms)) => {
            let mut terms = terms.clone();
            let at = 1 + coin % (terms.len() - 1);
            terms[at].0 = if terms[at].0 == Sign::Plus {
                Sign::Minus
            } else {
                Sign::Plus
            };
            Some(with(e, ExprKind::Sum(terms)))
        }
        // A term forgotten.
        (1, ExprKind::Sum(terms)) => {
            let mut terms = terms.clone();
            terms.truncate(terms.len() - 1);
            Some(with(e, ExprKind::Sum(terms)))
        }
        // A number, a little or a lot.
        (2, ExprKind::Number(n)) => Some(if coin.is_multiple_of(2) {
            number(e, n.digits + 1)
        } else {
            expr(&format!("({e} + 1/1000000)"))
        }),
        // Sine for cosine.
        (3, ExprKind::Call(f, u)) if f.text == "sin" => Some(expr(&format!("cos({})", u[0]))),
        (3, ExprKind::Call(f, u)) if f.text == "cos" => Some(expr(&format!("sin({})", u[0]))),
        // A factor that is nearly 1.
        (4, ExprKind::Name(_) | ExprKind::Call(..)) => Some(expr(&format!("({e}*1.000000001)"))),
        // A square forgotten.
        (5, ExprKind::Power(base, _)) => Some((**base).clone()),
        _ => None,
    }
}
