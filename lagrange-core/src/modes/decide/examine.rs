//! Whether one candidate mode is feasible: its guards just after the instant.

use super::{Decider, Known, Moment};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, NeedSet};
use crate::integrate::{Tolerance, taylor};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::table::Table;
use crate::system::{Normal, System};

/// Order of the series that are looked at first. Leading coefficients beyond it vanish rarely.
const LOW_ORDER: usize = 4;

impl Decider {
    /// Whether `mode` is feasible; if so, `zeros` says which guards begin with how many vanishing coefficients.
    pub(super) fn examine<S: System>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        table: &mut Table,
        moment: Moment<'_, S::Scalar>,
        mode: &Mode,
        known: &Known,
        last: bool,
    ) -> Result<bool, EvaluationError> {
        let Moment { t, q, v, .. } = moment;
        self.posed.clone_from(mode);
        self.forks = false;
        if mode.has_incipient_slip() && !self.find_directions(dynamics, table, moment)? {
            return Ok(false);
        }
        dynamics.set_mode(&self.posed);
        let mode = &self.posed;
        let watched = table.of(dynamics);
        dynamics.set_extra_needs(&watched.deciding);
        let serves = watched.deciding == watched.needs;
        list_questions::<S>(mode, known, &watched.deciding, &mut self.questions);
        // Most candidates are refused, and many accepted, by their values already.
        dynamics.value(t, q, v)?;
        self.sizes.take(dynamics);
        let mut refused = false;
        let Self {
            sizes,
            questions,
            zeros,
            ..
        } = self;
        zeros.clear();
        questions.retain(|&(guard, order_known)| {
            if matches!((guard, order_known), (Guard::Gap(_), 1)) {
                // It parts: that is known.
                zeros.push((guard, 1));
                return false;
            }
            let Some(value) = leading(guard, order_known, mode, dynamics) else {
                return true;
            };
            let noise = if concerns(guard, known) {
                1e3 * moment.blur(known)
            } else {
                1e-6
            };
            let size = sizes.of(guard, dynamics);
            if matches!(guard, Guard::Bearing(_)) && concerns(guard, known) && size <= value.abs() {
                // Nothing to compare it with: all forces may vanish at this instant.
                return true;
            }
            let clear = noise.max(1e-6) * size;
            refused |= value < -clear;
            let settled = clear > 0.0 && value > clear;
            if settled && order_known > 0 {
                zeros.push((guard, order_known));
            }
            !settled
        });
        if refused || questions.is_empty() {
            return Ok(!refused);
        }
        let settled = zeros.len();
        let low = if last {
            moment.order
        } else {
            LOW_ORDER.min(moment.order)
        };
        for order in [low, moment.order] {
            dynamics.series(t, q, v, order)?;
            self.decision.expanded = serves && order == moment.order;
            match self.judge(dynamics, moment, known, order) {
                Some(feasible) => return Ok(feasible),
                None => self.zeros.truncate(settled),
            }
        }
        Ok(true)
    }

    /// Looks at the guards in question just after the moment. `None`: one of them vanishes to this order, and more is to
    /// be had.
    fn judge<S: System>(
        &mut self,
        dynamics: &Dynamics<S>,
        moment: Moment<'_, S::Scalar>,
        known: &Known,
        order: usize,
    ) -> Option<bool> {
        let Moment { tolerance, .. } = moment;
        let last = order == moment.order;
        // A low order's last coefficient is small enough at the same step for a loose tolerance only.
        let allowed = Tolerance::both(if last { tolerance } else { 1e-3 });
        let step = taylor::step_size(dynamics, order, allowed);
        let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=order];
        let mut unclear = false;
        for &(guard, order_known) in &self.questions {
            guard::series(guard, &self.posed, &Reading::Series(dynamics), series);
            let mut power = 1.0;
            let mut size = 0.0_f64;
            for (k, c) in series.iter_mut().enumerate() {
                *c = if k < order_known { 0.0 } else { *c * power };
                power *= h;
                size = size.max(c.abs());
            }
            // The residue of a located root, and what follows from it, has the size of the integration error.
            let blurred = concerns(guard, known);
            let (relative, absolute) = if blurred {
                ((100.0 * tolerance).clamp(1e-11, 1e-3), moment.blur(known))
            } else {
                (1e-13, 1e-14)
            };
            let cancelling = self.sizes.of(guard, dynamics) * unit_of_order(guard, h);
            let noise = (relative * size).max(absolute * cancelling);
            match series.iter().position(|c| c.abs() > noise) {
                None if !last => unclear = true,
                // Identically zero: the boundary is not left.
                None => {
                    if order_known > 0 || series.iter().all(|c| *c <= 0.0) || blurred {
                        self.zeros.push((guard, guard::LENGTH));
                    }
                }
                Some(k) if series[k] < 0.0 => return Some(false),
                Some(0) => {}
                Some(k) => self.zeros.push((guard, k)),
            }
        }
        (!unclear).then_some(true)
    }
}

