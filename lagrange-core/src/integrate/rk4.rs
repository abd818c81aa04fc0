//! The classical Runge–Kutta method of order 4 with fixed steps (Kutta 1901). Dense output is a Hermite polynomial.

use super::control::Control;
use super::tableau::{Estimate, Tableau};

pub(super) static TABLEAU: Tableau = Tableau {
    order: 4,
    nodes: &[0.0, 0.5, 0.5, 1.0, 1.0],
    stages: &[
        &[],
        &[(0, 0.5)],
        &[(1, 0.5)],
        &[(2, 1.0)],
        &[
            (0, 1.0 / 6.0),
            (1, 1.0 / 3.0),
            (2, 1.0 / 3.0),
            (3, 1.0 / 6.0),
        ],
    ],
    end: 4,
    estimate: Estimate::None,
    dense: &[],
    // Never asked: steps are not judged.
    control: Control {
        order: 4,
        beta: 0.0,
        safety: 0.9,
        shrink: 0.2,
        grow: 1.0,
    },
};
