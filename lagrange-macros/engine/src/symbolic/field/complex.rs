//! Points of the circle c² + s² = 1 as numbers c + i s with i² = −1: angles add where the numbers multiply.

use super::Prime;

/// cos α + i sin α; on the way to one, a number of any length.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Turn {
    pub cos: u64,
    pub sin: u64,
}

impl Turn {
    pub const NONE: Turn = Turn { cos: 1, sin: 0 };

    /// The turn by twice the angle of a + b i, which may have any length but 0: that is a² + b² ≠ 0, since −1 is no square.
    pub fn twice(field: Prime, Turn { cos: a, sin: b }: Turn) -> Turn {
        let [aa, ab, bb] = [(a, a), (a, b), (b, b)].map(|(x, y)| field.mul(x, y));
        let below = field.inverse(field.add(aa, bb)).unwrap_or(1);
        Turn {
            cos: field.mul(field.sub(aa, bb), below),
            sin: field.mul(field.add(ab, ab), below),
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
