//! The rule of each operation: its coefficient k from those of its operands, the values at τ = 0 and the sums of earlier products.

use super::Step;
use crate::arithmetic::Number;
use crate::program::instruction::{Instruction, Op, Program, Register};

/// Coefficient k of a list of numbers.
#[inline(always)]
pub(super) fn advance<T: Number, const N: usize>(
    steps: &[Step],
    program: &Program,
    sums: &[T],
    k: usize,
    first: &[T; N],
    now: &mut [T; N],
) {
    let terms = &program.terms[..];
    let order = T::of(k as f64);
    for &Step {
        instruction,
        product,
    } in steps
    {
        let Instruction { op, to, x, y } = instruction;
        let at = |register: Register| now[register.index() & (N - 1)];
        let start = |register: Register| first[register.index() & (N - 1)];
        let sum = |number: usize| sums[product as usize + number];
        let value = match op {
            Op::Copy => at(x),
            Op::Add => at(x) + at(y),
            Op::Sub => at(x) - at(y),
            Op::Neg => -at(x),
            Op::Scale => start(x) * at(y),
            Op::Mul => start(x).mul_add(at(y), at(x).mul_add(start(y), sum(0))),
            Op::Square => {
                let half = start(x) * at(x);
                sum(0) + (half + half)
            }
            Op::Div => (at(x) - start(to).mul_add(at(y), sum(0))) / start(y),
            Op::Sqrt => (at(x) - sum(0)) / (start(to) + start(to)),
            Op::Powf => {
                let earlier = start(y) * sum(1) - sum(0);
                (start(y) * at(x) * start(to) + earlier / order) / start(x)
            }
            Op::Exp => start(to) * at(x) + sum(0) / order,
            Op::Ln => (at(x) - sum(0) / order) / start(x),
            Op::Sum => {
                let terms = &terms[x.index()..y.index()];
                let add =
                    |sum, &(factor, x): &(Register, Register)| start(factor).mul_add(at(x), sum);
                terms.iter().fold(T::of(0.0), add)
            }
            Op::Atan2 => {
                let earlier = (sum(0) - sum(3) + sum(4)) / order;
                let turn = at(x) * start(y) - at(y) * start(x);
                let half = start(x) * at(x) + start(y) * at(y);
                let second = to.next();
                now[second.index() & (N - 1)] = half + half + sum(1) + sum(2);
                (turn - earlier) / start(second)
            }
            Op::Asin | Op::Acos => {
                let second = to.next();
                let (half, u0) = (start(x) * at(x), start(second));
                let x = if op == Op::Asin { at(x) } else { -at(x) };
                now[second.index() & (N - 1)] = -(half + half + sum(1) + sum(2)) / (u0 + u0);
                (x - sum(0) / order) / u0
            }
            _ => {
                let second = to.next();
                let values = [start(x), start(to), start(second)];
                let (z, u) = pair(op, at(x), values, [sum(0), sum(1)], order);
                now[second.index() & (N - 1)] = u;
                z
            }
        };
        now[to.index() & (N - 1)] = value;
    }
}

/// Coefficient k of the other operations with two results, from that of x, the values of x, z, u, and the sums.
#[inline(always)]
fn pair<T: Number>(op: Op, x: T, [x0, z0, u0]: [T; 3], sums: [T; 2], order: T) -> (T, T) {
    let earlier = sums[0] / order;
    let twice = |c: T| c + c;
    match op {
        Op::SinCos => (u0.mul_add(x, earlier), -z0.mul_add(x, sums[1] / order)),
        Op::SinhCosh => (u0.mul_add(x, earlier), z0.mul_add(x, sums[1] / order)),
        Op::Tan => {
            let z = u0 * x + earlier;
            (z, twice(z0 * z) + sums[1])
        }
        Op::Tanh => {
            let z = u0 * x + earlier;
            (z, -(twice(z0 * z) + sums[1]))
        }
        // Atan
        _ => ((x - earlier) / u0, twice(x0 * x) + sums[1]),
    }
}
