//! What does not hold of a combination that has been solved, and where its slips go.

use super::{Pattern, Phase, Slide, length};
use crate::arithmetic::Scalar;
use crate::modes::impact::collision::{Collision, FrictionRow, NormalSource};

/// What does not hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::modes::impact) enum Violation {
    ContactRow(usize),
    FrictionRow(usize),
}

impl<T: Scalar> Pattern<T> {
    /// Solves the combination; whether all inequalities hold.
    pub fn is_solution(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.solve(c, phase) && self.violation(c, phase).is_none()
    }

    /// Lets turning frictions stick whose slips have vanished; what they did before, if there are any.
    pub fn stick_at_rest(&mut self, c: &Collision<T>) -> Option<Vec<Slide>> {
        let rests = |rub: &FrictionRow<T>, slide: &Slide| {
            matches!(slide, Slide::Turning(_))
                && length(&self.after[rub.row..rub.row + 2]) <= self.noise[rub.row]
        };
        let all = c.rubs.iter().zip(&self.slides);
        let slides = all.map(|(rub, slide)| match rests(rub, slide) {
            true => Slide::Stick,
            false => *slide,
        });
        if slides.clone().eq(self.slides.iter().copied()) {
            return None;
        }
        let slides = slides.collect();
        Some(core::mem::replace(&mut self.slides, slides))
    }

    /// The worst inequality that does not hold, rounding apart.
    pub fn violation(&self, c: &Collision<T>, phase: &Phase<T>) -> Option<Violation> {
        let mut worst: Option<(f64, Violation)> = None;
        let mut judge = |excess: f64, noise: f64, what: Violation| {
            let relative = excess / noise.max(f64::MIN_POSITIVE);
            if excess > noise && worst.is_none_or(|(w, _)| relative > w) {
                worst = Some((relative, what));
            }
        };
        for (k, touch) in c.touches.iter().enumerate() {
            let i = touch.row;
            if !phase.within[k] {
                continue;
            }
            let (excess, noise) = if self.pressed[k] {
                let short = (phase.least[k] - self.impulses[i]).value();
                (short * c.g(i, i).value(), self.noise[i])
            } else {
                // The rate of the last corner of a plate follows from those of the others, and with it what the run has left of them.
                let off = c.strength(i) * c.drift;
                ((phase.aims[k] - self.after[i]).value(), self.noise[i] + off)
            };
            judge(excess, noise, Violation::ContactRow(k));
        }
        // What is not left has its `while` rows hold, whether or not it is pressed.
        for &(row, k) in &c.conditional {
            let touch = c.touches[k].row;
            let is_left = self.after[touch].value() > self.noise[touch];
            if phase.within[k] && !self.holds(k, phase) && !is_left {
                let rate = self.after[row].value().abs();
                judge(rate, self.noise[row], Violation::ContactRow(k));
            }
        }
        for (r, rub) in c.rubs.iter().enumerate() {
            if let Some((excess, noise)) = self.excess(c, rub, self.slides[r]) {
                let leeway = if rub.components > 1 { self.leeway } else { 1.0 };
                judge(excess, leeway * noise, Violation::FrictionRow(r));
            }
            let drive = self.drive(c, rub, self.slides[r]);
            judge(drive, self.noise[rub.row], Violation::FrictionRow(r));
        }
        worst.map(|(_, what)| what)
    }

    /// How fast a turning friction drives its slip: the equations hold there as well. What would have to pull is another matter.
    fn drive(&self, c: &Collision<T>, rub: &FrictionRow<T>, slide: Slide) -> f64 {
        let pulls = matches!(rub.bearer, NormalSource::ContactRow(_))
            && self.impulses[c.bearing_row(rub)].value() < 0.0;
        if pulls || !matches!(slide, Slide::Turning(_)) {
            return 0.0;
        }
        let [impulse, slip] =
            [&self.impulses, &self.after].map(|of| [0, 1].map(|k| of[rub.row + k].value()));
        let size = impulse[0].hypot(impulse[1]).max(f64::MIN_POSITIVE);
        (impulse[0] * slip[0] + impulse[1] * slip[1]) / size
    }

    /// How far a friction is beyond its law, as a rate, and what rounding leaves of that.
    fn excess(&self, c: &Collision<T>, rub: &FrictionRow<T>, slide: Slide) -> Option<(f64, f64)> {
        let bearer = c.bearing_row(rub);
        let press = self.impulses[bearer].value();
        let normal = rub.factor.value() * press.abs();
        let impulse = length(&self.impulses[rub.rows()]);
        let own = c.g(rub.row, rub.row).value();
        let noise = |mu: f64| {
            let bearing = c.g(bearer, bearer).value().max(f64::MIN_POSITIVE);
            self.noise[rub.row] + mu * rub.factor.value() * own / bearing * self.noise[bearer]
        };
        match slide {
            Slide::Idle => None,
            Slide::Stick => {
                let mu = rub.stick.value();
                Some(((impulse - mu * normal) * own, noise(mu)))
            }
            Slide::Along(sign) => {
                let sign = match rub.bearer {
                    NormalSource::ConstraintRow(_) if press < 0.0 => -sign,
                    _ => sign,
                };
                let excess = -sign * self.after[rub.row].value();
                Some((excess, self.noise[rub.row]))
            }
            Slide::Turning(_) => {
                let mu = rub.slide.value();
                Some(((impulse - mu * normal).abs() * own, noise(mu)))
            }
        }
    }

    /// How far the slip of turning friction `r` is from the direction that is held: (across it, along it).
    pub fn deviation(&self, c: &Collision<T>, r: usize) -> (f64, f64) {
        let s = lead(&c.rubs[r], &self.impulses, &self.after);
        match self.slides[r] {
            Slide::Turning([x, y]) => (x * s[1] - y * s[0], x * s[0] + y * s[1]),
            _ => (0.0, 0.0),
        }
    }

    /// Puts the direction of each turning friction along the slip that it leaves.
    pub fn align(&mut self, c: &Collision<T>) {
        for (rub, slide) in c.rubs.iter().zip(&mut self.slides) {
            if let Slide::Turning(direction) = slide {
                let s = lead(rub, &self.impulses, &self.after);
                let length = s[0].hypot(s[1]);
                if length > 0.0 {
                    // Half-way: a direction that turns round would swing for ever.
                    let mean = [0, 1].map(|k| direction[k] + s[k] / length);
                    let size = mean[0].hypot(mean[1]);
                    if size > 1e-3 {
                        *direction = mean.map(|x| x / size);
                    }
                }
            }
        }
    }
}

/// Where the friction impulse of a rub with two components points away from: its slip, times the sign of the bearing impulse
/// on a constraint.
fn lead<T: Scalar>(rub: &FrictionRow<T>, impulses: &[T], after: &[T]) -> [f64; 2] {
    let against =
        matches!(rub.bearer, NormalSource::ConstraintRow(row) if impulses[row].value() < 0.0);
    let sign = if against { -1.0 } else { 1.0 };
    [0, 1].map(|k| sign * after[rub.row + k].value())
}
