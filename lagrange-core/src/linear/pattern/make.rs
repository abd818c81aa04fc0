//! The terms of a system → the lists of a mode: rows that are eliminated, like terms summed, what is constant apart from what changes.

use super::{Entry, KktPattern, Load, Term};
use crate::arithmetic::Scalar;
use crate::linear::assembly::Source;
use crate::system::{Description, ValueRef};

impl<T: Scalar> KktPattern<T> {
    /// Chooses the rows to eliminate: constant, without bias, with constant columns, independent.
    pub(super) fn eliminate(&mut self, description: &Description, constants: &[T]) {
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
    pub(super) fn collect_terms(&mut self, description: &Description) {
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
    pub(super) fn merge_terms(&mut self, constants: &[T]) {
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
