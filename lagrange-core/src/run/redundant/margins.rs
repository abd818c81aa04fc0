//! How near undetermined forces may come to their bounds between the instants of a step at which that is known.
//!
//! The widest margin by which forces keep all bounds is a concave function of what bounds them (duality of linear and conic programmes): while
//! that changes evenly, the margin is nowhere less than at both ends. It dips by no more than the values of the bounds bend, and by what frictions can hold
//! the less where the force of a constraint that presses them changes its sign between two instants, or turns.
//!
//! Where directions of forces turn, those that jam may come to be allowed: the margin, which has been small until then, is wide all at once. Between the instants it
//! may have fallen below zero.

use crate::linear::direction::{dot, length};

/// Composite guards are watched from there on if forces have come this near to their bounds, relative. No wider margins are told from one another.
pub(super) const WIDE: f64 = 0.5;

/// A margin that is expected below this share of a wide one, and is wide, has jumped.
const SMOOTH: f64 = 0.5;

/// Of so many instants in one step nothing more is learnt.
const MOST: usize = 24;

/// Values may bend by so many times as much as their second differences tell.
const SAFETY: f64 = 2.0;

/// The margins at some instants of a step, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Margins {
    known: Vec<Margin>,
}

#[derive(Clone, Debug)]
struct Margin {
    /// When, as a part of the step.
    part: f64,
    /// The widest margin, relative, or less.
    least: f64,
    /// The values of all bounds, relative.
    values: Vec<f64>,
    /// What frictions can hold, relative, in the directions in which constraints press them.
    holds: Vec<[f64; 3]>,
}

impl Margins {
    /// Notes that with bounds of these `values` forces keep all of them by at least `least`, where frictions are pressed to hold so much.
    pub fn note(&mut self, part: f64, least: f64, values: &[f64], holds: Vec<[f64; 3]>) {
        let place = self.known.partition_point(|known| known.part < part);
        let margin = Margin {
            part,
            least,
            values: values.to_vec(),
            holds,
        };
        self.known.insert(place, margin);
    }

    /// The last instant before `part` at which a margin is known.
    pub fn before(&self, part: f64) -> f64 {
        let place = self.known.partition_point(|known| known.part < part);
        place.checked_sub(1).map_or(0.0, |k| self.known[k].part)
    }

    /// Whether the margin may dip by more than `nothing` between any two of them.
    pub fn may_dip(&self, nothing: f64) -> bool {
        (0..self.known.len().saturating_sub(1)).any(|k| self.dip(k) > nothing)
    }

    /// An instant between two known ones at which the margin may be less than zero, and a dip of more than `nothing` deeper than at both.
    pub fn may_dip_at(&self, nothing: f64) -> Option<f64> {
        if self.known.len() >= MOST {
            return None;
        }
        let falls_by = |k: usize| {
            let dip = self.dip(k);
            let least = self.known[k].least.min(self.known[k + 1].least);
            (dip > nothing).then_some(dip - least)
        };
        let gaps = (0..self.known.len().saturating_sub(1)).filter_map(|k| Some((k, falls_by(k)?)));
        let (k, falls_by) = gaps.max_by(|x, y| x.1.total_cmp(&y.1))?;
        (falls_by > 0.0).then(|| 0.5 * (self.known[k].part + self.known[k + 1].part))
    }

    /// How much less the margin may be between instants `k` and `k` + 1 than at both.
    fn dip(&self, k: usize) -> f64 {
        let length = self.known[k + 1].part - self.known[k].part;
        let bends = [k.checked_sub(1), Some(k)].into_iter().flatten();
        let bend = bends.map(|first| self.bend(first)).fold(0.0, f64::max);
        SAFETY * bend * length * length / 4.0 + self.turn(k) + self.jump(k)
    }

    /// By how much the margin jumps between instants `k` and `k` + 1 from what it has come to beside them, if it is wide at the other one of them: before that it may
    /// have fallen below zero.
    fn jump(&self, k: usize) -> f64 {
        let jumps = |beside: Option<usize>, at: usize, other: usize| {
            let [beside, at, other] = [&self.known[beside?], &self.known[at], &self.known[other]];
            let slope = (beside.least - at.least) / (beside.part - at.part);
            let expected = at.least + slope * (other.part - at.part);
            (other.least >= WIDE && expected < SMOOTH * WIDE).then_some(WIDE - expected)
        };
        let next = Some(k + 2).filter(|&next| next < self.known.len());
        let both = [jumps(k.checked_sub(1), k, k + 1), jumps(next, k + 1, k)];
        both.into_iter().flatten().fold(0.0, f64::max)
    }

    /// How much less a friction may hold between instants `k` and `k` + 1, because what presses it turns, than if it only grew or fell.
    fn turn(&self, k: usize) -> f64 {
        let pairs = self.known[k].holds.iter().zip(&self.known[k + 1].holds);
        let less = pairs.map(|(before, after)| {
            let [one, other] = [before, after].map(|&force| length(force));
            // Of forces that change evenly, where they are smallest.
            let sum = (one + other).max(f64::MIN_POSITIVE);
            (one * other - dot(*before, *after)) / sum
        });
        less.fold(0.0, f64::max)
    }

    /// The largest second divided difference of a value over three instants.
    fn bend(&self, first: usize) -> f64 {
        let Some([a, b, c]) = self.known.get(first..first + 3) else {
            return 0.0;
        };
        if a.values.len() != b.values.len() || b.values.len() != c.values.len() {
            return 0.0;
        }
        let slope =
            |x: &Margin, y: &Margin, i: usize| (y.values[i] - x.values[i]) / (y.part - x.part);
        let second = |i: usize| (slope(b, c, i) - slope(a, b, i)) / (c.part - a.part);
        (0..a.values.len())
            .map(|i| second(i).abs())
            .fold(0.0, f64::max)
    }
}
