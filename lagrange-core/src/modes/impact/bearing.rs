//! Frictions that several constraints press together: N = √ΣΛ², the impulse of a bearing.
//!
//! The rows of the constraints are turned so that the first one has the direction u of the impulse, and the others none: N is then |Λ| of one row.
//! To solve with u and to take it anew from the impulses found is Newton's method, as for forces ([`crate::dynamics`]).

use super::collision::{Collision, NormalSource};
use super::pattern::{Pattern, Phase, ROUNDING};
use super::search::Search;
use crate::arithmetic::Scalar;

/// What is across of an impulse, as a part of it, where u has its direction: N misses its square.
const ALONG: f64 = 1e-13;

/// Where that no longer shrinks, this is as good.
const FOUND: f64 = 1e-6;

/// So often is a direction taken anew.
const MOST_TURNS: usize = 60;

/// Rows that press together, two or three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bearing {
    rows: [usize; 3],
    count: usize,
}

/// Orthonormal axes, as many as there are rows; the first is u.
type Axes<T> = [[T; 3]; 3];

impl Bearing {
    /// Of these rows, if all are there.
    pub fn of(rows: &mut dyn Iterator<Item = Option<usize>>) -> Option<Self> {
        let mut bearing = Self {
            rows: [0; 3],
            count: 0,
        };
        for row in rows {
            *bearing.rows.get_mut(bearing.count)? = row?;
            bearing.count += 1;
        }
        (bearing.count > 0).then_some(bearing)
    }

    /// The row that takes the direction of the impulse.
    pub fn first(&self) -> usize {
        self.rows[0]
    }

    fn rows(&self) -> &[usize] {
        &self.rows[..self.count]
    }

    /// Turns numbers of rows, `stride` apart, to the axes or `back` from them.
    fn turn<T: Scalar>(&self, axes: &Axes<T>, numbers: &mut [T], stride: usize, back: bool) {
        let held = self.rows.map(|row| numbers[row * stride]);
        for (i, &row) in self.rows().iter().enumerate() {
            let mut sum = T::zero();
            for (j, &x) in held[..self.count].iter().enumerate() {
                sum += if back { axes[j][i] } else { axes[i][j] } * x;
            }
            numbers[row * stride] = sum;
        }
    }

    /// The impulse in the rows.
    fn impulse<T: Scalar>(&self, impulses: &[T]) -> [T; 3] {
        let mut impulse = [T::zero(); 3];
        for (x, &row) in impulse.iter_mut().zip(self.rows()) {
            *x = impulses[row];
        }
        impulse
    }

    /// Axes whose first is along `u`, which is no longer than it has elements.
    fn axes<T: Scalar>(&self, u: [T; 3]) -> Axes<T> {
        let mut axes = [u, [T::zero(); 3], [T::zero(); 3]];
        if self.count == 2 {
            axes[1] = [-u[1], u[0], T::zero()];
            return axes;
        }
        // The unit vector most across of u, made orthogonal; then the product of both.
        let least = (0..3).min_by(|&i, &j| {
            let size = |k: usize| u[k].value().abs();
            size(i).total_cmp(&size(j))
        });
        let least = least.unwrap_or(0);
        let mut across = u.map(|x| -u[least] * x);
        across[least] += T::one();
        let length = length(across);
        axes[1] = across.map(|x| x / length);
        let [a, b] = [axes[0], axes[1]];
        axes[2] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i]);
        axes
    }
}

