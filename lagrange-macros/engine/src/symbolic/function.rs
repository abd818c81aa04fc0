//! Calls: parities, exact values, and inverse functions that cancel.

use super::{ExprId, Function, Node, Pool, Rational};

impl Pool {
    /// f(arguments)
    pub fn call(&mut self, f: Function, arguments: &[ExprId]) -> ExprId {
        let u = arguments[0];
        let known = match f {
            Function::Sin => self.sine(u, 0),
            Function::Cos => self.sine(u, 1),
            Function::Atan2 => self.arc_tangent_of(u, arguments[1]),
            _ => self.at_number(f, u).or_else(|| self.of_inverse(f, u)),
        };
        if let Some(known) = known {
            return known;
        }
        match f {
            Function::Tan | Function::Asin | Function::Atan | Function::Sinh | Function::Tanh
                if self.leads_negative(u) =>
            {
                let opposite = self.neg(u);
                let value = self.call(f, &[opposite]);
                self.neg(value)
            }
            Function::Cosh if self.leads_negative(u) => {
                let opposite = self.neg(u);
                self.call(f, &[opposite])
            }
            _ => self.intern(Node::Call(f, arguments.to_vec())),
        }
    }

    /// sin(u + quarters·π/2): multiples of π/2 are taken out of u, its sign is made canonical.
    fn sine(&mut self, u: ExprId, quarters: i64) -> Option<ExprId> {
        let turns = self.pi_coefficient(u);
        if turns.is_zero() {
            return self.sine_of_rest(u, quarters);
        }
        let halves = self.times(turns, Rational::integer(2));
        if halves.is_integer() {
            let pi = self.pi();
            let whole = self.negative(turns);
            let rest = self.linear(Rational::ZERO, vec![(u, Rational::ONE), (pi, whole)]);
            let quarters = quarters + i64::try_from(halves.numerator().rem_euclid(4)).ok()?;
            let f = if quarters % 2 == 0 {
                Function::Sin
            } else {
                Function::Cos
            };
            let value = self.call(f, &[rest]);
            return Some(if quarters.rem_euclid(4) >= 2 {
                self.neg(value)
            } else {
                value
            });
        }
        let pi = self.pi();
        if self.scale(pi, turns) == u
            && let Some(value) = self.sine_at(turns, quarters)
        {
            return Some(value);
        }
        self.sine_of_rest(u, quarters)
    }

    /// sin or cos of an argument without multiple of π/2.
    fn sine_of_rest(&mut self, u: ExprId, quarters: i64) -> Option<ExprId> {
        let cosine = quarters == 1;
        let inverse = if cosine {
            Function::Acos
        } else {
            Function::Asin
        };
        match self.node(u) {
            Node::Number(n) if n.is_zero() => Some(self.integer(quarters)),
            Node::Call(f, arguments) if *f == inverse => Some(arguments[0]),
            _ if self.leads_negative(u) => {
                let opposite = self.neg(u);
                let f = if cosine { Function::Cos } else { Function::Sin };
                let value = self.call(f, &[opposite]);
                Some(if cosine { value } else { self.neg(value) })
            }
            _ => None,
        }
    }

    /// sin(π·(turns + quarters/2)) at the angles with a simple value.
    fn sine_at(&mut self, turns: Rational, quarters: i64) -> Option<ExprId> {
        let angle = turns.checked_add(Rational::new(i128::from(quarters), 2)?)?;
        // Reduce modulo 2 to [0, 2), then to the first quadrant.
        let circles = Rational::new(angle.checked_mul(Rational::HALF)?.floor(), 1)?;
        let angle = angle.checked_sub(circles.checked_mul(Rational::integer(2))?)?;
        let negative = angle >= Rational::ONE;
        let angle = if negative {
            angle.checked_sub(Rational::ONE)?
        } else {
            angle
        };
        let angle = if angle > Rational::HALF {
            Rational::ONE.checked_sub(angle)?
        } else {
            angle
        };
        let square = match (angle.numerator(), angle.denominator()) {
            (1, 6) => Rational::new(1, 4)?,
            (1, 4) => Rational::HALF,
            (1, 3) => Rational::new(3, 4)?,
            _ => return None,
        };
        let square = self.number(square);
        let value = self.sqrt(square);
        Some(if negative { self.neg(value) } else { value })
    }

