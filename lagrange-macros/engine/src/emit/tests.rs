//! Emitted code reads as planned.

use super::{emit, tape};
use crate::derive::Stage;
use proc_macro2::TokenStream;
use quote::quote;

fn declared(input: TokenStream) -> crate::model::Declared {
    let mut sink = crate::diagnostics::Diagnostics::new();
    let declaration = crate::parse::declaration(input, &mut sink);
    crate::model::declared(&declaration.unwrap_or_else(|| panic!("{sink}")))
}

fn program(declaration: TokenStream) -> crate::plan::Program {
    crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// A mass on a spring that can be left out, with a floor below.
fn spring() -> TokenStream {
    quote! {
        #[lagrange(
            coordinates(x),
            kinetic = mass/2 * der(x)^2,
            potential = mass * gravity * x,
            potential(spring: stiffness/2 * (x - rest*cos(t))^2),
            contact(floor: x >= 0),
            start(high: x = 2*rest),
        )]
        pub struct Spring<T = f64> {
            pub mass: T,
            pub gravity: T,
            pub stiffness: T,
            pub rest: T,
        }
    }
}

/// Tokens compare without regard to white space.
#[track_caller]
fn check(emitted: &TokenStream, expected: TokenStream) {
    let (emitted, expected) = (emitted.to_string(), expected.to_string());
    assert!(
        emitted.contains(&expected),
        "\n{expected}\nis not in\n{emitted}"
    );
}

#[test]
fn a_tape_has_one_call_per_operation_and_one_if_per_block() {
    let motion = tape::tape(&program(spring()), Stage::Motion);
    check(
        &motion,
        quote! {
            let n3 = a.constant(0, c[2]);
            let mut sum2 = n3;
            if needs[0] & 2 != 0 {
                let (n4, n5) = a.sin_cos(1, n0);
                let n6 = a.scale(3, self.rest, n5);
                let n7 = a.sub(4, n1, n6);
                let n8 = a.scale(5, self.stiffness, n7);
                sum2 = a.sub(6, sum2, n8);
            }
            if needs[0] & 16 != 0 {
                y[0] = n1;
            }
            if needs[0] & 32 != 0 {
                y[1] = n2;
            }
            y[2] = sum2;
        },
    );
}

#[test]
fn constants_starts_and_handles() {
    let emitted = emit(&program(spring()), &declared(spring()), &[]);
    check(
        &emitted,
        quote! { pub const FLOOR: ::lagrange_core::handle::ContactId = ::lagrange_core::handle::ContactId(0); },
    );
}

#[test]
fn mistakes_come_with_an_implementation_that_type_checks() {
    let declaration = quote! {
        #[lagrange(coordinates(x), kinetic = mass/2 * der(y)^2, contact(floor: x >= 0))]
        struct Wrong<T> { mass: T }
    };
    let emitted = crate::expand(declaration);
    check(
        &emitted,
        quote!(impl<T: ::lagrange_core::arithmetic::Scalar> ::lagrange_core::system::System for Wrong<T>),
    );
    check(
        &emitted,
        quote!(pub const FLOOR: ::lagrange_core::handle::ContactId),
    );
    assert_eq!(emitted.to_string().matches("compile_error").count(), 1);
}
