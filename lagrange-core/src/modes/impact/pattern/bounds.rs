//! How impulses are shared that the law leaves open: an edge of a die that lands and sticks at both ends, a beam that falls on three supports.
//!
//! Of all with the same effect those of least norm count, within what bounds them: contacts push, and frictions that stick stay in their cones.

use super::{Pattern, Phase, Slide, held};
use crate::arithmetic::Scalar;
use crate::linear::{Freedom, Rank, least_norm};
use crate::modes::impact::collision::{Collision, FrictionRow, NormalSource};
use nalgebra::DVector;

/// By so much bounds are kept where they can be, relative, so that rounding does not take the impulses beyond them.
const INSIDE: f64 = 1e-12;

impl<T: Scalar> Pattern<T> {
    /// Shares impulses that are not determined.
    pub(super) fn share(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        let unknowns = self.unknowns.iter();
        let columns: Vec<T> = unknowns
            .clone()
            .flat_map(|&row| (0..c.size).map(move |i| (i, row)))
            .map(|(i, row)| self.effect(c, i, row, held))
            .collect();
        let mut shared: Vec<T> = unknowns.map(|&row| self.impulses[row]).collect();
        let rank = self.rank_of_effects(c);
        let freedom = least_norm(&columns, c.size, rank, &mut shared);
        // Where nothing sticks, the combination without contacts that would pull does the same.
        if self.slides.contains(&Slide::Stick)
            && let Some(change) = self.change(c, phase, &shared, &freedom)
        {
            // The same effect to the last digit: what is added has none, but for rounding, and the rest makes up for that.
            for (impulse, &more) in shared.iter_mut().zip(&change) {
                *impulse -= more;
            }
            least_norm(&columns, c.size, rank, &mut shared);
            for (impulse, &more) in shared.iter_mut().zip(&change) {
                *impulse += more;
            }
        }
        for (&row, impulse) in self.unknowns.iter().zip(shared) {
            self.impulses[row] = impulse;
        }
    }

    /// How many effects of the unknowns are independent: as many as their equations, which say what they do to their own rates, unless some bring
    /// friction along that acts elsewhere.
    fn rank_of_effects(&self, c: &Collision<T>) -> Rank {
        let slides = |(rub, slide): (&FrictionRow<T>, &Slide)| {
            matches!(slide, Slide::Along(_) | Slide::Turning(_))
                && self.unknowns.contains(&c.bearing_row(rub))
        };
        match c.rubs.iter().zip(&self.slides).any(slides) {
            true => Rank::Numerical,
            false => Rank::Known(self.factors.rank()),
        }
    }

    /// What takes unknown impulses from those of least norm to the least within their bounds; nothing if they are within them.
    fn change(
        &mut self,
        c: &Collision<T>,
        phase: &Phase<T>,
        least: &[T],
        freedom: &Freedom<T>,
    ) -> Option<DVector<T>> {
        self.bounds.clear();
        let place = |row: usize| self.unknowns.iter().position(|&unknown| unknown == row);
        let one = T::one();
        // An impulse that is zero among those of least norm by coincidence is as large as the others when it changes.
        let mut impulses = self.impulses.clone();
        for (&row, &impulse) in self.unknowns.iter().zip(least) {
            impulses[row] = impulse;
        }
        let effort = c.effort(&impulses);
        let size = |row: usize| match c.strength(row) {
            0.0 => 0.0,
            strength => effort / strength,
        };
        for (k, touch) in c.touches.iter().enumerate() {
            if let Some(i) = place(touch.row) {
                let push = [(&[(i, one)][..], -phase.least[k])];
                self.bounds.add(push, least, freedom, || size(touch.row));
            }
        }
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            let bearer = c.bearing_row(rub);
            let (Slide::Stick, Some(i)) = (slide, place(rub.row)) else {
                continue;
            };
            let most = rub.stick * rub.factor;
            let size = || size(rub.row).max(most.value() * size(bearer));
            let (limit, constant) = match place(bearer) {
                Some(n) => {
                    // The sign of a constraint's impulse is that which it has.
                    let against = matches!(rub.bearer, NormalSource::ConstraintRow(_))
                        && least[n].value() < 0.0;
                    ((n, if against { -most } else { most }), T::zero())
                }
                None => {
                    let pressing = self.impulses[bearer];
                    let sign = T::from_f64(pressing.value().signum());
                    ((i, T::zero()), most * sign * pressing)
                }
            };
            if rub.components == 1 {
                for sign in [-one, one] {
                    let side = [(&[(i, sign), limit][..], constant)];
                    self.bounds.add(side, least, freedom, size);
                }
            } else {
                let cone = [
                    (&[limit][..], constant),
                    (&[(i, one)][..], T::zero()),
                    (&[(i + 1, one)][..], T::zero()),
                ];
                self.bounds.add(cone, least, freedom, size);
            }
        }
        self.bounds.complete();
        self.bounds.shares(INSIDE)
    }
}
