//! The equations of a mode as matrices, to look at and to compare with a derivation by hand.

use super::Dynamics;
use crate::system::System;
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
}
