//! Random expressions without unit: how each is written, and its value by a second way that knows nothing of parsers and pools.

use crate::Random;
use lagrange_core::arithmetic::{Dual, Scalar};
use std::rc::Rc;

/// A value and its rate.
pub type Jet = Dual<f64, 1>;

/// The value of an expression from those of the leaves.
type Evaluation = dyn Fn(&[Jet]) -> Jet;

/// An expression, as it is written and as it is evaluated from the values of the [`Leaf`]s.
#[derive(Clone)]
pub struct Term {
    /// In the language.
    pub text: String,
    binding: Binding,
    value: Rc<Evaluation>,
}

/// How tightly an expression binds; looser ones stand in parentheses inside tighter ones.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

/// What an expression may depend on; each level has those above it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Parameters and the time.
    Fixed,
    /// And positions.
    Position,
    /// And velocities.
    Velocity,
}

/// Which kinks an expression may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kinks {
    /// None.
    Smooth,
    /// Those of `abs`, `min` and `max`.
    Continuous,
    /// And jumps.
    Any,
}

/// A number that the expressions are made of.
#[derive(Clone)]
pub struct Leaf {
    /// In the language.
    pub text: String,
    /// What it depends on.
    pub level: Level,
}

/// Writes expressions.
pub struct Writer<'a> {
    /// Source of what is random.
    pub random: &'a mut Random,
    /// What there is.
    pub leaves: &'a [Leaf],
    /// Number of the next index of a sum.
    pub index: &'a mut usize,
    /// Which kinks are wanted.
    pub kinks: Kinks,
}

impl Term {
    /// The value and its rate.
    pub fn at(&self, leaves: &[Jet]) -> Jet {
        (self.value)(leaves)
    }

    fn new(text: String, binding: Binding, value: impl Fn(&[Jet]) -> Jet + 'static) -> Self {
        Self {
            text,
            binding,
            value: Rc::new(value),
        }
    }

    /// Its text inside something that binds so tightly.
    fn inside(&self, binding: Binding) -> String {
        match self.binding >= binding {
            true => self.text.clone(),
            false => format!("({})", self.text),
        }
    }

    fn number(text: &str, binding: Binding, value: f64) -> Self {
        Self::new(text.to_owned(), binding, move |_| Jet::constant(value))
    }

    fn call(self, name: &str, of: fn(Jet) -> Jet) -> Self {
        let text = format!("{name}({})", self.text);
        Self::new(text, Binding::Atom, move |x| of(self.at(x)))
    }

    fn call_of_two(self, other: Self, name: &str, of: fn(Jet, Jet) -> Jet) -> Self {
        let text = format!("{name}({}, {})", self.text, other.text);
        Self::new(text, Binding::Atom, move |x| of(self.at(x), other.at(x)))
    }

    fn plus(self, other: Self) -> Self {
        let text = format!("{} + {}", self.text, other.inside(Binding::Product));
        Self::new(text, Binding::Sum, move |x| self.at(x) + other.at(x))
    }

    fn minus(self, other: Self) -> Self {
        let text = format!("{} - {}", self.text, other.inside(Binding::Product));
        Self::new(text, Binding::Sum, move |x| self.at(x) - other.at(x))
    }

    fn times(self, other: Self) -> Self {
        let (left, right) = (self.inside(Binding::Product), other.inside(Binding::Power));
        Self::new(format!("{left}*{right}"), Binding::Product, move |x| {
            self.at(x) * other.at(x)
        })
    }

    fn over(self, other: Self) -> Self {
        let (left, right) = (self.inside(Binding::Product), other.inside(Binding::Power));
        Self::new(format!("{left}/{right}"), Binding::Product, move |x| {
            self.at(x) / other.at(x)
        })
    }

    fn negative(self) -> Self {
        let text = format!("-{}", self.inside(Binding::Product));
        Self::new(text, Binding::Sum, move |x| -self.at(x))
    }

    fn power(self, text: &str, exponent: f64) -> Self {
        let text = format!("{}^{text}", self.inside(Binding::Atom));
        Self::new(text, Binding::Power, move |x| self.at(x).powf(exponent))
    }

