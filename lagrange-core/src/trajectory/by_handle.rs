//! Results asked by the handles of items, `now.force(MassOnWheel::RIM)`.

use super::{Event, Instant};
use crate::arithmetic::Scalar;
use crate::handle::{ContactId, CoordinateId, ForceId, FrictionId, ObserveId, Reaction};
use crate::system::Description;
use nalgebra::DVectorView;

impl<T: Scalar> Instant<T> {
    /// Position of a coordinate.
    pub fn q(&self, coordinate: CoordinateId) -> T {
        self.state.q(coordinate)
    }

    /// Velocity of a coordinate.
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
    pub fn a(&self, coordinate: CoordinateId) -> T {
        self.acceleration[coordinate.0]
    }

    /// Multiplier of a constraint, of a contact (its normal force where the gap is a distance), or the force of a friction along
    /// its slip (of one in space the first component, see [`Self::friction`]); 0 where it does not act.
    pub fn force(&self, item: impl Into<Reaction>) -> T {
        self.forces[item.into().row(self.owner.0)]
    }

    /// Force of a friction along its slips, one component in the plane, two in space.
    pub fn friction(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces, friction)
    }

    /// Value of an applied force.
    pub fn load(&self, force: ForceId) -> T {
        self.loads[force.0]
    }

    /// Gap of a contact.
    pub fn gap(&self, contact: ContactId) -> T {
        self.gaps[contact.0]
    }

    /// Slip of a friction; of one in space the first component.
    pub fn slip(&self, friction: FrictionId) -> T {
        let before = &self.owner.0.frictions[..friction.0];
        self.slips[before.iter().map(|f| f.components).sum::<usize>()]
    }

    /// How much more a sticking friction could hold: μs N − |F|.
    pub fn margin(&self, friction: FrictionId) -> T {
        let limit = self.limits[friction.0];
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
    pub fn observe(&self, output: ObserveId) -> T {
        self.observes[output.0]
    }

    /// T + V as declared, J.
    pub fn energy(&self) -> T {
        self.energies().total()
    }
}

impl<T: Scalar> Event<T> {
    /// Position of a coordinate; none of them jumps.
    pub fn q(&self, coordinate: CoordinateId) -> T {
        self.state.q(coordinate)
    }

    /// Velocity of a coordinate just before.
    pub fn v(&self, coordinate: CoordinateId) -> T {
        self.state.v(coordinate)
    }

    /// Velocity of a coordinate just after.
    pub fn v_after(&self, coordinate: CoordinateId) -> T {
        self.state_after.v(coordinate)
    }

    /// Force just before; see [`Instant::force`].
    pub fn force(&self, item: impl Into<Reaction>) -> T {
        self.forces[item.into().row(self.owner.0)]
    }

    /// Force just after.
    pub fn force_after(&self, item: impl Into<Reaction>) -> T {
        self.forces_after[item.into().row(self.owner.0)]
    }

    /// Force of a friction along its slips just before; see [`Instant::friction`].
    pub fn friction(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces, friction)
    }

    /// Force of a friction along its slips just after.
    pub fn friction_after(&self, friction: FrictionId) -> &[T] {
        components(self.owner.0, &self.forces_after, friction)
    }

    /// Impulse, N s; 0 where the event is not an impact.
    pub fn impulse(&self, item: impl Into<Reaction>) -> T {
        let row = item.into().row(self.owner.0);
        self.impulses.get(row).copied().unwrap_or_default()
    }
}

/// The rows of a friction among the numbers of all rows.
fn components<'a, T>(d: &Description, rows: &'a [T], friction: FrictionId) -> &'a [T] {
    let friction = &d.frictions[friction.0];
    &rows[friction.row..friction.row + friction.components]
}
