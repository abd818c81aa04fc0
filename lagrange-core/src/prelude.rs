//! What a scene needs: `use lagrange_core::prelude::*;`

#[cfg(feature = "derive")]
pub use crate::Lagrangian;
pub use crate::arithmetic::Scalar;
pub use crate::effects::Effects;
pub use crate::handle::{
    CoordinateId, ConstraintId, ContactId, DissipationId, ForceId, FrictionId, KineticId, MarkId, ObserveId,
    PotentialId, StartId, StopId,
};
pub use crate::simulation::Simulation;
pub use crate::system::System;
