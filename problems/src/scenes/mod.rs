//! The scenes, one file each. In the plane, with the height counted upward.
//!
//! Outer scenes (something on top of something round) measure θ from the **upward** vertical, clockwise, so that
//! `x = r sin θ`, `y = r cos θ`. The bowl measures it from the **downward** vertical, counter-clockwise, so that
//! its rest position is θ = 0. A body's own rotation φ turns the same way as θ.

pub mod hard;
mod mass_on_shell;
mod mass_on_wheel;
mod rolling_slipping_sphere;
mod rolling_sphere;
mod sphere_in_bowl;

pub use mass_on_shell::MassOnShell;
pub use mass_on_wheel::MassOnWheel;
pub use rolling_slipping_sphere::RollingSlippingSphere;
pub use rolling_sphere::RollingSphere;
pub use sphere_in_bowl::SphereInBowl;
