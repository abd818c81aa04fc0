//! What all terms of a sum share.

use super::Factors;
use crate::symbolic::{ExprId, Rational};

/// A term of a sum: number · Π base^exponent.
type Term = (Rational, Factors);

/// Divides all terms by what they share, and returns it. A number is shared if it is whole, or in the company of letters.
pub(super) fn take_common(terms: &mut [Term]) -> Term {
    let common = shared_factors(terms);
    divide(terms, &common);
    let Some(number) = shared_number(terms, !common.is_empty()) else {
        return (Rational::ONE, common);
    };
    let quotients: Option<Vec<Rational>> =
        terms.iter().map(|(c, _)| c.checked_div(number)).collect();
    let Some(quotients) = quotients else {
        return (Rational::ONE, common);
    };
    for ((c, _), quotient) in terms.iter_mut().zip(quotients) {
        *c = quotient;
    }
    (number, common)
}

/// Powers that are in all terms: the least of positive whole ones, others if they are equal.
fn shared_factors(terms: &[Term]) -> Factors {
    let mut common: Factors = Vec::new();
    for &(base, first) in &terms[0].1 {
        let powers: Option<Vec<Rational>> = terms
            .iter()
            .map(|(_, factors)| {
                let own = factors.iter().find(|&&(other, _)| other == base)?;
                Some(own.1).filter(|power| power.is_negative() == first.is_negative())
            })
            .collect();
        let Some(least) = powers.as_ref().and_then(|powers| powers.iter().min()) else {
            continue;
        };
        if least.is_integer() && !first.is_negative() {
            common.push((base, *least));
        } else if powers.iter().flatten().all(|power| *power == first) {
            common.push((base, first));
        }
    }
    common
}

/// Takes powers out of all terms.
fn divide(terms: &mut [Term], common: &[(ExprId, Rational)]) {
    for &(base, exponent) in common {
        for (_, factors) in terms.iter_mut() {
            for factor in factors.iter_mut().filter(|factor| factor.0 == base) {
                factor.1 = factor.1.checked_sub(exponent).unwrap_or(Rational::ZERO);
            }
            factors.retain(|(_, exponent)| !exponent.is_zero());
        }
    }
}

/// The number that is put in front of a sum, with letters beside it or alone.
fn shared_number(terms: &[Term], beside_letters: bool) -> Option<Rational> {
    let minus = terms.iter().all(|(c, _)| c.is_negative());
    let number = match common_divisor(terms) {
        Some(whole) => Rational::new(if minus { -whole } else { whole }, 1),
        None if beside_letters => {
            most_frequent(terms).and_then(|n| if minus { n.checked_neg() } else { Some(n) })
        }
        None => None,
    };
    match number {
        None if minus && beside_letters => Some(Rational::MINUS_ONE),
        // A sign alone is not worth parentheses.
        Some(Rational::MINUS_ONE) if !beside_letters => None,
        number => number,
    }
}

/// The greatest common divisor of whole numbers.
fn common_divisor(terms: &[Term]) -> Option<i128> {
    let (mut over, mut under) = (0, 1);
    for (c, _) in terms {
        over = gcd(over, c.numerator().unsigned_abs());
        let denominator = c.denominator().unsigned_abs();
        under = (under / gcd(under, denominator)).saturating_mul(denominator);
    }
    i128::try_from(over).ok().filter(|_| under == 1)
}

/// Of fractions the one that most terms have.
fn most_frequent(terms: &[Term]) -> Option<Rational> {
    let size = |c: Rational| c.checked_abs().unwrap_or(c);
    let having = |n: Rational| terms.iter().filter(|(c, _)| size(*c) == n).count();
    terms
        .iter()
        .map(|(c, _)| size(*c))
        .max_by_key(|&n| (having(n), n))
        .filter(|&n| 2 * having(n) > terms.len() && !n.is_integer())
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { gcd(b, a % b) }
}
