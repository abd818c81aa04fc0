//! Taylor coefficients of a recorded tape.
//!
//! With x(τ) = Σ xₖ τᵏ, coefficient k of every operation is *linear* in the coefficients k of its operands, with factors
//! that are values at τ = 0, once the products of earlier coefficients are known:
//!
//! ```text
//! z = x y     zₖ = x₀ yₖ + xₖ y₀ + Aₖ               A = Σ xᵢ yⱼ,  i, j ≥ 1
//! z = x / y   zₖ = (xₖ − z₀ yₖ − Aₖ) / y₀           A = Σ yᵢ zⱼ
//! z = eˣ      zₖ = z₀ xₖ + Aₖ / k                   A = Σ i xᵢ zⱼ     (z′ = x′ z, and so for every such equation)
//! ```
//!
//! So a series takes two alternating passes. One runs the tape on numbers, like a value. The other adds, for each of the few
//! products, what the new coefficients contribute to all later sums A: long additions of a scaled row to a row, which
//! a processor does several at a time, and with no sum to wait for.
//!
//! References: Jorba & Zou 2005, A software package for the numerical integration of ODEs by means of high-order Taylor
//! methods, section 2; Griewank & Walther 2008, Evaluating Derivatives, chapter 13; the order of summation is that of relaxed
//! multiplication, van der Hoeven 2002, Relax, but don't be too lazy, section 3.

use super::instruction::{Instruction, Op};
use super::record::{Recorded, Recording, Slot};
use super::Scalar;

/// Coefficients of a row. Rows are added in fours, up to three elements past the last coefficient.
const STRIDE: usize = 32;

/// No row is kept.
const NO_ROW: u32 = u32::MAX;

/// Highest order of a series.
pub const MAX_ORDER: usize = 28;

/// Coefficients of one number.
type Row<T> = [T; STRIDE];

/// An operation whose Taylor series can fail to exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Operation {
    /// x / y at y = 0.
    Division,
    /// √x at x ≤ 0.
    SquareRoot,
    /// xᶜ at x ≤ 0.
    Power,
    /// ln x at x ≤ 0.
    Logarithm,
    /// asin or acos at |x| ≥ 1.
    InverseSine,
    /// Angle of the point (0, 0).
    Angle,
}

/// An instruction with the first of its sums.
#[derive(Clone, Copy, Debug)]
struct Step {
    instruction: Instruction,
    sum: u32,
}

/// A number whose coefficients are kept, or j times coefficient j of it.
#[derive(Clone, Copy, Debug)]
struct Kept {
    slot: u32,
    weighted: bool,
}

/// sum += factor Σ xᵢ yⱼ, rows x and y.
#[derive(Clone, Copy, Debug)]
struct Product<T> {
    sum: usize,
    x: usize,
    y: usize,
    factor: T,
}

/// The Taylor coefficients of a recorded tape, order by order.
#[derive(Clone, Debug, Default)]
pub struct Expansion<T> {
    parts: Vec<Vec<Step>>,
    /// Operations that need a series to exist: where their argument is.
    critical: Vec<(Operation, Slot, Slot)>,
    /// Rows kept of varying numbers, then of constant ones.
    kept: Vec<Kept>,
    varying: usize,
    /// By register: the row of its coefficients, and the row of the weighted ones.
    rows: Vec<[u32; 2]>,
    products: Vec<Product<T>>,
    history: Vec<Row<T>>,
    sums: Vec<Row<T>>,
    /// Coefficient k of the registers.
    now: Vec<T>,
    /// Coefficient k of the rows.
    current: Vec<T>,
}

