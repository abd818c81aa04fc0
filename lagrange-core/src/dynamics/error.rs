//! Why the equations of motion could not be evaluated.

use crate::program::Operation;
use crate::system::Description;
use core::fmt;

/// Why the equations of motion could not be evaluated. Numbers are indices into the description.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EvaluationError {
    /// Nothing determines the acceleration of this coordinate: no inertia and no constraint.
    NoInertia {
        /// Coordinate.
        coordinate: usize,
    },
    /// The equations do not determine the force of this row (sliding friction at the edge of Painlevé's paradox).
    Undetermined {
        /// Row.
        row: usize,
    },
    /// This row follows from the others, but asks for another acceleration than they do.
    Inconsistent {
        /// Row.
        row: usize,
        /// By how much, relative to the largest acceleration bias.
        residual: f64,
    },
    /// The motion has no Taylor series here.
    NoSeries {
        /// The operation that has none.
        operation: Operation,
        /// The item or coordinate whose equation has it.
        item: Option<&'static str>,
    },
    /// The acceleration of this coordinate is not a finite number.
    NotFiniteAcceleration {
        /// Coordinate.
        coordinate: usize,
    },
    /// The force of this row is not a finite number.
    NotFiniteForce {
        /// Row.
        row: usize,
    },
    /// No state nearby satisfies this row.
    Projection {
        /// Row.
        row: usize,
        /// Its residual at the best state found, in the unit of the declaration.
        residual: f64,
    },
}

/// Level of a residual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// g(q,t), a function of positions.
    Position,
    /// ġ, linear in the velocities.
    Velocity,
}

/// Name of the item that a row belongs to.
pub fn row_name(description: &Description, row: usize) -> &'static str {
    let constraints = description
        .constraints
        .iter()
        .map(|c| (c.row..c.row + 1, c.name));
    let contacts = description
        .contacts
        .iter()
        .map(|c| (c.row..c.row + 1, c.name));
    let frictions = description.frictions.iter().map(|f| (f.rows(), f.name));
    let mut items = constraints.chain(contacts).chain(frictions);
    items
        .find(|(rows, _)| rows.contains(&row))
        .map_or("", |(_, name)| name)
}

impl EvaluationError {
    /// The coordinate or item concerned, if it is one.
    pub fn item(&self, description: &Description) -> Option<&'static str> {
        match *self {
            Self::NoInertia { coordinate } | Self::NotFiniteAcceleration { coordinate } => {
                Some(description.coordinates[coordinate].name)
            }
            Self::Undetermined { row }
            | Self::Inconsistent { row, .. }
            | Self::NotFiniteForce { row }
            | Self::Projection { row, .. } => Some(row_name(description, row)),
            Self::NoSeries { item, .. } => item,
        }
    }

    /// Whether a square root has no Taylor series.
    pub fn is_of_root(&self) -> bool {
        matches!(
            self,
            Self::NoSeries {
                operation: Operation::SquareRoot,
                ..
            }
        )
    }
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoInertia { .. } => f.write_str(
                "nothing determines the acceleration of a coordinate; give it a kinetic energy or a constraint"
            ),
            Self::Undetermined { .. } => f.write_str(
                "the equations do not determine a force: it depends on others there, or its kinetic friction is so large that it locks itself"
            ),
            Self::Inconsistent { residual, .. } => write!(
                f,
                "an item depends on others but contradicts them by {residual:e}; leave one of them out"
            ),
            Self::NoSeries { operation, .. } => write!(
                f,
                "the motion or a guard has no Taylor series here ({}), and every method decides modes by series; {}",
                match operation {
                    Operation::Division => "division by zero",
                    Operation::SquareRoot => "square root of a number that is not positive",
                    Operation::Power => "power of a number that is not positive",
                    Operation::Logarithm => "logarithm of a number that is not positive",
                    Operation::InverseSine => "inverse sine at the end of its range",
                    Operation::Angle => "angle of the origin",
                },
                match operation {
                    Operation::SquareRoot | Operation::Power =>
                        "round a power that begins at zero, `d^(5/2)` as `d^2 * sqrt(d + e)` with a small e, and write what breaks off there as branches, with `if`",
                    _ => "write what breaks off there as branches, with `if`",
                }
            ),
            Self::NotFiniteAcceleration { coordinate } => write!(
                f,
                "the acceleration of coordinate {coordinate} is not finite; look for a division by zero in the declaration"
            ),
            Self::NotFiniteForce { row } => {
                write!(
                    f,
                    "the force of row {row} is not finite; look for a division by zero in the declaration"
                )
            }
            Self::Projection { row, residual } => write!(
                f,
                "no state nearby satisfies row {row}: {residual:e} is left; start closer to the constraint"
            ),
        }
    }
}

impl core::error::Error for EvaluationError {}
