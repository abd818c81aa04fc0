//! From the equations of motion at one state to a [`Collision`], and from its impulses back to velocities.

use super::Impact;
use super::bearing::Bearing;
use super::collision::{Collision, ContactRow, FrictionRow, NormalSource};
use super::pattern::ROUNDING;
use crate::arithmetic::{Scalar, rounding};
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::linear::{Equilibrated, Rank, least_norm};
use crate::mode::FrictionMode;
use crate::system::{Normal, Restitution, ValueRef};

/// A coordinate that by its own inertia would move so many times as far as what constraints tie it to has hardly any.
const HARDLY: f64 = 1e3;

/// An inertia below this share of the largest is none to speak of.
const NO_INERTIA: f64 = 1e-12;

/// What stands between coordinates and rows; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathering<T> {
    /// Description's row of every row of the collision.
    rows: Vec<usize>,
    /// Per row: the rate vanishes before the impact, whatever rounding says.
    at_rest: Vec<bool>,
    /// Bilateral rows that are solved with M.
    bilateral: Vec<usize>,
    /// Dense Jacobian of `rows`, then of `bilateral`.
    jacobian: Vec<T>,
    /// [M −Bᵀ; B 0], scaled on both sides: inertias come to 1, and so do rows of B beside them, whatever units make of masses.
    matrix: Vec<T>,
    /// By what.
    scale: Vec<f64>,
    /// The matrix while it is factored.
    factored: Vec<T>,
    factors: Equilibrated<T>,
    rest: Vec<T>,
    /// (Δv, Λ of `bilateral`) of a unit impulse in every row.
    answers: Vec<T>,
    /// The same of what takes away the rates that errors of the run have left `bilateral` with.
    correction: Vec<T>,
}

impl<T: Scalar> Gathering<T> {
    /// Describes the impact of the contacts `near` at velocities `v`. False if an impulse has no finite effect.
    pub fn collect(
        &mut self,
        dynamics: &Dynamics<T>,
        v: &[T],
        near: &[usize],
        out: &mut Collision<T>,
    ) -> bool {
        self.list_rows(dynamics, near, out);
        let d = dynamics.description();
        let n = d.coordinates.len();
        let bilateral = self.bilateral.len();
        let size = n + bilateral;
        out.size = self.rows.len();
        if !self.answer(dynamics) {
            return false;
        }
        self.correct(dynamics);
        out.response.clear();
        out.rates.clear();
        out.terms.clear();
        out.drift = 0.0;
        for i in 0..out.size {
            let a = &self.jacobian[i * n..(i + 1) * n];
            for k in 0..out.size {
                let change = &self.answers[k * size..k * size + n];
                out.response.push(dot(a, change));
            }
            let rate = dynamics.motion(d.rows[self.rows[i]].velocity);
            let rate = rate + dot(a, &self.correction[..n]);
            let strength = out.strength(i);
            if self.at_rest[i] && strength > 0.0 {
                out.drift = out.drift.max(rate.value().abs() / strength);
            }
            out.rates
                .push(if self.at_rest[i] { T::zero() } else { rate });
            let terms = a.iter().zip(v).enumerate();
            let terms =
                terms.map(|(j, (a, v))| a.value().abs() * (v.value().abs() + dynamics.at_rest(j)));
            out.terms.push(terms.sum());
        }
        for i in 0..out.size {
            if !self.is_bound(i, out.g(i, i).value()) {
                continue;
            }
            for k in 0..out.size {
                out.response[i * out.size + k] = T::zero();
                out.response[k * out.size + i] = T::zero();
            }
        }
        true
    }

    /// Whether constraints leave nothing of a row but rounding, so that no impulse in it has an effect: the slip of a disc on a belt that is geared to it.
    /// The velocities that an impulse causes are rounding beside those that it would cause without constraints, or lie across the row.
    fn is_bound(&self, row: usize, response: f64) -> bool {
        if self.bilateral.is_empty() {
            return false;
        }
        let size = self.scale.len();
        let n = size - self.bilateral.len();
        let a = &self.jacobian[row * n..][..n];
        let changes = &self.answers[row * size..][..n];
        let inertia = |j: usize| self.matrix[j * size + j].value().abs() / self.scale[j].powi(2);
        let least = NO_INERTIA * (0..n).map(inertia).fold(0.0, f64::max);
        let (mut along, mut moved) = (0.0, 0.0);
        for (j, (a, change)) in a.iter().zip(changes).enumerate() {
            // In units in which the coordinate has a mass of 1, if it has one to speak of.
            let unit = match inertia(j) {
                mass if mass > least => mass.sqrt().recip(),
                _ => self.scale[j],
            };
            along += (a.value() * unit).powi(2);
            moved += (change.value() / unit).powi(2);
        }
        let rounding = rounding::<T>(ROUNDING);
        let (along, moved) = (along.sqrt(), moved.sqrt());
        moved <= rounding * along || response.abs() <= rounding * along * moved
    }

