//! Infinitely many impacts in finite time: a bouncing ball comes to rest.
//!
//! With Newton's restitution the intervals between impacts shrink by a factor ρ < 1, and what is left of them after an
//! interval Δ lasts Δ ρ/(1 − ρ). Once all that can still move in that time is below the tolerance, and not earlier, the
//! contact closes at the limit instant (Brogliato 2016, section 1.3; Goebel & Teel 2008).

use super::Run;
use crate::arithmetic::Scalar;
use crate::modes::decide::Known;
use crate::system::{Place, System};

/// Shrinking is believed after this many intervals.
const FEWEST: usize = 3;
/// Intervals that are remembered.
const REMEMBERED: usize = 128;

/// The impacts of one contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Impacts {
    /// Number of impacts with shrinking intervals.
    count: usize,
    /// Time of the last one.
    last: f64,
    /// Interval before it.
    interval: f64,
    /// Ratio of the last two intervals.
    ratio: f64,
    /// The intervals before the last `REMEMBERED` of the `count` impacts, in a ring.
    intervals: [f64; REMEMBERED],
}

impl Default for Impacts {
    fn default() -> Self {
        Impacts {
            count: 0,
            last: 0.0,
            interval: 0.0,
            ratio: 0.0,
            intervals: [0.0; REMEMBERED],
        }
    }
}

impl Impacts {
    /// Books an impact; returns how long all further ones will last, if they shrink geometrically.
    fn book(&mut self, time: f64) -> Option<f64> {
        let interval = time - self.last;
        let ratio = interval / self.interval;
        let shrinking = self.count > 0 && ratio < 1.0;
        let steady = shrinking && (ratio - self.ratio).abs() < 0.1 * (1.0 - ratio);
        self.count = if shrinking || self.count < 2 {
            self.count + 1
        } else {
            1
        };
        (self.last, self.interval, self.ratio) = (time, interval, ratio);
        self.intervals[self.count % REMEMBERED] = interval;
        (steady && self.count >= FEWEST).then(|| {
            let ratio = self.mean_ratio();
            interval * ratio / (1.0 - ratio)
        })
    }

    /// Mean ratio of the intervals since they were about e times as long: where they shrink slowly, the resolution of time
    /// blurs the ratio of two by more than its distance from 1 bears.
    fn mean_ratio(&self) -> f64 {
        let back = (1.0 / (1.0 - self.ratio)) as usize;
        // The interval before the first impact of a series is not one of it.
        let back = back.clamp(1, (self.count.saturating_sub(3)).clamp(1, REMEMBERED - 1));
        let earlier = self.intervals[(self.count - back) % REMEMBERED];
        let mean = (self.interval / earlier).powf(1.0 / back as f64);
        if (mean - self.ratio).abs() < 0.1 * (1.0 - self.ratio) {
            mean
        } else {
            self.ratio
        }
    }
}

impl<S: System> Run<S> {
    /// After an impact of contact `c` that bounced: closes it if the bounces to come are below the tolerance. Returns
    /// the number of impacts that led here.
    pub(super) fn accumulate(&mut self, c: usize, known: &mut Known) -> Option<usize> {
        let remaining = self.impacts[c].book(self.t.value())?;
        let tolerance = self.settings.tolerance;
        let moves = |(q, v): (&S::Scalar, &S::Scalar)| {
            v.value().abs() * remaining > tolerance * q.value().abs().max(1.0)
        };
        // Below the resolution of time nothing can be told apart.
        let resolved = remaining > 64.0 * f64::EPSILON * self.t.value().abs();
        if resolved && self.state.q.iter().zip(&self.state.v).any(moves) {
            return None;
        }
        let d = S::DESCRIPTION;
        known.touching[c] = true;
        known.parting[c] = false;
        // Contacts that take part in the same cycle (the other corner of a rocking block) close with it.
        for (other, impacts) in self.impacts.iter().enumerate() {
            let recent =
                impacts.count >= FEWEST && self.t.value() - impacts.last <= 2.0 * impacts.interval;
            let row = &d.rows[d.contacts[other].row];
            let gap = self.dynamics.motion(row.position.unwrap_or(Place::Zero));
            // One that parts for good closes again in its own time.
            let still = self.rate_after(other) <= 8.0 * self.rate_after(c);
            if other != c && recent && gap.value().abs() <= tolerance && still {
                known.touching[other] = true;
                known.parting[other] = false;
            }
        }
        self.t += S::Scalar::from_f64(remaining);
        let count = self.impacts[c].count;
        self.impacts[c] = Impacts::default();
        Some(count)
    }
    /// Speed at which the gap of contact `c` changes after the impact that `dynamics` has evaluated.
    fn rate_after(&self, c: usize) -> f64 {
        let row = &S::DESCRIPTION.rows[S::DESCRIPTION.contacts[c].row];
        let jump = row.jacobian.iter().map(|&(j, place)| {
            let change = self.state.v[j] - self.before.state.v[j];
            (self.dynamics.motion(place) * change).value()
        });
        (self.dynamics.motion(row.velocity).value() + jump.sum::<f64>()).abs()
    }
}
