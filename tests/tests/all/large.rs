//! Large tapes, which are emitted as data: every operation of the language against the interpretation of the same
//! declaration, to the last bit; and what a chain's declaration expands to, twice.

use crate::interpretation::{check, check_derivatives};
use lagrange_core::prelude::*;

/// Every function of many coordinates, with what can be left out, so that blocks are skipped.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[24]),
    kinetic = sum(i in 0..24: mass[i]/2 * der(x[i])^2),
    kinetic(tied: sum(i in 0..23: mass[i]/8 * sin(x[i])^2 * (der(x[i+1]) - der(x[i]))^2)),
    potential(circular: stiffness * sum(i in 0..23: sin(x[i] - x[i+1]) + tan(x[i]/9) + cos(2*x[i])^3)),
    potential(inverse: sum(i in 0..24: asin(x[i]/5) + acos(x[i]/6) + atan(x[i]) + atan2(x[i], 1 + x[i]^2))),
    potential(growing: sum(i in 0..24: sinh(x[i]) + tanh(x[i]) + exp(-x[i]) + ln(3 + x[i]) + (1 + x[i])^0.3)),
    potential(roots: sum(i in 0..23: sqrt(1 + (x[i] - x[i+1])^2) + stiffness/(2 + x[i]*x[i+1]))),
    potential(broken: sum(i in 0..12: stiffness*max(x[i]^2, 1.1*x[i+12]))),
    force(push: x[3] = pi * stiffness * t * sin(x[4])),
    contact(floor: x[7] >= 0.1),
    observe(middle = sum(i in 0..24: x[i])/24),
)]
struct Functions {
    mass: [f64; 24],
    stiffness: f64,
}

impl Default for Functions {
    fn default() -> Self {
        Self {
            mass: [1.0; 24],
            stiffness: 2.0,
        }
    }
}

#[test]
fn a_tape_as_data_computes_as_declared() {
    let source = include_str!("large.rs");
    check::<Functions>(source);
    check_derivatives::<Functions>(source);
}

/// Tokens of a chain of n links.
fn chain(n: usize) -> String {
    let text = format!(
        "#[lagrange(
            coordinates(theta[{n}]),
            define(
                x[k in 0..{n}] = sum(i in 0..k+1: length[i] * sin(theta[i])),
                y[k in 0..{n}] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
            ),
            kinetic = sum(k in 0..{n}: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
            potential = sum(k in 0..{n}: mass[k] * gravity * y[k]),
        )]
        struct Chain {{ mass: [f64; {n}], length: [f64; {n}], gravity: f64 }}"
    );
    let tokens = text.parse().expect("tokens");
    lagrange_engine::expand(tokens).to_string()
}

#[test]
fn expansions_are_the_same_byte_for_byte() {
    for n in [3, 12, 30] {
        assert_eq!(chain(n), chain(n));
    }
}
