//! What to compute and where to put it: the linear system of one mode as lists, made when the mode is set.
//!
//! Structural zeros never appear, what depends on parameters only is summed once, constant rows are eliminated. What is
//! left are K w = b for w = (u̇, −λ of the rows kept) and, for the rows eliminated, λ = (further rows of K) w − (of b).

mod make;

use super::assembly::KktTerms;
use super::eliminate::Elimination;
use super::program::{Program, ProgramWriter};
use super::sliding::SlidingFrictions;
use crate::arithmetic::Scalar;
use crate::effects::Effects;
use crate::mode::Mode;
use crate::system::{Description, ValueRef};

/// A matrix element that changes with the state: K[row, column] += nodes[node].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    pub row: usize,
    pub column: usize,
    pub node: usize,
}

/// A part of a right-hand side that changes with the state: b[row] += factor · nodes[node].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<T> {
    pub row: usize,
    pub factor: T,
    pub node: usize,
}

/// One contribution to an element before like ones are summed.
#[derive(Clone, Copy, Debug)]
struct Term<T> {
    row: usize,
    /// Column of K, or the number of columns for the right-hand side.
    column: usize,
    factor: T,
    place: ValueRef,
}

/// The linear system of a mode.
#[derive(Clone, Debug, Default)]
pub(crate) struct KktPattern<T> {
    /// Rows of the system: unknown `free + i` is −λ of `kept[i]`.
    pub kept: Vec<usize>,
    /// Rows that act and were eliminated; force `i` is row `size + i` of the lists.
    pub eliminated: Vec<usize>,
    /// Frictions that slide.
    pub sliding: SlidingFrictions,
    /// Work after the motion program.
    pub program: Program<T>,
    /// Elements that change, in the square system: accelerations first, forces after `first_force`.
    pub entries: Vec<Entry>,
    /// The first of `entries` whose column is a force.
    pub first_force: usize,
    /// The same for the rows of eliminated forces.
    pub force_entries: Vec<Entry>,
    /// The rest of the matrix, row-major, `size` wide; eliminated forces at the end.
    pub constant: Vec<T>,
    /// Right-hand sides that change.
    pub loads: Vec<Load<T>>,
    /// The rest of the right-hand sides; eliminated forces at the end.
    pub constant_load: Vec<T>,
    /// Terms of kept rows that elimination may cancel, by row: (row, first, end) of `cancelling`.
    pub reduced: Vec<(usize, usize, usize)>,
    cancelling: Vec<(T, ValueRef)>,
    /// Elements of kept rows that elimination takes away: (row, element, inertia of its coordinate).
    taken: Vec<(usize, ValueRef, ValueRef)>,
    /// How accelerations follow from those that are left.
    pub elimination: Elimination<T>,
    collected: KktTerms,
    terms: Vec<Term<T>>,
    dependent: Vec<bool>,
    entangled: Vec<bool>,
    constant_rows: Vec<usize>,
    a: Vec<T>,
    c: Vec<T>,
}

impl<T: Scalar> KktPattern<T> {
    /// Number of accelerations in the system.
    pub(crate) fn free(&self) -> usize {
        self.elimination.free.len()
    }

    /// Whether forces act through the multipliers of others.
    pub(crate) fn is_coupled(&self) -> bool {
        self.collected.is_coupled()
    }

    /// Whether something depends on how rows that depend on one another share a load.
    pub(crate) fn shares_matter(&self) -> bool {
        self.collected.shares_matter
    }

    /// Number of equations.
    pub(crate) fn size(&self) -> usize {
        self.free() + self.kept.len()
    }

    /// Whether constant rows that follow from others were left out.
    pub(crate) fn has_dependent_rows(&self) -> bool {
        self.independent_rows() < self.collected.acting.len()
    }

    /// How many rows are left without them.
    pub(crate) fn independent_rows(&self) -> usize {
        self.kept.len() + self.eliminated.len()
    }

