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

use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Arithmetic, Coefficients, Scalar, Slot};
use crate::linear::Plan;
use crate::system::{Description, Held, Place, System};

/// Coefficient table: zero | t q v v̇ λ | constants | motion tape | report tape | plan's program.
#[derive(Clone, Debug, Default)]
pub(super) struct Table<T> {
    coefficients: Coefficients<T>,
    current: bool,
    order: usize,
    inputs: Vec<Slot>,
    nodes: Vec<Slot>,
    report_nodes: Vec<Slot>,
    /// Where the unknowns of the linear system are (forces with the other sign).
    unknowns: Vec<Slot>,
}

/// First slots of the parts.
struct Layout {
    inputs: usize,
    constants: usize,
    motion: usize,
    report: usize,
    program: usize,
}

fn layout(d: &Description) -> Layout {
    let inputs = 1;
    let constants = inputs + 1 + 3 * d.coordinates.len() + d.rows.len();
    let motion = constants + d.constants;
    let report = motion + d.motion.slots;
    Layout {
        inputs,
        constants,
        motion,
        report,
        program: report + d.report.slots,
    }
}

impl<T: Scalar> Table<T> {
    /// The mode has changed: shape and constants must be set before the next series.
    pub(super) fn outdate(&mut self) {
        self.current = false;
    }

    fn prepare(&mut self, d: &Description, constants: &[T], plan: &Plan<T>, order: usize) {
        if self.current && self.order == order {
            return;
        }
        self.current = true;
        self.order = order;
        let parts = layout(d);
        let program = plan.program.len();
        self.coefficients.shape(parts.program + program, order);
        let stride = self.coefficients.stride();
        self.inputs.clear();
        self.inputs
            .extend((parts.inputs..parts.constants).map(|slot| Slot::new(slot, stride)));
        self.nodes.clear();
        self.nodes
            .resize(d.motion.outputs + program, Slot::new(0, stride));
        self.report_nodes.clear();
        self.report_nodes
            .resize(d.report.outputs, Slot::new(0, stride));
        for (i, &c) in constants[..d.constants].iter().enumerate() {
            self.coefficients
                .put(Slot::new(parts.constants + i, stride), 0, c);
        }
        let (n, inputs) = (d.coordinates.len(), &self.inputs);
        self.unknowns.clear();
        self.unknowns
            .extend(plan.elimination.free.iter().map(|&j| inputs[1 + 2 * n + j]));
        self.unknowns
            .extend(plan.kept.iter().map(|&row| inputs[1 + 3 * n + row]));
        // dt/dτ = 1
        if order > 0 {
            self.coefficients.put(self.inputs[0], 1, T::one());
        }
    }

    fn series(&self, d: &Description, place: Place, nodes: &[Slot]) -> &[T] {
        let slot = match place {
            Place::Zero => self.coefficients.slot(0),
            Place::Constant(i) => self.coefficients.slot(layout(d).constants + i),
            Place::Node(i) => nodes[i],
        };
        self.coefficients.series(slot)
    }
}

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
                self.factor_start()?;
            }
            self.append_solution(k)?;
            if self.reports {
                self.append_report(k)?;
            }
            if k < order {
                let Table {
                    coefficients,
                    inputs,
                    ..
                } = &mut self.table;
                let next = S::Scalar::from_f64((k + 1) as f64);
                for i in 1..1 + 2 * n {
                    let rate = coefficients.get(inputs[i + n], k);
                    coefficients.put(inputs[i], k + 1, rate / next);
                }
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
        a.singular().map_or(Ok(()), |s| {
            Err(EvaluationError::NoSeries {
                operation: s.operation,
            })
        })
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
        a.singular().map_or(Ok(()), |s| {
            Err(EvaluationError::NoSeries {
                operation: s.operation,
            })
        })
    }

    fn factor_start(&mut self) -> Result<(), EvaluationError> {
        let table = core::mem::take(&mut self.table);
        let outcome = self.factor(|node| table.coefficients.get(table.nodes[node], 0));
        self.table = table;
        outcome
    }

    /// Coefficient k of accelerations and forces.
    fn append_solution(&mut self, k: usize) -> Result<(), EvaluationError> {
        self.gather(k);
        self.solve()?;
        if k == 0 {
            self.check_rows_aside()?;
        }
        self.scatter(k);
        Ok(())
    }

    /// Right-hand sides: bₖ − Σ_{j=1..k} Kⱼ xₖ₋ⱼ.
    fn gather(&mut self, k: usize) {
        let Self {
            plan,
            right,
            table:
                Table {
                    coefficients,
                    nodes,
                    unknowns,
                    ..
                },
            ..
        } = self;
        right.clear();
        if k == 0 {
            right.extend_from_slice(&plan.constant_load);
        } else {
            right.resize(plan.constant_load.len(), S::Scalar::default());
        }
        for load in &plan.loads {
            right[load.row] += load.factor * coefficients.get(nodes[load.node], k);
        }
        if k > 0 {
            let (accelerations, forces) = plan.entries.split_at(plan.first_force);
            for entry in accelerations {
                right[entry.row] -=
                    coefficients.tail_product(nodes[entry.node], unknowns[entry.column], k);
            }
            // The unknown is −λ, the table holds λ.
            for entry in forces {
                right[entry.row] +=
                    coefficients.tail_product(nodes[entry.node], unknowns[entry.column], k);
            }
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
            unknowns,
            ..
        } = table;
        let n = S::DESCRIPTION.coordinates.len();
        let (accelerations, forces) = inputs[1 + 2 * n..].split_at(n);
        for (j, &slot) in accelerations.iter().enumerate() {
            coefficients.put(slot, k, plan.elimination.acceleration(j, solution));
        }
        let (free, size) = (plan.free(), plan.size());
        for (&slot, &x) in unknowns[free..].iter().zip(&solution[free..]) {
            coefficients.put(slot, k, -x);
        }
        for (i, &row) in plan.eliminated.iter().enumerate() {
            coefficients.put(
                forces[row],
                k,
                plan.constant_force(i, solution) - right[size + i],
            );
        }
        for entry in &plan.force_entries {
            let slot = forces[plan.eliminated[entry.row - size]];
            let part = coefficients.product(nodes[entry.node], unknowns[entry.column], k);
            let sum = coefficients.get(slot, k) + if entry.column < free { part } else { -part };
            coefficients.put(slot, k, sum);
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
