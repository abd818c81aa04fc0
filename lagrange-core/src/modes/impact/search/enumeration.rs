//! All combinations in order: contacts pressed before free, frictions sticking before sliding.
//!
//! A law with friction may have several solutions: what is held between two rough surfaces jams, or one of them lets go. With the
//! same contacts pressed those count in which most sticks. Of these, and of those with other contacts pressed, it is the one with
//! the least jump of the velocities, Δvᵀ M Δv = Λᵀ G Λ.

use super::{FEW, Search};
use crate::arithmetic::Scalar;
use crate::modes::impact::collision::{Collision, FrictionRow, NormalSource};
use crate::modes::impact::pattern::{Pattern, Phase, Slide};

/// All that so many frictions may do is looked at once contacts are known that are pressed.
const MOST_WEIGHED: usize = 6;

/// Solutions whose rates differ by less than this share of them are the same.
const SAME: f64 = 1e-9;

impl<T: Scalar> Search<T> {
    /// Number of combinations, unless it is beyond counting.
    pub(super) fn combinations(&self, c: &Collision<T>, phase: &Phase<T>) -> Option<usize> {
        let contacts = 1_usize.checked_shl(self.taking.len() as u32)?;
        c.acting(phase).try_fold(contacts, |n, rub| {
            n.checked_mul(if rub.components == 1 { 3 } else { 2 })
        })
    }

    /// Leaves in `pattern` the solution that counts, and the others in `others`; false if there is none.
    pub(super) fn enumerate(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let few = self.combinations(c, phase).is_some_and(|n| n <= FEW);
        let several = few && self.taking.len() > 1 && c.acting(phase).next().is_some();
        let mut found: Vec<Pattern<T>> = Vec::new();
        for open in 0..1_usize << self.taking.len() {
            let before = found.len();
            if self.list_with(open, few, several, &mut found, c, phase) {
                return true;
            }
            let first = before == 0 && !found.is_empty();
            if first && !several && !found.iter().any(|found| found.may_jam(c)) {
                break;
            }
        }
        self.take_least(found, phase)
    }

    /// Where less holds what slides than what sticks, several solutions may have the same contacts pressed as the one in `pattern`: leaves that in it which
    /// counts, and the others in `others`.
    pub(super) fn weigh(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        let differ = c
            .acting(phase)
            .any(|rub| rub.stick.value() > rub.slide.value());
        let free = |(bit, &k): (usize, &usize)| usize::from(!self.pattern.pressed[k]) << bit;
        let few = self.taking.len() < usize::BITS as usize;
        if !differ || self.pattern.undetermined || !few {
            return;
        }
        let open = self.taking.iter().enumerate().map(free).sum();
        self.list_acting(c, phase);
        let mut first = self.pattern.clone();
        if self.acting.len() > MOST_WEIGHED {
            for k in 0..self.acting.len() {
                let slide =
                    core::mem::replace(&mut self.pattern.slides[self.acting[k]], Slide::Stick);
                if slide != Slide::Stick && self.holds(c, phase) {
                    first.clone_from(&self.pattern);
                } else {
                    self.pattern.clone_from(&first);
                }
            }
            return;
        }
        let mut found = Vec::new();
        if !(self.list_with(open, true, false, &mut found, c, phase)
            || self.take_least(found, phase))
        {
            self.pattern = first;
        }
    }

    /// Lists the solutions with the contacts free that `open` has bits for in which most sticks. Whether the first one, which is then in `pattern`, is all that
    /// need be looked at: unless others are looked for with other contacts pressed (`several`), and unless `all` are listed, it is where nothing jams.
    fn list_with(
        &mut self,
        open: usize,
        all: bool,
        several: bool,
        found: &mut Vec<Pattern<T>>,
        c: &Collision<T>,
        phase: &Phase<T>,
    ) -> bool {
        self.begin_with(open, c, phase);
        let (before, mut most) = (found.len(), 0);
        while self.next_solution(c, phase) {
            let sticking = self.sticking();
            let alone = !all || self.acting.len() < 2 || sticking == self.acting.len();
            if found.is_empty() && alone && !several && !self.pattern.may_jam(c) {
                return true;
            }
            if sticking > most {
                found.truncate(before);
                most = sticking;
            }
            if sticking == most && !found.iter().any(|other| other.moves_as(&self.pattern)) {
                found.push(self.pattern.clone());
            }
            if alone || !self.next_choice(c) {
                break;
            }
        }
        false
    }

