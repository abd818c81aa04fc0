//! Symbols of units: `kN` → its dimension, and how far it is from the coherent unit.

use super::dimension::Dimension;
use super::refusal::{Refusal, form};
use crate::diagnostics::nearest;
use crate::symbolic::Rational;

/// Units and the power of ten by which they differ from the coherent unit of their dimension.
const UNITS: [(&str, Dimension, i64); 33] = [
    ("m", Dimension::LENGTH, 0),
    ("g", Dimension::MASS, -3),
    ("t", Dimension::MASS, 3),
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
    ("lm", Dimension::base(6), 0),
    (
        "lx",
        Dimension::base(6).per(Dimension::mechanical(0, 2, 0)),
        0,
    ),
    ("Bq", Dimension::mechanical(0, 0, -1), 0),
    ("Gy", Dimension::mechanical(0, 2, -2), 0),
    ("Sv", Dimension::mechanical(0, 2, -2), 0),
    ("kat", Dimension::base(5).per(Dimension::TIME), 0),
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

/// Those of angles and of their rates.
const ANGLES: [&str; 6] = ["deg", "degree", "degrees", "\u{b0}", "rev", "rpm"];

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
pub(super) struct Scaled {
    pub dimension: Dimension,
    pub ten: Rational,
    /// Whether a unit of [`ODD`] is in it.
    pub odd: bool,
    /// Whether a unit of angles is in it.
    pub angle: bool,
}

impl Scaled {
    pub const ONE: Scaled = Scaled {
        dimension: Dimension::ONE,
        ten: Rational::ZERO,
        odd: false,
        angle: false,
    };

    /// Whether it is coherent: no multiple.
    pub fn is_coherent(self) -> bool {
        !self.odd && self.ten.is_zero()
    }

    /// The coherent unit of its dimension.
    pub fn coherent(self) -> String {
        let text = match self.dimension.text() {
            plain if plain.is_empty() => "1".to_string(),
            text => text,
        };
        match text.strip_prefix('1').filter(|_| self.angle) {
            Some(rest) => format!("rad{rest}"),
            None => text,
        }
    }

    /// self · otherʳ
    pub fn times(self, other: Scaled, r: Rational) -> Result<Scaled, Refusal> {
        let product = || {
            Some(Scaled {
                dimension: self.dimension.times(other.dimension, r)?,
                ten: self.ten.checked_add(other.ten.checked_mul(r)?)?,
                odd: self.odd || other.odd,
                angle: self.angle || other.angle,
            })
        };
        product().ok_or_else(|| form("this power is too large", "write a small number"))
    }
}

/// A unit's symbol, with a prefix or without.
pub(super) fn known(symbol: &str) -> Result<Scaled, Refusal> {
    unit(symbol).ok_or_else(|| Refusal::Unknown(symbol.to_string(), meant(symbol)))
}

fn unit(symbol: &str) -> Option<Scaled> {
    let plain = |symbol: &str| UNITS.iter().find(|(known, ..)| *known == symbol);
    let scaled = |&(unit, dimension, ten): &(&str, Dimension, i64), more: i64| Scaled {
        dimension,
        ten: Rational::integer(ten + more),
        odd: false,
        angle: unit == "rad",
    };
    if let Some(found) = plain(symbol) {
        return Some(scaled(found, 0));
    }
    if let Some((_, dimension)) = ODD.iter().find(|(known, _)| *known == symbol) {
        return Some(Scaled {
            dimension: *dimension,
            ten: Rational::ZERO,
            odd: true,
            angle: ANGLES.contains(&symbol),
        });
    }
    PREFIXES.iter().find_map(|(prefix, ten)| {
        let found = plain(symbol.strip_prefix(prefix)?)?;
        Some(scaled(found, *ten))
    })
}

/// What an unknown symbol may be meant to be.
fn meant(symbol: &str) -> String {
    let word = WORDS
        .iter()
        .find(|(word, _)| word.eq_ignore_ascii_case(symbol));
    if let Some((_, unit)) = word {
        return format!("write `{unit}`");
    }
    let units = UNITS.iter().map(|(unit, ..)| *unit).chain(["kg"]);
    let coherent = product(symbol, Scaled::is_coherent);
    let near = nearest(symbol, units).filter(|_| coherent.is_none());
    if let Some(unit) = near {
        return format!("did you mean `{unit}`?");
    }
    match coherent.or_else(|| product(symbol, |_| true)) {
        Some(product) => format!("a product is written with a blank: `{product}`"),
        None => "units are those of the SI: `kg m^2/s^2`, `N m`, `rad`".to_string(),
    }
}

/// Coherent units one after the other, of which the last may be any `allowed` one: `Nms` → `N m s`. The same one twice would be a square.
fn product(symbol: &str, allowed: impl Fn(Scaled) -> bool + Copy) -> Option<String> {
    /// The ways to cut a text double with each letter; `kgmmss` has six.
    const LONGEST: usize = 12;
    if symbol.len() > LONGEST {
        return None;
    }
    let cuts = symbol.char_indices().skip(1);
    let mut cuts = cuts.map(|(at, _)| symbol.split_at(at));
    cuts.find_map(|(first, rest)| {
        unit(first).filter(|unit| unit.is_coherent())?;
        let rest = match unit(rest) {
            Some(unit) if allowed(unit) => rest.to_string(),
            _ => product(rest, allowed)?,
        };
        (rest.split(' ').next() != Some(first)).then(|| format!("{first} {rest}"))
    })
}
