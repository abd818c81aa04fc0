//! What is printed of an expression reads back as one of equal value, to a reader who goes from left to right, `a/b c` is
//! (a/b) c, and to one who takes what stands side by side together, `a/b c` is a/(b c).

use super::planned;
use crate::inspect::names::Names;
use crate::inspect::print::text;
use crate::inspect::readable::Reader;
use crate::symbolic::{ExprId, Function, Pool, Rational};
use quote::quote;
use std::collections::BTreeMap;
use std::iter::Peekable;
use std::str::Chars;

/// How a reader takes strokes, and arguments without parentheses.
#[derive(Clone, Copy, Debug)]
enum Habit {
    /// A stroke divides by the next factor, and the argument of a function is the next factor.
    LeftToRight,
    /// A stroke divides by all that stands side by side, and the argument of a function goes on to the next function or sign.
    SideBySide,
}

/// Reads a text and computes its value.
struct Eye<'a> {
    rest: Peekable<Chars<'a>>,
    habit: Habit,
    letters: &'a BTreeMap<String, f64>,
}

const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

const VULGAR: [(char, f64); 11] = [
    ('½', 1.0 / 2.0),
    ('⅓', 1.0 / 3.0),
    ('⅔', 2.0 / 3.0),
    ('¼', 1.0 / 4.0),
    ('¾', 3.0 / 4.0),
    ('⅕', 1.0 / 5.0),
    ('⅖', 2.0 / 5.0),
    ('⅗', 3.0 / 5.0),
    ('⅘', 4.0 / 5.0),
    ('⅙', 1.0 / 6.0),
    ('⅛', 1.0 / 8.0),
];

fn function(name: &str) -> Option<fn(f64) -> f64> {
    Some(match name {
        "sin" => f64::sin,
        "cos" => f64::cos,
        "tan" => f64::tan,
        "arctan" => f64::atan,
        "tanh" => f64::tanh,
        "exp" => f64::exp,
        "ln" => f64::ln,
        _ => return None,
    })
}

