//! The system of a mode before anything is eliminated: which rows act, their columns, the loads.

use super::program::ProgramWriter;
use super::sliding::{Slide, SlidingFrictions};
use crate::arithmetic::Scalar;
use crate::effects::{Effects, Item};
use crate::mode::{FrictionMode, Mode};
use crate::system::{Description, Normal, ValueRef};

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
    pub(crate) fn set<T: Scalar>(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        program: &mut ProgramWriter<'_, T>,
        sliding: &mut SlidingFrictions,
    ) {
        self.acting.clear();
        self.acting.extend(acting(description, effects, mode));
        self.columns.clear();
        self.loads.clear();
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
        sliding.set(description, effects, mode, &self.acting, program);
        for &Slide {
            row,
            factor,
            source,
        } in &sliding.slides
        {
            for &(j, place) in description.rows[row].jacobian {
                let force = program.mul(factor, place);
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
            for slide in sliding.slides.iter().filter(|s| s.row == coupling.row) {
                let force = program.mul(coupling.factor, slide.factor);
                self.push_force(coupling.coordinate, force, slide.source);
            }
        }
        let mut watched = description.watched_rows.iter();
        self.shares_matter =
            self.is_coupled() || watched.any(|row| self.acting.binary_search(row).is_ok());
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
