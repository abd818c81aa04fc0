//! Frictions that slide: they act through the column of their normal force, or as a load.

use super::program::ProgramWriter;
use crate::arithmetic::Scalar;
use crate::effects::{Effects, Item};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::system::{Description, Friction, Normal, Row, ValueRef};

/// Added to the square of a slip before its root is taken: nothing beside any slip there is.
const LEAST_SQUARE: f64 = 1e-300;

/// A part of the force of a sliding friction's row: λ[row] is the sum of factor · λ[source], or factor where there is no source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slide {
    pub row: usize,
    pub factor: ValueRef,
    pub source: Option<usize>,
}

/// A friction whose slip begins: the direction is given from outside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SlipDirection {
    pub friction: usize,
    /// Where the components of the direction are.
    pub nodes: [usize; 2],
}

/// Forces of constraints that press together: N = Σ uᵢ λᵢ + ρ, where the unit vector u and ρ are given from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ResultantNodes {
    pub resultant: usize,
    /// Where the components of u are, as many as there are constraints.
    pub along: [usize; 3],
    /// Where ρ is.
    pub rest: usize,
}

/// The frictions that slide in a mode.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SlidingFrictions {
    /// The parts of their forces.
    pub slides: Vec<Slide>,
    /// Directions of slips that begin.
    pub slip_directions: Vec<SlipDirection>,
    /// What presses frictions, where it is given from outside.
    pub resultants: Vec<ResultantNodes>,
}

/// What presses a friction is the sum of these: 1 or a number, times 1 or the force of a row.
struct Pressing {
    parts: [(Option<ValueRef>, Option<usize>); 4],
    count: usize,
}

impl SlidingFrictions {
    /// Lists those of a mode in which the rows `acting` act; products are made by `program`.
    pub(crate) fn set<T: Scalar>(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        acting: &[usize],
        program: &mut ProgramWriter<'_, T>,
    ) {
        self.slides.clear();
        self.slip_directions.clear();
        self.resultants.clear();
        let acts = |row: usize| acting.binary_search(&row).is_ok();
        for (i, friction) in description.frictions.iter().enumerate() {
            let FrictionMode::Slip(sliding) = mode.frictions[i] else {
                continue;
            };
            if !effects.includes(description, Item::Friction(i)) {
                continue;
            }
            let (strength, pressing) = self.pressing(description, friction, sliding, program);
            let pressing = &pressing.parts[..pressing.count];
            if !pressing.iter().filter_map(|part| part.1).all(acts) {
                continue;
            }
            let rows = &description.rows[friction.rows()];
            let strength = match sliding.direction {
                Direction::AlongSlip => over_length(strength, rows, program),
                _ => strength,
            };
            let strength = program.scale(-T::one(), strength);
            let mut slip_direction = SlipDirection {
                friction: i,
                ..SlipDirection::default()
            };
            for (component, row) in rows.iter().enumerate() {
                let factor = match sliding.direction {
                    Direction::Fixed(d) => program.scale(T::from_f64(d[component]), strength),
                    Direction::AlongSlip => program.mul(strength, row.velocity),
                    Direction::Incipient(_) => {
                        let node = program.given();
                        slip_direction.nodes[component] = node;
                        program.mul(strength, ValueRef::Node(node))
                    }
                };
                for &(share, source) in pressing {
                    let share = share.map(|share| program.mul(factor, share));
                    self.slides.push(Slide {
                        row: friction.row + component,
                        factor: share.unwrap_or(factor),
                        source,
                    });
                }
            }
            if let Direction::Incipient(_) = sliding.direction {
                self.slip_directions.push(slip_direction);
            }
        }
    }

    /// What presses a friction, and the strength of the friction per unit of it.
    fn pressing<T: Scalar>(
        &mut self,
        description: &Description,
        friction: &Friction,
        sliding: Sliding,
        program: &mut ProgramWriter<'_, T>,
    ) -> (ValueRef, Pressing) {
        let mut strength = friction.kinetic_coefficient;
        let mut pressing = Pressing {
            parts: [(None, None); 4],
            count: 1,
        };
        match friction.normal {
            Normal::Contact(contact) => {
                if let Some(factor) = description.contacts[contact].normal_factor {
                    strength = program.mul(strength, factor);
                }
                pressing.parts[0].1 = Some(description.contacts[contact].row);
            }
            Normal::Constraint(constraint) => {
                strength = program.scale(T::from_f64(sliding.normal_sign), strength);
                pressing.parts[0].1 = Some(description.constraints[constraint].row);
            }
            Normal::Resultant(resultant) => {
                let nodes = self.resultant(resultant, program);
                pressing.parts[0].0 = Some(ValueRef::Node(nodes.rest));
                let constraints = description.resultants[resultant].iter();
                for (&constraint, along) in constraints.zip(nodes.along) {
                    let row = description.constraints[constraint].row;
                    pressing.parts[pressing.count] = (Some(ValueRef::Node(along)), Some(row));
                    pressing.count += 1;
                }
            }
            Normal::Given(normal) => strength = program.mul(strength, normal),
        }
        (strength, pressing)
    }

    /// Where a resultant is given: several frictions may be pressed by one.
    fn resultant<T: Scalar>(
        &mut self,
        resultant: usize,
        program: &mut ProgramWriter<'_, T>,
    ) -> ResultantNodes {
        let mut known = self.resultants.iter();
        if let Some(nodes) = known.find(|known| known.resultant == resultant) {
            return *nodes;
        }
        let nodes = ResultantNodes {
            resultant,
            along: [program.given(), program.given(), program.given()],
            rest: program.given(),
        };
        self.resultants.push(nodes);
        nodes
    }
}

/// A strength over the length of the slip that these rows are the components of.
fn over_length<T: Scalar>(
    strength: ValueRef,
    rows: &[Row],
    program: &mut ProgramWriter<'_, T>,
) -> ValueRef {
    let mut square = ValueRef::Zero;
    for row in rows {
        let own = program.mul(row.velocity, row.velocity);
        square = program.add(square, own);
    }
    // Of a slip of exactly zero the direction is zero, not 0/0.
    let least = program.constant(T::from_f64(LEAST_SQUARE));
    let square = program.add(square, least);
    let inverse = program.inverse_root(square);
    program.mul(strength, inverse)
}
