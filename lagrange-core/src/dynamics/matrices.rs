//! The equations of a mode as matrices, to look at and to compare with a derivation by hand.

use super::{Compiled, Dynamics};
use crate::arithmetic::Value;
use crate::linear::least_norm;
use crate::system::{Place, System};
use nalgebra::{DMatrix, DVector};

impl<S: System> Dynamics<S> {
    /// M, coordinates × coordinates, at the last [`Self::value`].
    pub fn mass_matrix(&self) -> DMatrix<S::Scalar> {
        let n = S::DESCRIPTION.coordinates.len();
        let mut matrix = DMatrix::from_element(n, n, S::Scalar::default());
        for &(i, j, place) in S::DESCRIPTION.mass {
            matrix[(i, j)] = self.motion(place);
            matrix[(j, i)] = self.motion(place);
        }
        matrix
    }

    /// f, one per coordinate, at the last [`Self::value`].
    pub fn forcing(&self) -> DVector<S::Scalar> {
        let forcing = S::DESCRIPTION
            .forcing
            .iter()
            .map(|&place| self.motion(place));
        DVector::from_iterator(S::DESCRIPTION.coordinates.len(), forcing)
    }

    /// A of the rows that act ([`Self::acting_rows`]) × coordinates, at the last [`Self::value`].
    pub fn constraint_jacobian(&self) -> DMatrix<S::Scalar> {
        let rows = self.acting_rows();
        let n = S::DESCRIPTION.coordinates.len();
        let mut matrix = DMatrix::from_element(rows.len(), n, S::Scalar::default());
        for (k, &row) in rows.iter().enumerate() {
            for &(j, place) in S::DESCRIPTION.rows[row].jacobian {
                matrix[(k, j)] = self.motion(place);
            }
        }
        matrix
    }

    /// λ of the rows that act ([`Self::acting_rows`]), at the last [`Self::value`].
    pub fn multipliers(&self) -> DVector<S::Scalar> {
        let rows = self.acting_rows();
        DVector::from_iterator(rows.len(), rows.iter().map(|&row| self.force(row)))
    }

    /// Whether rows that act depend on one another at the last [`Self::value`], so that single forces are not determined.
    /// [`Self::force`] then gives those of an independent subset.
    pub fn has_dependent_rows(&self) -> bool {
        let compiled = self.compiled();
        compiled.plan.has_dependent_rows() || compiled.solver.has_rows_aside()
    }

    /// The forces of all rows at the last [`Self::value`], where they are not determined those of least norm; and whether
    /// each is determined (rows that do not act are).
    pub fn least_norm_forces(&self) -> (Vec<S::Scalar>, Vec<bool>) {
        let d = S::DESCRIPTION;
        let n = d.coordinates.len();
        let acting = self.acting_rows();
        let Compiled {
            plan, constants, ..
        } = self.compiled();
        let mut nodes = self.nodes.clone();
        nodes.resize(nodes.len() + plan.program.len(), S::Scalar::default());
        for heading in &plan.headings {
            for (node, along) in heading
                .nodes
                .into_iter()
                .zip(self.heading(heading.friction))
            {
                nodes[node] = along;
            }
        }
        plan.program.run(&mut Value::new(), constants, &mut nodes);
        let number = |place: Place| match place {
            Place::Zero => S::Scalar::default(),
            Place::Constant(i) => constants[i],
            Place::Node(i) => nodes[i],
        };
        let mut columns = vec![S::Scalar::default(); n * acting.len()];
        for (index, coordinate, place) in plan.columns() {
            columns[index * n + coordinate] += number(place);
        }
        let mut acting_forces: Vec<S::Scalar> = acting.iter().map(|&row| self.force(row)).collect();
        let acting_determined = least_norm(&columns, n, &mut acting_forces);
        let mut forces: Vec<S::Scalar> = (0..d.rows.len()).map(|row| self.force(row)).collect();
        let mut determined = vec![true; d.rows.len()];
        for (i, &row) in acting.iter().enumerate() {
            forces[row] = acting_forces[i];
            determined[row] = acting_determined[i];
        }
        for slide in &plan.slides {
            if let Some(source) = slide.source {
                forces[slide.row] = number(slide.factor) * forces[source];
                determined[slide.row] = determined[source];
            }
        }
        (forces, determined)
    }
}
