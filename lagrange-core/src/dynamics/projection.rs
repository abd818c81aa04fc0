//! Back onto the constraints: the least change in the mass metric that makes g(q,t) = 0 and then ġ = 0.
//!
//! ```text
//! ⎡ M  Aᵀ ⎤ ⎡ Δq ⎤   ⎡  0 ⎤                     ⎡ M  Aᵀ ⎤ ⎡ Δv ⎤   ⎡  0 ⎤
//! ⎣ A  0  ⎦ ⎣  μ ⎦ = ⎣ −g ⎦  until g = 0, then  ⎣ A  0  ⎦ ⎣  μ ⎦ = ⎣ −ġ ⎦
//! ```
//!
//! The rows are those that act in the mode; dependent ones follow from the others. Reference: Eich 1993, Convergence results
//! for a coordinate projection method applied to mechanical systems with algebraic constraints, SIAM J. Numer. Anal. 30.

use super::emitted::{Emitted, is_finite};
use super::error::Level;
use super::{Dynamics, EvaluationError};
use crate::arithmetic::{Scalar, epsilon};
use crate::integrate::least_size;
use crate::linear::{Inertia, Shares};
use crate::system::{Row, ValueRef};

/// Residuals are rounding below this share of the terms that they cancel from.
pub(crate) fn rounding_of_residuals<T: Scalar>() -> f64 {
    16.0 * epsilon::<T>()
}

/// A step's result is moved onto its constraints from this residual on. Between two projections a residual does work, and
/// a state just below [`rounding_of_residuals`] would be left to do it for tens of steps: with 4 instead of 16 units the energy of a
/// pendulum keeps a digit more, and still only one step in twenty needs a projection.
fn tolerated<T: Scalar>() -> f64 {
    4.0 * epsilon::<T>()
}

/// A residual that no step reduces any more is accepted below this size (1e-10 in double precision).
fn accepted<T: Scalar>() -> f64 {
    0.01 * epsilon::<T>().sqrt()
}

/// Newton steps from a state on a nearby constraint; it takes 2 or 3 unless the start is far away.
const MOST_STEPS: usize = 40;
/// Halvings of a step that makes the residual worse.
const MOST_HALVINGS: usize = 12;

/// Memory of a projection.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch<T> {
    right: Vec<T>,
    /// Change of positions or velocities.
    change: Vec<T>,
    /// A matrix of zeros.
    blank: Vec<T>,
    /// Positions before a Newton step.
    previous: Vec<T>,
}

impl<T: Scalar> Scratch<T> {
    /// Memory for so many coordinates and rows.
    pub(super) fn new(coordinates: usize, rows: usize) -> Self {
        let size = coordinates + rows;
        Self {
            right: Vec::with_capacity(size),
            change: Vec::with_capacity(size),
            blank: Vec::with_capacity(size * size),
            previous: vec![T::default(); coordinates],
        }
    }
}

/// Largest residual of a level: relative to a displacement (or velocity) of the size of the state, and where.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// max |gᵢ| / max_j |aᵢⱼ| max(1, |qⱼ|), dimensionless.
    pub relative: f64,
    /// Its row.
    pub row: usize,
    /// gᵢ itself, in the unit of the declaration.
    pub value: f64,
}

impl<T: Scalar> Dynamics<T> {
    /// Residuals at (t, q, v) of the rows that act: of positions g and of velocities ġ.
    pub fn residuals(&mut self, t: T, q: &[T], v: &[T]) -> (Residual, Residual) {
        if self.acting_rows().is_empty() {
            return Default::default();
        }
        self.see_rows(t, q, v);
        (
            self.residual(Level::Position, q),
            self.residual(Level::Velocity, v),
        )
    }

