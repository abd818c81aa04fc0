//! What a scene and its user need: `use lagrange_core::prelude::*`.

#[cfg(feature = "derive")]
pub use crate::Lagrangian;
pub use crate::arithmetic::Scalar;
pub use crate::derivation::Derivation;
pub use crate::effects::{Effects, Item};
pub use crate::error::Error;
pub use crate::handle::*;
pub use crate::integrate::Method;
pub use crate::mode::{FrictionMode, Mode};
pub use crate::simulation::{
    Awaited, Ensemble, Equations, Failure, FixedComponents, Runner, Simulation,
};
pub use crate::system::{Derived, Description, Impacts, System};
pub use crate::trajectory::{
    Energies, Entry, Estimate, Event, EventKind, Instant, Ledger, Phase, Sampler, Starts, State,
    Subject, Trajectory, Work,
};
