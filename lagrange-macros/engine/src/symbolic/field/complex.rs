//! Points of the circle c² + s² = 1 as numbers c + i s with i² = −1: angles add where the numbers multiply.

use super::Prime;

/// cos α + i sin α
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Turn {
    pub cos: u64,
    pub sin: u64,
}

impl Turn {
    pub const NONE: Turn = Turn { cos: 1, sin: 0 };

    /// ((1 − t²) + 2 t i)/(1 + t²): every point of the circle but −1. 1 + t² is never 0, since −1 is no square.
    pub fn parametrized(field: Prime, t: u64) -> Turn {
        let square = field.mul(t, t);
        let below = field.inverse(field.add(1, square)).unwrap_or(1);
        Turn {
            cos: field.mul(field.sub(1, square), below),
            sin: field.mul(field.add(t, t), below),
        }
    }

    /// α + β
    pub fn and(self, field: Prime, other: Turn) -> Turn {
        let (a, b, c, d) = (self.cos, self.sin, other.cos, other.sin);
        Turn {
            cos: field.sub(field.mul(a, c), field.mul(b, d)),
            sin: field.add(field.mul(a, d), field.mul(b, c)),
        }
    }

    /// n α
    pub fn times(self, field: Prime, n: i128) -> Turn {
        let (mut base, mut left, mut result) = (self, n.unsigned_abs(), Turn::NONE);
        while left > 0 {
            if left & 1 == 1 {
                result = result.and(field, base);
            }
            left >>= 1;
            if left > 0 {
                base = base.and(field, base);
            }
        }
        if n < 0 {
            result.sin = field.neg(result.sin);
        }
        result
    }
}
