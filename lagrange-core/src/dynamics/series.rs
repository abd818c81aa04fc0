//! Taylor coefficients of the motion, its forces and all outputs.
//!
//! With K x = b and x = (v̇, −λ),
//!
//! ```text
//! K₀ xₖ = bₖ − Σ_{j=1..k} Kⱼ xₖ₋ⱼ        vₖ₊₁ = v̇ₖ/(k+1)        qₖ₊₁ = vₖ/(k+1)
//! ```
//!
//! one factorization whatever the order; the sum runs over those matrix elements that change with the state.
//! Reference: Griewank & Walther 2008, Evaluating Derivatives, section 13.2 (implicit relations).

use super::tape::{REPORT, Shape, Tape};
use super::values::Extent;
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Expansion, MAX_ORDER, Pack, Scalar};
use crate::equations::Refused;
use crate::system::Place;
use std::sync::Arc;

impl<T: Scalar> Dynamics<T> {
    /// Taylor coefficients 0…`order` (at most 28) in the time τ since `t` of positions, velocities, accelerations, forces and all
    /// outputs that were asked for. The arrays that the `…_series` functions return have `order + 1` elements.
    ///
    /// # Errors
    /// Those of [`Self::value`], and [`EvaluationError::NoSeries`].
    pub fn series(&mut self, t: T, q: &[T], v: &[T], order: usize) -> Result<(), EvaluationError> {
        if self.begin_series(t, q, v, order)? {
            self.end_series(order);
        }
        Ok(())
    }

    /// The first half of [`Self::series`]: whether a second is needed.
    pub(crate) fn begin_series(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        order: usize,
    ) -> Result<bool, EvaluationError> {
        let order = order.min(MAX_ORDER);
        self.work.series += 1;
        self.work.coefficients += order + 1;
        if self.choose(q, v) {
            let expanded = self.modes[self.current].emitted_mut(&self.series_held);
            match expanded.map(|(emitted, held)| emitted.series(&held, order, (t, q, v))) {
                Some(Ok(())) => return Ok(false),
                // The interpreter says which operation has none, if any.
                Some(Err(Refused::NoSeries)) => self.by_functions = false,
                Some(Err(Refused::Pivot)) | None => self.leave_to_solver(),
            }
        }
        self.run(t, q, v, Extent::Everything, true)?;
        if self.compiled().plan.headings.is_empty() {
            self.start_series(order)?;
            Ok(true)
        } else {
            self.expand_from_rest(order)?;
            Ok(false)
        }
    }

    /// The second half of [`Self::series`].
    pub(crate) fn end_series(&mut self, order: usize) {
        self.expand(order.min(MAX_ORDER));
        self.take_headings_of_series();
    }

    /// What the tape does.
    pub(super) fn shape_mut(&mut self) -> &mut Arc<Shape> {
        let (_, _, tape) = self.modes[self.current].parts();
        &mut tape.shape
    }

    /// Solves the equations that the last value has left factored.
    pub(super) fn solve(&mut self, right: &mut [T]) {
        let (_, solver, _) = self.modes[self.current].parts();
        solver.solve(right);
    }

    /// The numbers that the tape works with.
    pub(super) fn registers(&self) -> &[T] {
        self.compiled().tape().map_or(&[], |tape| &tape.registers)
    }

    /// The second half of [`Self::series`], done for several motions at once.
    pub(super) fn take_series<const L: usize>(
        &mut self,
        pack: &Expansion<Pack<T, L>>,
        lane: usize,
        order: usize,
    ) {
        let (_, _, tape) = self.modes[self.current].parts();
        tape.expansion.take_lane(pack, lane, order);
        self.take_headings_of_series();
    }

