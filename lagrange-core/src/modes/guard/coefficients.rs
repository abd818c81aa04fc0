//! Sums, products and roots of the coefficients that guards consist of.

use super::LENGTH;
use crate::arithmetic::Scalar;
use crate::modes::reading::Terms;

/// Adds a number times a series.
pub(super) fn add<T: Scalar>(out: &mut [f64], (factor, terms): (f64, Terms<T>)) {
    for (c, x) in out.iter_mut().zip(terms.as_slice()) {
        *c += factor * x.value();
    }
}

/// Adds `factor` times the product of two series.
pub(super) fn add_product(out: &mut [f64], factor: f64, x: &[f64], y: &[f64]) {
    for (k, c) in out.iter_mut().enumerate() {
        let products = x[..=k].iter().zip(y[..=k].iter().rev());
        *c += factor * products.map(|(x, y)| x * y).sum::<f64>();
    }
}

/// A series as numbers.
pub(super) fn numbers<T: Scalar>(terms: Terms<T>) -> [f64; LENGTH] {
    let mut out = [0.0; LENGTH];
    add(&mut out, (1.0, terms));
    out
}

/// Adds the root of a series, as far as it has one.
pub(super) fn add_root(out: &mut [f64], square: &[f64]) {
    let mut root = [0.0; LENGTH];
    root[0] = square[0].sqrt();
    for k in (1..square.len()).take_while(|_| square[0] > 0.0) {
        let products = (1..k).map(|j| root[j] * root[k - j]).sum::<f64>();
        root[k] = (square[k] - products) / (root[0] + root[0]);
    }
    for (c, x) in out.iter_mut().zip(root) {
        *c += x;
    }
}

/// Multiplies each coefficient by its factor.
pub fn scale(series: &mut [f64], powers: &[f64]) {
    for (c, power) in series.iter_mut().zip(powers) {
        *c *= power;
    }
}
