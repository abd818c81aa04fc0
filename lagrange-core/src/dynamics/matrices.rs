//! The equations of a mode as matrices, to look at and to compare with a derivation by hand.

use super::Dynamics;
use super::shape::{Extent, SYSTEM};
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::linear::{Freedom, Rank, dot, least_norm};
use crate::mode::FrictionMode;
use nalgebra::{DMatrix, DVector};

impl<T: Scalar> Dynamics<T> {
    /// M, coordinates × coordinates, at the last [`Self::value`].
    pub fn mass_matrix(&self) -> DMatrix<T> {
        let n = self.description().coordinates.len();
        let mut matrix = DMatrix::from_element(n, n, T::default());
        for &(i, j, place) in self.description().mass {
            matrix[(i, j)] = self.motion(place);
            matrix[(j, i)] = self.motion(place);
        }
        matrix
    }

    /// f, one per coordinate, at the last [`Self::value`].
    pub fn forcing(&self) -> DVector<T> {
        let forcing = self
            .description()
            .forcing
            .iter()
            .map(|&place| self.motion(place));
        DVector::from_iterator(self.description().coordinates.len(), forcing)
    }

    /// What friction that slips, and applied forces that are proportional to other forces, add to f, one per coordinate, at the last
    /// [`Self::value`]: M v̇ = f + Aᵀ λ + this.
    pub fn coupled_forces(&self) -> DVector<T> {
        let d = self.description();
        let mut sum = DVector::from_element(d.coordinates.len(), T::default());
        let frictions = d.frictions.iter().zip(&self.mode().frictions);
        let slides = frictions.filter(|(_, state)| matches!(state, FrictionMode::Slip(_)));
        for row in slides.flat_map(|(friction, _)| friction.rows()) {
            for &(j, place) in d.rows[row].jacobian {
                sum[j] += self.motion(place) * self.force(row);
            }
        }
        for coupling in d.couplings {
            let owner = d.forces.iter().position(|f| f.need == coupling.need);
            if owner.is_none_or(|i| self.effects().includes(d, Item::Force(i))) {
                sum[coupling.coordinate] += self.motion(coupling.factor) * self.force(coupling.row);
            }
        }
        sum
    }

    /// Whether M is positive definite at the evaluation at hand, which need not have come to its end.
    pub(super) fn has_inertia(&self) -> bool {
        let n = self.description().coordinates.len();
        let nodes = self.program_nodes();
        let mut matrix = DMatrix::zeros(n, n);
        for &(i, j, place) in self.description().mass {
            let mass = place.read(&self.compiled().constants, &nodes).value();
            matrix[(i, j)] = mass;
            matrix[(j, i)] = mass;
        }
        matrix.cholesky().is_some()
    }

    /// A of the rows that act ([`Self::acting_rows`]) × coordinates, at the last [`Self::value`].
    pub fn constraint_jacobian(&self) -> DMatrix<T> {
        let rows = self.acting_rows();
        let n = self.description().coordinates.len();
        let mut matrix = DMatrix::from_element(rows.len(), n, T::default());
        for (k, &row) in rows.iter().enumerate() {
            for &(j, place) in self.description().rows[row].jacobian {
                matrix[(k, j)] = self.motion(place);
            }
        }
        matrix
    }

    /// λ of the rows that act ([`Self::acting_rows`]), at the last [`Self::value`].
    pub fn multipliers(&self) -> DVector<T> {
        let rows = self.acting_rows();
        DVector::from_iterator(rows.len(), rows.iter().map(|&row| self.force(row)))
    }

    /// Whether rows that act depend on one another at the last [`Self::value`], so that single forces are not determined.
    /// [`Self::force`] then gives those of an independent subset.
    pub fn has_dependent_rows(&self) -> bool {
        let compiled = self.compiled();
        // The pivots of functions are safe.
        !self.by_functions
            && (compiled.pattern.has_dependent_rows() || compiled.solver.has_rows_aside())
    }

    /// Whether rows whose coefficients change with the state were dependent at the last evaluation by the solver.
    pub(crate) fn has_rows_aside(&self) -> bool {
        !self.by_functions && self.compiled().solver.has_rows_aside()
    }

