//! How many operations a plan has.

use crate::derive::Stage;
use crate::plan::mode::products::Plan;
use proc_macro2::TokenStream;
use quote::quote;

/// Operations of the motion tape when everything is held, and of the report.
fn operations(declaration: TokenStream) -> (usize, usize) {
    let program = crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let all = vec![!0; program.equations.needs.len().div_ceil(64)];
    (
        program.operations(Stage::Motion, &all),
        program.operations(Stage::Report, &all),
    )
}

#[test]
fn operation_counts_do_not_grow() {
    // By hand: three sin_cos and the difference, one scaling in M, 1 + 2 + 2 + 2 + 2 in f.
    assert_eq!(operations(chain(2)), (14, 26));
    // The same for six: 21 sin_cos and 15 differences, 15 in M, 15 + 6 + 30 + 30 + 6 in f.
    assert_eq!(operations(chain(6)), (138, 186));
    let wheel = crate::model::tests::MASS_ON_WHEEL.parse().expect("tokens");
    assert_eq!(operations(wheel), (26, 34));
    let top = quote! {
        #[lagrange(
            coordinates(phi, theta, psi),
            kinetic = i1/2*(der(theta)^2 + der(phi)^2*sin(theta)^2) + i3/2*(der(psi) + der(phi)*cos(theta))^2,
            potential = m*g*l*cos(theta),
        )]
        struct Top { i1: f64, i3: f64, m: f64, g: f64, l: f64 }
    };
    assert_eq!(operations(top), (19, 19));
    // Three differences, their squares and two sums, root, cube, one division, three products and their negatives.
    let two_bodies = quote! {
        #[lagrange(
            coordinates(x, y, z, u, v, w),
            kinetic = m/2*(der(x)^2 + der(y)^2 + der(z)^2) + n/2*(der(u)^2 + der(v)^2 + der(w)^2),
            potential = -g*m*n/sqrt((x - u)^2 + (y - v)^2 + (z - w)^2),
        )]
        struct Two { m: f64, n: f64, g: f64 }
    };
    assert_eq!(operations(two_bodies), (17, 31));
}

#[test]
fn energies_that_are_multiplied_out_stay_so() {
    let chain = quote! {
        #[lagrange(
            coordinates(q[12]),
            kinetic = m/2*l^2*sum(i in 0..12: sum(j in 0..12: (12 - max(i, j))*cos(q[i] - q[j])*der(q[i])*der(q[j]))),
            potential = -m*g*l*sum(i in 0..12: (12 - i)*cos(q[i])),
        )]
        struct Chain { m: f64, l: f64, g: f64 }
    };
    // By hand: 66 differences, sines and cosines with their weights, in f two products and two sums of each; 12 squares, and of the weights sine,
    // product and sum. Eleven of those sums fall away.
    assert_eq!(operations(chain).0, 66 * 8 + 12 * 4 - 11);
}

/// Sums over earlier coefficients that the series of a system without contacts have.
fn convolutions(declaration: TokenStream) -> usize {
    let program = crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Plan::new(&program.modes[0]).convolutions()
}

#[test]
fn series_of_chains_have_products_in_proportion_to_their_links() {
    // Of each link: sine and cosine, the square of the rate, sine and cosine times that and times the acceleration, and the two forces
    // times theirs: nine. Two and three links have no more by the elements of M and f.
    assert_eq!(
        [2, 3, 4, 5].map(|n| convolutions(chain(n))),
        [12, 27, 36, 45]
    );
}

#[test]
fn powers_have_two_products_however_many_operations_make_them() {
    let planet = |potential: TokenStream| {
        convolutions(quote! {
            #[lagrange(
                coordinates(x, y),
                kinetic = (der(x)^2 + der(y)^2)/2,
                potential = #potential,
            )]
            struct Planet { k: f64, l: f64 }
        })
    };
    // x², y², the power, and the two forces: what r and r³ would take is gone.
    assert_eq!(planet(quote!(-k / sqrt(x ^ 2 + y ^ 2))), 6);
    assert_eq!(planet(quote!(k / (x ^ 2 + y ^ 2))), 6);
    assert_eq!(planet(quote!(k * (x ^ 2 + y ^ 2) ^ 0.7)), 6);
    // One operation makes 1/x. A fourth power has a series where x vanishes too, which that of powers has not.
    assert_eq!(planet(quote!(k * ln(x) + k * y ^ 2 / 2)), 1);
    assert_eq!(planet(quote!(k * x ^ 5)), 2);
}

/// A chain of n point masses on rods.
fn chain(n: usize) -> TokenStream {
    let text = format!(
        "#[lagrange(
            coordinates(th[{n}]),
            define(
                px[k in 0..{n}] = sum(i in 0..k+1: l[i]*sin(th[i])),
                py[k in 0..{n}] = sum(i in 0..k+1: -l[i]*cos(th[i])),
            ),
            kinetic = sum(k in 0..{n}: m[k]/2*(der(px[k])^2 + der(py[k])^2)),
            potential = sum(k in 0..{n}: m[k]*g*py[k]),
        )]
        struct Chain {{ m: [f64; {n}], l: [f64; {n}], g: f64 }}"
    );
    text.parse().expect("tokens")
}
