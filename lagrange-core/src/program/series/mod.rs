//! Taylor coefficients of a program.
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
//! So a series takes two alternating passes. One forms the sums A of all products, four of them at a time: they lie side by
//! side, so that a processor adds four terms at once, and in each only as many terms as the order. The other runs the program
//! on numbers, like a value.
//!
//! References: Jorba & Zou 2005, A software package for the numerical integration of ODEs by means of high-order Taylor
//! methods, section 2; Griewank & Walther 2008, Evaluating Derivatives, chapter 13.

mod rules;

use super::instruction::{Instruction, Op, Program, Register, with_registers};
use super::roots::Root;
use crate::arithmetic::products::{ROW, Row, STRIDE};
use crate::arithmetic::{Number, Pack, Scalar};
use rules::advance;

/// No row is kept.
const NO_ROW: u32 = u32::MAX;

/// Highest order of a series.
pub const MAX_ORDER: usize = 28;

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

/// An instruction with the number of the first of its products.
#[derive(Clone, Copy, Debug)]
struct Step {
    instruction: Instruction,
    product: u32,
}

/// Products that are summed together.
const LANES: usize = 4;

/// Σ xᵢ yⱼ over i, j ≥ 1 for four products, side by side.
#[derive(Clone, Debug)]
struct Products<T> {
    /// Which numbers they multiply.
    x_registers: [Register; LANES],
    y_registers: [Register; LANES],
    /// One where xᵢ counts i times, else zero.
    weighted: [T; LANES],
    /// Coefficients 1, 2, ….
    x: [[T; LANES]; STRIDE],
    y: [[T; LANES]; STRIDE],
}

impl<T: Number> Products<T> {
    /// Products of zeros.
    fn new() -> Self {
        Self {
            x_registers: [Register::ZERO; LANES],
            y_registers: [Register::ZERO; LANES],
            weighted: [T::of(0.0); LANES],
            x: [[T::of(0.0); LANES]; STRIDE],
            y: [[T::of(0.0); LANES]; STRIDE],
        }
    }

    /// What coefficients 1…k−1 give to coefficient k.
    #[inline(always)]
    fn earlier(&self, k: usize) -> [T; LANES] {
        let mut sum = [T::of(0.0); LANES];
        let known = (k - 1) % STRIDE;
        for (x, y) in self.x[..known].iter().zip(self.y[..known].iter().rev()) {
            for lane in 0..LANES {
                sum[lane] = x[lane].mul_add(y[lane], sum[lane]);
            }
        }
        sum
    }

    /// Takes coefficient k of the numbers.
    #[inline(always)]
    fn take<const N: usize>(&mut self, k: usize, now: &[T; N]) {
        let extra = T::of((k - 1) as f64);
        let (x, y) = (&mut self.x[(k - 1) % STRIDE], &mut self.y[(k - 1) % STRIDE]);
        for lane in 0..LANES {
            let weight = T::of(1.0) + self.weighted[lane] * extra;
            x[lane] = weight * now[self.x_registers[lane].index() & (N - 1)];
            y[lane] = now[self.y_registers[lane].index() & (N - 1)];
        }
    }
}

/// The Taylor coefficients of a program, order by order.
#[derive(Clone, Debug)]
pub(crate) struct Series<T> {
    /// What runs before the caller's own equations are solved, and after that.
    before: Vec<Step>,
    after: Vec<Step>,
    /// Operations that need a series to exist: where their arguments are.
    critical: Vec<(Operation, Instruction)>,
    /// Roots that are given: they begin at zero.
    roots: Vec<(Operation, Root<T>)>,
    /// Number of products.
    count: usize,
    products: Vec<Products<T>>,
    /// Parts of coefficient k that earlier coefficients give, product by product.
    sums: Vec<T>,
    /// The registers whose coefficients are kept.
    kept: Vec<Register>,
    /// By register: its row among those kept.
    rows: Vec<u32>,
    history: Vec<Row<T>>,
    /// Coefficient k of the registers.
    now: Vec<T>,
}

impl<T: Number> Series<T> {
    /// Prepares the series of `program` with so many `registers`; the coefficients of `wanted` are kept. The caller solves
    /// equations after the first `before` parts; their `elements` (matrix element and unknown) are products 0, 1, ….
    pub(crate) fn new(
        program: &Program,
        registers: usize,
        wanted: &[Register],
        elements: impl Iterator<Item = (Register, Register)>,
        before: usize,
    ) -> Self {
        let mut series = Self {
            before: Vec::new(),
            after: Vec::new(),
            critical: Vec::new(),
            roots: Vec::new(),
            count: 0,
            products: Vec::new(),
            sums: Vec::new(),
            kept: Vec::new(),
            rows: vec![NO_ROW; registers],
            history: Vec::new(),
            now: vec![T::of(0.0); registers],
        };
        elements.for_each(|(x, y)| series.product(x, y));
        for (index, part) in program.parts.iter().enumerate() {
            for &instruction in part {
                series.watch(&instruction);
                let product = series.count as u32;
                series.products_of(&instruction);
                let step = Step {
                    instruction,
                    product,
                };
                if index < before {
                    series.before.push(step);
                } else {
                    series.after.push(step);
                }
            }
        }
        series.keep(Register::ZERO);
        wanted.iter().for_each(|&register| series.keep(register));
        for at in 0..series.critical.len() {
            if let (Operation::SquareRoot | Operation::Power, root) = series.critical[at] {
                series.keep(root.x);
            }
        }
        series.history = vec![[T::of(0.0); ROW]; series.kept.len()];
        series.sums = vec![T::of(0.0); series.products.len() * LANES];
        series
    }