    /// Coefficient of π in a sum.
    fn pi_coefficient(&self, u: ExprId) -> Rational {
        let Some(pi) = self.pi else {
            return Rational::ZERO;
        };
        match self.node(u) {
            Node::Pi => Rational::ONE,
            Node::Sum { terms, .. } => match terms.binary_search_by_key(&pi, |&(e, _)| e) {
                Ok(at) => terms[at].1,
                Err(_) => Rational::ZERO,
            },
            _ => Rational::ZERO,
        }
    }

    /// Values at 0, ±1, ±1/2.
    fn at_number(&mut self, f: Function, u: ExprId) -> Option<ExprId> {
        let n = self.as_number(u)?;
        let value = (n.numerator(), n.denominator());
        let of_pi = |num, den| Rational::new(num, den);
        let multiple = match (f, value) {
            (
                Function::Tan | Function::Asin | Function::Atan | Function::Sinh | Function::Tanh,
                (0, 1),
            )
            | (Function::Ln, (1, 1)) => return Some(self.integer(0)),
            (Function::Exp | Function::Cosh, (0, 1)) => return Some(self.integer(1)),
            (Function::Acos, (1, 1)) => return Some(self.integer(0)),
            (Function::Asin, (1, 1)) | (Function::Acos, (0, 1)) => of_pi(1, 2),
            (Function::Asin, (1, 2)) => of_pi(1, 6),
            (Function::Acos, (1, 2)) => of_pi(1, 3),
            (Function::Acos, (-1, 2)) => of_pi(2, 3),
            (Function::Acos, (-1, 1)) => of_pi(1, 1),
            (Function::Atan, (1, 1)) => of_pi(1, 4),
            _ => None,
        }?;
        let pi = self.pi();
        Some(self.scale(pi, multiple))
    }

    /// exp(c·ln x) = x^c, ln(exp x) = x, tan(atan x) = x; tan of multiples of π/4.
    fn of_inverse(&mut self, f: Function, u: ExprId) -> Option<ExprId> {
        match (f, self.node(u)) {
            (Function::Ln, Node::Call(Function::Exp, arguments))
            | (Function::Exp, Node::Call(Function::Ln, arguments))
            | (Function::Tan, Node::Call(Function::Atan, arguments)) => Some(arguments[0]),
            (Function::Exp, Node::Sum { constant, terms })
                if constant.is_zero() && terms.len() == 1 =>
            {
                let (term, c) = terms[0];
                let Node::Call(Function::Ln, arguments) = self.node(term) else {
                    return None;
                };
                let base = arguments[0];
                Some(self.raise(base, c))
            }
            (Function::Tan, Node::Pi | Node::Sum { .. }) => {
                let turns = self.pi_coefficient(u);
                let pi = self.pi;
                if turns.is_zero() || self.scale(pi?, turns) != u {
                    return None;
                }
                match (
                    turns.numerator().rem_euclid(turns.denominator()),
                    turns.denominator(),
                ) {
                    (_, 1) => Some(self.integer(0)),
                    (1, 4) => Some(self.integer(1)),
                    (3, 4) => Some(self.integer(-1)),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// atan2 of numbers on an axis.
    fn arc_tangent_of(&mut self, y: ExprId, x: ExprId) -> Option<ExprId> {
        let (y, x) = (self.as_number(y)?, self.as_number(x)?);
        let multiple = match (y.is_zero(), x.is_zero()) {
            (true, false) if x.is_negative() => Rational::ONE,
            (true, _) => Rational::ZERO,
            (false, true) if y.is_negative() => Rational::new(-1, 2)?,
            (false, true) => Rational::HALF,
            (false, false) => return None,
        };
        let pi = self.pi();
        Some(self.scale(pi, multiple))
    }
}
