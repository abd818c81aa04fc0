//! Why a position of a mode has no motion.

use crate::symbolic::field::Trouble;

/// Why there is no motion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Stuck {
    /// A number has no value here.
    Trouble(Trouble),
    /// The equations of the mode contradict each other.
    Impossible,
}

impl From<Trouble> for Stuck {
    fn from(trouble: Trouble) -> Stuck {
        Stuck::Trouble(trouble)
    }
}
