//! The rule of each operation: its coefficient k from that of its operands and from sums over earlier ones.

use super::Expansion;
use crate::emit::names::{self, index, local};
use crate::emit::operation::Notation;
use crate::plan::{Operation, Step, Value};
use proc_macro2::TokenStream;
use quote::quote;

impl Expansion<'_> {
    /// Coefficient k of a step. That of the unknowns is not there yet where it is not `known`.
    pub(super) fn coefficient(&self, step: &Step, known: bool) -> TokenStream {
        if !self.plan.varying[step.value.0] {
            return TokenStream::new();
        }
        let number = &self.writer.number;
        let n = |value| self.writer.value(value);
        let share = local("share");
        let z = step.value;
        let s = |at: usize| self.product(z, at);
        let d = |x: Value| self.d(x);
        let i = self.inverse(z);
        let zero = || quote!(#number::of(0.0));
        let bind = |value: Value, result: TokenStream| {
            let name = self.coefficient_of(value);
            if self.crossing.contains(&value) {
                quote!(#name = #result;)
            } else {
                quote!(let #name = #result;)
            }
        };
        let twice = |x: TokenStream| quote!((#x + #x));
        // −(Σ zⱼ yₖ₋ⱼ)/y₀, j < k
        let divided = |dy: TokenStream| {
            let (z0, s) = (n(z), s(0));
            quote!(#number::fused(-(#z0 * #i), #dy, -(#s * #i)))
        };
        // What depends on coefficient k of an operand enters last, in one operation: each order waits for it.
        if let Some(power) = self.plan.power(z) {
            let (z0, dx, one, two) = (n(z), d(power.base), s(0), s(1));
            let e = names::float(power.exponent);
            let slope = quote!((#number::of(#e) * #z0 * #i));
            return bind(
                z,
                quote!(#number::fused(#slope, #dx, (#number::of(#e) * #two - #one) * (#share * #i))),
            );
        }
        let result = match step.operation {
            Operation::Add(x, y) => match (d(x), d(y)) {
                (Some(x), Some(y)) => quote!(#x + #y),
                (Some(x), None) | (None, Some(x)) => x,
                (None, None) => zero(),
            },
            Operation::Sub(x, y) => match (d(x), d(y)) {
                (Some(x), Some(y)) => quote!(#x - #y),
                (Some(x), None) => x,
                (None, Some(y)) => quote!(-#y),
                (None, None) => zero(),
            },
            Operation::Neg(x) => {
                let x = d(x);
                quote!(-#x)
            }
            Operation::Offset(_, x) => {
                let x = d(x);
                quote!(#x)
            }
            Operation::Scale(c, x) => {
                let (c, x) = (self.writer.coefficient(c), d(x));
                quote!(#c * #x)
            }
            Operation::Mul(x, y) => {
                let (x0, y0) = (n(x), n(y));
                match (d(x), d(y)) {
                    (Some(_), Some(dy)) if !known && self.is_unknown(x) => {
                        let s = s(0);
                        quote!(#number::fused(#x0, #dy, #s))
                    }
                    (Some(dx), Some(_)) if !known && self.is_unknown(y) => {
                        let s = s(0);
                        quote!(#number::fused(#y0, #dx, #s))
                    }
                    (Some(dx), Some(dy)) => {
                        let s = s(0);
                        quote!(#number::fused(#x0, #dy, #number::fused(#dx, #y0, #s)))
                    }
                    (Some(dx), None) => quote!(#dx * #y0),
                    (None, Some(dy)) => quote!(#x0 * #dy),
                    (None, None) => zero(),
                }
            }
            Operation::Square(x) => {
                let (x0, dx, s) = (n(x), d(x), s(0));
                quote!(#number::fused(#x0 + #x0, #dx, #s))
            }
            Operation::Div(x, y) => match (d(x), d(y).map(divided)) {
                (Some(dx), Some(rest)) => quote!(#number::fused(#i, #dx, #rest)),
                (None, Some(rest)) => rest,
                (dx, None) => quote!(#dx * #i),
            },
            Operation::Ratio(_, y) => d(y).map_or_else(zero, divided),
            Operation::Sqrt(x) => {
                let (dx, s) = (d(x), s(0));
                quote!(#number::fused(#i, #dx, -(#s * #i)))
            }
            Operation::Exp(x) => {
                let (z0, dx, s) = (n(z), d(x), s(0));
                quote!(#number::fused(#z0, #dx, #s * #share))
            }
            Operation::Ln(x) => {
                let (dx, s) = (d(x), s(0));
                quote!(#number::fused(#i, #dx, -(#s * (#share * #i))))
            }
            Operation::SinCos(x) | Operation::SinhCosh(x) => {
                let second = Value(z.0 + 1);
                let (z0, u0, dx) = (n(z), n(second), d(x));
                let (one, two) = (s(0), s(1));
                let first = bind(z, quote!(#number::fused(#u0, #dx, #one * #share)));
                let other = quote!(#number::fused(#z0, #dx, #two * #share));
                let other = match step.operation {
                    Operation::SinCos(_) => bind(second, quote!(-#other)),
                    _ => bind(second, other),
                };
                return quote!(#first #other);
            }
            Operation::Tan(x) | Operation::Tanh(x) => {
                let (z0, u0, dx, one, two) = (n(z), self.auxiliary(z), d(x), s(0), s(1));
                let first = bind(z, quote!(#number::fused(#u0, #dx, #one * #share)));
                let dz = self.coefficient_of(z);
                let half = twice(quote!(#z0 * #dz));
                let change = match step.operation {
                    Operation::Tan(_) => quote!(#half + #two),
                    _ => quote!(-(#half + #two)),
                };
                let second = self.auxiliary_next(z, change);
                return quote!(#first #second);
            }
            Operation::Asin(x) | Operation::Acos(x) => {
                let (x0, dx) = (n(x), d(x));
                let (one, two, three) = (s(0), s(1), s(2));
                let half = twice(quote!(#x0 * #dx));
                let u = quote!(-(#half + #two + #three) * #number::of(0.5) * #i);
                let second = self.auxiliary_next(z, u);
                let turn = match step.operation {
                    Operation::Asin(_) => quote!(#dx),
                    _ => quote!((-#dx)),
                };
                let first = bind(z, quote!((#turn - #one * #share) * #i));
                return quote!(#first #second);
            }
            Operation::Atan(x) => {
                let (x0, dx, one, two) = (n(x), d(x), s(0), s(1));
                let half = twice(quote!(#x0 * #dx));
                let second = self.auxiliary_next(z, quote!(#half + #two));
                let first = bind(z, quote!((#dx - #one * #share) * #i));
                return quote!(#first #second);
            }
            Operation::Atan2(y, x) => {
                let (y0, x0) = (n(y), n(x));
                let (dy, dx) = (d(y).unwrap_or_else(zero), d(x).unwrap_or_else(zero));
                let [one, two, three, four, five] = [s(0), s(1), s(2), s(3), s(4)];
                let half = twice(quote!((#y0 * #dy + #x0 * #dx)));
                let second = self.auxiliary_next(z, quote!(#half + #four + #five));
                let earlier = quote!((#one - #two + #three) * #share);
                let first = bind(z, quote!((#dy * #x0 - #dx * #y0 - #earlier) * #i));
                return quote!(#first #second);
            }
            Operation::Select(branch, x, y) => {
                let (held, branch) = (local("held"), index(branch));
                let (x, y) = (d(x).unwrap_or_else(zero), d(y).unwrap_or_else(zero));
                quote!(if #held.branch(#branch) { #x } else { #y })
            }
            Operation::Powf(..) => unreachable!("a power has the rule of powers"),
            Operation::Constant(_) | Operation::Choose(..) => zero(),
        };
        bind(z, result)
    }

    /// Whether the rule of a step divides by something.
    pub(super) fn needs_inverse(&self, step: &Step) -> bool {
        use Operation::*;
        let divides = matches!(
            step.operation,
            Div(..) | Ratio(..) | Sqrt(_) | Ln(_) | Asin(_) | Acos(_) | Atan(_) | Atan2(..)
        );
        divides || self.plan.power(step.value).is_some()
    }

    fn auxiliary_next(&self, value: Value, result: TokenStream) -> TokenStream {
        let name = self.auxiliary_coefficient(value);
        match self.writer.declared.contains(&value) {
            true => quote!(#name = #result;),
            false => quote!(let #name = #result;),
        }
    }
}

pub(super) fn needs_auxiliary(operation: Operation) -> bool {
    use Operation::*;
    matches!(
        operation,
        Tan(_) | Tanh(_) | Asin(_) | Acos(_) | Atan(_) | Atan2(..)
    )
}