    /// Coefficients 1…`order` of everything.
    pub(super) fn expand(&mut self, order: usize) {
        let Self {
            modes,
            current,
            right,
            headings,
            ..
        } = self;
        let (_, solver, tape) = modes[*current].parts();
        let Tape {
            shape,
            registers,
            expansion,
            headings: slots,
            ..
        } = tape;
        for &(friction, _, rates) in &*slots {
            for (rate, u) in rates.into_iter().zip(headings.coefficient(friction, 1)) {
                registers[rate.index()] = u;
            }
        }
        expansion.run(
            &shape.everything,
            registers,
            order,
            &shape.integrals,
            |k, now, first, earlier| {
                let Some(unsolved) = &shape.unsolved else {
                    return;
                };
                unsolved.right_hand_sides(now, first, earlier, right);
                solver.solve(right);
                for (slot, &x) in unsolved.unknowns.iter().zip(&*right) {
                    now[slot.index()] = x;
                }
                let next = T::from_f64((k + 1) as f64);
                for &(friction, _, rates) in &*slots {
                    let turn = headings.coefficient(friction, k + 1);
                    for (rate, u) in rates.into_iter().zip(turn) {
                        now[rate.index()] = next * u;
                    }
                }
            },
        );
    }

    /// Coefficients 0 of everything.
    pub(super) fn start_series(&mut self, order: usize) -> Result<(), EvaluationError> {
        let (_, _, tape) = self.modes[self.current].parts();
        tape.order = order;
        tape.shape.everything.evaluate(REPORT, &mut tape.registers);
        match tape.expansion.singular(&tape.registers) {
            Some(operation) => Err(EvaluationError::NoSeries { operation }),
            None => {
                tape.expansion.begin(&tape.registers);
                Ok(())
            }
        }
    }

    /// Position coefficients of coordinate `i`.
    pub fn position_series(&self, i: usize) -> &[T] {
        self.input_series(1 + i)
    }

    /// Velocity coefficients of coordinate `i`.
    pub fn velocity_series(&self, i: usize) -> &[T] {
        self.input_series(1 + self.description().coordinates.len() + i)
    }

    /// Acceleration coefficients of coordinate `i`: one fewer.
    pub fn acceleration_series(&self, i: usize) -> Vec<T> {
        let velocity = self.velocity_series(i).iter().enumerate().skip(1);
        velocity.map(|(k, &c)| T::from_f64(k as f64) * c).collect()
    }

    /// Force coefficients of a row; zeros where it does not act.
    pub fn force_series(&self, row: usize) -> &[T] {
        self.input_series(1 + 3 * self.description().coordinates.len() + row)
    }

    fn input_series(&self, index: usize) -> &[T] {
        if let Some(emitted) = self.in_use() {
            return emitted.input_series(self.description, index);
        }
        self.compiled()
            .tape()
            .map_or(&[], |t| t.input_series(index))
    }

    /// Coefficients of a number of the motion tape that depends on the state. Its need must have been asked for by
    /// [`Self::set_extra_needs`]; of other numbers, zeros.
    pub fn motion_series(&self, place: Place) -> &[T] {
        if let Some(emitted) = self.in_use() {
            return match place {
                Place::Node(node) => emitted.motion_series(self.description, node),
                Place::Zero | Place::Constant(_) => emitted.zero_series(self.description),
            };
        }
        let tape = self.compiled().tape();
        tape.map_or(&[], |tape| match place {
            Place::Node(node) => tape.node_series(node),
            Place::Zero | Place::Constant(_) => tape.zero_series(),
        })
    }

    /// Coefficients of a number of the report tape that depends on the state. Its need must have been asked for by
    /// [`Self::set_report_needs`]; of other numbers, zeros.
    pub fn report_series(&self, place: Place) -> &[T] {
        if let Some(emitted) = self.in_use() {
            return match place {
                Place::Node(node) => emitted.report_series(self.description, node),
                Place::Zero | Place::Constant(_) => emitted.zero_series(self.description),
            };
        }
        let tape = self.compiled().tape();
        tape.map_or(&[], |tape| match place {
            Place::Node(node) => tape.report_series(node),
            Place::Zero | Place::Constant(_) => tape.zero_series(),
        })
    }
}
