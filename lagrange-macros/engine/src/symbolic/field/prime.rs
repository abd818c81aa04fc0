//! Arithmetic modulo a prime p = 2^bits − gap: x·2^bits + y ≡ x·gap + y, so reduction needs no division.
//!
//! The primes are chosen so that roots behave like those of positive numbers. p = 2r + 1 with r prime, so that the
//! squares are a group of prime order r in which every root exists and is unique: √a √b = √(ab), and (a^(1/3))³ = a.
//! p ≡ 3 modulo 4, so that −1 is no square: of a and −a one is, as of two numbers one is positive. The primes up to
//! 23 are squares.

use super::super::Rational;

/// A field of p elements; they are the numbers 0 … p − 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Prime {
    bits: u32,
    gap: u64,
}

/// The fields for two independent evaluations: together 123 bits.
pub const PRIMES: [Prime; 2] = [
    Prime {
        bits: 61,
        gap: 636_873,
    },
    Prime {
        bits: 62,
        gap: 308_225,
    },
];

impl Prime {
    /// p
    pub const fn modulus(self) -> u64 {
        (1 << self.bits) - self.gap
    }

    fn reduced(self, x: u128) -> u64 {
        let mask = (1_u128 << self.bits) - 1;
        let fold = |x: u128| (x >> self.bits) * u128::from(self.gap) + (x & mask);
        let x = fold(fold(x)) as u64;
        let p = self.modulus();
        let x = if x >= p { x - p } else { x };
        if x >= p { x - p } else { x }
    }

    /// Any 64 bits as an element.
    pub fn element(self, bits: u64) -> u64 {
        self.reduced(u128::from(bits))
    }

    /// a + b
    pub fn add(self, a: u64, b: u64) -> u64 {
        let (sum, p) = (a + b, self.modulus());
        if sum >= p { sum - p } else { sum }
    }

    /// −a
    pub fn neg(self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.modulus() - a }
    }

    /// a − b
    pub fn sub(self, a: u64, b: u64) -> u64 {
        self.add(a, self.neg(b))
    }

    /// a b
    pub fn mul(self, a: u64, b: u64) -> u64 {
        self.reduced(u128::from(a) * u128::from(b))
    }

    /// aⁿ
    pub fn pow(self, a: u64, n: u64) -> u64 {
        let (mut base, mut left, mut result) = (a, n, 1);
        while left > 0 {
            if left & 1 == 1 {
                result = self.mul(result, base);
            }
            left >>= 1;
            if left > 0 {
                base = self.mul(base, base);
            }
        }
        result
    }

    /// 1/a; None for 0.
    pub fn inverse(self, a: u64) -> Option<u64> {
        inverse_modulo(a, self.modulus())
    }

    /// Whether a = b² for some b ≠ 0.
    pub fn is_square(self, a: u64) -> bool {
        self.pow(a, self.modulus() / 2) == 1
    }

    /// An integer.
    pub fn integer(self, n: i128) -> u64 {
        n.rem_euclid(i128::from(self.modulus())) as u64
    }

    /// An exact number; None if p divides its denominator.
    pub fn rational(self, n: Rational) -> Option<u64> {
        let numerator = self.integer(n.numerator());
        if n.is_integer() {
            return Some(numerator);
        }
        let below = self.inverse(self.integer(n.denominator()))?;
        Some(self.mul(numerator, below))
    }

    /// a^r for an integer r; None for 0 to a negative power.
    fn power_integer(self, a: u64, r: Rational) -> Option<u64> {
        let order = i128::from(self.modulus() - 1);
        let base = if r.is_negative() { self.inverse(a)? } else { a };
        let size = r.numerator().checked_abs()?;
        // a^(p − 1) = 1 for all a but 0, whose power must stay 0.
        Some(self.pow(base, if a == 0 { size.min(1) } else { size % order } as u64))
    }

    /// a^r, where a is a square if r is not an integer: the one that is itself a square. None where there is none.
    pub fn power(self, a: u64, r: Rational) -> Option<u64> {
        if r.is_integer() {
            return self.power_integer(a, r);
        }
        if a == 0 {
            return (!r.is_negative()).then_some(0);
        }
        if !self.is_square(a) {
            return None;
        }
        let order = i128::from(self.modulus() / 2);
        let numerator = r.numerator().rem_euclid(order) as u64;
        let denominator = r.denominator().rem_euclid(order) as u64;
        let below = inverse_modulo(denominator, order as u64)?;
        let exponent = (u128::from(numerator) * u128::from(below) % order as u128) as u64;
        Some(self.pow(a, exponent))
    }
}

/// 1/a modulo n; None if they have a common divisor.
fn inverse_modulo(a: u64, n: u64) -> Option<u64> {
    // Euclid: s a ≡ r modulo n throughout.
    let (mut r, mut s) = ((i128::from(n), i128::from(a)), (0_i128, 1_i128));
    while r.1 != 0 {
        let quotient = r.0 as u64 / r.1 as u64;
        r = (r.1, r.0 - i128::from(quotient) * r.1);
        s = (s.1, s.0 - i128::from(quotient) * s.1);
    }
    (r.0 == 1).then(|| s.0.rem_euclid(i128::from(n)) as u64)
}
