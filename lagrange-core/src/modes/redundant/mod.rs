//! Forces that the motion does not determine: a table on four legs, a rod that sticks to two supports.
//!
//! With λ₀ of least norm and a basis B of the forces without effect that bounds depend on, all λ₀ + B y move the system in the same way.
//! Contacts and sticking frictions bound them: what they push with, and hold, is not negative, and is inside the friction cones. The shares of
//! least norm within these bounds are a quadratic programme over cones for y. A friction on a constraint is bounded by |λ|, which is two cones,
//! one for each sign of λ: the signs are chosen before.
//!
//! Where no forces keep all bounds there are weights of them, directions in cones included, with which everything open cancels, and
//! whose sum is negative (Farkas): they are the multipliers of the programme that asks for forces which keep all bounds by the largest
//! margin. Such a sum is a [`CompositeGuard`]. It ends a mode where the guards of single forces cannot: both frictions under a rod slip
//! together, where μs (N₁ + N₂) − (F₁ + F₂) falls through zero.

mod bounds;
mod idle;

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, LeastForces};
use crate::linear::{Cone, ConicPoint};
use crate::mode::FrictionMode;
use crate::modes::composite::{CompositeGuard, Part};
use crate::modes::guard::{ConePlane, Guard, stick_guards};
use crate::modes::scale::Sizes;
use crate::system::{Description, Friction, Normal};
use bounds::Bounds;
use idle::Idle;

/// Undetermined forces at one state; the memory is reused.
#[derive(Clone, Debug, Default)]
pub struct RedundantForces<T> {
    least: LeastForces<T>,
    /// Signs of the forces of constraints, for the frictions that they carry.
    signs: Vec<f64>,
    /// Per friction on several constraints, the direction in which they press where it is not that of their least forces.
    directions: Vec<Option<[f64; 3]>>,
    bounds: Bounds<T>,
    /// Forces of frictions that can hold nothing.
    idle: Vec<Idle>,
    sizes: Sizes,
    /// The largest drive so far: loads that are nothing now may be large again.
    largest_drive: f64,
    /// The largest force so far.
    largest_force: f64,
}

/// What rounding leaves of a bound, relative to its size.
const ROUNDING: f64 = 1e-10;

/// Of so many constraints with open forces that carry friction both signs are tried.
const MOST_SIGNS: usize = 8;

/// So often are directions in which constraints press chosen at one state.
const MOST_DIRECTIONS: usize = 32;

/// A smaller weight of a composite guard, relative to the largest, is rounding.
const NO_WEIGHT: f64 = 1e-12;

impl<T: Scalar> RedundantForces<T> {
    /// Forgets what belongs to another motion.
    pub fn restart(&mut self) {
        self.clear();
        self.signs.clear();
        self.directions.clear();
        (self.largest_drive, self.largest_force) = (0.0, 0.0);
    }

    /// Forgets everything: all forces are determined.
    pub fn clear(&mut self) {
        self.bounds.clear();
        self.idle.clear();
        self.least.forces.clear();
    }

    /// Looks at the last value of `dynamics`, and chooses the signs of constraint forces that carry friction.
    pub fn look(&mut self, dynamics: &mut Dynamics<T>) {
        if self.take_least(dynamics) {
            self.take_signs(dynamics);
        }
    }

    /// The same with the signs that were chosen last: that they hold no longer ends a mode.
    pub fn follow(&mut self, dynamics: &mut Dynamics<T>) {
        if self.signs.len() != dynamics.description().constraints.len() {
            self.look(dynamics);
        } else if self.take_least(dynamics) {
            self.list_bounds(dynamics);
        }
    }

    /// Takes the forces of least norm, if any are undetermined.
    fn take_least(&mut self, dynamics: &mut Dynamics<T>) -> bool {
        self.clear();
        if !dynamics.has_dependent_rows() {
            return false;
        }
        self.least = dynamics.least_norm_of_acting();
        dynamics.complete_outputs();
        self.choose_idle(dynamics);
        self.sizes.take(dynamics);
        self.largest_drive = self.largest_drive.max(self.sizes.drive);
        self.sizes.drive = self.largest_drive;
        true
    }