    /// The generalized forces of unit forces: (index among the rows that act, coordinate, factor).
    pub(crate) fn columns(&self) -> impl Iterator<Item = (usize, usize, ValueRef)> + '_ {
        let elements = self.collected.columns.iter();
        elements.map(|element| (element.index, element.coordinate, element.place))
    }

    /// Whether coordinate `j` cannot accelerate in this mode.
    pub(crate) fn is_pinned(&self, j: usize) -> bool {
        self.elimination.right.row(j).is_empty()
    }

    /// The rows of the matrix that give the eliminated forces.
    pub(crate) fn constant_of_forces(&self) -> &[T] {
        &self.constant[self.size() * self.size()..]
    }

    /// Appends all numbers that a program made by this plan reads, beside the constants: factors of the sums, the rows of eliminated forces, the
    /// right-hand sides, the factors of loads, and those of the elimination.
    pub(crate) fn collect(&self, numbers: &mut Vec<T>) {
        numbers.extend(self.program.numbers());
        numbers.extend_from_slice(self.constant_of_forces());
        numbers.extend_from_slice(&self.constant_load);
        numbers.extend(self.loads.iter().map(|load| load.factor));
        numbers.extend(self.elimination.right.values());
    }

    /// Whether a program made by another plan does what this one says, up to numbers.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let mut loads = self.loads.iter().zip(&other.loads);
        let same_zeros = |x: &[T], y: &[T]| x.iter().map(T::is_zero).eq(y.iter().map(T::is_zero));
        self.collected.acting == other.collected.acting
            && self.kept == other.kept
            && self.eliminated == other.eliminated
            && self.sliding == other.sliding
            && self.entries == other.entries
            && self.first_force == other.first_force
            && self.force_entries == other.force_entries
            && same_zeros(self.constant_of_forces(), other.constant_of_forces())
            && same_zeros(&self.constant_load, &other.constant_load)
            && self.reduced == other.reduced
            && self.cancelling().eq(other.cancelling())
            && self.taking().eq(other.taking())
            && self.loads.len() == other.loads.len()
            && loads.all(|(x, y)| (x.row, x.node) == (y.row, y.node))
            && self.program.is_like(&other.program)
            && self.elimination.is_like(&other.elimination)
    }

    /// Makes the plan of a mode. `constants` begins with the system's own and is extended.
    pub(crate) fn set(
        &mut self,
        description: &Description,
        effects: &Effects,
        mode: &Mode,
        constants: &mut Vec<T>,
    ) {
        self.program.restart(description.motion.outputs);
        let mut program = ProgramWriter {
            program: &mut self.program,
            constants,
        };
        self.collected
            .set(description, effects, mode, &mut program, &mut self.sliding);
        self.eliminate(description, constants);
        self.collect_terms(description);
        self.merge_terms(constants);
    }

    /// The numbers that [`Self::cancelled`] reads.
    pub(crate) fn cancelling(&self) -> impl Iterator<Item = ValueRef> + '_ {
        self.cancelling.iter().map(|&(_, place)| place)
    }

    /// The numbers that [`Self::taken`] reads.
    pub(crate) fn taking(&self) -> impl Iterator<Item = ValueRef> + '_ {
        let taken = self.taken.iter();
        taken.flat_map(|&(_, element, inertia)| [element, inertia])
    }

    /// What elimination takes from kept rows: (row, the element over the root of the inertia of its coordinate).
    pub(crate) fn taken<'a>(
        &'a self,
        read: impl Fn(ValueRef) -> T + 'a,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let sizes = self.taken.iter().map(move |&(row, element, inertia)| {
            let inertia = read(inertia).value();
            (row, (read(element).value() / inertia.sqrt()).abs())
        });
        sizes.filter(|(_, size)| size.is_finite())
    }

    /// The size of the terms of each kept row that elimination may cancel: (row, largest term).
    pub(crate) fn cancelled<'a>(
        &'a self,
        read: impl Fn(ValueRef) -> T + 'a,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.reduced.iter().map(move |&(row, first, end)| {
            let sizes = self.cancelling[first..end]
                .iter()
                .map(|&(factor, place)| (factor * read(place)).value().abs());
            (row, sizes.fold(0.0, f64::max))
        })
    }
}
