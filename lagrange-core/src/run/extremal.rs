//! Constraints that hold only where they are smallest or largest, as a square or a distance that is zero, or a cosine that is one.
//!
//! Where such an equation holds it has no derivative along what the others leave free, so no force could keep it. It shows around the start: on
//! all sides what should be zero has the same sign. Where two branches of positions cross, as at a dead centre, it has both.

use super::Run;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::Mode;
use crate::modes::guard;

/// Positions are moved by this share of their size.
const AWAY: f64 = 1e-3;

/// In so many directions.
const DIRECTIONS: usize = 24;

/// What is left of a residual below this share of its terms is what projections leave; a repeated condition leaves no more.
const LEFT: f64 = 1e-11;

/// A constraint that is extremal at the start is farther from holding around it by this factor.
const FARTHER: f64 = 2.0;

impl<T: Scalar> Run<T> {
    /// The error that names a constraint which is extremal at the start, if that is why the motion came to this `error`.
    pub(super) fn extremal_constraint(&mut self, error: &Error) -> Option<Error> {
        let d = self.description();
        let (all, time) = (self.settings.effects.clone(), self.begin);
        let is_named = |name: &str| match error {
            Error::Singular { items, .. } => items.contains(&name),
            Error::Projection { item, .. } => *item == name,
            // A distance that is zero has no derivative at all.
            Error::NotFinite { time, .. } => *time == self.begin,
            _ => false,
        };
        let suspects = (0..d.constraints.len()).filter(|&i| {
            let constraint = &d.constraints[i];
            let of_positions = d.rows[constraint.row].position.is_some();
            is_named(constraint.name)
                && of_positions
                && constraint.attitude.is_none()
                && all.includes(d, Item::Constraint(i))
        });
        let suspects: Vec<usize> = suspects.collect();
        if suspects.is_empty() {
            return None;
        }
        let mut whole = Dynamics::of(self.dynamics.system().clone(), &all);
        whole.set_extra_needs(&guard::all_row_needs(d, whole.motion_needs()));
        let found = suspects
            .into_iter()
            .find(|&i| self.is_extremal(&mut whole, i))?;
        let name = d.constraints[found].name;
        Some(Error::Singular {
            time,
            mode: Mode::open(d).display(d).to_string(),
            items: vec![name],
            reason: "the equation holds only where the difference of its sides is smallest or largest, as a square that is 0 or a cosine that is 1, and no \
                force can keep it there; write equations whose sides cross, one for each component"
                .to_owned(),
        })
    }

    /// Goes back to the start: a constraint that is extremal there lets go, and what has been told since is no motion.
    pub(super) fn take_back(&mut self) {
        let record = &mut self.recorder.trajectory;
        self.now.t = record.first_time;
        self.now.state.clone_from(&record.start);
        self.now.mode.clone_from(&record.modes[0]);
        record.begin(self.now.t, &self.now.state, &self.now.mode);
    }

    /// Whether constraint `i` has one sign around the start, on what satisfies the others.
    fn is_extremal(&mut self, whole: &mut Dynamics<T>, i: usize) -> bool {
        let d = self.description();
        let row = &d.rows[d.constraints[i].row];
        let Some(place) = row.position else {
            return false;
        };
        let effects = self.settings.effects.clone();
        let others = effects.without(Item::Constraint(i));
        let mut others = Dynamics::of(self.dynamics.system().clone(), &others);
        let (t, start) = (T::from_f64(self.begin), &self.recorder.trajectory.start);
        // It has to hold at the start, where the others do.
        let (mut q, mut v) = (start.q.clone(), start.v.clone());
        if others.project(t, &mut q, &mut v, 0.0).is_err() {
            return false;
        }
        whole.tape(t, &q, &v);
        let here = whole.motion(place).value().abs();
        let (mut lowest, mut highest) = (0.0_f64, 0.0_f64);
        let mut random = fastrand::Rng::with_seed(i as u64);
        for _ in 0..DIRECTIONS {
            let moved = start.q.iter().map(|q| {
                let part = AWAY * (2.0 * random.f64() - 1.0);
                *q + T::from_f64(part * q.value().abs().max(1.0))
            });
            let (mut q, mut v): (Vec<T>, Vec<T>) = (moved.collect(), start.v.clone());
            if others.project(t, &mut q, &mut v, 0.0).is_err() {
                return false;
            }
            whole.tape(t, &q, &v);
            let terms = row
                .jacobian
                .iter()
                .map(|&(j, place)| whole.motion(place).value().abs() * q[j].value().abs().max(1.0));
            let residual = whole.motion(place).value();
            if !(residual.abs() > LEFT * terms.sum::<f64>() + FARTHER * here) {
                return false;
            }
            (lowest, highest) = (lowest.min(residual), highest.max(residual));
        }
        (lowest < 0.0) != (highest > 0.0)
    }
}
