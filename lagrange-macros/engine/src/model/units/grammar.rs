//! The text of a unit, `kg m^2/s^2`, → its dimension.
//!
//! ```text
//! unit    = product ("/" factor)*             after a stroke one factor: J/(kg K), not J/kg K
//! product = factor ((" " | "*" | "·" | ".") factor)*
//! factor  = symbol power? | "1" | "(" unit ")" power?
//! power   = "^" integer | "^(" p "/" q ")" | superscript digits
//! ```
//!
//! Numbers are never converted, so a unit is coherent: a product of SI units without a factor. Multiples (`mm`, `deg`,
//! `h`) are known in order to say so.

use super::dimension::{Dimension, superscript};
use super::refusal::{Refusal, form};
use super::table::{Scaled, known};
use crate::symbolic::Rational;

/// A unit that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::model) struct Unit {
    pub dimension: Dimension,
    /// As written, with small digits for powers; empty for `1`.
    pub text: String,
}

/// Reads a unit.
pub(in crate::model) fn unit(text: &str) -> Result<Unit, Refusal> {
    let mut reader = Reader {
        symbols: text.trim().chars().collect(),
        at: 0,
        text: String::new(),
    };
    if reader.symbols.is_empty() {
        let hint = "write `1` for a plain number, or leave the unit out";
        return Err(form("the unit is empty", hint));
    }
    let found = reader.quotient(0)?;
    if reader.peek().is_some() {
        return Err(reader.unexpected());
    }
    if !found.is_coherent() {
        return Err(Refusal::Multiple(found.coherent()));
    }
    let text = match reader.text.as_str() {
        "1" => String::new(),
        text => text.to_string(),
    };
    Ok(Unit {
        dimension: found.dimension,
        text,
    })
}

/// A walk over the symbols of a text, which writes it down again tidily.
struct Reader {
    symbols: Vec<char>,
    at: usize,
    text: String,
}

/// How deep parentheses may nest.
const DEEPEST: usize = 20;

impl Reader {
    fn peek(&self) -> Option<char> {
        self.symbols.get(self.at).copied()
    }

    fn blanks(&mut self) -> bool {
        let start = self.at;
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
        self.at > start
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    fn unexpected(&self) -> Refusal {
        match self.peek() {
            Some(symbol) => form(
                &format!("`{symbol}` has no place in a unit"),
                "write units like `kg m^2/s^2`",
            ),
            None => form("the unit ends too early", "write units like `kg m^2/s^2`"),
        }
    }

    /// product ("/" factor)*
    fn quotient(&mut self, depth: usize) -> Result<Scaled, Refusal> {
        let mut found = self.factor(depth)?;
        let mut divided = false;
        loop {
            let blank = self.blanks();
            let side = match self.peek() {
                None | Some(')') => return Ok(found),
                Some('/') => {
                    self.at += 1;
                    self.blanks();
                    self.text.push('/');
                    Rational::MINUS_ONE
                }
                Some('*' | '.' | '\u{b7}' | '\u{22c5}') => {
                    self.at += 1;
                    if self.peek() == Some('*') {
                        return Err(form(
                            "`**` is not used in units",
                            "a power is written `m^2`",
                        ));
                    }
                    self.blanks();
                    self.text.push(' ');
                    Rational::ONE
                }
                Some(_) if blank => {
                    self.text.push(' ');
                    Rational::ONE
                }
                Some(_) => return Err(self.unexpected()),
            };
            if divided && side.is_one() {
                return Err(form(
                    "it is not clear what stands under the stroke",
                    "use parentheses: `J/(kg K)`",
                ));
            }
            divided |= !side.is_one();
            let next = self.factor(depth)?;
            found = found.times(next, side)?;
        }
    }

    /// symbol power? | "1" | "(" unit ")" power?
    fn factor(&mut self, depth: usize) -> Result<Scaled, Refusal> {
        let base = match self.peek() {
            Some('(') if depth < DEEPEST => {
                self.at += 1;
                self.blanks();
                self.text.push('(');
                let inside = self.quotient(depth + 1)?;
                if !self.take(')') {
                    return Err(form("a `)` is missing", "close the parentheses"));
                }
                self.text.push(')');
                inside
            }
            Some(digit) if digit.is_ascii_digit() => {
                self.at += 1;
                if digit != '1'
                    || self
                        .peek()
                        .is_some_and(|next| next.is_ascii_digit() || next == '.')
                {
                    let hint = "numbers are not converted: write the unit alone, and put the number into the value";
                    return Err(form("a unit has no number in it", hint));
                }
                self.text.push('1');
                return Ok(Scaled::ONE);
            }
            Some(symbol) if is_letter(symbol) => {
                let start = self.at;
                while self.peek().is_some_and(is_letter) {
                    self.at += 1;
                }
                let symbol: String = self.symbols[start..self.at].iter().collect();
                let found = known(&symbol)?;
                self.text.push_str(&symbol);
                found
            }
            _ => return Err(self.unexpected()),
        };
        let power = self.power()?;
        self.text.push_str(&superscript(power));
        Scaled::ONE.times(base, power)
    }

    /// A power, 1 if none is written.
    fn power(&mut self) -> Result<Rational, Refusal> {
        let small: String = self.symbols[self.at..]
            .iter()
            .map_while(|symbol| small_digit(*symbol))
            .collect();
        if !small.is_empty() {
            self.at += small.chars().count();
            return small
                .parse()
                .map(Rational::integer)
                .map_err(|_| self.bad_power());
        }
        if self.peek().is_some_and(|symbol| symbol.is_ascii_digit()) {
            return Err(form(
                "a power is written with `^`",
                "write `m^2`, or `m\u{b2}`",
            ));
        }
        if !self.take('^') {
            return Ok(Rational::ONE);
        }
        if self.take('(') {
            let numerator = self.integer()?;
            let denominator = if self.take('/') { self.integer()? } else { 1 };
            let closed = self.take(')');
            return Rational::new(i128::from(numerator), i128::from(denominator))
                .filter(|_| closed)
                .ok_or_else(|| self.bad_power());
        }
        self.integer().map(Rational::integer)
    }

    fn bad_power(&self) -> Refusal {
        form(
            "this is not a power",
            "write a whole number or a fraction: `m^2`, `s^-1`, `m^(1/2)`",
        )
    }

    fn integer(&mut self) -> Result<i64, Refusal> {
        let start = self.at;
        if matches!(self.peek(), Some('-' | '\u{2212}')) {
            self.at += 1;
        }
        while self.peek().is_some_and(|symbol| symbol.is_ascii_digit()) {
            self.at += 1;
        }
        let digits: String = self.symbols[start..self.at].iter().collect();
        let fraction = self.peek() == Some('.')
            && self
                .symbols
                .get(self.at + 1)
                .is_some_and(char::is_ascii_digit);
        digits
            .replace('\u{2212}', "-")
            .parse()
            .ok()
            .filter(|_| !fraction)
            .ok_or_else(|| self.bad_power())
    }
}

fn is_letter(symbol: char) -> bool {
    symbol.is_alphabetic() || matches!(symbol, '%' | '\u{b0}' | '_')
}

/// `²` as `2`.
fn small_digit(symbol: char) -> Option<char> {
    const SMALL: &str =
        "\u{2070}\u{b9}\u{b2}\u{b3}\u{2074}\u{2075}\u{2076}\u{2077}\u{2078}\u{2079}";
    if symbol == '\u{207b}' {
        return Some('-');
    }
    let value = SMALL.chars().position(|small| small == symbol)?;
    char::from_digit(value as u32, 10)
}
