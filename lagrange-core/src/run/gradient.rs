//! Gaps without a gradient where they are zero: in which direction they change is not told by positions that have errors.

use super::Run;
use crate::arithmetic::{GOLDEN, Scalar, rounding, uneven};

/// A gap whose rate is larger than this beside the velocities has a gradient.
const STEEP: f64 = 1e-2;

/// A gap that falls by no more than so many errors of positions only touches zero.
const SHALLOW: f64 = 4.0;

/// Positions are off by so many tolerances.
const OFF: f64 = 4.0;

/// Bottoms as flat as that of x⁴ are looked for up to this root of the tolerance.
const FLAT: f64 = 0.25;

/// Where it falls to less than this share a gradient ends.
const ENDS: f64 = 0.5;

/// A gradient that is no more than this share of what constraints take of it is none.
const NOTHING: f64 = 1e-14;

/// A gradient of which constraints leave no more than this share depends on them.
const DEPENDENT: f64 = 1e-12;

impl<T: Scalar> Run<T> {
    /// Whether positions are not known well enough to tell in which direction the gap of an open contact changes: that above a floor which is exactly as low
    /// as a pendulum hangs has no gradient there, or none that the rod of the pendulum leaves free.
    pub(super) fn has_no_direction(&mut self, c: usize) -> bool {
        if !self.gradient_varies(c) {
            return false;
        }
        let row = self.description().contacts[c].row;
        let fastest = self.now.state.v.iter();
        let fastest = fastest.fold(0.0_f64, |fastest, v| fastest.max(v.value().abs()));
        let (rate, _) = self.rate(row);
        if rate.abs() > STEEP * fastest {
            return false;
        }
        let (n, positions) = (self.now.state.q.len(), &self.now.state.q);
        let allowed = |j: usize| self.settings.allowed(j, positions[j].value().abs());
        let shallow = SHALLOW * self.dynamics.size_of_row(row, allowed);
        let tolerance = self.settings.tolerance;
        let [mut here, mut there] = core::mem::take(&mut self.switcher.gradients);
        let nothing = rounding::<T>(NOTHING) * self.free_gradient(row, &mut here);
        let gradient = &here[here.len() - n..];
        let slope = norm(gradient);
        let ends = slope <= nothing;
        let farthest = tolerance.powf(FLAT);
        // Straight down the gap would fall by that on the way.
        let far = (shallow / slope).min(farthest).max(OFF * tolerance);
        let moved = |j: usize, _| {
            T::from_f64(match ends {
                false => -far * gradient[j] / slope,
                // Neither sums nor differences of coordinates stay as they are.
                true => farthest * uneven(j, GOLDEN),
            })
        };
        self.beside(None, T::zero(), moved, |run| {
            run.free_gradient(row, &mut there)
        });
        let below = &there[there.len() - n..];
        let touches = match ends {
            // What constraints hold closed for good touches nevertheless.
            true => norm(below) > nothing,
            false => {
                let along = gradient.iter().zip(below);
                along.map(|(here, below)| here * below).sum::<f64>() <= ENDS * slope * slope
            }
        };
        self.switcher.gradients = [here, there];
        touches
    }

    /// Whether the gradient of the gap of contact `c`, or what constraints leave free of it, depends on the state.
    pub(super) fn gradient_varies(&self, c: usize) -> bool {
        let d = self.description();
        let mut rows = self.acting_constraints().chain([d.contacts[c].row]);
        rows.any(|row| !d.rows[row].is_constant())
    }

    /// The rows of the constraints that act in the mode.
    fn acting_constraints(&self) -> impl Iterator<Item = usize> {
        let acting = self.dynamics.acting_rows();
        let constraints = self.description().constraints.iter();
        let rows = constraints.map(|constraint| constraint.row);
        rows.filter(|row| acting.binary_search(row).is_ok())
    }

    /// Writes the part of the gradient of a row that the constraints leave free behind an orthogonal basis of theirs; the size of the whole gradient.
    fn free_gradient(&self, row: usize, list: &mut Vec<f64>) -> f64 {
        let d = self.description();
        let n = self.now.state.q.len();
        list.clear();
        let mut whole = 0.0;
        for of in self.acting_constraints().chain([row]) {
            let first = list.len();
            list.resize(first + n, 0.0);
            let (basis, part) = list.split_at_mut(first);
            for &(j, place) in d.rows[of].jacobian {
                part[j] += self.dynamics.motion(place).value();
            }
            whole = norm(part);
            // Twice, for once leaves what rounding makes of the basis.
            for along in basis.chunks_exact(n).chain(basis.chunks_exact(n)) {
                let share: f64 = along.iter().zip(&*part).map(|(a, b)| a * b).sum();
                part.iter_mut()
                    .zip(along)
                    .for_each(|(part, a)| *part -= share * a);
            }
            let left = norm(part);
            if of != row && left > DEPENDENT * whole {
                part.iter_mut().for_each(|part| *part /= left);
            } else if of != row {
                list.truncate(first);
            }
        }
        whole
    }
}

/// √Σx²
fn norm(list: &[f64]) -> f64 {
    list.iter().map(|x| x * x).sum::<f64>().sqrt()
}
