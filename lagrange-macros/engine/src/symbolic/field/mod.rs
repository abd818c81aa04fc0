//! Values of expressions in a finite field: exact, fast, and equal for equal expressions whatever their form.
//!
//! ```text
//! symbols            random elements, or what the caller binds
//! sin u, cos u       u = Σ cᵢ tᵢ: every tᵢ/D is a random point of the circle, D the common denominator of all cᵢ
//! exp, sinh, cosh    the same with a random square for exp(tᵢ/D)
//! u^(m/n)            the root that is a square; u must be one (another point is taken if it is not)
//! other functions    a random element for every value of the argument
//! ```
//!
//! A rational function of total degree d that is not zero vanishes at a random point of a field of p elements with
//! probability ≤ d/p (Schwartz, J. ACM 27, 1980; Zippel, EUROSAM 1979), so at independent points in both fields of
//! [`PRIMES`] with probability ≤ d²/2^123. Zero at the points is thus zero; not zero is proof of not zero where
//! all atoms are independent: see [`Point::is_exact`].
//!
//! Atoms are found by value: arguments that are equal as expressions have equal values and get the same atom.

mod angles;
mod complex;
mod degree;
mod point;
mod prime;
#[cfg(test)]
mod tests;
mod values;

pub use angles::Angles;
pub use degree::Degree;
pub use point::{FieldValue, Point, Trouble};
pub use prime::{PRIMES, Prime};
