//! What guards do just after the instant, by their series.

use super::Decider;
use super::questions::{Doubt, blame, concerns, leading, unit_of_order};
use crate::arithmetic::Scalar;
use crate::arithmetic::products::ROW;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::integrate::taylor;
use crate::integrate::{Tolerance, horner};
use crate::mode::FrictionMode;
use crate::modes::composite;
use crate::modes::facts::{EvaluationPoint, SwitchContext, SwitchFacts};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;

/// How far ahead guards at their border are looked at, in parts of the step.
pub(super) const AHEAD: f64 = 1e-2;

/// Instants are located to this share of the tolerance, in parts of what a series reaches over.
const INSTANT: f64 = 1e-3;

/// Accelerations that are all below this share of what forces make where they do not cancel are rounding of them. What that moves shows after long
/// enough: guards are looked at
const ROUNDING: f64 = 1e-12;

/// over no more than so many times the time in which those forces would move a coordinate by its unit. Series that end reach everywhere, and are looked
/// at over that time as well, whatever the unit of time is.
const TIMES: f64 = 10.0;

/// What is less than this part of what cancels in it is rounding.
const ROUNDED: f64 = 1e-14;

/// So many composite guards at most begin at their border.
const MOST_JOINTS: usize = 20;

/// What a guard does just after the instant, with the number of leading coefficients that vanish.
enum Leading {
    Rises(usize),
    Falls,
    /// Identically zero, as far as the series goes: the boundary is not left.
    Stays,
}

/// What happens after the moment, by a series of the order `order`, over times up to about `h`.
struct Ahead<'a, T: Scalar> {
    dynamics: &'a Dynamics<T>,
    here: SwitchContext<'a, T>,
    order: usize,
    h: f64,
    /// Error of a series over such a time.
    allowed: Tolerance<'a>,
}

impl<T: Scalar> Clone for Ahead<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Scalar> Copy for Ahead<'_, T> {}

impl<T: Scalar> Decider<T> {
    /// How far the series of the state at hand reach with this error, s; 1 if they end and nothing drives.
    pub(super) fn reach(
        &self,
        dynamics: &Dynamics<T>,
        order: usize,
        allowed: Tolerance<'_>,
    ) -> f64 {
        let step = taylor::step_size(dynamics.state_series(), order, allowed);
        let step = step.filter(|h| h.is_finite());
        let coordinates = (0..dynamics.acceleration().len())
            .map(|j| (j, self.sizes.of_coordinate(j)))
            .filter(|(_, size)| *size > 0.0);
        let rounding =
            |(j, size): (usize, f64)| dynamics.acceleration()[j].value().abs() <= ROUNDING * size;
        if let Some(step) = step
            && !coordinates.clone().all(rounding)
        {
            return step;
        }
        let times = coordinates.map(|(j, size)| {
            let unit = 1.0 + dynamics.position_series(j)[0].value().abs();
            TIMES * (unit / size).sqrt()
        });
        let time = times.fold(step.unwrap_or(f64::INFINITY), f64::min);
        if time.is_finite() { time } else { 1.0 }
    }

