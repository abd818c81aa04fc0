//! The scenes, one file each. In the plane, with the height counted upward.
//!
//! Outer scenes (something on top of something round) measure θ from the **upward** vertical, clockwise, so that
//! `x = r sin θ`, `y = r cos θ`. The bowl measures it from the **downward** vertical, counter-clockwise, so that
//! its rest position is θ = 0, and so do the pendulums. A body's own rotation φ turns the same way as θ.
//!
//! The scenes without contacts are smooth: they are here to compare methods, and begin as in the literature.

mod cartesian_pendulum;
mod chain;
mod double_pendulum;
mod five_link_chain;
pub mod hard;
mod kepler;
mod mass_on_shell;
mod mass_on_wheel;
mod net;
mod rolling_slipping_sphere;
mod rolling_sphere;
mod sphere_in_bowl;
mod stiff_spring_pendulum;

pub use cartesian_pendulum::CartesianPendulum;
pub use chain::{Chain10, Chain20, Chain50};
pub use double_pendulum::DoublePendulum;
pub use five_link_chain::FiveLinkChain;
pub use kepler::Kepler;
pub use mass_on_shell::MassOnShell;
pub use mass_on_wheel::MassOnWheel;
pub use net::Net;
pub use rolling_slipping_sphere::RollingSlippingSphere;
pub use rolling_sphere::RollingSphere;
pub use sphere_in_bowl::SphereInBowl;
pub use stiff_spring_pendulum::StiffSpringPendulum;