    /// Chooses the signs of constraint forces and lists the bounds that hold with them: signs with which admissible forces exist, of these
    /// those of the least forces.
    fn take_signs(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let index = |i: usize| acting.binary_search(&d.constraints[i].row).ok();
        let known = |i: usize| self.signs.get(i).copied().unwrap_or(1.0);
        let of_least = |i: usize| match index(i) {
            Some(k) => self.sign_of_least(k).unwrap_or_else(|| known(i)),
            None => 1.0,
        };
        self.signs = (0..d.constraints.len()).map(of_least).collect();
        self.directions.clear();
        self.directions.resize(d.frictions.len(), None);
        self.list_bounds(dynamics);
        if !self.has_open() || self.bounds.forces.least(&self.bounds.forces.values) >= 0.0 {
            return;
        }
        let choices = self.choices_of_signs(dynamics);
        if choices.len() == 1 {
            self.press_otherwise(dynamics, -ROUNDING);
            return;
        }
        let mut best = (f64::INFINITY, f64::INFINITY, self.signs.clone());
        for signs in choices {
            self.signs = signs;
            self.list_bounds(dynamics);
            let missing = -self.bounds.forces.widest_margin();
            let missing = if missing > ROUNDING { missing } else { 0.0 };
            let change = self.bounds.forces.change(0.0);
            if (missing, change) < (best.0, best.1) {
                best = (missing, change, self.signs.clone());
            }
        }
        self.signs = best.2;
        self.list_bounds(dynamics);
        self.press_otherwise(dynamics, -ROUNDING);
    }

    /// Constraints that press a friction together press at least what their forces are in any direction: chooses the directions of forces that are nearest to
    /// the bounds, again and again, until forces keep all bounds by more than the `border` or come no nearer. Whether they do.
    fn press_otherwise(&mut self, dynamics: &Dynamics<T>, border: f64) -> bool {
        let d = dynamics.description();
        let by_several = |(f, friction): &(usize, &Friction)| {
            let mut own = stick_guards(*f, friction);
            matches!(friction.normal, Normal::Resultant(_)) && own.any(|guard| self.is_open(guard))
        };
        let frictions = d.frictions.iter().enumerate().filter(by_several);
        let pressed: Vec<usize> = frictions.map(|(f, _)| f).collect();
        if pressed.is_empty() {
            return false;
        }
        let mut margin = self.bounds.forces.widest_margin();
        for _ in 0..MOST_DIRECTIONS {
            if margin > border {
                break;
            }
            let before = self.directions.clone();
            let forces = self.within_bounds();
            let acting = dynamics.acting_rows();
            for &f in &pressed {
                let rows = d.frictions[f].normal.rows(d);
                let mut direction = [0.0; 3];
                for (part, row) in direction.iter_mut().zip(rows) {
                    *part = acting
                        .binary_search(&row)
                        .map_or(0.0, |i| forces[i].value());
                }
                let size = direction
                    .iter()
                    .fold(0.0, |size: f64, part| size.hypot(*part));
                self.directions[f] = (size > 0.0).then(|| direction.map(|part| part / size));
            }
            self.list_bounds(dynamics);
            let next = self.bounds.forces.widest_margin();
            if !(next > margin) {
                self.directions = before;
                self.list_bounds(dynamics);
                break;
            }
            margin = next;
        }
        margin > border
    }

    /// The sign of a force of least norm, unless it vanishes beside the others.
    fn sign_of_least(&self, k: usize) -> Option<f64> {
        let forces = &self.least.forces;
        let size = |force: &T| force.value().abs();
        let largest = forces.iter().map(size).fold(0.0, f64::max);
        let force = forces[k].value();
        (force.abs() > ROUNDING * largest).then(|| force.signum())
    }

