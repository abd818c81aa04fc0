//! Results asked by the handles of items, `now.force(MassOnWheel::RIM)`. A handle of another system that names nothing here is a panic.

use super::{Event, Instant};
use crate::arithmetic::Scalar;
use crate::handle::{ContactId, CoordinateId, ForceId, FrictionId, ObserveId, Reaction, named};
use crate::system::Description;
use nalgebra::DVectorView;

impl<T: Scalar> Instant<T> {
    /// Position of a coordinate.
    #[track_caller]
    pub fn q(&self, coordinate: CoordinateId) -> T {
        self.state.q(coordinate)
    }

    /// Velocity of a coordinate.
    #[track_caller]
    pub fn v(&self, coordinate: CoordinateId) -> T {
        self.state.v(coordinate)
    }

    /// The positions as a vector of nalgebra.
    pub fn positions(&self) -> DVectorView<'_, T> {
        self.state.positions()
    }

    /// The velocities as a vector of nalgebra.
    pub fn velocities(&self) -> DVectorView<'_, T> {
        self.state.velocities()
    }

    /// The accelerations as a vector of nalgebra.
    pub fn accelerations(&self) -> DVectorView<'_, T> {
        DVectorView::from_slice(&self.acceleration, self.acceleration.len())
    }

    /// Acceleration of a coordinate.
    #[track_caller]
    pub fn a(&self, coordinate: CoordinateId) -> T {
        *named(&self.acceleration, coordinate.0, "coordinate")
    }

    /// Multiplier of a constraint, of a contact (its normal force where the gap is a distance), or the force of a friction along
    /// its slip (of one in space the first component, see [`Self::friction`]); 0 where it does not act.
    #[track_caller]
    pub fn force(&self, item: impl Into<Reaction>) -> T {
        self.forces[item.into().row(self.owner.0)]
    }

    /// Force of a friction along its slips, one component in the plane, two in space.
    #[track_caller]
    pub fn friction(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces, friction)
    }

    /// Value of an applied force.
    #[track_caller]
    pub fn load(&self, force: ForceId) -> T {
        *named(&self.loads, force.0, "force")
    }

    /// Gap of a contact.
    #[track_caller]
    pub fn gap(&self, contact: ContactId) -> T {
        *named(&self.gaps, contact.0, "contact")
    }

    /// Slip of a friction; of one in space the first component.
    #[track_caller]
    pub fn slip(&self, friction: FrictionId) -> T {
        let frictions = self.owner.0.frictions;
        named(frictions, friction.0, "friction");
        let before = frictions[..friction.0].iter().map(|f| f.components);
        self.slips[before.sum::<usize>()]
    }

    /// How much more a sticking friction could hold: μs N − |F|.
    #[track_caller]
    pub fn margin(&self, friction: FrictionId) -> T {
        let limit = *named(&self.limits, friction.0, "friction");
        match *self.friction(friction) {
            [force] if force.value() < 0.0 => limit + force,
            [force] => limit - force,
            ref forces => {
                let square = forces.iter().fold(T::zero(), |sum, &f| sum + f * f);
                limit - square.sqrt()
            }
        }
    }

    /// A declared output.
    #[track_caller]
    pub fn observe(&self, output: ObserveId) -> T {
        *named(&self.observes, output.0, "output")
    }

    /// T + V as declared, J.
    pub fn energy(&self) -> T {
        self.energies().total()
    }
}

impl<T: Scalar> Event<T> {
    /// Position of a coordinate; none of them jumps.
    #[track_caller]
    pub fn q(&self, coordinate: CoordinateId) -> T {
        self.state.q(coordinate)
    }

    /// Velocity of a coordinate just before.
    #[track_caller]
    pub fn v(&self, coordinate: CoordinateId) -> T {
        self.state.v(coordinate)
    }

    /// Velocity of a coordinate just after.
    #[track_caller]
    pub fn v_after(&self, coordinate: CoordinateId) -> T {
        self.state_after.v(coordinate)
    }

    /// Force just before; see [`Instant::force`].
    #[track_caller]
    pub fn force(&self, item: impl Into<Reaction>) -> T {
        self.forces[item.into().row(self.owner.0)]
    }

    /// Force just after.
    #[track_caller]
    pub fn force_after(&self, item: impl Into<Reaction>) -> T {
        self.forces_after[item.into().row(self.owner.0)]
    }

    /// Force of a friction along its slips just before; see [`Instant::friction`].
    #[track_caller]
    pub fn friction(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces, friction)
    }

    /// Force of a friction along its slips just after.
    #[track_caller]
    pub fn friction_after(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces_after, friction)
    }

    /// Impulse, N s; 0 where the event is not an impact.
    #[track_caller]
    pub fn impulse(&self, item: impl Into<Reaction>) -> T {
        let row = item.into().row(self.owner.0);
        self.impulses.get(row).copied().unwrap_or_default()
    }
}

/// The rows of a friction among the numbers of all rows.
#[track_caller]
fn components<'a, T>(d: &Description, rows: &'a [T], friction: FrictionId) -> &'a [T] {
    let friction = named(d.frictions, friction.0, "friction");
    &rows[friction.rows()]
}
