//! One instant: the balance of forces, constraints, contacts and frictions as the mode demands.

use super::equations::{Equations, Situation, Zero};
use super::{Findings, MARGIN, Subject, beyond};
use crate::effects::Item;
use crate::error::Level;
use crate::mode::{Direction, FrictionMode, Mode};
use crate::trajectory::State;

/// Shares of forces that are not determined keep their bounds to this, relative.
const SHARED: f64 = 1e-9;
/// Such shares cancel in the balance of forces to this, relative.
const OF_SHARES: f64 = 1e-11;

/// Beside its reach a slip in space has no direction below this multiple of the tolerance.
const VANISHING: f64 = 1e3;

/// Energies that the run reports of an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Energies {
    pub kinetic: f64,
    pub potential: f64,
    /// v·∂L/∂v − L
    pub jacobi: f64,
}

impl Equations {
    /// Choices whose conditions vanish to within the tolerance take the side on which the state balances best. A force may jump at the surface of a contact
    /// that is closed; of one that has just opened the state may be on either side, and so it may be between two events of one instant.
    fn take_sides(&mut self, at: Situation<'_>, mode: &Mode, tolerance: f64) {
        let opens = self.gap_that_opens(at, mode, tolerance);
        let sides = [
            Some(Zero::AsDeclared),
            opens.map(Zero::AsGapOpens),
            Some(Zero::Below),
        ];
        let (mut best, mut least) = (None, self.imbalance());
        for side in sides.into_iter().flatten() {
            self.take_what_vanishes(side, at, tolerance);
            self.balance(at);
            if self.imbalance() < least {
                (best, least) = (Some(side), self.imbalance());
            }
            if !self.is_beyond() {
                return;
            }
        }
        match best {
            Some(side) => self.take_what_vanishes(side, at, tolerance),
            None => self.take_all_as_it_is(),
        }
        self.balance(at);
    }

    /// Checks whether a state with the reported accelerations and forces balances, and its energies; remembers how large the forces are.
    pub fn examine_balance(
        &mut self,
        at: Situation<'_>,
        mode: &Mode,
        reported: Energies,
        findings: &mut Findings,
    ) {
        self.balance(at);
        for (largest, size) in self.largest.iter_mut().zip(&self.size) {
            *largest = largest.max(*size);
        }
        if self.is_beyond() {
            self.take_sides(at, mode, MARGIN * findings.tolerance);
        }
        self.examine_energies(at, reported, findings);
        if self.is_beyond() {
            self.balance_with_sizes(at, mode);
        }
        self.take_all_as_it_is();
        let shared = if at.shared { OF_SHARES } else { 0.0 };
        for (i, coordinate) in self.d.coordinates.iter().enumerate() {
            let size = self.size[i];
            let error = beyond(self.residual[i].abs(), shared * size);
            findings.book(Subject::Equations, error, size, at.time, coordinate.name);
        }
    }

    /// Checks constraints, contacts and frictions of the state that was taken.
    pub fn examine(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        self.examine_positions(at, mode, findings);
        self.examine_constraints(at, mode, findings);
        self.examine_contacts(at, mode, findings);
        self.examine_frictions(at, mode, findings);
        self.examine_bounds(at, mode, findings);
    }

    /// Checks whether forces are such as a mode allows, in the state that was taken: normal forces not negative, and frictions that stick within their cones.
    pub fn examine_bounds(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        let blur = self.blur_of_directions(at, mode, findings.tolerance);
        let shared = if at.shared { SHARED } else { 0.0 };
        let largest = at.shared.then(|| self.largest.clone());
        if let Some(mut loads) = largest.clone() {
            // A share may be small, or nothing, beside the load that it is a part of.
            self.measure_inertia(at);
            self.spread(&mut loads, mode);
            self.largest = loads;
        }
        for (c, contact) in self.declaration.contacts.iter().enumerate() {
            if self.contact_acts(c, mode) {
                let (force, name) = (at.forces[self.d.contacts[c].row], self.d.contacts[c].name);
                let size = self.force_along(contact.gap, Level::Position);
                let mut beyond = -force - blur - shared * size;
                if beyond > 0.0 {
                    beyond -= self.rounding_along(contact.gap, Level::Position, at, mode);
                }
                findings.book(Subject::NormalForces, beyond, size, at.time, name);
            }
        }
        for (f, friction) in self.declaration.frictions.iter().enumerate() {
            if mode.frictions[f] != FrictionMode::Stick || !self.friction_acts(f, mode) {
                continue;
            }
            let (first, name) = (self.d.frictions[f].row, self.d.frictions[f].name);
            let force = length(&at.forces[first..first + friction.slip.len()]);
            let (normal, normal_size) = self.normal(f, at.forces);
            let mu = self.values.value(friction.static_coefficient);
            let size = self.force_along_slips(friction.slip) + mu * normal_size;
            let mut beyond = force - mu * normal - blur - shared * size;
            if beyond > 0.0 {
                let along = |&slip: &usize| self.rounding_along(slip, Level::Velocity, at, mode);
                beyond -= friction.slip.iter().map(along).fold(0.0, f64::max);
            }
            findings.book(Subject::Cones, beyond, size, at.time, name);
        }
        if let Some(largest) = largest {
            self.largest = largest;
        }
    }

    /// What rounding makes of a force along a value where hardly any acts: the force that would take away a second's rounding error of velocities beside 1.
    fn rounding_along(
        &mut self,
        value: usize,
        level: Level,
        at: Situation<'_>,
        mode: &Mode,
    ) -> f64 {
        let balance = self.gradients.clone();
        let state = State::new(at.q.to_vec(), at.v.to_vec());
        let momenta = self.momentum_sizes(at.time, &state, mode);
        self.gradients = balance;
        let (along, square) = self.along(value, level, &momenta);
        match square > 0.0 {
            true => self.exact * along / square,
            false => 0.0,
        }
    }

