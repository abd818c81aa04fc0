//! What is kept beside each node of a pool.

/// What is kept beside each node.
#[derive(Clone, Copy)]
pub(super) struct Facts {
    pub(super) hash: u64,
    /// Bit (index mod 63) of each symbol that occurs: a quick "does not depend on". Bit 63: holds a selection.
    pub(super) symbols: u64,
    /// A product with a factor sin², cos², sinh² or cosh².
    pub(super) square: bool,
    /// A product with a factor exp or a general power, which merge with their like.
    pub(super) merging: bool,
    /// Holds a symbol that is not fixed, or a selection.
    pub(super) varies: bool,
}