    fn square(self) -> Self {
        let text = format!("{}^2", self.inside(Binding::Atom));
        Self::new(text, Binding::Power, move |x| {
            let base = self.at(x);
            base * base
        })
    }

    /// 1 + e², for roots, logarithms and denominators.
    fn positive(self) -> Self {
        Self::number("1", Binding::Atom, 1.0).plus(self.square())
    }

    /// tanh(e)/2, for functions with a bounded domain.
    fn bounded(self) -> Self {
        let half = Self::number("2", Binding::Atom, 2.0);
        self.call("tanh", Jet::tanh).over(half)
    }
}

const NUMBERS: [(&str, Binding, f64); 8] = [
    ("2", Binding::Atom, 2.0),
    ("0.25", Binding::Atom, 0.25),
    ("1e-1", Binding::Atom, 0.1),
    ("1/3", Binding::Product, 1.0 / 3.0),
    ("3/7", Binding::Product, 3.0 / 7.0),
    ("pi", Binding::Atom, core::f64::consts::PI),
    ("pi/4", Binding::Product, core::f64::consts::FRAC_PI_4),
    ("1.5", Binding::Atom, 1.5),
];

const EXPONENTS: [(&str, f64); 6] = [
    ("(1/2)", 0.5),
    ("(-1)", -1.0),
    ("-2", -2.0),
    ("(3/2)", 1.5),
    ("(-1/3)", -1.0 / 3.0),
    ("3", 3.0),
];

