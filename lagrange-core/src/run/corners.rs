//! Where a piecewise expression changes, forces may jump, but not what would make velocities jump: no law says what they do there.
//!
//! The rate of a constraint may not, nor a momentum ∂L/∂v, nor L itself where that depends on the motion: a step of a potential refracts
//! what passes it, or reflects it. Energies that jump with time alone do work, which the ledger books.

use super::Run;
use crate::arithmetic::Scalar;
use crate::declaration::{Declaration, Evaluator, Gradient, Inputs, Seed};
use crate::dynamics::{AT_REST, Residual, row_name};
use crate::effects::{Effects, Item};
use crate::error::Error;
use crate::mode::Mode;
use crate::system::Erased;
use crate::trajectory::State;
use core::cmp::Ordering;

/// What jumps by more than this, relative, has a corner.
const CORNER: f64 = 1e-6;

/// A condition whose value is no larger than this, beside what makes it, changes at the instant.
const VANISHES: f64 = 1e-9;

/// L of the effects that act, as declared, where a choice in it changes with the motion or with time.
#[derive(Debug)]
pub(super) struct Lagrangian {
    evaluator: Evaluator,
    /// What the choices depend on.
    guards: Vec<usize>,
    /// T, with the weight 1, and V, with −1.
    seeds: Vec<Seed>,
}

/// A condition that changes at an instant: its value, and what it is taken for before and after.
type Change = (usize, [Ordering; 2]);

/// L on one side of a change, with the sum of its terms' sizes, and ∂/∂v.
struct Side {
    value: f64,
    size: f64,
    gradients: Vec<Gradient>,
}

impl Lagrangian {
    /// That of a system, if it has such a choice.
    pub(super) fn new<T: Scalar>(system: &Erased<T>, effects: &Effects) -> Option<Self> {
        let (d, declaration): (_, &Declaration) = (system.description(), system.declaration());
        let term = |value: usize, gradient: f64| Seed {
            value,
            variation: [0.0; 2],
            gradient,
        };
        let kinetic = declaration.kinetic.iter().enumerate();
        let kinetic = kinetic.filter(|(i, _)| effects.includes(d, Item::Kinetic(*i)));
        let potential = declaration.potential.iter().enumerate();
        let potential = potential.filter(|(i, _)| effects.includes(d, Item::Potential(*i)));
        let seeds = kinetic.map(|(_, &value)| term(value, 1.0));
        let seeds: Vec<Seed> = seeds
            .chain(potential.map(|(_, &value)| term(value, -1.0)))
            .collect();
        let values = seeds.iter().map(|seed| seed.value);
        let evaluator = Evaluator::new(declaration, &system.parameters(), values);
        let guards = evaluator.guards();
        (!guards.is_empty()).then_some(Self {
            evaluator,
            guards,
            seeds,
        })
    }

    /// Takes the parameters of another system of the same kind.
    pub(super) fn set_parameters(&mut self, parameters: &[f64]) {
        self.evaluator.set_parameters(parameters);
    }

    /// The conditions that vanish at a state, and whether any of them changes with the motion.
    fn changes(&mut self, at: Inputs<'_>) -> (Vec<Change>, bool) {
        self.evaluator.take_for([]);
        self.evaluator.evaluate(at);
        let mut derivatives = vec![[0.0; 3]; at.q.len()];
        let mut moves = false;
        let change = |&guard: &usize| {
            let [value, rate] = [0, 1].map(|k| self.evaluator.coefficient(guard, k));
            self.evaluator.gradient_size(guard, 0, &mut derivatives);
            let state = at.q.iter().zip(at.v);
            let terms = derivatives
                .iter()
                .zip(state)
                .map(|([position, velocity, _], (q, v))| {
                    position * (1.0 + q.abs()) + velocity * (1.0 + v.abs())
                });
            let by_motion: f64 = terms.sum();
            let size = by_motion + rate.abs() * (1.0 + at.time.abs());
            let vanishes = value.abs() <= VANISHES * size;
            moves |= vanishes && by_motion > 0.0;
            let sides = match rate > 0.0 {
                true => [Ordering::Less, Ordering::Equal],
                false => [Ordering::Equal, Ordering::Less],
            };
            (vanishes && rate != 0.0).then_some((guard, sides))
        };
        let changes: Vec<Change> = self.guards.iter().filter_map(change).collect();
        (changes, moves)
    }