fn length<T: Scalar>(x: [T; 3]) -> T {
    (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()
}

/// A collision with its bearings turned.
#[derive(Clone, Debug, Default)]
pub(super) struct Turned<T> {
    collision: Collision<T>,
    phase: Phase<T>,
    axes: Vec<Axes<T>>,
}

impl<T: Scalar> Turned<T> {
    fn begin(&mut self, c: &Collision<T>) {
        let mut first = [T::zero(); 3];
        first[0] = T::one();
        self.axes.clear();
        self.axes
            .extend(c.bearings.iter().map(|bearing| bearing.axes(first)));
    }

    /// Turns a collision to the axes; `pressed`: with the frictions that bearings press.
    fn turn(&mut self, c: &Collision<T>, phase: &Phase<T>, pressed: bool) {
        self.collision.clone_from(c);
        self.phase.clone_from(phase);
        let n = c.size;
        for (bearing, axes) in c.bearings.iter().zip(&self.axes) {
            for k in 0..n {
                bearing.turn(axes, &mut self.collision.response[k * n..][..n], 1, false);
            }
            for k in 0..n {
                bearing.turn(axes, &mut self.collision.response[k..], n, false);
            }
            bearing.turn(axes, &mut self.phase.rates, 1, false);
            bearing.turn(axes, &mut self.collision.rates, 1, false);
            let terms = &mut self.collision.terms;
            let largest = bearing.rows().iter().map(|&row| terms[row]);
            let largest = largest.fold(0.0, f64::max);
            bearing.rows().iter().for_each(|&row| terms[row] = largest);
            for rub in &mut self.collision.rubs {
                if rub.bearer == NormalSource::ConstraintRow(bearing.first()) && !pressed {
                    (rub.stick, rub.slide) = (T::zero(), T::zero());
                }
            }
        }
    }

    /// Turns the axes to where the impulses point. Returns how far they did not.
    fn follow(&mut self, found: &Pattern<T>) -> f64 {
        let Self {
            collision: c, axes, ..
        } = self;
        let sizes = found.impulses.iter().enumerate();
        let effort: f64 = sizes.map(|(j, x)| c.strength(j) * x.value().abs()).sum();
        let mut most = 0.0_f64;
        for (bearing, axes) in c.bearings.iter().zip(axes) {
            let turned = bearing.impulse(&found.impulses);
            let size = length(turned.map(|x| T::from_f64(x.value()))).value();
            let strengths = bearing.rows().iter().map(|&row| c.strength(row));
            if !(size * strengths.fold(0.0, f64::max) > ROUNDING * effort) {
                continue;
            }
            let across = length([T::zero(), turned[1], turned[2]].map(|x| T::from_f64(x.value())));
            most = most.max(across.value() / size);
            let long = length(turned);
            let mut u = [T::zero(); 3];
            for (axis, part) in axes.iter().zip(turned) {
                for (u, &x) in u.iter_mut().zip(axis) {
                    *u += part / long * x;
                }
            }
            *axes = bearing.axes(u);
        }
        most
    }
}

impl<T: Scalar> Search<T> {
    /// [`Search::find`] where bearings press frictions.
    pub(super) fn find_turned(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let mut turned = core::mem::take(&mut self.turned);
        let found = self.turn_until_settled(&mut turned, c, phase);
        self.turned = turned;
        found
    }

    fn turn_until_settled(
        &mut self,
        turned: &mut Turned<T>,
        c: &Collision<T>,
        phase: &Phase<T>,
    ) -> bool {
        turned.begin(c);
        let mut least = f64::INFINITY;
        // The derivatives of a direction follow from those of the impulses found with it.
        let mut more = usize::from(T::DERIVATIVES > 0);
        for turn in 0..MOST_TURNS {
            turned.turn(c, phase, turn > 0);
            if !self.find_straight(&turned.collision, &turned.phase) {
                return false;
            }
            let axes = turned.axes.clone();
            let across = turned.follow(&self.pattern);
            if turn == 0 {
                continue;
            }
            if across <= ALONG || across < FOUND && across >= 0.5 * least {
                if more == 0 {
                    self.turn_back(c, &axes);
                    return true;
                }
                more -= 1;
            }
            least = least.min(across);
        }
        false
    }

    /// Turns what was found back to the rows.
    fn turn_back(&mut self, c: &Collision<T>, axes: &[Axes<T>]) {
        let Self {
            pattern, others, ..
        } = self;
        // Another impact has another direction: what was pressed along this one obeys the law.
        others.retain(|other| {
            c.bearings.iter().all(|bearing| {
                let [along, rest @ ..] = bearing.impulse(&other.impulses);
                let rest = rest.map(|x| x.value().abs());
                rest[0].max(rest[1]) <= FOUND * along.value().abs()
            })
        });
        for found in others.iter_mut().chain([pattern]) {
            for (bearing, axes) in c.bearings.iter().zip(axes) {
                bearing.turn(axes, &mut found.impulses, 1, true);
                bearing.turn(axes, &mut found.after, 1, true);
            }
        }
    }
}
