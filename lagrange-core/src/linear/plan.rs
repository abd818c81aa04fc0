//! What to compute and where to put it: the linear system of one mode as a list, made when the mode is set.
//!
//! Structural zeros never appear, what depends on parameters only is summed once.

use super::program::Program;
use crate::arithmetic::Scalar;
use crate::effects::{Effects, Item};
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Description, Normal, Place};

/// A matrix element that changes with the state: K[row, column] += nodes[node].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub row: usize,
    pub column: usize,
    pub node: usize,
}

/// A sliding friction's row: λ[row] = factor · λ[source], or factor where there is no source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slide {
    pub row: usize,
    pub factor: Place,
    pub source: Option<usize>,
}

/// The linear system of a mode.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan<T> {
    /// Number of coordinates.
    pub coordinates: usize,
    /// Description rows that act, ascending: equation and unknown `coordinates + i` belong to `acting[i]`.
    pub acting: Vec<usize>,
    /// Frictions that slide.
    pub slides: Vec<Slide>,
    /// Work after the motion tape.
    pub program: Program,
    /// Elements that change.
    pub entries: Vec<Entry>,
    /// The rest of the matrix, row-major.
    pub constant: Vec<T>,
    /// (equation, factor ±1, place): right-hand sides.
    pub loads: Vec<(usize, T, Place)>,
}

/// Which rows of a description act in a mode as equations.
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
        .position(|f| (f.row..f.row + f.components).contains(&row));
    owner.is_some_and(|i| {
        mode.frictions[i] == FrictionMode::Stick
            && effects.includes(description, Item::Friction(i))
            && match description.frictions[i].normal {
                Normal::Contact(contact) => contact_acts(contact),
                Normal::Constraint(constraint) => constraint_acts(constraint),
                Normal::Given(_) => true,
            }
    })
}

impl<T: Scalar> Plan<T> {
    /// Number of equations.
    pub(crate) fn size(&self) -> usize {
        self.coordinates + self.acting.len()
    }

    /// Makes the plan of a mode. `constants` begins with the system's own and is extended.
    pub(crate) fn set(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Vec<T>,
    ) {
        let n = description.coordinates.len();
        self.coordinates = n;
        self.acting.clear();
        self.acting.extend(
            (0..description.rows.len()).filter(|&row| acts(description, effects, mode, row)),
        );
        let size = self.size();
        self.entries.clear();
        self.loads.clear();
        self.slides.clear();
        self.constant.clear();
        self.constant.resize(size * size, T::zero());
        self.program.restart(description.motion.outputs);

        for &(i, j, place) in description.mass {
            self.element(constants, i, j, place);
            if i != j {
                self.element(constants, j, i, place);
            }
        }
        for (i, &place) in description.forcing.iter().enumerate() {
            self.load(i, T::one(), place);
        }
        for index in 0..self.acting.len() {
            let (row, unknown) = (&description.rows[self.acting[index]], n + index);
            for &(j, place) in row.jacobian {
                self.element(constants, unknown, j, place);
                self.element(constants, j, unknown, place);
            }
            self.load(unknown, -T::one(), row.bias);
        }
        self.slide(description, effects, mode, constants);
        self.couple(description, effects, constants);
    }

    /// Sliding frictions: they act through the column of their normal force, or as a load.
    fn slide(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Vec<T>,
    ) {
        for (i, friction) in description.frictions.iter().enumerate() {
            let FrictionMode::Slip(sliding) = mode.frictions[i] else {
                continue;
            };
            if !effects.includes(description, Item::Friction(i)) {
                continue;
            }
            let program = &mut self.program;
            let mut strength = friction.kinetic_coefficient;
            let source = match friction.normal {
                Normal::Contact(contact) => {
                    if let Some(factor) = description.contacts[contact].normal_factor {
                        strength = program.mul(constants, strength, factor);
                    }
                    Some(description.contacts[contact].row)
                }
                Normal::Constraint(constraint) => {
                    strength = program.scale(constants, T::from_f64(sliding.normal_sign), strength);
                    Some(description.constraints[constraint].row)
                }
                Normal::Given(normal) => {
                    strength = program.mul(constants, strength, normal);
                    None
                }
            };
            if source.is_some_and(|row| !self.acting.contains(&row)) {
                continue;
            }
            let slips = |component: usize| description.rows[friction.row + component].velocity;
            if sliding.direction == Direction::AlongSlip {
                let mut square = Place::Zero;
                for component in 0..friction.components {
                    let s = slips(component);
                    let s2 = program.mul(constants, s, s);
                    square = program.add(constants, square, s2);
                }
                let inverse = program.inverse_root(constants, square);
                strength = program.mul(constants, strength, inverse);
            }
            strength = program.scale(constants, -T::one(), strength);
            for component in 0..friction.components {
                let row = friction.row + component;
                let factor = match sliding.direction {
                    Direction::Fixed(d) => {
                        program.scale(constants, T::from_f64(d[component]), strength)
                    }
                    Direction::AlongSlip => program.mul(constants, strength, slips(component)),
                };
                self.slides.push(Slide {
                    row,
                    factor,
                    source,
                });
            }
        }
        for index in 0..self.slides.len() {
            let Slide {
                row,
                factor,
                source,
            } = self.slides[index];
            for &(j, place) in description.rows[row].jacobian {
                self.push_force(constants, j, factor, place, source);
            }
        }
    }

    /// Forces that a force item makes of a multiplier.
    fn couple(&mut self, description: &Description, effects: &Effects, constants: &mut Vec<T>) {
        for coupling in description.couplings {
            let owner = description
                .forces
                .iter()
                .position(|f| f.need == coupling.need);
            if owner.is_some_and(|i| !effects.includes(description, Item::Force(i))) {
                continue;
            }
            if let Some(index) = self.acting.iter().position(|&row| row == coupling.row) {
                self.element(
                    constants,
                    coupling.coordinate,
                    self.coordinates + index,
                    coupling.factor,
                );
            } else if let Some(&Slide { factor, source, .. }) =
                self.slides.iter().find(|s| s.row == coupling.row)
            {
                self.push_force(
                    constants,
                    coupling.coordinate,
                    coupling.factor,
                    factor,
                    source,
                );
            }
        }
    }

    /// The generalized force x y λ[source] (or x y) on coordinate `j`.
    fn push_force(
        &mut self,
        constants: &mut Vec<T>,
        j: usize,
        x: Place,
        y: Place,
        source: Option<usize>,
    ) {
        let force = self.program.mul(constants, x, y);
        match source {
            Some(source) => {
                if let Some(index) = self.acting.iter().position(|&row| row == source) {
                    self.element(constants, j, self.coordinates + index, force);
                }
            }
            None => self.load(j, T::one(), force),
        }
    }

    fn element(&mut self, constants: &[T], row: usize, column: usize, place: Place) {
        match place {
            Place::Zero => {}
            Place::Constant(c) => {
                self.constant[row * (self.coordinates + self.acting.len()) + column] += constants[c]
            }
            Place::Node(node) => self.entries.push(Entry { row, column, node }),
        }
    }

    fn load(&mut self, row: usize, sign: T, place: Place) {
        if place != Place::Zero {
            self.loads.push((row, sign, place));
        }
    }
}
