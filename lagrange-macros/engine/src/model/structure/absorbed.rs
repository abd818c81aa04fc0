//! Coordinates that occur in constraints or gaps only: they were put into the energies before anything was derived.
//!
//! With `constraint(shell: r == radius)` the force of the shell is found only if the energies contain r. With T and V
//! already written for r = radius, the multiplier is that of a coordinate without any: zero.

use crate::model::elaboration::Elaboration;
use crate::model::{Coordinate, Hint, Level};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Symbol};

impl Elaboration<'_> {
    /// Remarks on coordinates that only constraints and gaps contain.
    pub(super) fn absorbed(&mut self) {
        let system = &self.system;
        let pool = &system.pool;
        let energies = system
            .kinetic
            .iter()
            .chain(&system.potential)
            .map(|term| term.energy);
        let loads = system
            .forces
            .iter()
            .flat_map(|force| &force.generalized)
            .map(|(_, e)| *e);
        let dissipations = system.dissipations.iter().map(|item| item.rayleigh);
        let slips = system
            .frictions
            .iter()
            .flat_map(|friction| &friction.slip)
            .map(|(e, _)| *e);
        let velocity = system
            .constraints
            .iter()
            .filter(|c| c.level == Level::Velocity);
        let acting: Vec<ExprId> = energies
            .chain(loads)
            .chain(dissipations)
            .chain(slips)
            .chain(velocity.map(|constraint| constraint.residual))
            .collect();
        let mut used: SortedSet<Symbol> = acting.iter().flat_map(|&e| pool.symbols(e)).collect();
        let driven = system.forces.iter().flat_map(|force| &force.generalized);
        used.extend(driven.map(|(coordinate, _)| system.coordinates[*coordinate].position));
        let coordinates: SortedMap<Symbol, &Coordinate> = system
            .coordinates
            .iter()
            .map(|coordinate| (coordinate.position, coordinate))
            .collect();
        let mut hints = Vec::new();
        let positions = system
            .constraints
            .iter()
            .filter(|c| c.level == Level::Position);
        let rows = positions
            .map(|constraint| (&constraint.name, constraint.residual))
            .chain(
                system
                    .contacts
                    .iter()
                    .map(|contact| (&contact.name, contact.gap)),
            );
        for (name, row) in rows {
            let symbols = pool.symbols(row).into_iter();
            let absorbed =
                symbols
                    .filter_map(|symbol| coordinates.get(&symbol))
                    .find(|coordinate| {
                        !used.contains(&coordinate.position) && !used.contains(&coordinate.velocity)
                    });
            if let Some(coordinate) = absorbed {
                let text = format!(
                    "`{0}` occurs in `{1}` but in no energy or force: if the energies are already written for `{1}`, its force comes out as zero; write them with `{0}`, as if it were free",
                    coordinate.name.text, name.text
                );
                let extent = name.span.into();
                hints.push(Hint { text, extent });
            }
        }
        self.system.hints.extend(hints);
    }
}
