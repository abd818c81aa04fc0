//! Exact numbers p/q with checked 128-bit integers: an operation that does not fit gives `None`.
//!
//! `num_rational::Ratio<i128>` panics where the smallest integer becomes a denominator, rounds to `f64` only with big
//! integers, and takes twice the time without optimisation, as which macros are built (a comparison five times).

use std::cmp::Ordering;
use std::fmt;

/// An exact number p/q in lowest terms, q > 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

/// Greatest common divisor; 64-bit division is many times faster, and nearly always enough.
fn gcd(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        if let (Ok(mut x), Ok(mut y)) = (u64::try_from(a), u64::try_from(b)) {
            while y != 0 {
                (x, y) = (y, x % y);
            }
            return u128::from(x);
        }
        (a, b) = (b, a % b);
    }
    a
}

impl Rational {
    /// 0
    pub const ZERO: Rational = Rational::integer(0);
    /// 1
    pub const ONE: Rational = Rational::integer(1);
    /// −1
    pub const MINUS_ONE: Rational = Rational::integer(-1);
    /// 1/2
    pub const HALF: Rational = Rational {
        numerator: 1,
        denominator: 2,
    };

    /// −1/2
    pub const MINUS_HALF: Rational = Rational {
        numerator: -1,
        denominator: 2,
    };

    /// n
    pub const fn integer(n: i64) -> Rational {
        Rational {
            numerator: n as i128,
            denominator: 1,
        }
    }

