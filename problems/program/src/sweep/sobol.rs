//! Points of a Sobol sequence, scrambled.
//!
//! Coordinate d of point i is ⊕ₖ iₖ Vₖ over the bits of i, with direction numbers V that a primitive polynomial makes of a few first ones
//! (Sobol 1967; the numbers of Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections", file
//! new-joe-kuo-6). Scrambling (Owen 1995) then turns each bit around, or does not, as a hash of the bits before it says: the points stay
//! as even, and are otherwise random.

use super::sample::{mix, random, unit};

/// Bits of the number of a point.
const BITS: usize = 32;

/// Per dimension after the first: the inner coefficients of its polynomial, as bits, and its first direction integers.
#[rustfmt::skip]
const NUMBERS: [(u32, &[u64]); 31] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, &[1, 1, 3, 13, 7, 35, 63]),
    (8, &[1, 3, 5, 9, 1, 25, 53]),
    (14, &[1, 3, 1, 13, 9, 35, 107]),
    (19, &[1, 3, 1, 5, 27, 61, 31]),
    (21, &[1, 1, 5, 11, 19, 41, 61]),
    (28, &[1, 3, 5, 3, 3, 13, 69]),
    (31, &[1, 1, 7, 13, 1, 19, 1]),
    (32, &[1, 3, 7, 5, 13, 19, 59]),
    (37, &[1, 1, 3, 9, 25, 29, 41]),
    (41, &[1, 3, 5, 13, 23, 1, 55]),
    (42, &[1, 3, 7, 3, 13, 59, 17]),
];

/// Direction numbers Vₖ, as binary fractions with 64 digits.
static DIRECTIONS: [[u64; BITS]; NUMBERS.len() + 1] = directions();

const fn directions() -> [[u64; BITS]; NUMBERS.len() + 1] {
    let mut all = [[0; BITS]; NUMBERS.len() + 1];
    let mut k = 0;
    while k < BITS {
        all[0][k] = 1 << (63 - k);
        k += 1;
    }
    let mut d = 0;
    while d < NUMBERS.len() {
        let (coefficients, first) = NUMBERS[d];
        let degree = first.len();
        let v = &mut all[d + 1];
        let mut k = 0;
        while k < BITS {
            if k < degree {
                v[k] = first[k] << (63 - k);
            } else {
                v[k] = v[k - degree] ^ (v[k - degree] >> degree);
                let mut j = 1;
                while j < degree {
                    if (coefficients >> (degree - 1 - j)) & 1 == 1 {
                        v[k] ^= v[k - j];
                    }
                    j += 1;
                }
            }
            k += 1;
        }
        d += 1;
    }
    all
}

/// A coordinate of point number `index`, in [0, 1). Beyond the dimensions that there are numbers for, it is random.
pub(super) fn coordinate(seed: u64, dimension: usize, index: u64) -> f64 {
    let Some(directions) = DIRECTIONS.get(dimension) else {
        return random(seed, dimension, index);
    };
    let set = directions
        .iter()
        .enumerate()
        .filter(|(k, _)| (index >> k) & 1 == 1);
    let plain = set.fold(0, |sum, (_, direction)| sum ^ direction);
    let key = mix(mix(seed) ^ dimension as u64);
    // The digits that a double has room for.
    let scrambled = (0..53).fold(plain, |scrambled, k| {
        // A one, then the digits before digit k: another number for each branch of the tree.
        let before = ((1 << 63) | (plain >> 1)) >> (63 - k);
        scrambled ^ ((mix(key ^ before) >> 63) << (63 - k))
    });
    unit(scrambled)
}

#[cfg(test)]
mod tests {
    use super::{DIRECTIONS, coordinate};

    #[test]
    fn every_dimension_and_neighbouring_pair_is_even() {
        for dimension in 0..DIRECTIONS.len() {
            // 256 points, one in each interval of 1/256.
            let mut intervals = [0; 256];
            for index in 0..256 {
                intervals[(coordinate(3, dimension, index) * 256.0) as usize] += 1;
            }
            assert_eq!(intervals, [1; 256], "{dimension}");
        }
    }

    #[test]
    fn an_integral_converges_faster_than_by_chance() {
        // ∫ Π (1 + (xᵢ − ½)) over the unit cube of 6 dimensions = 1.
        let value = |index| -> f64 { (0..6).map(|d| 0.5 + coordinate(1, d, index)).product() };
        let mean = (0..1 << 14).map(value).sum::<f64>() / f64::from(1 << 14);
        // By chance: √((13/12)⁶ − 1) / 2⁷ = 0.006.
        assert!((mean - 1.0).abs() < 1e-4, "{mean}");
    }
}
