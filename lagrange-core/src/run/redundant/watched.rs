//! Stops and marks that ask for undetermined forces.
//!
//! They are read by the solution of the equations that the step has. Results report another one where contacts or frictions bound how a load can be shared,
//! and series of forces that share it otherwise from instant to instant are not those of the least ones: what is read there is no answer.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::modes::guard::Guard;
use crate::modes::redundant::RedundantForces;
use crate::run::Run;

/// What is watched depends on forces if it changes by more than this share of what they change by.
const DEPENDS: f64 = 1e-9;

/// Forces that differ by less, relative, are the same.
const SAME: f64 = 1e-10;

/// A direction that changes by less, relative, is the same.
const TURNS: f64 = 1e-12;

impl<T: Scalar> Run<T> {
    /// Refuses stops and marks that would have other values with the forces that results report. The dynamics hold a value, whose undetermined forces have been
    /// looked at.
    ///
    /// # Errors
    /// [`Error::Undetermined`].
    pub(in crate::run) fn refuse_watches_of_bounded_shares(&mut self) -> Result<(), Error> {
        match self.watches_open_forces() {
            true => self.refuse_watches(|redundant, dynamics| redundant.forces(dynamics)),
            false => Ok(()),
        }
    }

    /// Refuses stops and marks of forces that their series do not tell, because directions in which a load can be shared change up to part `end` of the step,
    /// where the dynamics hold a value.
    ///
    /// # Errors
    /// [`Error::Undetermined`].
    pub(in crate::run) fn refuse_watches_of_turning_shares(
        &mut self,
        end: f64,
    ) -> Result<(), Error> {
        if !self.watches_open_forces() {
            return Ok(());
        }
        let after = self.directions();
        self.look_at_end(0.0);
        let before = self.directions();
        self.look_at_end(end);
        let mut pairs = before.iter().zip(&after);
        let turns = pairs
            .any(|(before, after)| (after - before).abs() > TURNS * before.abs().max(after.abs()));
        if !turns {
            return Ok(());
        }
        self.switcher.redundant.follow(&mut self.dynamics);
        self.refuse_watches(|redundant, dynamics| redundant.otherwise(dynamics))
    }

    /// The directions of all forces that act, at the last value of the dynamics.
    fn directions(&self) -> Vec<f64> {
        let rows = self.description().rows;
        let acting = self.dynamics.acting_rows().iter();
        let parts = acting.flat_map(|&row| rows[row].jacobian.iter());
        parts
            .map(|&(_, place)| self.dynamics.motion(place).value())
            .collect()
    }

    /// Whether there are stops or marks while forces are undetermined.
    fn watches_open_forces(&self) -> bool {
        !self.locator.polynomials.watches().is_empty() && self.dynamics.has_dependent_rows()
    }

    /// Refuses stops and marks that have other values with `other` forces.
    fn refuse_watches(
        &mut self,
        other: impl FnOnce(&RedundantForces<T>, &Dynamics<T>) -> Vec<T>,
    ) -> Result<(), Error> {
        let rows = 0..self.description().rows.len();
        let own: Vec<T> = rows.map(|row| self.dynamics.force(row)).collect();
        let others = other(&self.switcher.redundant, &self.dynamics);
        let size = |forces: &[T]| forces.iter().map(|x| x.value().abs()).fold(0.0, f64::max);
        let changes = own.iter().zip(&others).map(|(&own, &other)| other - own);
        let change = size(&changes.collect::<Vec<T>>());
        if change <= SAME * size(&own) {
            return Ok(());
        }
        let before = self.watched();
        self.dynamics.replace_forces(&others);
        let after = self.watched();
        self.dynamics.replace_forces(&own);
        let mut pairs = before.iter().zip(after);
        let differs = pairs.position(|(before, after)| (after - before).abs() > DEPENDS * change);
        let Some(index) = differs else {
            return Ok(());
        };
        let d = self.description();
        let watch = match self.locator.polynomials.watches()[index] {
            Guard::Stop(i, _) => &d.stops[i],
            Guard::Mark(i, _) => &d.marks[i],
            _ => return Ok(()),
        };
        Err(Error::Undetermined {
            time: self.dynamics.time_and_state()[0].value(),
            item: watch.name,
            mode: self.mode_in_words(),
        })
    }

    /// The values of the terms of stops and marks with the forces that the dynamics hold.
    fn watched(&mut self) -> Vec<f64> {
        self.dynamics.report_value();
        let polynomials = &self.locator.polynomials;
        let watches = 0..polynomials.watches().len();
        let value = |index| polynomials.value(index, &self.now.mode, &self.dynamics);
        watches.map(value).collect()
    }
}
