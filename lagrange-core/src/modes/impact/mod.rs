//! Impacts: velocities jump, positions do not.
//!
//! ```text
//! M (v⁺ − v⁻) = Σ aᵢᵀ Λᵢ
//! contact   Λₙ ≥ 0 ⟂ ġ⁺ + e ġ⁻ ≥ 0            (Newton's restitution, contacts together)
//! friction  s⁺ = 0 with |Λₜ| ≤ μs N, else Λₜ = −μk N s⁺/|s⁺|     N = Λₙ of a contact, |Λ| of a constraint
//! bilateral ġ⁺ = 0
//! ```
//!
//! Coefficients are those of the state before. Moreau (1988); Glocker (2001), chapter 6; Brogliato (2016), chapter 4.
//! [`gather`] brings the impact into the space of its rows, [`law`] has the laws, [`turn`] impacts one after the other,
//! [`search`] finds which contacts take part and which frictions stick, [`pattern`] solves and judges one such combination.

mod bearing;
mod collision;
mod complement;
mod gather;
mod law;
mod pattern;
mod relaxation;
mod search;
mod sequential;
#[cfg(test)]
mod tests;
mod turning;

use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::system::{Description, Impacts};
use collision::{Collision, FrictionRow};
use gather::Gathering;
use law::Law;
use pattern::length;
use sequential::{MOST_IMPACTS, Stuck, Turns};

/// An impact may miss its energy balance by this share, and no more.
const GAIN: f64 = 1e-9;

/// Velocities are known to within so many units in the last place of 1 + |v|.
const UNITS: f64 = 16.0;

/// A body whose points hold on to within what the run has left of their rates is off by so many times that at others.
const LEFT: f64 = 4.0;

/// An impact that satisfies the law as well as the one that was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherImpact<T> {
    /// Velocities just after.
    pub v_after: Vec<T>,
    /// Impulse of every row.
    pub impulses: Vec<T>,
}

/// What an impact does.
#[derive(Clone, Debug, Default)]
pub struct Impact<T> {
    /// Velocities after it.
    pub v: Vec<T>,
    /// Impulse of every row.
    pub impulses: Vec<T>,
    /// Per contact: the gap rate vanishes afterwards.
    pub stays: Vec<bool>,
    /// Per contact: takes part with an impulse.
    pub struck: Vec<bool>,
    /// Per friction that can act: the slip vanishes afterwards.
    pub sticks: Vec<bool>,
    /// Per friction that can act: the slip afterwards, as a share of what impulses of this size can make of it.
    pub slips: Vec<f64>,
    /// Whether the restitution was lowered.
    pub lowered: bool,
    /// Whether dependent rows leave some impulses undetermined; those given are the least that contacts and friction allow.
    pub undetermined: bool,
    /// Whether other impacts satisfy the law as well.
    pub ambiguous: bool,
    /// Other impacts that satisfy the law, as far as they are known as a whole.
    pub others: Vec<OtherImpact<T>>,
}

/// Solves impacts; the memory is reused.
#[derive(Clone, Debug, Default)]
pub struct Collider<T> {
    /// What the last impact has done.
    pub outcome: Impact<T>,
    /// The same of the last in which contacts came to rest.
    pub rest: Impact<T>,
    collision: Collision<T>,
    gathering: Gathering<T>,
    law: Law<T>,
    turns: Turns<T>,
}

impl<T: Scalar> Collider<T> {
    /// Solves the impact of the contacts `near` (gap zero) at velocities `v`; `dynamics` holds the values of the state,
    /// with the Jacobians of all rows.
    ///
    /// # Errors
    /// [`Error::NoImpact`] if no combination satisfies the law, [`Error::EndlessImpacts`] if impacts in turn do not end,
    /// [`Error::EnergyGain`] if the solution adds energy.
    pub fn solve(
        &mut self,
        dynamics: &Dynamics<T>,
        t: f64,
        v: &[T],
        near: &[usize],
        impacts: Impacts,
    ) -> Result<(), Error> {
        self.solve_share(dynamics, t, v, near, (impacts, 1.0))
    }

