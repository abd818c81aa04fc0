//! What the results are compared with: quadrature, elliptic functions, roots, an integrator; nothing in common with the
//! library.

mod elliptic;
mod extrapolation;
mod quadrature;

pub use elliptic::{agm, jacobi};
pub use extrapolation::extrapolate;
pub use quadrature::{integral, over_a_turn};

/// The root of `f` in [low, high], which must change sign there, to the last bit by bisection.
pub fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(low) < 0.0;
    assert_ne!(
        rising,
        f(high) < 0.0,
        "no change of sign in [{low}, {high}]"
    );
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
