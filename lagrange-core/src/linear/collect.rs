//! The system of a mode before anything is eliminated: which rows act, their columns, the loads.

use super::program::Program;
use crate::arithmetic::Scalar;
use crate::effects::{Effects, Item};
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Description, Normal, ValueRef};

/// Added to the square of a slip before its root is taken: nothing beside any slip there is.
const LEAST_SQUARE: f64 = 1e-300;

/// Where an element of a force's column comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// aᵀ
    Jacobian,
    /// Sliding friction or a force that is proportional to the multiplier.
    Coupled,
}

/// Q[coordinate] += place · λ of acting row `index`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColumnElement {
    pub index: usize,
    pub coordinate: usize,
    pub place: ValueRef,
    pub source: Source,
}

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

/// The pieces of the system of one mode.
#[derive(Clone, Debug, Default)]
pub(crate) struct KktTerms {
    /// Description rows that act, ascending.
    pub acting: Vec<usize>,
    /// Generalized forces of the multipliers.
    pub columns: Vec<ColumnElement>,
    /// (coordinate, place): f and what friction of a given normal force adds.
    pub loads: Vec<(usize, ValueRef)>,
    /// Whether something depends on how rows that depend on one another share a load: what acts through their multipliers, or a stop, mark or
    /// branch that reads them.
    pub shares_matter: bool,
}

/// Whether a row of a description acts in a mode as an equation.
pub(crate) fn acts(description: &Description, effects: &Effects, mode: &Mode, row: usize) -> bool {
    let constraint_acts = |i: usize| {
        effects.includes(description, Item::Constraint(i))
            && description.constraints[i]
                .while_contact
                .is_none_or(|contact| mode.contacts[contact])
    };
    let contact_acts =
        |i: usize| effects.includes(description, Item::Contact(i)) && mode.contacts[i];
    let (constraints, contacts) = (description.constraints, description.contacts);
    if let Some(i) = constraints.iter().position(|c| c.row == row) {
        return constraint_acts(i);
    }
    if let Some(i) = contacts.iter().position(|c| c.row == row) {
        return contact_acts(i);
    }
    let owner = description
        .frictions
        .iter()
        .position(|f| f.rows().contains(&row));
    owner.is_some_and(|i| {
        mode.frictions[i] == FrictionMode::Stick
            && effects.includes(description, Item::Friction(i))
            && match description.frictions[i].normal {
                Normal::Contact(contact) => contact_acts(contact),
                normal => normal.constraints(description).all(constraint_acts),
            }
    })
}

/// The rows that act in a mode as equations, ascending.
pub(crate) fn acting<'a>(
    description: &'a Description,
    effects: &'a Effects,
    mode: &'a Mode,
) -> impl Iterator<Item = usize> + 'a {
    (0..description.rows.len()).filter(|&row| acts(description, effects, mode, row))
}

