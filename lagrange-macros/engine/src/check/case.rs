//! A claim in a mode.

use super::mechanics::Mechanics;
use super::motion::Tie;
use crate::modes::Mode;
use crate::symbolic::ExprId;

/// Everything in the free symbols of a sheet.
pub(super) struct Case<'a> {
    pub mechanics: &'a Mechanics<'a>,
    pub mode: &'a Mode,
    pub ties: &'a [Tie],
    /// Independent rows on position level.
    pub positions: &'a [usize],
    /// left − right
    pub claim: ExprId,
    /// Branches that the mode and the conditions decide.
    pub decided: &'a [(usize, bool)],
}