    /// Chooses the signs of constraint forces as [`Self::look`] does at the last value of `dynamics`, a little after the instant; whether they are others.
    pub fn take_signs_of_later(&mut self, dynamics: &mut Dynamics<T>) -> bool {
        let (signs, directions) = (self.signs.clone(), self.directions.clone());
        self.look(dynamics);
        self.directions = directions;
        self.signs != signs
    }

    /// Takes the signs that a decision has found for constraint forces which vanish at its instant.
    pub fn take_signs_of(&mut self, composites: &[CompositeGuard], d: &Description) {
        self.signs.resize(d.constraints.len(), 1.0);
        for part in composites.iter().flat_map(|composite| &composite.parts) {
            if let (Guard::StickCone(f), Some(plane)) = (part.guard, part.plane)
                && let Normal::Constraint(on) = d.frictions[f].normal
            {
                self.signs[on] = plane.pressing[0];
            }
        }
    }

    /// Where the signs chosen last end: chooses others that allow forces by more than the `border`, of these those of the least forces. False: there
    /// are none.
    pub fn turn(&mut self, dynamics: &mut Dynamics<T>, border: f64) -> bool {
        if !self.take_least(dynamics) {
            return false;
        }
        let present = self.signs.clone();
        let mut best: Option<(f64, Vec<f64>)> = None;
        for signs in self.choices_of_signs(dynamics) {
            if signs == present {
                continue;
            }
            self.signs = signs;
            self.list_bounds(dynamics);
            if self.bounds.forces.widest_margin() > border {
                let change = self.bounds.forces.change(0.0);
                if best.as_ref().is_none_or(|(least, _)| change < *least) {
                    best = Some((change, self.signs.clone()));
                }
            }
        }
        let turns = best.is_some();
        self.signs = best.map_or(present, |(_, signs)| signs);
        self.list_bounds(dynamics);
        turns || self.press_otherwise(dynamics, border)
    }

    /// The present signs, and all others of constraints whose forces are open and carry frictions that stick.
    fn choices_of_signs(&self, dynamics: &Dynamics<T>) -> Vec<Vec<f64>> {
        let d = dynamics.description();
        let is_open = |i: &usize| {
            let sticks = |(f, friction): (usize, &Friction)| {
                matches!(friction.normal, Normal::Constraint(on) if on == *i)
                    && dynamics.mode().frictions[f] == FrictionMode::Stick
            };
            self.leaves_open(dynamics, d.constraints[*i].row)
                && d.frictions.iter().enumerate().any(sticks)
        };
        let open: Vec<usize> = (0..self.signs.len())
            .filter(is_open)
            .take(MOST_SIGNS)
            .collect();
        let choose = |choice: usize| {
            let mut signs = self.signs.clone();
            for (k, &i) in open.iter().enumerate() {
                if choice >> k & 1 == 1 {
                    signs[i] = -signs[i];
                }
            }
            signs
        };
        (0..1_usize << open.len()).map(choose).collect()
    }

    /// Whether a guard concerns forces that are not determined, so that by itself it decides nothing.
    pub fn is_open(&self, guard: Guard) -> bool {
        self.bounds.list.iter().any(|bound| bound.guard == guard)
            || self.idle.iter().any(|idle| idle.has(guard))
    }

    /// Whether any guard does.
    pub fn has_open(&self) -> bool {
        !self.bounds.list.is_empty()
    }

    /// By how much the sizes that composite guards are relative to are more than those of the last value of `dynamics`.
    pub fn raised(&mut self, dynamics: &mut Dynamics<T>) -> f64 {
        dynamics.complete_outputs();
        self.sizes.take(dynamics);
        self.largest_drive / self.sizes.drive
    }

    /// The largest force so far, of which one has now this `size`.
    pub fn largest_force(&mut self, size: f64) -> f64 {
        self.largest_force = self.largest_force.max(size);
        self.largest_force
    }

    /// The composite guard that forbids the mode, or comes nearer to that than `margin` (relative): of all the smallest.
    pub fn critical(&self, margin: f64) -> Option<CompositeGuard> {
        self.nearest(margin).1
    }

