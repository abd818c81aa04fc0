//! All combinations in order: contacts pressed before free, frictions sticking before sliding.

use super::Search;
use crate::arithmetic::Scalar;
use crate::modes::impact::collision::Collision;
use crate::modes::impact::pattern::{Phase, Slide};

impl<T: Scalar> Search<T> {
    /// Number of combinations, unless it is beyond counting.
    pub(super) fn combinations(&self, c: &Collision<T>) -> Option<usize> {
        let contacts = 1_usize.checked_shl(self.taking.len() as u32)?;
        c.rubs.iter().try_fold(contacts, |n, rub| {
            n.checked_mul(if rub.components == 1 { 3 } else { 2 })
        })
    }

    pub(super) fn enumerate(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        for open in 0..1_usize << self.taking.len() {
            self.pattern.pressed.clear();
            self.pattern.pressed.resize(c.touches.len(), false);
            for (bit, &k) in self.taking.iter().enumerate() {
                self.pattern.pressed[k] = open >> bit & 1 == 0;
            }
            self.list_acting(c, phase);
            self.choice.clear();
            self.choice.resize(self.acting.len(), 0);
            loop {
                if self.attempt_choice(c, phase) {
                    return true;
                }
                if !self.next_choice(c) {
                    break;
                }
            }
        }
        false
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
