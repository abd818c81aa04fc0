//! Squares of sines and cosines in products.

use super::ExprId;

/// One way to see a product as X · f(u)².
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Square {
    /// X
    pub(super) rest: ExprId,
    /// u
    pub(super) argument: ExprId,
    /// sinh and cosh instead of sin and cos.
    pub(super) hyperbolic: bool,
    /// cos or cosh.
    pub(super) cosine: bool,
}
