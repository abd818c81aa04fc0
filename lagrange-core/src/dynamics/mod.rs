//! The equations of motion of a scene in one mode at a time: evaluated, expanded in Taylor series, projected.
//!
//! A [`Dynamics`] owns all memory that this takes. It is told a [`Mode`] and from then on runs only what that mode needs.

mod error;
mod jacobian;
mod matrices;
mod needs;
mod projection;
mod series;
mod stepping;
mod table;
#[cfg(test)]
pub(crate) mod tests;
mod values;

pub use error::{EvaluationError, row_name};
pub use needs::{NeedSet, add_branch_guards, add_guards};
pub use projection::Residual;

use crate::effects::Effects;
use crate::linear::{Plan, SolveError, Solver};
use crate::mode::Mode;
use crate::system::{Description, Held, Place, System};
use table::Table;

/// Work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the equations of motion as values.
    pub values: usize,
    /// Taylor expansions.
    pub series: usize,
    /// Coefficients computed by them: Σ (order + 1).
    pub coefficients: usize,
    /// Factorizations of the linear system.
    pub factorizations: usize,
    /// Runs of the tape by projections.
    pub projections: usize,
}

/// The equations of motion of a scene.
#[derive(Clone, Debug)]
pub struct Dynamics<S: System> {
    scene: S,
    effects: Effects,
    mode: Mode,
    /// Of the equations of motion in this mode.
    motion_needs: NeedSet,
    /// The same and what was asked for beside.
    held: NeedSet,
    extra: NeedSet,
    report_needs: NeedSet,
    /// What the report tape is told: the effects' own needs and what was asked for.
    report_held: NeedSet,
    reports: bool,
    /// Of the named energies.
    energies: NeedSet,
    /// Inertia, Jacobians and residuals of the rows that act.
    row_needs: NeedSet,
    /// The system's own, then the plan's.
    constants: Vec<S::Scalar>,
    plan: Plan<S::Scalar>,
    solver: Solver<S::Scalar>,
    /// Whether the solver holds the factors of this plan.
    factored: bool,
    /// t, q, v, v̇, λ of all rows.
    inputs: Vec<S::Scalar>,
    /// Outputs of the motion tape, then results of the plan's program.
    nodes: Vec<S::Scalar>,
    report_nodes: Vec<S::Scalar>,
    right: Vec<S::Scalar>,
    solution: Vec<S::Scalar>,
    projection: projection::Scratch<S::Scalar>,
    /// The solution of the value while its derivatives are computed.
    known: Vec<S::Scalar>,
    lane_inputs: Vec<jacobian::Lanes<S::Scalar>>,
    lane_nodes: Vec<jacobian::Lanes<S::Scalar>>,
    table: Table<S::Scalar>,
    work: Work,
}

impl<S: System> Dynamics<S> {
    /// Takes a copy of the scene and memory for every mode; the mode is "everything open" until
    /// [`Self::set_mode`].
    pub fn new(scene: &S, effects: &Effects) -> Self {
        let d = S::DESCRIPTION;
        let (n, rows) = (d.coordinates.len(), d.rows.len());
        let zero = S::Scalar::default();
        let mut dynamics = Self {
            scene: scene.clone(),
            effects: effects.clone(),
            mode: Mode::open(d),
            motion_needs: NeedSet::new(d),
            held: NeedSet::new(d),
            extra: NeedSet::new(d),
            report_needs: NeedSet::new(d),
            report_held: NeedSet::new(d),
            reports: false,
            energies: needs::of_energies(d),
            row_needs: NeedSet::new(d),
            constants: Vec::with_capacity(d.constants),
            plan: Plan::default(),
            solver: Solver::default(),
            factored: false,
            inputs: vec![zero; 1 + 3 * n + rows],
            nodes: vec![zero; d.motion.outputs],
            report_nodes: vec![zero; d.report.outputs],
            right: Vec::with_capacity(n + rows),
            solution: Vec::with_capacity(n + rows),
            projection: projection::Scratch::new(n, rows),
            known: Vec::new(),
            lane_inputs: Vec::new(),
            lane_nodes: Vec::new(),
            table: Table::default(),
            work: Work::default(),
        };
        dynamics.solver.reserve(n, rows);
        let open = dynamics.mode.clone();
        dynamics.set_mode(&open);
        dynamics
    }

