//! Values, rates and gradients of the declared quantities at a state.
//!
//! A motion q + vτ + ½aτ² goes through the operations as [`Series`]; where it is one of intervals, everything that it can be
//! within a time goes through them at once. Gradients come from one sweep backwards: a change δx(τ)
//! of an operand changes f(x) by f'(x)δx, so that the weights w̄ₖ of the coefficients of a value go back by convolution with
//! f'(x), and those of a derivative y = ẋ by x̄ₖ₊₁ += (k+1) ȳₖ (Griewank & Walther 2008, chapter 13).
//!
//! What balances is a functional derivative of ∫L dτ, which is a series itself. By parts it goes back through y = ẋ as
//!
//! ```text
//! δ/δx = −d/dτ δ/δy        so that        δ/δq = ∂L/∂q − d/dt ∂L/∂v
//! ```
//!
//! A force λ on a gap has the weight λ there, and one on a slip the weight −λτ, whose −d/dτ it is. The same sweep
//! takes ∂L/∂q and ∂L/∂v along.

use super::operations::{Operation, Operations};
use super::real::Real;
use super::series::{Series, function, power};
use super::{Declaration, op};
use core::cmp::Ordering;
use core::ops::AddAssign;

/// What a declaration is evaluated at.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a, N = f64> {
    /// t
    pub time: N,
    /// q
    pub q: &'a [N],
    /// v
    pub v: &'a [N],
    /// dv/dt
    pub acceleration: &'a [N],
    /// λ of every row.
    pub forces: &'a [N],
    /// Values of the applied forces.
    pub loads: &'a [N],
}

/// A value with the coefficients of its weight in what balances, and its weight in the gradient.
#[derive(Clone, Copy, Debug)]
pub struct Seed {
    /// The value.
    pub value: usize,
    /// Weights of τ⁰ and τ¹ in the functional derivative.
    pub variation: [f64; 2],
    /// Weight in the gradient.
    pub gradient: f64,
}

/// A sum, and the sum of the absolute values of its terms, which rounding errors and errors of the state are relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// Σ x
    pub sum: f64,
    /// Σ |x|
    pub size: f64,
}

impl Sum {
    #[inline]
    fn of(x: f64) -> Self {
        let size = x.abs();
        Self { sum: x, size }
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        Self {
            sum: self.sum * factor,
            size: self.size * factor.abs(),
        }
    }
}

impl AddAssign for Sum {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.sum += other.sum;
        self.size += other.size;
    }
}

/// What a sweep finds for a coordinate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gradient {
    /// ∂/∂q − d/dt ∂/∂v
    pub variation: Sum,
    /// ∂/∂q
    pub position: Sum,
    /// ∂/∂v
    pub velocity: Sum,
}

/// Weights of a value: τ⁰ and τ¹ of the functional derivative, the gradient, and that which has come through a derivative.
type Weights = [Sum; 4];

/// Evaluates a declaration; keeps the memory for it.
#[derive(Clone, Debug)]
pub struct Evaluator<N = f64> {
    declaration: &'static Declaration,
    /// What changes with the state, of what is wanted.
    operations: Vec<Operation>,
    /// What does not.
    still: Vec<Operation>,
    /// Per value: whether it changes with the state.
    moves: Vec<bool>,
    /// Per value: whether it reads forces, which do not follow from the state alone.
    of_forces: Vec<bool>,
    /// Per value: how choices take it to compare with zero, where not as it is.
    taken: Vec<Option<Ordering>>,
    values: Vec<Series<N>>,
    /// Derivative of each function by its operands.
    slopes: Vec<[Series<N>; 2]>,
    weights: Vec<Weights>,
    /// The same of one value's coefficients.
    sizes: Vec<[f64; 3]>,
}

impl<N: Real> Evaluator<N> {
    /// An evaluator of these values, with these parameters.
    pub fn new(
        declaration: &'static Declaration,
        parameters: &[f64],
        wanted: impl IntoIterator<Item = usize>,
    ) -> Self {
        let needed = Operations::of(declaration, wanted);
        let n = declaration.len();
        let mut evaluator = Self {
            declaration,
            operations: Vec::with_capacity(n),
            still: Vec::new(),
            moves: vec![false; n],
            of_forces: vec![false; n],
            taken: vec![None; n],
            values: vec![Series::default(); n],
            slopes: vec![[Series::default(); 2]; n],
            weights: Vec::new(),
            sizes: Vec::new(),
        };
        for operation in needed.iter() {
            let at = operation.value;
            evaluator.moves[at] = match operation.code {
                op::TIME | op::POSITION | op::FORCE | op::LOAD => true,
                _ => operation.operands().any(|x| evaluator.moves[x]),
            };
            evaluator.of_forces[at] = match operation.code {
                op::FORCE | op::LOAD => true,
                _ => operation.operands().any(|x| evaluator.of_forces[x]),
            };
            match evaluator.moves[at] {
                true => evaluator.operations.push(operation),
                false => evaluator.still.push(operation),
            }
        }
        evaluator.set_parameters(parameters);
        evaluator
    }

