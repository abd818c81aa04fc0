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

use super::shape::{Extent, REPORT, Shape};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::products::Row;
use crate::arithmetic::{Pack, Scalar};
use crate::equations::Refused;
use crate::program::{MAX_ORDER, Operation, Register, Series};
use crate::system::ValueRef;
use std::sync::Arc;

impl<T: Scalar> Dynamics<T> {
    /// Taylor coefficients 0…`order` (at most 28) in the time τ since `t` of positions, velocities, accelerations, forces and all
    /// outputs that were asked for. The arrays that the `…_series` functions return have `order + 1` elements.
    ///
    /// # Errors
    /// The same as [`Self::value`], and [`EvaluationError::NoSeries`].
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
        (self.series_by_functions, self.without_watches) = (false, false);
        self.hold();
        if self.choose(q, v) {
            let expanded = self.modes[self.current].emitted_mut();
            let turns = &mut self.turns;
            match expanded.map(|(emitted, held)| emitted.series(&held, order, (t, q, v), turns)) {
                Some(Ok(())) => {
                    self.series_by_functions = true;
                    return Ok(false);
                }
                // The interpreter says which operation has none, if any.
                Some(Err(Refused::NoSeries)) => self.by_functions = false,
                Some(Err(Refused::Pivot | Refused::NoRegisters)) | None => self.refuse_functions(),
            }
        }
        self.run(t, q, v, Extent::Series, true)?;
        if self.presses_by_resultants() {
            self.expand_pressed(order)?;
            self.take_directions_of_series();
            return Ok(false);
        }
        if self.compiled().pattern.sliding.slip_directions.is_empty() {
            match self.start_series(order) {
                Err(EvaluationError::NoSeries { .. }) => {
                    match self.with_roots(order, Self::expand_anew) {
                        Err(EvaluationError::NoSeries { .. }) => self.expand_past_watches(order),
                        expanded => expanded,
                    }?;
                    self.take_directions_of_series();
                    Ok(false)
                }
                started => started.map(|()| true),
            }
        } else {
            self.with_roots(order, Self::expand_from_rest)?;
            // Beside slips that begin others go on, and turn.
            self.take_directions_of_series();
            Ok(false)
        }
    }

    /// The second half of [`Self::series`].
    pub(crate) fn end_series(&mut self, order: usize) {
        self.expand(order.min(MAX_ORDER));
        self.take_directions_of_series();
    }

    /// What the interpreter does.
    pub(super) fn shape_mut(&mut self) -> &mut Arc<Shape> {
        let (_, _, interpreted) = self.modes[self.current].parts();
        &mut interpreted.shape
    }

    /// Solves the equations that the last value has left factored.
    pub(super) fn solve(&mut self, right: &mut [T]) {
        let (_, solver, _) = self.modes[self.current].parts();
        solver.solve(right);
    }

    /// The numbers that the interpreter works with.
    pub(super) fn registers(&self) -> &[T] {
        let interpreted = self.compiled().interpreted();
        interpreted.map_or(&[], |interpreted| &interpreted.registers)
    }

    /// Expands to `order`, from values in the registers. Roots that begin at zero are held if there would be no series else.
    pub(super) fn with_roots(
        &mut self,
        order: usize,
        expand: fn(&mut Self, usize) -> Result<(), EvaluationError>,
    ) -> Result<(), EvaluationError> {
        match expand(self, order) {
            Err(EvaluationError::NoSeries { .. }) if self.hold_roots(order) => {
                let settled = self.settle_roots(order, expand);
                let (_, _, interpreted) = self.modes[self.current].parts();
                let (series, _) = interpreted.series_memory(order);
                series.release_roots();
                match settled? {
                    true => Ok(()),
                    // What depends on its own root to the same order is never right.
                    false => expand(self, order),
                }
            }
            outcome => outcome,
        }
    }

    /// Whether roots begin at zero where the registers are; they are held then.
    fn hold_roots(&mut self, order: usize) -> bool {
        let n = self.description.coordinates.len();
        let (_, _, interpreted) = self.modes[self.current].parts();
        let beside = interpreted.beside(n);
        let (series, registers) = interpreted.series_memory(order);
        series.hold_roots(registers, &beside)
    }

    /// Repeats an expansion until roots that are held follow from what they are made of; whether they do at last.
    fn settle_roots(
        &mut self,
        order: usize,
        expand: fn(&mut Self, usize) -> Result<(), EvaluationError>,
    ) -> Result<bool, EvaluationError> {
        // The last coefficients of a root need later ones of its argument.
        let further = (order + 2).min(MAX_ORDER);
        let mut changes = true;
        for _ in 0..=MAX_ORDER {
            if !changes {
                break;
            }
            expand(self, further)?;
            let (_, _, interpreted) = self.modes[self.current].parts();
            let (series, _) = interpreted.series_memory(order);
            changes = match series.follow_roots(further) {
                Ok(changes) => changes,
                Err((operation, result)) => return Err(self.no_series(operation, result)),
            };
        }
        Ok(!changes && self.begins_clearly())
    }

    /// The second half of [`Self::series`], done for several motions at once.
    pub(super) fn take_series<const L: usize>(
        &mut self,
        pack: &Series<Pack<T, L>>,
        lane: usize,
        order: usize,
    ) {
        let (_, _, interpreted) = self.modes[self.current].parts();
        if let (_, _, Some(series)) = interpreted.parts() {
            series.take_lane(pack, lane, order);
        }
        self.take_directions_of_series();
    }

    /// Coefficients 1…`order` of everything.
    pub(super) fn expand(&mut self, order: usize) {
        let Self {
            modes,
            current,
            right,
            slip_directions,
            resultants,
            ..
        } = self;
        let (_, solver, interpreted) = modes[*current].parts();
        let (shape, registers, Some(series)) = interpreted.parts() else {
            return;
        };
        for given in &shape.resultants {
            resultants.begin(given, &shape.unknowns, registers);
        }
        for &(friction, _, rates) in &shape.slip_directions {
            for (rate, u) in rates
                .into_iter()
                .zip(slip_directions.coefficient(friction, 1))
            {
                registers[rate.index()] = u;
            }
        }
        series.run(
            shape.program(Extent::Series),
            registers,
            order,
            &shape.integrals,
            |k, now, first, earlier| {
                shape.right_hand_sides(now, first, earlier, right);
                solver.solve(right);
                for (register, &x) in shape.unknowns.iter().zip(&*right) {
                    now[register.index()] = x;
                }
                let next = T::from_f64((k + 1) as f64);
                for given in &shape.resultants {
                    let rest = resultants.follow(given, k, right, now);
                    now[given.rest.1.index()] = next * rest;
                }
                for &(friction, _, rates) in &shape.slip_directions {
                    let turn = slip_directions.coefficient(friction, k + 1);
                    for (rate, u) in rates.into_iter().zip(turn) {
                        now[rate.index()] = next * u;
                    }
                }
            },
        );
    }

    /// Coefficients 0…`order` of everything.
    pub(super) fn expand_anew(&mut self, order: usize) -> Result<(), EvaluationError> {
        self.start_series(order)?;
        self.expand(order);
        Ok(())
    }

    /// Coefficients 0 of everything.
    fn start_series(&mut self, order: usize) -> Result<(), EvaluationError> {
        let (_, _, interpreted) = self.modes[self.current].parts();
        interpreted.evaluate(Extent::Series, REPORT);
        let (series, registers) = interpreted.series_memory(order);
        let first = series.singular(registers).next();
        match first {
            Some((operation, result)) => Err(self.no_series(operation, result)),
            None => {
                series.begin(registers);
                Ok(())
            }
        }
    }

    /// The same as [`Self::expand_anew`] where only stops and marks have no series: their coefficients are no numbers then.
    fn expand_past_watches(&mut self, order: usize) -> Result<(), EvaluationError> {
        let description = self.description;
        let (_, _, interpreted) = self.modes[self.current].parts();
        interpreted.evaluate(Extent::Series, REPORT);
        let (shape, registers, series) = interpreted.parts();
        let Some(series) = series else {
            return Ok(());
        };
        let of_motion = |&(_, result): &(Operation, Register)| {
            shape.item_of_motion(result, description).is_some()
        };
        let first = series.singular(registers).find(of_motion);
        match first {
            Some((operation, result)) => Err(self.no_series(operation, result)),
            None => {
                series.begin(registers);
                self.without_watches = true;
                self.expand(order);
                Ok(())
            }
        }
    }

    /// Whether some stop or mark has no series at the state of the last one.
    pub(crate) fn is_without_watches(&self) -> bool {
        self.without_watches
    }

    /// An operation, whose result goes there, has no series.
    fn no_series(&mut self, operation: Operation, result: Register) -> EvaluationError {
        let (_, _, interpreted) = self.modes[self.current].parts();
        let item = interpreted.shape.item_of(result, self.description);
        EvaluationError::NoSeries { operation, item }
    }

    /// Coefficients of all positions and of all velocities; those above the order of the last series mean nothing.
    #[inline]
    pub(crate) fn state_series(&self) -> [&[Row<T>]; 2] {
        let n = self.description.coordinates.len();
        let rows = match self.in_use() {
            Some(emitted) => emitted.state_series(n),
            None => {
                let interpreted = self.compiled().interpreted();
                interpreted.map_or(&[][..], |interpreted| interpreted.state_series(n))
            }
        };
        let (positions, velocities) = rows.split_at_checked(n).unwrap_or_default();
        [positions, velocities]
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

    #[inline(always)]
    fn input_series(&self, index: usize) -> &[T] {
        if let Some(emitted) = self.in_use() {
            return emitted.input_series(self.description, index);
        }
        let interpreted = self.compiled().interpreted();
        interpreted.map_or(&[], |interpreted| interpreted.input_series(index))
    }

    /// Coefficients of a number of the motion program that depends on the state. Its need must have been asked for by
    /// [`Self::set_extra_needs`]; of other numbers, zeros.
    #[doc(hidden)]
    pub fn motion_series(&self, place: ValueRef) -> &[T] {
        let ValueRef::Node(node) = place else {
            return self.zero_series();
        };
        if let Some(emitted) = self.in_use() {
            return emitted.motion_series(self.description, node);
        }
        let interpreted = self.compiled().interpreted();
        interpreted.map_or(&[], |interpreted| interpreted.node_series(node))
    }

    /// Coefficients of a term of a stop or a mark that depends on the state. Its need must have been asked for by
    /// [`Self::set_report_needs`]; of other numbers, zeros: emitted functions give series of what guards read.
    #[doc(hidden)]
    pub fn report_series(&self, place: ValueRef) -> &[T] {
        let ValueRef::Node(node) = place else {
            return self.zero_series();
        };
        if let Some(emitted) = self.in_use() {
            return emitted.report_series(self.description, node);
        }
        let interpreted = self.compiled().interpreted();
        interpreted.map_or(&[], |interpreted| interpreted.report_series(node))
    }

    fn zero_series(&self) -> &[T] {
        if let Some(emitted) = self.in_use() {
            return emitted.zero_series(self.description);
        }
        let interpreted = self.compiled().interpreted();
        interpreted.map_or(&[], |interpreted| interpreted.zero_series())
    }
}