impl<T: Scalar> Expansion<T> {
    /// Prepares the expansion of `recording`, as far as it is needed for `wanted`; of these the coefficients are kept.
    /// Sums 0…`own`−1 are the caller's: `products` lists what goes into them, sum += x y.
    pub fn set(
        &mut self,
        recording: &Recording<T>,
        parts: usize,
        wanted: &[Recorded],
        own: usize,
        products: &[(usize, Slot, Slot)],
    ) {
        self.critical.clear();
        self.kept.clear();
        self.rows.clear();
        self.rows.resize(recording.registers(), [NO_ROW; 2]);
        self.products.clear();
        let mut sums = own;
        for &(sum, x, y) in products {
            self.product(sum, T::one(), (x, false), (y, false));
        }
        let live = live(recording, wanted, products);
        self.parts.resize(parts, Vec::new());
        for index in 0..parts {
            let mut steps = core::mem::take(&mut self.parts[index]);
            steps.clear();
            let [fixed, varying] = recording.part(index);
            for instruction in &recording.fixed[fixed] {
                self.watch(instruction);
            }
            for &instruction in &recording.varying[varying] {
                let second = instruction.is_pair() && live[instruction.to.index() + 1];
                if !(live[instruction.to.index()] || second) {
                    continue;
                }
                self.watch(&instruction);
                steps.push(Step {
                    instruction,
                    sum: sums as u32,
                });
                sums += self.sums_of(&instruction, sums);
            }
            self.parts[index] = steps;
        }
        for recorded in wanted.iter().filter(|r| r.varies()) {
            self.row((recorded.slot, false));
        }
        self.varying = self.kept.len();
        self.row((Recorded::ZERO.slot, false));
        for recorded in wanted.iter().filter(|r| !r.varies()) {
            self.row((recorded.slot, false));
        }
        self.history.clear();
        self.history.resize(self.kept.len(), [T::zero(); STRIDE]);
        self.sums.resize(sums, [T::zero(); STRIDE]);
        self.now.clear();
        self.now.resize(recording.registers(), T::zero());
        self.current.clear();
        self.current.resize(self.varying, T::zero());
    }

    fn row(&mut self, (slot, weighted): (Slot, bool)) -> usize {
        let kept = Kept {
            slot: slot.0,
            weighted,
        };
        let row = &mut self.rows[slot.index()][usize::from(weighted)];
        if *row == NO_ROW {
            *row = self.kept.len() as u32;
            self.kept.push(kept);
        }
        *row as usize
    }

    fn product(&mut self, sum: usize, factor: T, x: (Slot, bool), y: (Slot, bool)) {
        let (x, y) = (self.row(x), self.row(y));
        self.products.push(Product { sum, x, y, factor });
    }

    /// The sums of an instruction, numbered from `sum` on; returns how many there are.
    fn sums_of(&mut self, i: &Instruction, sum: usize) -> usize {
        let one = T::one();
        let second = Slot(i.to.0 + 1);
        let (x, y, z, u) = (
            (i.x, false),
            (i.y, false),
            (i.to, false),
            (second, false),
        );
        let (wx, wy, wz) = ((i.x, true), (i.y, true), (i.to, true));
        match i.op {
            Op::Copy
            | Op::Add
            | Op::Sub
            | Op::Neg
            | Op::Offset
            | Op::Scale
            | Op::DivConstant
            | Op::Sum => return 0,
            Op::Mul => self.product(sum, one, x, y),
            Op::Square => self.product(sum, one, x, x),
            Op::Div | Op::Ratio => self.product(sum, one, y, z),
            Op::Sqrt => self.product(sum, one, z, z),
            Op::Powf => {
                // x z′ = c z x′; c is put in by the step.
                self.product(sum, one, wz, x);
                self.product(sum + 1, one, wx, z);
                return 2;
            }
            Op::Exp => self.product(sum, one, wx, z),
            Op::Ln => self.product(sum, one, wz, x),
            Op::SinCos | Op::SinhCosh => {
                self.product(sum, one, wx, u);
                self.product(sum + 1, one, wx, z);
                return 2;
            }
            Op::Tan | Op::Tanh => {
                self.product(sum, one, wx, u);
                self.product(sum + 1, one, z, z);
                return 2;
            }
            Op::Asin | Op::Acos => {
                self.product(sum, one, wz, u);
                self.product(sum + 1, one, u, u);
                self.product(sum + 1, one, x, x);
                return 2;
            }
            Op::Atan => {
                self.product(sum, one, wz, u);
                self.product(sum + 1, one, x, x);
                return 2;
            }
            Op::Atan2 => {
                self.product(sum, one, wz, u);
                self.product(sum, -one, wx, y);
                self.product(sum, one, wy, x);
                self.product(sum + 1, one, x, x);
                self.product(sum + 1, one, y, y);
                return 2;
            }
        }
        1
    }

