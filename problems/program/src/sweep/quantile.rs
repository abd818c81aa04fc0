//! Exact quantiles of numbers that are read again and again instead of being held in memory.
//!
//! The numbers are sorted into 2¹⁶ boxes by their first 16 bits, then those of the boxes of interest by the next 16, and so on: after
//! four readings the numbers of any ranks are known to the last bit.

use std::collections::BTreeMap;

/// Bits told apart by a reading.
const BITS: u32 = 16;

/// Bits that tell the boxes of a shelf apart, and half of all bits of a reading.
const SHELF: u32 = BITS / 2;

/// Readings that it takes.
pub(super) const READINGS: u32 = 64 / BITS;

/// A number of a certain rank, as far as it is known.
#[derive(Clone, Copy)]
struct Sought {
    /// Its first bits.
    prefix: u64,
    /// Its rank among the numbers that begin with these.
    rank: u64,
}

/// How many numbers of a reading fall into each box, and into each shelf of 2⁸ boxes: few boxes are looked at to find a rank.
struct Boxes {
    shelves: [u64; 1 << SHELF],
    boxes: Vec<u64>,
}

impl Boxes {
    fn empty() -> Self {
        Self {
            shelves: [0; 1 << SHELF],
            boxes: vec![0; 1 << BITS],
        }
    }

    fn take(&mut self, place: usize) {
        self.shelves[place >> SHELF] += 1;
        self.boxes[place] += 1;
    }

    /// The box of the number of a rank, and its rank in there.
    fn find(&self, rank: u64) -> (usize, u64) {
        let (shelf, rank) = first_above(&self.shelves, rank);
        let first = shelf << SHELF;
        let (place, rank) = first_above(&self.boxes[first..first + (1 << SHELF)], rank);
        (first + place, rank)
    }
}

/// The part of a rank, of parts of so many numbers, and its rank in there.
fn first_above(counts: &[u64], mut rank: u64) -> (usize, u64) {
    let mut place = 0;
    while place + 1 < counts.len() && rank >= counts[place] {
        rank -= counts[place];
        place += 1;
    }
    (place, rank)
}

/// The search for some quantiles.
pub(super) struct Search {
    parts: Vec<f64>,
    count: usize,
    /// Two for each quantile: what it lies between.
    sought: Vec<Sought>,
    /// By prefix.
    boxes: BTreeMap<u64, Boxes>,
    /// Bits that are known.
    known: u32,
}

impl Search {
    /// For the quantiles at `parts`, 0 … 1, of so many numbers.
    pub(super) fn new(parts: &[f64], count: usize) -> Self {
        let last = count.saturating_sub(1);
        let sought = parts.iter().flat_map(|part| {
            let below = ((part * last as f64) as usize).min(last);
            [below, (below + 1).min(last)].map(|rank| Sought {
                prefix: 0,
                rank: rank as u64,
            })
        });
        let mut search = Self {
            parts: parts.to_vec(),
            count,
            sought: sought.collect(),
            boxes: BTreeMap::new(),
            known: 0,
        };
        search.open();
        search
    }

    fn open(&mut self) {
        let empty = |sought: &Sought| (sought.prefix, Boxes::empty());
        self.boxes = self.sought.iter().map(empty).collect();
    }

    /// Takes a number of a reading.
    pub(super) fn take(&mut self, number: f64) {
        let key = key(number);
        let prefix = key.checked_shr(64 - self.known).unwrap_or(0);
        if let Some(boxes) = self.boxes.get_mut(&prefix) {
            boxes.take(place(key, self.known));
        }
    }

    /// Ends a reading.
    pub(super) fn narrow(&mut self) {
        for sought in &mut self.sought {
            let Some(boxes) = self.boxes.get(&sought.prefix) else {
                continue;
            };
            let (place, rank) = boxes.find(sought.rank);
            sought.prefix = sought.prefix << BITS | place as u64;
            sought.rank = rank;
        }
        self.known += BITS;
        if self.known < 64 {
            self.open();
        }
    }

    /// The quantiles, interpolated between ranks (type 7 of Hyndman and Fan 1996, as NumPy does), when all readings are done.
    pub(super) fn found(&self) -> Vec<f64> {
        let pairs = self.parts.iter().zip(self.sought.as_chunks::<2>().0);
        pairs
            .map(|(part, [below, above])| {
                let within = (part * self.count.saturating_sub(1) as f64).fract();
                let (below, above) = (number(below.prefix), number(above.prefix));
                match below == above {
                    true => below,
                    false => below + within * (above - below),
                }
            })
            .collect()
    }
}

/// The next bits of a key of which some are known.
fn place(key: u64, known: u32) -> usize {
    (key >> (64 - BITS - known)) as usize & ((1 << BITS) - 1)
}

/// Whole numbers in the order of the numbers.
fn key(number: f64) -> u64 {
    let bits = number.to_bits();
    match bits >> 63 {
        0 => bits | 1 << 63,
        _ => !bits,
    }
}

/// The number of a key.
fn number(key: u64) -> f64 {
    f64::from_bits(match key >> 63 {
        0 => !key,
        _ => key & !(1 << 63),
    })
}

#[cfg(test)]
mod tests {
    use super::{READINGS, Search};

    fn quantiles(numbers: &[f64], parts: &[f64]) -> Vec<f64> {
        let mut search = Search::new(parts, numbers.len());
        for _ in 0..READINGS {
            numbers.iter().for_each(|x| search.take(*x));
            search.narrow();
        }
        search.found()
    }

    #[test]
    fn they_are_those_of_the_sorted_numbers() {
        let parts = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];
        // numpy.quantile(x, parts) for x = [3, −1, 4, 1, −5, 9, 2, 6]
        let expected = [-5.0, -3.6, 0.5, 2.5, 4.5, 7.95, 9.0];
        let found = quantiles(&[3.0, -1.0, 4.0, 1.0, -5.0, 9.0, 2.0, 6.0], &parts);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
        assert_eq!(quantiles(&[7.25], &parts), [7.25; 7]);
        assert_eq!(quantiles(&[-2.0; 9], &parts), [-2.0; 7]);
        // Of a thousand numbers that differ in their last bits only.
        let close: Vec<f64> = (0..1001)
            .map(|i| 1.0 + f64::EPSILON * f64::from(i * 8 % 1001))
            .collect();
        assert_eq!(quantiles(&close, &[0.5]), [1.0 + 500.0 * f64::EPSILON]);
    }
}