impl Writer<'_> {
    /// An expression of so many levels at most, of what is allowed at `level`.
    pub fn term(&mut self, level: Level, depth: usize) -> Term {
        if depth == 0 || self.random.below(7) == 0 {
            return self.leaf(level);
        }
        // Half of all operations are those of arithmetic.
        match self.random.below(4) {
            0 | 1 => self.arithmetic(level, depth - 1),
            2 => self.function(level, depth - 1),
            _ => self.structure(level, depth - 1),
        }
    }

    fn leaf(&mut self, level: Level) -> Term {
        if self.random.below(5) == 0 {
            let (text, binding, value) = NUMBERS[self.random.below(NUMBERS.len())];
            return Term::number(text, binding, value);
        }
        // The first leaf has a unit.
        let known = self.leaves.iter().enumerate().skip(1);
        let known: Vec<_> = known.filter(|(_, leaf)| leaf.level <= level).collect();
        let (place, leaf) = known[self.random.below(known.len())];
        let binding = match leaf.text.contains(['*', '/']) {
            true => Binding::Product,
            false => Binding::Atom,
        };
        Term::new(leaf.text.clone(), binding, move |x| x[place])
    }

    fn arithmetic(&mut self, level: Level, depth: usize) -> Term {
        let kind = self.random.below(7);
        let a = self.term(level, depth);
        match kind {
            0 => a.plus(self.term(level, depth)),
            1 => a.minus(self.term(level, depth)),
            2 => a.times(self.term(level, depth)),
            3 => a.over(self.term(level, depth).positive()),
            4 => a.negative(),
            5 => a.square(),
            _ => {
                let (text, exponent) = EXPONENTS[self.random.below(EXPONENTS.len())];
                a.positive().power(text, exponent)
            }
        }
    }

    fn function(&mut self, level: Level, depth: usize) -> Term {
        let kinked = match self.kinks {
            Kinks::Smooth => 0,
            Kinks::Continuous => 3,
            Kinks::Any => 5,
        };
        let kind = self.random.below(15 + kinked);
        let a = self.term(level, depth);
        match kind {
            0 => a.call("sin", |x| x.sin_cos().0),
            1 => a.call("cos", |x| x.sin_cos().1),
            2 => a.bounded().call("tan", Jet::tan),
            3 => a.bounded().call("asin", Jet::asin),
            4 => a.bounded().call("acos", Jet::acos),
            5 => a.call("atan", Jet::atan),
            6 => {
                let other = self.term(level, depth);
                a.call_of_two(other.positive(), "atan2", Jet::atan2)
            }
            7 => a.bounded().call("sinh", |x| x.sinh_cosh().0),
            8 => a.bounded().call("cosh", |x| x.sinh_cosh().1),
            9 => a.call("tanh", Jet::tanh),
            10 => a.bounded().call("exp", Jet::exp),
            11 => a.positive().call("ln", Jet::ln),
            12 => a.positive().call("sqrt", Jet::sqrt),
            13 => {
                let (base, exponent) = (a.positive(), self.term(level, depth).bounded());
                let text = format!("({})^({})", base.text, exponent.text);
                Term::new(text, Binding::Power, move |x| {
                    (exponent.at(x) * base.at(x).ln()).exp()
                })
            }
            14 => {
                let (b, c) = (self.term(level, depth), self.term(level, depth));
                let text = format!("norm([{}, 1, {}, {}])", a.text, b.text, c.text);
                Term::new(text, Binding::Atom, move |x| {
                    let squares = [a.at(x), b.at(x), c.at(x)].map(|e| e * e);
                    (Jet::constant(1.0) + squares[0] + squares[1] + squares[2]).sqrt()
                })
            }
            15 => a.call("abs", |x| if x.value < 0.0 { -x } else { x }),
            16 => {
                let other = self.term(level, depth);
                a.call_of_two(other, "min", |x, y| if x.value <= y.value { x } else { y })
            }
            17 => {
                let other = self.term(level, depth);
                a.call_of_two(other, "max", |x, y| if x.value >= y.value { x } else { y })
            }
            18 => a.call("sign", |x| {
                Jet::constant(if x.value < 0.0 { -1.0 } else { 1.0 })
            }),
            _ => {
                let (b, c) = (self.term(level, depth), self.term(level, depth));
                let text = format!("if({} >= 1/5, {}, {})", a.text, b.text, c.text);
                Term::new(text, Binding::Atom, move |x| match a.at(x).value >= 0.2 {
                    true => b.at(x),
                    false => c.at(x),
                })
            }
        }
    }

    /// Lists, sums over an index, and derivatives.
    fn structure(&mut self, level: Level, depth: usize) -> Term {
        let kind = self.random.below(5);
        if kind == 0 && level >= Level::Velocity {
            let a = self.term(Level::Position, depth);
            let text = format!("second*der({})", a.text);
            // The first leaf is the unit of time.
            return Term::new(text, Binding::Product, move |x| {
                Jet::constant(x[0].value * a.at(x).derivative[0])
            });
        }
        let a = self.term(level, depth);
        let k = *self.index;
        *self.index += 1;
        match kind {
            0 | 1 => {
                let text = format!("sum(k{k} in 0..3: cos(k{k}*{}))", a.inside(Binding::Atom));
                Term::new(text, Binding::Atom, move |x| {
                    let a = a.at(x);
                    let cosines = [0.0, 1.0, 2.0].map(|k| (Jet::constant(k) * a).sin_cos().1);
                    cosines[0] + cosines[1] + cosines[2]
                })
            }
            2 => {
                let b = self.term(level, depth);
                let text = format!("dot([{}, {}], ({}, 2))", a.text, b.text, b.text);
                Term::new(text, Binding::Atom, move |x| {
                    a.at(x) * b.at(x) + Jet::constant(2.0) * b.at(x)
                })
            }
            3 => {
                let (b, c) = (self.term(level, depth), self.term(level, depth));
                let text = format!(
                    "cross([{}, {}, 1], [1, {}, {}])[1]",
                    a.text, b.text, c.text, b.text
                );
                Term::new(text, Binding::Atom, move |x| {
                    Jet::constant(1.0) - a.at(x) * b.at(x)
                })
            }
            _ => {
                let text = format!("list(k{k} in 0..3: {} - k{k})[2]", a.inside(Binding::Sum));
                Term::new(text, Binding::Atom, move |x| a.at(x) - Jet::constant(2.0))
            }
        }
    }
}