    /// Moves (q, v) onto the rows that act where a relative residual is above `tolerance` (0: wherever it is more than
    /// rounding). Returns whether anything was moved; the rounding in the velocity of a pinned coordinate goes in any case.
    ///
    /// # Errors
    /// [`EvaluationError::Projection`] if no state nearby satisfies a row.
    pub fn project(
        &mut self,
        t: T,
        q: &mut [T],
        v: &mut [T],
        tolerance: f64,
    ) -> Result<bool, EvaluationError> {
        if self.acting_rows().is_empty() {
            return Ok(false);
        }
        let given = self.see_rows(t, q, v);
        let threshold = tolerance.max(tolerated::<T>());
        let displaced = self.residual(Level::Position, q).relative > threshold;
        let mut least = tolerated::<T>();
        if displaced {
            self.move_positions(t, q, v, &[], least)?;
        }
        let mut residual = self.residual(Level::Velocity, v);
        let moved = displaced || residual.relative > threshold;
        if moved {
            if given && !displaced && residual.relative > least && self.take_velocity_changes() {
                residual = self.change_velocities(v);
                least = rounding_of_residuals::<T>();
            }
            self.move_velocities(v, &[], residual, least)?;
        }
        self.settle_pinned(q, v, threshold);
        let carries = T::DERIVATIVES > 0;
        if carries {
            self.move_derivatives(t, q, v, [&[], &[]]);
        }
        Ok(moved || carries)
    }

    /// Derivatives of (q, v) onto those of the rows that act, in the same metric: Newton steps that leave the values.
    fn move_derivatives(&mut self, t: T, q: &mut [T], v: &mut [T], held: [&[bool]; 2]) {
        for (level, held) in [Level::Position, Level::Velocity].into_iter().zip(held) {
            for _ in 0..T::DERIVATIVES {
                self.run_rows(t, q, v);
                if !self.correction(level, held) {
                    break;
                }
                let state = if level == Level::Position {
                    &mut *q
                } else {
                    &mut *v
                };
                for (x, &change) in state.iter_mut().zip(&self.projection.change) {
                    *x += change - T::from_f64(change.value());
                }
            }
        }
        self.run_rows(t, q, v);
    }

    /// Takes the rounding out of the positions and velocities of coordinates that a row of their own pins: a coordinate that is
    /// exactly at rest where it is pinned is a number in the equations of the mode. The last tape was run at (q, v).
    fn settle_pinned(&self, q: &mut [T], v: &mut [T], threshold: f64) {
        for &row in self.acting_rows() {
            let row = &self.description().rows[row];
            if let [(j, factor @ ValueRef::Constant(_))] = *row.jacobian
                && self.is_constantly_zero(row.bias)
            {
                if let Some(position) = row.position {
                    let excess = self.motion(position) / self.motion(factor);
                    if excess.value().abs() <= threshold * self.size_of(j, q) {
                        q[j] -= excess;
                    }
                }
                let excess = self.motion(row.velocity) / self.motion(factor);
                if excess.value().abs() <= threshold * self.size_of(j, v) {
                    v[j] -= excess;
                }
            }
        }
    }

    fn is_constantly_zero(&self, place: ValueRef) -> bool {
        !place.varies() && self.motion(place).is_zero()
    }

    /// Moves positions, then velocities, with some of them held: `held_positions[j]` keeps qⱼ, `held_velocities[j]` keeps vⱼ
    /// (shorter lists hold nothing more).
    ///
    /// # Errors
    /// [`EvaluationError::Projection`] if what is free cannot satisfy a row.
    pub(crate) fn project_holding(
        &mut self,
        t: T,
        q: &mut [T],
        v: &mut [T],
        held_positions: &[bool],
        held_velocities: &[bool],
    ) -> Result<(), EvaluationError> {
        self.move_positions(t, q, v, held_positions, rounding_of_residuals::<T>())?;
        self.project_velocities(t, q, v, held_velocities, rounding_of_residuals::<T>())?;
        if T::DERIVATIVES > 0 {
            self.move_derivatives(t, q, v, [held_positions, held_velocities]);
        }
        Ok(())
    }