    /// How many rows the solver has found to be independent at the last [`Self::value`].
    fn independent_rows(&self) -> usize {
        let compiled = self.compiled();
        compiled.pattern.independent_rows() - compiled.solver.rows_aside()
    }

    /// Whether rows are held aside now, see [`Self::hold_rows_aside`].
    pub(crate) fn holds_rows_aside(&self) -> bool {
        !self.by_functions && self.compiled().solver.holds_rows_aside()
    }

    /// Whether this row is one of those that [`Self::hold_rows_aside`] holds.
    pub(crate) fn holds_aside(&self, row: usize) -> bool {
        self.compiled().holds_aside(row)
    }

    /// Whether the rows that were found dependent in the last evaluation are not looked at until this is said again.
    pub(crate) fn hold_rows_aside(&mut self, yes: bool) {
        self.modes[self.current].solver.hold_rows_aside(yes);
    }

    /// Forces of the rows that act ([`Self::acting_rows`]), of least norm, and how else they could be.
    ///
    /// The multiplier of a unit quaternion is no force, and does not count: it is what all others leave along the quaternion.
    pub(crate) fn least_norm_of_acting(&self) -> LeastForces<T> {
        let n = self.description().coordinates.len();
        let acting = self.acting_rows();
        let pattern = &self.compiled().pattern;
        let nodes = self.program_nodes();
        let mut columns = vec![T::default(); n * acting.len()];
        for (index, coordinate, place) in pattern.columns() {
            columns[index * n + coordinate] += place.read(&self.compiled().constants, &nodes);
        }
        let mut forces: Vec<T> = acting.iter().map(|&row| self.force(row)).collect();
        let attitudes = self.attitudes();
        let attitudes = attitudes.map(|k| (k, split_off(k, &mut columns, n, &mut forces)));
        let attitudes: Vec<_> = attitudes.collect();
        // Forces that act through multipliers press the columns apart: rows that depend on one another may have independent forces.
        let rank = match pattern.is_coupled() {
            false => Rank::Known(self.independent_rows()),
            true => Rank::Numerical,
        };
        let freedom = least_norm(&columns, n, rank, &mut forces);
        let mut least = LeastForces {
            forces,
            freedom,
            attitudes,
        };
        let mut forces = least.forces.clone();
        least.follow(&least.forces, &mut forces);
        least.forces = forces;
        least
    }

    /// Of the rows that act, those that keep quaternions at unit length.
    fn attitudes(&self) -> impl Iterator<Item = usize> + '_ {
        let constraints = self.description().constraints.iter();
        let rows = constraints.filter(|c| c.attitude.is_some()).map(|c| c.row);
        rows.filter_map(|row| self.acting_rows().binary_search(&row).ok())
    }

    /// Forces of all rows, sliding frictions included, given those of the rows that act.
    pub(crate) fn forces_of_acting(&self, acting_forces: &[T]) -> Vec<T> {
        let nodes = self.program_nodes();
        let rows = 0..self.description().rows.len();
        let mut forces: Vec<T> = rows.map(|row| self.force(row)).collect();
        for (&row, &force) in self.acting_rows().iter().zip(acting_forces) {
            forces[row] = force;
        }
        let slides = || self.compiled().pattern.sliding.slides.iter();
        let follows = slides().filter(|slide| slide.source.is_some());
        follows.for_each(|slide| forces[slide.row] = T::zero());
        for slide in slides() {
            if let Some(source) = slide.source {
                let factor = slide.factor.read(&self.compiled().constants, &nodes);
                let force = factor * forces[source];
                forces[slide.row] += force;
            }
        }
        forces
    }

    /// Whether row `row` says nothing new at the last [`Self::value`]: its Jacobian (which must have been asked for) is a
    /// combination of those of the rows that act.
    pub(crate) fn follows(&self, row: usize) -> bool {
        let n = self.description().coordinates.len();
        let acting = self.acting_rows();
        let count = acting.len();
        let mut matrix = vec![T::default(); n * (count + 1)];
        for (k, &r) in acting.iter().chain([&row]).enumerate() {
            for &(j, place) in self.description().rows[r].jacobian {
                matrix[k * n + j] = self.motion(place);
            }
        }
        let mut forces = vec![T::default(); count + 1];
        // A column that others replace is not determined.
        !least_norm(&matrix, n, Rank::Numerical, &mut forces).is_determined(count)
    }

    /// Whether forces that the rows leave open change the motion at the last [`Self::value`]: the friction of a body that slides on
    /// one of many supports.
    pub(crate) fn leaves_motion_open(&self) -> bool {
        let n = self.description().coordinates.len();
        let acting = self.acting_rows();
        let mut rows = vec![T::default(); n * acting.len()];
        for (row, out) in acting.iter().zip(rows.chunks_exact_mut(n.max(1))) {
            for &(j, place) in self.description().rows[*row].jacobian {
                out[j] = self.motion(place);
            }
        }
        let mut forces = vec![T::default(); acting.len()];
        let rank = Rank::Known(self.independent_rows());
        let open = least_norm(&rows, n, rank, &mut forces).dimension();
        open > self.least_norm_of_acting().freedom.dimension()
    }

    /// Outputs of the motion program, then those of the plan.
    fn program_nodes(&self) -> Vec<T> {
        let Some(interpreted) = self.compiled().interpreted() else {
            return self.nodes.clone();
        };
        let shape = &interpreted.shape;
        let mut registers = interpreted.registers.clone();
        for &(friction, components, _) in &shape.slip_directions {
            let held = self.slip_directions.held(friction);
            for (register, along) in components.into_iter().zip(held) {
                registers[register.index()] = along;
            }
        }
        shape
            .program(Extent::Everything)
            .evaluate(SYSTEM, &mut registers);
        let nodes = shape.nodes.iter();
        nodes.map(|register| registers[register.index()]).collect()
    }
}