    /// The impact in which contacts come to rest that have bounced infinitely often, without restitution, into [`Self::rest`].
    ///
    /// # Errors
    /// The same as [`Self::solve`].
    pub fn bring_to_rest(
        &mut self,
        dynamics: &Dynamics<T>,
        t: f64,
        v: &[T],
        near: &[usize],
    ) -> Result<(), Error> {
        core::mem::swap(&mut self.outcome, &mut self.rest);
        let mut solved = self.solve_share(dynamics, t, v, near, (Impacts::Together, 0.0));
        core::mem::swap(&mut self.outcome, &mut self.rest);
        // What comes to rest does so together, whatever is chosen for impacts.
        if let Err(Error::NoImpact { together, .. }) = &mut solved {
            *together = false;
        }
        solved
    }

    /// The impact with this share of every restitution.
    fn solve_share(
        &mut self,
        dynamics: &Dynamics<T>,
        t: f64,
        v: &[T],
        near: &[usize],
        (impacts, share): (Impacts, f64),
    ) -> Result<(), Error> {
        let d = dynamics.description();
        let contact = |k: usize| d.contacts[near.get(k).copied().unwrap_or(0)].name;
        self.law.search.tried = 0;
        let collected = self
            .gathering
            .collect(dynamics, v, near, &mut self.collision);
        for touch in &mut self.collision.touches {
            touch.restitution *= T::from_f64(share);
        }
        let solved = if collected {
            self.solve_rows(impacts)
        } else {
            Err(Stuck::Unsolved(0))
        };
        match solved {
            Ok(()) => {}
            Err(Stuck::Unsolved(k)) => {
                let tried = self.law.search.tried;
                let together = impacts == Impacts::Together && near.len() > 1;
                return Err(Error::NoImpact {
                    time: t,
                    mode: dynamics.mode().display(d).to_string(),
                    item: contact(k),
                    tried,
                    together: collected && together && self.solve_rows(Impacts::InTurn).is_ok(),
                    friction: collected && self.is_solved_without_friction(impacts),
                });
            }
            Err(Stuck::Endless(k)) => {
                return Err(Error::EndlessImpacts {
                    time: t,
                    item: contact(k),
                    impacts: MOST_IMPACTS,
                });
            }
        }
        self.write_outcome(d, v);
        let (gain, size) = self.balance(dynamics, v);
        let share = GAIN.max(64.0 * epsilon::<T>());
        if gain > share * size + self.rounding(dynamics, v) {
            return Err(Error::EnergyGain {
                time: t,
                item: contact(0),
                gain,
            });
        }
        Ok(())
    }

    fn solve_rows(&mut self, impacts: Impacts) -> Result<(), Stuck> {
        let Self {
            collision,
            law,
            turns,
            ..
        } = self;
        match impacts {
            Impacts::InTurn => turns.solve(collision, law),
            Impacts::Together => turns.solve_groups(collision, law),
        }
    }

    /// Whether the impact has a solution if nothing rubs.
    fn is_solved_without_friction(&mut self, impacts: Impacts) -> bool {
        let rubs = &mut self.collision.rubs;
        let rough = rubs.iter().any(FrictionRow::is_rough);
        for rub in rubs {
            (rub.stick, rub.slide) = (T::zero(), T::zero());
        }
        rough && self.solve_rows(impacts).is_ok()
    }

