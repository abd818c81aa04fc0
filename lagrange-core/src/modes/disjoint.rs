//! Disjoint sets of items: each item refers to one of its set that is not behind it, the first of a set to itself.

/// Every item a set of its own.
pub fn separate(sets: &mut Vec<usize>, count: usize) {
    sets.clear();
    sets.extend(0..count);
}

/// The first item of a set.
pub fn first(sets: &[usize], mut item: usize) -> usize {
    while sets[item] != item {
        item = sets[item];
    }
    item
}

/// Makes one set of those of two items.
pub fn join(sets: &mut [usize], a: usize, b: usize) {
    let (a, b) = (first(sets, a), first(sets, b));
    sets[a.max(b)] = a.min(b);
}
