//! What bounds undetermined forces: contacts push, sticking frictions stay in their cones.

use super::RedundantForces;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::linear::{ForceBounds, Linear};
use crate::mode::FrictionMode;
use crate::modes::composite::CompositeGuard;
use crate::modes::guard::{self, ConePlane, Guard};
use crate::system::{Friction, Normal, ValueRef};

/// A bound of undetermined forces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub guard: Guard,
    /// What the forces of the constraints that carry a friction count.
    pressing: [f64; 3],
}

impl Bound {
    /// A force of this size that presses.
    pub fn pressed_by(&self, size: f64) -> [f64; 3] {
        self.pressing.map(|part| part * size)
    }

    /// The plane that touches the cone in this direction.
    pub fn plane(&self, along: [f64; 2]) -> ConePlane {
        ConePlane {
            along,
            pressing: self.pressing,
        }
    }
}

/// What a friction can hold: a sum of forces, (index, factor), and a constant.
struct Limit<T> {
    /// What the forces of what presses it count.
    pressing: [T; 3],
    terms: Vec<(usize, T)>,
    constant: T,
}

/// The bounds with a part that is open.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds<T> {
    pub list: Vec<Bound>,
    /// The same as cones over the forces.
    pub forces: ForceBounds<T>,
}

impl<T: Scalar> Bounds<T> {
    pub fn clear(&mut self) {
        self.list.clear();
        self.forces.clear();
    }
}

impl<T: Scalar> RedundantForces<T> {
    /// Lists the bounds with a part that is open.
    pub(super) fn list_bounds(&mut self, dynamics: &Dynamics<T>) {
        self.bounds.clear();
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let index = |row: usize| acting.binary_search(&row).ok();
        let mode = dynamics.mode();
        for (c, contact) in d.contacts.iter().enumerate() {
            if let Some(i) = index(contact.row) {
                let gap = [(&[(i, T::one())][..], T::zero())];
                let bound = Bound {
                    guard: Guard::Normal(c),
                    pressing: [1.0, 0.0, 0.0],
                };
                self.bound(bound, gap, dynamics);
            }
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            if mode.frictions[f] != FrictionMode::Stick || self.is_idle(f, friction) {
                continue;
            }
            let Some(i) = index(friction.row) else {
                continue;
            };
            let Some(Limit {
                pressing,
                terms: limits,
                constant,
            }) = self.limit(f, friction, dynamics)
            else {
                continue;
            };
            let one = T::one();
            let bound = |guard| Bound {
                guard,
                pressing: pressing.map(T::value),
            };
            if guard::stick_guards(f, friction).eq([Guard::StickCone(f)]) {
                let other = (friction.components > 1).then(|| index(friction.row + 1));
                let other = other.flatten().map(|j| (j, one));
                let cone = [
                    (&limits[..], constant),
                    (&[(i, one)], T::zero()),
                    (other.as_slice(), T::zero()),
                ];
                self.bound(bound(Guard::StickCone(f)), cone, dynamics);
            } else {
                let sides = [(Guard::StickUpper(f), -one), (Guard::StickLower(f), one)];
                for (guard, sign) in sides {
                    let terms = [&[(i, sign)], &limits[..]].concat();
                    self.bound(bound(guard), [(&terms, constant)], dynamics);
                }
            }
        }
        self.bounds.forces.complete();
    }

    /// What a friction that sticks can hold; nothing if what presses it does not act.
    fn limit(&self, f: usize, friction: &Friction, dynamics: &Dynamics<T>) -> Option<Limit<T>> {
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let index = |row: usize| acting.binary_search(&row).ok();
        let number = |place: ValueRef| dynamics.motion(place);
        let coefficient = number(friction.static_coefficient);
        let mut pressing = [T::one(), T::zero(), T::zero()];
        let mut terms = Vec::with_capacity(3);
        let constant = match friction.normal {
            Normal::Contact(c) => {
                let factor = d.contacts[c].normal_factor.map_or(T::one(), number);
                let row = index(d.contacts[c].row)?;
                terms.push((row, coefficient * factor));
                T::zero()
            }
            Normal::Given(place) => coefficient * number(place),
            Normal::Constraint(on) => {
                let row = index(d.constraints[on].row)?;
                // Only where a force is open its sign is a choice.
                let own = match self.least.freedom.is_determined(row) {
                    true => self.sign_of_least(row),
                    false => None,
                };
                pressing[0] = T::from_f64(own.unwrap_or(self.signs[on]));
                terms.push((row, coefficient * pressing[0]));
                T::zero()
            }
            // What forces press in a direction they press at least; in that of the least ones, if no other has been chosen.
            normal @ Normal::Resultant(_) => {
                let rows = normal.rows(d).map(index).collect::<Option<Vec<_>>>()?;
                let force = |&row: &usize| self.least.forces[row];
                let squares = rows.iter().map(|row| force(row) * force(row));
                let size = squares.fold(T::zero(), |sum, square| sum + square).sqrt();
                if let Some(Some(chosen)) = self.directions.get(f) {
                    pressing = chosen.map(T::from_f64);
                } else if size.value() > 0.0 {
                    for (part, row) in pressing.iter_mut().zip(&rows) {
                        *part = force(row) / size;
                    }
                }
                let parts = pressing.map(|part| coefficient * part);
                terms.extend(rows.into_iter().zip(parts));
                T::zero()
            }
        };
        Some(Limit {
            pressing,
            terms,
            constant,
        })
    }