    /// Keeps the coefficients of a register.
    fn keep(&mut self, register: Register) {
        let row = &mut self.rows[register.index()];
        if *row == NO_ROW {
            *row = self.kept.len() as u32;
            self.kept.push(register);
        }
    }

    /// Σ xᵢ yⱼ
    fn product(&mut self, x: Register, y: Register) {
        self.push_product(x, y, T::of(0.0));
    }

    /// Σ i xᵢ yⱼ
    fn weighted(&mut self, x: Register, y: Register) {
        self.push_product(x, y, T::of(1.0));
    }

    fn push_product(&mut self, x: Register, y: Register, weighted: T) {
        let lane = self.count % LANES;
        if lane == 0 {
            self.products.push(Products::new());
        }
        self.count += 1;
        if let Some(last) = self.products.last_mut() {
            (last.x_registers[lane], last.y_registers[lane]) = (x, y);
            last.weighted[lane] = weighted;
        }
    }

    /// The products of an instruction.
    fn products_of(&mut self, i: &Instruction) {
        let (x, y, z, u) = (i.x, i.y, i.to, i.to.next());
        match i.op {
            Op::Copy | Op::Add | Op::Sub | Op::Neg | Op::Scale | Op::Sum => {}
            Op::Mul => self.product(x, y),
            Op::Square => self.product(x, x),
            Op::Div => self.product(y, z),
            Op::Sqrt => self.product(z, z),
            Op::Exp => self.weighted(x, z),
            Op::Ln => self.weighted(z, x),
            Op::Powf => {
                // x z′ = c z x′
                self.weighted(z, x);
                self.weighted(x, z);
            }
            Op::SinCos | Op::SinhCosh => {
                self.weighted(x, u);
                self.weighted(x, z);
            }
            Op::Tan | Op::Tanh => {
                self.weighted(x, u);
                self.product(z, z);
            }
            Op::Asin | Op::Acos => {
                self.weighted(z, u);
                self.product(x, x);
                self.product(u, u);
            }
            Op::Atan => {
                self.weighted(z, u);
                self.product(x, x);
            }
            Op::Atan2 => {
                self.weighted(z, u);
                self.product(x, x);
                self.product(y, y);
                self.weighted(x, y);
                self.weighted(y, x);
            }
        }
    }

    /// Notes an operation whose series can fail to exist.
    fn watch(&mut self, i: &Instruction) {
        let operation = match i.op {
            Op::Div => Operation::Division,
            Op::Sqrt => Operation::SquareRoot,
            Op::Powf => Operation::Power,
            Op::Ln => Operation::Logarithm,
            Op::Asin | Op::Acos => Operation::InverseSine,
            Op::Atan2 => Operation::Angle,
            _ => return,
        };
        self.critical.push((operation, *i));
    }

    /// Coefficients 0, from values in the registers `first`.
    #[inline(always)]
    pub(crate) fn begin(&mut self, first: &[T]) {
        for (row, register) in self.history.iter_mut().zip(&self.kept) {
            row[0] = first[register.index()];
        }
    }

    /// Coefficients 1…`order` of everything after [`Self::begin`], from values in the registers `first`. `integrals` are numbers with
    /// their rates; register 1 is time. `solve` puts coefficient k of the caller's unknowns into the registers that it is given; it gets
    /// the values of all registers, and of each product what earlier coefficients give to coefficient k.
    #[inline(always)]
    pub(crate) fn run(
        &mut self,
        program: &Program,
        first: &mut [T],
        order: usize,
        integrals: &[(Register, Register)],
        mut solve: impl FnMut(usize, &mut [T], &[T], &[T]),
    ) {
        let order = order.min(MAX_ORDER);
        with_registers!(first, |first| self
            .coefficients(program, first, order, integrals, &mut solve));
    }

