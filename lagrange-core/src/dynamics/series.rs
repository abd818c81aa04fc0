//! The jet reading: Taylor coefficients of the motion, its forces and all outputs.
//!
//! With K x = b and x = (v̇, −λ),
//!
//! ```text
//! K₀ xₖ = bₖ − Σ_{j=1..k} Kⱼ xₖ₋ⱼ        vₖ₊₁ = v̇ₖ/(k+1)        qₖ₊₁ = vₖ/(k+1)
//! ```
//!
//! one factorization whatever the order; the sum runs over those matrix elements that change with the state.
//! Reference: Griewank & Walther 2008, Evaluating Derivatives, section 13.2 (implicit relations).

use super::tape::{FORCES, MOTION, REPORT};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{MAX_ORDER, Scalar, Slot};
use crate::system::{Place, System};
use num_traits::{One, Zero};

impl<S: System> Dynamics<S> {
    /// Taylor coefficients 0…`order` (at most 28) in the time τ since `t` of positions, velocities, accelerations, forces and all
    /// outputs that were asked for. The arrays that the `…_series` functions return have `order + 1` elements.
    ///
    /// # Errors
    /// Those of [`Self::value`], and [`EvaluationError::NoSeries`].
    pub fn series(
        &mut self,
        t: S::Scalar,
        q: &[S::Scalar],
        v: &[S::Scalar],
        order: usize,
    ) -> Result<(), EvaluationError> {
        let order = order.min(MAX_ORDER);
        self.work.series += 1;
        self.work.coefficients += order + 1;
        self.select(v);
        self.begin(t, q, v);
        self.start_series(order)?;
        let Self {
            modes,
            current,
            right,
            ..
        } = self;
        let (_, solver, tape) = modes[*current].parts();
        let integrals = core::mem::take(&mut tape.integrals);
        let unsolved = tape.unsolved.take();
        let (program, first, expansion) =
            (&tape.program, &mut tape.registers[..], &mut tape.expansion);
        for k in 1..=order {
            // dt/dτ = 1
            let time = if k == 1 {
                S::Scalar::one()
            } else {
                S::Scalar::zero()
            };
            expansion.put(Slot::new(1), time);
            let divisor = S::Scalar::from_f64(k as f64);
            for &(slot, rate) in &integrals {
                let rate = if k == 1 {
                    first[rate.index()]
                } else {
                    expansion.get(rate)
                };
                expansion.put(slot, rate / divisor);
            }
            expansion.advance(program, MOTION, k, first);
            if let Some(unsolved) = &unsolved {
                right.clear();
                let sides = unsolved.right.iter().enumerate();
                right.extend(sides.map(|(i, r)| {
                    let earlier = expansion.sum(i, k);
                    if r.varies() {
                        expansion.get(r.slot) - earlier
                    } else {
                        -earlier
                    }
                }));
                for &(equation, element, unknown) in &unsolved.elements {
                    right[equation] -= expansion.get(element) * first[unknown.index()];
                }
                solver.solve(right);
                for (&slot, &x) in unsolved.unknowns.iter().zip(&*right) {
                    expansion.put(slot, x);
                }
            }
            expansion.advance(program, FORCES, k, first);
            expansion.advance(program, REPORT, k, first);
            expansion.keep(k, order);
        }
        tape.integrals = integrals;
        tape.unsolved = unsolved;
        Ok(())
    }

    /// Coefficients 0 of everything.
    fn start_series(&mut self, order: usize) -> Result<(), EvaluationError> {
        let (_, _, tape) = self.modes[self.current].parts();
        tape.order = order;
        self.run_values()?;
        let (_, _, tape) = self.modes[self.current].parts();
        tape.program.evaluate(REPORT, &mut tape.registers);
        match tape.expansion.singular(&tape.registers) {
            Some(operation) => Err(EvaluationError::NoSeries { operation }),
            None => {
                tape.expansion.begin(&tape.registers);
                Ok(())
            }
        }
    }

    /// Position coefficients of coordinate `i`.
    pub fn position_series(&self, i: usize) -> &[S::Scalar] {
        self.input_series(1 + i)
    }

    /// Velocity coefficients of coordinate `i`.
    pub fn velocity_series(&self, i: usize) -> &[S::Scalar] {
        self.input_series(1 + S::DESCRIPTION.coordinates.len() + i)
    }

    /// Acceleration coefficients of coordinate `i`.
    pub fn acceleration_series(&self, i: usize) -> &[S::Scalar] {
        self.input_series(1 + 2 * S::DESCRIPTION.coordinates.len() + i)
    }

    /// Force coefficients of a row; zeros where it does not act.
    pub fn force_series(&self, row: usize) -> &[S::Scalar] {
        self.input_series(1 + 3 * S::DESCRIPTION.coordinates.len() + row)
    }

    fn input_series(&self, index: usize) -> &[S::Scalar] {
        self.compiled().tape().map_or(&[], |t| t.input_series(index))
    }

    /// Coefficients of a number of the motion tape that depends on the state. Its need must have been asked for by
    /// [`Self::set_extra_needs`]; of other numbers, zeros.
    pub fn motion_series(&self, place: Place) -> &[S::Scalar] {
        let tape = self.compiled().tape();
        tape.map_or(&[], |tape| match place {
            Place::Node(node) => tape.node_series(node),
            Place::Zero | Place::Constant(_) => tape.zero_series(),
        })
    }

    /// Coefficients of a number of the report tape that depends on the state. Its need must have been asked for by
    /// [`Self::set_report_needs`]; of other numbers, zeros.
    pub fn report_series(&self, place: Place) -> &[S::Scalar] {
        let tape = self.compiled().tape();
        tape.map_or(&[], |tape| match place {
            Place::Node(node) => tape.report_series(node),
            Place::Zero | Place::Constant(_) => tape.zero_series(),
        })
    }
}