/// The first coefficient of a guard that is not known to vanish, times its factorial, as far as values tell.
fn leading<S: System>(
    guard: Guard,
    order_known: usize,
    mode: &Mode,
    dynamics: &Dynamics<S>,
) -> Option<f64> {
    let d = S::DESCRIPTION;
    let acceleration = |row: usize| row_acceleration(row, dynamics);
    match (guard, order_known) {
        (_, 0) => Some(guard::value(guard, mode, &Reading::Values(dynamics))),
        (Guard::Gap(c), 2) => Some(acceleration(d.contacts[c].row)),
        (Guard::Slip(f), 1) => match mode.frictions[f] {
            FrictionMode::Slip(Sliding {
                direction: Direction::Fixed([sign, 0.0]),
                ..
            }) => Some(sign * acceleration(d.frictions[f].row)),
            FrictionMode::Slip(Sliding {
                direction: Direction::Incipient([x, y]),
                ..
            }) => {
                let row = d.frictions[f].row;
                Some(x * acceleration(row) + y * acceleration(row + 1))
            }
            _ => None,
        },
        _ => None,
    }
}

/// a v̇ + γ of a row at the last value.
pub(super) fn row_acceleration<S: System>(row: usize, dynamics: &Dynamics<S>) -> f64 {
    let row = &S::DESCRIPTION.rows[row];
    let products = row.jacobian.iter().map(|&(j, place)| {
        let a = dynamics.motion(place) * dynamics.acceleration()[j];
        a.value()
    });
    dynamics.motion(row.bias).value() + products.sum::<f64>()
}

/// The guards that can be violated just after the instant, with the number of coefficients known to vanish; `held` are
/// the needs that are evaluated.
fn list_questions<S: System>(
    mode: &Mode,
    known: &Known,
    held: &NeedSet,
    list: &mut Vec<(Guard, usize)>,
) {
    let d = S::DESCRIPTION;
    list.clear();
    for c in 0..d.contacts.len() {
        if mode.contacts[c] {
            list.push((Guard::Normal(c), 0));
        } else if known.touching[c] {
            list.push((Guard::Gap(c), 2));
        } else if known.parting[c] {
            list.push((Guard::Gap(c), 1));
        }
    }
    for f in 0..d.frictions.len() {
        match mode.frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => {
                list.extend(guard::stick_guards(f, &d.frictions[f]).map(|g| (g, 0)));
            }
            FrictionMode::Slip(_) => {
                if known.resting[f] {
                    list.push((Guard::Slip(f), 1));
                }
                if let Normal::Constraint(_) = d.frictions[f].normal {
                    list.push((Guard::Bearing(f), 0));
                }
            }
        }
    }
    for b in 0..d.branches.len() {
        // What nothing in this mode uses decides nothing.
        if known.balanced[b] && held.contains(d.branches[b].need) {
            list.push((Guard::Branch(b), 1));
        }
    }
}

/// Whether a guard's leading coefficients carry the error of a located root: it is that root, or belongs to the
/// same contact (in the mode after, gap and slip accelerations vanish with the force that was located).
fn concerns(guard: Guard, known: &Known) -> bool {
    known.located.iter().any(|root| {
        *root == guard
            || match (*root, guard) {
                (Guard::Normal(c), Guard::Gap(g)) | (Guard::Gap(c), Guard::Normal(g)) => c == g,
                (
                    Guard::StickUpper(f)
                    | Guard::StickLower(f)
                    | Guard::StickCone(f)
                    | Guard::Slip(f)
                    | Guard::Bearing(f),
                    Guard::Slip(g)
                    | Guard::StickUpper(g)
                    | Guard::StickLower(g)
                    | Guard::StickCone(g)
                    | Guard::Bearing(g),
                ) => f == g,
                _ => false,
            }
    })
}

/// Powers of h that turn an acceleration or force scale into the unit of the guard.
fn unit_of_order(guard: Guard, h: f64) -> f64 {
    match guard {
        Guard::Gap(_) => h * h,
        Guard::Slip(_) => h,
        _ => 1.0,
    }
}
