//! One combination, from several directions of slip if there are any to be found.

use super::Search;
use crate::arithmetic::Scalar;
use crate::modes::impact::collision::Collision;
use crate::modes::impact::pattern::{Phase, Slide};
use core::f64::consts::TAU;

/// Directions all round from which a slip is looked for.
const SIDES: usize = 8;

/// Steps that put each direction along the slip that it causes, before Newton's method.
const ALIGNMENTS: usize = 3;

/// Marks of a circle between which a direction is looked for.
const MARKS: usize = 64;

/// Bisections between two marks.
const BISECTIONS: usize = 40;

impl<T: Scalar> Search<T> {
    /// Solves and judges the present combination, from several directions of slip if there are any to be found.
    pub(super) fn attempt(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.tried += 1;
        if !self.turns() {
            return self.holds(c, phase);
        }
        let turning = self
            .pattern
            .slides
            .iter()
            .filter(|s| matches!(s, Slide::Turning(_)));
        let single = turning.count() == 1;
        for k in 0..=SIDES {
            self.direct(c, phase, k);
            for _ in 0..ALIGNMENTS {
                if self.pattern.solve_held(c, phase) {
                    self.pattern.align(c);
                }
            }
            if self.holds(c, phase) {
                return true;
            }
        }
        single && self.turn_round(c, phase) && self.holds(c, phase)
    }

    /// The direction of the only turning friction along which its slip is: bisection between the marks of a circle.
    fn turn_round(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let mut slides = self.pattern.slides.iter();
        let Some(r) = slides.position(|s| matches!(s, Slide::Turning(_))) else {
            return false;
        };
        let mut deviation = |turns: f64| {
            let (sin, cos) = (TAU * turns).sin_cos();
            self.pattern.slides[r] = Slide::Turning([cos, sin]);
            let solved = self.pattern.solve_held(c, phase);
            solved.then(|| self.pattern.deviation(c, r))
        };
        let mut before = deviation(0.0);
        for mark in 1..=MARKS {
            let here = deviation(mark as f64 / MARKS as f64);
            if let (Some((a, along)), Some((b, also))) = (before, here)
                && (a < 0.0) != (b < 0.0)
                && (along > 0.0 || also > 0.0)
            {
                let (mut low, mut high) = ((mark - 1) as f64, mark as f64);
                let mut last = 0.0;
                for _ in 0..BISECTIONS {
                    let middle = 0.5 * (low + high);
                    let Some((across, along)) = deviation(middle / MARKS as f64) else {
                        break;
                    };
                    last = along;
                    if (across < 0.0) == (a < 0.0) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                if last > 0.0 {
                    return true;
                }
            }
            before = here;
        }
        false
    }

    fn turns(&self) -> bool {
        let mut slides = self.pattern.slides.iter();
        slides.any(|slide| matches!(slide, Slide::Turning(_)))
    }

    /// Where slips are looked for: along those before, then all round.
    fn direct(&mut self, c: &Collision<T>, phase: &Phase<T>, k: usize) {
        for (rub, slide) in c.rubs.iter().zip(&mut self.pattern.slides) {
            if let Slide::Turning(direction) = slide {
                let s = [0, 1].map(|k| phase.rates[rub.row + k].value());
                let speed = s[0].hypot(s[1]);
                let angle = TAU * k as f64 / SIDES as f64;
                *direction = if k == 0 && speed > 0.0 {
                    s.map(|x| x / speed)
                } else {
                    [angle.cos(), angle.sin()]
                };
            }
        }
    }
}
