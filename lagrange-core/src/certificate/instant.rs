//! One instant: the balance of forces, constraints, contacts and frictions as the mode demands.

use super::equations::{Equations, Level, Situation};
use super::{Findings, Subject};
use crate::effects::Item;
use crate::mode::{Direction, FrictionMode, Mode};

/// Beside its reach a slip in space has no direction below this multiple of the tolerance.
const VANISHING: f64 = 1e3;

/// What the run reports of an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reported {
    pub kinetic: f64,
    pub potential: f64,
    /// v·∂L/∂v − L
    pub jacobi: f64,
}

impl Equations {
    /// Checks a state with the reported accelerations and forces. `passed` says of which contacts the motion has passed beyond
    /// the surface outside their region.
    pub fn examine(
        &mut self,
        at: Situation<'_>,
        mode: &Mode,
        reported: Reported,
        passed: &mut [bool],
        findings: &mut Findings,
    ) {
        self.balance_at(at, mode);
        let d = self.d;
        for (i, coordinate) in d.coordinates.iter().enumerate() {
            let (error, size) = (self.residual[i].abs(), self.size[i]);
            findings.book(Subject::Equations, error, size, at.time, coordinate.name);
        }
        self.examine_positions(at, mode, passed, findings);
        self.examine_constraints(at, mode, findings);
        self.examine_contacts(at, mode, findings);
        self.examine_frictions(at, mode, findings);
        self.examine_energies(at, reported, findings);
    }

    fn examine_energies(&mut self, at: Situation<'_>, reported: Reported, findings: &mut Findings) {
        let name = self.d.name;
        let (jacobi, size) = self.jacobi(at);
        let error = (reported.jacobi - jacobi).abs();
        findings.book(Subject::Energies, error, size, at.time, name);
        // A Lagrangian does not say which of its terms are kinetic.
        if self.d.inertia.is_none() {
            return;
        }
        for (potential, reported) in [(false, reported.kinetic), (true, reported.potential)] {
            let declared = self.energy(potential);
            let error = (reported - declared).abs();
            findings.book(Subject::Energies, error, size, at.time, name);
        }
    }

    /// Constraints of position level and gaps with their rates, in the state taken.
    pub fn examine_positions(
        &mut self,
        at: Situation<'_>,
        mode: &Mode,
        passed: &mut [bool],
        findings: &mut Findings,
    ) {
        let d = self.d;
        for (i, &value) in self.declaration.constraints.iter().enumerate() {
            if self.constraint_acts(i, mode) {
                let levels = match self.level(i) {
                    Level::Position => 2,
                    Level::Velocity => 1,
                };
                for power in 0..levels {
                    let error = self.values.coefficient(value, power).abs();
                    let reach = self.reach(value, power, at);
                    let name = d.constraints[i].name;
                    findings.book(Subject::Constraints, error, reach, at.time, name);
                }
            }
        }
        for (c, contact) in self.declaration.contacts.iter().enumerate() {
            if !self.includes(Item::Contact(c)) {
                continue;
            }
            let name = d.contacts[c].name;
            let gap = self.values.value(contact.gap);
            let wanting = mode.contacts[c] || gap < 0.0;
            let reach = if wanting {
                self.reach(contact.gap, 0, at)
            } else {
                1.0
            };
            if mode.contacts[c] {
                findings.book(Subject::Closed, gap.abs(), reach, at.time, name);
                let (rate, reach) = (
                    self.values.rate(contact.gap),
                    self.reach(contact.gap, 1, at),
                );
                findings.book(Subject::Closed, rate.abs(), reach, at.time, name);
                continue;
            }
            passed[c] = self.has_passed(c, gap, passed[c]);
            if !passed[c] {
                findings.book(Subject::Gaps, -gap, reach, at.time, name);
            }
        }
    }

    /// Whether the motion is beyond the surface of contact `c`, which it has passed outside the contact's region, now or `before`.
    pub fn has_passed(&self, c: usize, gap: f64, before: bool) -> bool {
        let region = self.declaration.contacts[c].region;
        let outside = region.is_some_and(|region| self.values.value(region) < 0.0);
        gap < 0.0 && (before || outside)
    }

