//! Composite guards: sums of guards of undetermined forces in which all that is open cancels.

use crate::arithmetic::Scalar;
use crate::mode::Mode;
use crate::modes::guard::{self, ConePlane, Guard};
use crate::modes::reading::Reading;

/// Factors that change nothing.
pub const ONES: [f64; guard::LENGTH] = [1.0; guard::LENGTH];

/// A guard as a part of a composite one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// The guard.
    pub guard: Guard,
    /// If the guard is a friction cone, the plane that touches it; nothing for other guards.
    pub plane: Option<ConePlane>,
    /// Weight in the sum.
    pub weight: f64,
}

/// Weighted guards whose sum is determined where they are not. The sum is relative to the terms that make it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompositeGuard {
    /// The guards, with weights that are all positive.
    pub parts: Vec<Part>,
    /// How long after the begin of the step at hand forces cease to keep all bounds, where that has been located by the forces themselves, s.
    pub falls_after: Option<f64>,
}

impl CompositeGuard {
    /// Whether it is made of the same guards, of cones about the same side.
    pub fn is_like(&self, other: &CompositeGuard) -> bool {
        /// Distance of the directions of sides that one plane touches well enough.
        const SAME_SIDE: f64 = 0.45;
        let pairs = self.parts.iter().zip(&other.parts);
        let near = |x: ConePlane, y: ConePlane| {
            let [east, north] = [0, 1].map(|k| x.along[k] - y.along[k]);
            let pressing = [0, 1, 2].map(|k| x.pressing[k] - y.pressing[k]);
            let turned = pressing.into_iter().fold(0.0, f64::hypot);
            turned < SAME_SIDE && east.hypot(north) < SAME_SIDE
        };
        let alike = |(x, y): (&Part, &Part)| {
            x.guard == y.guard && x.plane.zip(y.plane).is_none_or(|(x, y)| near(x, y))
        };
        self.parts.len() == other.parts.len() && pairs.into_iter().all(alike)
    }

    /// Whether it says only how much frictions can hold, either way: the force of each of them cancels by itself.
    pub fn is_of_limits(&self) -> bool {
        /// Forces that cancel leave this share of their weights.
        const CANCELS: f64 = 1e-6;
        let along = |part: &Part| match (part.guard, part.plane) {
            (Guard::StickUpper(f), _) => Some((f, [1.0, 0.0])),
            (Guard::StickLower(f), _) => Some((f, [-1.0, 0.0])),
            (Guard::StickCone(f), Some(plane)) => Some((f, plane.along)),
            _ => None,
        };
        let cancels = |part: &Part| {
            let Some((friction, _)) = along(part) else {
                return false;
            };
            let own = self.parts.iter().filter_map(|other| {
                let (f, direction) = along(other)?;
                (f == friction).then_some((other.weight, direction))
            });
            let (mut sum, mut weights) = ([0.0; 2], 0.0);
            for (weight, direction) in own {
                sum = [0, 1].map(|k| sum[k] + weight * direction[k]);
                weights += weight;
            }
            sum[0].hypot(sum[1]) <= CANCELS * weights
        };
        self.parts.iter().all(cancels)
    }

    /// Its value.
    pub fn value<T: Scalar>(&self, mode: &Mode, reading: &Reading<'_, T>) -> f64 {
        let mut value = [0.0];
        sum(self, mode, reading, &mut value);
        value[0]
    }
}

/// [`guard::series`], also of composite guards.
#[inline]
pub fn series<T: Scalar>(
    guard: Guard,
    composites: &[CompositeGuard],
    mode: &Mode,
    reading: &Reading<'_, T>,
    powers: &[f64],
    out: &mut [f64],
) {
    let Guard::Composite(index) = guard else {
        return guard::series(guard, mode, reading, powers, out);
    };
    sum(&composites[index], mode, reading, out);
    guard::scale(out, powers);
}

/// Coefficients of a composite guard.
fn sum<T: Scalar>(
    composite: &CompositeGuard,
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    let mut part = [0.0; guard::LENGTH];
    let part = &mut part[..out.len()];
    out.fill(0.0);
    for each in &composite.parts {
        side(each.guard, each.plane, mode, reading, part);
        for (sum, x) in out.iter_mut().zip(&*part) {
            *sum += each.weight * x;
        }
    }
}

/// [`guard::value`], also of composite guards.
#[inline]
pub fn value<T: Scalar>(
    guard: Guard,
    composites: &[CompositeGuard],
    mode: &Mode,
    reading: &Reading<'_, T>,
) -> f64 {
    let Guard::Composite(index) = guard else {
        return guard::value(guard, mode, reading);
    };
    composites[index].value(mode, reading)
}

/// A guard by [`guard::series`] without factors, but of a cone only a plane that touches it.
pub fn side<T: Scalar>(
    guard: Guard,
    plane: Option<ConePlane>,
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    match (guard, plane) {
        (Guard::StickCone(f), Some(plane)) => guard::cone_side(f, plane, mode, reading, out),
        _ => guard::series(guard, mode, reading, &ONES, out),
    }
}