    /// What a unit impulse of each row does; false if that is not finite.
    fn answer(&mut self, dynamics: &Dynamics<T>) -> bool {
        let d = dynamics.description();
        let n = d.coordinates.len();
        let (count, bilateral) = (self.rows.len(), self.bilateral.len());
        let size = n + bilateral;
        self.jacobian.clear();
        self.jacobian.resize((count + bilateral) * n, T::zero());
        let all = self.rows.iter().chain(&self.bilateral);
        for (&row, a) in all.zip(self.jacobian.chunks_exact_mut(n.max(1))) {
            for &(j, place) in d.rows[row].jacobian {
                a[j] = dynamics.motion(place);
            }
        }
        // [M −Bᵀ; B 0]
        self.matrix.clear();
        self.matrix.resize(size * size, T::zero());
        for &(i, j, place) in d.mass {
            self.matrix[i * size + j] = dynamics.motion(place);
            self.matrix[j * size + i] = dynamics.motion(place);
        }
        for k in 0..bilateral {
            for j in 0..n {
                let a = self.jacobian[(count + k) * n + j];
                self.matrix[(n + k) * size + j] = a;
                self.matrix[j * size + n + k] = -a;
            }
        }
        self.find_scale(n, count);
        let rows = self.matrix.chunks_exact_mut(size.max(1));
        for (row, &own) in rows.zip(&self.scale) {
            for (x, &other) in row.iter_mut().zip(&self.scale) {
                *x *= T::from_f64(own * other);
            }
        }
        self.factored.clone_from(&self.matrix);
        self.factors.factor(&mut self.factored, size);
        let mut answers = core::mem::take(&mut self.answers);
        answers.clear();
        answers.resize(count * size, T::zero());
        let solved = (0..count).all(|k| {
            let answer = &mut answers[k * size..(k + 1) * size];
            answer[..n].copy_from_slice(&self.jacobian[k * n..(k + 1) * n]);
            self.solve(answer)
        });
        self.answers = answers;
        solved
    }

    /// Finds the scale of coordinates and of bilateral rows, which follow `count` others in the Jacobian.
    fn find_scale(&mut self, n: usize, count: usize) {
        let bilateral = self.bilateral.len();
        let size = n + bilateral;
        let inverse = |size: f64| if size > 0.0 { size.recip() } else { 1.0 };
        let b = |k: usize, j: usize| self.jacobian[(count + k) * n + j].value();
        let inertia = |j: usize| self.matrix[j * size + j].value().abs();
        let scale = &mut self.scale;
        scale.clear();
        scale.extend((0..n).map(|j| match inertia(j) > 0.0 {
            true => inertia(j).sqrt().recip(),
            false => 0.0,
        }));
        let length = |scale: &[f64], k: usize, except: usize| {
            let others = (0..n).filter(|&j| j != except);
            let parts = others.map(|j| (b(k, j) * scale[j]).powi(2));
            parts.sum::<f64>().sqrt()
        };
        // What has hardly any inertia of its own moves as far as what it is tied to: the real part of a quaternion near its unit.
        let own = match bilateral {
            0 => Vec::new(),
            _ => scale.clone(),
        };
        for (j, &own_scale) in own.iter().enumerate().filter(|(_, own)| **own > 0.0) {
            let ties = (0..bilateral).filter(|&k| b(k, j) != 0.0);
            let moves = ties.map(|k| length(&own, k, j) / b(k, j).abs());
            let moves = moves.filter(|moves| *moves > 0.0);
            let moves = moves.fold(f64::INFINITY, f64::min);
            if own_scale > HARDLY * moves {
                scale[j] = moves;
            }
        }
        let length = |scale: &[f64], k: usize| length(scale, k, n);
        // What has no inertia of its own is measured by what constraints tie it to.
        let lengths: Vec<f64> = (0..bilateral).map(|k| length(scale, k)).collect();
        for j in (0..n).filter(|&j| inertia(j) == 0.0) {
            let ties = (0..bilateral).map(|k| b(k, j).abs() * inverse(lengths[k]));
            scale[j] = inverse(ties.fold(0.0, f64::max));
        }
        let rows = (0..bilateral).map(|k| inverse(length(scale, k)));
        let rows: Vec<f64> = rows.collect();
        scale.extend(rows);
    }

