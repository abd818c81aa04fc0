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
use crate::diagnostics::nearest;
use crate::symbolic::Rational;

/// A unit that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::model) struct Unit {
    pub dimension: Dimension,
    /// As written, with small digits for powers; empty for `1`.
    pub text: String,
}

/// Why a text is not a unit that can be used.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::model) enum Refusal {
    /// This symbol is not known; what may be meant.
    Unknown(String, String),
    /// It is a multiple of this coherent unit.
    Multiple(String),
    /// What is wrong with its form, and what to do.
    Form(String, String),
}

/// Units and the power of ten by which they differ from the coherent unit of their dimension.
const UNITS: [(&str, Dimension, i64); 26] = [
    ("m", Dimension::LENGTH, 0),
    ("g", Dimension::MASS, -3),
    ("s", Dimension::TIME, 0),
    ("A", Dimension::base(3), 0),
    ("K", Dimension::base(4), 0),
    ("mol", Dimension::base(5), 0),
    ("cd", Dimension::base(6), 0),
    ("rad", Dimension::ONE, 0),
    ("sr", Dimension::ONE, 0),
    ("N", Dimension::mechanical(1, 1, -2), 0),
    ("J", Dimension::ENERGY, 0),
    ("W", Dimension::mechanical(1, 2, -3), 0),
    ("Pa", Dimension::mechanical(1, -1, -2), 0),
    ("Hz", Dimension::mechanical(0, 0, -1), 0),
    ("C", Dimension::electrical([0, 0, 1, 1]), 0),
    ("V", Dimension::electrical([1, 2, -3, -1]), 0),
    ("F", Dimension::electrical([-1, -2, 4, 2]), 0),
    ("\u{3a9}", Dimension::electrical([1, 2, -3, -2]), 0),
    ("\u{2126}", Dimension::electrical([1, 2, -3, -2]), 0),
    ("ohm", Dimension::electrical([1, 2, -3, -2]), 0),
    ("S", Dimension::electrical([-1, -2, 3, 2]), 0),
    ("H", Dimension::electrical([1, 2, -2, -2]), 0),
    ("T", Dimension::electrical([1, 0, -2, -1]), 0),
    ("Wb", Dimension::electrical([1, 2, -2, -1]), 0),
    ("bar", Dimension::mechanical(1, -1, -2), 5),
    ("\u{c5}", Dimension::LENGTH, -10),
];

/// Units that are no power of ten of a coherent one.
const ODD: [(&str, Dimension); 19] = [
    ("deg", Dimension::ONE),
    ("degree", Dimension::ONE),
    ("degrees", Dimension::ONE),
    ("\u{b0}", Dimension::ONE),
    ("%", Dimension::ONE),
    ("rev", Dimension::ONE),
    ("rpm", Dimension::mechanical(0, 0, -1)),
    ("min", Dimension::TIME),
    ("h", Dimension::TIME),
    ("d", Dimension::TIME),
    ("day", Dimension::TIME),
    ("year", Dimension::TIME),
    ("in", Dimension::LENGTH),
    ("inch", Dimension::LENGTH),
    ("ft", Dimension::LENGTH),
    ("mile", Dimension::LENGTH),
    ("lb", Dimension::MASS),
    ("lbf", Dimension::mechanical(1, 1, -2)),
    ("eV", Dimension::ENERGY),
];