    /// Takes other parameters.
    pub fn set_parameters(&mut self, parameters: &[f64]) {
        let no_state = Inputs {
            time: N::default(),
            q: &[],
            v: &[],
            acceleration: &[],
            forces: &[],
            loads: &[],
        };
        for k in 0..self.still.len() {
            let operation = self.still[k];
            if operation.code == op::PARAMETER {
                let parameter = N::number(parameters[operation.x]);
                self.values[operation.value] = Series::constant(parameter);
            } else {
                self.apply(operation, no_state);
            }
        }
    }

    /// An evaluator of everything, pictures too.
    pub fn of_everything(declaration: &'static Declaration, parameters: &[f64]) -> Self {
        Self::new(declaration, parameters, 0..declaration.len())
    }

    /// Whether a value changes with the state, and follows from it alone.
    pub fn follows_state(&self, value: usize) -> bool {
        self.moves[value] && !self.of_forces[value]
    }

    /// Whether a value reads forces, which do not follow from the state alone.
    pub fn is_of_forces(&self, value: usize) -> bool {
        self.of_forces[value]
    }

    /// Whether any value reads velocities as such, so that its rate needs accelerations.
    pub fn needs_accelerations(&self) -> bool {
        let mut operations = self.operations.iter();
        operations.any(|operation| operation.code == op::DERIVATIVE)
    }

    /// What the choices depend on, as far as it changes with the state; some of it more than once.
    pub fn guards(&self) -> Vec<usize> {
        let choices = self.operations.iter().filter(|o| o.code == op::SELECT);
        let guards = choices.map(|operation| operation.guard);
        guards.filter(|&guard| self.moves[guard]).collect()
    }

    /// Says which values choices take for zero, or for less, from now on, whatever they are; and the others for what they are.
    pub fn take_for(&mut self, values: impl IntoIterator<Item = (usize, Ordering)>) {
        self.taken.fill(None);
        let values = values.into_iter();
        values.for_each(|(value, ordering)| self.taken[value] = Some(ordering));
    }

    /// Takes another state.
    pub fn evaluate(&mut self, x: Inputs<'_, N>) {
        for k in 0..self.operations.len() {
            self.apply(self.operations[k], x);
        }
    }

    #[inline]
    fn apply(&mut self, operation: Operation, x: Inputs<'_, N>) {
        let (at, i, j) = (operation.value, operation.x, operation.y);
        let n = |i: usize| self.values[i];
        self.values[at] = match operation.code {
            op::NUMBER => Series::constant(N::number(self.declaration.numbers[i])),
            op::FORCE => Series::constant(x.forces[i]),
            op::LOAD => Series::constant(x.loads[i]),
            op::TIME => Series([x.time, N::number(1.0), N::default()]),
            op::POSITION => Series([x.q[i], x.v[i], N::number(0.5) * x.acceleration[i]]),
            op::ADD => n(i) + n(j),
            op::MULTIPLY => n(i) * n(j),
            op::DERIVATIVE => n(i).derivative(),
            op::SELECT => Series(self.guard(operation).choose(n(i).0, n(j).0)),
            op::ATAN2 => {
                let (value, slopes) = n(i).atan2(n(j));
                self.slopes[at] = slopes;
                value
            }
            op::POWER => {
                let c = self.declaration.numbers[j];
                let (value, slope) = n(i).of(power(n(i).0[0], c));
                self.slopes[at][0] = slope;
                value
            }
            call => {
                let (value, slope) = n(i).of(function(call - op::FUNCTIONS, n(i).0[0]));
                self.slopes[at][0] = slope;
                value
            }
        };
    }

    /// What a choice compares with zero.
    #[inline]
    fn guard(&self, choice: Operation) -> N {
        match self.taken[choice.guard] {
            Some(ordering) => N::number(f64::from(ordering as i8)),
            None => self.value(choice.guard),
        }
    }

    /// A value at the state.
    pub fn value(&self, value: usize) -> N {
        self.values[value].0[0]
    }

    /// Coefficient of a value's series at the state.
    pub fn coefficient(&self, value: usize, power: usize) -> N {
        self.values[value].0[power]
    }

    /// d/dt of a value.
    pub fn rate(&self, value: usize) -> N {
        self.values[value].0[1]
    }
}

