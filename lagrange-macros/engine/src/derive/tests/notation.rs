//! The notation of the language, enough of it to write test systems down.

use crate::model::{Branch, System};
use crate::symbolic::{ExprId, Function, Pool, Rational};
use proc_macro2::Span;
use std::collections::BTreeMap;

/// Parses an expression; `der(e)` is the total time derivative, `v_x`, `a_x` are der(x), der(der(x)),
/// `if(g, a, b)` is a where g ≥ 0.
pub fn parse(system: &mut System, names: &BTreeMap<String, ExprId>, text: &str) -> ExprId {
    let text: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
    let mut parser = Parser {
        system,
        names,
        text: &text,
        at: 0,
    };
    let e = parser.sum();
    assert_eq!(
        parser.at,
        text.len(),
        "left over: {}",
        text[parser.at..].iter().collect::<String>()
    );
    e
}

/// Precedence climbing over characters.
struct Parser<'a> {
    system: &'a mut System,
    names: &'a BTreeMap<String, ExprId>,
    text: &'a [char],
    at: usize,
}

impl Parser<'_> {
    fn take(&mut self, c: char) -> bool {
        let found = self.text.get(self.at) == Some(&c);
        self.at += usize::from(found);
        found
    }

    fn pool(&mut self) -> &mut Pool {
        &mut self.system.pool
    }

    fn sum(&mut self) -> ExprId {
        let mut e = self.term();
        loop {
            if self.take('+') {
                let right = self.term();
                e = self.pool().add(e, right);
            } else if self.take('-') {
                let right = self.term();
                e = self.pool().sub(e, right);
            } else {
                return e;
            }
        }
    }

    fn term(&mut self) -> ExprId {
        let mut e = self.sign();
        loop {
            if self.take('*') {
                let right = self.sign();
                e = self.pool().mul(e, right);
            } else if self.take('/') {
                let right = self.sign();
                e = self.pool().div(e, right).expect("division by zero");
            } else {
                return e;
            }
        }
    }

    fn sign(&mut self) -> ExprId {
        if self.take('-') {
            let e = self.sign();
            return self.pool().neg(e);
        }
        let base = self.atom();
        if !self.take('^') {
            return base;
        }
        let exponent = self.sign();
        self.pool()
            .pow(base, exponent)
            .expect("zero to a negative power")
    }

    fn atom(&mut self) -> ExprId {
        if self.take('(') {
            let e = self.sum();
            assert!(self.take(')'));
            return e;
        }
        let from = self.at;
        while self
            .text
            .get(self.at)
            .is_some_and(|c| c.is_alphanumeric() || *c == '_' || *c == '.')
        {
            self.at += 1;
        }
        let word: String = self.text[from..self.at].iter().collect();
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let number = Rational::parse(&word).expect("number");
            return self.pool().number(number);
        }
        if !self.take('(') {
            return *self
                .names
                .get(&word)
                .unwrap_or_else(|| panic!("unknown name `{word}`"));
        }
        let mut arguments = vec![self.sum()];
        while self.take(',') {
            arguments.push(self.sum());
        }
        assert!(self.take(')'));
        match word.as_str() {
            "der" => {
                let system = &mut *self.system;
                let pool = &mut system.pool;
                let mut direction = vec![(system.time, pool.integer(1))];
                for c in &system.coordinates {
                    direction.push((c.position, pool.leaf(c.velocity)));
                    direction.push((c.velocity, pool.leaf(c.acceleration)));
                }
                pool.derivative_along(arguments[0], &direction)
            }
            "sqrt" => self.pool().sqrt(arguments[0]),
            "if" => {
                let branch = self.system.branches.len();
                self.system.branches.push(Branch {
                    guard: arguments[0],
                    declared: arguments[0],
                    then: "if".to_owned(),
                    otherwise: String::new(),
                    span: Span::call_site(),
                });
                self.pool().select(branch, arguments[1], arguments[2])
            }
            _ => {
                let f = Function::from_name(&word)
                    .unwrap_or_else(|| panic!("unknown function `{word}`"));
                self.pool().call(f, &arguments)
            }
        }
    }
}