    /// Whether a friction that sticks is pressed by a constraint whose force is open, and that of least norm, which would say its sign, vanishes at the instant:
    /// `nothing` says below which size it does.
    pub fn has_unknown_signs(
        &self,
        dynamics: &Dynamics<T>,
        nothing: impl Fn(usize) -> f64,
    ) -> bool {
        let acting = dynamics.acting_rows();
        self.bounds.list.iter().any(|bound| {
            let Guard::StickCone(f) = bound.guard else {
                return false;
            };
            let row = self.open_row(f, dynamics);
            let force = row.and_then(|row| acting.binary_search(&row).ok());
            force.is_some_and(|k| {
                let vanishes = self.least.forces[k].value().abs() <= nothing(f);
                vanishes || self.sign_of_least(k).is_none()
            })
        })
    }

    /// The row of the constraint that presses friction `f`, if its force is open: its sign is a choice.
    fn open_row(&self, f: usize, dynamics: &Dynamics<T>) -> Option<usize> {
        let d = dynamics.description();
        match d.frictions[f].normal {
            Normal::Constraint(on) => Some(d.constraints[on].row),
            _ => None,
        }
        .filter(|&row| self.leaves_open(dynamics, row))
    }

    /// Turns the planes that touch cones of frictions on constraints whose force vanishes at the instant, here and in `composites`: |λ| presses as λ begins. Signs of
    /// open forces are choices, and stay. `dynamics` holds the series of the instant, which are good for a time of `reach`; `nothing` says below which size the
    /// force that presses a friction is zero, and `unclear` below which part of what it changes by within the reach.
    pub fn press_as_forces_begin(
        &mut self,
        composites: &mut [CompositeGuard],
        dynamics: &Dynamics<T>,
        reach: f64,
        unclear: f64,
        nothing: impl Fn(usize) -> f64,
    ) {
        let d = dynamics.description();
        for k in 0..self.bounds.list.len() {
            let Guard::StickCone(f) = self.bounds.list[k].guard else {
                continue;
            };
            let normal = d.frictions[f].normal;
            let presses = matches!(normal, Normal::Constraint(_) | Normal::Resultant(_));
            if !presses || self.open_row(f, dynamics).is_some() {
                continue;
            }
            let bound = &mut self.bounds.list[k];
            let series: Vec<&[T]> = normal
                .rows(d)
                .map(|row| dynamics.force_series(row))
                .collect();
            let force = |k: usize| series.iter().map(move |series| series[k].value());
            let size = |k: usize| force(k).fold(0.0, f64::hypot);
            let orders = 0..series.iter().map(|series| series.len()).min().unwrap_or(0);
            let part = |k: usize| size(k) * reach.powi(k as i32);
            let largest = orders.clone().map(part).fold(0.0, f64::max);
            let zero = nothing(f).max(unclear * largest);
            let Some(k @ 1..) = orders.into_iter().find(|&k| part(k) > zero) else {
                continue;
            };
            let directions = bound.pressing.iter_mut().zip(force(k));
            directions.for_each(|(pressing, force)| *pressing = force / size(k));
            let parts = composites
                .iter_mut()
                .flat_map(|composite| &mut composite.parts);
            for part in parts.filter(|part| part.guard == bound.guard) {
                if let Some(plane) = &mut part.plane {
                    plane.pressing = bound.pressing;
                }
            }
        }
    }

    /// Adds a bound, if it has a part that is open: s ≥ 0, or s₀ ≥ √(s₁² + s₂²).
    fn bound<const N: usize>(
        &mut self,
        bound: Bound,
        rows: [Linear<'_, T>; N],
        dynamics: &Dynamics<T>,
    ) {
        let least = &self.least;
        let own = || match bound.guard {
            // Without the unit that the squares of its guard have.
            Guard::StickCone(f) => self.sizes.limit(f, dynamics),
            guard => self.sizes.of(guard, dynamics),
        };
        let bounds = &mut self.bounds.forces;
        let is_open = bounds.add(rows, &least.forces, &least.freedom, own);
        if is_open {
            self.bounds.list.push(bound);
        }
    }
}
