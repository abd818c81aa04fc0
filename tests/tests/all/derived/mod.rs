//! Generated equations against equations derived by hand, in every mode of every scene, at random parameters and states.
//!
//! Mass matrix, forcing and rows hold anywhere, so the states are arbitrary. Accelerations and forces are compared with
//! the textbook's formulas in minimal coordinates, so the states are on the constraints of the mode.

mod shell;
mod sphere;
mod wheel;

use lagrange_core::mode::Mode;
use lagrange_core::system::Derived;
use lagrange_tests::equations::Equations;
use lagrange_tests::{agree, all_agree};

/// Random states in each mode.
const STATES: usize = 250;

/// Relative difference that rounding explains.
const ROUNDING: f64 = 1e-12;

/// What the textbook says at one state.
struct Textbook {
    /// v̇
    acceleration: Vec<f64>,
    /// Force of each row.
    force: Vec<f64>,
}

/// Compares accelerations and forces at a state, which must be on the constraints of the mode.
#[track_caller]
fn check_motion<S: Derived<Scalar = f64>>(
    scene: &S,
    mode: &Mode,
    q: &[f64],
    v: &[f64],
    book: &Textbook,
) {
    let found = Equations::of(scene, mode, q, v);
    all_agree(
        "acceleration",
        &found.acceleration,
        &book.acceleration,
        ROUNDING,
    );
    all_agree("force", &found.force, &book.force, ROUNDING);
}

/// Compares mass matrix and forcing, anywhere.
#[track_caller]
fn check_inertia<S: Derived<Scalar = f64>>(
    scene: &S,
    mode: &Mode,
    q: &[f64],
    v: &[f64],
    mass: &[Vec<f64>],
    forcing: &[f64],
) {
    let found = Equations::of(scene, mode, q, v);
    let size = mass.iter().flatten().fold(1.0_f64, |m, x| m.max(x.abs()));
    for (i, (found, mass)) in found.mass.iter().zip(mass).enumerate() {
        for (j, (found, mass)) in found.iter().zip(mass).enumerate() {
            agree(format!("M[{i}][{j}]"), found / size, mass / size, ROUNDING);
        }
    }
    all_agree("forcing", &found.forcing, forcing, ROUNDING);
}

/// What a row must be: a, γ, g (0 at velocity level), velocity.
struct HandRow {
    jacobian: Vec<f64>,
    bias: f64,
    position: f64,
    velocity: f64,
}

#[track_caller]
fn check_row<S: Derived<Scalar = f64>>(
    scene: &S,
    mode: &Mode,
    q: &[f64],
    v: &[f64],
    row: usize,
    hand: &HandRow,
) {
    let found = Equations::of(scene, mode, q, v);
    all_agree("row", &found.jacobian[row], &hand.jacobian, ROUNDING);
    let size = v.iter().chain(q).fold(1.0_f64, |m, x| m.max(x.abs()));
    agree("bias", found.bias[row], hand.bias, ROUNDING * size * size);
    agree(
        "position",
        found.position[row],
        hand.position,
        ROUNDING * size,
    );
    agree(
        "velocity",
        found.velocity[row],
        hand.velocity,
        ROUNDING * size,
    );
}