    fn write_outcome(&mut self, d: &Description, v: &[T]) {
        self.write_others(d, v);
        let Self {
            outcome,
            collision: c,
            turns,
            ..
        } = self;
        outcome.ambiguous = turns.ambiguous;
        outcome.lowered = turns.lowered;
        outcome.undetermined = turns.undetermined;
        outcome.impulses.clear();
        outcome.impulses.resize(d.rows.len(), T::zero());
        self.gathering.apply(&turns.impulses, v, outcome);
        for (flags, count) in [
            (&mut outcome.stays, d.contacts.len()),
            (&mut outcome.struck, d.contacts.len()),
            (&mut outcome.sticks, d.frictions.len()),
        ] {
            flags.clear();
            flags.resize(count, false);
        }
        for touch in &c.touches {
            let row = touch.row;
            // The rate of the last corner of a plate follows from those of the others, and with it what the run has left of them.
            let off = LEFT * c.strength(row) * c.drift;
            outcome.stays[touch.contact] = turns.rates[row].value().abs() <= turns.noise[row] + off;
            let effect = turns.impulses[row].value() * c.g(row, row).value();
            outcome.struck[touch.contact] = effect > turns.noise[row];
        }
        let effort = c.effort(&turns.impulses);
        outcome.slips.clear();
        outcome.slips.resize(d.frictions.len(), 0.0);
        for rub in &c.rubs {
            let rows = rub.rows();
            let slip = length(&turns.rates[rows.clone()]);
            let strength = rows.map(|row| c.strength(row)).fold(0.0, f64::max);
            // What has stuck to another surface is as far from rest on this one as it was there.
            let off = LEFT * strength * c.drift;
            outcome.sticks[rub.friction] = slip <= turns.noise[rub.row] + off;
            outcome.slips[rub.friction] = slip / (strength * effort).max(f64::MIN_POSITIVE);
        }
    }

    /// Other impacts that satisfy the law, where it has one phase: of several groups of contacts each time one does something else.
    fn write_others(&mut self, d: &Description, v: &[T]) {
        self.outcome.others.clear();
        if self.collision.touches.iter().any(|touch| touch.poisson) {
            return;
        }
        let mut out = Impact::default();
        let taken = &self.turns.impulses;
        for other in &self.turns.others {
            out.impulses.clear();
            out.impulses.resize(d.rows.len(), T::zero());
            let impulses = taken.iter().zip(other);
            let impulses: Vec<T> = impulses.map(|(taken, more)| *taken + *more).collect();
            self.gathering.apply(&impulses, v, &mut out);
            self.outcome.others.push(OtherImpact {
                v_after: out.v.clone(),
                impulses: out.impulses.clone(),
            });
        }
    }

    /// What rounding errors of velocities make of the kinetic energy: of a body that impacts have brought to rest, by a surface that comes to it without speed,
    /// and by what is left of the rates of contacts that were closed.
    fn rounding(&self, dynamics: &Dynamics<T>, v: &[T]) -> f64 {
        let speed = |i: usize| v[i].value().abs();
        let known = |i: usize| UNITS * epsilon::<T>() * (1.0 + speed(i));
        let mass = dynamics.description().mass.iter();
        let parts = mass.map(|&(i, j, place)| {
            let of_both = speed(i) * known(j) + known(i) * (speed(j) + known(j));
            dynamics.motion(place).value().abs() * of_both
        });
        parts.sum()
    }

    /// Kinetic energy that is not work of moving surfaces, from velocities and impulses: (gain, size of its terms).
    fn balance(&self, dynamics: &Dynamics<T>, v: &[T]) -> (f64, f64) {
        let d = dynamics.description();
        let (mut gain, mut size) = (0.0, 0.0);
        for &(i, j, place) in d.mass {
            let m = dynamics.motion(place).value() * if i == j { 0.5 } else { 1.0 };
            let after = m * (self.outcome.v[i] * self.outcome.v[j]).value();
            let before = m * (v[i] * v[j]).value();
            gain += after - before;
            size += after.abs() + before.abs();
        }
        // A row a v + b does −b Λ.
        for (row, impulse) in self.outcome.impulses.iter().enumerate() {
            if impulse.is_zero() {
                continue;
            }
            let own = dynamics.motion(d.rows[row].velocity) - dynamics.speed_along(row, v);
            gain += (own * *impulse).value();
            size += (own * *impulse).value().abs();
        }
        (gain, size)
    }
}
