//! How much energy there is along a trajectory, and what gives and takes it.
//!
//! The force of a row does the work λ (a·v) = −λ b per time, with b = 0 where what it holds does not move by itself (d'Alembert's
//! principle; Lanczos 1970, section III.1): only rheonomic rows and slips are asked for their forces.

use super::sampler::{Sampler, branches_of_outputs, report_needs, unless_left_out};
use super::{Event, Instant, Segment, State, Trajectory};
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::system::{Constraint, Description, Load, ValueRef};

/// Energies at one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies<T = f64> {
    /// T as declared.
    pub kinetic: T,
    /// V as declared.
    pub potential: T,
    /// v·∂L/∂v − L.
    pub jacobi: T,
}

impl<T: Scalar> Energies<T> {
    /// T + V, J.
    pub fn total(&self) -> T {
        self.kinetic + self.potential
    }

    /// Without derivatives.
    pub(super) fn values(&self) -> Energies {
        Energies {
            kinetic: self.kinetic.value(),
            potential: self.potential.value(),
            jacobi: self.jacobi.value(),
        }
    }
}

impl Energies {
    /// Whether the Jacobi integral is another quantity than T + V, beyond rounding: then it is what works balance.
    pub fn has_own_jacobi(&self) -> bool {
        let size = self.kinetic.abs() + self.potential.abs() + self.jacobi.abs();
        (self.jacobi - self.total()).abs() > 1e-10 * size
    }
}

impl<T: Scalar> Instant<T> {
    /// Kinetic and potential energy and the Jacobi integral, J.
    pub fn energies(&self) -> Energies<T> {
        Energies {
            kinetic: self.kinetic,
            potential: self.potential,
            jacobi: self.jacobi,
        }
    }
}

/// What can do work in a mode.
#[derive(Debug, Default)]
pub(super) struct Working {
    /// Rows.
    rows: Vec<usize>,
    /// Whether forces, dissipations or explicit time can.
    loads: bool,
    /// Whether one of these forces is known only when the equations of motion are solved.
    solved: bool,
    /// Whether there are branches on whose sides only energies depend: the motion does not decide them.
    undecided: bool,
}

impl Working {
    /// In the mode of these equations.
    fn of<T: Scalar>(dynamics: &Dynamics<T>) -> Self {
        let d = dynamics.description();
        let (mode, effects) = (dynamics.mode(), dynamics.effects());
        let acting = dynamics.acting_rows().iter().copied();
        let slipping = d.frictions.iter().zip(&mode.frictions);
        let slipping = slipping
            .filter(|(_, friction)| matches!(friction, FrictionMode::Slip(_)))
            .flat_map(|(f, _)| f.rows());
        let mut rows: Vec<usize> = acting.filter(|&row| d.rows[row].rheonomic).collect();
        rows.extend(slipping);
        rows.sort_unstable();
        rows.dedup();
        let loads = items(d.forces.len(), d.dissipations.len());
        let loads: Vec<_> = loads
            .zip(d.forces.iter().chain(d.dissipations))
            .filter(|(item, load)| effects.includes(d, *item) && load.power != ValueRef::Zero)
            .map(|(_, load)| load)
            .collect();
        let coupled = |load: &&Load| d.couplings.iter().any(|c| c.need == load.need);
        Self {
            solved: !rows.is_empty() || loads.iter().any(coupled),
            loads: !loads.is_empty() || d.energy.time_power != ValueRef::Zero,
            rows,
            undecided: !branches_of_outputs(dynamics).is_empty(),
        }
    }

    /// Whether anything can.
    fn any(&self) -> bool {
        self.loads || !self.rows.is_empty()
    }
}

/// Forces, then dissipations.
fn items(forces: usize, dissipations: usize) -> impl Iterator<Item = Item> {
    (0..forces)
        .map(Item::Force)
        .chain((0..dissipations).map(Item::Dissipation))
}

/// The place of a row among powers: behind those of forces and dissipations.
pub(super) fn place_of_row(d: &Description, row: usize) -> usize {
    d.forces.len() + d.dissipations.len() + row
}

/// Tells energies and powers at any time of a trajectory.
#[derive(Debug)]
pub(super) struct EnergyMeter<'a, T: Scalar> {
    trajectory: &'a Trajectory<T>,
    sampler: Sampler<'a, T>,
    /// In the mode that the sampler has entered.
    working: Working,
}

impl<'a, T: Scalar> EnergyMeter<'a, T> {
    pub(super) fn new(trajectory: &'a Trajectory<T>) -> Self {
        let mut dynamics = trajectory.dynamics();
        let needs = report_needs(dynamics.description());
        dynamics.set_report_needs(&needs);
        Self {
            trajectory,
            sampler: Sampler::with(trajectory, dynamics),
            working: Working::default(),
        }
    }

    fn enter(&mut self, mode: &Mode) {
        if self.sampler.enter(mode) {
            self.working = Working::of(&self.sampler.dynamics);
        }
    }

    /// Enters the mode of a segment.
    fn enter_segment(&mut self, index: usize) -> (&'a Mode, &'a Segment<T>) {
        let segment = &self.trajectory.segments[index];
        let mode = &self.trajectory.modes[segment.mode];
        self.enter(mode);
        (mode, segment)
    }