    /// numerator/denominator in lowest terms; `None` if the denominator is 0 or the result does not fit.
    pub fn new(numerator: i128, denominator: i128) -> Option<Rational> {
        if denominator == 0 {
            return None;
        }
        if denominator == 1 {
            return Some(Rational {
                numerator,
                denominator,
            });
        }
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs());
        let magnitude = i128::try_from(numerator.unsigned_abs() / divisor).ok()?;
        let below = i128::try_from(denominator.unsigned_abs() / divisor).ok()?;
        let negative = (numerator < 0) != (denominator < 0);
        Some(Rational {
            numerator: if negative { -magnitude } else { magnitude },
            denominator: below,
        })
    }

    /// p
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// q > 0
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// Whether it is 0.
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// Whether it is 1.
    pub fn is_one(self) -> bool {
        self.numerator == 1 && self.denominator == 1
    }

    /// Whether it is 1 or −1.
    pub fn is_unit(self) -> bool {
        self.denominator == 1 && (self.numerator == 1 || self.numerator == -1)
    }

    /// Whether q = 1.
    pub fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// Whether it is < 0.
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// The integer, if it is one and fits.
    pub fn to_integer(self) -> Option<i64> {
        if self.denominator == 1 {
            i64::try_from(self.numerator).ok()
        } else {
            None
        }
    }

    /// Largest integer that is not greater.
    pub fn floor(self) -> i128 {
        self.numerator.div_euclid(self.denominator)
    }

    /// a + b
    pub fn checked_add(self, other: Rational) -> Option<Rational> {
        if self.denominator == 1 && other.denominator == 1 {
            let numerator = self.numerator.checked_add(other.numerator)?;
            return Some(Rational {
                numerator,
                denominator: 1,
            });
        }
        let shared = gcd(
            self.denominator.unsigned_abs(),
            other.denominator.unsigned_abs(),
        ) as i128;
        let left = self.numerator.checked_mul(other.denominator / shared)?;
        let right = other.numerator.checked_mul(self.denominator / shared)?;
        let below = self.denominator.checked_mul(other.denominator / shared)?;
        Rational::new(left.checked_add(right)?, below)
    }

    /// a − b
    pub fn checked_sub(self, other: Rational) -> Option<Rational> {
        self.checked_add(other.checked_neg()?)
    }

    /// −a
    pub fn checked_neg(self) -> Option<Rational> {
        Some(Rational {
            numerator: self.numerator.checked_neg()?,
            denominator: self.denominator,
        })
    }

    /// |a|
    pub fn checked_abs(self) -> Option<Rational> {
        Some(Rational {
            numerator: self.numerator.checked_abs()?,
            denominator: self.denominator,
        })
    }

    /// a b
    pub fn checked_mul(self, other: Rational) -> Option<Rational> {
        if self.denominator == 1 && other.denominator == 1 {
            let numerator = self.numerator.checked_mul(other.numerator)?;
            return Some(Rational {
                numerator,
                denominator: 1,
            });
        }
        // Reduce crosswise first: what fits in the result then fits on the way.
        let left = Rational::new(self.numerator, other.denominator)?;
        let right = Rational::new(other.numerator, self.denominator)?;
        Some(Rational {
            numerator: left.numerator.checked_mul(right.numerator)?,
            denominator: left.denominator.checked_mul(right.denominator)?,
        })
    }

    /// a / b; `None` also for b = 0.
    pub fn checked_div(self, other: Rational) -> Option<Rational> {
        self.checked_mul(Rational::new(other.denominator, other.numerator)?)
    }

    /// aⁿ; `None` also for 0 to a negative power.
    pub fn pow_int(self, n: i64) -> Option<Rational> {
        let mut base = if n < 0 {
            Rational::new(self.denominator, self.numerator)?
        } else {
            self
        };
        if base.is_unit() || base.is_zero() {
            let even = n % 2 == 0;
            return Some(if n == 0 || (base.numerator == -1 && even) {
                Rational::ONE
            } else {
                base
            });
        }
        let mut left = n.unsigned_abs();
        let mut result = Rational::ONE;
        while left > 0 {
            if left % 2 == 1 {
                result = result.checked_mul(base)?;
            }
            left /= 2;
            if left > 0 {
                base = base.checked_mul(base)?;
            }
        }
        Some(result)
    }

    /// Exact value of a decimal literal such as `12`, `0.1`, `1e-3`, `1_000.5`; `None` if it is not one (a sign or
    /// a type suffix is not part of it) or does not fit.
    pub fn parse(literal: &str) -> Option<Rational> {
        let (digits, exponent) = match literal.find(['e', 'E']) {
            Some(at) => (
                &literal[..at],
                literal[at + 1..].replace('_', "").parse::<i64>().ok()?,
            ),
            None => (literal, 0),
        };
        if !digits.starts_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        let mut numerator: i128 = 0;
        let mut zeros: i64 = 0;
        let mut decimals: i64 = 0;
        let mut after_point = false;
        for c in digits.chars() {
            match c {
                '_' => {}
                '.' if !after_point => after_point = true,
                '0'..='9' => {
                    decimals += i64::from(after_point);
                    // Zeros are held back, so that trailing ones cannot overflow.
                    if c == '0' {
                        zeros += 1;
                    } else {
                        let shift = 10_i128.checked_pow(u32::try_from(zeros + 1).ok()?)?;
                        numerator = numerator
                            .checked_mul(shift)
                            .or((numerator == 0).then_some(0))?;
                        numerator = numerator.checked_add(i128::from(c as u32 - '0' as u32))?;
                        zeros = 0;
                    }
                }
                _ => return None,
            }
        }
        if numerator == 0 {
            return Some(Rational::ZERO);
        }
        let scale =
            Rational::integer(10).pow_int(exponent.checked_add(zeros)?.checked_sub(decimals)?)?;
        Rational::new(numerator, 1)?.checked_mul(scale)
    }

    /// The nearest f64, ties to even.
    pub fn to_f64(self) -> f64 {
        let (n, d) = (
            self.numerator.unsigned_abs(),
            self.denominator.unsigned_abs(),
        );
        const EXACT: u128 = 1 << 53;
        let magnitude = if n <= EXACT && d <= EXACT {
            n as f64 / d as f64
        } else {
            // Long division: 64 leading bits of the quotient, the last one also standing for all that follow.
            let whole = n / d;
            let mut rest = n % d;
            let excess = (128 - whole.leading_zeros()).saturating_sub(64);
            let mut bits = (whole >> excess) as u64;
            let mut sticky = whole & ((1 << excess) - 1) != 0;
            let mut exponent = excess as i32;
            while bits >> 63 == 0 {
                let one = rest >= d - rest;
                rest = if one { rest - (d - rest) } else { rest * 2 };
                bits = bits * 2 + u64::from(one);
                exponent -= 1;
            }
            sticky |= rest != 0;
            (bits | u64::from(sticky)) as f64 * 2f64.powi(exponent)
        };
        if self.numerator < 0 {
            -magnitude
        } else {
            magnitude
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        if self.denominator == other.denominator {
            return self.numerator.cmp(&other.numerator);
        }
        if let (Some(left), Some(right)) = (
            self.numerator.checked_mul(other.denominator),
            other.numerator.checked_mul(self.denominator),
        ) {
            return left.cmp(&right);
        }
        // Continued fractions: compare integer parts, then the reciprocals of the rests the other way round.
        let (mut a, mut b) = (*self, *other);
        let mut swapped = false;
        loop {
            let order = a.floor().cmp(&b.floor());
            let (r, s) = (
                a.numerator.rem_euclid(a.denominator),
                b.numerator.rem_euclid(b.denominator),
            );
            let order = if order == Ordering::Equal && (r == 0 || s == 0) {
                r.cmp(&s)
            } else {
                order
            };
            if order != Ordering::Equal || r == 0 {
                return if swapped { order.reverse() } else { order };
            }
            a = Rational {
                numerator: a.denominator,
                denominator: r,
            };
            b = Rational {
                numerator: b.denominator,
                denominator: s,
            };
            swapped = !swapped;
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<i64> for Rational {
    fn from(n: i64) -> Rational {
        Rational::integer(n)
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.denominator == 1 {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}