    /// Least change of q in the mass metric that makes g(q,t) = 0, where a relative residual is above `least`; `v` is not used but for
    /// the tape.
    ///
    /// # Errors
    /// [`EvaluationError::Projection`] if what is free cannot satisfy a row.
    fn move_positions(
        &mut self,
        t: T,
        q: &mut [T],
        v: &[T],
        held: &[bool],
        mut least: f64,
    ) -> Result<(), EvaluationError> {
        self.run_rows(t, q, v);
        let mut residual = self.residual(Level::Position, q);
        for _ in 0..MOST_STEPS {
            if residual.relative <= least || !self.correction(Level::Position, held) {
                break;
            }
            let before = residual.relative;
            // Shorter steps do not help against rounding.
            let trials = if before <= rounding_of_residuals::<T>() {
                1
            } else {
                MOST_HALVINGS
            };
            let mut part = T::one();
            self.projection.previous.copy_from_slice(q);
            for _ in 0..trials {
                for (q, (&start, &change)) in q
                    .iter_mut()
                    .zip(self.projection.previous.iter().zip(&self.projection.change))
                {
                    *q = start + part * change;
                }
                self.run_rows(t, q, v);
                residual = self.residual(Level::Position, q);
                if residual.relative < before {
                    break;
                }
                part *= T::from_f64(0.5);
            }
            if !(residual.relative < before) {
                q.copy_from_slice(&self.projection.previous);
                self.run_rows(t, q, v);
                residual = self.residual(Level::Position, q);
                break;
            }
            least = rounding_of_residuals::<T>();
        }
        accept::<T>(residual)
    }

    /// Least change of v in the mass metric that makes ġ = 0, where a relative residual is above `least`: [`rounding_of_residuals`] as a rule, 0
    /// also where residuals are rounding beside a velocity of 1, of which a coordinate that a row hardly moves would keep many times that.
    ///
    /// # Errors
    /// [`EvaluationError::Projection`] if what is free cannot satisfy a row.
    pub(crate) fn project_velocities(
        &mut self,
        t: T,
        q: &[T],
        v: &mut [T],
        held: &[bool],
        least: f64,
    ) -> Result<(), EvaluationError> {
        self.run_rows(t, q, v);
        let residual = self.residual(Level::Velocity, v);
        self.move_velocities(v, held, residual, least)
    }

    /// [`Self::project_velocities`] from velocities of this `residual`, where it is above `least`. The motion program was run at (q, v),
    /// and its outputs are those at the new velocities afterwards, as far as projections read them.
    fn move_velocities(
        &mut self,
        v: &mut [T],
        held: &[bool],
        mut residual: Residual,
        mut least: f64,
    ) -> Result<(), EvaluationError> {
        // The equations are linear: the second pass only takes away rounding.
        for _ in 0..2 {
            if residual.relative <= least || !self.correction(Level::Velocity, held) {
                break;
            }
            residual = self.change_velocities(v);
            least = rounding_of_residuals::<T>();
        }
        accept::<T>(residual)
    }

    /// Takes the correction that the functions of the mode have given with the last value; false if they give none.
    fn take_velocity_changes(&mut self) -> bool {
        let emitted = self.modes[self.current].emitted.as_ref();
        let changes = emitted.map_or(&[][..], Emitted::velocity_changes);
        self.projection.change.clear();
        self.projection.change.extend_from_slice(changes);
        !changes.is_empty() && is_finite(changes)
    }

    /// Adds `projection.change` to the velocities; what is left of the rates.
    fn change_velocities(&mut self, v: &mut [T]) -> Residual {
        for (v, &change) in v.iter_mut().zip(&self.projection.change) {
            *v += change;
        }
        self.change_rates();
        self.residual(Level::Velocity, v)
    }

    /// The rates of the rows that act, after the velocities have changed as in `projection.change`: they are linear in these.
    fn change_rates(&mut self) {
        self.given = false;
        self.run.empty();
        let Self {
            modes,
            current,
            nodes,
            projection,
            description,
            ..
        } = self;
        let compiled = &modes[*current];
        let rates = compiled.acting.iter().map(|&row| {
            let row = &description.rows[row];
            let read = |place: ValueRef| place.read(&compiled.constants, nodes);
            let terms = row.jacobian.iter();
            let terms = terms.map(|&(j, place)| read(place) * projection.change[j]);
            terms.fold(read(row.velocity), |sum, term| sum + term)
        });
        // All are read before one is written: two rows may have the same rate.
        projection.right.clear();
        projection.right.extend(rates);
        for (&row, &rate) in compiled.acting.iter().zip(&projection.right) {
            if let ValueRef::Node(node) = description.rows[row].velocity {
                nodes[node] = rate;
            }
        }
    }

    fn residual_place(row: &Row, level: Level) -> Option<ValueRef> {
        match level {
            Level::Position => row.position,
            Level::Velocity => Some(row.velocity),
        }
    }