    /// The same, and the widest margin by which forces keep all bounds, or `margin` if that is less.
    pub fn nearest(&self, margin: f64) -> (f64, Option<CompositeGuard>) {
        self.smallest(&self.bounds.forces.values, margin)
    }

    /// The values of all bounds, relative to their sizes.
    pub fn values(&self) -> &[f64] {
        &self.bounds.forces.values
    }

    /// What each friction with a cone can hold, relative to the size of that, in the directions in which constraints press it.
    pub fn holds(&self) -> Vec<[f64; 3]> {
        let forces = &self.bounds.forces;
        let cones = self.bounds.list.iter().zip(&forces.cones);
        let holds = cones.filter_map(|(bound, cone)| match *cone {
            Cone::Ray(_) => None,
            Cone::SecondOrder(limit) => Some(bound.pressed_by(forces.values[limit])),
        });
        holds.collect()
    }

    /// The same for guards with other values than those looked at, and the same rows.
    pub fn critical_at(
        &self,
        mut value: impl FnMut(Guard, Option<ConePlane>) -> f64,
    ) -> Option<CompositeGuard> {
        let forces = &self.bounds.forces;
        let mut values = Vec::with_capacity(forces.values.len());
        let changes = self.without_idle(&mut value);
        for ((bound, cone), size) in self
            .bounds
            .list
            .iter()
            .zip(&forces.cones)
            .zip(&forces.sizes)
        {
            match cone {
                Cone::Ray(_) => values.push(value(bound.guard, None) / size),
                Cone::SecondOrder(_) => {
                    let mut side = |along| value(bound.guard, Some(bound.plane(along))) / size;
                    let [east, west] = [1.0, -1.0].map(|x| side([x, 0.0]));
                    let [north, south] = [1.0, -1.0].map(|y| side([0.0, y]));
                    values.extend([east + west, west - east, south - north].map(|x| 0.5 * x));
                }
            }
        }
        for (cone, size) in forces.cones.iter().zip(&forces.sizes) {
            for row in cone.rows() {
                let terms = forces.terms[row].iter();
                values[row] += terms.map(|&(i, a)| a * changes[i]).sum::<f64>() / size;
            }
        }
        self.smallest(&values, -ROUNDING).1
    }

    /// The widest margin by which forces keep bounds with these `values`, up to `margin`, and the composite guard that tells of it. What frictions can hold is
    /// not negative: a guard that says only how much that is tells nothing.
    fn smallest(&self, values: &[f64], margin: f64) -> (f64, Option<CompositeGuard>) {
        // Those of least norm may do.
        let forces = &self.bounds.forces;
        if !self.has_open() || forces.least(values) >= margin {
            return (margin, None);
        }
        let ConicPoint { x, z } = forces.widest(values, margin);
        let weights = forces.cones.iter().map(|cone| z[cone.first()]);
        // The rest is the weight of the margin asked for.
        let sum: f64 = weights.clone().sum();
        let value: f64 = values.iter().zip(&z).map(|(x, z)| x * z).sum();
        if !(sum > 0.5 && value < margin * sum) {
            return (margin, None);
        }
        let largest = weights.fold(0.0, f64::max);
        let slacks = forces.slacks(values, &x);
        let list = self
            .bounds
            .list
            .iter()
            .zip(forces.cones.iter().zip(&forces.sizes));
        // Of a weight and a slack one is zero.
        let weighs = |cone: &Cone, slack: f64| z[cone.first()] > slack.max(NO_WEIGHT * largest);
        let parts = list.zip(slacks);
        let parts = parts.filter(|((_, (cone, _)), slack)| weighs(cone, *slack));
        let mut factors = vec![0.0; self.least.forces.len()];
        let parts = parts.map(|((bound, (cone, size)), _)| {
            let weight = z[cone.first()];
            for row in cone.rows() {
                for &(i, factor) in &forces.terms[row] {
                    factors[i] += z[row] * factor / (sum * size);
                }
            }
            let along = |i: usize| [i + 1, i + 2].map(|i| -z[i] / weight);
            Part {
                guard: bound.guard,
                plane: match *cone {
                    Cone::Ray(_) => None,
                    Cone::SecondOrder(i) => Some(bound.plane(along(i))),
                },
                weight: weight / (sum * size),
            }
        });
        let mut parts: Vec<Part> = parts.collect();
        parts.extend(self.parts_of_idle(factors));
        let composite = CompositeGuard {
            parts,
            falls_after: None,
        };
        let tells = !composite.is_of_limits();
        (value / sum, tells.then_some(composite))
    }

