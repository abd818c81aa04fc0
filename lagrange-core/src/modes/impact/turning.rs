//! Slips with two components, whose directions are unknowns: Newton's method.
//!
//! ```text
//! Λₜ + μk N s⁺/|s⁺| = 0        together with all other equations of the combination
//! ```

use super::collision::{Collision, FrictionRow, NormalSource};
use super::pattern::{Pattern, Phase, Slide};
use crate::arithmetic::Scalar;

/// Newton steps for directions of slip.
const MOST_STEPS: usize = 30;

impl<T: Scalar> Pattern<T> {
    /// Newton's method for Λₜ + μ N s⁺/|s⁺| = 0 together with all other equations.
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
                        matrix.extend(all.map(|&row| self.plain_effect(c, i, row)));
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
            self.slide_fixed(c);
            self.move_on(c, phase);
            // Quadratic: what is left after a step this small is rounding.
            if change <= 1e-15 * size || (change <= 1e-12 * size && change >= 0.5 * last) {
                return true;
            }
            last = change;
        }
        false
    }

    /// [`Self::slide`] for what has one component.
    fn slide_fixed(&mut self, c: &Collision<T>) {
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if let Slide::Along(sign) = *slide {
                let normal = rub.factor * self.impulses[c.bearing_row(rub)];
                self.impulses[rub.row] = T::from_f64(-sign) * rub.slide * normal;
            }
        }
    }

    /// [`Self::effect`] without the turning frictions.
    fn plain_effect(&self, c: &Collision<T>, i: usize, row: usize) -> T {
        let mut effect = c.g(i, row);
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if let Slide::Along(sign) = *slide
                && c.bearing_row(rub) == row
            {
                effect += T::from_f64(-sign) * rub.slide * rub.factor * c.g(i, rub.row);
            }
        }
        effect
    }

    /// Rows of Newton's matrix for a turning friction; false where it does not slip.
    fn linearize(
        &self,
        c: &Collision<T>,
        rub: &FrictionRow<T>,
        matrix: &mut Vec<T>,
        right: &mut Vec<T>,
    ) -> bool {
        let s = [0, 1].map(|k| self.after[rub.row + k]);
        let length = (s[0] * s[0] + s[1] * s[1]).sqrt();
        if !(length.value() > 0.0) {
            return false;
        }
        let along = s.map(|x| x / length);
        let bearer = c.bearing_row(rub);
        let press = self.impulses[bearer];
        let sign = match rub.bearer {
            NormalSource::ConstraintRow(_) if press.value() < 0.0 => -T::one(),
            _ => T::one(),
        };
        let coefficient = rub.slide * rub.factor * sign;
        let normal = coefficient * press;
        for k in 0..2 {
            for &row in &self.unknowns {
                let ds = [0, 1].map(|l| self.plain_effect(c, rub.row + l, row));
                let across = ds[k] - along[k] * (along[0] * ds[0] + along[1] * ds[1]);
                let mut entry = normal * across / length;
                if row == bearer {
                    entry += coefficient * along[k];
                }
                if row == rub.row + k {
                    entry += T::one();
                }
                matrix.push(entry);
            }
            right.push(-(self.impulses[rub.row + k] + normal * along[k]));
        }
        true
    }
}
