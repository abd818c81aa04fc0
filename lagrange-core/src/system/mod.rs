//! What the derive macro implements: a table of everything that was declared, and the equations.
//!
//! The equations of motion in a mode are, with the rows `i` that act in it,
//!
//! ```text
//! M(q,t) v̇ = f(q,v,t) + Σᵢ (aᵢᵀ + couplings) λᵢ        aᵢ v̇ + γᵢ = 0
//! ```

mod description;
mod erased;
pub(crate) mod places;

use crate::arithmetic::{Number, Scalar};
use crate::declaration::Declaration;
use crate::derivation::Derivation;
use crate::equations::{Arguments, ModeStructure, SeriesFn, ValueFn};
pub(crate) use crate::program::{Selection, ValueRef};
pub use description::*;
pub use erased::AnySystem;
pub(crate) use erased::{Erased, ErasedSystem};
pub(crate) use places::{Condition, Normal, Restitution, Row};

/// A mechanical system: what `#[derive(Lagrangian)]` implements, with [`Derived`]. It is not implemented by hand.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanical system",
    note = "derive it, `#[derive(Lagrangian)]`, from what stands in `#[lagrange(…)]`; the numbers in it are `f64` or `Dual`"
)]
pub trait System: Sized + Send + Sync + 'static {
    /// The number type of parameters and state.
    type Scalar: Scalar;

    /// The same system once more, which is what a run keeps.
    #[doc(hidden)]
    fn copy(&self) -> Self;

    /// Names and units of everything that was declared.
    fn description(&self) -> &'static Description;

    /// What was declared, as numbers to be evaluated.
    #[doc(hidden)]
    fn declaration(&self) -> &'static Declaration;

    /// What was derived, to be read.
    fn derivation(&self) -> &'static Derivation {
        &Derivation::NONE
    }

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> Self::Scalar;

    /// Sets parameter `index` of the description.
    fn set_parameter(&mut self, index: usize, value: Self::Scalar);

    /// Positions `q` and velocities `v` of start `index`, at time `t`.
    #[doc(hidden)]
    fn start(&self, index: usize, t: Self::Scalar, q: &mut [Self::Scalar], v: &mut [Self::Scalar]);

    /// The modes whose equations are emitted: [values](Self::mode_values) and [series](Self::mode_series).
    #[doc(hidden)]
    const MODES: &'static [ModeStructure] = &[];

    /// Everything that depends on parameters only in mode `mode` of [`Self::MODES`]; `signs` are, per friction, those of its slip
    /// and of the multiplier that presses. False if the parameters do not allow the pivots that were chosen at build time.
    #[doc(hidden)]
    fn mode_constants(
        &self,
        mode: usize,
        held: &Selection,
        signs: &[Self::Scalar],
        c: &mut [Self::Scalar],
    ) -> bool {
        let _ = (mode, held, signs, c);
        false
    }

    /// Outputs of the motion program for what is held, from the constants `c` and a state; those that nobody asks for are left as they are. False where
    /// one is not finite, as what a parameter that is zero leaves of a pole, or where there is no such function.
    #[doc(hidden)]
    fn motion(
        &self,
        held: &Selection,
        c: &[Self::Scalar],
        state: Arguments<'_, Self::Scalar>,
        nodes: &mut [Self::Scalar],
    ) -> bool {
        let _ = (held, c, state, nodes);
        false
    }

    /// Right-hand sides of the modes, in the order of [`Self::MODES`].
    #[doc(hidden)]
    fn mode_values<N: Number>() -> &'static [ValueFn<N>] {
        &[]
    }

    /// Taylor series of the modes, in the order of [`Self::MODES`].
    #[doc(hidden)]
    fn mode_series<N: Number>() -> &'static [SeriesFn<N>] {
        &[]
    }

    /// The system without its type, which is all that a run sees of it.
    #[doc(hidden)]
    fn erased(&self) -> AnySystem<Self::Scalar> {
        AnySystem::new(self.copy())
    }
}

/// A system whose tables are known when the program is built: those of all values of its type are the same. A system that is read
/// from a file when the program runs is a [`System`] only.
pub trait Derived: System {
    /// What [`System::description`] returns.
    const DESCRIPTION: &'static Description;

    /// What [`System::declaration`] returns.
    #[doc(hidden)]
    const DECLARATION: &'static Declaration;
}