    /// Whether bounds keep forces from being those of least norm, where one of these is the load of a friction that slips.
    pub fn bend_loads_of_slips(&self, dynamics: &Dynamics<T>) -> bool {
        let forces = &self.bounds.forces;
        let (d, mode) = (dynamics.description(), dynamics.mode());
        let slips = |&f: &usize| matches!(mode.frictions[f], FrictionMode::Slip(_));
        let open =
            |f: usize| (d.frictions[f].normal.rows(d)).any(|row| self.leaves_open(dynamics, row));
        self.has_open()
            && forces.least(&forces.values) < -ROUNDING
            && (0..d.frictions.len()).filter(slips).any(open)
    }

    /// Whether the force of this row acts, and the motion does not determine it.
    fn leaves_open(&self, dynamics: &Dynamics<T>, row: usize) -> bool {
        let force = dynamics.acting_rows().binary_search(&row);
        force.is_ok_and(|i| !self.least.freedom.is_determined(i))
    }

    /// The forces of all rows at the last value of `dynamics`, and which of them are undetermined (nothing where all are
    /// determined).
    pub fn report(&mut self, dynamics: &mut Dynamics<T>, undetermined: &mut Vec<bool>) -> Vec<T> {
        undetermined.clear();
        self.look(dynamics);
        if dynamics.has_dependent_rows() {
            self.undetermined(dynamics, undetermined);
        }
        self.forces(dynamics)
    }

    /// The forces of all rows as last looked at: those of least norm within the bounds, or as near to that as any are.
    pub fn forces(&self, dynamics: &Dynamics<T>) -> Vec<T> {
        if self.least.forces.is_empty() {
            let rows = 0..dynamics.description().rows.len();
            return rows.map(|row| dynamics.force(row)).collect();
        }
        if !self.has_open() {
            return dynamics.forces_of_acting(&self.least.forces);
        }
        dynamics.forces_of_acting(&self.within_bounds())
    }

    /// The forces that act, of least norm within the bounds, or as near to that as any are.
    fn within_bounds(&self) -> Vec<T> {
        match self.bounds.forces.shares(0.0) {
            Some(changes) => self.least.changed(changes.as_slice()),
            None => self.least.forces.clone(),
        }
    }

    /// Forces of all rows that move the system in the same way as those last looked at, and are others wherever they are undetermined.
    pub fn otherwise(&self, dynamics: &Dynamics<T>) -> Vec<T> {
        let size = |force: &T| force.value().abs();
        let largest = self.least.forces.iter().map(size).fold(0.0, f64::max);
        let size = if largest > 0.0 { largest } else { 1.0 };
        // Of no two forces the same part.
        let count = self.least.forces.len();
        let parts: Vec<(usize, T)> = (0..count)
            .map(|i| (i, T::from_f64(size / (1.0 + (i as f64).sqrt()))))
            .collect();
        let changes = self.least.freedom.part(&parts);
        dynamics.forces_of_acting(&self.least.changed(changes.as_slice()))
    }

    /// Whether the force of each row is undetermined.
    fn undetermined(&self, dynamics: &Dynamics<T>, out: &mut Vec<bool>) {
        let d = dynamics.description();
        out.clear();
        out.resize(d.rows.len(), false);
        if self.least.forces.is_empty() {
            return;
        }
        for (i, &row) in dynamics.acting_rows().iter().enumerate() {
            out[row] = !self.least.freedom.is_determined(i);
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            if let FrictionMode::Slip(_) = dynamics.mode().frictions[f] {
                let open = friction.normal.rows(d).any(|source| out[source]);
                out[friction.rows()].fill(open);
            }
        }
    }
}
