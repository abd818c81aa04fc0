//! A net of point masses and springs in space.

use lagrange_macros::Lagrangian;

/// A net of eight by eight knots hangs by its corners from four hooks and drops under its own weight.
///
/// Knot `8 i + j` is in row i and column j; `x`, `y`, `z` are its displacements from the flat net in which no spring is
/// strained, z upward. Springs join neighbours in a row and in a column, and each corner to the hook above it.
///
/// What to expect: the net sags and swings. Energy is conserved without air (`--without air`); with it the net comes to
/// rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[64], y[64], z[64]),
    kinetic = mass/2 * sum(k in 0..64: der(x[k])^2 + der(y[k])^2 + der(z[k])^2),
    potential(weight: mass * gravity * sum(k in 0..64: z[k])),
    potential(rows: stiffness/2 * sum(i in 0..8: sum(k in 8*i..8*i + 7:
        (norm([length + x[k + 1] - x[k], y[k + 1] - y[k], z[k + 1] - z[k]]) - length)^2))),
    potential(columns: stiffness/2 * sum(k in 0..56:
        (norm([x[k + 8] - x[k], length + y[k + 8] - y[k], z[k + 8] - z[k]]) - length)^2)),
    potential(hooks: stiffness/2 * sum(i in 0..2: sum(j in 0..2:
        (norm([x[56*i + 7*j], y[56*i + 7*j], length - z[56*i + 7*j]]) - length)^2))),
    dissipation(air: drag/2 * sum(k in 0..64: der(x[k])^2 + der(y[k])^2 + der(z[k])^2)),
    start(flat: z[k in 0..64] = 0),
    observe(sag = -(z[27] + z[28] + z[35] + z[36])/4),
    draw(rod[i in 0..8]: list(j in 0..8: (length*j + x[8*i + j], length*i + y[8*i + j], z[8*i + j]))),
    draw(rod[j in 0..8]: list(i in 0..8: (length*j + x[8*i + j], length*i + y[8*i + j], z[8*i + j]))),
    draw(rod[i in 0..2]: (0, 7*length*i, length) to (x[56*i], 7*length*i + y[56*i], z[56*i])),
    draw(rod[i in 0..2]: (7*length, 7*length*i, length)
        to (7*length + x[56*i + 7], 7*length*i + y[56*i + 7], z[56*i + 7])),
    draw(pivot[i in 0..2]: (0, 7*length*i, length)),
    draw(pivot[i in 0..2]: (7*length, 7*length*i, length)),
    // Where it is out of the way of the deepest sag.
    draw(floor: -10*length),
)]
pub struct Net<T = f64> {
    /// Mass of a knot, kg.
    pub mass: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Stiffness of every spring, N/m.
    pub stiffness: T,
    /// Length at rest of every spring, m.
    pub length: T,
    /// Force of the air per velocity of a knot, N s/m.
    pub drag: T,
}

impl Default for Net {
    fn default() -> Self {
        Self {
            mass: 0.02,
            gravity: 9.81,
            stiffness: 40.0,
            length: 0.1,
            drag: 0.01,
        }
    }
}
