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

use super::table::{Table, layout};
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Arithmetic, Jet, Scalar};
use crate::system::{Held, Place, System};

impl<S: System> Dynamics<S> {
    /// Taylor coefficients 0…`order` in the time τ since `t` of positions, velocities, accelerations, forces and all outputs
    /// that are held. The arrays that the `…_series` functions return have `order + 1` elements.
    pub fn series(
        &mut self,
        t: S::Scalar,
        q: &[S::Scalar],
        v: &[S::Scalar],
        order: usize,
    ) -> Result<(), EvaluationError> {
        self.work.series += 1;
        let n = S::DESCRIPTION.coordinates.len();
        self.table
            .prepare(S::DESCRIPTION, &self.constants, &self.plan, order);
        let Table {
            coefficients,
            inputs,
            ..
        } = &mut self.table;
        coefficients.put(inputs[0], 0, t);
        for (&slot, &x) in inputs[1..1 + 2 * n].iter().zip(q.iter().chain(v)) {
            coefficients.put(slot, 0, x);
        }
        for k in 0..=order {
            self.work.coefficients += 1;
            self.append_motion(k)?;
            if k == 0 {
                self.table.resolve(S::DESCRIPTION, &self.plan);
                self.factor_start()?;
            }
            self.gather(k);
            self.solve()?;
            if k == 0 {
                self.check_rows_aside()?;
            }
            self.scatter(k);
            if self.reports {
                self.append_report(k)?;
            }
            if k < order {
                self.integrate(k);
            }
        }
        Ok(())
    }

    fn append_motion(&mut self, k: usize) -> Result<(), EvaluationError> {
        let d = S::DESCRIPTION;
        let parts = layout(d);
        let held = Held {
            needs: &self.held,
            branches: &self.mode.branches,
        };
        let Table {
            coefficients,
            inputs,
            nodes,
            ..
        } = &mut self.table;
        let inputs = &inputs[..1 + 2 * d.coordinates.len()];
        let mut a = coefficients.jet(k, parts.motion);
        self.scene.motion(
            &mut a,
            &held,
            &self.constants,
            inputs,
            &mut nodes[..d.motion.outputs],
        );
        a.origin(parts.program);
        self.plan.program.run(&mut a, &self.constants, nodes);
        expandable(&a)
    }

    fn append_report(&mut self, k: usize) -> Result<(), EvaluationError> {
        let held = Held {
            needs: &self.report_held,
            branches: &self.mode.branches,
        };
        let Table {
            coefficients,
            inputs,
            report_nodes,
            ..
        } = &mut self.table;
        let mut a = coefficients.jet(k, layout(S::DESCRIPTION).report);
        self.scene
            .report(&mut a, &held, &self.constants, inputs, report_nodes);
        expandable(&a)
    }

    fn factor_start(&mut self) -> Result<(), EvaluationError> {
        let table = core::mem::take(&mut self.table);
        let outcome = self.factor(|node| table.coefficients.get(table.nodes[node], 0));
        self.table = table;
        outcome
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
        let Table {
            coefficients,
            inputs,
            nodes,
            kept,
            force_parts,
            ..
        } = table;
        let n = S::DESCRIPTION.coordinates.len();
        let (accelerations, forces) = inputs[1 + 2 * n..].split_at(n);
        for (j, &slot) in accelerations.iter().enumerate() {
            coefficients.put(slot, k, plan.elimination.acceleration(j, solution));
        }
        for (&slot, &x) in kept.iter().zip(&solution[plan.free()..]) {
            coefficients.put(slot, k, -x);
        }
        let constant_parts = plan.constant_forces(solution).zip(&right[plan.size()..]);
        for (&row, (part, &load)) in plan.eliminated.iter().zip(constant_parts) {
            coefficients.put(forces[row], k, part - load);
        }
        for part in force_parts.iter() {
            let product = coefficients.product(part.element, part.unknown, k);
            let sum =
                coefficients.get(part.force, k) + if part.subtract { -product } else { product };
            coefficients.put(part.force, k, sum);
        }
        for slide in &plan.slides {
            let normal = slide.source.map(|source| forces[source]);
            let force = match (slide.factor, normal) {
                (Place::Zero, _) => S::Scalar::default(),
                (Place::Constant(c), Some(normal)) => constants[c] * coefficients.get(normal, k),
                (Place::Constant(c), None) if k == 0 => constants[c],
                (Place::Constant(_), None) => S::Scalar::default(),
                (Place::Node(node), Some(normal)) => coefficients.product(nodes[node], normal, k),
                (Place::Node(node), None) => coefficients.get(nodes[node], k),
            };
            coefficients.put(forces[slide.row], k, force);
        }
    }

    /// Coefficient k + 1 of positions and velocities.
    fn integrate(&mut self, k: usize) {
        let Table {
            coefficients,
            inputs,
            ..
        } = &mut self.table;
        let n = S::DESCRIPTION.coordinates.len();
        let next = S::Scalar::from_f64((k + 1) as f64);
        for (&slot, &rate) in inputs[1..1 + 2 * n].iter().zip(&inputs[1 + n..]) {
            let rate = coefficients.get(rate, k);
            coefficients.put(slot, k + 1, rate / next);
        }
    }

    /// Position coefficients of coordinate `i`.
    pub fn position_series(&self, i: usize) -> &[S::Scalar] {
        self.table.coefficients.series(self.table.inputs[1 + i])
    }

    /// Velocity coefficients of coordinate `i`.
    pub fn velocity_series(&self, i: usize) -> &[S::Scalar] {
        self.table
            .coefficients
            .series(self.table.inputs[1 + S::DESCRIPTION.coordinates.len() + i])
    }

    /// Acceleration coefficients of coordinate `i`.
    pub fn acceleration_series(&self, i: usize) -> &[S::Scalar] {
        self.table
            .coefficients
            .series(self.table.inputs[1 + 2 * S::DESCRIPTION.coordinates.len() + i])
    }

    /// Force coefficients of a row; zeros where it does not act.
    pub fn force_series(&self, row: usize) -> &[S::Scalar] {
        self.table
            .coefficients
            .series(self.table.inputs[1 + 3 * S::DESCRIPTION.coordinates.len() + row])
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

fn expandable<T: Scalar>(a: &Jet<'_, T>) -> Result<(), EvaluationError> {
    match a.singular() {
        None => Ok(()),
        Some(singular) => Err(EvaluationError::NoSeries {
            operation: singular.operation,
        }),
    }
}
