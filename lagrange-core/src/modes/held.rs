//! Branches that a mode holds at their border: the guard of `if(y <= 0, …)` is zero as long as the floor y ≥ 0 carries.
//!
//! Such a guard is zero wherever the rows that act let the motion be, and what rounding and the tolerance leave of it says nothing: the
//! branch is the one that is declared for equality. States beside the present one that are moved back onto these rows tell it from
//! a guard that only happens to vanish.

use crate::arithmetic::{GOLDEN, Scalar, uneven};
use crate::dynamics::{Dynamics, OutputMask};
use crate::modes::facts::EvaluationPoint;

/// States are this far beside, relative above 1.
const BESIDE: f64 = 1e-4;
/// A guard that is held keeps less than this share of what it is beside the rows. What only touches zero there keeps [`BESIDE`].
const KEPT: f64 = 1e-7;
/// A guard that is not smaller than this share of what it is beside is not looked at.
const SMALL: f64 = 1e-2;
/// Irrational steps by which time and all coordinates and velocities are moved by different parts in the two directions in which states are looked
/// at: no two of them move alike, however many there are.
const STEPS: [f64; 2] = [GOLDEN, 0.414_213_562_373_095];

/// Which branches are held, with the memory to find out.
#[derive(Clone, Debug, Default)]
pub struct HeldBranches<T> {
    held: Vec<bool>,
    /// Of these, those whose guards read no velocities.
    of_positions: Vec<bool>,
    /// Sizes of the guards where they are looked at, and beside the rows.
    here: Vec<f64>,
    beside: Vec<f64>,
    q: Vec<T>,
    v: Vec<T>,
}

/// The conditions of all branches by the numbers that `dynamics` holds; 0 for those that are told with the outputs only.
pub fn conditions<T: Scalar>(dynamics: &Dynamics<T>) -> impl Iterator<Item = f64> + '_ {
    let branches = dynamics.description().branches.iter();
    branches.map(|branch| match branch.after_solve {
        true => 0.0,
        false => dynamics.motion(branch.guard).value(),
    })
}

impl<T: Scalar> HeldBranches<T> {
    /// Per branch.
    pub fn held(&self) -> &[bool] {
        &self.held
    }

    /// Per branch: whether it is held and its guard reads no velocities, so that its rate vanishes too.
    pub fn of_positions(&self) -> &[bool] {
        &self.of_positions
    }

    /// None is known to be held.
    pub fn clear(&mut self) {
        self.held.clear();
    }

    /// Finds the branches that the mode of `dynamics` holds; `needs` are what all guards read.
    pub fn look(
        &mut self,
        dynamics: &mut Dynamics<T>,
        needs: &OutputMask,
        at: EvaluationPoint<'_, T>,
    ) {
        let branches = dynamics.description().branches;
        self.held.clear();
        self.held
            .extend(branches.iter().map(|branch| !branch.after_solve));
        self.of_positions.clear();
        self.of_positions.resize(branches.len(), false);
        for step in STEPS {
            if dynamics.acting_rows().is_empty() {
                self.held.fill(false);
            }
            if !self.held.contains(&true) {
                return;
            }
            self.look_along(dynamics, needs, at, step);
        }
    }

    /// Keeps those that are held beside the present state in the direction of a step.
    fn look_along(
        &mut self,
        dynamics: &mut Dynamics<T>,
        needs: &OutputMask,
        at: EvaluationPoint<'_, T>,
        step: f64,
    ) {
        let mut moved = 0;
        let mut beside = |x: &T| {
            moved += 1;
            let part = BESIDE * uneven(moved, step);
            *x + T::from_f64(part * x.value().abs().max(1.0))
        };
        let t = beside(&at.t);
        self.q.clear();
        self.q.extend(at.q.iter().map(&mut beside));
        self.v.clear();
        self.v.extend(at.v.iter().map(&mut beside));
        let sizes = |dynamics: &Dynamics<T>, to: &mut Vec<f64>| {
            to.clear();
            to.extend(conditions(dynamics).map(f64::abs));
        };
        dynamics.set_extra_needs(needs);
        dynamics.tape(t, &self.q, &self.v);
        sizes(dynamics, &mut self.beside);
        dynamics.tape(at.t, at.q, at.v);
        sizes(dynamics, &mut self.here);
        for (b, held) in self.held.iter_mut().enumerate() {
            // What vanishes beside the rows as well is not held by them, as max(0, u) while u = if(t <= t1, 0, F) is 0: it jumps or grows with u.
            *held &= self.here[b] < SMALL * self.beside[b];
        }
        if !self.held.contains(&true) {
            return;
        }
        if dynamics.project(t, &mut self.q, &mut self.v, 0.0).is_err() {
            return self.held.fill(false);
        }
        dynamics.set_extra_needs(needs);
        dynamics.tape(t, &self.q, &self.v);
        sizes(dynamics, &mut self.here);
        for (b, held) in self.held.iter_mut().enumerate() {
            *held &= self.here[b] <= KEPT * self.beside[b];
        }
        self.v.clear();
        self.v.extend(at.v.iter().map(&mut beside));
        dynamics.tape(t, &self.q, &self.v);
        sizes(dynamics, &mut self.here);
        for (b, of_positions) in self.of_positions.iter_mut().enumerate() {
            *of_positions = self.held[b] && self.here[b] <= KEPT * self.beside[b];
        }
    }
}
