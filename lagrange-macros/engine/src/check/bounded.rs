//! Floating point with bounds of the rounding errors: two values differ only if they do beyond these.
//!
//! First-order running error analysis (Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.3).

use super::arithmetic::Arithmetic;
use crate::sorted::SortedMap;
use crate::symbolic::field::Trouble;
use crate::symbolic::{ExprId, Function, Node, Pool, Rational, Symbol};

/// A value and a bound of its error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Bounded {
    pub value: f64,
    pub error: f64,
}

/// An error is a few roundings, and library functions are off by one or two more.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Bounded {
    /// A value given to the last bit.
    pub fn exactly(value: f64) -> Bounded {
        Bounded { value, error: 0.0 }
    }

    fn rounded(value: f64, error: f64) -> Bounded {
        Bounded {
            value,
            error: error + ROUNDING * value.abs(),
        }
    }

    fn checked(self) -> Result<Bounded, Trouble> {
        if self.value.is_finite() && self.error.is_finite() {
            Ok(self)
        } else {
            Err(Trouble::Division)
        }
    }

    fn plus(self, other: Bounded) -> Bounded {
        Bounded::rounded(self.value + other.value, self.error + other.error)
    }

    fn times(self, other: Bounded) -> Bounded {
        let (a, b) = (self, other);
        let error = a.value.abs() * b.error + b.value.abs() * a.error + a.error * b.error;
        Bounded::rounded(a.value * b.value, error)
    }

    fn inverse(self) -> Result<Bounded, Trouble> {
        let least = self.value.abs() - self.error;
        if least <= 0.0 {
            return Err(Trouble::Division);
        }
        let value = 1.0 / self.value;
        Bounded::rounded(value, self.error * value.abs() / least).checked()
    }

    /// f(x) with |f′| ≤ slope near x.
    fn through(self, value: f64, slope: f64) -> Result<Bounded, Trouble> {
        Bounded::rounded(value, self.error * slope.abs()).checked()
    }

    fn power(self, r: Rational) -> Result<Bounded, Trouble> {
        let x = self.value;
        match r.to_integer() {
            Some(1) => Ok(self),
            Some(2) => Ok(self.times(self)),
            Some(-1) => self.inverse(),
            Some(n) if n.abs() < 1 << 20 => {
                let n = n as i32;
                if n < 0 && x.abs() <= self.error {
                    return Err(Trouble::Division);
                }
                let value = x.powi(n);
                let slope = f64::from(n) * x.powi(n - 1);
                let roundings = ROUNDING * f64::from(n.abs()) * value.abs();
                let bounded = self.through(value, slope)?;
                Ok(Bounded {
                    error: bounded.error + roundings,
                    ..bounded
                })
            }
            _ => {
                if x < -self.error {
                    return Err(Trouble::NotSquare);
                }
                if x <= 4.0 * self.error {
                    return Err(Trouble::Division);
                }
                let r = r.to_f64();
                let value = if r == 0.5 { x.sqrt() } else { x.powf(r) };
                self.through(value, 2.0 * r * value / x)
            }
        }
    }
}

/// A state: symbols with their values, and the guards of the branches.
pub(super) struct Floating<'a> {
    pub symbols: SortedMap<Symbol, Bounded>,
    /// ≥ 0 selects the first side.
    pub guards: &'a [ExprId],
}

impl Arithmetic for Floating<'_> {
    type Number = Bounded;

    fn values(&mut self, pool: &Pool, e: &[ExprId]) -> Result<Vec<Bounded>, Trouble> {
        let mut values = SortedMap::new();
        e.iter()
            .map(|&e| self.value(pool, e, &mut values))
            .collect()
    }

    fn bind(&mut self, symbol: Symbol, value: Bounded) {
        self.symbols.insert(symbol, value);
    }

    fn symbol(&self, symbol: Symbol) -> Bounded {
        self.symbols
            .get(&symbol)
            .copied()
            .unwrap_or(Bounded::exactly(0.0))
    }

    fn integer(&self, n: i64) -> Bounded {
        Bounded::exactly(n as f64)
    }

    fn add(&self, a: Bounded, b: Bounded) -> Bounded {
        a.plus(b)
    }

    fn sub(&self, a: Bounded, b: Bounded) -> Bounded {
        a.plus(Bounded {
            value: -b.value,
            ..b
        })
    }

    fn mul(&self, a: Bounded, b: Bounded) -> Bounded {
        a.times(b)
    }

    fn div(&self, a: Bounded, b: Bounded) -> Result<Bounded, Trouble> {
        a.times(b.inverse()?).checked()
    }

    fn sqrt(&self, a: Bounded) -> Result<Bounded, Trouble> {
        a.power(Rational::HALF)
    }

    fn size(&self, a: Bounded) -> f64 {
        if a.value.abs() <= 8.0 * a.error {
            0.0
        } else {
            a.value.abs()
        }
    }
}

