//! Values, rates and gradients of the declared quantities at a state.
//!
//! A motion q + vτ + ½aτ² goes through the operations as [`Series`]. Gradients come from one sweep backwards: a change δx(τ)
//! of an operand changes f(x) by f'(x)δx, so that the weights w̄ₖ of the coefficients of a value go back by convolution with
//! f'(x), and those of a derivative y = ẋ by x̄ₖ₊₁ += (k+1) ȳₖ (Griewank & Walther 2008, chapter 13). With
//!
//! ```text
//! ∂L₀/∂q₁ = ∂L/∂v        ∂L₁/∂q₁ = d/dt ∂L/∂v + ∂L/∂q        ∂L₀/∂q₀ = ∂L/∂q
//! ```
//!
//! two sweeps, from the weights of L and of everything that forces act on, are all of d/dt ∂L/∂v − ∂L/∂q − Q.

use super::series::{Series, function, power};
use super::{Declaration, op};

/// What a declaration is evaluated at.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// Parameters, in the order of the description.
    pub parameters: &'a [f64],
    /// t
    pub time: f64,
    /// q
    pub q: &'a [f64],
    /// v
    pub v: &'a [f64],
    /// dv/dt
    pub acceleration: &'a [f64],
    /// λ of every row.
    pub forces: &'a [f64],
    /// Values of the applied forces.
    pub loads: &'a [f64],
}

/// A weight of a coefficient of a value: (value, power of τ, weight).
pub type Seed = (usize, usize, f64);

/// Evaluates a declaration; keeps the memory for it.
#[derive(Clone, Debug)]
pub struct Evaluator {
    declaration: &'static Declaration,
    values: Vec<Series>,
    /// Derivative of each value by its operands.
    slopes: Vec<[Series; 2]>,
    /// The operands that the derivatives are by.
    operands: Vec<[usize; 2]>,
    weights: Vec<[f64; 3]>,
}

/// No operand.
const NOTHING: usize = usize::MAX;

impl Evaluator {
    /// An evaluator of everything but pictures, without values.
    pub fn new(declaration: &'static Declaration) -> Self {
        Self::of(declaration, declaration.values)
    }

    /// An evaluator of everything, without values.
    pub fn with_pictures(declaration: &'static Declaration) -> Self {
        Self::of(declaration, declaration.words.len() / 12)
    }

    /// An evaluator of so many values.
    fn of(declaration: &'static Declaration, count: usize) -> Self {
        Self {
            declaration,
            values: Vec::with_capacity(count),
            slopes: Vec::with_capacity(count),
            operands: Vec::with_capacity(count),
            weights: vec![[0.0; 3]; count],
        }
    }

    /// Number of operations, each of which rounds.
    pub fn operations(&self) -> usize {
        self.weights.len()
    }

    /// Takes another state.
    pub fn evaluate(&mut self, x: Inputs<'_>) {
        self.values.clear();
        self.slopes.clear();
        self.operands.clear();
        let one = Series::constant(1.0);
        let none = [Series::default(); 2];
        let words = self.declaration.words.chunks_exact(12);
        for words in words.take(self.weights.len()) {
            let word = |k: usize| {
                let bytes = [words[k], words[k + 1], words[k + 2], words[k + 3]];
                u32::from_le_bytes(bytes)
            };
            let (code, i, j) = (word(0), word(4) as usize, word(8) as usize);
            let number = |list: &[f64]| (Series::constant(list[i]), none, [NOTHING; 2]);
            let n = |i: usize| self.values[i];
            let (value, slopes, operands) = match code & 255 {
                op::NUMBER => number(self.declaration.numbers),
                op::PARAMETER => number(x.parameters),
                op::FORCE => number(x.forces),
                op::LOAD => number(x.loads),
                op::TIME => (Series([x.time, 1.0, 0.0]), none, [NOTHING; 2]),
                op::POSITION => {
                    let moves = Series([x.q[i], x.v[i], 0.5 * x.acceleration[i]]);
                    (moves, none, [NOTHING; 2])
                }
                op::ADD => (n(i) + n(j), [one, one], [i, j]),
                op::MULTIPLY => (n(i) * n(j), [n(j), n(i)], [i, j]),
                op::POWER => {
                    let c = self.declaration.numbers[j];
                    let (value, slope) = n(i).of(power(n(i).0[0], c));
                    (value, [slope, one], [i, NOTHING])
                }
                op::DERIVATIVE => (n(i).derivative(), none, [i, NOTHING]),
                op::SELECT => {
                    let chosen = if n((code >> 8) as usize).0[0] >= 0.0 {
                        i
                    } else {
                        j
                    };
                    (n(chosen), [one, one], [chosen, NOTHING])
                }
                op::ATAN2 => {
                    let (value, slopes) = n(i).atan2(n(j));
                    (value, slopes, [i, j])
                }
                call => {
                    let (value, slope) = n(i).of(function(call - op::FUNCTIONS, n(i).0[0]));
                    (value, [slope, one], [i, NOTHING])
                }
            };
            self.values.push(value);
            self.slopes.push(slopes);
            self.operands.push(operands);
        }
    }

    /// A value at the state.
    pub fn value(&self, value: usize) -> f64 {
        self.values[value].0[0]
    }

    /// Coefficient of a value's series at the state.
    pub fn coefficient(&self, value: usize, power: usize) -> f64 {
        self.values[value].0[power]
    }

    /// d/dt of a value.
    pub fn rate(&self, value: usize) -> f64 {
        self.values[value].0[1]
    }

    /// Σ weight · ∂value/∂qₖ of all seeds for every coordinate, k = `power`, added to `sums`; and the same of absolute values,
    /// which rounding errors and errors of the state are relative to, to `sizes`.
    pub fn sweep(&mut self, seeds: &[Seed], power: usize, sums: &mut [f64], sizes: &mut [f64]) {
        self.back(seeds, power, sums, |x| x);
        self.back(seeds, power, sizes, f64::abs);
    }

    /// The sizes of [`Self::sweep`] alone.
    pub fn gradient_size(&mut self, seeds: &[Seed], power: usize, sizes: &mut [f64]) {
        self.back(seeds, power, sizes, f64::abs);
    }

    fn back(&mut self, seeds: &[Seed], power: usize, out: &mut [f64], of: impl Fn(f64) -> f64) {
        let Some(last) = seeds.iter().map(|seed| seed.0).max() else {
            return;
        };
        self.weights[..=last].fill([0.0; 3]);
        for &(value, k, weight) in seeds {
            self.weights[value][k] += of(weight);
        }
        for at in (0..=last).rev() {
            let w = self.weights[at];
            if w == [0.0; 3] {
                continue;
            }
            let words = &self.declaration.words[12 * at..];
            match u32::from(words[0]) {
                op::POSITION => {
                    let i = u32::from_le_bytes([words[4], words[5], words[6], words[7]]);
                    out[i as usize] += w[power];
                }
                op::DERIVATIVE => {
                    let x = &mut self.weights[self.operands[at][0]];
                    x[1] += w[0];
                    x[2] += 2.0 * w[1];
                }
                _ => {
                    for (slope, operand) in self.slopes[at].iter().zip(self.operands[at]) {
                        if operand == NOTHING {
                            continue;
                        }
                        let [a, b, c] = slope.0.map(&of);
                        let x = &mut self.weights[operand];
                        x[0] += w[0] * a + w[1] * b + w[2] * c;
                        x[1] += w[1] * a + w[2] * b;
                        x[2] += w[2] * a;
                    }
                }
            }
        }
    }
}
