//! Slips with two components, whose directions are unknowns: Newton's method.
//!
//! ```text
//! Λₜ = μk N w/|w|,  w = Λₜ − s⁺/g        together with all other equations of the combination
//! ```
//!
//! says the same as Λₜ = −μk N s⁺/|s⁺| if |w| ≥ μk N, and has a direction where the slip that is left is small beside that taken away (Alart & Curnier
//! 1991, Computer Methods in Applied Mechanics and Engineering 92, 353; g is what an impulse does to its own rate).

use super::collision::{Collision, FrictionRow, NormalSource};
use super::pattern::{Pattern, Phase, Slide, held, length};
use crate::arithmetic::{Scalar, rounding};

/// Newton steps for directions of slip.
const MOST_STEPS: usize = 30;

impl<T: Scalar> Pattern<T> {
    /// Newton's method for all equations together; false if it does not converge.
    pub fn turn(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let linear = self.unknowns.len();
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if matches!(slide, Slide::Turning(_)) {
                self.unknowns.extend([rub.row, rub.row + 1]);
            }
        }
        let converged = self.newton(c, phase, linear);
        self.unknowns.truncate(linear);
        converged
    }

    fn newton(&mut self, c: &Collision<T>, phase: &Phase<T>, linear: usize) -> bool {
        let count = self.unknowns.len();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let mut matrix = core::mem::take(&mut self.matrix);
            let mut right = core::mem::take(&mut self.right);
            matrix.clear();
            right.clear();
            // A turning friction brings nothing along here: its impulses are unknowns.
            for (at, &i) in self.unknowns[..linear].iter().enumerate() {
                match self.share_at(at) {
                    Some(share) => share.write(count, &mut matrix),
                    None => {
                        let all = self.unknowns.iter();
                        matrix.extend(all.map(|&row| self.effect(c, i, row, straight)));
                    }
                }
                right.push(self.missing(c, phase, at));
            }
            let mut regular = true;
            for (rub, slide) in c.rubs.iter().zip(&self.slides) {
                if matches!(slide, Slide::Turning(_)) {
                    regular &= self.linearize(c, rub, &mut matrix, &mut right);
                }
            }
            if regular {
                self.factors.factor(&mut matrix, count);
            }
            let solved = regular && self.factors.solve(&mut right);
            (self.matrix, self.right) = (matrix, right);
            if !solved {
                return false;
            }
            let mut change = 0.0;
            let mut size = 0.0;
            for (&row, &x) in self.unknowns.iter().zip(&self.right) {
                let scale = c.g(row, row).value().abs();
                change = f64::max(change, scale * x.value().abs());
                size = f64::max(size, scale * self.impulses[row].value().abs());
                self.impulses[row] += x;
            }
            self.move_on(c, phase, straight);
            // Quadratic: what is left after a step this small is rounding. Of a small slip rounding leaves the direction open.
            let stalls = change >= 0.5 * last;
            if change <= rounding::<T>(1e-15) * size
                || stalls
                    && (change <= rounding::<T>(1e-12) * size || self.is_settled(c, phase, linear))
            {
                return true;
            }
            last = change;
        }
        false
    }

    /// Whether what is missing in all equations is rounding.
    fn is_settled(&self, c: &Collision<T>, phase: &Phase<T>, linear: usize) -> bool {
        let meets = |at: usize| {
            let row = self.unknowns[at];
            let size = match self.share_at(at) {
                Some(_) => c.g(row, row).value(),
                None => 1.0,
            };
            (size * self.missing(c, phase, at).value()).abs() <= self.noise[row]
        };
        let turns = |(rub, slide): (&FrictionRow<T>, &Slide)| {
            !matches!(slide, Slide::Turning(_))
                || self.heading(c, rub).is_some_and(|heading| {
                    let left = heading.missing(self, rub).map(|x| x.value());
                    heading.own * length(&left) <= self.leeway * self.noise[rub.row]
                })
        };
        (0..linear).all(meets) && c.rubs.iter().zip(&self.slides).all(turns)
    }

    /// Where a turning friction heads; `None` where it has no direction.
    fn heading(&self, c: &Collision<T>, rub: &FrictionRow<T>) -> Option<Heading<T>> {
        let own = 0.5 * (c.g(rub.row, rub.row) + c.g(rub.row + 1, rub.row + 1)).value();
        let share = T::from_f64(1.0 / own);
        let w = [0, 1].map(|k| self.impulses[rub.row + k] - share * self.after[rub.row + k]);
        let length = (w[0] * w[0] + w[1] * w[1]).sqrt();
        let press = self.impulses[c.bearing_row(rub)];
        let sign = match rub.bearer {
            NormalSource::ConstraintRow(_) if press.value() < 0.0 => -T::one(),
            _ => T::one(),
        };
        let coefficient = rub.slide * rub.factor * sign;
        (own > 0.0 && length.value() > 0.0).then(|| Heading {
            own,
            along: w.map(|x| x / length),
            length,
            coefficient,
            normal: coefficient * press,
        })
    }

    /// Rows of Newton's matrix for a turning friction; false where it has no direction.
    fn linearize(
        &self,
        c: &Collision<T>,
        rub: &FrictionRow<T>,
        matrix: &mut Vec<T>,
        right: &mut Vec<T>,
    ) -> bool {
        let Some(heading) = self.heading(c, rub) else {
            return false;
        };
        let Heading { along, .. } = heading;
        let bearer = c.bearing_row(rub);
        let share = T::from_f64(1.0 / heading.own);
        let unit = |yes: bool| if yes { T::one() } else { T::zero() };
        for k in 0..2 {
            for &row in &self.unknowns {
                let own = [0, 1].map(|l| unit(row == rub.row + l));
                let dw =
                    [0, 1].map(|l| own[l] - share * self.effect(c, rub.row + l, row, straight));
                let across = dw[k] - along[k] * (along[0] * dw[0] + along[1] * dw[1]);
                let pressed = heading.coefficient * along[k] * unit(row == bearer);
                matrix.push(own[k] - pressed - heading.normal * across / heading.length);
            }
        }
        right.extend(heading.missing(self, rub));
        true
    }
}

/// Direction of a sliding friction that is held while turning ones find theirs.
fn straight(slide: &Slide) -> Option<[f64; 2]> {
    held(slide).filter(|_| !matches!(slide, Slide::Turning(_)))
}

/// Where a friction of two components heads.
struct Heading<T> {
    /// g
    own: f64,
    /// w/|w|
    along: [T; 2],
    /// |w|
    length: T,
    /// μk N over the impulse of the bearer.
    coefficient: T,
    /// μk N
    normal: T,
}

impl<T: Scalar> Heading<T> {
    /// What is missing in its equations.
    fn missing(&self, pattern: &Pattern<T>, rub: &FrictionRow<T>) -> [T; 2] {
        [0, 1].map(|k| self.normal * self.along[k] - pattern.impulses[rub.row + k])
    }
}
