//! The switches of a run in their order, as one number that is kept like any other result of a sweep, and as words.
//!
//! ```text
//! few switches     digits, the first switch lowest
//! more             the first digits │ "and so on" │ a hash of all of them, 32 bits
//! ```
//!
//! The base of the digits is the number of switches that a scene can have, and two more: for the end and for "and so on". A sequence is
//! kept as it is where whole numbers of a double have room for it, 15 switches where there are eight kinds. Else its first ones are
//! read, and the hash tells it from others that begin alike. The same switch again and again counts once: how often a ball bounces does
//! not make another sequence.

use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use twox_hash::XxHash64;

/// Bits of the hash.
const HASH: u32 = 32;

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

    /// Switches that so many bits have room for.
    fn room(&self, bits: u32) -> usize {
        (f64::from(bits) / (self.base() as f64).log2()) as usize
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
        self.packed(digits)
    }

    fn packed(&self, mut digits: Vec<u64>) -> f64 {
        let mut rest = 0;
        if digits.len() > self.room(f64::MANTISSA_DIGITS) {
            let bytes: Vec<u8> = digits
                .iter()
                .flat_map(|digit| digit.to_le_bytes())
                .collect();
            rest = XxHash64::oneshot(0, &bytes) >> (u64::BITS - HASH);
            let readable = self.room(f64::MANTISSA_DIGITS - HASH);
            digits.truncate(readable.saturating_sub(1));
            digits.push(self.base() - 1);
        }
        digits
            .iter()
            .rfold(rest, |number, digit| number * self.base() + digit) as f64
    }

    /// A number in words, one for each switch, and one for all that it has no room for.
    pub(super) fn words(&self, number: f64) -> Vec<String> {
        let mut rest = number as u64;
        let mut words = Vec::new();
        while rest > 0 {
            let digit = (rest % self.base()) as usize;
            rest /= self.base();
            match digit.checked_sub(1).and_then(|index| self.kinds.get(index)) {
                Some((_, _, switch)) => words.push(switch.clone()),
                None => {
                    words.push(format!("… {rest:08x}"));
                    break;
                }
            }
        }
        words
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file;
    use std::collections::BTreeSet;

    /// Two switches that take turns in all ways: 2ⁿ sequences of n, of which those of 40 differ from others in one place alone.
    #[test]
    fn sequences_that_differ_have_different_numbers() {
        let declared = "coordinates(x, y), kinetic = der(x)^2 + der(y)^2, contact(floor: x >= 0), contact(wall: y >= 0)";
        let scene = file::scene("switches.lagrange", declared).expect("a declaration");
        let switches = Switches::of(scene.description());
        assert_eq!(switches.base(), 10);
        let short = [1, 4, 2, 8, 5, 7, 1, 3, 1, 2, 3, 4, 5, 6, 7].to_vec();
        let all = switches.words(switches.packed(short.clone()));
        let told = short
            .iter()
            .map(|digit| &switches.kinds[*digit as usize - 1].2);
        assert!(all.iter().eq(told), "{all:?}");
        let long: Vec<u64> = (0..40).map(|k| 1 + k % 3).collect();
        let others = (0..40).map(|k| {
            let mut other = long.clone();
            other[k] = 7;
            other
        });
        let others = others.chain([long.clone(), long[..39].to_vec()]);
        let numbers: BTreeSet<u64> = others.map(|it| switches.packed(it) as u64).collect();
        assert_eq!(numbers.len(), 42);
        assert!(
            numbers
                .iter()
                .all(|number| *number < 1 << f64::MANTISSA_DIGITS)
        );
        let words = switches.words(switches.packed(long));
        assert_eq!(words[..2], ["floor lost", "floor closed"]);
        let [.., last] = &words[..] else {
            panic!("words")
        };
        assert!(last.starts_with("… ") && words.len() == 6, "{words:?}");
    }
}
