//! Operation counts beside SymPy's, on systems of textbooks.
//!
//! SymPy 1.14.0: `LagrangesMethod`, then `simplify` of mass matrix and forcing if that is shorter, then `cse` of the lower
//! triangle of M and f with the better of its optimizations; `count_ops` of all of it. SymPy counts what depends on
//! parameters alone with the rest, so ours are counted with the constants, which run once; and sin and cos apart, where
//! both are read.

use crate::plan::{Operation, Tape, Value};
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::BTreeSet;

/// Operations of a tape for M and f that SymPy counts as well.
fn count(tape: &Tape) -> usize {
    // What the energies ask for beside is not M or f.
    let blocks = || tape.blocks.iter().filter(|block| block.needs.runs(&[1]));
    let steps = || blocks().flat_map(|block| &block.steps);
    let writes = blocks().flat_map(|block| &block.writes);
    let mut read: BTreeSet<Value> = writes.map(|write| write.value).collect();
    read.extend(steps().flat_map(|step| step.operation.operands()));
    steps()
        .filter(|step| step.operation.is_work())
        .map(|step| match step.operation {
            Operation::SinCos(_) => [step.value.0, step.value.0 + 1]
                .into_iter()
                .filter(|value| read.contains(&Value(*value)))
                .count(),
            _ => 1,
        })
        .sum()
}

#[track_caller]
fn no_more_than(sympy: usize, declaration: TokenStream) {
    let program = crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let ours = count(&program.motion) + count(&program.constants);
    println!(
        "{ours} operations, {} of them once a run; SymPy {sympy}",
        count(&program.constants)
    );
    assert!(ours <= sympy, "{ours} operations, SymPy {sympy}");
}

#[test]
fn double_pendulum() {
    no_more_than(
        29,
        quote! {
            #[lagrange(
                coordinates(a, b),
                define(
                    x1 = l1*sin(a), y1 = -l1*cos(a),
                    x2 = x1 + l2*sin(b), y2 = y1 - l2*cos(b),
                ),
                kinetic = m1/2*(der(x1)^2 + der(y1)^2) + m2/2*(der(x2)^2 + der(y2)^2),
                potential = m1*g*y1 + m2*g*y2,
            )]
            struct S { m1: f64, m2: f64, l1: f64, l2: f64, g: f64 }
        },
    );
}

#[test]
fn cart_pole() {
    no_more_than(
        11,
        quote! {
            #[lagrange(
                coordinates(x, th),
                define(px = x + l*sin(th), py = l*cos(th)),
                kinetic = cart/2*der(x)^2 + m/2*(der(px)^2 + der(py)^2),
                potential = m*g*py,
            )]
            struct S { cart: f64, m: f64, l: f64, g: f64 }
        },
    );
}

/// Crank and rod by their angles, the slider at the end; what keeps it on its line is a constraint and counts for itself.
#[test]
fn slider_crank() {
    no_more_than(
        69,
        quote! {
            #[lagrange(
                coordinates(a, b),
                define(
                    cx = l1*cos(a) + l2/2*cos(b), cy = l1*sin(a) - l2/2*sin(b),
                    slider = l1*cos(a) + l2*cos(b),
                ),
                kinetic = j1/2*der(a)^2 + m2/2*(der(cx)^2 + der(cy)^2) + j2/2*der(b)^2 + ms/2*der(slider)^2,
                potential = m2*g*cy,
            )]
            struct S { j1: f64, j2: f64, m2: f64, ms: f64, l1: f64, l2: f64, g: f64 }
        },
    );
}

#[test]
fn gyroscope() {
    no_more_than(
        29,
        quote! {
            #[lagrange(
                coordinates(th, ph, ps),
                kinetic = a/2*(der(th)^2 + der(ph)^2*sin(th)^2) + c/2*(der(ps) + der(ph)*cos(th))^2,
                potential = m*g*l*cos(th),
            )]
            struct S { a: f64, c: f64, m: f64, g: f64, l: f64 }
        },
    );
}

#[test]
fn chain_of_five() {
    no_more_than(
        130,
        quote! {
            #[lagrange(
                coordinates(q[5]),
                define(
                    x[k in 0..5] = sum(i in 0..k+1: l*sin(q[i])),
                    y[k in 0..5] = sum(i in 0..k+1: -l*cos(q[i])),
                ),
                kinetic = sum(k in 0..5: m/2*(der(x[k])^2 + der(y[k])^2)),
                potential = sum(k in 0..5: m*g*y[k]),
            )]
            struct S { m: f64, l: f64, g: f64 }
        },
    );
}

/// CasADi 3.8.2 counts 4 855 instructions for M and f of twenty links and 28 645 for fifty, inputs and outputs among them
/// (`{'cse': True}`, unit masses and lengths).
#[test]
fn long_chains() {
    for (n, casadi, ours) in [(20_usize, 4_855, 1_000), (50, 28_645, 5_000)] {
        let n_ = proc_macro2::Literal::usize_unsuffixed(n);
        let chain = quote! {
            #[lagrange(
                coordinates(q[#n_]),
                define(
                    x[k in 0..#n_] = sum(i in 0..k+1: l*sin(q[i])),
                    y[k in 0..#n_] = sum(i in 0..k+1: -l*cos(q[i])),
                ),
                kinetic = sum(k in 0..#n_: m/2*(der(x[k])^2 + der(y[k])^2)),
                potential = sum(k in 0..#n_: m*g*y[k]),
            )]
            struct S { m: f64, l: f64, g: f64 }
        };
        // Three for each entry of M below the diagonal, and a multiple of n.
        assert!(3 * n * (n - 1) / 2 < ours && ours < casadi);
        no_more_than(ours, chain);
    }
}
