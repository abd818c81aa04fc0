//! One operation of a tape → an expression of Rust. How values, numbers and functions are written there differs: emitted functions of modes work with
//! several motions side by side, everything else with one scalar.

use super::names::{index, local};
use crate::plan::{Coefficient, Operation, Value};
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};

/// How the operands of operations are written.
pub trait Notation {
    /// The local that holds a value.
    fn value(&self, value: Value) -> Ident;
    /// A number that is fixed during a run.
    fn coefficient(&self, coefficient: Coefficient) -> TokenStream;
    /// A function of x, and of what else it takes.
    fn call(&self, function: &str, x: Ident, more: Option<TokenStream>) -> TokenStream;
    /// A choice between two values.
    fn choice(&self, operation: Operation) -> TokenStream;
}

/// The value of the side that its branch is on.
pub fn select(operation: Operation, notation: &impl Notation) -> TokenStream {
    let Operation::Select(branch, x, y) = operation else {
        unreachable!("only starts choose by value")
    };
    let (held, branch) = (local("held"), index(branch));
    let [x, y] = [x, y].map(|value| notation.value(value));
    quote!(if #held.branch(#branch) { #x } else { #y })
}

/// The result of an operation; one with two results gives a pair.
pub fn expression(operation: Operation, notation: &impl Notation) -> TokenStream {
    let n = |value| notation.value(value);
    let fixed = |c| notation.coefficient(c);
    let infix = |x: &dyn ToTokens, sign: TokenStream, y: Value| {
        let y = n(y);
        quote!(#x #sign #y)
    };
    let call = |function: &str, x: Value| notation.call(function, n(x), None);
    match operation {
        Operation::Constant(c) => fixed(c),
        Operation::Add(x, y) => infix(&n(x), quote!(+), y),
        Operation::Sub(x, y) => infix(&n(x), quote!(-), y),
        Operation::Neg(x) => {
            let x = n(x);
            quote!(-#x)
        }
        Operation::Offset(c, x) => infix(&fixed(c), quote!(+), x),
        Operation::Scale(c, x) => infix(&fixed(c), quote!(*), x),
        Operation::Mul(x, y) => infix(&n(x), quote!(*), y),
        Operation::Square(x) => infix(&n(x), quote!(*), x),
        Operation::Div(x, y) => infix(&n(x), quote!(/), y),
        Operation::Ratio(c, x) => infix(&fixed(c), quote!(/), x),
        Operation::Sqrt(x) => call("sqrt", x),
        Operation::Powf(x, c) => notation.call("powf", n(x), Some(super::names::float(c))),
        Operation::Exp(x) => call("exp", x),
        Operation::Ln(x) => call("ln", x),
        Operation::SinCos(x) => call("sin_cos", x),
        Operation::SinhCosh(x) => call("sinh_cosh", x),
        Operation::Tan(x) => call("tan", x),
        Operation::Tanh(x) => call("tanh", x),
        Operation::Asin(x) => call("asin", x),
        Operation::Acos(x) => call("acos", x),
        Operation::Atan(x) => call("atan", x),
        Operation::Atan2(y, x) => notation.call("atan2", n(y), Some(n(x).to_token_stream())),
        Operation::Select(..) | Operation::Choose(..) => notation.choice(operation),
    }
}