impl KktTerms {
    /// Collects the pieces of a mode; products are made by `program`.
    #[expect(
        clippy::too_many_arguments,
        reason = "what the program of a mode is made of"
    )]
    pub(crate) fn set<T: Scalar>(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Vec<T>,
        program: &mut Program<T>,
        slides: &mut Vec<Slide>,
        slip_directions: &mut Vec<SlipDirection>,
        resultants: &mut Vec<ResultantNodes>,
    ) {
        self.acting.clear();
        self.acting.extend(acting(description, effects, mode));
        self.columns.clear();
        self.loads.clear();
        slides.clear();
        slip_directions.clear();
        resultants.clear();
        self.loads
            .extend(description.forcing.iter().copied().enumerate());
        for (index, &row) in self.acting.iter().enumerate() {
            let elements = description.rows[row].jacobian.iter();
            self.columns
                .extend(elements.map(|&(coordinate, place)| ColumnElement {
                    index,
                    coordinate,
                    place,
                    source: Source::Jacobian,
                }));
        }
        self.slide(
            description,
            effects,
            mode,
            constants,
            program,
            slides,
            slip_directions,
            resultants,
        );
        for &Slide {
            row,
            factor,
            source,
        } in slides.iter()
        {
            for &(j, place) in description.rows[row].jacobian {
                let force = program.mul(constants, factor, place);
                self.push_force(j, force, source);
            }
        }
        for coupling in description.couplings {
            let owner = description
                .forces
                .iter()
                .position(|f| f.need == coupling.need);
            if owner.is_some_and(|i| !effects.includes(description, Item::Force(i))) {
                continue;
            }
            if self.acting.binary_search(&coupling.row).is_ok() {
                self.push_force(coupling.coordinate, coupling.factor, Some(coupling.row));
                continue;
            }
            for slide in slides.iter().filter(|s| s.row == coupling.row) {
                let force = program.mul(constants, coupling.factor, slide.factor);
                self.push_force(coupling.coordinate, force, slide.source);
            }
        }
        let mut watched = description.watched_rows.iter();
        self.shares_matter =
            self.is_coupled() || watched.any(|row| self.acting.binary_search(row).is_ok());
    }

    /// Sliding frictions: they act through the column of their normal force, or as a load.
    #[expect(
        clippy::too_many_arguments,
        reason = "what the program of a mode is made of"
    )]
    fn slide<T: Scalar>(
        &self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Vec<T>,
        program: &mut Program<T>,
        slides: &mut Vec<Slide>,
        slip_directions: &mut Vec<SlipDirection>,
        resultants: &mut Vec<ResultantNodes>,
    ) {
        for (i, friction) in description.frictions.iter().enumerate() {
            let FrictionMode::Slip(sliding) = mode.frictions[i] else {
                continue;
            };
            if !effects.includes(description, Item::Friction(i)) {
                continue;
            }
            let mut strength = friction.kinetic_coefficient;
            // What presses is the sum of these: 1 or a number, times the force of a row or 1.
            let mut pressing = [(None, None); 4];
            let mut parts = 1;
            match friction.normal {
                Normal::Contact(contact) => {
                    if let Some(factor) = description.contacts[contact].normal_factor {
                        strength = program.mul(constants, strength, factor);
                    }
                    pressing[0].1 = Some(description.contacts[contact].row);
                }
                Normal::Constraint(constraint) => {
                    strength = program.scale(constants, T::from_f64(sliding.normal_sign), strength);
                    pressing[0].1 = Some(description.constraints[constraint].row);
                }
                Normal::Resultant(resultant) => {
                    let known = resultants.iter().find(|known| known.resultant == resultant);
                    let nodes = known.copied().unwrap_or_else(|| {
                        let nodes = ResultantNodes {
                            resultant,
                            along: [program.given(), program.given(), program.given()],
                            rest: program.given(),
                        };
                        resultants.push(nodes);
                        nodes
                    });
                    pressing[0].0 = Some(ValueRef::Node(nodes.rest));
                    let constraints = description.resultants[resultant].iter();
                    for (&constraint, along) in constraints.zip(nodes.along) {
                        let row = description.constraints[constraint].row;
                        pressing[parts] = (Some(ValueRef::Node(along)), Some(row));
                        parts += 1;
                    }
                }
                Normal::Given(normal) => strength = program.mul(constants, strength, normal),
            }
            let pressing = &pressing[..parts];
            let acts = |row: usize| self.acting.binary_search(&row).is_ok();
            if !pressing.iter().filter_map(|part| part.1).all(acts) {
                continue;
            }
            let slip = |component: usize| description.rows[friction.row + component].velocity;
            if sliding.direction == Direction::AlongSlip {
                let mut square = ValueRef::Zero;
                for component in 0..friction.components {
                    let s2 = program.mul(constants, slip(component), slip(component));
                    square = program.add(constants, square, s2);
                }
                // Of a slip of exactly zero the direction is zero, not 0/0.
                let least = Program::constant(constants, T::from_f64(LEAST_SQUARE));
                square = program.add(constants, square, least);
                let inverse = program.inverse_root(constants, square);
                strength = program.mul(constants, strength, inverse);
            }
            strength = program.scale(constants, -T::one(), strength);
            let mut slip_direction = SlipDirection {
                friction: i,
                ..SlipDirection::default()
            };
            for component in 0..friction.components {
                let row = friction.row + component;
                let factor = match sliding.direction {
                    Direction::Fixed(d) => {
                        program.scale(constants, T::from_f64(d[component]), strength)
                    }
                    Direction::AlongSlip => program.mul(constants, strength, slip(component)),
                    Direction::Incipient(_) => {
                        let node = program.given();
                        slip_direction.nodes[component] = node;
                        program.mul(constants, strength, ValueRef::Node(node))
                    }
                };
                for &(share, source) in pressing {
                    let share = share.map(|share| program.mul(constants, factor, share));
                    slides.push(Slide {
                        row,
                        factor: share.unwrap_or(factor),
                        source,
                    });
                }
            }
            if let Direction::Incipient(_) = sliding.direction {
                slip_directions.push(slip_direction);
            }
        }
    }

    /// The generalized force `force` · λ[source] (or just `force`) on a coordinate.
    fn push_force(&mut self, coordinate: usize, force: ValueRef, source: Option<usize>) {
        if force == ValueRef::Zero {
            return;
        }
        match source {
            Some(row) => {
                if let Ok(index) = self.acting.binary_search(&row) {
                    self.columns.push(ColumnElement {
                        index,
                        coordinate,
                        place: force,
                        source: Source::Coupled,
                    });
                }
            }
            None => self.loads.push((coordinate, force)),
        }
    }

    /// Whether a force acts through the multiplier of another row: what slides, or is proportional to a multiplier.
    pub(crate) fn is_coupled(&self) -> bool {
        let mut columns = self.columns.iter();
        columns.any(|element| element.source == Source::Coupled)
    }

    /// Whether a row depends on parameters only, and has no bias.
    pub(crate) fn has_constant_row<T: Scalar>(
        &self,
        description: &Description,
        index: usize,
        constants: &[T],
    ) -> bool {
        let row = &description.rows[self.acting[index]];
        let unbiased = match row.bias {
            ValueRef::Zero => true,
            ValueRef::Constant(i) => constants[i].is_zero(),
            ValueRef::Node(_) => false,
        };
        let mut elements = row.jacobian.iter();
        unbiased && elements.all(|&(_, place)| is_constant(place, constants))
    }

    /// The same of a row and the column of its force.
    pub(crate) fn is_constant<T: Scalar>(
        &self,
        description: &Description,
        index: usize,
        constants: &[T],
    ) -> bool {
        let mut column = self.columns.iter().filter(|e| e.index == index);
        self.has_constant_row(description, index, constants)
            && column.all(|e| is_constant(e.place, constants))
    }
}

/// Whether a number depends on parameters only, and is one.
fn is_constant<T: Scalar>(place: ValueRef, constants: &[T]) -> bool {
    match place {
        ValueRef::Zero => true,
        ValueRef::Constant(i) => constants[i].value().is_finite(),
        ValueRef::Node(_) => false,
    }
}