impl Eye<'_> {
    fn take(&mut self, c: char) -> bool {
        self.rest.next_if_eq(&c).is_some()
    }

    fn expect(&mut self, text: &str) {
        for c in text.chars() {
            assert!(self.take(c), "{text:?} is expected");
        }
    }

    /// Whether the rest begins with this.
    fn sees(&self, text: &str) -> bool {
        let mut rest = self.rest.clone();
        text.chars().all(|c| rest.next() == Some(c))
    }

    fn sees_function(&self) -> bool {
        let word: String = self
            .rest
            .clone()
            .take_while(char::is_ascii_alphabetic)
            .collect();
        function(&word).is_some() || ["max", "min", "sgn"].contains(&word.as_str())
    }

    fn sum(&mut self) -> f64 {
        let mut sum = match self.take('−') {
            true => -self.product(),
            false => self.product(),
        };
        loop {
            if self.sees(" + ") {
                self.expect(" + ");
                sum += self.product();
            } else if self.sees(" − ") {
                self.expect(" − ");
                sum -= self.product();
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> f64 {
        self.factors(&|_| true)
    }

    /// Factors and strokes as far as the next factor is wanted.
    fn factors(&mut self, wanted: &dyn Fn(&Self) -> bool) -> f64 {
        let mut value = self.run(wanted);
        loop {
            if self.take('/') {
                value /= self.run(wanted);
            } else if self.goes_on(wanted) {
                value *= self.run(wanted);
            } else {
                return value;
            }
        }
    }

    /// What is taken together: one factor, or all that stand side by side.
    fn run(&mut self, wanted: &dyn Fn(&Self) -> bool) -> f64 {
        let mut value = self.factor();
        while matches!(self.habit, Habit::SideBySide) && self.goes_on(wanted) {
            value *= self.factor();
        }
        value
    }

    /// Steps over the blank before another factor.
    fn goes_on(&mut self, wanted: &dyn Fn(&Self) -> bool) -> bool {
        let mut behind = self.rest.clone();
        if behind.next() != Some(' ')
            || [" + ", " − ", " if ", " ≥ "]
                .iter()
                .any(|end| self.sees(end))
        {
            return false;
        }
        let ahead = Eye {
            rest: behind,
            ..*self
        };
        if !wanted(&ahead) {
            return false;
        }
        self.take(' ')
    }

    /// A function of its argument, or a base with its exponent.
    fn factor(&mut self) -> f64 {
        let word: String = self
            .rest
            .clone()
            .take_while(char::is_ascii_alphabetic)
            .collect();
        let Some(f) = function(&word) else {
            let base = self.atom();
            return base.powf(self.exponent());
        };
        self.expect(&word);
        let exponent = self.exponent();
        let argument = match (self.take(' '), self.habit) {
            (false, _) => self.atom(),
            (true, Habit::LeftToRight) => self.atom(),
            (true, Habit::SideBySide) => self.factors(&|eye| !eye.sees_function()),
        };
        f(argument).powf(exponent)
    }

    /// The exponent that stands here, or 1.
    fn exponent(&mut self) -> f64 {
        if self.take('^') {
            return self.atom();
        }
        let mut digits = None;
        while let Some(c) = self.rest.next_if(|&c| RAISED.contains(c)) {
            let digit = RAISED
                .chars()
                .position(|known| known == c)
                .expect("a digit");
            digits = Some(10.0 * digits.unwrap_or(0.0) + digit as f64);
        }
        digits.unwrap_or(1.0)
    }

    fn atom(&mut self) -> f64 {
        if self.take('(') {
            let value = self.sum();
            self.expect(")");
            return value;
        }
        if self.take('|') {
            let value = self.sum();
            self.expect("|");
            return value.abs();
        }
        if self.take('√') {
            return self.atom().sqrt();
        }
        if self.take('{') {
            let mut then = self.sum();
            let mut chosen = None;
            loop {
                self.expect(" if ");
                let left = self.sum();
                self.expect(" ≥ ");
                let holds = left >= self.sum();
                chosen = chosen.or(holds.then_some(then));
                self.expect(", ");
                if self.sees("else ") {
                    break;
                }
                then = self.sum();
            }
            self.expect("else ");
            let otherwise = self.sum();
            self.expect("}");
            return chosen.unwrap_or(otherwise);
        }
        if let Some(&(c, value)) = self
            .rest
            .peek()
            .and_then(|c| VULGAR.iter().find(|(known, _)| known == c))
        {
            self.take(c);
            return value;
        }
        let mut word = String::new();
        let written =
            |c: char| c == '\u{307}' || c == '.' || c.is_alphanumeric() && !RAISED.contains(c);
        while let Some(c) = self.rest.next_if(|&c| written(c)) {
            word.push(c);
        }
        if let Ok(number) = word.parse() {
            return number;
        }
        if self.take('(') {
            let first = self.sum();
            let value = match word.as_str() {
                "sgn" => first.signum(),
                "max" | "min" => {
                    self.expect(", ");
                    let second = self.sum();
                    if word == "max" {
                        first.max(second)
                    } else {
                        first.min(second)
                    }
                }
                other => panic!("{other} is no function"),
            };
            self.expect(")");
            return value;
        }
        *self
            .letters
            .get(&word)
            .unwrap_or_else(|| panic!("{word:?} is no letter"))
    }
}

/// What a text says.
fn read(text: &str, habit: Habit, letters: &BTreeMap<String, f64>) -> f64 {
    let mut eye = Eye {
        rest: text.chars().peekable(),
        habit,
        letters,
    };
    let value = eye.sum();
    assert_eq!(eye.rest.collect::<String>(), "", "the rest of {text}");
    value
}

/// A random expression of these leaves; branch 0 is on `guard`.
fn random(
    dice: &mut fastrand::Rng,
    pool: &mut Pool,
    leaves: &[ExprId],
    guard: ExprId,
    depth: u32,
) -> Option<ExprId> {
    if depth == 0 {
        return Some(match dice.u8(..8) {
            0 => {
                let above = dice.i128(1..6);
                pool.number(Rational::new(above, dice.i128(1..8))?)
            }
            1 => pool.pi(),
            _ => leaves[dice.usize(..leaves.len())],
        });
    }
    let part = |pool: &mut Pool, dice: &mut fastrand::Rng| {
        let less = dice.u32(..depth);
        random(dice, pool, leaves, guard, less)
    };
    let a = part(pool, dice)?;
    let b = part(pool, dice)?;
    Some(match dice.u8(..16) {
        0..=2 => pool.add(a, b),
        3 | 4 => pool.sub(a, b),
        5..=7 => pool.mul(a, b),
        8..=10 => pool.div(a, b)?,
        11 => {
            let half = pool.number(Rational::new(dice.i128(-3..7), 2)?);
            pool.pow(a, half)?
        }
        12 => pool.pow(a, b)?,
        13 => {
            let minus = pool.neg(guard);
            let pairs = [(a, b), (guard, minus)];
            let (then, otherwise) = pairs[dice.usize(..2)];
            pool.select(0, then, otherwise)
        }
        _ => {
            let functions = [
                Function::Sin,
                Function::Cos,
                Function::Tanh,
                Function::Atan,
                Function::Exp,
            ];
            pool.call(functions[dice.usize(..functions.len())], &[a])
        }
    })
}

#[test]
fn printed_expressions_read_back() {
    let (declaration, mut program) = planned(quote! {
        #[lagrange(coordinates(x, y), kinetic = mass/2 * (der(x)^2 + der(y)^2), potential = b * y)]
        struct Particle { mass: f64, b: f64 }
    });
    let mut pool = std::mem::take(&mut program.equations.system.pool);
    let system = &program.equations.system;
    let names = Names::of(&declaration, system);
    let moving = system
        .coordinates
        .iter()
        .flat_map(|c| [c.position, c.velocity]);
    let symbols: Vec<_> = moving
        .chain(system.parameters.iter().map(|p| p.symbol))
        .collect();
    let leaves: Vec<ExprId> = symbols.iter().map(|&symbol| pool.leaf(symbol)).collect();
    let guard = pool.sub(leaves[0], leaves[2]);
    let mut dice = fastrand::Rng::with_seed(7);
    let mut compared = 0;
    for _ in 0..4000 {
        let Some(e) = random(&mut dice, &mut pool, &leaves, guard, 4) else {
            continue;
        };
        let formula = Reader::new(&mut pool, &names, vec![guard]).formula(e);
        let printed = text::formula(&formula);
        for _ in 0..3 {
            let values: Vec<f64> = symbols.iter().map(|_| 0.2 + 1.5 * dice.f64()).collect();
            let of = |symbol| values[symbols.iter().position(|&s| s == symbol).expect("a symbol")];
            let value = pool.evaluate(&[e], &of, &|_| values[0] >= values[2])[0];
            if !value.is_finite() || value.abs() > 1e6 {
                continue;
            }
            let letter = |symbol| {
                text::formula(&crate::inspect::formula::Formula::Letter(
                    names.letter(symbol),
                ))
            };
            let letters = symbols.iter().map(|&symbol| (letter(symbol), of(symbol)));
            let letters = letters
                .chain([("π".to_owned(), std::f64::consts::PI)])
                .collect();
            for habit in [Habit::LeftToRight, Habit::SideBySide] {
                let read = read(&printed, habit, &letters);
                let close = (read - value).abs() <= 1e-7 * (1.0 + value.abs());
                assert!(
                    close,
                    "{habit:?}: {printed} reads {read}; {} is {value}",
                    pool.print(e)
                );
            }
            compared += 1;
        }
    }
    assert!(compared > 5000, "{compared}");
}
