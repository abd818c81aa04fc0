//! What a decision starts from: the instant, the mode up to it, and what is known exactly.

use crate::effects::{Effects, Item};
use crate::integrate::Tolerance;
use crate::mode::Mode;
use crate::modes::guard::Guard;
use crate::system::Description;

/// What a force at its limit is from it may do to what it moves, and that to other forces: so many times as much, relative.
const RESIDUES: f64 = 16.0;

/// What is known exactly at the instant.
#[derive(Debug, Default)]
pub struct SwitchFacts {
    /// Per contact: gap and gap rate vanish, so that it may be closed or open.
    pub touching: Vec<bool>,
    /// Per contact: the gap has just come to vanish, so that it may be hit.
    pub arriving: Vec<bool>,
    /// Per contact: the gap vanishes and grows.
    pub parting: Vec<bool>,
    /// Per friction: the slip vanishes, so that it may stick or slip either way.
    pub resting: Vec<bool>,
    /// Per branch: its guard vanishes.
    pub balanced: Vec<bool>,
    /// Per branch: its guard and the rate of that vanish because what touches holds it there.
    pub lying: Vec<bool>,
    /// Per branch: its guard vanishes because what touches and rests holds it there.
    pub held: Vec<bool>,
    /// Velocities have just jumped.
    pub jumped: bool,
    /// Guards of the present mode that have just been located as roots: the present mode goes on only where nothing else does.
    pub located: Vec<Guard>,
    /// Guards that have just been located as roots and end no mode: limits of a friction that can hold nothing at this instant, beside others that hold.
    pub touched: Vec<Guard>,
    /// Slips of two components have come to rest of which only errors were left: the state decides as it is.
    pub lost: bool,
    /// Time has not advanced since the last switch: what has been located now is zero as exactly as time can tell.
    pub again: bool,
    /// What evaluation leaves of the forces that have been located as zero, relative to the terms that they are made of.
    pub residue: f64,
    /// How long the present mode has lasted, or as far as its last step could have gone, s: the time to whose errors an instant is located. Infinite where
    /// there has been none.
    pub lasted: f64,
}

impl Clone for SwitchFacts {
    fn clone(&self) -> Self {
        let mut facts = Self::default();
        facts.clone_from(self);
        facts
    }

    // A run goes on from an impact without allocating.
    fn clone_from(&mut self, source: &Self) {
        self.touching.clone_from(&source.touching);
        self.arriving.clone_from(&source.arriving);
        self.parting.clone_from(&source.parting);
        self.resting.clone_from(&source.resting);
        self.balanced.clone_from(&source.balanced);
        self.lying.clone_from(&source.lying);
        self.held.clone_from(&source.held);
        self.located.clone_from(&source.located);
        self.touched.clone_from(&source.touched);
        (self.jumped, self.lost, self.again) = (source.jumped, source.lost, source.again);
        (self.residue, self.lasted) = (source.residue, source.lasted);
    }
}

impl SwitchFacts {
    /// Whether a friction is not left out and may have a force: what presses it touches.
    pub fn may_act(&self, friction: usize, d: &Description, effects: &Effects) -> bool {
        let normal = d.frictions[friction].normal;
        normal.presses(d, |c| self.touching[c]) && effects.includes(d, Item::Friction(friction))
    }

    /// Whether there is no mode that could go on: the present one is that of a start, a guess.
    pub fn begins(&self) -> bool {
        self.lasted.is_infinite()
    }

    /// Nothing is known.
    pub fn clear(&mut self, d: &Description) {
        for flags in [&mut self.touching, &mut self.arriving, &mut self.parting] {
            flags.clear();
            flags.resize(d.contacts.len(), false);
        }
        self.resting.clear();
        self.resting.resize(d.frictions.len(), false);
        for flags in [&mut self.balanced, &mut self.lying, &mut self.held] {
            flags.clear();
            flags.resize(d.branches.len(), false);
        }
        self.jumped = false;
        self.located.clear();
        self.touched.clear();
        self.lost = false;
        self.again = false;
        self.residue = 0.0;
        self.lasted = f64::INFINITY;
    }
}

/// The instant at which a mode is looked for.
#[derive(Clone, Copy, Debug)]
pub struct EvaluationPoint<'a, T> {
    /// Time, s.
    pub t: T,
    /// Positions.
    pub q: &'a [T],
    /// Velocities.
    pub v: &'a [T],
    /// Order of the series that decide what values do not.
    pub order: usize,
    /// Error that the state may have.
    pub tolerance: f64,
}

impl<T> EvaluationPoint<'_, T> {
    /// Error that steps of the series may have.
    pub fn allowed(&self) -> Tolerance<'static> {
        Tolerance::both(self.tolerance.max(f64::EPSILON))
    }
}

/// Where a mode ends and another is looked for.
#[derive(Clone, Copy, Debug)]
pub struct SwitchContext<'a, T> {
    /// The instant.
    pub moment: EvaluationPoint<'a, T>,
    /// The mode up to it.
    pub present: &'a Mode,
    /// What is known exactly.
    pub facts: &'a SwitchFacts,
}

impl<T: Copy> SwitchContext<'_, T> {
    /// The same with a state that has no error.
    pub fn exactly(mut self) -> Self {
        self.moment.tolerance = 0.0;
        self
    }

    /// How far forces located as zero, and what follows from them, are from it, relative to what they are made of.
    pub fn blur(&self) -> f64 {
        // Where all forces vanish at once a residue has nothing to be compared with.
        let tolerance = self.moment.tolerance;
        let residue = self.facts.residue.min(tolerance.max(1e-6));
        tolerance.max(1e-14).max(RESIDUES * residue)
    }

    /// Whether a mode is over: a root of it falls through zero.
    pub fn ends(&self, mode: &Mode) -> bool {
        mode == self.present && !self.facts.located.is_empty()
    }
}