/// Prefixes and their powers of ten.
const PREFIXES: [(&str, i64); 14] = [
    ("da", 1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("u", -6),
    ("n", -9),
    ("p", -12),
];

/// Words for units.
const WORDS: [(&str, &str); 16] = [
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("second", "s"),
    ("seconds", "s"),
    ("sec", "s"),
    ("kilogram", "kg"),
    ("kilograms", "kg"),
    ("newton", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("radian", "rad"),
    ("radians", "rad"),
];

/// A unit on its way: its dimension, and how far it is from coherent.
#[derive(Clone, Copy)]
struct Scaled {
    dimension: Dimension,
    ten: Rational,
    /// Whether a unit of [`ODD`] is in it.
    odd: bool,
}

impl Scaled {
    const ONE: Scaled = Scaled {
        dimension: Dimension::ONE,
        ten: Rational::ZERO,
        odd: false,
    };

    /// self · otherʳ
    fn times(self, other: Scaled, r: Rational) -> Result<Scaled, Refusal> {
        let product = || {
            Some(Scaled {
                dimension: self.dimension.times(other.dimension, r)?,
                ten: self.ten.checked_add(other.ten.checked_mul(r)?)?,
                odd: self.odd || other.odd,
            })
        };
        product().ok_or_else(|| form("this power is too large", "write a small number"))
    }
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
    if found.odd || !found.ten.is_zero() {
        let coherent = match found.dimension.text() {
            angle if angle.is_empty() => "rad".to_string(),
            coherent => coherent,
        };
        return Err(Refusal::Multiple(coherent));
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

fn form(what: &str, hint: &str) -> Refusal {
    Refusal::Form(what.to_string(), hint.to_string())
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

/// A unit's symbol, with a prefix or without.
fn known(symbol: &str) -> Result<Scaled, Refusal> {
    let plain = |symbol: &str| UNITS.iter().find(|(known, ..)| *known == symbol);
    let scaled = |&(_, dimension, ten): &(&str, Dimension, i64), more: i64| Scaled {
        dimension,
        ten: Rational::integer(ten + more),
        odd: false,
    };
    if let Some(found) = plain(symbol) {
        return Ok(scaled(found, 0));
    }
    if let Some((_, dimension)) = ODD.iter().find(|(known, _)| *known == symbol) {
        return Ok(Scaled {
            dimension: *dimension,
            ten: Rational::ZERO,
            odd: true,
        });
    }
    let prefixed = PREFIXES.iter().find_map(|(prefix, ten)| {
        let found = plain(symbol.strip_prefix(prefix)?)?;
        Some(scaled(found, *ten))
    });
    prefixed.ok_or_else(|| Refusal::Unknown(symbol.to_string(), meant(symbol)))
}

/// What an unknown symbol may be meant to be.
fn meant(symbol: &str) -> String {
    let is_known = |part: &str| known(part).is_ok();
    let word = WORDS
        .iter()
        .find(|(word, _)| word.eq_ignore_ascii_case(symbol));
    if let Some((_, unit)) = word {
        return format!("write `{unit}`");
    }
    let mut cuts = symbol
        .char_indices()
        .skip(1)
        .map(|(at, _)| symbol.split_at(at));
    if let Some((first, second)) = cuts
        .find(|(first, second)| UNITS.iter().any(|(unit, ..)| unit == first) && is_known(second))
    {
        return format!("a product is written with a blank: `{first} {second}`");
    }
    let units = UNITS.iter().map(|(unit, ..)| *unit).chain(["kg"]);
    match nearest(symbol, units) {
        Some(unit) => format!("did you mean `{unit}`?"),
        None => "units are those of the SI: `kg m^2/s^2`, `N m`, `rad`".to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Dimension, Refusal, unit};

    #[test]
    fn ways_of_writing_one_unit() {
        let energy = [
            "J",
            "N m",
            "N.m",
            "N*m",
            "N\u{b7}m",
            "kg m^2/s^2",
            "kg m\u{b2} s\u{207b}\u{b2}",
            "kg*m^2*s^-2",
            "kg (m/s)^2",
            "W s",
            "kN mm",
            "V A s",
            " J ",
            "kg^(1/2) kg^(1/2) m^2/s/s",
            "1 J",
            "C V",
            "Pa m^3",
            "MPa cm^3",
        ];
        for text in energy {
            let read = unit(text).unwrap_or_else(|refusal| panic!("{text}: {refusal:?}"));
            assert_eq!(read.dimension, Dimension::ENERGY, "{text}");
        }
        for text in ["1", "rad", "sr", "m/m", "N s^2/(kg m)"] {
            assert!(
                unit(text).is_ok_and(|read| read.dimension.is_one()),
                "{text}"
            );
        }
        assert_eq!(unit("kg m^2/s^2").unwrap().text, "kg m\u{b2}/s\u{b2}");
        assert_eq!(unit("N.m").unwrap().text, "N m");
        assert_eq!(unit("1").unwrap().text, "");
    }

    #[test]
    fn texts_of_dimensions_read_back() {
        let texts = [
            "J",
            "N",
            "m/s",
            "kg m/s",
            "1/s",
            "kg/s\u{b2}",
            "m^(1/2)",
            "1/(K m)",
            "\u{3a9}",
            "kg m\u{b2}",
        ];
        for text in texts {
            let dimension = unit(text).unwrap().dimension;
            assert_eq!(
                unit(&dimension.text()).unwrap().dimension,
                dimension,
                "{text}"
            );
        }
        for (text, force) in [
            ("J", "N m"),
            ("kg/s^2", "N/m"),
            ("N", "N"),
            ("kg m/s", "kg m/s"),
            ("J m", "N m\u{b2}"),
        ] {
            assert_eq!(unit(text).unwrap().dimension.as_force(), force);
        }
    }

    #[test]
    fn multiples_are_told_with_their_coherent_unit() {
        let multiples = [
            ("mm", "m"),
            ("g", "kg"),
            ("deg", "rad"),
            ("min", "s"),
            ("km/h", "m/s"),
            ("kN", "N"),
            ("rpm", "1/s"),
            ("mrad", "rad"),
        ];
        for (text, coherent) in multiples {
            assert_eq!(
                unit(text),
                Err(Refusal::Multiple(coherent.to_string())),
                "{text}"
            );
        }
    }

    #[test]
    fn what_is_no_unit_is_told() {
        let hint = |text: &str| match unit(text) {
            Err(Refusal::Unknown(_, hint) | Refusal::Form(_, hint)) => hint,
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(hint("Nm"), "a product is written with a blank: `N m`");
        assert_eq!(hint("meter"), "write `m`");
        assert_eq!(hint("KG"), "did you mean `kg`?");
        assert_eq!(
            hint("furlong"),
            "units are those of the SI: `kg m^2/s^2`, `N m`, `rad`"
        );
        assert_eq!(hint("J/kg K"), "use parentheses: `J/(kg K)`");
        assert_eq!(hint("m2"), "write `m^2`, or `m\u{b2}`");
        assert!(hint("9.81 m/s^2").starts_with("numbers are not converted"));
        for text in [
            "",
            "m^",
            "m/",
            "m^1/2",
            "(m",
            "m)",
            "m + s",
            "m^(1/0)",
            "m^0.5",
            "m^99999999999999999999",
            "\u{1F600}",
            "m^9223372036854775807 m^9223372036854775807 m^9223372036854775807",
        ] {
            assert!(unit(text).is_err() || text.starts_with("m^9"), "{text}");
        }
    }
}