    /// Notes an operation whose series can fail to exist.
    fn watch(&mut self, i: &Instruction) {
        let operation = match i.op {
            Op::Div | Op::DivConstant | Op::Ratio => {
                return self.critical.push((Operation::Division, i.y, i.y));
            }
            Op::Sqrt => Operation::SquareRoot,
            Op::Powf => Operation::Power,
            Op::Ln => Operation::Logarithm,
            Op::Asin | Op::Acos => Operation::InverseSine,
            Op::Atan2 => Operation::Angle,
            _ => return,
        };
        self.critical.push((operation, i.x, i.y));
    }

    /// The first operation that has no Taylor series where the registers hold the values `first`.
    pub fn singular(&self, first: &[T]) -> Option<Operation> {
        let at = |slot: Slot| first[slot.index()].value();
        let fails = |&&(operation, x, y): &&(Operation, Slot, Slot)| match operation {
            Operation::Division => at(x) == 0.0,
            Operation::InverseSine => !(at(x).abs() < 1.0),
            Operation::Angle => at(x) == 0.0 && at(y) == 0.0,
            _ => !(at(x) > 0.0),
        };
        self.critical.iter().find(fails).map(|&(operation, ..)| operation)
    }

    /// Takes coefficients 0 from the registers.
    pub fn begin(&mut self, first: &[T]) {
        self.history[..self.varying].fill([T::zero(); STRIDE]);
        self.sums.fill([T::zero(); STRIDE]);
        for (row, kept) in self.history.iter_mut().zip(&self.kept) {
            if !kept.weighted {
                row[0] = first[kept.slot as usize];
            }
        }
    }

    /// Coefficient k of the numbers of part `index`, from those of its operands.
    #[inline]
    pub fn advance(&mut self, recording: &Recording<T>, index: usize, k: usize, first: &[T]) {
        let order = T::from_f64(k as f64);
        let (now, sums) = (&mut self.now[..], &self.sums[..]);
        for &Step { instruction, sum } in &self.parts[index] {
            let Instruction { op, to, x, y } = instruction;
            let at = |slot: Slot| now[slot.index()];
            let start = |slot: Slot| first[slot.index()];
            let sum = |offset: usize| sums[sum as usize + offset][k];
            let value = match op {
                Op::Copy => at(x),
                Op::Add => at(x) + at(y),
                Op::Sub => at(x) - at(y),
                Op::Neg => -at(x),
                Op::Offset => at(y),
                Op::Scale => start(x) * at(y),
                Op::Mul => sum(0) + start(x) * at(y) + at(x) * start(y),
                Op::Square => {
                    let half = start(x) * at(x);
                    sum(0) + (half + half)
                }
                Op::Div => (at(x) - start(to) * at(y) - sum(0)) / start(y),
                Op::DivConstant => at(x) / start(y),
                Op::Ratio => -(start(to) * at(y) + sum(0)) / start(y),
                Op::Sqrt => (at(x) - sum(0)) / (start(to) + start(to)),
                Op::Powf => {
                    let earlier = start(y) * sum(1) - sum(0);
                    (start(y) * at(x) * start(to) + earlier / order) / start(x)
                }
                Op::Exp => start(to) * at(x) + sum(0) / order,
                Op::Ln => (at(x) - sum(0) / order) / start(x),
                Op::Sum => {
                    let terms = &recording.terms[x.index()..y.index()];
                    terms
                        .iter()
                        .fold(T::zero(), |sum, &(factor, x)| sum + factor * at(x))
                }
                _ => {
                    let second = Slot(to.0 + 1);
                    let values = [start(x), start(y), start(to), start(second)];
                    let sums = [sum(0), sum(1)];
                    let (z, u) = pair(op, [at(x), at(y)], values, sums, order);
                    now[second.index()] = u;
                    z
                }
            };
            now[to.index()] = value;
        }
    }

