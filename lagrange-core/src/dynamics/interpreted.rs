//! The equations of a mode as data: what runs where none have been emitted for it.

use super::Operations;
use super::loading::{collect, shape};
use super::output_mask::OutputMask;
use super::shape::{Asked, Extent, FORCES, MOTION, Part, Planned, REPORT, SYSTEM, Shape};
use crate::arithmetic::products::Row;
use crate::arithmetic::{GOLDEN, Scalar, uneven};
use crate::program::{Register, Series};
use crate::system::ErasedSystem;
use std::sync::Arc;

/// How far from a state those beside it are, for tests of signs.
const BESIDE: f64 = 1e-3;

/// The interpreted equations of a mode, for what is asked.
#[derive(Clone, Debug)]
pub(super) struct Interpreted<T> {
    held: OutputMask,
    extra: OutputMask,
    report: Option<OutputMask>,
    part: Part,
    /// Shared with other motions that do the same with other numbers.
    pub shape: Arc<Shape>,
    pub registers: Vec<T>,
    /// Whether the parameters have changed since the numbers were taken.
    outdated: bool,
    /// Made when a series is first asked for.
    series: Option<Series<T>>,
    /// Order of the series held.
    order: usize,
}

impl<T: Scalar> Interpreted<T> {
    /// Whether it was made for this.
    pub(super) fn is_for(&self, asked: &Asked) -> bool {
        self.held == *asked.held
            && self.extra == *asked.extra
            && self.report.as_ref() == asked.report
            && self.part == asked.part
    }

    /// Whether any output of the motion program is held.
    #[inline]
    pub(super) fn has_motion(&self) -> bool {
        !self.shape.held_nodes.is_empty()
    }

    /// Arithmetic operations of one evaluation; those of the solver are counted as an elimination by pivots.
    pub(super) fn operations(&self) -> Operations {
        let size = self.shape.unknowns.len();
        let solver = (size * (size + 1) * (4 * size + 5) / 6).saturating_sub(2 * size);
        Operations {
            accelerations: self.shape.accelerations.operations() + solver,
            everything: self.shape.everything.operations() + solver,
        }
    }

    /// Writes a state into the registers, with no acceleration and no force.
    #[inline]
    pub(super) fn place(&mut self, t: T, q: &[T], v: &[T]) {
        let n = q.len();
        let inputs = &mut self.registers[1..self.shape.numbers.start];
        inputs[0] = t;
        inputs[1..1 + n].copy_from_slice(q);
        inputs[1 + n..1 + 2 * n].copy_from_slice(v);
        inputs[1 + 2 * n..].fill(T::default());
    }

    /// Takes those outputs of the motion program that are held.
    #[inline]
    pub(super) fn take_nodes(&self, nodes: &mut [T]) {
        for &(node, register) in &self.shape.held_nodes {
            nodes[node] = self.registers[register.index()];
        }
    }

    /// Sizes of the right-hand sides of the equations at the time and the positions in the registers and at these velocities.
    pub(super) fn right_sides_at(&self, velocities: &[f64]) -> Vec<f64> {
        let mut registers = self.registers.clone();
        let places = registers[2 + velocities.len()..].iter_mut();
        for (place, &v) in places.zip(velocities) {
            *place = T::from_f64(v);
        }
        let program = self.shape.program(Extent::Accelerations);
        for part in [MOTION, SYSTEM] {
            program.evaluate(part, &mut registers);
        }
        let right = self.shape.right.iter();
        right
            .map(|register| registers[register.index()].value().abs())
            .collect()
    }

    /// The registers at states on two sides of that of `n` coordinates in them, with its accelerations and forces.
    pub(super) fn beside(&self, n: usize) -> [Vec<T>; 2] {
        [-BESIDE, BESIDE].map(|step| {
            let mut registers = self.registers.clone();
            for (i, x) in registers[2..2 + 2 * n].iter_mut().enumerate() {
                *x += T::from_f64(step * uneven(i, GOLDEN));
            }
            let program = self.shape.program(Extent::Series);
            for part in [MOTION, SYSTEM, FORCES, REPORT] {
                program.evaluate(part, &mut registers);
            }
            registers
        })
    }

