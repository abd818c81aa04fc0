//! A system whose type is forgotten.
//!
//! What integrates and switches modes works with this. It is compiled once per scalar, not once per system, and so a
//! program with many systems stays small and quick to compile.

use super::{Description, Selection, System};
use crate::arithmetic::Scalar;
use crate::declaration::Declaration;
use crate::derivation::Derivation;
use crate::equations::{Arguments, ModeStructure, SeriesFn, ValueFn};
use core::fmt;
use std::sync::Arc;

/// What the core asks of a system.
pub(crate) trait ErasedSystem<T: Scalar>: Send + Sync {
    /// The table of names, places and needs, and the programs.
    fn description(&self) -> &'static Description;

    /// What was declared.
    fn declaration(&self) -> &'static Declaration;

    /// What was derived.
    fn derivation(&self) -> &'static Derivation;

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> T;

    /// The values of all parameters.
    fn parameters(&self) -> Vec<f64> {
        let count = self.description().parameters.len();
        (0..count).map(|i| self.parameter(i).value()).collect()
    }

    /// The same system with another value of parameter `index`.
    fn with_parameter(&self, index: usize, value: T) -> Erased<T>;

    /// Start `index` at time `t`.
    fn start(&self, index: usize, t: T, q: &mut [T], v: &mut [T]);

    /// The modes whose equations are emitted.
    fn structures(&self) -> &'static [ModeStructure];

    /// Their right-hand sides.
    fn mode_values(&self) -> &'static [ValueFn<T>];

    /// Their Taylor coefficients.
    fn mode_series(&self) -> &'static [SeriesFn<T>];

    /// Their constants; false if the parameters do not allow the pivots that were chosen at build time.
    fn mode_constants(&self, mode: usize, held: &Selection, signs: &[T], c: &mut [T]) -> bool;

    /// The outputs of the motion program for what is held; false if they are not given.
    fn motion(&self, held: &Selection, c: &[T], state: Arguments<'_, T>, nodes: &mut [T]) -> bool;
}

impl<T: Scalar> fmt::Debug for dyn ErasedSystem<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.description().name)
    }
}

/// A system that forgets its type.
pub(crate) type Erased<T> = Arc<dyn ErasedSystem<T>>;

/// A system whose type is forgotten. A program that knows many systems and works with this is compiled once for all of them.
///
/// ```
/// use lagrange_core::prelude::*;
/// use lagrange_core::system::AnySystem;
///
/// #[derive(Lagrangian, Clone, Debug)]
/// #[lagrange(coordinates(x), kinetic = mass * der(x)^2 / 2, force(push: x = 3), start(rest: x = 0))]
/// struct Cart<T = f64> {
///     mass: T,
/// }
///
/// let mut system = AnySystem::new(Cart { mass: 1.0 });
/// system.set_parameter(0, 6.0);
/// let run = Simulation::new(&system).run(system.at(StartId(0)), 0.0..2.0).expect("runs");
/// assert_eq!(run.final_state().q, [1.0]);
/// ```
#[derive(Clone, Debug)]
pub struct AnySystem<T: Scalar> {
    pub(crate) system: Erased<T>,
}

impl<T: Scalar> AnySystem<T> {
    /// Forgets the type of a system.
    pub fn new<S: System<Scalar = T>>(system: S) -> Self {
        Self {
            system: Arc::new(system),
        }
    }
}

impl<T: Scalar> System for AnySystem<T> {
    type Scalar = T;

    fn copy(&self) -> Self {
        self.clone()
    }

    fn description(&self) -> &'static Description {
        self.system.description()
    }

    fn declaration(&self) -> &'static Declaration {
        self.system.declaration()
    }

    fn derivation(&self) -> &'static Derivation {
        self.system.derivation()
    }

    fn parameter(&self, index: usize) -> T {
        self.system.parameter(index)
    }

    fn set_parameter(&mut self, index: usize, value: T) {
        self.system = self.system.with_parameter(index, value);
    }

    fn start(&self, index: usize, t: T, q: &mut [T], v: &mut [T]) {
        self.system.start(index, t, q, v);
    }

    fn erased(&self) -> AnySystem<T> {
        self.clone()
    }
}

impl<S: System> ErasedSystem<S::Scalar> for S {
    fn description(&self) -> &'static Description {
        System::description(self)
    }

    fn declaration(&self) -> &'static Declaration {
        System::declaration(self)
    }

    fn derivation(&self) -> &'static Derivation {
        System::derivation(self)
    }

    fn parameter(&self, index: usize) -> S::Scalar {
        System::parameter(self, index)
    }

    fn with_parameter(&self, index: usize, value: S::Scalar) -> Erased<S::Scalar> {
        let mut system = self.copy();
        system.set_parameter(index, value);
        Arc::new(system)
    }

    fn start(&self, index: usize, t: S::Scalar, q: &mut [S::Scalar], v: &mut [S::Scalar]) {
        System::start(self, index, t, q, v);
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

    fn motion(
        &self,
        held: &Selection,
        c: &[S::Scalar],
        state: Arguments<'_, S::Scalar>,
        nodes: &mut [S::Scalar],
    ) -> bool {
        System::motion(self, held, c, state, nodes)
    }
}