    /// The size of which coordinate `j` is rounded in a state, its positions or its velocities.
    fn size_of(&self, j: usize, state: &[T]) -> f64 {
        state[j].value().abs().max(least_size(&self.sizes, j))
    }

    fn residual(&self, level: Level, state: &[T]) -> Residual {
        let mut worst = Residual::default();
        let compiled = &self.modes[self.current];
        let read = |place: ValueRef| place.read(&compiled.constants, &self.nodes).value();
        for &row in &compiled.acting {
            let terms = &self.description.rows[row];
            let Some(place) = Self::residual_place(terms, level) else {
                continue;
            };
            let value = read(place);
            if value == 0.0 {
                continue;
            }
            let sizes = terms.jacobian.iter();
            let sizes = sizes.map(|&(j, place)| read(place).abs() * self.size_of(j, state));
            let relative = value.abs() / sizes.fold(0.0, f64::max);
            if !(relative <= worst.relative) {
                worst = Residual {
                    relative,
                    row,
                    value,
                };
            }
        }
        worst
    }

    /// The change of the free coordinates that the linearized rows ask for, in `projection.change`; false if there is none.
    fn correction(&mut self, level: Level, held: &[bool]) -> bool {
        let d = self.description();
        let n = d.coordinates.len();
        let is_held = |j: usize| held.get(j).copied().unwrap_or(false);
        let compiled = &self.modes[self.current];
        let constants = &compiled.constants;
        let has_place = |row: &usize| Self::residual_place(&d.rows[*row], level).is_some();
        // As many rows as are held aside follow from the others. But a gap may follow from a friction that sticks, whose row has no position.
        let follow = compiled.acting.iter().all(has_place);
        let following = compiled
            .acting
            .iter()
            .filter(|&&row| follow && compiled.holds_aside(row));
        let following = following.count();
        let rows = compiled.acting.iter().copied();
        let rows = rows.filter_map(|row| Some((row, Self::residual_place(&d.rows[row], level)?)));
        let size = n + rows.clone().count();
        for without_inertia in [false, true] {
            self.projection.right.clear();
            self.projection.right.resize(size, T::zero());
            self.projection.blank.clear();
            self.projection.blank.resize(size * size, T::zero());
            let matrix = self.projector.begin(n, size, &self.projection.blank);
            for &(i, j, place) in d.mass {
                let value = place.read(constants, &self.nodes);
                if !is_held(i) && !is_held(j) {
                    matrix[i * size + j] = value;
                    matrix[j * size + i] = value;
                }
            }
            // Coordinates without inertia of their own: give every one some, any metric projects.
            let typical = (0..n)
                .map(|j| matrix[j * size + j].value().abs())
                .fold(0.0, f64::max);
            for j in 0..n {
                if is_held(j) {
                    matrix[j * size + j] = T::one();
                } else if without_inertia {
                    matrix[j * size + j] +=
                        T::from_f64(if typical > 0.0 { 1e-3 * typical } else { 1.0 });
                }
            }
            for (index, (row, place)) in (n..).zip(rows.clone()) {
                for &(j, place) in d.rows[row].jacobian {
                    if !is_held(j) {
                        let value = place.read(constants, &self.nodes);
                        matrix[index * size + j] = value;
                        matrix[j * size + index] = value;
                    }
                }
                self.projection.right[index] = -place.read(constants, &self.nodes);
            }
            self.work.factorizations += 1;
            let factored = match following {
                0 => self.projector.factor(Inertia::Symmetric, Shares::Any),
                _ => self.projector.factor_dependent(size - n - following),
            };
            if factored.is_ok() {
                self.projection.change.clear();
                self.projection
                    .change
                    .extend_from_slice(&self.projection.right);
                self.projector.solve(&mut self.projection.change);
                self.projection.change.truncate(n);
                return is_finite(&self.projection.change);
            }
        }
        false
    }
}

fn accept<T: Scalar>(residual: Residual) -> Result<(), EvaluationError> {
    if residual.relative <= accepted::<T>() {
        Ok(())
    } else {
        Err(EvaluationError::Projection {
            row: residual.row,
            residual: residual.value,
        })
    }
}