    /// L before what changes does, or after.
    fn side(&mut self, after: bool, changes: &[Change], at: Inputs<'_>) -> Side {
        let taken = changes
            .iter()
            .map(|(guard, sides)| (*guard, sides[usize::from(after)]));
        self.evaluator.take_for(taken);
        self.evaluator.evaluate(at);
        let mut gradients = vec![Gradient::default(); at.q.len()];
        self.evaluator.sweep(&self.seeds, &mut gradients);
        let terms = self.seeds.iter();
        let terms = terms.map(|seed| seed.gradient * self.evaluator.value(seed.value));
        let (value, size) = terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
        Side {
            value,
            size,
            gradients,
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Refuses what would make velocities jump where the branches of a switch change.
    ///
    /// # Errors
    /// [`Error::Discontinuous`], [`Error::Corner`] and [`Error::Kick`].
    pub(super) fn refuse_corners(&mut self) -> Result<(), Error> {
        if self.recorder.before.mode.branches == self.now.mode.branches {
            return Ok(());
        }
        let State { q, v, .. } = &self.now.state;
        let (position, velocity) = self.dynamics.residuals(self.now.t, q, v);
        self.now.valued = false;
        let time = self.now.t.value();
        self.refuse_jump(time, position)?;
        self.refuse_corner(time, velocity)?;
        self.refuse_jumping_gaps()?;
        self.refuse_kicks()
    }

    /// Refuses gaps of open contacts that jump below zero: a floor that is higher all at once.
    fn refuse_jumping_gaps(&mut self) -> Result<(), Error> {
        let d = self.description();
        if !self.now.mode.contacts.contains(&false) {
            return Ok(());
        }
        let modes = [&self.recorder.before.mode, &self.now.mode].map(Mode::clone);
        let [before, after] = self.on_both_sides(modes.each_ref(), |run| {
            let gaps = (0..d.contacts.len()).map(|c| run.gap(c));
            gaps.collect::<Vec<f64>>()
        });
        let jumps = (0..d.contacts.len()).find(|&c| {
            let open = !self.now.mode.contacts[c] && !self.now.below[c];
            let takes_part = self.dynamics.effects().includes(d, Item::Contact(c));
            let below = after[c] < before[c].min(0.0) - self.corner() * self.extent(c).max(1.0);
            open && takes_part && below && self.is_in_region(c)
        });
        self.ask_for_guards();
        self.now.outdate();
        jumps.map_or(Ok(()), |c| {
            Err(Error::Discontinuous {
                time: self.now.t.value(),
                item: d.contacts[c].name,
                before: before[c],
                after: after[c],
            })
        })
    }

    /// Refuses a step up to part `end` of it that has passed a corner of what acts, where no branch says so: the middle of a `norm`. Its state there,
    /// which is at hand, does not keep the rates that it should. So with the cut of an `atan2`.
    ///
    /// # Errors
    /// [`Error::Discontinuous`] and [`Error::Corner`].
    pub(super) fn refuse_hidden_corners(&mut self, end: f64) -> Result<(), Error> {
        let may_pass = self.may_jump && !self.dynamics.acting_rows().is_empty();
        let tells = end > 0.0 && self.locator.rests.is_empty() && !self.is_undecided();
        if !(may_pass && tells) {
            return Ok(());
        }
        let State { q, v, .. } = &self.stepper.scratch;
        let time = self.stepper.step.time(T::from_f64(end));
        let (position, velocity) = self.dynamics.residuals(time, q, v);
        // A corner that the step has passed has moved what it was to end at.
        self.refuse_corner(time.value(), velocity)?;
        self.refuse_jump(time.value(), position)?;
        // What the step has left is evaluated again.
        self.evaluate_end(end).map_err(|e| self.error(e))
    }

    /// Refuses a row that should be zero and is not.
    fn refuse_jump(&self, time: f64, position: Residual) -> Result<(), Error> {
        match position.relative > self.corner() {
            true => Err(Error::Discontinuous {
                time,
                item: row_name(self.description(), position.row),
                before: 0.0,
                after: position.value,
            }),
            false => Ok(()),
        }
    }

    /// Refuses a rate that should be zero and is not.
    fn refuse_corner(&self, time: f64, velocity: Residual) -> Result<(), Error> {
        match velocity.relative > self.corner() {
            true => Err(Error::Corner {
                time,
                item: row_name(self.description(), velocity.row),
                rate: velocity.value,
            }),
            false => Ok(()),
        }
    }

    /// What residuals of rows are beyond, relative, where these jump.
    fn corner(&self) -> f64 {
        CORNER.max(1e3 * self.settings.tolerance)
    }

    /// Refuses momenta and Lagrangians that jump.
    fn refuse_kicks(&mut self) -> Result<(), Error> {
        let d = self.description();
        let Some(lagrangian) = &mut self.lagrangian else {
            return Ok(());
        };
        let modes = [&self.recorder.before.mode, &self.now.mode];
        let differs = |(b, _): &(usize, _)| modes[0].branch(*b) != modes[1].branch(*b);
        let Some((_, branch)) = d.branches.iter().enumerate().find(differs) else {
            return Ok(());
        };
        let State { q, v, .. } = &self.now.state.values();
        let time = self.now.t.value();
        let at = Inputs {
            time,
            q,
            v,
            acceleration: &vec![0.0; q.len()],
            forces: &[],
            loads: &[],
        };
        let (changes, moves) = lagrangian.changes(at);
        let [before, after] = [false, true].map(|after| lagrangian.side(after, &changes, at));
        // Of what is at rest there are squares of rounding only.
        let faster: Vec<f64> = v.iter().map(|v| v.abs() + AT_REST).collect();
        let moving = Inputs { v: &faster, ..at };
        let sides = [false, true].map(|after| lagrangian.side(after, &changes, moving));
        let kick = |momentum, before, after| Error::Kick {
            time,
            condition: branch.then,
            momentum,
            before,
            after,
        };
        let momenta = before.gradients.iter().zip(&after.gradients);
        let momenta = momenta.map(|(before, after)| [before.velocity, after.velocity]);
        let sizes = sides.iter().flat_map(|side| &side.gradients);
        let sizes = sizes.map(|gradient| gradient.velocity.size);
        let size = sizes.fold(0.0, f64::max);
        for (coordinate, [before, after]) in d.coordinates.iter().zip(momenta) {
            if (after.sum - before.sum).abs() > CORNER * size {
                return Err(kick(Some(coordinate.name), before.sum, after.sum));
            }
        }
        let size = sides.iter().fold(0.0_f64, |size, side| size.max(side.size));
        if moves && (after.value - before.value).abs() > CORNER * size {
            return Err(kick(None, before.value, after.value));
        }
        Ok(())
    }
}
