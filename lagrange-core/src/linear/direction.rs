//! The direction of a vector of forces or impulses that follow from it, by Newton's method.
//!
//! N = |λ| is homogeneous, so that u·λ with u along λ is its tangent: a solution is found with u, u is taken anew from it, and what it misses squares itself.

use crate::arithmetic::Scalar;

/// What is across of a vector, as a part of it, where u has its direction: N misses the square of that.
const ALONG: f64 = 1e-13;

/// Where that no longer shrinks, this is as good; a direction that is not found to this part is not found.
const FOUND: f64 = 1e-6;

/// So often is a direction taken anew.
const MOST_TURNS: usize = 60;

/// Up to three elements; those that there are not are zero.
pub(crate) type Vector<T> = [T; 3];

pub(crate) fn dot<T: Scalar>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn length<T: Scalar>(x: Vector<T>) -> T {
    dot(x, x).sqrt()
}

/// Whether a component `across` a vector of this size counts as zero, as far as a direction can be found.
pub(crate) fn is_along(across: f64, size: f64) -> bool {
    across <= FOUND * size
}

/// Takes a direction anew until it settles; `turn` solves with the one there is, and says what has been across of what it found. False if it does
/// not settle; numbers with derivatives take one more turn, because those of a direction follow from those of what was found with it.
pub(crate) fn settle<T: Scalar, E>(mut turn: impl FnMut() -> Result<f64, E>) -> Result<bool, E> {
    let mut least = f64::INFINITY;
    let mut more = usize::from(T::DERIVATIVES > 0);
    for _ in 0..MOST_TURNS {
        let across = turn()?;
        let settled = across <= ALONG || across < FOUND && across >= 0.5 * least;
        if settled && more == 0 {
            return Ok(true);
        }
        more -= usize::from(settled);
        least = least.min(across);
    }
    Ok(false)
}
