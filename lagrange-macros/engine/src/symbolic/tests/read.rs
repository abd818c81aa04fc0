//! A reader of the declaration's grammar that builds in a pool: `+ - * / ^`, calls, numbers, names.

use crate::symbolic::{ExprId, Function, Pool, Rational, Symbol};

/// A pool whose symbols are made on first use.
#[derive(Default)]
pub(super) struct Desk {
    pub(super) pool: Pool,
    pub(super) symbols: Vec<Symbol>,
}

impl Desk {
    pub(super) fn symbol(&mut self, name: &str) -> Symbol {
        if let Some(&known) = self
            .symbols
            .iter()
            .find(|&&symbol| self.pool.name(symbol) == name)
        {
            return known;
        }
        let symbol = self.pool.symbol(name);
        self.symbols.push(symbol);
        symbol
    }

    pub(super) fn read(&mut self, text: &str) -> ExprId {
        let mut reader = Reader {
            text: text.as_bytes(),
            at: 0,
            desk: self,
        };
        let e = reader.sum();
        reader.blanks();
        assert_eq!(reader.at, text.len(), "rest of {text:?}");
        e
    }

    /// Reads a and b, checks that both give the same expression.
    pub(super) fn same(&mut self, a: &str, b: &str) {
        let (left, right) = (self.read(a), self.read(b));
        let (x, y) = (self.pool.print(left), self.pool.print(right));
        assert_eq!(left, right, "{a} gives {x}, {b} gives {y}");
    }

    pub(super) fn different(&mut self, a: &str, b: &str) {
        let (left, right) = (self.read(a), self.read(b));
        assert_ne!(left, right, "{a} and {b}");
    }

    pub(super) fn printed(&mut self, text: &str) -> String {
        let e = self.read(text);
        self.pool.print(e)
    }
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    desk: &'a mut Desk,
}

impl Reader<'_> {
    fn blanks(&mut self) {
        while self.text.get(self.at) == Some(&b' ') {
            self.at += 1;
        }
    }

    fn take(&mut self, c: u8) -> bool {
        self.blanks();
        let here = self.text.get(self.at) == Some(&c);
        self.at += usize::from(here);
        here
    }

    fn sum(&mut self) -> ExprId {
        let mut sum = self.product();
        loop {
            if self.take(b'+') {
                let term = self.product();
                sum = self.desk.pool.add(sum, term);
            } else if self.take(b'-') {
                let term = self.product();
                sum = self.desk.pool.sub(sum, term);
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> ExprId {
        let mut product = self.signed();
        loop {
            if self.take(b'*') {
                let factor = self.signed();
                product = self.desk.pool.mul(product, factor);
            } else if self.take(b'/') {
                let divisor = self.signed();
                product = self
                    .desk
                    .pool
                    .div(product, divisor)
                    .expect("division by zero");
            } else {
                return product;
            }
        }
    }

    fn signed(&mut self) -> ExprId {
        if self.take(b'-') {
            let e = self.signed();
            return self.desk.pool.neg(e);
        }
        let base = self.atom();
        if !self.take(b'^') {
            return base;
        }
        let exponent = self.signed();
        self.desk
            .pool
            .pow(base, exponent)
            .expect("0 to a negative power")
    }

    fn atom(&mut self) -> ExprId {
        if self.take(b'(') {
            let e = self.sum();
            assert!(self.take(b')'), "missing )");
            return e;
        }
        let from = self.at;
        while self
            .text
            .get(self.at)
            .is_some_and(|c| c.is_ascii_alphanumeric() || b"._".contains(c))
        {
            self.at += 1;
        }
        let word = std::str::from_utf8(&self.text[from..self.at])
            .unwrap()
            .to_owned();
        if let Some(n) = Rational::parse(&word) {
            return self.desk.pool.number(n);
        }
        if !self.take(b'(') {
            assert!(!word.is_empty(), "nothing at {from}");
            let symbol = if word == "pi" {
                return self.desk.pool.pi();
            } else {
                self.desk.symbol(&word)
            };
            return self.desk.pool.leaf(symbol);
        }
        let mut arguments = vec![self.sum()];
        while self.take(b',') {
            arguments.push(self.sum());
        }
        assert!(self.take(b')'), "missing )");
        match (word.as_str(), Function::from_name(&word)) {
            (_, Some(f)) => self.desk.pool.call(f, &arguments),
            ("sqrt", None) => self.desk.pool.sqrt(arguments[0]),
            // Branches have numbers in print.
            ("select", None) => {
                let n = self
                    .desk
                    .pool
                    .as_number(arguments[0])
                    .and_then(Rational::to_integer)
                    .unwrap();
                self.desk
                    .pool
                    .select(n as usize, arguments[1], arguments[2])
            }
            _ => panic!("unknown function {word}"),
        }
    }
}
