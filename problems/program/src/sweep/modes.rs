//! The switches of a run in their order, as one number that is kept like any other result of a sweep, and as words.
//!
//! The number has a digit for each switch, the first one lowest; the base is the number of switches that a scene can have, and two
//! more: for the end and for "and so on". As many are kept as whole numbers of a double have room for, 16 where there are eight
//! kinds. The same switch again and again counts once: how often a ball bounces does not make another sequence.

use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// The switches that a scene can have.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Switches {
    /// What each is about, in a word what happens, and both as they are told.
    kinds: Vec<(Subject, &'static str, String)>,
}

impl Switches {
    pub(super) fn of(d: &'static Description) -> Self {
        let contacts = (0..d.contacts.len()).map(Subject::Contact);
        let impact = [
            EventKind::Lost,
            EventKind::Closed,
            EventKind::Impact,
            EventKind::Accumulates { impacts: 0 },
        ];
        let frictions = (0..d.frictions.len()).map(Subject::Friction);
        let slip = [EventKind::Slips, EventKind::Sticks, EventKind::Reverses];
        let branches = (0..d.branches.len()).map(Subject::Branch);
        let stops = (0..d.stops.len()).map(Subject::Stop);
        let all = contacts.flat_map(|subject| impact.map(|kind| (subject, kind)));
        let all = all.chain(frictions.flat_map(|subject| slip.map(|kind| (subject, kind))));
        let all = all.chain(branches.map(|subject| (subject, EventKind::Branches)));
        let all = all.chain(stops.map(|subject| (subject, EventKind::Stop)));
        let told = all.map(|(subject, kind)| {
            let words = format!("{} {}", subject.name(d), kind.word());
            (subject, kind.word(), words)
        });
        Self {
            kinds: told.collect(),
        }
    }

    /// Digits that there are: one for each switch, the end and "and so on".
    fn base(&self) -> u64 {
        self.kinds.len() as u64 + 2
    }

    /// Switches that a number has room for.
    fn room(&self) -> usize {
        (f64::from(f64::MANTISSA_DIGITS) / (self.base() as f64).log2()) as usize
    }

    /// The number of a run's events; marks are no switches.
    pub(super) fn number(&self, events: &[Event<f64>]) -> f64 {
        let digit = |event: &Event<f64>| {
            let same = |(subject, word, _): &(Subject, &str, String)| {
                *subject == event.subject && *word == event.kind.word()
            };
            Some(self.kinds.iter().position(same)? as u64 + 1)
        };
        let mut digits: Vec<u64> = events.iter().filter_map(digit).collect();
        digits.dedup();
        if digits.len() > self.room() {
            digits.truncate(self.room() - 1);
            digits.push(self.base() - 1);
        }
        digits
            .iter()
            .rfold(0, |number, digit| number * self.base() + digit) as f64
    }

    /// A number in words, one for each switch.
    pub(super) fn words(&self, number: f64) -> Vec<&str> {
        let mut rest = number as u64;
        let mut words = Vec::new();
        while rest > 0 {
            let digit = (rest % self.base()) as usize;
            let kind = digit.checked_sub(1).and_then(|index| self.kinds.get(index));
            words.push(kind.map_or("…", |(_, _, words)| words.as_str()));
            rest /= self.base();
        }
        words
    }
}