    /// The table of names, places and needs.
    pub fn description(&self) -> &'static Description {
        S::DESCRIPTION
    }

    /// The scene.
    pub fn scene(&self) -> &S {
        &self.scene
    }

    /// The effects that take part.
    pub fn effects(&self) -> &Effects {
        &self.effects
    }

    /// The present mode.
    pub fn mode(&self) -> &Mode {
        &self.mode
    }

    /// What the equations of motion of this mode need.
    pub fn motion_needs(&self) -> &NeedSet {
        &self.motion_needs
    }

    /// What was asked of the report tape.
    pub fn report_needs(&self) -> &NeedSet {
        &self.report_needs
    }

    /// Work done so far.
    pub fn work(&self) -> Work {
        Work {
            factorizations: self.solver.factorizations,
            ..self.work
        }
    }

    /// The rows that act as equations in this mode, ascending.
    pub fn acting_rows(&self) -> &[usize] {
        &self.plan.acting
    }

    /// Changes the mode: parameter-only numbers and the plan of the linear system are made anew. What was asked for
    /// beside the motion stays asked for.
    pub fn set_mode(&mut self, mode: &Mode) {
        let d = S::DESCRIPTION;
        self.mode.clone_from(mode);
        needs::of_motion(d, &self.effects, mode, &mut self.motion_needs);
        needs::of_rows(d, &self.effects, mode, &mut self.row_needs);
        needs::of_effects(d, &self.effects, &mut self.held);
        self.constants.clear();
        self.constants.resize(d.constants, S::Scalar::default());
        let held = Held {
            needs: &self.held,
            branches: &self.mode.branches,
        };
        self.scene.constants(&held, &mut self.constants);
        self.plan.set(d, &self.effects, mode, &mut self.constants);
        self.nodes.resize(
            d.motion.outputs + self.plan.program.len(),
            S::Scalar::default(),
        );
        let forces = 1 + 3 * d.coordinates.len();
        self.inputs[forces..].fill(S::Scalar::default());
        self.table.outdate();
        self.right
            .resize(self.plan.constant_load.len(), S::Scalar::default());
        self.solution.resize(self.plan.size(), S::Scalar::default());
        self.factored = false;
        self.hold();
    }

    /// Asks the motion tape for more than the equations of motion: gaps, slips, coefficients, branch guards.
    /// Replaces what was asked for before.
    pub fn set_extra_needs(&mut self, needs: &[u64]) {
        self.extra.clear();
        self.extra.extend(needs);
        self.hold();
    }

    /// Asks for outputs of the report tape, of [`Self::report_value`] and of every [`Self::series`]. Replaces what was
    /// asked for before; need 0 alone asks for nothing.
    pub fn set_report_needs(&mut self, needs: &[u64]) {
        self.report_needs.clear();
        self.report_needs.extend(needs);
        self.hold();
    }

    /// What the tapes are told. A series recorded for other needs is out of date.
    fn hold(&mut self) {
        let d = S::DESCRIPTION;
        let motion = self.motion_needs.iter().zip(self.extra.iter());
        let mut changed = self.held.assign(motion.map(|(a, b)| a | b));
        // The named energies stand under their own needs also in the report, for the energy balance alone.
        let balance =
            self.report_needs.contains(d.energy.need) || self.report_needs.contains(d.momenta.need);
        let left_out = |energies: u64| if balance { 0 } else { energies };
        let report = self
            .held
            .iter()
            .zip(self.report_needs.iter())
            .zip(self.energies.iter());
        changed |= self
            .report_held
            .assign(report.map(|((a, b), &e)| (a | b) & !left_out(e)));
        let after_solve = d
            .branches
            .iter()
            .any(|b| b.after_solve && self.held.contains(b.need));
        let reports = after_solve
            || self
                .report_needs
                .iter()
                .enumerate()
                .any(|(i, &w)| w & !u64::from(i == 0) != 0);
        changed |= reports != self.reports;
        self.reports = reports;
        if changed {
            self.table.outdate();
        }
    }

    fn solve_error(&self, error: SolveError) -> EvaluationError {
        let free = self.plan.free();
        match error {
            SolveError::NotFinite { equation } => self.not_finite(equation),
            SolveError::Undetermined { unknown } if unknown < free => EvaluationError::NoInertia {
                coordinate: self.plan.elimination.free[unknown],
            },
            SolveError::Undetermined { unknown } => EvaluationError::Undetermined {
                row: self.plan.kept[unknown - free],
            },
            SolveError::Inconsistent { row, residual } => EvaluationError::Inconsistent {
                row: self.plan.kept[row],
                residual,
            },
        }
    }

    /// The acceleration or force that is not finite, given a solution with such a number.
    fn not_finite(&self, unknown: usize) -> EvaluationError {
        let free = self.plan.free();
        if unknown < free {
            EvaluationError::NotFiniteAcceleration {
                coordinate: self.plan.elimination.free[unknown],
            }
        } else {
            EvaluationError::NotFiniteForce {
                row: self.plan.kept[unknown - free],
            }
        }
    }

    /// A number of the motion tape at the last [`Self::value`]. Its need must have been held.
    #[inline]
    pub fn motion(&self, place: Place) -> S::Scalar {
        match place {
            Place::Zero => S::Scalar::default(),
            Place::Constant(i) => self.constants[i],
            Place::Node(i) => self.nodes[i],
        }
    }

    /// A number of the report tape at the last [`Self::report_value`]. Its need must have been held.
    #[inline]
    pub fn report(&self, place: Place) -> S::Scalar {
        match place {
            Place::Zero => S::Scalar::default(),
            Place::Constant(i) => self.constants[i],
            Place::Node(i) => self.report_nodes[i],
        }
    }

    /// v̇ at the last [`Self::value`], one per coordinate.
    #[inline]
    pub fn acceleration(&self) -> &[S::Scalar] {
        let n = S::DESCRIPTION.coordinates.len();
        &self.inputs[1 + 2 * n..1 + 3 * n]
    }

    /// The force λ of a row at the last [`Self::value`]: 0 where the row does not act; −μk N d for sliding friction.
    #[inline]
    pub fn force(&self, row: usize) -> S::Scalar {
        self.inputs[1 + 3 * S::DESCRIPTION.coordinates.len() + row]
    }
}
