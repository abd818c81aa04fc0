//! How well accelerations can be known: where an inertia is about to vanish, the rounding errors of the elements are all that is left
//! of it. (Constraints that lose their rank are watched by [`super::singular`].)
//!
//! In M v̇ = f with elements known to within a share ε, v̇ is open by ε |K⁻¹| |K| |v̇|, K the whole matrix with the rows that act (Skeel
//! 1979, J. ACM 26; Higham 2002, section 7.2). No residual shows that: the accelerations satisfy equations that differ by rounding. Nor
//! does the error of a step: a method takes the noise for an error of its own, and makes its steps so short that each of them looks right.
//! What counts is how far velocities are off after the time in which they change by their own size, or that of a long step.
//!
//! The matrix is looked at where steps become short. Beside a singular point the motion changes as fast as the matrix does, so
//! steps shrink before accelerations are lost.

use super::Run;
use crate::arithmetic::{Scalar, epsilon};
use crate::error::Error;
use crate::integrate::least_size;
use crate::trajectory::State;

/// Steps up to this share of the longest one so far are short.
const SHORT: f64 = 1.0 / 16.0;
/// Short steps are looked at again where they are shorter by this.
const SHORTER: f64 = 0.5;

/// The elements of the matrix are sums of a few products, known to within this many units in the last place.
const UNITS: f64 = 4.0;
/// Every linear system loses a few digits; so many units are not a loss of inertia.
const ORDINARY: f64 = 4096.0;

/// Velocities may be off by this many times the tolerance, because estimates of errors only estimate.
const MARGIN: f64 = 16.0;

/// Which steps have been looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Resolution {
    /// The longest step so far.
    longest: f64,
    /// The shortest step that was looked at.
    examined: f64,
}

impl Resolution {
    /// The longest step so far.
    pub(super) fn longest(&self) -> f64 {
        self.longest
    }

    /// Whether a step of this length is to be looked at.
    fn examines(&mut self, h: f64) -> bool {
        if h > self.longest {
            (self.longest, self.examined) = (h, SHORT * h);
        }
        let examines = h <= SHORTER * self.examined;
        if examines {
            self.examined = h;
        }
        examines
    }
}

impl<T: Scalar> Run<T> {
    /// Looks whether rounding leaves the accelerations at the start of the step at hand known to within the tolerance.
    ///
    /// # Errors
    /// [`Error::Singular`] if it does not.
    #[inline]
    pub(super) fn check_resolution(&mut self) -> Result<(), Error> {
        let short = self
            .stepper
            .resolution
            .examines(self.stepper.step.h.value());
        match short && !self.rank.watches() {
            true => self.resolve_accelerations(),
            false => Ok(()),
        }
    }

    #[cold]
    fn resolve_accelerations(&mut self) -> Result<(), Error> {
        let State { q, v, .. } = &self.now.state;
        let Ok(open) = self.dynamics.open_accelerations(self.now.t, q, v) else {
            return Ok(());
        };
        let sizes = &self.settings.sizes;
        let share = |(i, rate): (usize, f64)| rate / (least_size(sizes, i) + v[i].value().abs());
        let step = &self.stepper.step;
        let accelerations = (0..v.len()).map(|i| step.acceleration(i, T::zero()).value().abs());
        let fastest = accelerations.enumerate().map(share).fold(0.0, f64::max);
        let shares = (open.into_iter().enumerate()).map(|(i, rate)| (i, share((i, rate))));
        let larger = |most: (usize, f64), next: (usize, f64)| match next.1 > most.1 {
            true => next,
            false => most,
        };
        let (coordinate, most) = shares.fold((0, 0.0), larger);
        let time = self.stepper.resolution.longest.min(1.0 / fastest);
        let unknown = UNITS * epsilon::<T>() * most * time;
        let allowed = MARGIN * self.settings.tolerance;
        if !(unknown > allowed.max(ORDINARY * epsilon::<T>())) {
            return Ok(());
        }
        let d = self.description();
        Err(Error::Singular {
            time: self.now.t.value(),
            mode: self.mode_in_words(),
            items: vec![d.coordinates[coordinate].name],
            reason: format!(
                "the equations of motion are nearly singular here, and rounding leaves velocities known to within {unknown:.1e} of their \
                 size only; ask for a larger tolerance, or give inertia to what has hardly any"
            ),
        })
    }
}