    /// Replaces a right-hand side by the solution, with one step of refinement: each equation then holds to rounding of its own terms (Skeel 1980,
    /// Mathematics of Computation 35, 817). False if it has none.
    fn solve(&mut self, b: &mut [T]) -> bool {
        let size = b.len();
        let scaled = |b: &mut [T], scale: &[f64]| {
            let pairs = b.iter_mut().zip(scale);
            pairs.for_each(|(b, &scale)| *b *= T::from_f64(scale));
        };
        let mut rest = core::mem::take(&mut self.rest);
        scaled(b, &self.scale);
        rest.clear();
        rest.extend_from_slice(b);
        let solved = self.factors.solve(b);
        if solved {
            for (rest, row) in rest.iter_mut().zip(self.matrix.chunks_exact(size)) {
                *rest -= dot(row, b);
            }
            if self.factors.solve(&mut rest) {
                b.iter_mut().zip(&rest).for_each(|(x, &more)| *x += more);
            }
        }
        self.rest = rest;
        scaled(b, &self.scale);
        solved
    }

    /// Finds what takes away the rates of bilateral rows, whose rate vanishes after an impact: where rows depend on one another by them, as
    /// slips of two corners of a body by the unit length of its quaternion, no impulse would stop all.
    fn correct(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let n = d.coordinates.len();
        let mut correction = core::mem::take(&mut self.correction);
        correction.clear();
        correction.resize(n, T::zero());
        let rates = self.bilateral.iter();
        correction.extend(rates.map(|&row| -dynamics.motion(d.rows[row].velocity)));
        if !self.solve(&mut correction) {
            correction.fill(T::zero());
        }
        self.correction = correction;
    }

    /// Which rows there are.
    fn list_rows(&mut self, dynamics: &Dynamics<T>, near: &[usize], out: &mut Collision<T>) {
        let d = dynamics.description();
        self.rows.clear();
        self.at_rest.clear();
        self.bilateral.clear();
        out.conditional.clear();
        out.touches.clear();
        out.rubs.clear();
        out.bearings.clear();
        self.list_constraints(dynamics, near, out);
        for &c in near {
            let restitution = d.contacts[c].restitution;
            out.touches.push(ContactRow {
                contact: c,
                row: self.rows.len(),
                restitution: dynamics.motion(restitution.place()),
                poisson: matches!(restitution, Restitution::Poisson(_)),
            });
            self.rows.push(d.contacts[c].row);
            self.at_rest.push(dynamics.mode().contacts[c]);
        }
        for f in frictions(dynamics) {
            self.list_friction(dynamics, f, near, out);
        }
    }

    /// Constraints that always act and carry friction, then those of contacts that are hit; the others are solved with M.
    fn list_constraints(&mut self, dynamics: &Dynamics<T>, near: &[usize], out: &mut Collision<T>) {
        let d = dynamics.description();
        let carries = |i: usize| {
            frictions(dynamics).any(|f| d.frictions[f].normal.constraints(d).any(|c| c == i))
        };
        let included = |i: &usize| dynamics.effects().includes(d, Item::Constraint(*i));
        let constraints = || (0..d.constraints.len()).filter(included);
        for i in constraints().filter(|i| d.constraints[*i].while_contact.is_none()) {
            match carries(i) {
                true => self.rows.push(d.constraints[i].row),
                false => self.bilateral.push(d.constraints[i].row),
            }
        }
        out.links = self.rows.len();
        self.at_rest.resize(out.links, true);
        for i in constraints() {
            let constraint = &d.constraints[i];
            let place = |c| near.iter().position(|n| *n == c);
            if let Some(touch) = constraint.while_contact.and_then(place) {
                out.conditional.push((self.rows.len(), touch));
                self.rows.push(constraint.row);
                self.at_rest.push(dynamics.mode().contacts[near[touch]]);
            }
        }
    }

