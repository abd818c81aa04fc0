//! How a slip of two components falls to zero, told by what it is at two instants near there: along a straight line.

use crate::dynamics::{cross, dot};

/// A slip near its end: just before it, and there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fall {
    pub before: [f64; 2],
    pub now: [f64; 2],
}

impl Fall {
    pub fn change(&self) -> [f64; 2] {
        [0, 1].map(|k| self.now[k] - self.before[k])
    }

    pub fn length(&self) -> f64 {
        self.change()[0].hypot(self.change()[1])
    }

    pub fn speed(&self) -> f64 {
        self.now[0].hypot(self.now[1])
    }

    /// Whether it has come nearest to zero between both: a root that is located to the tolerance may be behind.
    fn has_passed(&self) -> bool {
        dot(self.now, self.change()) > 0.0 && dot(self.before, self.change()) < 0.0
    }

    pub fn grows(&self) -> bool {
        dot(self.now, self.change()) > 0.0 && !self.has_passed()
    }

    /// By how much it misses zero, as far as is known.
    pub fn missed(&self) -> f64 {
        match self.has_passed() {
            true => cross(self.now, self.change()).abs() / self.length(),
            false => self.speed(),
        }
    }

    /// The time from `before` until it has fallen to this share of what it was there, in units of that between both, if it goes on along its line.
    pub fn until(&self, share: f64) -> f64 {
        let change = self.change();
        let nearest = -dot(self.before, change) / dot(change, change);
        let passes = cross(self.before, change).abs() / self.length();
        let falls = nearest > 0.0 && passes < share * self.before[0].hypot(self.before[1]);
        match falls {
            true => (1.0 - share) * nearest,
            false => f64::INFINITY,
        }
    }

    /// The time that is left, in units of that between both.
    pub fn left(&self) -> f64 {
        -dot(self.now, self.change()) / dot(self.change(), self.change())
    }
}
