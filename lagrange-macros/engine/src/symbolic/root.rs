//! Numbers to rational powers, split into primes: √8 = 2 · 2^(1/2), √(1/2) = 1/2 · 2^(1/2), √(9/4) = 3/2.

use super::product::Factors;
use super::{Outgrown, Pool, Rational};

impl Pool {
    /// Multiplies by n^r.
    pub(super) fn multiply_number(&mut self, all: &mut Factors, n: Rational, r: Rational) {
        if n.is_zero() {
            if r.is_negative() {
                let zero = self.integer(0);
                all.plain.push((zero, r));
            } else {
                all.coefficient = n;
            }
            return;
        }
        if let Some(k) = r.to_integer() {
            let power = if k == 1 {
                n
            } else {
                self.checked(n.pow_int(k))
            };
            all.coefficient = self.times(all.coefficient, power);
            return;
        }
        if n.is_negative() {
            let base = self.integer(-1);
            all.plain.push((base, r));
        }
        self.multiply_primes(all, n.numerator().unsigned_abs(), r);
        let below = self.negative(r);
        self.multiply_primes(all, n.denominator().unsigned_abs(), below);
    }

    /// Multiplies by n^r as a product of powers of primes.
    fn multiply_primes(&mut self, all: &mut Factors, n: u128, r: Rational) {
        // Trial division that far finds all common literals; a cofactor beyond it stays one base.
        const LARGEST_TRIAL: u128 = 1000;
        let mut n = n;
        let mut prime = 2;
        while n > 1 && prime <= LARGEST_TRIAL {
            if prime * prime > n {
                prime = n;
            }
            let mut count = 0;
            while n.is_multiple_of(prime) {
                n /= prime;
                count += 1;
            }
            if count > 0 {
                self.multiply_prime(all, prime, count, r);
            }
            prime += 1;
        }
        if n > 1 {
            // A large cofactor of a root is mostly a perfect square.
            let root = integer_root(n);
            if root * root == n {
                self.multiply_prime(all, root, 2, r);
            } else {
                self.multiply_prime(all, n, 1, r);
            }
        }
    }

    fn multiply_prime(&mut self, all: &mut Factors, prime: u128, count: i64, r: Rational) {
        let Some(prime) = i128::try_from(prime).ok().and_then(|n| Rational::new(n, 1)) else {
            self.note_outgrown(Outgrown::Numbers);
            return;
        };
        let exponent = self.times(r, Rational::integer(count));
        let base = self.number(prime);
        all.plain.push((base, exponent));
    }
}

/// ⌊√n⌋ by Newton's iteration from above.
fn integer_root(n: u128) -> u128 {
    if n < 2 {
        return n;
    }
    let mut root = 1_u128 << (128 - n.leading_zeros()).div_ceil(2);
    loop {
        let next = (root + n / root) / 2;
        if next >= root {
            return root;
        }
        root = next;
    }
}