    /// A friction, if what it rubs on takes part.
    fn list_friction(
        &mut self,
        dynamics: &Dynamics<T>,
        f: usize,
        near: &[usize],
        out: &mut Collision<T>,
    ) {
        let d = dynamics.description();
        let friction = &d.frictions[f];
        let constraints = &self.rows[..out.links + out.conditional.len()];
        let (bearer, factor) = match friction.normal {
            Normal::Contact(c) => (
                near.iter()
                    .position(|n| *n == c)
                    .map(NormalSource::ContactRow),
                d.contacts[c].normal_factor,
            ),
            Normal::Constraint(i) => {
                let row = d.constraints[i].row;
                let among = constraints.iter().position(|r| *r == row);
                (among.map(NormalSource::ConstraintRow), None)
            }
            normal @ Normal::Resultant(_) => {
                let rows = normal.rows(d);
                let mut among = rows.map(|row| constraints.iter().position(|r| *r == row));
                // All of them are there, or none is.
                let bearing = Bearing::of(&mut among);
                if let Some(bearing) = bearing.filter(|new| !out.bearings.contains(new)) {
                    out.bearings.push(bearing);
                }
                (
                    bearing.map(|b| NormalSource::ConstraintRow(b.first())),
                    None,
                )
            }
            // A given force is finite: it does nothing in no time.
            Normal::Given(_) => (None, None),
        };
        let Some(bearer) = bearer else {
            return;
        };
        let of_constraint = matches!(bearer, NormalSource::ConstraintRow(_));
        let contact = friction.normal.contact(d).filter(|_| of_constraint);
        out.rubs.push(FrictionRow {
            friction: f,
            row: self.rows.len(),
            components: friction.components,
            bearer,
            while_touch: contact.and_then(|c| near.iter().position(|n| *n == c)),
            factor: factor.map_or(T::one(), |place: ValueRef| dynamics.motion(place)),
            stick: dynamics.motion(friction.static_coefficient),
            slide: dynamics.motion(friction.kinetic_coefficient),
        });
        self.rows.extend(friction.rows());
        let sticks = dynamics.mode().frictions[f] == FrictionMode::Stick;
        self.at_rest.resize(self.rows.len(), sticks);
    }

    /// Velocities after the impulses of the rows, and the impulses of all rows of the description.
    ///
    /// A velocity of which only rounding is left is zero: it would turn a plate that falls flat, and one edge of it would be the first to
    /// touch next time.
    pub fn apply(&self, impulses: &[T], v: &[T], out: &mut Impact<T>) {
        let n = v.len();
        let bilateral = self.bilateral.len();
        let size = n + bilateral;
        let (change, along) = self.correction.split_at(n);
        out.v.clear();
        out.v.extend(v.iter().zip(change).map(|(&v, &x)| v + x));
        out.impulses.fill(T::zero());
        for (&row, &impulse) in self.bilateral.iter().zip(along) {
            out.impulses[row] = impulse;
        }
        for (k, answer) in self.answers.chunks_exact(size.max(1)).enumerate() {
            let share = impulses[k];
            if share.is_zero() {
                continue;
            }
            for (v, &change) in out.v.iter_mut().zip(answer) {
                *v += share * change;
            }
            for (&row, &impulse) in self.bilateral.iter().zip(&answer[n..]) {
                out.impulses[row] += share * impulse;
            }
        }
        for (j, after) in out.v.iter_mut().enumerate() {
            let answers = self.answers.chunks_exact(size.max(1)).zip(impulses);
            let changes: f64 = answers
                .map(|(answer, &share)| (share * answer[j]).value().abs())
                .sum();
            if after.value().abs() <= rounding::<T>(ROUNDING) * (v[j].value().abs() + changes) {
                *after -= T::from_f64(after.value());
            }
        }
        for (&row, &impulse) in self.rows.iter().zip(impulses) {
            out.impulses[row] = impulse;
        }
        if self.factors.is_deficient() {
            // Of constraints that depend on each other.
            let columns = &self.jacobian[self.rows.len() * n..];
            let mut shared: Vec<T> = self
                .bilateral
                .iter()
                .map(|&row| out.impulses[row])
                .collect();
            least_norm(columns, n, Rank::Numerical, &mut shared);
            for (&row, impulse) in self.bilateral.iter().zip(shared) {
                out.impulses[row] = impulse;
            }
            out.undetermined = true;
        }
    }
}

/// Frictions that are not left out.
fn frictions<T: Scalar>(dynamics: &Dynamics<T>) -> impl Iterator<Item = usize> + '_ {
    let d = dynamics.description();
    (0..d.frictions.len()).filter(move |&f| dynamics.effects().includes(d, Item::Friction(f)))
}

fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter()
        .zip(b)
        .fold(T::zero(), |sum, (&a, &b)| a.mul_add(b, sum))
}
