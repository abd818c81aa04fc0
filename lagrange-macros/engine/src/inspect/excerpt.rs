//! Of many items only the first ones and the last one are shown.

/// Of so many items all are shown.
const MOST_SHOWN: usize = 12;
/// Of more these, and the last one.
const FIRST_SHOWN: usize = 4;

/// Which of so many items are shown.
pub(super) fn excerpt(count: usize) -> Vec<usize> {
    match count {
        0..=MOST_SHOWN => (0..count).collect(),
        _ => (0..FIRST_SHOWN).chain([count - 1]).collect(),
    }
}
