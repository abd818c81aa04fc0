//! Gaps without a gradient where they are zero: in which direction they change is not told by positions that have errors.

use super::Run;
use crate::arithmetic::{Scalar, rounding};

/// A gap whose rate is larger than this beside the velocities has a gradient: a share of the root of the tolerance.
const SLOW: f64 = 4.0;

/// So many times what errors of positions change a gradient by is none.
const DIRECTED: f64 = 8.0;

/// A gradient that changes by no more than this share of it where positions do stays the same.
const UNCHANGED: f64 = 1e-14;

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
        if rate.abs() > SLOW * self.settings.tolerance.sqrt() * fastest {
            return false;
        }
        let (n, positions) = (self.now.state.q.len(), &self.now.state.q);
        let allowed = |j: usize| self.settings.allowed(j, positions[j].value().abs());
        let shallow = self.dynamics.size_of_row(row, allowed);
        let error = self.settings.tolerance;
        let [mut here, mut there] = core::mem::take(&mut self.switcher.gradients);
        let whole = self.free_gradient(row, &mut here);
        let gradient = &here[here.len() - n..];
        let slope = norm(gradient);
        // Where there is hardly a gradient, its direction is rounding.
        let any = |j: usize| if j % 2 == 1 { -1.0 } else { 1.0 };
        let along = |j: usize| gradient[j] / slope;
        let touches = [&any as &dyn Fn(usize) -> f64, &along]
            .iter()
            .any(|direction| {
                let moved = |j: usize, _| T::from_f64(error * direction(j));
                self.beside(None, T::zero(), moved, |run| {
                    run.free_gradient(row, &mut there)
                });
                let pairs = gradient.iter().zip(&there[there.len() - n..]);
                let change = pairs.map(|(here, there)| (here - there).abs());
                let change = change.fold(0.0, f64::max);
                // Along a parabola of this curvature the gap falls no deeper than that.
                let bend = change / error;
                let depth = slope.powi(2) / (2.0 * bend);
                // What constraints hold closed for good touches nevertheless.
                let bends = change > rounding::<T>(UNCHANGED) * whole;
                bends && depth <= shallow.max(0.5 * (DIRECTED * error).powi(2) * bend)
            });
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