    /// What the series of this order tell.
    fn ahead<'a>(
        &self,
        dynamics: &'a Dynamics<T>,
        here: SwitchContext<'a, T>,
        order: usize,
    ) -> Ahead<'a, T> {
        let SwitchContext { moment, facts, .. } = here;
        // A low order's last coefficient is small enough at the same step for a loose tolerance only.
        let allowed = if order == moment.order {
            moment.tolerance.max(f64::EPSILON)
        } else {
            1e-3
        };
        let allowed = Tolerance::both(allowed);
        let h = self
            .reach(dynamics, order, allowed)
            .min(self.directions_last(dynamics, facts));
        Ahead {
            dynamics,
            here,
            order,
            h,
            allowed,
        }
    }

    /// Whether nothing but conditions forbids the candidate, of which some have no size yet: what refuses it may be rounding, as where two bodies fall
    /// side by side. These are in doubt then, with their sizes as the state changes by what it goes through ahead, and `dynamics` holds the
    /// series as before.
    ///
    /// # Errors
    /// The state cannot be evaluated.
    pub(super) fn doubts_branches(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Result<bool, EvaluationError> {
        let is_branch = |guard: &Guard| matches!(guard, Guard::Branch(_));
        let is_doubtful = |guard: &Guard| self.doubtful.iter().any(|doubt| doubt.guard == *guard);
        let violated = &self.violated;
        if !violated.iter().all(is_branch) || violated.iter().all(is_doubtful) {
            return Ok(false);
        }
        let h = self.ahead(dynamics, here, order).h;
        let size = |series: &[T]| terms(series[..=order].iter().map(|c| c.value()), h).sum();
        let coordinates = 0..dynamics.acceleration().len();
        let sizes = [Dynamics::position_series, Dynamics::velocity_series].map(|series| {
            coordinates
                .clone()
                .map(|j| size(series(dynamics, j)))
                .collect()
        });
        let first = self.doubtful.len();
        let EvaluationPoint { t, q, v, .. } = here.moment;
        dynamics.value(t, q, v)?;
        for guard in self.violated.drain(..) {
            let value = leading(guard, 0, &[], &self.posed, dynamics);
            self.doubtful.push(Doubt {
                guard,
                order_known: 0,
                value: value.unwrap_or_default(),
                size: 0.0,
            });
        }
        self.shake(dynamics, here.moment, &sizes, first)?;
        dynamics.series(t, q, v, order)?;
        Ok(true)
    }

    /// Looks at the guards in question just after the moment. `None`: one of them vanishes to this order, and more is to
    /// be had.
    pub(super) fn judge(
        &mut self,
        dynamics: &Dynamics<T>,
        here: SwitchContext<'_, T>,
        order: usize,
    ) -> Option<bool> {
        let facts = here.facts;
        let last = order == here.moment.order;
        let ahead = self.ahead(dynamics, here, order);
        let mut unclear = false;
        let questions = core::mem::take(&mut self.questions);
        for &(guard, order_known) in &questions {
            let mut series = [0.0; guard::LENGTH];
            let series = &mut series[..=order];
            match self.just_after(guard, order_known, ahead, series) {
                Leading::Falls => blame(guard, &self.composites, &mut self.violated),
                Leading::Rises(0) => {}
                // Where others hold it, series of a direction that there is not are no guide.
                Leading::Rises(2..)
                    if self.posed.frictions.contains(&FrictionMode::Stick)
                        && self.must_stick(guard, dynamics)
                        && is_held::<T>(guard, facts, dynamics) =>
                {
                    self.violated.push(guard);
                }
                Leading::Rises(k) => self.zeros.push((guard, k)),
                Leading::Stays if !last => unclear = true,
                Leading::Stays
                    if self.must_stick(guard, dynamics)
                        || !self.lies_loosely && is_held::<T>(guard, facts, dynamics) =>
                {
                    self.violated.push(guard);
                }
                // Whatever sign rounding has given it.
                Leading::Stays => {
                    self.zeros.push((guard, guard::LENGTH));
                    if guard.is_single_force() {
                        self.at_limit.push((guard, self.size(guard, dynamics)));
                    }
                }
            }
        }
        if self.violated.is_empty() && !unclear && !self.composites.is_empty() {
            self.look_ahead(ahead);
        }
        self.questions = questions;
        if self.violated.is_empty() && unclear {
            return None;
        }
        Some(self.violated.is_empty())
    }

    /// Whether a slip that would stay zero must stick: one of two components has no direction then.
    fn must_stick(&self, guard: Guard, dynamics: &Dynamics<T>) -> bool {
        let Guard::Slip(f) = guard else {
            return false;
        };
        let turns = dynamics.description().frictions[f].components > 1;
        self.sticks_first || turns && !self.slips_in_name
    }

    /// How long slips that are under way keep their directions, s: beyond the time in which one of two components may turn or end its series
    /// say nothing, also where the motion is as simple as that of a puck that slides straight on.
    fn directions_last(&self, dynamics: &Dynamics<T>, facts: &SwitchFacts) -> f64 {
        let reading = Reading::Series(dynamics);
        let frictions = dynamics.description().frictions.iter().enumerate();
        let turns = frictions.filter(|&(f, friction)| {
            let slips = matches!(self.posed.frictions[f], FrictionMode::Slip(_));
            friction.components > 1 && slips && !facts.resting[f]
        });
        let lasts = turns.map(|(_, friction)| {
            let size = |k: usize| {
                let rows = friction.rows().map(|row| &dynamics.description().rows[row]);
                let parts = rows.map(|row| {
                    reading
                        .motion(row.velocity)
                        .as_slice()
                        .get(k)
                        .map_or(0.0, |c| c.value())
                });
                parts.fold(0.0, f64::hypot)
            };
            size(0) / size(1)
        });
        lasts.fold(f64::INFINITY, f64::min)
    }

    /// At the border several composite guards may vanish together: a little later those that fall show.
    fn look_ahead(&mut self, ahead: Ahead<'_, T>) {
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=ahead.order];
        let (reading, later) = (Reading::Series(ahead.dynamics), AHEAD * ahead.h);
        for _ in 0..MOST_JOINTS {
            let found = self.redundant.critical_at(|guard, plane| {
                composite::side(guard, plane, &self.posed, &reading, series);
                horner(series, later)
            });
            let Some(composite) = found else {
                return;
            };
            let index = self.composites.len();
            self.composites.push(composite);
            match self.just_after(Guard::Composite(index), 0, ahead, series) {
                Leading::Falls => {
                    return blame(
                        Guard::Composite(index),
                        &self.composites,
                        &mut self.violated,
                    );
                }
                Leading::Rises(0) => {}
                Leading::Rises(k) => self.zeros.push((Guard::Composite(index), k)),
                Leading::Stays => return self.zeros.push((Guard::Composite(index), guard::LENGTH)),
            }
        }
    }

    /// What a guard does just after the moment; its series, scaled onto the reach, is left in `series`.
    fn just_after(
        &self,
        guard: Guard,
        order_known: usize,
        ahead: Ahead<'_, T>,
        series: &mut [f64],
    ) -> Leading {
        let Ahead {
            dynamics,
            here,
            order,
            h,
            allowed,
        } = ahead;
        let tolerance = here.moment.tolerance;
        let reading = Reading::Series(dynamics);
        composite::series(
            guard,
            &self.composites,
            &self.posed,
            &reading,
            &composite::ONES,
            series,
        );
        series[..order_known].fill(0.0);
        // In free flight the motion has a series that ends, and reaches everywhere; that of the wall that it has left does not.
        let mut row = [0.0; ROW];
        row[..series.len()].copy_from_slice(series);
        let own = taylor::step_size([&[row], &[]], order, allowed);
        let h = own.map_or(h, |own| own.min(h));
        let mut power = 1.0;
        for c in &mut *series {
            *c *= power;
            power *= h;
        }
        let size = series.iter().fold(0.0_f64, |size, c| size.max(c.abs()));
        // The residue of a located root, and what follows from it, has the size of the integration error. Everything else is off by what it changes by
        // within the error of the instant.
        let (relative, absolute) = if concerns(guard, &self.composites, here.facts) {
            // What moves slowly from now on may be known for far longer than what led to it.
            let part = (here.facts.lasted / h).min(1.0);
            let known = terms(series.iter().copied(), part).fold(0.0, f64::max) / size;
            ((100.0 * tolerance).clamp(1e-11, 1e-3) * known, here.blur())
        } else {
            (unclear_part(tolerance), (INSTANT * tolerance).max(ROUNDED))
        };
        let cancelling = match guard {
            Guard::Branch(b) if here.facts.held[b] => self.size_as_of_rows(size, ahead, h),
            Guard::StickCone(f) => {
                let grown = self.sizes.of_cone(f, size.sqrt(), dynamics);
                self.size(guard, dynamics).max(grown)
            }
            _ => self.size(guard, dynamics) * unit_of_order(guard, h),
        };
        let absolute = match guard {
            Guard::Branch(b) if !here.facts.held[b] => ROUNDED,
            _ => absolute.max(ROUNDED * growth(dynamics, order, h)),
        };
        let noise = (relative * size).max(absolute * cancelling);
        match series.iter().position(|c| c.abs() > noise) {
            None => Leading::Stays,
            Some(k) if series[k] < 0.0 => Leading::Falls,
            Some(k) => Leading::Rises(k),
        }
    }

    /// Size of what makes the guard of a branch that contacts or frictions have held at its border until now, and which changes by `size` over a
    /// time `h`: that of the gaps or slips of those, by which it changes.
    fn size_as_of_rows(&self, size: f64, ahead: Ahead<'_, T>, h: f64) -> f64 {
        let Ahead {
            dynamics,
            here,
            order,
            ..
        } = ahead;
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=order];
        let slips = |f: usize| matches!(self.posed.frictions[f], FrictionMode::Slip(_));
        let left = here.facts.located.iter().filter_map(|guard| match *guard {
            Guard::Normal(c) if !self.posed.contacts[c] => Some((Guard::Gap(c), 2)),
            Guard::StickUpper(f) | Guard::StickLower(f) | Guard::StickCone(f) if slips(f) => {
                Some((Guard::Slip(f), 1))
            }
            _ => None,
        });
        let sizes = left.map(|(row, known)| {
            let reading = Reading::Series(dynamics);
            guard::series(row, &self.posed, &reading, &composite::ONES, series);
            let grows = terms(series.iter().copied(), h)
                .skip(known)
                .fold(0.0, f64::max);
            if grows > 0.0 {
                self.sizes.of(row, dynamics) * unit_of_order(row, h) * size / grows
            } else {
                0.0
            }
        });
        sizes.fold(0.0, f64::max)
    }
}

