//! Mechanical systems with constraints, contacts and friction: written down once, on a struct, as in a textbook.
//!
//! [`#[derive(Lagrangian)]`](macro@Lagrangian) derives the equations of motion when the struct is compiled, for every mode that contacts
//! and frictions can be in; a [`Simulation`] integrates them, finds every switch, and knows every force.
//!
//! ```
//! use lagrange_core::prelude::*;
//!
//! /// A pendulum in Cartesian coordinates: the rod is a constraint.
//! #[derive(Lagrangian, Clone, Debug)]
//! #[lagrange(
//!     coordinates(x, y),
//!     kinetic   = mass/2 * (der(x)^2 + der(y)^2),
//!     potential = mass * gravity * y,
//!     constraint(rod: x^2 + y^2 == l^2),
//!     start(held: x = l),
//! )]
//! struct Pendulum {
//!     mass: f64,
//!     gravity: f64,
//!     l: f64,
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let pendulum = Pendulum { mass: 1.0, gravity: 9.81, l: 1.0 };
//!     let start = pendulum.at(Pendulum::HELD);
//!     let trajectory = Simulation::new(&pendulum).tolerance(1e-12).run(start, 0.0..5.0)?;
//!     let mut sampler = trajectory.sampler();
//!     let now = sampler.at(1.0)?;
//!     println!("x = {}, y = {}, λ = {}", now.q(Pendulum::X), now.q(Pendulum::Y), now.force(Pendulum::ROD));
//!
//!     // The tension −2 l λ of a pendulum that fell from the horizontal is 3 m g cos φ.
//!     let tension = -2.0 * pendulum.l * now.force(Pendulum::ROD);
//!     assert!((tension + 3.0 * 9.81 * now.q(Pendulum::Y)).abs() < 1e-10);
//!     Ok(())
//! }
//! ```
//!
//! * [The language](macro@Lagrangian#the-language): all items of `#[lagrange(…)]` and what expressions may contain.
//! * [`Simulation`]: tolerance, method, effects, when to end. [`Runner`] and [`Ensemble`] make many runs of one system.
//! * [`trajectory`]: states, forces, events and the energy ledger of a run; `now.force(Pendulum::ROD)` asks by [`handle`].
//! * [`error::Error`]: what can go wrong, with the numbers that say where.
//! * [`checks`]: formulas derived by hand, held against the derived equations.
//! * [`arithmetic::Dual`]: derivatives of whole runs by parameters and start.
//! * [`system`]: what the macro implements, for who looks inside.

// The derive macro names this crate by its path, also inside it.
extern crate self as lagrange_core;

pub mod arithmetic;
pub mod certificate;
pub mod checks;
pub mod code;
pub mod declaration;
mod derivation;
pub mod dynamics;
pub mod effects;
mod entries;
pub mod equations;
pub mod error;
pub mod events;
pub mod handle;
pub mod integrate;
mod linear;
pub mod mode;
mod modes;
mod monitor;
mod pool;
pub mod prelude;
mod run;
pub mod simulation;
pub mod system;
mod tapes;
pub mod trajectory;

pub use derivation::Derivation;
pub use error::Error;
#[cfg(feature = "derive")]
pub use lagrange_macros::Lagrangian;
pub use monitor::Monitor;
pub use run::{Ensemble, Runner};
pub use simulation::{Awaited, Equations, Failure, Held, Simulation};