    /// By how much forces are off because slips of two components that nearly vanish have their directions to what rounding leaves of them only,
    /// or none at all where they are no larger than their errors.
    fn blur_of_directions(&mut self, at: Situation<'_>, mode: &Mode, tolerance: f64) -> f64 {
        let mut blur = 0.0;
        for (f, friction) in self.declaration.frictions.iter().enumerate() {
            let turns = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => !matches!(sliding.direction, Direction::Fixed(_)),
                _ => false,
            };
            if turns && self.friction_acts(f, mode) {
                let speed = length(&self.slip(friction.slip));
                let reach = self.reach_of(friction.slip, at);
                let (normal, _) = self.normal(f, at.forces);
                let mu = self.values.value(friction.kinetic_coefficient);
                blur += mu
                    * normal.abs()
                    * match speed > VANISHING * tolerance * reach {
                        true => self.exact * reach / speed,
                        false => 2.0,
                    };
            }
        }
        blur
    }

    /// Components of a slip.
    fn slip(&self, components: &[usize]) -> Vec<f64> {
        let components = components.iter();
        components.map(|&value| self.values.value(value)).collect()
    }

    /// How large its components may be by what moves.
    fn reach_of(&mut self, slip: &[usize], at: Situation<'_>) -> f64 {
        let mut reach = 0.0_f64;
        for &value in slip {
            reach = reach.max(self.reach(value, 0, at));
        }
        reach
    }

    fn examine_energies(&mut self, at: Situation<'_>, reported: Energies, findings: &mut Findings) {
        let (jacobi, mut size) = self.jacobi(at);
        let pairs = [
            (reported.jacobi, jacobi),
            (reported.kinetic, self.energy(false)),
            (reported.potential, self.energy(true)),
        ];
        // A Lagrangian does not say which of its terms are kinetic.
        let known = if self.d.inertia.is_none() { 1 } else { 3 };
        let errors = pairs.map(|(reported, declared)| (reported - declared).abs());
        if errors[..known]
            .iter()
            .any(|error| *error > self.exact * size)
        {
            size += self.energy_of_each(at);
        }
        for &error in &errors[..known] {
            findings.book(Subject::Energies, error, size, at.time, self.d.name);
        }
    }

    /// Constraints and closed contacts with their rates, in the state that was taken.
    pub fn examine_positions(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        let d = self.d;
        for (i, &value) in self.declaration.constraints.iter().enumerate() {
            if self.constraint_acts(i, mode) {
                let levels = match self.level(i) {
                    Level::Position => 2,
                    Level::Velocity => 1,
                };
                for power in 0..levels {
                    let (error, reach) = self.residual(value, power, at);
                    let name = d.constraints[i].name;
                    findings.book(Subject::Constraints, error, reach, at.time, name);
                }
            }
        }
        for (c, contact) in self.declaration.contacts.iter().enumerate() {
            if !self.contact_acts(c, mode) {
                continue;
            }
            for power in 0..2 {
                let error = self.values.coefficient(contact.gap, power).abs();
                let reach = self.reach(contact.gap, power, at);
                findings.book(Subject::Closed, error, reach, at.time, d.contacts[c].name);
            }
        }
    }

    fn examine_constraints(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        for (i, &value) in self.declaration.constraints.iter().enumerate() {
            let row = self.d.constraints[i].row;
            let name = self.d.constraints[i].name;
            if self.constraint_acts(i, mode) {
                self.examine_row((value, self.level(i)), at, mode, name, findings);
            } else {
                findings.book(Subject::Idle, at.forces[row].abs(), 1.0, at.time, name);
            }
        }
    }

    /// Whether accelerations keep a row. Rows that depend on each other where constraints are satisfied contradict each other by what is left of residuals.
    fn examine_row(
        &mut self,
        row: (usize, Level),
        at: Situation<'_>,
        mode: &Mode,
        name: &'static str,
        findings: &mut Findings,
    ) {
        let (error, size) = self.acceleration(row, at, mode);
        let left = if at.shared {
            findings.tolerance * size
        } else {
            0.0
        };
        let error = beyond(error.abs(), left);
        findings.book(Subject::Rows, error, size, at.time, name);
    }

    fn examine_contacts(&mut self, at: Situation<'_>, mode: &Mode, findings: &mut Findings) {
        for (c, contact) in self.declaration.contacts.iter().enumerate() {
            let (force, name) = (at.forces[self.d.contacts[c].row], self.d.contacts[c].name);
            if !self.contact_acts(c, mode) {
                findings.book(Subject::Idle, force.abs(), 1.0, at.time, name);
                continue;
            }
            self.examine_row((contact.gap, Level::Position), at, mode, name, findings);
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
            let size = self.force_along_slips(friction.slip);
            let reach = self.reach_of(friction.slip, at);
            let slip = &self.slip(friction.slip)[..];
            match mode.frictions[f] {
                FrictionMode::Inactive => {}
                FrictionMode::Stick => {
                    findings.book(Subject::Slips, length(slip), reach, at.time, name);
                    for &value in friction.slip {
                        self.examine_row((value, Level::Velocity), at, mode, name, findings);
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
                    // A small slip has its direction to as much as rounding leaves of it.
                    let blur = match sliding.direction {
                        Direction::Fixed(_) => 0.0,
                        _ => mu * normal.abs() * self.exact * reach / speed,
                    };
                    let error = error - blur.min(error);
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
