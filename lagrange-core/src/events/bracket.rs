//! Where a function falls through zero of which there are no coefficients, but values anywhere on [0, 1].

/// A place and the value of the function there.
pub type Sample = (f64, f64);

/// So many times an interval is made longer, fourfold.
const MOST_PROBES: usize = 12;

/// So many secants a root takes at most.
const MOST_SECANTS: usize = 60;

/// Two samples with the zero between them, of which one is `start`; the zero is about `reach` away. Where there is no zero so far the values of both have one
/// sign. `None`: the function has no value at a place.
pub fn bracket(
    start: Sample,
    mut reach: f64,
    mut value_at: impl FnMut(f64) -> Option<f64>,
) -> Option<[Sample; 2]> {
    let [mut before, mut after] = [start; 2];
    for _ in 0..MOST_PROBES {
        if before.1 >= 0.0 && after.1 <= 0.0 {
            break;
        }
        let (s, probe) = if start.1 > 0.0 {
            ((start.0 + reach).min(1.0), &mut after)
        } else {
            ((start.0 - reach).max(0.0), &mut before)
        };
        *probe = (s, value_at(s)?);
        reach *= 4.0;
    }
    Some([before, after])
}

/// Where the function vanishes between two such samples, by secants that keep the zero between them (the Illinois algorithm, Dowell & Jarratt 1971). `None`: it
/// has no value at a place.
pub fn zero_between(
    [mut before, mut after]: [Sample; 2],
    mut value_at: impl FnMut(f64) -> Option<f64>,
) -> Option<f64> {
    let mut weights = [before.1, after.1];
    let mut moved = 0.0;
    for _ in 0..MOST_SECANTS {
        let (width, resolution) = (after.0 - before.0, 2.0 * f64::EPSILON * after.0);
        if before.1 == 0.0 || after.1 == 0.0 || width <= resolution {
            break;
        }
        let share = weights[0] / (weights[0] - weights[1]);
        let middle = before.0 + width * share;
        let s = middle.clamp(before.0 + 0.5 * resolution, after.0 - 0.5 * resolution);
        let value = value_at(s)?;
        let again = if value * moved > 0.0 { 0.5 } else { 1.0 };
        moved = value;
        if value > 0.0 {
            (before, weights) = ((s, value), [value, again * weights[1]]);
        } else {
            (after, weights) = ((s, value), [again * weights[0], value]);
        }
    }
    Some(if before.1.abs() < after.1.abs() {
        before.0
    } else {
        after.0
    })
}
