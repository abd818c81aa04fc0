//! Sets of squares; a bit each.

/// Which squares.
pub(super) type Set = Vec<u64>;

/// The empty set of so many squares.
pub(super) fn empty(squares: usize) -> Set {
    vec![0; squares.div_ceil(64)]
}

/// Adds a square.
pub(super) fn insert(set: &mut Set, square: usize) {
    set[square / 64] |= 1 << (square % 64);
}

/// What two sets have in common.
pub(super) fn common(a: &Set, b: &Set) -> Set {
    a.iter().zip(b).map(|(a, b)| a & b).collect()
}

/// The members of a set, ascending.
pub(super) fn members(set: &Set) -> impl Iterator<Item = usize> + '_ {
    let bits = |(word, &bits): (usize, &u64)| {
        (0..64)
            .filter(move |bit| bits >> bit & 1 == 1)
            .map(move |bit| 64 * word + bit)
    };
    set.iter().enumerate().flat_map(bits)
}
