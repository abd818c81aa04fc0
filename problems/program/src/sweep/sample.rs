//! Numbers that look random and depend on a seed and on their own number alone, so that any machine can make any of them.

/// Spreads 64 bits (the finaliser of SplitMix64: Steele, Lea and Flood 2014, Fast splittable pseudorandom number generators).
pub(super) fn mix(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Number `index` of SplitMix64.
fn split_mix(start: u64, index: u64) -> u64 {
    mix(start.wrapping_add(0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(index.wrapping_add(1))))
}

/// From 64 bits to [0, 1), in steps of 2⁻⁵³.
pub(super) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Where the numbers of a dimension start.
fn start(seed: u64, dimension: usize) -> u64 {
    split_mix(split_mix(0, seed), dimension as u64)
}

/// A coordinate of random point number `index`, in [0, 1).
pub(super) fn random(seed: u64, dimension: usize, index: u64) -> f64 {
    unit(split_mix(start(seed, dimension), index))
}

/// A coordinate of point number `index` of `count` of a Latin hypercube, in [0, 1).
pub(super) fn latin(seed: u64, dimension: usize, index: u64, count: u64) -> f64 {
    let key = mix(start(seed, dimension));
    let slice = shuffled(key, index, count);
    let within = random(seed, dimension, index);
    // Not rounded up into the next slice.
    ((slice as f64 + within) / count as f64).min(((slice + 1) as f64 / count as f64).next_down())
}

/// Where `index` comes in a shuffle of `count` numbers: a cipher of four rounds (Luby and Rackoff 1988) on the next power of four, again
/// until the number is one of them (Black and Rogaway 2002).
fn shuffled(key: u64, index: u64, count: u64) -> u64 {
    let half = (64 - (count - 1).leading_zeros()).div_ceil(2);
    let mask = (1 << half) - 1;
    let mut index = index;
    loop {
        let (mut left, mut right) = (index >> half, index & mask);
        for round in 0..4 {
            let turned = left ^ (split_mix(key ^ right, round) & mask);
            (left, right) = (right, turned);
        }
        index = (left << half) | right;
        if index < count {
            return index;
        }
    }
}
