//! Undetermined forces along a run: which guards decide, and what is reported.
//!
//! Guards of single undetermined forces mean nothing; in their place stand joint guards, found where a step ends in a state
//! that no admissible forces allow. The root of such a guard is the end of the mode. Where the dependence of the rows
//! changes along the motion, the weights of the guard are taken again at its root until both agree.

use super::Run;
use super::hits::Hit;
use crate::arithmetic::Scalar;
use crate::modes::guard::Guard;
use crate::modes::reading::Reading;
use crate::modes::sharing::{self, Joint};

/// A joint guard above this (relative) is not about to fall.
const BORDER: f64 = 1e-3;

/// So far may the root of a joint guard be from the border, relative: beyond, its weights were those of another state.
const ROOT: f64 = 1e-9;

/// So often are the joint guards of one step found anew.
const MOST_CORRECTIONS: usize = 12;

/// Joint guards are also looked for at these parts of a step,
const WITHIN: [f64; 3] = [0.25, 0.5, 0.75];

/// and watched from there on if they have come this near to zero, relative.
const NEARBY: f64 = 0.5;

impl<T: Scalar> Run<T> {
    /// Looks at the forces at the last value of the dynamics, in the mode of the run.
    pub(super) fn look_at_shares(&mut self) {
        let was_open = self.switcher.sharing.has_open();
        self.switcher.sharing.look(&self.dynamics);
        if was_open || self.switcher.sharing.has_open() {
            self.list_guards();
        }
    }

    /// After a switch: guards, and the forces to be logged.
    pub(super) fn note_shares(&mut self) {
        let mut forces = core::mem::take(&mut self.recorder.forces_after);
        let mut undetermined = core::mem::take(&mut self.recorder.undetermined_after);
        self.reported_forces(&mut forces, &mut undetermined);
        (self.recorder.forces_after, self.recorder.undetermined_after) = (forces, undetermined);
        self.list_guards();
    }

    /// The guards that decide.
    fn list_guards(&mut self) {
        let watched = self.switcher.table.of(&self.dynamics);
        let sharing = &self.switcher.sharing;
        let single = watched.guards.iter().copied();
        let single = single.filter(|&guard| !sharing.is_open(guard));
        let curves = &mut self.locator.curves;
        curves.arm(single, &self.now.mode, &self.dynamics);
    }

    /// At part `looked` of a step, its end or just before it, which the dynamics have evaluated, after `corrections` others:
    /// whether joint guards must be looked at again, because that state allows no forces, because one before it does not or
    /// comes near to it, or because the root of one was none.
    pub(super) fn corrects_joints(
        &mut self,
        hit: &Hit,
        looked: f64,
        corrections: &mut usize,
    ) -> bool {
        if !self.dynamics.has_dependent_rows() && !self.switcher.sharing.has_open() {
            return false;
        }
        self.look_at_shares();
        if *corrections == MOST_CORRECTIONS {
            return false;
        }
        let critical = self.switcher.sharing.critical(BORDER);
        let value = critical.as_ref().map(|joint| self.joint_value(joint));
        if self.switcher.sharing.has_open() && self.finds_joints_within(looked) {
            *corrections += 1;
            return true;
        }
        let fallen = self
            .locator
            .fallen
            .iter()
            .find_map(|guard| match (hit, guard) {
                (Hit::Guards(_), Guard::Joint(k)) => Some(*k),
                _ => None,
            });
        match (fallen, critical, value) {
            (None, Some(joint), Some(value)) if value < -ROOT => {
                self.locator.curves.joints.push(joint)
            }
            (Some(_), Some(_), Some(value)) if value.abs() <= ROOT => return false,
            (Some(k), Some(joint), Some(_)) => self.locator.curves.joints[k] = joint,
            (Some(k), ..) => _ = self.locator.curves.joints.remove(k),
            _ => return false,
        }
        *corrections += 1;
        self.list_guards();
        true
    }

    /// Looks for joint guards at some instants before part `end` of the step, where `dynamics` and `scratch` end again: whether
    /// there are new ones, or known ones are below zero with weights that are new.
    fn finds_joints_within(&mut self, end: f64) -> bool {
        let mut found = false;
        for part in WITHIN {
            if self.evaluate_end(part * end).is_err() {
                continue;
            }
            self.switcher.sharing.look(&self.dynamics);
            let Some(joint) = self.switcher.sharing.critical(NEARBY) else {
                continue;
            };
            let mut known = self.locator.curves.joints.iter();
            match known.position(|known| known.is_like(&joint)) {
                None => {
                    self.locator.curves.joints.push(joint);
                    found = true;
                }
                Some(k) => {
                    let falls = self.joint_value(&joint) < -ROOT;
                    found |= falls && self.joint_value(&self.locator.curves.joints[k]) >= -ROOT;
                    self.locator.curves.joints[k] = joint;
                }
            }
        }
        // What could be evaluated before.
        _ = self.evaluate_end(end);
        self.look_at_shares();
        found
    }

    /// The forces of all rows at the last value of the dynamics, to be reported; and which are undetermined (none: all
    /// are determined).
    pub(super) fn reported_forces(&mut self, forces: &mut Vec<T>, undetermined: &mut Vec<bool>) {
        if self.dynamics.has_dependent_rows() {
            *forces = self.switcher.sharing.report(&self.dynamics, undetermined);
        } else {
            undetermined.clear();
            forces.clear();
            let rows = 0..self.description().rows.len();
            forces.extend(rows.map(|row| self.dynamics.force(row)));
        }
        if self.is_undecided() {
            undetermined.clear();
            undetermined.resize(forces.len(), false);
            for &row in self.dynamics.acting_rows() {
                undetermined[row] = true;
            }
        }
    }

    /// How far a joint guard is from the zero that it was located as.
    pub(super) fn joint_residue(&self, joint: &Joint) -> f64 {
        self.joint_value(joint).abs()
    }

    /// A joint guard at the last value of the dynamics.
    fn joint_value(&self, joint: &Joint) -> f64 {
        let joints = core::slice::from_ref(joint);
        let reading = Reading::Values(&self.dynamics);
        sharing::value(Guard::Joint(0), joints, &self.now.mode, &reading)
    }
}
