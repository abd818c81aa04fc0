//! Coordinates that rows hold fixed: q = value, v = 0, v̇ = 0.

use crate::derive::Equations;
use crate::symbolic::{ExprId, Pool, Symbol};

/// A row that says coordinate = value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Pin {
    /// Row.
    pub row: usize,
    /// Coordinate.
    pub coordinate: usize,
    /// Value, in parameters alone.
    pub value: ExprId,
}

/// Which of the acting rows are pins, one for each coordinate. The pool is that of the equations, which lend it.
pub fn pins(equations: &Equations, pool: &mut Pool, acting: &[usize]) -> Vec<Pin> {
    let system = &equations.system;
    let parameters: Vec<Symbol> = system.parameters.iter().map(|p| p.symbol).collect();
    let mut pins: Vec<Pin> = Vec::new();
    for &row in acting {
        let numbers = &equations.structure.rows[row];
        let (Some(position), &[(coordinate, entry)]) = (numbers.position, &numbers.jacobian[..])
        else {
            continue;
        };
        let entry = equations.total(pool, entry);
        let Some(sign) = pool.as_number(entry).filter(|n| n.is_unit()) else {
            continue;
        };
        // g = ±(q − value)
        let gap = equations.total(pool, position);
        let scaled = pool.scale(gap, sign);
        let leaf = pool.leaf(system.coordinates[coordinate].position);
        let value = pool.sub(leaf, scaled);
        let fixed = pool.symbols(value).iter().all(|s| parameters.contains(s));
        if fixed && !pins.iter().any(|pin| pin.coordinate == coordinate) {
            pins.push(Pin {
                row,
                coordinate,
                value,
            });
        }
    }
    pins
}

/// What pins say of positions, velocities and accelerations. What makes the equations infinite is not said: they keep the symbol, whose value
/// then tells it in a run that comes to this mode.
pub fn pinned(equations: &Equations, pool: &mut Pool, pins: &[Pin]) -> Vec<(Symbol, ExprId)> {
    let zero = pool.integer(0);
    let said = pins.iter().flat_map(|pin| {
        let item = &equations.system.coordinates[pin.coordinate];
        [
            (item.position, pin.value),
            (item.velocity, zero),
            (item.acceleration, zero),
        ]
    });
    let mut known: Vec<(Symbol, ExprId)> = said.collect();
    for below in pool.what_has_poles(&equations.terms_of_motion()) {
        let symbols: Vec<Symbol> = known.iter().map(|&(symbol, _)| symbol).collect();
        if pool.depends_on_any(below, &symbols) {
            let value = pool.substitute(below, &known);
            if pool.vanishes(value) {
                known.retain(|&(symbol, _)| !pool.depends_on(below, symbol));
            }
        }
    }
    known
}
