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

use super::table::{Table, Tapes};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Coefficients, Recording, Scalar, Variation};
use crate::system::{Held, Place, System};
use num_traits::{One, Zero};

impl<S: System> Dynamics<S> {
    /// Taylor coefficients 0…`order` in the time τ since `t` of positions, velocities, accelerations, forces and all outputs
    /// that are held. The arrays that the `…_series` functions return have `order + 1` elements.
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
        self.work.series += 1;
        self.work.coefficients += order + 1;
        self.record(v, order);
        self.begin(t, q, v);
        for k in 0..=order {
            let Table {
                coefficients,
                motion,
                ..
            } = &mut self.table;
            append(motion, coefficients, k)?;
            if k == 0 {
                self.factor_start()?;
            }
            self.gather(k);
            self.solve()?;
            if k == 0 {
                self.check_rows_aside()?;
                self.refine();
            }
            self.scatter(k);
            let Table {
                coefficients,
                report,
                ..
            } = &mut self.table;
            append(report, coefficients, k)?;
            if k < order {
                self.integrate(k);
            }
        }
        Ok(())
    }

    /// Records the tapes of the mode unless that has been done.
    fn record(&mut self, v: &[S::Scalar], order: usize) {
        let branches = &self.mode.branches[..];
        let tapes = Tapes {
            scene: &self.scene,
            constants: &self.constants,
            plan: &self.plan,
            motion: Held {
                needs: &self.held,
                branches,
            },
            report: self.reports.then_some(Held {
                needs: &self.report_held,
                branches,
            }),
        };
        let at_rest = v
            .iter()
            .enumerate()
            .all(|(j, v)| v.is_zero() || !self.plan.is_pinned(j));
        self.table.prepare(&tapes, order, at_rest);
    }

    /// Coefficients 0 of the state, and of time all.
    fn begin(&mut self, t: S::Scalar, q: &[S::Scalar], v: &[S::Scalar]) {
        let time = self.table.input(0);
        self.table.coefficients.put(time, 0, t);
        if self.table.order() > 0 {
            // dt/dτ = 1
            self.table.coefficients.put(time, 1, S::Scalar::one());
        }
        for (i, &x) in q.iter().chain(v).enumerate() {
            let slot = self.table.input(1 + i);
            self.table.coefficients.put(slot, 0, x);
        }
    }

    fn factor_start(&mut self) -> Result<(), EvaluationError> {
        let table = core::mem::take(&mut self.table);
        let outcome = self.factor(|node| table.coefficients.get(table.nodes[node].slot, 0));
        self.table = table;
        outcome
    }

    /// Takes out of the first forces what rounding leaves in them step after step.
    fn refine(&mut self) {
        let (free, size) = (self.plan.free(), self.plan.size());
        if size > free {
            self.solver
                .refine(&mut self.solution, &mut self.right[..size]);
        }
    }

    /// Right-hand sides: bₖ − Σ_{j=1..k} Kⱼ xₖ₋ⱼ.
    fn gather(&mut self, k: usize) {
        let Self {
            plan, right, table, ..
        } = self;
        let Table {
            coefficients,
            loads,
            with_accelerations,
            with_forces,
            ..
        } = table;
        if k == 0 {
            right.copy_from_slice(&plan.constant_load);
        } else {
            right.fill(S::Scalar::default());
            for product in with_accelerations.iter() {
                right[product.row] -=
                    coefficients.tail_product(product.element, product.unknown, k);
            }
            for product in with_forces.iter() {
                right[product.row] +=
                    coefficients.tail_product(product.element, product.unknown, k);
            }
        }
        for &(row, factor, node) in loads.iter() {
            right[row] += factor * coefficients.get(node, k);
        }
    }

    /// Coefficient k of all accelerations and forces from the solution.
    fn scatter(&mut self, k: usize) {
        let Self {
            plan,
            right,
            solution,
            constants,
            table,
            ..
        } = self;
        let n = S::DESCRIPTION.coordinates.len();
        for &(j, slot) in &table.accelerations {
            table
                .coefficients
                .put(slot, k, plan.elimination.acceleration(j, solution));
        }
        for (&slot, &x) in table.kept.iter().zip(&solution[plan.free()..]) {
            table.coefficients.put(slot, k, -x);
        }
        let force = |row: usize| 1 + 3 * n + row;
        let constant_parts = plan.constant_forces(solution).zip(&right[plan.size()..]);
        for (&row, (part, &load)) in plan.eliminated.iter().zip(constant_parts) {
            let slot = table.input(force(row));
            table.coefficients.put(slot, k, part - load);
        }
        let coefficients = &mut table.coefficients;
        for part in &table.force_parts {
            let element = part.element.slot;
            let product = match part.element.variation {
                Variation::Varying => coefficients.product(element, part.unknown, k),
                _ => coefficients.get(element, 0) * coefficients.get(part.unknown, k),
            };
            let sum =
                coefficients.get(part.force, k) + if part.subtract { -product } else { product };
            coefficients.put(part.force, k, sum);
        }
        for slide in &plan.slides {
            let normal = slide.source.map(|source| table.input(force(source)));
            let coefficients = &mut table.coefficients;
            let value = match (slide.factor, normal) {
                (Place::Zero, _) => S::Scalar::zero(),
                (Place::Constant(c), Some(normal)) => constants[c] * coefficients.get(normal, k),
                (Place::Constant(c), None) if k == 0 => constants[c],
                (Place::Constant(_), None) => S::Scalar::zero(),
                (Place::Node(node), Some(normal)) => {
                    coefficients.product(table.nodes[node].slot, normal, k)
                }
                (Place::Node(node), None) => coefficients.get(table.nodes[node].slot, k),
            };
            let slot = table.input(force(slide.row));
            table.coefficients.put(slot, k, value);
        }
    }

    /// Coefficient k + 1 of positions and velocities.
    fn integrate(&mut self, k: usize) {
        let Table {
            coefficients,
            integrals,
            ..
        } = &mut self.table;
        let next = S::Scalar::from_f64((k + 1) as f64);
        for &(slot, rate) in integrals.iter() {
            let rate = coefficients.get(rate, k);
            coefficients.put(slot, k + 1, rate / next);
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
        self.table.coefficients.series(self.table.input(index))
    }

    /// Coefficients of a number of the motion tape. Its need must have been held.
    pub fn motion_series(&self, place: Place) -> &[S::Scalar] {
        self.table.series(S::DESCRIPTION, place, &self.table.nodes)
    }

    /// Coefficients of a number of the report tape. Its need must have been held.
    pub fn report_series(&self, place: Place) -> &[S::Scalar] {
        self.table
            .series(S::DESCRIPTION, place, &self.table.report_nodes)
    }
}

/// Appends coefficient `k` of everything in a recording.
fn append<T: Scalar>(
    recording: &Recording<T>,
    coefficients: &mut Coefficients<T>,
    k: usize,
) -> Result<(), EvaluationError> {
    let mut a = coefficients.jet(k, 0);
    recording.run(&mut a);
    match a.singular() {
        None => Ok(()),
        Some(singular) => Err(EvaluationError::NoSeries {
            operation: singular.operation,
        }),
    }
}