impl Floating<'_> {
    /// The value of e, children first; of a selection only the side that holds.
    fn value(
        &self,
        pool: &Pool,
        e: ExprId,
        known: &mut SortedMap<ExprId, Bounded>,
    ) -> Result<Bounded, Trouble> {
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            if !known.contains_key(&top) {
                let height = stack.len();
                self.missing(pool, top, known, &mut stack)?;
                if stack.len() > height {
                    continue;
                }
                let value = self.of_children(pool, top, known)?.checked()?;
                known.insert(top, value);
            }
            stack.pop();
        }
        known.get(&e).copied().ok_or(Trouble::Beyond)
    }

    /// Adds what the value of e needs and is not known yet.
    fn missing(
        &self,
        pool: &Pool,
        e: ExprId,
        known: &SortedMap<ExprId, Bounded>,
        stack: &mut Vec<ExprId>,
    ) -> Result<(), Trouble> {
        let mut need = |e: ExprId| {
            if !known.contains_key(&e) {
                stack.push(e);
            }
        };
        if let Node::Select { branch, .. } = pool.node(e) {
            let guard = *self.guards.get(*branch).ok_or(Trouble::Beyond)?;
            match known.get(&guard) {
                None => need(guard),
                Some(_) => need(self.side(pool, e, known)?),
            }
        } else {
            pool.node(e).for_each_child(need);
        }
        Ok(())
    }

    /// The side of a selection whose guard is known.
    fn side(
        &self,
        pool: &Pool,
        e: ExprId,
        known: &SortedMap<ExprId, Bounded>,
    ) -> Result<ExprId, Trouble> {
        let Node::Select {
            branch,
            then,
            otherwise,
        } = pool.node(e)
        else {
            return Err(Trouble::Beyond);
        };
        let guard = self.guards.get(*branch).and_then(|guard| known.get(guard));
        let guard = guard.ok_or(Trouble::Beyond)?;
        if guard.value.abs() <= 8.0 * guard.error {
            return Err(Trouble::Division);
        }
        Ok(if guard.value > 0.0 { *then } else { *otherwise })
    }

    fn of_children(
        &self,
        pool: &Pool,
        e: ExprId,
        known: &SortedMap<ExprId, Bounded>,
    ) -> Result<Bounded, Trouble> {
        let at = |e: ExprId| known.get(&e).copied().ok_or(Trouble::Beyond);
        let number = |n: Rational| Bounded::rounded(n.to_f64(), 0.0);
        Ok(match pool.node(e) {
            Node::Number(n) => number(*n),
            Node::Pi => Bounded::rounded(std::f64::consts::PI, 0.0),
            Node::Symbol(symbol) => self.symbols.get(symbol).copied().ok_or(Trouble::Beyond)?,
            Node::Sum { constant, terms } => {
                let mut sum = number(*constant);
                for &(term, c) in terms {
                    sum = sum.plus(number(c).times(at(term)?));
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = Bounded::exactly(1.0);
                for &(base, exponent) in factors {
                    product = product.times(at(base)?.power(exponent)?);
                }
                product
            }
            Node::Power(base, exponent) => {
                let (x, y) = (at(*base)?, at(*exponent)?);
                if x.value <= 4.0 * x.error {
                    return Err(Trouble::NotSquare);
                }
                let value = x.value.powf(y.value);
                let slope =
                    x.error * 2.0 * (y.value / x.value).abs() + y.error * x.value.ln().abs();
                Bounded::rounded(value, value.abs() * slope)
            }
            Node::Call(Function::Atan2, arguments) => {
                let (y, x) = (at(arguments[0])?, at(arguments[1])?);
                let square = x.value * x.value + y.value * y.value;
                let error = (x.error * y.value.abs() + y.error * x.value.abs()) / square;
                // Beyond the cut the value jumps.
                if y.value.abs() <= 8.0 * y.error && x.value < 0.0 {
                    return Err(Trouble::Division);
                }
                Bounded::rounded(y.value.atan2(x.value), error)
            }
            Node::Call(f, arguments) => call(*f, at(arguments[0])?)?,
            Node::Group(e) => at(*e)?,
            Node::Select { .. } => at(self.side(pool, e, known)?)?,
        })
    }
}

/// f(x) of one argument.
fn call(f: Function, u: Bounded) -> Result<Bounded, Trouble> {
    let x = u.value;
    let inside = 1.0 - x * x;
    match f {
        Function::Sin => u.through(x.sin(), 1.0),
        Function::Cos => u.through(x.cos(), 1.0),
        Function::Tan => u.through(x.tan(), 2.0 / (x.cos() * x.cos())),
        Function::Asin | Function::Acos if inside <= 8.0 * u.error => Err(Trouble::NotSquare),
        Function::Asin => u.through(x.asin(), 2.0 / inside.sqrt()),
        Function::Acos => u.through(x.acos(), 2.0 / inside.sqrt()),
        Function::Atan | Function::Atan2 => u.through(x.atan(), 1.0),
        Function::Sinh => u.through(x.sinh(), 2.0 * x.cosh()),
        Function::Cosh => u.through(x.cosh(), 2.0 * x.cosh()),
        Function::Tanh => u.through(x.tanh(), 1.0),
        Function::Exp => u.through(x.exp(), 2.0 * x.exp()),
        Function::Ln if x <= 4.0 * u.error => Err(Trouble::NotSquare),
        Function::Ln => u.through(x.ln(), 2.0 / x),
    }
}
