//! A system whose type is forgotten.
//!
//! What integrates and switches modes works with this. It is compiled once per scalar, not once per system, and so a
//! program with many systems stays small and quick to compile.

use crate::arithmetic::Scalar;
use crate::declaration::Declaration;
use crate::equations::{ModeStructure, SeriesFn, ValueFn};
use crate::system::{Description, Selection, System};
use core::fmt;
use std::sync::Arc;

/// What the core asks of a system.
pub(crate) trait ErasedSystem<T: Scalar>: Send + Sync {
    /// The table of names, places and needs, and the programs.
    fn description(&self) -> &'static Description;

    /// What was declared.
    fn declaration(&self) -> &'static Declaration;

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> T;

    /// The modes whose equations are emitted.
    fn structures(&self) -> &'static [ModeStructure];

    /// Their right-hand sides.
    fn mode_values(&self) -> &'static [ValueFn<T>];

    /// Their Taylor coefficients.
    fn mode_series(&self) -> &'static [SeriesFn<T>];

    /// Their constants; false if the parameters do not allow the pivots that were chosen at build time.
    fn mode_constants(&self, mode: usize, held: &Selection, signs: &[T], c: &mut [T]) -> bool;
}

impl<T: Scalar> fmt::Debug for dyn ErasedSystem<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.description().name)
    }
}

/// A system that forgets its type.
pub(crate) type Erased<T> = Arc<dyn ErasedSystem<T>>;

impl<S: System> ErasedSystem<S::Scalar> for S {
    fn description(&self) -> &'static Description {
        System::description(self)
    }

    fn declaration(&self) -> &'static Declaration {
        System::declaration(self)
    }

    fn parameter(&self, index: usize) -> S::Scalar {
        System::parameter(self, index)
    }

    fn structures(&self) -> &'static [ModeStructure] {
        S::MODES
    }

    fn mode_values(&self) -> &'static [ValueFn<S::Scalar>] {
        S::mode_values::<S::Scalar>()
    }

    fn mode_series(&self) -> &'static [SeriesFn<S::Scalar>] {
        S::mode_series::<S::Scalar>()
    }

    fn mode_constants(
        &self,
        mode: usize,
        held: &Selection,
        signs: &[S::Scalar],
        c: &mut [S::Scalar],
    ) -> bool {
        System::mode_constants(self, mode, held, signs, c)
    }
}