    /// Ends coefficient k, when all parts have it, of `order`.
    #[inline]
    pub fn keep(&mut self, k: usize, order: usize) {
        let weight = T::from_f64(k as f64);
        for (current, kept) in self.current.iter_mut().zip(&self.kept) {
            let c = self.now[kept.slot as usize];
            *current = if kept.weighted { weight * c } else { c };
        }
        // What coefficient k gives with coefficients 1…k−1 to the sums up to the order.
        let chunks = (k - 1).min(order.saturating_sub(k)).div_ceil(4);
        for product in &self.products {
            let (xk, yk) = (self.current[product.x], self.current[product.y]);
            let (xk, yk) = (product.factor * xk, product.factor * yk);
            let sum = &mut self.sums[product.sum];
            let (later, _) = sum[k + 1..].as_chunks_mut::<4>();
            let (xs, _) = self.history[product.x][1..].as_chunks::<4>();
            let (ys, _) = self.history[product.y][1..].as_chunks::<4>();
            if product.x == product.y {
                let twice = xk + xk;
                for (sum, x) in later[..chunks].iter_mut().zip(&xs[..chunks]) {
                    for (sum, &x) in sum.iter_mut().zip(x) {
                        *sum += twice * x;
                    }
                }
            } else {
                let both = xs[..chunks].iter().zip(&ys[..chunks]);
                for (sum, (x, y)) in later[..chunks].iter_mut().zip(both) {
                    for (sum, (&x, &y)) in sum.iter_mut().zip(x.iter().zip(y)) {
                        *sum += xk * y + yk * x;
                    }
                }
            }
            if 2 * k <= order {
                sum[2 * k] += xk * self.current[product.y];
            }
        }
        for (row, &current) in self.history.iter_mut().zip(&self.current) {
            row[k] = current;
        }
    }

    /// Coefficient k of a register, while it is computed.
    #[inline(always)]
    pub fn get(&self, slot: Slot) -> T {
        self.now[slot.index()]
    }

    /// Sets coefficient k of a register.
    #[inline(always)]
    pub fn put(&mut self, slot: Slot, value: T) {
        self.now[slot.index()] = value;
    }

    /// Sum number `index` of the caller's, for coefficient k.
    #[inline(always)]
    pub fn sum(&self, index: usize, k: usize) -> T {
        self.sums[index][k]
    }

    /// Coefficients 0…`order` of a number that was wanted; of any other number, zeros.
    #[inline]
    pub fn series(&self, number: Recorded, order: usize) -> &[T] {
        let row = self.rows.get(number.slot.index()).map_or(NO_ROW, |r| r[0]);
        let zero = self.rows.first().map_or(NO_ROW, |r| r[0]);
        let row = if row == NO_ROW { zero } else { row };
        self.history
            .get(row as usize)
            .map_or(&[], |row| &row[..=order.min(MAX_ORDER)])
    }
}

/// Which registers `wanted` and the products depend on.
fn live<T: Scalar>(
    recording: &Recording<T>,
    wanted: &[Recorded],
    products: &[(usize, Slot, Slot)],
) -> Vec<bool> {
    let mut live = vec![false; recording.registers()];
    for recorded in wanted {
        live[recorded.slot.index()] = true;
    }
    for &(_, x, y) in products {
        live[x.index()] = true;
        live[y.index()] = true;
    }
    for instruction in recording.varying.iter().rev() {
        let to = instruction.to.index();
        if live[to] || (instruction.is_pair() && live[to + 1]) {
            for operand in instruction.operands(&recording.terms) {
                live[operand.index()] = true;
            }
        }
    }
    live
}

/// Coefficient k of the operations with two results, from those of x and y, values of x, y, z, u, and the sums.
#[inline(always)]
fn pair<T: Scalar>(op: Op, [x, y]: [T; 2], start: [T; 4], sums: [T; 2], order: T) -> (T, T) {
    let [x0, y0, z0, u0] = start;
    let earlier = sums[0] / order;
    let twice = |c: T| c + c;
    match op {
        Op::SinCos => (u0 * x + earlier, -(z0 * x + sums[1] / order)),
        Op::SinhCosh => (u0 * x + earlier, z0 * x + sums[1] / order),
        Op::Tan => {
            let z = u0 * x + earlier;
            (z, twice(z0 * z) + sums[1])
        }
        Op::Tanh => {
            let z = u0 * x + earlier;
            (z, -(twice(z0 * z) + sums[1]))
        }
        Op::Asin => (
            (x - earlier) / u0,
            -(twice(x0 * x) + sums[1]) / twice(u0),
        ),
        Op::Acos => (
            (-x - earlier) / u0,
            -(twice(x0 * x) + sums[1]) / twice(u0),
        ),
        Op::Atan => ((x - earlier) / u0, twice(x0 * x) + sums[1]),
        // The angle of (y, x) is that of x above y.
        _ => (
            (x * y0 - y * x0 - earlier) / u0,
            twice(x0 * x + y0 * y) + sums[1],
        ),
    }
}
