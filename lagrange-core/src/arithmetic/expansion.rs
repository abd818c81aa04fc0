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

use super::Scalar;
use super::instruction::{Instruction, Op};
use super::program::{Program, room, with_registers};
use super::record::{Recorded, Slot};

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

/// An instruction with the place of the first of its sums.
#[derive(Clone, Copy, Debug)]
struct Step {
    instruction: Instruction,
    sum: u32,
}

/// sum += Σ xᵢ yⱼ, where the x may be weighted with i: registers and rows of x and y.
#[derive(Clone, Copy, Debug)]
struct Product {
    sum: u32,
    x: Slot,
    y: Slot,
    x_row: u32,
    y_row: u32,
}

/// The Taylor coefficients of a program, order by order.
#[derive(Clone, Debug, Default)]
pub struct Expansion<T> {
    parts: Vec<Vec<Step>>,
    /// Operations that need a series to exist: where their arguments are.
    critical: Vec<(Operation, Slot, Slot)>,
    products: Vec<Product>,
    weighted_products: Vec<Product>,
    /// The registers whose coefficients are kept: varying ones, then constant ones.
    kept: Vec<Slot>,
    varying: usize,
    /// Registers of which j times coefficient j is kept, in the rows after.
    weighted: Vec<Slot>,
    /// By register: its row among those kept, and its row among the weighted ones.
    rows: Vec<[u32; 2]>,
    history: Vec<Row<T>>,
    weighted_history: Vec<Row<T>>,
    sums: Vec<Row<T>>,
    /// Coefficient k of the registers.
    now: Vec<T>,
}

impl<T: Scalar> Expansion<T> {
    /// Prepares the expansion of `program` with so many `registers`; the coefficients of `wanted` are kept.
    /// Sums 0…`own`−1 are the caller's: `products` lists what goes into them, sum += x y.
    pub fn new(
        program: &Program,
        registers: usize,
        wanted: &[Recorded],
        own: usize,
        products: &[(usize, Slot, Slot)],
    ) -> Self {
        let mut expansion = Self {
            rows: vec![[NO_ROW; 2]; registers],
            now: vec![T::zero(); room(registers)],
            ..Self::default()
        };
        for &(sum, x, y) in products {
            expansion.product(sum, x, y);
        }
        let mut sums = own;
        for part in &program.parts {
            let mut steps = Vec::with_capacity(part.varying.len());
            part.fixed.iter().for_each(|i| expansion.watch(i));
            for &instruction in &part.varying {
                expansion.watch(&instruction);
                let sum = (sums * STRIDE) as u32;
                sums += expansion.sums_of(&instruction, sums);
                steps.push(Step { instruction, sum });
            }
            expansion.parts.push(steps);
        }
        for recorded in wanted.iter().filter(|r| r.varies()) {
            expansion.row(recorded.slot);
        }
        expansion.varying = expansion.kept.len();
        expansion.row(Recorded::ZERO.slot);
        for recorded in wanted.iter().filter(|r| !r.varies()) {
            expansion.row(recorded.slot);
        }
        let rows = |count: usize| vec![[T::zero(); STRIDE]; count];
        expansion.history = rows(expansion.kept.len());
        expansion.weighted_history = rows(expansion.weighted.len());
        expansion.sums = rows(sums);
        expansion
    }

    /// The row in which the coefficients of a register are kept.
    fn row(&mut self, slot: Slot) -> u32 {
        let row = &mut self.rows[slot.index()][0];
        if *row == NO_ROW {
            *row = self.kept.len() as u32;
            self.kept.push(slot);
        }
        *row
    }

    /// The same for j times coefficient j.
    fn weighted_row(&mut self, slot: Slot) -> u32 {
        let row = &mut self.rows[slot.index()][1];
        if *row == NO_ROW {
            *row = self.weighted.len() as u32;
            self.weighted.push(slot);
        }
        *row
    }

    /// sum += Σ xᵢ yⱼ
    fn product(&mut self, sum: usize, x: Slot, y: Slot) {
        let (x_row, y_row) = (self.row(x), self.row(y));
        let sum = sum as u32;
        self.products.push(Product {
            sum,
            x,
            y,
            x_row,
            y_row,
        });
    }

    /// sum += Σ i xᵢ yⱼ
    fn weighted_product(&mut self, sum: usize, x: Slot, y: Slot) {
        let (x_row, y_row) = (self.weighted_row(x), self.row(y));
        let sum = sum as u32;
        self.weighted_products.push(Product {
            sum,
            x,
            y,
            x_row,
            y_row,
        });
    }

