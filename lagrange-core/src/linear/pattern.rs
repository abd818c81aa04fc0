//! What to compute and where to put it: the linear system of one mode as lists, made when the mode is set.
//!
//! Structural zeros never appear, what depends on parameters only is summed once, constant rows are eliminated. What is
//! left are K w = b for w = (u̇, −λ of the rows kept) and, for the rows eliminated, λ = (further rows of K) w − (of b).

use super::assembly::{KktTerms, Source};
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

    /// Chooses the rows to eliminate: constant, without bias, with constant columns, independent.
    fn eliminate(&mut self, description: &Description, constants: &[T]) {
        let n = description.coordinates.len();
        let Self {
            collected,
            constant_rows,
            a,
            c,
            dependent,
            entangled,
            elimination,
            kept,
            eliminated,
            ..
        } = self;
        let acting = &collected.acting;
        let mut find = |constant_rows: &mut Vec<usize>, constant: &dyn Fn(usize) -> bool| {
            constant_rows.clear();
            constant_rows.extend((0..acting.len()).filter(|&index| constant(index)));
            fill(a, n, constant_rows, |index, put| {
                for &(j, place) in description.rows[acting[index]].jacobian {
                    put(j, number(place, constants));
                }
            });
            elimination.dependent(a, n, dependent);
            dependent.contains(&true)
        };
        let is_row = |i| collected.has_constant_row(description, i, constants);
        let is_constant = |i| collected.is_constant(description, i, constants);
        if !collected.shares_matter {
            find(constant_rows, &is_constant);
        } else if find(constant_rows, &is_row) {
            // How more contacts than are needed share their load matters: the solver finds that for all rows.
            constant_rows.clear();
        } else {
            find_entangled(description, acting, entangled);
            let changes = (0..acting.len()).any(|i| entangled[i] && !is_row(i));
            find(constant_rows, &|i| {
                is_constant(i) && !(changes && entangled[i])
            });
        }
        let mut position = 0;
        // A dependent row follows from the others and has no force of its own.
        kept.clear();
        eliminated.clear();
        let mut aside = dependent.iter();
        for index in 0..acting.len() {
            if constant_rows.get(position) == Some(&index) {
                position += 1;
                if aside.next() == Some(&false) {
                    eliminated.push(index);
                }
            } else {
                kept.push(index);
            }
        }
        loop {
            fill(a, n, eliminated, |index, put| {
                for &(j, place) in description.rows[acting[index]].jacobian {
                    put(j, number(place, constants));
                }
            });
            fill(c, n, eliminated, |index, put| {
                for element in collected.columns.iter().filter(|e| e.index == index) {
                    put(element.coordinate, number(element.place, constants));
                }
            });
            let symmetric = collected
                .columns
                .iter()
                .all(|e| e.source == Source::Jacobian || kept.contains(&e.index));
            if elimination.set(a, c, n, symmetric, kept.len()) {
                break;
            }
            kept.append(eliminated);
            kept.sort_unstable();
        }
    }

    /// Every contribution, combined by the elimination.
    fn collect_terms(&mut self, description: &Description) {
        let Self {
            collected,
            elimination,
            terms,
            kept,
            eliminated,
            reduced,
            cancelling,
            taken,
            ..
        } = self;
        let acting = &collected.acting;
        let (free, rows) = (elimination.free.len(), kept.len());
        let size = free + rows;
        terms.clear();
        reduced.clear();
        cancelling.clear();
        taken.clear();
        let minus = -T::one();
        let symmetric = elimination.symmetric;
        let mut mass = |i: usize, j: usize, place: ValueRef| {
            for &(row, left) in elimination.left.row(i) {
                for &(column, right) in elimination.right.row(j) {
                    // The upper triangle of a symmetric matrix is copied.
                    if !(symmetric && row < column) {
                        terms.push(Term {
                            row,
                            column,
                            factor: left * right,
                            place,
                        });
                    }
                }
            }
        };
        for &(i, j, place) in description.mass {
            mass(i, j, place);
            if i != j {
                mass(j, i, place);
            }
        }
        for element in &collected.columns {
            if let Some(index) = kept.iter().position(|&k| k == element.index) {
                for &(row, factor) in elimination.left.row(element.coordinate) {
                    terms.push(Term {
                        row,
                        column: free + index,
                        factor,
                        place: element.place,
                    });
                }
            }
        }
        for (index, &row) in kept.iter().enumerate() {
            let row = &description.rows[acting[row]];
            let first = cancelling.len();
            let mut combined = false;
            for &(j, place) in row.jacobian {
                let parts = elimination.right.row(j);
                if !matches!(parts, [(_, one)] if *one == T::one()) {
                    combined = true;
                    let inertia = description.mass.iter().find(|m| (m.0, m.1) == (j, j));
                    taken.extend(inertia.map(|&(_, _, inertia)| (free + index, place, inertia)));
                }
                for &(column, factor) in parts {
                    terms.push(Term {
                        row: free + index,
                        column,
                        factor,
                        place,
                    });
                    cancelling.push((factor, place));
                }
            }
            if combined {
                reduced.push((free + index, first, cancelling.len()));
            } else {
                cancelling.truncate(first);
            }
            terms.push(Term {
                row: free + index,
                column: size,
                factor: minus,
                place: row.bias,
            });
        }
        for &(j, place) in &collected.loads {
            for &(row, factor) in elimination.left.row(j) {
                terms.push(Term {
                    row,
                    column: size,
                    factor,
                    place,
                });
            }
        }
        terms.retain(|term| term.place != ValueRef::Zero);
        for list in [kept, eliminated] {
            list.iter_mut().for_each(|index| *index = acting[*index]);
        }
    }

    /// Sums like contributions: constants now, the others by the program.
    fn merge_terms(&mut self, constants: &[T]) {
        let (free, size) = (self.free(), self.size());
        let height = size + self.eliminated.len();
        self.constant.clear();
        self.constant.resize(height * size, T::zero());
        self.constant_load.clear();
        self.constant_load.resize(height, T::zero());
        self.entries.clear();
        self.force_entries.clear();
        self.loads.clear();
        let key = |term: &Term<T>| match term.place {
            ValueRef::Zero => (term.row, term.column, 0, 0),
            ValueRef::Constant(i) => (term.row, term.column, 1, i),
            ValueRef::Node(i) => (term.row, term.column, 2, i),
        };
        self.terms.sort_unstable_by_key(key);
        let mut rest = &self.terms[..];
        while let Some(&Term { row, column, .. }) = rest.first() {
            let (element, after) =
                rest.split_at(rest.partition_point(|t| (t.row, t.column) <= (row, column)));
            rest = after;
            let mut constant = T::zero();
            self.program.begin_sum();
            for like in element.chunk_by(|x, y| x.place == y.place) {
                let factor = like.iter().fold(T::zero(), |sum, term| sum + term.factor);
                match like[0].place {
                    ValueRef::Zero => {}
                    ValueRef::Constant(i) => constant += factor * constants[i],
                    ValueRef::Node(node) if column == size => {
                        if !factor.is_zero() {
                            self.loads.push(Load { row, factor, node });
                        }
                    }
                    ValueRef::Node(node) => self.program.add_term(factor, node),
                }
            }
            if column == size {
                self.constant_load[row] += constant;
                continue;
            }
            let mirrored = self.elimination.symmetric && row > column && row < free;
            self.constant[row * size + column] += constant;
            if mirrored {
                self.constant[column * size + row] += constant;
            }
            if let Some(node) = self.program.end_sum() {
                let entries = if row < size {
                    &mut self.entries
                } else {
                    &mut self.force_entries
                };
                entries.push(Entry { row, column, node });
                if mirrored {
                    entries.push(Entry {
                        row: column,
                        column: row,
                        node,
                    });
                }
            }
        }
        self.entries
            .sort_unstable_by_key(|e| (e.column >= free, e.row, e.column));
        self.first_force = self.entries.partition_point(|e| e.column < free);
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

/// Finds which of the rows that act may depend on one another somewhere: not one that has a coordinate to itself, nor what is left without it.
fn find_entangled(description: &Description, acting: &[usize], entangled: &mut Vec<bool>) {
    entangled.clear();
    entangled.resize(acting.len(), true);
    let jacobian = |i: usize| description.rows[acting[i]].jacobian.iter();
    let has = |i: usize, coordinate| jacobian(i).any(|&(j, _)| j == coordinate);
    let alone = |i: usize, entangled: &[bool]| {
        let others = |j| (0..acting.len()).any(|k| k != i && entangled[k] && has(k, j));
        jacobian(i).any(|&(j, _)| !others(j))
    };
    while let Some(i) = (0..acting.len()).find(|&i| entangled[i] && alone(i, entangled)) {
        entangled[i] = false;
    }
}

fn number<T: Scalar>(place: ValueRef, constants: &[T]) -> T {
    match place {
        ValueRef::Constant(i) => constants[i],
        ValueRef::Zero | ValueRef::Node(_) => T::zero(),
    }
}

/// Row-major matrix with one row per index, summed from what `each` puts.
fn fill<T: Scalar>(
    matrix: &mut Vec<T>,
    n: usize,
    indices: &[usize],
    each: impl Fn(usize, &mut dyn FnMut(usize, T)),
) {
    matrix.clear();
    matrix.resize(n * indices.len(), T::zero());
    for (row, &index) in matrix.chunks_exact_mut(n.max(1)).zip(indices) {
        each(index, &mut |j, value| row[j] += value);
    }
}