/// What is less than this part of what it changes by is nothing, as far as the instant is known by a run of this tolerance.
pub(super) fn unclear_part(tolerance: f64) -> f64 {
    (INSTANT * tolerance).max(1e-13)
}

/// By how much what cancels may be larger after a time `h` than at the instant: forces are made of positions and of products of them, as those on a plank of a mass
/// that has left it and is counted along it.
fn growth<T: Scalar>(dynamics: &Dynamics<T>, order: usize, h: f64) -> f64 {
    let growths = (0..dynamics.acceleration().len()).map(|j| {
        let series = &dynamics.position_series(j)[..=order];
        let extent: f64 = terms(series.iter().map(|c| c.value()), h).sum();
        extent / (1.0 + series[0].value().abs())
    });
    growths.fold(1.0, f64::max).powi(2)
}

/// The sizes of the terms of a series after some time.
pub fn terms(series: impl Iterator<Item = f64>, time: f64) -> impl Iterator<Item = f64> {
    let powers = core::iter::successors(Some(1.0), move |power| Some(power * time));
    series.zip(powers).map(|(c, power)| (c * power).abs())
}

/// Whether a contact cannot open because others are closed, or a friction cannot slip because others stick: then the mode
/// in which it is closed, or sticks, has the same motion, and more forces to choose from. Not so a contact that a force has left which
/// was determined, because the sliding friction of the others depends on it.
fn is_held<T: Scalar>(guard: Guard, facts: &SwitchFacts, dynamics: &Dynamics<T>) -> bool {
    let d = dynamics.description();
    let mut rows = match guard {
        Guard::Gap(c) if facts.located.contains(&Guard::Normal(c)) => return false,
        Guard::Gap(c) => d.contacts[c].row..d.contacts[c].row + 1,
        Guard::Slip(f) => d.frictions[f].rows(),
        _ => return false,
    };
    rows.all(|row| dynamics.follows(row))
}