    /// The sums of an instruction, numbered from `sum` on; returns how many there are.
    fn sums_of(&mut self, i: &Instruction, sum: usize) -> usize {
        let (x, y, z, u) = (i.x, i.y, i.to, Slot(i.to.0 + 1));
        match i.op {
            Op::Copy
            | Op::Add
            | Op::Sub
            | Op::Neg
            | Op::Offset
            | Op::Scale
            | Op::DivConstant
            | Op::Sum
            | Op::Sum2 => return 0,
            Op::Mul => self.product(sum, x, y),
            Op::Square => self.product(sum, x, x),
            Op::Div | Op::Ratio => self.product(sum, y, z),
            Op::Sqrt => self.product(sum, z, z),
            Op::Exp => self.weighted_product(sum, x, z),
            Op::Ln => self.weighted_product(sum, z, x),
            Op::Powf => {
                // x z′ = c z x′
                self.weighted_product(sum, z, x);
                self.weighted_product(sum + 1, x, z);
                return 2;
            }
            Op::SinCos | Op::SinhCosh => {
                self.weighted_product(sum, x, u);
                self.weighted_product(sum + 1, x, z);
                return 2;
            }
            Op::Tan | Op::Tanh => {
                self.weighted_product(sum, x, u);
                self.product(sum + 1, z, z);
                return 2;
            }
            Op::Asin | Op::Acos => {
                self.weighted_product(sum, z, u);
                self.product(sum + 1, u, u);
                self.product(sum + 1, x, x);
                return 2;
            }
            Op::Atan => {
                self.weighted_product(sum, z, u);
                self.product(sum + 1, x, x);
                return 2;
            }
            Op::Atan2 => {
                self.weighted_product(sum, z, u);
                self.product(sum + 1, x, x);
                self.product(sum + 1, y, y);
                self.weighted_product(sum + 2, x, y);
                self.weighted_product(sum + 3, y, x);
                return 4;
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
    #[inline]
    pub fn singular(&self, first: &[T]) -> Option<Operation> {
        let at = |slot: Slot| first[slot.index()].value();
        let fails = |&&(operation, x, y): &&(Operation, Slot, Slot)| match operation {
            Operation::Division => at(x) == 0.0,
            Operation::InverseSine => !(at(x).abs() < 1.0),
            Operation::Angle => at(x) == 0.0 && at(y) == 0.0,
            _ => !(at(x) > 0.0),
        };
        let found = self.critical.iter().find(fails);
        found.map(|&(operation, ..)| operation)
    }

    /// Takes coefficients 0 from the registers.
    pub fn begin(&mut self, first: &[T]) {
        let zero = [T::zero(); STRIDE];
        self.history[..self.varying].fill(zero);
        self.weighted_history.fill(zero);
        self.sums.fill(zero);
        for (row, slot) in self.history.iter_mut().zip(&self.kept) {
            row[0] = first[slot.index()];
        }
    }

    /// Coefficient k of the numbers of part `index`, from those of its operands. `first` holds the values.
    #[inline]
    pub fn advance(&mut self, program: &Program, index: usize, k: usize, first: &mut [T]) {
        let (steps, sums, now) = (&self.parts[index], self.sums.as_flattened(), &mut self.now);
        let now: &mut [T] = now;
        with_registers!(first, |first| {
            advance(steps, &program.terms, sums, k, first, now);
        });
    }

    /// Ends coefficient k, when all parts have it, of `order`: what it gives with coefficients 1…k−1 to later sums.
    #[inline]
    pub fn keep(&mut self, k: usize, order: usize) {
        // Additions go on in fours; the rows have room.
        match (k - 1).min(order.saturating_sub(k)).div_ceil(4) {
            0 => self.add_products::<0>(k, order),
            1 => self.add_products::<1>(k, order),
            2 => self.add_products::<2>(k, order),
            3 => self.add_products::<3>(k, order),
            _ => self.add_products::<4>(k, order),
        }
        let Some(k) = Some(k).filter(|k| *k < STRIDE) else {
            return;
        };
        let weight = T::from_f64(k as f64);
        let now = |slot: &Slot| self.now[slot.index()];
        for (row, slot) in self.history[..self.varying].iter_mut().zip(&self.kept) {
            row[k] = now(slot);
        }
        for (row, slot) in self.weighted_history.iter_mut().zip(&self.weighted) {
            row[k] = weight * now(slot);
        }
    }

    #[inline(always)]
    fn add_products<const FOURS: usize>(&mut self, k: usize, order: usize) {
        let twice_k = (2 * k <= order).then_some(2 * k);
        let weight = T::from_f64(k as f64);
        let (history, weighted, now) = (&self.history, &self.weighted_history, &self.now);
        let mut add = |product: &Product, xk: T, xs: &Row<T>| {
            let ys = &history[product.y_row as usize];
            let yk = now[product.y.index()];
            let sum = &mut self.sums[product.sum as usize];
            if let Some(later) = sum.get_mut(k + 1..).map(|s| s.as_chunks_mut::<4>().0)
                && let Some(later) = later.first_chunk_mut::<FOURS>()
            {
                let (xs, ys) = (fours::<T, FOURS>(xs), fours::<T, FOURS>(ys));
                for (sum, (xs, ys)) in later.iter_mut().zip(xs.iter().zip(ys)) {
                    for (sum, (&x, &y)) in sum.iter_mut().zip(xs.iter().zip(ys)) {
                        *sum = xk.mul_add(y, yk.mul_add(x, *sum));
                    }
                }
            }
            if let Some(sum) = twice_k.and_then(|k| sum.get_mut(k)) {
                *sum = xk.mul_add(yk, *sum);
            }
        };
        for product in &self.products {
            let xs = &history[product.x_row as usize];
            add(product, now[product.x.index()], xs);
        }
        for product in &self.weighted_products {
            let xs = &weighted[product.x_row as usize];
            add(product, weight * now[product.x.index()], xs);
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

/// Coefficients 1, 2, … of a row, in fours.
#[inline(always)]
fn fours<T, const FOURS: usize>(row: &Row<T>) -> &[[T; 4]; FOURS] {
    const { assert!(4 * FOURS < STRIDE) };
    match row[1..].as_chunks::<4>().0.first_chunk() {
        Some(fours) => fours,
        None => unreachable!("a row holds that many"),
    }
}

/// Coefficient k of a list of numbers.
#[inline(always)]
fn advance<T: Scalar, const N: usize>(
    steps: &[Step],
    terms: &[(Slot, Slot)],
    sums: &[T],
    k: usize,
    first: &[T; N],
    now: &mut [T],
) {
    let Some(now) = now.first_chunk_mut::<N>() else {
        return;
    };
    let order = T::from_f64(k as f64);
    for &Step { instruction, sum } in steps {
        let Instruction { op, to, x, y } = instruction;
        let at = |slot: Slot| now[slot.index() & (N - 1)];
        let start = |slot: Slot| first[slot.index() & (N - 1)];
        let sum = |number: usize| sums[sum as usize + number * STRIDE + k];
        let value = match op {
            Op::Copy => at(x),
            Op::Add => at(x) + at(y),
            Op::Sub => at(x) - at(y),
            Op::Neg => -at(x),
            Op::Offset => at(y),
            Op::Scale => start(x) * at(y),
            Op::Mul => start(x).mul_add(at(y), at(x).mul_add(start(y), sum(0))),
            Op::Square => {
                let half = start(x) * at(x);
                sum(0) + (half + half)
            }
            Op::Div => (at(x) - start(to).mul_add(at(y), sum(0))) / start(y),
            Op::DivConstant => at(x) / start(y),
            Op::Ratio => -start(to).mul_add(at(y), sum(0)) / start(y),
            Op::Sqrt => (at(x) - sum(0)) / (start(to) + start(to)),
            Op::Powf => {
                let earlier = start(y) * sum(1) - sum(0);
                (start(y) * at(x) * start(to) + earlier / order) / start(x)
            }
            Op::Exp => start(to) * at(x) + sum(0) / order,
            Op::Ln => (at(x) - sum(0) / order) / start(x),
            Op::Sum => {
                let terms = &terms[x.index()..y.index()];
                let add = |sum, &(factor, x): &(Slot, Slot)| start(factor).mul_add(at(x), sum);
                terms.iter().fold(T::zero(), add)
            }
            Op::Sum2 => {
                let [(f, x), (g, y)] = [terms[x.index()], terms[x.index() + 1]];
                start(f).mul_add(at(x), start(g) * at(y))
            }
            Op::Atan2 => {
                let earlier = (sum(0) - sum(2) + sum(3)) / order;
                let turn = at(x) * start(y) - at(y) * start(x);
                let half = start(x) * at(x) + start(y) * at(y);
                let second = Slot(to.0 + 1);
                now[second.index() & (N - 1)] = half + half + sum(1);
                (turn - earlier) / start(second)
            }
            _ => {
                let second = Slot(to.0 + 1);
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
fn pair<T: Scalar>(op: Op, x: T, [x0, z0, u0]: [T; 3], sums: [T; 2], order: T) -> (T, T) {
    let earlier = sums[0] / order;
    let twice = |c: T| c + c;
    match op {
        Op::SinCos => (
            u0.mul_add(x, earlier),
            -z0.mul_add(x, sums[1] / order),
        ),
        Op::SinhCosh => (
            u0.mul_add(x, earlier),
            z0.mul_add(x, sums[1] / order),
        ),
        Op::Tan => {
            let z = u0 * x + earlier;
            (z, twice(z0 * z) + sums[1])
        }
        Op::Tanh => {
            let z = u0 * x + earlier;
            (z, -(twice(z0 * z) + sums[1]))
        }
        Op::Asin => ((x - earlier) / u0, -(twice(x0 * x) + sums[1]) / twice(u0)),
        Op::Acos => ((-x - earlier) / u0, -(twice(x0 * x) + sums[1]) / twice(u0)),
        // Atan
        _ => ((x - earlier) / u0, twice(x0 * x) + sums[1]),
    }
}
