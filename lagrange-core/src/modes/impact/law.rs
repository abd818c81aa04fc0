//! The laws of impact, for contacts that are solved together.
//!
//! * Newton: one phase, each contact that approaches is left with −e times its rate.
//! * Poisson: compression until nothing approaches; then restitution, in which each contact gets at least e times the
//!   impulse that it had, and more if it would approach again (Pfeiffer & Glocker 1996, chapter 8). Friction obeys Coulomb's
//!   law in each phase by itself. Where contacts of both kinds meet, those of Newton compress as well and are then
//!   brought to −e times the rate before.
//!
//! Either law can add energy where there is friction (Kane & Levinson 1985). The impact is then solved with the same share
//! of all restitutions, the largest that adds none; without any, the impact is plastic, and that never does: with ΔT =
//! ½ Σ Λᵢ (rateᵢ⁻ + rateᵢ⁺), all Λᵢ rateᵢ⁺ ≤ 0 and ½ Σ Λᵢ rateᵢ⁻ = ½ Σ Λᵢ rateᵢ⁺ − ½ ΔvᵀM Δv. The rates are those between
//! the surfaces, so that surfaces which move as one change nothing of it; what they do is booked by the ledger.

use super::collision::Collision;
use super::pattern::Phase;
use super::search::Search;
use crate::arithmetic::{Scalar, rounding};

/// Bisections for the share of the restitution.
const BISECTIONS: usize = 60;

/// Equations that contradict one another by less than this share of the restitution count as satisfied: it is as if there were no restitution.
const LEAST_SHARE: f64 = 1e-6;

/// Solves impacts by their laws; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Law<T> {
    pub search: Search<T>,
    pub phase: Phase<T>,
    /// Λ of every row, of all phases.
    pub impulses: Vec<T>,
    /// Rates after.
    pub after: Vec<T>,
    /// What rounding leaves of them.
    pub noise: Vec<f64>,
    /// Whether some impulses are not determined.
    pub undetermined: bool,
    /// Whether the restitution was lowered.
    pub lowered: bool,
    /// Whether other impacts satisfy the law as well.
    pub ambiguous: bool,
}

impl<T: Scalar> Law<T> {
    /// Solves the impact of the touches in `phase.within` at `rates`; false if the law has no solution.
    pub fn solve(&mut self, c: &Collision<T>, rates: &[T]) -> bool {
        self.lowered = false;
        let solved = self.solve_share(c, rates, 1.0);
        if solved && !self.gains(rates) {
            return true;
        }
        if !self.bounces(c, rates) {
            // Without restitution no law adds energy: that was rounding.
            return solved;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let share = 0.5 * (low + high);
            if self.solve_share(c, rates, share) && !self.gains(rates) {
                low = share;
            } else {
                high = share;
            }
        }
        self.lowered = true;
        low >= LEAST_SHARE && self.solve_share(c, rates, low) || self.solve_share(c, rates, 0.0)
    }

    /// Whether a contact that takes part and approaches has a restitution.
    fn bounces(&self, c: &Collision<T>, rates: &[T]) -> bool {
        let mut touches = c.touches.iter().zip(&self.phase.within);
        touches.any(|(touch, within)| {
            *within && rates[touch.row].value() < 0.0 && touch.restitution.value() != 0.0
        })
    }

    /// The impact with this share of every restitution.
    pub fn solve_share(&mut self, c: &Collision<T>, rates: &[T], share: f64) -> bool {
        let share = T::from_f64(share);
        let bounce = |k: usize| {
            let touch = &c.touches[k];
            let rate = rates[touch.row];
            if rate.value() < 0.0 {
                -share * touch.restitution * rate
            } else {
                T::zero()
            }
        };
        let touches = c.touches.len();
        let taking = |k: &usize| self.phase.within[*k];
        let newton = (0..touches).filter(taking).all(|k| !c.touches[k].poisson);
        (self.undetermined, self.ambiguous) = (false, false);
        self.impulses.clear();
        self.impulses.resize(c.size, T::zero());
        self.phase.rates.clear();
        self.phase.rates.extend_from_slice(rates);
        self.phase.least.clear();
        self.phase.least.resize(touches, T::zero());
        self.phase.struck.clear();
        self.phase.struck.resize(touches, false);
        self.phase.aims.clear();
        if newton {
            self.phase.aims.extend((0..touches).map(bounce));
            return self.add_phase(c);
        }
        self.phase.aims.resize(touches, T::zero());
        if !self.add_phase(c) {
            return false;
        }
        for (rate, (after, noise)) in
            (self.phase.rates.iter_mut()).zip(self.after.iter().zip(&self.noise))
        {
            // What rounding has left of a rate would be restored as an approach that no impulse can end.
            *rate = match after.value().abs() <= *noise {
                true => *after - T::from_f64(after.value()),
                false => *after,
            };
        }
        for (k, touch) in c.touches.iter().enumerate() {
            self.phase.struck[k] = self.impulses[touch.row].value() > 0.0;
            if touch.poisson {
                self.phase.least[k] = share * touch.restitution * self.impulses[touch.row];
            } else {
                self.phase.aims[k] = bounce(k);
            }
        }
        self.add_phase(c)
    }

    fn add_phase(&mut self, c: &Collision<T>) -> bool {
        if !self.search.find(c, &self.phase) {
            return false;
        }
        let found = &self.search.pattern;
        for (sum, &impulse) in self.impulses.iter_mut().zip(&found.impulses) {
            *sum += impulse;
        }
        self.after.clone_from(&found.after);
        self.noise.clone_from(&found.noise);
        self.undetermined |= found.undetermined;
        self.ambiguous |= !self.search.others.is_empty();
        true
    }

    /// Whether the impact adds energy: ½ Σ Λ (rate⁻ + rate⁺) > 0 beyond rounding.
    fn gains(&self, rates: &[T]) -> bool {
        let (mut gain, mut size) = (0.0, 0.0);
        let all = self.impulses.iter().zip(rates).zip(&self.after);
        for ((impulse, before), after) in all {
            gain += impulse.value() * (before.value() + after.value());
            size += impulse.value().abs() * (before.value().abs() + after.value().abs());
        }
        gain > rounding::<T>(1e-13) * size
    }
}
