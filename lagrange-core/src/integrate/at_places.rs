//! Polynomials at several places at once, as quadratures and looks between the ends of a step ask for them.

use crate::arithmetic::quad::{Quad, QuadBody, side_by_side};
use crate::arithmetic::{Pack, Scalar};

/// k as a number.
pub(crate) const ORDERS: [f64; 64] = {
    let mut table = [0.0; 64];
    let mut k = 1;
    while k < 64 {
        table[k] = k as f64;
        k += 1;
    }
    table
};

/// How many places there are.
pub(crate) const PLACES: usize = 8;

/// A number for each of them.
pub(crate) type AtPlaces = Pack<f64, PLACES>;

/// Σ cₖ sᵏ at each place s, as [`super::horner`] gives it for the values of the coefficients.
pub(crate) fn horner_at<T: Scalar>(c: &[T], places: AtPlaces) -> AtPlaces {
    side_by_side::<AtAll<false>, _>((c, places))
}

/// Σ k cₖ sᵏ⁻¹ at each place s, as [`super::polynomial_derivative`] gives it.
pub(crate) fn derivative_at<T: Scalar>(c: &[T], places: AtPlaces) -> AtPlaces {
    side_by_side::<AtAll<true>, _>((c, places))
}

/// A polynomial, or its derivative.
struct AtAll<const DERIVATIVE: bool>;

impl<T: Scalar, const DERIVATIVE: bool> QuadBody<(&[T], AtPlaces)> for AtAll<DERIVATIVE> {
    type Output = AtPlaces;

    #[inline(always)]
    fn run<Q: Quad>(quad: Q, (c, Pack([a, b, c_, d, e, f, g, h])): (&[T], AtPlaces)) -> AtPlaces {
        let (first, second) = (quad.four([a, b, c_, d]), quad.four([e, f, g, h]));
        let (mut at_first, mut at_second) = (quad.splat(0.0), quad.splat(0.0));
        let mut k = c.len();
        while k > usize::from(DERIVATIVE) {
            k -= 1;
            let factor = if DERIVATIVE { ORDERS[k] } else { 1.0 };
            let next = quad.splat(factor * c[k].value());
            at_first = quad.sum(quad.product(at_first, first), next);
            at_second = quad.sum(quad.product(at_second, second), next);
        }
        let [a, b, c, d] = quad.numbers(at_first);
        let [e, f, g, h] = quad.numbers(at_second);
        Pack([a, b, c, d, e, f, g, h])
    }
}