    /// Of solutions takes that with the least jump of the velocities; false if there is none.
    fn take_least(&mut self, mut found: Vec<Pattern<T>>, phase: &Phase<T>) -> bool {
        let jumps = |pattern: &Pattern<T>| pattern.jump(phase);
        let least = (0..found.len()).min_by(|&i, &j| jumps(&found[i]).total_cmp(&jumps(&found[j])));
        let Some(least) = least else {
            return false;
        };
        self.pattern = found.swap_remove(least);
        self.others = found;
        true
    }

    /// How many frictions stick in the present combination.
    fn sticking(&self) -> usize {
        let slides = self.pattern.slides.iter();
        slides.filter(|slide| **slide == Slide::Stick).count()
    }

    /// Begins with all that sticks and the contacts free that `open` has bits for.
    fn begin_with(&mut self, open: usize, c: &Collision<T>, phase: &Phase<T>) {
        self.pattern.pressed.clear();
        self.pattern.pressed.resize(c.touches.len(), false);
        for (bit, &k) in self.taking.iter().enumerate() {
            self.pattern.pressed[k] = open >> bit & 1 == 0;
        }
        self.list_acting(c, phase);
        self.choice.clear();
        self.choice.resize(self.acting.len(), 0);
    }

    /// The first solution from the present combination on, with the same contacts free.
    fn next_solution(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        loop {
            if self.attempt_choice(c, phase) {
                return true;
            }
            if !self.next_choice(c) {
                return false;
            }
        }
    }

    fn list_acting(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        self.acting.clear();
        for (r, rub) in c.rubs.iter().enumerate() {
            if self.pattern.bears(rub, phase) {
                self.acting.push(r);
            }
        }
    }

    /// The next combination of what the frictions do, the first one fastest.
    fn next_choice(&mut self, c: &Collision<T>) -> bool {
        for (choice, &r) in self.choice.iter_mut().zip(&self.acting) {
            *choice += 1;
            let states = if c.rubs[r].components == 1 { 3 } else { 2 };
            if *choice < states {
                return true;
            }
            *choice = 0;
        }
        false
    }

    fn attempt_choice(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let pattern = &mut self.pattern;
        pattern.slides.clear();
        pattern.slides.resize(c.rubs.len(), Slide::Idle);
        for (&choice, &r) in self.choice.iter().zip(&self.acting) {
            pattern.slides[r] = match (choice, c.rubs[r].components) {
                (0, _) => Slide::Stick,
                (1, 1) => Slide::Along(1.0),
                (_, 1) => Slide::Along(-1.0),
                _ => Slide::Turning([1.0, 0.0]),
            };
        }
        self.attempt(c, phase)
    }
}

impl<T: Scalar> Collision<T> {
    /// Frictions that can act.
    pub(super) fn acting(&self, phase: &Phase<T>) -> impl Iterator<Item = &FrictionRow<T>> {
        let rubs = self.rubs.iter();
        rubs.filter(|rub| rub.is_rough() && phase.includes(rub))
    }
}

impl<T: Scalar> Pattern<T> {
    /// Whether friction holds fast between several contacts: of many combinations those with other contacts pressed are looked at only then.
    fn may_jam(&self, c: &Collision<T>) -> bool {
        let holds = |(rub, slide): (&FrictionRow<T>, &Slide)| {
            *slide == Slide::Stick && matches!(rub.bearer, NormalSource::ContactRow(_))
        };
        self.pressed.iter().filter(|pressed| **pressed).count() > 1
            && c.rubs.iter().zip(&self.slides).any(holds)
    }

    /// Whether another solution leaves the same rates.
    fn moves_as(&self, other: &Pattern<T>) -> bool {
        let size = self.after.iter().chain(&other.after);
        let size = size.fold(0.0_f64, |size, rate| size.max(rate.value().abs()));
        let noises = self.noise.iter().zip(&other.noise);
        let rates = self.after.iter().zip(&other.after).zip(noises);
        rates.into_iter().all(|((a, b), (noise, more))| {
            (*a - *b).value().abs() <= SAME * size + 10.0 * (noise + more)
        })
    }

    /// Λᵀ G Λ
    fn jump(&self, phase: &Phase<T>) -> f64 {
        let changes = self.after.iter().zip(&phase.rates);
        let changes = changes.map(|(after, before)| (*after - *before).value());
        let all = self.impulses.iter().zip(changes);
        all.map(|(impulse, change)| impulse.value() * change).sum()
    }
}