    #[inline(always)]
    fn coefficients<const N: usize>(
        &mut self,
        program: &Program,
        first: &[T; N],
        order: usize,
        integrals: &[(Register, Register)],
        solve: &mut impl FnMut(usize, &mut [T], &[T], &[T]),
    ) {
        let mut now = core::mem::take(&mut self.now);
        let Some(registers) = now.first_chunk_mut::<N>() else {
            return;
        };
        for k in 1..=order {
            let weight = T::of(k as f64);
            // dt/dτ = 1
            registers[1] = if k == 1 { T::of(1.0) } else { T::of(0.0) };
            for &(register, rate) in integrals {
                let rate = rate.index() & (N - 1);
                let rate = if k == 1 { first[rate] } else { registers[rate] };
                registers[register.index() & (N - 1)] = rate / weight;
            }
            for (_, root) in &self.roots {
                registers[root.own().to.index() & (N - 1)] = root.coefficient(k);
            }
            let (sums, _) = self.sums.as_chunks_mut::<LANES>();
            for (sums, products) in sums.iter_mut().zip(&self.products) {
                *sums = products.earlier(k);
            }
            advance(&self.before, program, &self.sums, k, first, registers);
            solve(k, registers, first, &self.sums);
            advance(&self.after, program, &self.sums, k, first, registers);
            for products in &mut self.products {
                products.take(k, registers);
            }
            for (row, register) in self.history.iter_mut().zip(&self.kept) {
                row[k % STRIDE] = registers[register.index() & (N - 1)];
            }
        }
        self.now = now;
    }

    /// Coefficients of so many numbers that were wanted one after the other.
    pub(crate) fn rows_from(&self, first: Register, count: usize) -> &[Row<T>] {
        let first = self.rows.get(first.index()).map_or(0, |&row| row as usize);
        self.history.get(first..first + count).unwrap_or_default()
    }

    /// Coefficients 0…`order` of a number that was wanted; of any other number, zeros.
    #[inline]
    pub(crate) fn series(&self, number: Register, order: usize) -> &[T] {
        let row = |register: Register| self.rows.get(register.index()).copied();
        let row = |register: Register| row(register).unwrap_or(NO_ROW);
        let found = match row(number) {
            NO_ROW => row(Register::ZERO),
            found => found,
        };
        let row = self.history.get(found as usize);
        row.map_or(&[], |row| &row[..=order.min(MAX_ORDER)])
    }
}

impl<T: Scalar> Series<T> {
    /// Takes coefficients 1…`order` that one motion of a pack has. Both expansions must have been made for the same program and the
    /// same numbers.
    pub(crate) fn take_lane<const L: usize>(
        &mut self,
        pack: &Series<Pack<T, L>>,
        lane: usize,
        order: usize,
    ) {
        let order = order.min(MAX_ORDER);
        let rows = self.history.iter_mut().zip(&pack.history);
        for (row, packed) in rows {
            for (c, packed) in row[1..=order].iter_mut().zip(&packed[1..=order]) {
                *c = packed.0[lane];
            }
        }
    }

    /// The operations that have no Taylor series where the registers hold the values `first`, and where their results go.
    #[inline]
    pub(crate) fn singular(&self, first: &[T]) -> impl Iterator<Item = (Operation, Register)> {
        let at = |register: Register| first[register.index()].value();
        let fails = move |&&(operation, i): &&(Operation, Instruction)| match operation {
            _ if self.roots.iter().any(|(_, root)| root.own().to == i.to) => false,
            Operation::Division => at(i.y) == 0.0,
            Operation::InverseSine => !(at(i.x).abs() < 1.0),
            Operation::Angle => at(i.x) == 0.0 && at(i.y) == 0.0,
            _ => !(at(i.x) > 0.0),
        };
        let found = self.critical.iter().filter(fails);
        found.map(|&(operation, i)| (operation, i.to))
    }

    /// Takes the roots that begin at zero in the registers `first` out of the program, to be given instead, first as zero; whether there are
    /// any. `beside`: the registers at states on two sides.
    pub(crate) fn hold_roots(&mut self, first: &[T], beside: &[Vec<T>; 2]) -> bool {
        for &(operation, instruction) in &self.critical {
            if let Operation::SquareRoot | Operation::Power = operation {
                let root = Root::of(instruction, first, beside);
                self.roots.extend(root.map(|root| (operation, root)));
            }
        }
        for (_, root) in &self.roots {
            place(&mut self.before, &mut self.after, root.given());
        }
        !self.roots.is_empty()
    }

    /// Puts the roots back into the program.
    pub(crate) fn release_roots(&mut self) {
        for (_, root) in self.roots.drain(..) {
            place(&mut self.before, &mut self.after, root.own());
        }
    }

    /// Gives the roots the coefficients that follow from those, up to `order`, of their arguments in the last expansion; whether any has changed.
    ///
    /// # Errors
    /// The first that has no series.
    pub(crate) fn follow_roots(&mut self, order: usize) -> Result<bool, (Operation, Register)> {
        let mut roots = core::mem::take(&mut self.roots);
        let follow = |(operation, root): &mut (Operation, Root<T>)| {
            let Instruction { to, x, .. } = root.own();
            root.follow(self.series(x, order)).ok_or((*operation, to))
        };
        let followed: Result<Vec<bool>, _> = roots.iter_mut().map(follow).collect();
        self.roots = roots;
        Ok(followed?.contains(&true))
    }
}

/// Puts an instruction in the place of that whose result goes to the same register.
fn place(before: &mut [Step], after: &mut [Step], instruction: Instruction) {
    for step in before.iter_mut().chain(after) {
        if step.instruction.to == instruction.to {
            step.instruction = instruction;
        }
    }
}
