//! Dimensions of the SI: a power of each of its seven base units.

use crate::symbolic::Rational;

/// Symbols of the base units, in the order of the exponents and of texts.
const BASE: [&str; 7] = ["kg", "m", "s", "A", "K", "mol", "cd"];

/// Units with names of their own that are used in texts: (symbol, powers of kg, m, s, A).
const NAMED: [(&str, [i32; 4]); 11] = [
    ("N", [1, 1, -2, 0]),
    ("J", [1, 2, -2, 0]),
    ("W", [1, 2, -3, 0]),
    ("Pa", [1, -1, -2, 0]),
    ("C", [0, 0, 1, 1]),
    ("V", [1, 2, -3, -1]),
    ("F", [-1, -2, 4, 2]),
    ("Ω", [1, 2, -3, -2]),
    ("H", [1, 2, -2, -2]),
    ("T", [1, 0, -2, -1]),
    ("Wb", [1, 2, -2, -1]),
];

/// kg^a m^b s^c A^d K^e mol^f cd^g
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(in crate::model) struct Dimension([Exponent; 7]);

/// p/q in lowest terms: exponents are small, and there are many of them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Exponent(i32, i32);

impl Exponent {
    const ZERO: Exponent = Exponent(0, 1);

    fn new(value: Rational) -> Option<Exponent> {
        let numerator = i32::try_from(value.numerator()).ok()?;
        Some(Exponent(
            numerator,
            i32::try_from(value.denominator()).ok()?,
        ))
    }

    fn value(self) -> Rational {
        Rational::new(i128::from(self.0), i128::from(self.1)).unwrap_or(Rational::ZERO)
    }
}

impl Dimension {
    /// A plain number.
    pub const ONE: Dimension = Dimension([Exponent::ZERO; 7]);
    /// kg
    pub const MASS: Dimension = Dimension::mechanical(1, 0, 0);
    /// m
    pub const LENGTH: Dimension = Dimension::mechanical(0, 1, 0);
    /// s
    pub const TIME: Dimension = Dimension::mechanical(0, 0, 1);
    /// J
    pub const ENERGY: Dimension = Dimension::mechanical(1, 2, -2);

    /// kg^a m^b s^c
    pub const fn mechanical(mass: i32, length: i32, time: i32) -> Dimension {
        Dimension::electrical([mass, length, time, 0])
    }

    /// kg^a m^b s^c A^d
    pub const fn electrical([mass, length, time, current]: [i32; 4]) -> Dimension {
        Dimension([
            Exponent(mass, 1),
            Exponent(length, 1),
            Exponent(time, 1),
            Exponent(current, 1),
            Exponent::ZERO,
            Exponent::ZERO,
            Exponent::ZERO,
        ])
    }

    /// The base unit with this index: K 4, mol 5, cd 6.
    pub const fn base(index: usize) -> Dimension {
        let mut exponents = [Exponent::ZERO; 7];
        exponents[index] = Exponent(1, 1);
        Dimension(exponents)
    }

    /// The quotient of two dimensions with whole exponents.
    pub const fn per(self, other: Dimension) -> Dimension {
        let mut exponents = self.0;
        let mut i = 0;
        while i < exponents.len() {
            exponents[i].0 -= other.0[i].0;
            i += 1;
        }
        Dimension(exponents)
    }

    /// Whether it is a plain number.
    pub fn is_one(self) -> bool {
        self == Dimension::ONE
    }

    /// Whether a power of kg is in it.
    pub fn has_mass(self) -> bool {
        self.0[0] != Exponent::ZERO
    }

    /// self · otherʳ; `None` if an exponent does not fit.
    pub fn times(self, other: Dimension, r: Rational) -> Option<Dimension> {
        let mut product = self;
        for (exponent, more) in product.0.iter_mut().zip(other.0) {
            let sum = exponent.value().checked_add(more.value().checked_mul(r)?)?;
            *exponent = Exponent::new(sum)?;
        }
        Some(product)
    }

    /// The power of time that it is, if it is nothing else.
    pub fn as_time(self) -> Option<Rational> {
        let power = self.0[2].value();
        let rest = self.times(Dimension::TIME, power.checked_neg()?)?;
        rest.is_one().then_some(power)
    }

    /// `kg m²/s²`, or the name of a unit; empty for a plain number.
    pub fn text(self) -> String {
        let named = NAMED
            .iter()
            .find(|(_, powers)| Dimension::electrical(*powers) == self);
        if let Some((name, _)) = named {
            return (*name).to_string();
        }
        fraction(BASE.into_iter().zip(self.0.map(Exponent::value)))
    }

    /// As a force or torque: `N`, `N m`, `N/m`, `N s`; else as [`Self::text`].
    pub fn as_force(self) -> String {
        let newton = Dimension::mechanical(1, 1, -2);
        let Some(rest) = self.times(newton, Rational::MINUS_ONE) else {
            return self.text();
        };
        let lengths = rest.0[1].value();
        match rest.times(Dimension::LENGTH, lengths.checked_neg().unwrap_or(lengths)) {
            Some(left) if left.is_one() => {
                fraction([("N", Rational::ONE), ("m", lengths)].into_iter())
            }
            _ => self.text(),
        }
    }
}

/// Factors with positive powers, then a stroke, then those with negative ones.
fn fraction<'a>(factors: impl Iterator<Item = (&'a str, Rational)>) -> String {
    let factors: Vec<(&str, Rational)> = factors.filter(|(_, power)| !power.is_zero()).collect();
    let product = |negative: bool| {
        let side = factors
            .iter()
            .filter(|(_, power)| power.is_negative() == negative);
        let side = side.map(|&(symbol, power)| {
            let power = power.checked_abs().unwrap_or(power);
            format!("{symbol}{}", superscript(power))
        });
        side.collect::<Vec<String>>()
    };
    let (above, below) = (product(false), product(true));
    let above_text = match (above.is_empty(), below.is_empty()) {
        (true, true) => return String::new(),
        (true, false) => "1".to_string(),
        _ => above.join(" "),
    };
    match below.as_slice() {
        [] => above_text,
        [only] => format!("{above_text}/{only}"),
        several => format!("{above_text}/({})", several.join(" ")),
    }
}

/// `²`, or `^(1/2)`; nothing for 1.
pub(super) fn superscript(power: Rational) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    if power.is_one() {
        return String::new();
    }
    let Some(integer) = power.to_integer() else {
        return format!("^({}/{})", power.numerator(), power.denominator());
    };
    integer
        .to_string()
        .chars()
        .map(|symbol| match symbol.to_digit(10) {
            Some(digit) => DIGITS[digit as usize],
            None => '⁻',
        })
        .collect()
}