    fn examine_constraints(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        for (i, &value) in self.declaration.constraints.iter().enumerate() {
            let row = self.d.constraints[i].row;
            let name = self.d.constraints[i].name;
            if self.constraint_acts(i, mode) {
                let (error, size) = self.acceleration(value, self.level(i), at);
                findings.book(Subject::Rows, error.abs(), size, at.time, name);
            } else {
                findings.book(Subject::Idle, at.forces[row].abs(), 1.0, at.time, name);
            }
        }
    }

    fn examine_contacts(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        for (c, contact) in self.declaration.contacts.iter().enumerate() {
            let (force, name) = (at.forces[self.d.contacts[c].row], self.d.contacts[c].name);
            if !(self.includes(Item::Contact(c)) && mode.contacts[c]) {
                findings.book(Subject::Idle, force.abs(), 1.0, at.time, name);
                continue;
            }
            let size = self.force_along(contact.gap, Level::Position);
            findings.book(Subject::NormalForces, -force, size, at.time, name);
            let (error, size) = self.acceleration(contact.gap, Level::Position, at);
            findings.book(Subject::Rows, error.abs(), size, at.time, name);
        }
    }

    fn examine_frictions(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        for (f, friction) in self.declaration.frictions.iter().enumerate() {
            let (first, name) = (self.d.frictions[f].row, self.d.frictions[f].name);
            let force = &at.forces[first..first + friction.slip.len()];
            let (normal, normal_size) = self.normal(f, at.forces);
            if !self.friction_acts(f, mode) {
                findings.book(Subject::Idle, length(force), 1.0, at.time, name);
                if self.includes(Item::Friction(f)) && self.is_pressed(f, mode) {
                    let mu = self.values.value(friction.kinetic_coefficient);
                    let (missing, size) = (mu * normal, mu * normal_size);
                    findings.book(Subject::Sliding, missing, size, at.time, name);
                }
                continue;
            }
            let mut size = 0.0_f64;
            let mut reach = 0.0_f64;
            let mut slip = [0.0; 2];
            for (k, &value) in friction.slip.iter().enumerate() {
                size = size.max(self.force_along(value, Level::Velocity));
                reach = reach.max(self.reach(value, 0, at));
                slip[k] = self.values.value(value);
            }
            let slip = &slip[..friction.slip.len()];
            match mode.frictions[f] {
                FrictionMode::Inactive => {}
                FrictionMode::Stick => {
                    let mu = self.values.value(friction.static_coefficient);
                    let excess = length(force) - mu * normal;
                    let size = size + mu * normal_size;
                    findings.book(Subject::Cones, excess, size, at.time, name);
                    findings.book(Subject::Slips, length(slip), reach, at.time, name);
                    for &value in friction.slip {
                        let (error, size) = self.acceleration(value, Level::Velocity, at);
                        findings.book(Subject::Rows, error.abs(), size, at.time, name);
                    }
                }
                FrictionMode::Slip(sliding) => {
                    let mu = self.values.value(friction.kinetic_coefficient);
                    let speed = length(slip);
                    let along = match sliding.direction {
                        Direction::Fixed(along) => {
                            let slip =
                                slip[0] * along[0] + slip.get(1).map_or(0.0, |s| s * along[1]);
                            findings.book(Subject::Slips, -slip, reach, at.time, name);
                            along
                        }
                        _ if speed > VANISHING * findings.tolerance * reach => {
                            [slip[0] / speed, slip.get(1).map_or(0.0, |s| s / speed)]
                        }
                        // A slip that vanishes has no direction; its force still has a size.
                        _ => {
                            let whole = length(force);
                            [-force[0] / whole, force.get(1).map_or(0.0, |f| -f / whole)]
                        }
                    };
                    let error = force
                        .iter()
                        .zip(along)
                        .map(|(f, e)| (f + mu * normal * e).abs());
                    let size = size + mu * normal_size;
                    let error = error.fold(0.0, f64::max);
                    findings.book(Subject::Sliding, error, size, at.time, name);
                }
            }
        }
    }
}

/// √Σx²
pub(super) fn length(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))
}
