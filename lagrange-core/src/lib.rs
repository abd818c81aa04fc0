//! Mechanical systems with constraints, contacts and friction: written down once, on a struct, as in a textbook.
//!
//! [`#[derive(Lagrangian)]`](macro@Lagrangian) derives the equations of motion when the struct is compiled, for every mode that contacts
//! and frictions can be in. A [`Simulation`] integrates them, finds every switch, and knows every force.
//!
//! ```
//! use lagrange_core::prelude::*;
//!
//! /// A small mass slides down a smooth ball.
//! #[derive(Lagrangian, Clone, Debug)]
//! #[lagrange(
//!     coordinates(r: "m", theta: "rad"),
//!     kinetic   = mass/2 * (der(r)^2 + r^2 * der(theta)^2),
//!     potential = mass * gravity * r * cos(theta),
//!     contact(ball: r >= radius),
//!     start(nudged: r = radius, theta = 0.1),
//! )]
//! struct MassOnBall { mass: f64, gravity: f64, radius: f64 }
//!
//! let scene = MassOnBall { mass: 1.0, gravity: 9.81, radius: 1.0 };
//! let run = Simulation::new(&scene).run(scene.at(MassOnBall::NUDGED), 0.0..1.0)?;
//! let lost = &run.events()[0];
//! println!("{lost}");
//! println!("at {:.4}°", lost.q(MassOnBall::THETA).to_degrees());
//! println!("N = {:.4} at 0.5 s", run.sampler().at(0.5)?.force(MassOnBall::BALL));
//! # assert!((lost.q(MassOnBall::THETA).cos() - 2.0 / 3.0 * 0.1_f64.cos()).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **[The book](book)** has a chapter for each subject; begin with [the language](book::language) and [results](book::results). The reference
//! is here:
//!
//! * [`Lagrangian`](macro@Lagrangian#the-language): all items of `#[lagrange(…)]` and what expressions may contain.
//! * [`Simulation`]: tolerance, method, effects, when to end. [`Runner`] and [`Ensemble`] make many runs of one system.
//! * [`trajectory`]: states, forces, events and the energy ledger of a run. [`handle`]: the names of coordinates and items.
//! * [`error::Error`]: what can go wrong, with the numbers that say where.
//! * [`checks`]: formulas derived by hand, held against the derived equations.
//! * [`arithmetic::Dual`]: derivatives of whole runs by parameters and start.
//! * [`system`]: the names and units of everything that was declared, of one system or of any.

// The derive macro names this crate by its path, also inside it.
extern crate self as lagrange_core;

pub mod arithmetic;
// The chapters are not part of what is compiled, so that to edit them rebuilds nothing.
#[cfg(any(doc, doctest))]
pub mod book;
pub mod certificate;
pub mod checks;
mod declaration;
mod derivation;
pub mod dynamics;
pub mod effects;
mod equations;
pub mod error;
mod events;
pub mod handle;
pub mod integrate;
mod linear;
pub mod mode;
mod modes;
mod monitor;
mod pool;
mod precompiled;
pub mod prelude;
mod program;
mod run;
mod settings;
mod shortest;
pub mod simulation;
mod state;
pub mod system;
pub mod trajectory;

pub use derivation::Derivation;
pub use error::Error;
#[cfg(feature = "derive")]
pub use lagrange_macros::Lagrangian;
pub use monitor::Monitor;
/// Matrices and vectors of results are those of this crate.
pub use nalgebra;
pub use precompiled::Runnable;
pub use simulation::{Awaited, Ensemble, Equations, Failure, FixedComponents, Runner, Simulation};

/// What the code that the derive macro emits is made of. It may change with every version: only that code and the program
/// `lagrange`, which comes with this crate, may use it.
#[doc(hidden)]
pub mod __private {
    pub use crate::arithmetic::number::Number;
    pub use crate::arithmetic::registers::Body;

    pub mod declaration {
        pub use crate::declaration::*;
    }

    pub mod equations {
        pub use crate::equations::*;
    }

    pub mod places {
        pub use crate::system::places::*;
    }

    pub mod program {
        pub use crate::program::{Encoded, Selection, ValueRef};
    }
}