/// Forces of the rows that act, of which some are not determined.
#[derive(Clone, Debug, Default)]
pub(crate) struct LeastForces<T> {
    /// Those of least norm.
    pub(crate) forces: Vec<T>,
    /// How else they could be, but for the multipliers of quaternions.
    pub(crate) freedom: Freedom<T>,
    /// Multipliers of quaternions, and what each takes of the others.
    attitudes: Vec<(usize, Vec<T>)>,
}

impl<T: Scalar> LeastForces<T> {
    /// Makes force `i` zero, unless it is determined, and those of the others that can be chosen the least; how they follow from it, per force.
    pub(crate) fn choose_zero(&mut self, i: usize) -> Option<Vec<T>> {
        let along = self.freedom.choose(i)?;
        let changes = along.iter().map(|&part| -(part * self.forces[i]));
        self.forces = self.changed(&changes.collect::<Vec<T>>());
        Some(along)
    }

    /// The forces with these `changes`, and with what multipliers of quaternions follow from them.
    pub(crate) fn changed(&self, changes: &[T]) -> Vec<T> {
        let pairs = self.forces.iter().zip(changes);
        let mut forces: Vec<T> = pairs.map(|(&force, &change)| force + change).collect();
        self.follow(changes, &mut forces);
        forces
    }

    /// Changes the multipliers of quaternions among `forces` as follows from `changes` of the others.
    fn follow(&self, changes: &[T], forces: &mut [T]) {
        for (k, parts) in &self.attitudes {
            forces[*k] -= dot(parts, changes);
        }
    }
}

/// Takes out of all columns but number `k` what they have along that one, and gives it to force `k`; how much that is of each.
fn split_off<T: Scalar>(k: usize, columns: &mut [T], n: usize, forces: &mut [T]) -> Vec<T> {
    let along = columns[k * n..(k + 1) * n].to_vec();
    let square = dot(&along, &along);
    let mut parts = vec![T::zero(); forces.len()];
    if square.is_zero() {
        return parts;
    }
    for (j, column) in columns
        .chunks_exact_mut(n)
        .enumerate()
        .filter(|(j, _)| *j != k)
    {
        let part = dot(column, &along) / square;
        for (x, &y) in column.iter_mut().zip(&along) {
            *x -= part * y;
        }
        let force = forces[j];
        forces[k] += part * force;
        parts[j] = part;
    }
    parts
}