    /// Energies of a state in a mode.
    pub(super) fn energies(
        &mut self,
        t: T,
        mode: &Mode,
        state: &State<T>,
    ) -> Result<Energies<T>, Error> {
        self.enter(mode);
        self.energies_entered(t, mode, state)
    }

    /// Energies at a time within a segment, or between its end and the next one; `s` is the part of it.
    fn energies_inside(&mut self, time: f64, index: usize, s: T) -> Result<Energies<T>, Error> {
        let (mode, _) = self.enter_segment(index);
        let mut state = self.sampler.place(index, s)?;
        self.trajectory.spread_last_impacts(time, &mut state);
        let energies = self.energies_entered(T::from_f64(time), mode, &state);
        self.sampler.state = state;
        energies
    }

    /// Kinetic energy at part `s` of a segment, as exact as the tolerance of its step: nothing that depends on it is looked for.
    pub(super) fn kinetic(&mut self, index: usize, s: T) -> Result<T, Error> {
        let (mode, segment) = self.enter_segment(index);
        let mut state = core::mem::take(&mut self.sampler.state);
        self.trajectory
            .state_at(segment, s, &mut state.q, &mut state.v);
        let energies = self.energies_entered(segment.t + segment.h * s, mode, &state);
        self.sampler.state = state;
        Ok(energies?.kinetic)
    }

    /// Energies at a time of the run.
    pub(super) fn energies_at(&mut self, time: f64) -> Result<Energies, Error> {
        let trajectory = self.trajectory;
        let place = self.sampler.locate(time)?;
        let energies = match place {
            Some((segment, s)) if time != trajectory.last_time() => {
                self.energies_inside(time, segment, s)?
            }
            // Beside the last state, the end of the last polynomial is off by rounding.
            _ => self.energies(
                trajectory.last_time,
                trajectory.final_mode(),
                &trajectory.last,
            )?,
        };
        Ok(energies.values())
    }

    fn energies_entered(
        &mut self,
        t: T,
        mode: &Mode,
        state: &State<T>,
    ) -> Result<Energies<T>, Error> {
        if self.working.undecided {
            return Ok(self.sampler.evaluate_entered(t, mode, state)?.energies());
        }
        let dynamics = &mut self.sampler.dynamics;
        dynamics.report_of_state(t, &state.q, &state.v);
        let energy = &dynamics.description().energy;
        Ok(Energies {
            kinetic: dynamics.report(energy.kinetic),
            potential: dynamics.report(energy.potential),
            jacobi: dynamics.report(energy.jacobi),
        })
    }

    /// Works of the impulses of an impact, (row, J): each by the mean of the speeds along its row before and after (Thomson & Tait 1867, section 308).
    /// Constraints that hold before and after, and do not move by themselves, do none.
    pub(super) fn works_of_impulses(&mut self, event: &Event<T>) -> Vec<(usize, f64)> {
        self.enter(&event.after);
        let (State { q, v, .. }, after) = (&event.state, &event.state_after.v);
        let dynamics = &mut self.sampler.dynamics;
        dynamics.tape(event.time, q, v);
        let d = dynamics.description();
        let is_still = |row: usize| {
            let mut constraints = d.constraints.iter();
            let lasts = |constraint: &Constraint| {
                constraint.row == row && constraint.while_contact.is_none()
            };
            !d.rows[row].rheonomic && constraints.any(lasts)
        };
        let impulses = event.impulses.iter().enumerate();
        let working = impulses.filter(|&(row, impulse)| !impulse.is_zero() && !is_still(row));
        let work = |(row, &impulse): (usize, &T)| {
            let speeds = dynamics.speed_along(row, v) + dynamics.speed_along(row, after);
            (row, 0.5 * (impulse * speeds).value())
        };
        working.map(work).collect()
    }

    /// Whether anything can give or take energy in a segment.
    pub(super) fn works(&mut self, index: usize) -> bool {
        self.enter_segment(index);
        self.working.any()
    }

    /// Power of every force, dissipation and row, and of explicit time, at part `s` of a segment; in the order of
    /// [`super::ledger`].
    pub(super) fn powers(&mut self, index: usize, s: T, out: &mut [T]) -> Result<(), Error> {
        let (mode, segment) = self.enter_segment(index);
        let state = self.sampler.place(index, s)?;
        let time = segment.t + segment.h * s;
        let d = self.trajectory.description();
        out.fill(T::zero());
        let (sampler, working) = (&mut self.sampler, &self.working);
        if working.solved || working.undecided {
            let forces = sampler.evaluate_entered(time, mode, &state)?.forces;
            for &row in &working.rows {
                out[place_of_row(d, row)] =
                    forces[row] * sampler.dynamics.speed_along(row, &state.v);
            }
        } else {
            sampler.dynamics.report_of_state(time, &state.q, &state.v);
        }
        let dynamics = &sampler.dynamics;
        let powers = d.forces.iter().chain(d.dissipations).map(|load| load.power);
        for ((out, item), power) in out
            .iter_mut()
            .zip(items(d.forces.len(), d.dissipations.len()))
            .zip(powers)
        {
            *out = unless_left_out(dynamics, item, power);
        }
        if let Some(out) = out.last_mut() {
            *out = dynamics.report(d.energy.time_power);
        }
        sampler.state = state;
        Ok(())
    }
}
