//! Relaxation: one impulse after the other is put where its own condition holds, again and again.
//!
//! Projected Gauss–Seidel iteration (Jourdan, Alart & Jean 1998). It knows the round cone of a friction with two components
//! but converges linearly: it only says which combination holds, and along which directions what slips does so.

use super::collision::{Collision, NormalSource};
use super::pattern::{Pattern, Phase, Slide};
use crate::arithmetic::{Scalar, rounding};

const MOST_SWEEPS: usize = 3000;
/// Sweeps end when impulses change by less than this share.
const STEADY: f64 = 1e-12;
/// Slips below this share of the rates count as zero.
const SLIP: f64 = 1e-8;

/// Impulses and rates on the way; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Relaxation {
    impulses: Vec<f64>,
    rates: Vec<f64>,
    /// Per friction: coefficient in force.
    coefficients: Vec<f64>,
    /// Share of each correction that is made.
    pace: f64,
}

impl Relaxation {
    /// Starts without impulses; `pace` is the share of each correction that is made.
    pub fn begin<T: Scalar>(&mut self, c: &Collision<T>, phase: &Phase<T>, pace: f64) {
        self.pace = pace;
        self.impulses.clear();
        self.impulses.resize(c.size, 0.0);
        self.rates.clear();
        self.rates.extend(phase.rates.iter().map(|x| x.value()));
        self.coefficients.clear();
        let sticking = c.rubs.iter().map(|rub| rub.stick.value());
        self.coefficients.extend(sticking);
    }

    /// Sets the impulse of a row.
    fn set<T: Scalar>(&mut self, c: &Collision<T>, row: usize, impulse: f64) -> f64 {
        let change = self.pace * (impulse - self.impulses[row]);
        if change != 0.0 {
            self.impulses[row] += change;
            for (i, rate) in self.rates.iter_mut().enumerate() {
                *rate += c.g(i, row).value() * change;
            }
        }
        change.abs() * c.g(row, row).value()
    }

    /// Puts the rate of a row to zero.
    fn hold<T: Scalar>(&mut self, c: &Collision<T>, row: usize) -> f64 {
        let own = c.g(row, row).value();
        if own <= 0.0 {
            return 0.0;
        }
        self.set(c, row, self.impulses[row] - self.rates[row] / own)
    }

    /// Sweeps until nothing changes any more.
    pub fn sweep<T: Scalar>(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        let size = phase
            .rates
            .iter()
            .fold(0.0_f64, |m, x| m.max(x.value().abs()));
        for _ in 0..MOST_SWEEPS {
            let mut change = 0.0_f64;
            for row in 0..c.links {
                change = change.max(self.hold(c, row));
            }
            for &(row, k) in &c.conditional {
                let struck = phase.struck[k] || self.impulses[c.touches[k].row] > 0.0;
                if phase.within[k] && struck {
                    change = change.max(self.hold(c, row));
                }
            }
            for (k, touch) in c
                .touches
                .iter()
                .enumerate()
                .filter(|(k, _)| phase.within[*k])
            {
                let own = c.g(touch.row, touch.row).value();
                if own > 0.0 {
                    let short = phase.aims[k].value() - self.rates[touch.row];
                    let impulse = self.impulses[touch.row] + short / own;
                    let impulse = impulse.max(phase.least[k].value());
                    change = change.max(self.set(c, touch.row, impulse));
                }
            }
            for r in 0..c.rubs.len() {
                change = change.max(self.rub(c, phase, r));
            }
            if change <= rounding::<T>(STEADY) * size {
                break;
            }
        }
    }

    /// The greatest impulse of friction `r`.
    fn limit<T: Scalar>(&self, c: &Collision<T>, phase: &Phase<T>, r: usize) -> f64 {
        let rub = &c.rubs[r];
        if !phase.includes(rub) {
            return 0.0;
        }
        self.coefficients[r] * rub.factor.value() * self.impulses[c.bearing_row(rub)].abs()
    }

    fn rub<T: Scalar>(&mut self, c: &Collision<T>, phase: &Phase<T>, r: usize) -> f64 {
        let rub = &c.rubs[r];
        let rows = rub.rows();
        let own: f64 = rows.clone().map(|i| c.g(i, i).value()).sum();
        if own <= 0.0 {
            return 0.0;
        }
        let mut wanted = [0.0; 2];
        for (x, i) in wanted.iter_mut().zip(rows.clone()) {
            *x = self.impulses[i] - self.rates[i] / own;
        }
        let (size, limit) = (wanted[0].hypot(wanted[1]), self.limit(c, phase, r));
        let share = if size > limit { limit / size } else { 1.0 };
        let mut change = 0.0_f64;
        for (x, i) in wanted.iter().zip(rows) {
            change = change.max(self.set(c, i, share * x));
        }
        change
    }

    /// The combination reached. True if a coefficient has been lowered to that of sliding: then there is more to do.
    pub fn read<T: Scalar>(
        &mut self,
        c: &Collision<T>,
        phase: &Phase<T>,
        pattern: &mut Pattern<T>,
    ) -> bool {
        pattern.pressed.clear();
        pattern.slides.clear();
        for (k, touch) in c.touches.iter().enumerate() {
            let i = touch.row;
            let press = (self.impulses[i] - phase.least[k].value()) * c.g(i, i).value();
            let over = self.rates[i] - phase.aims[k].value();
            pattern.pressed.push(phase.within[k] && press >= over);
        }
        let mut lowered = false;
        for (r, rub) in c.rubs.iter().enumerate() {
            // Of a slip that friction ends rounding of what it does is left.
            let size = rub.rows().fold(0.0_f64, |size, i| {
                let ended = self.impulses[i].abs() * c.g(i, i).value();
                let before = phase.rates[i].value().abs();
                size.max(self.rates[i].abs()).max(before).max(ended)
            });
            let mut s = [0.0; 2];
            s[..rub.components].copy_from_slice(&self.rates[rub.rows()]);
            let speed = s[0].hypot(s[1]);
            let slide = if !pattern.bears(rub, phase) {
                Slide::Idle
            } else if speed <= SLIP * size {
                Slide::Stick
            } else {
                let against = matches!(rub.bearer, NormalSource::ConstraintRow(row) if self.impulses[row] < 0.0);
                let sign = if against { -1.0 } else { 1.0 };
                if self.coefficients[r] != rub.slide.value() {
                    self.coefficients[r] = rub.slide.value();
                    lowered = true;
                }
                match rub.components {
                    1 => Slide::Along(sign * s[0].signum()),
                    _ => Slide::Turning(s.map(|x| sign * x / speed)),
                }
            };
            pattern.slides.push(slide);
        }
        lowered
    }
}
