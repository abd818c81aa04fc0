//! Seeded random expressions over x, y, z.

use super::read::Desk;
use crate::symbolic::{ExprId, Function, Rational};

/// Seeded random numbers.
pub(super) struct Random(fastrand::Rng);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.0.u64(..n)
    }

    /// Uniform in (low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }
}

/// What has been built, in the order of building, so that it can be read twice: once by the pool and once by an
/// arithmetic that knows nothing of it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Leaf(usize),
    Number(i64, i64),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Power(usize, i64, i64),
    General(usize, usize),
    Call(Function, usize),
    Atan2(usize, usize),
    Select(usize, usize),
}

/// A program of random steps; the last is the result.
pub(super) fn program(random: &mut Random, length: usize) -> Vec<Step> {
    const FUNCTIONS: [Function; 9] = [
        Function::Sin,
        Function::Cos,
        Function::Sin,
        Function::Cos,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Atan,
        Function::Tan,
    ];
    let mut steps = vec![Step::Leaf(0), Step::Leaf(1), Step::Leaf(2)];
    for _ in 0..length {
        // Mostly recent steps, so that little is left unused.
        let count = steps.len() as u64;
        let mut pick = || {
            let window = u64::min(count, 5);
            let low = if random.below(3) == 0 {
                0
            } else {
                count - window
            };
            (low + random.below(count - low)) as usize
        };
        let (a, b) = (pick(), pick());
        steps.push(match random.below(16) {
            0..=3 => Step::Add(a, b),
            4 | 5 => Step::Sub(a, b),
            6..=8 => Step::Mul(a, b),
            9 => Step::Div(a, b),
            10 => Step::Power(a, random.below(6) as i64 - 2, 1 + random.below(2) as i64),
            11 => Step::Number(random.below(9) as i64 - 4, 1 + random.below(3) as i64),
            12 | 13 => Step::Call(FUNCTIONS[random.below(9) as usize], a),
            14 => match random.below(4) {
                0 => Step::Atan2(a, b),
                1 => Step::General(a, b),
                2 => Step::Call(Function::Exp, a),
                _ => Step::Call(Function::Ln, a),
            },
            _ => Step::Select(a, b),
        });
    }
    steps
}

/// Builds a program; None where it divides by the number 0.
pub(super) fn build(desk: &mut Desk, steps: &[Step]) -> Option<ExprId> {
    let leaves = ["x", "y", "z"].map(|name| {
        let symbol = desk.symbol(name);
        desk.pool.leaf(symbol)
    });
    let pool = &mut desk.pool;
    let mut built: Vec<ExprId> = Vec::new();
    for &step in steps {
        let e = match step {
            Step::Leaf(i) => leaves[i],
            Step::Number(n, d) => pool.number(Rational::new(n.into(), d.into())?),
            Step::Add(a, b) => pool.add(built[a], built[b]),
            Step::Sub(a, b) => pool.sub(built[a], built[b]),
            Step::Mul(a, b) => pool.mul(built[a], built[b]),
            Step::Div(a, b) => pool.div(built[a], built[b])?,
            Step::Power(a, n, d) => {
                let exponent = pool.number(Rational::new(n.into(), d.into())?);
                pool.pow(built[a], exponent)?
            }
            Step::General(a, b) => pool.pow(built[a], built[b])?,
            Step::Call(f, a) => pool.call(f, &[built[a]]),
            Step::Atan2(a, b) => pool.call(Function::Atan2, &[built[a], built[b]]),
            Step::Select(a, b) => pool.select(a % 2, built[a], built[b]),
        };
        built.push(e);
    }
    built.last().copied()
}