    /// Runs a part for values.
    #[inline]
    pub(super) fn evaluate(&mut self, extent: Extent, part: usize) {
        let program = self.shape.program(extent);
        program.evaluate(part, &mut self.registers);
    }

    /// Memory of a series of this order, and the values in the registers, which it begins with.
    pub(super) fn series_memory(&mut self, order: usize) -> (&mut Series<T>, &[T]) {
        self.order = order;
        let series = self.series.get_or_insert_with(|| self.shape.series());
        (series, &self.registers)
    }

    /// What an expansion works with.
    pub(super) fn parts(&mut self) -> (&Shape, &mut [T], Option<&mut Series<T>>) {
        (&self.shape, &mut self.registers, self.series.as_mut())
    }

    /// Whether the numbers belong to the present parameters.
    pub(super) fn is_current(&self) -> bool {
        !self.outdated
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.outdated = true;
    }

    /// Takes the numbers of the present parameters, if they have changed; `numbers` is memory. False if others of them are zero
    /// now: then it is the program of other parameters.
    pub(super) fn renew(
        &mut self,
        system: &dyn ErasedSystem<T>,
        planned: Planned<'_, T>,
        numbers: &mut Vec<T>,
    ) -> bool {
        if self.outdated {
            collect(system, planned, self.part, numbers);
            let registers = &mut self.registers[self.shape.numbers.clone()];
            let mut pairs = registers.iter().zip(&*numbers);
            if registers.len() != numbers.len() || pairs.any(|(x, y)| x.is_zero() != y.is_zero()) {
                return false;
            }
            registers.copy_from_slice(numbers);
            self.outdated = false;
        }
        true
    }

    /// Loads the equations of a mode; `numbers` is memory.
    pub(super) fn load(
        system: &dyn ErasedSystem<T>,
        planned: Planned<'_, T>,
        asked: &Asked,
        numbers: &mut Vec<T>,
    ) -> Self {
        collect(system, planned, asked.part, numbers);
        let shape = shape(system.description(), planned, asked, numbers);
        let mut registers = vec![T::zero(); shape.registers];
        registers[shape.numbers.clone()].copy_from_slice(numbers);
        Self {
            held: asked.held.clone(),
            extra: asked.extra.clone(),
            report: asked.report.cloned(),
            part: asked.part,
            shape: Arc::new(shape),
            registers,
            outdated: false,
            series: None,
            order: 0,
        }
    }

    /// Coefficients of the positions and velocities of `n` coordinates.
    pub(super) fn state_series(&self, n: usize) -> &[Row<T>] {
        let first = Register::new(2);
        let series = self.series.as_ref();
        series.map_or(&[], |series| series.rows_from(first, 2 * n))
    }

    /// Coefficients of t, q, v or λ, by their index in the inputs of the report.
    #[inline]
    pub(super) fn input_series(&self, index: usize) -> &[T] {
        self.series_of(Register::new(1 + index))
    }

    /// Coefficients of an output of the motion program.
    #[inline]
    pub(super) fn node_series(&self, node: usize) -> &[T] {
        self.series_of(self.shape.nodes[node])
    }

    /// Coefficients of an output of the report.
    #[inline]
    pub(super) fn report_series(&self, node: usize) -> &[T] {
        self.series_of(self.shape.report_nodes[node])
    }

    /// Coefficients of zero.
    pub(super) fn zero_series(&self) -> &[T] {
        self.series_of(Register::ZERO)
    }

    #[inline]
    fn series_of(&self, register: Register) -> &[T] {
        let series = self.series.as_ref();
        series.map_or(&[], |series| series.series(register, self.order))
    }
}