impl Evaluator {
    /// What makes a value no finite number at the state, in words: the first operation in it that has none for operands that have.
    pub(crate) fn why_not_finite(&self, value: usize) -> Option<String> {
        let operations = Operations::of(self.declaration, [value]);
        let is_finite = |x: usize| self.value(x).is_finite();
        let mut without = operations.iter().filter(|o| !is_finite(o.value));
        let first = without.find(|o| o.operands().all(is_finite))?;
        operations.no_value(&first, self.value(first.x))
    }

    /// Hands the derivatives of an operation over, with the operands that they are by.
    #[inline]
    fn pass(&self, operation: Operation, mut to: impl FnMut(usize, &Series)) {
        const ONE: Series = Series([1.0, 0.0, 0.0]);
        let (i, j) = (operation.x, operation.y);
        let mut by = |i: usize, slope: &Series| {
            if self.moves[i] {
                to(i, slope);
            }
        };
        match operation.code {
            op::ADD => {
                by(i, &ONE);
                by(j, &ONE);
            }
            op::MULTIPLY => {
                by(i, &self.values[j]);
                by(j, &self.values[i]);
            }
            op::SELECT => {
                let first = self.guard(operation) >= 0.0;
                by(if first { i } else { j }, &ONE);
            }
            op::TIME | op::FORCE | op::LOAD => {}
            op::ATAN2 => {
                let [along, across] = &self.slopes[operation.value];
                by(i, along);
                by(j, across);
            }
            _ => by(i, &self.slopes[operation.value][0]),
        }
    }

    /// Operations up to that which defines a value.
    fn up_to(&self, last: usize) -> usize {
        self.operations
            .partition_point(|operation| operation.value <= last)
    }

    /// Σ weight · δ/δq of all seeds for every coordinate, with their gradients.
    pub fn sweep(&mut self, seeds: &[Seed], out: &mut [Gradient]) {
        out.fill(Gradient::default());
        let Some(last) = seeds.iter().map(|seed| seed.value).max() else {
            return;
        };
        let mut weights = core::mem::take(&mut self.weights);
        weights.clear();
        weights.resize(last + 1, Weights::default());
        for seed in seeds {
            let [first, second] = seed.variation;
            let w = &mut weights[seed.value];
            for (w, x) in w.iter_mut().zip([first, second, seed.gradient]) {
                *w += Sum::of(x);
            }
        }
        for k in (0..self.up_to(last)).rev() {
            let operation = self.operations[k];
            let [e0, e1, g, p] = weights[operation.value];
            if e0.size + e1.size + g.size + p.size == 0.0 {
                continue;
            }
            match operation.code {
                op::POSITION => {
                    let out = &mut out[operation.x];
                    out.variation += e0;
                    out.position += g;
                    out.velocity += p;
                }
                op::DERIVATIVE => {
                    let x = &mut weights[operation.x];
                    x[0] += e1.times(-1.0);
                    x[3] += g;
                }
                _ => self.pass(operation, |i, Series([a, b, _])| {
                    let x = &mut weights[i];
                    x[0] += e0.times(*a);
                    x[1] += e1.times(*a);
                    x[1] += e0.times(*b);
                    x[2] += g.times(*a);
                    x[3] += p.times(*a);
                }),
            }
        }
        self.weights = weights;
    }

    /// Σ |∂c/∂qₖ| for every coordinate and k, c a coefficient of a value. Returned is the size of the terms that make the value: rounding of each
    /// operation changes it by this times 1e-16 at most.
    pub fn gradient_size(&mut self, value: usize, power: usize, out: &mut [[f64; 3]]) -> f64 {
        out.fill([0.0; 3]);
        let mut terms = 0.0;
        let mut sizes = core::mem::take(&mut self.sizes);
        sizes.clear();
        sizes.resize(value + 1, [0.0; 3]);
        sizes[value][power] = 1.0;
        for k in (0..self.up_to(value)).rev() {
            let operation = self.operations[k];
            let w = sizes[operation.value];
            if w == [0.0; 3] {
                continue;
            }
            terms += w[0] * self.values[operation.value].0[0].abs();
            match operation.code {
                op::POSITION => {
                    let out = &mut out[operation.x];
                    (0..3).for_each(|k| out[k] += w[k]);
                }
                op::DERIVATIVE => {
                    let x = &mut sizes[operation.x];
                    x[1] += w[0];
                    x[2] += 2.0 * w[1];
                }
                _ => self.pass(operation, |i, slope| {
                    let [a, b, c] = slope.0.map(f64::abs);
                    let x = &mut sizes[i];
                    x[0] += w[0] * a + w[1] * b + w[2] * c;
                    x[1] += w[1] * a + w[2] * b;
                    x[2] += w[2] * a;
                }),
            }
        }
        self.sizes = sizes;
        terms
    }
}
