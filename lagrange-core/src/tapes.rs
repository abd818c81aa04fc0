//! A system whose type is forgotten: its tapes, as far as the core runs them.
//!
//! What integrates and switches modes works with this. It is compiled once per scalar, not once per system, and so a
//! program with many systems stays small and quick to compile. Steppers do not notice: they run what has been recorded.

use crate::arithmetic::{Arithmetic, Given, Recorder, Scalar, Value};
use crate::declaration::Declaration;
use crate::dynamics::Seeded;
use crate::equations::{ModeEquations, ModeStructure};
use crate::system::{Description, Held, System};
use core::fmt;
use std::sync::Arc;

/// What a tape is given: what is held, the constants, the inputs; and where its outputs go.
pub(crate) struct Call<'a, A: Arithmetic> {
    pub arithmetic: &'a mut A,
    pub held: &'a Held<'a>,
    pub constants: &'a [A::Scalar],
    pub inputs: &'a [A::Node],
    pub outputs: &'a mut [A::Node],
}

/// Which tape.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Which {
    /// What the equations of motion are made of.
    Motion,
    /// What is read after they are solved.
    Report,
}

/// The tapes of a system, in every reading.
pub(crate) trait Tapes<T: Scalar>: Send + Sync {
    /// The table of names, places and needs.
    fn description(&self) -> &'static Description;

    /// What was declared.
    fn declaration(&self) -> &'static Declaration;

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> T;

    /// Everything that depends on parameters only.
    fn constants(&self, held: &Held, c: &mut [T]);

    /// The modes whose equations are emitted.
    fn structures(&self) -> &'static [ModeStructure];

    /// Their functions.
    fn mode_equations(&self) -> &'static [ModeEquations<T>];

    /// Their constants; false if the parameters do not allow the pivots that were chosen at build time.
    fn mode_constants(&self, mode: usize, held: &Held, signs: &[T], c: &mut [T]) -> bool;

    /// Written down.
    fn record(&self, which: Which, call: Call<'_, Recorder<'_, T>>);

    /// The numbers that it is given.
    fn collect(&self, which: Which, call: Call<'_, Given<T>>);

    /// In numbers.
    fn evaluate(&self, which: Which, call: Call<'_, Value<T>>);

    /// The motion tape with derivatives.
    fn differentiate(&self, call: Call<'_, Seeded<T>>);
}

impl<T: Scalar> fmt::Debug for dyn Tapes<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.description().name)
    }
}

/// A system that forgets its type.
pub(crate) type Erased<T> = Arc<dyn Tapes<T>>;

impl<S: System> Tapes<S::Scalar> for S {
    fn description(&self) -> &'static Description {
        S::DESCRIPTION
    }

    fn declaration(&self) -> &'static Declaration {
        S::DECLARATION
    }

    fn parameter(&self, index: usize) -> S::Scalar {
        System::parameter(self, index)
    }

    fn constants(&self, held: &Held, c: &mut [S::Scalar]) {
        System::constants(self, held, c);
    }

    fn structures(&self) -> &'static [ModeStructure] {
        S::MODES
    }

    fn mode_equations(&self) -> &'static [ModeEquations<S::Scalar>] {
        S::mode_equations::<S::Scalar>()
    }

    fn mode_constants(
        &self,
        mode: usize,
        held: &Held,
        signs: &[S::Scalar],
        c: &mut [S::Scalar],
    ) -> bool {
        System::mode_constants(self, mode, held, signs, c)
    }

    fn record(&self, which: Which, call: Call<'_, Recorder<'_, S::Scalar>>) {
        run(self, which, call);
    }

    fn collect(&self, which: Which, call: Call<'_, Given<S::Scalar>>) {
        run(self, which, call);
    }

    fn evaluate(&self, which: Which, call: Call<'_, Value<S::Scalar>>) {
        run(self, which, call);
    }

    fn differentiate(&self, call: Call<'_, Seeded<S::Scalar>>) {
        self.motion(
            call.arithmetic,
            call.held,
            call.constants,
            call.inputs,
            call.outputs,
        );
    }
}

fn run<S: System, A: Arithmetic<Scalar = S::Scalar>>(system: &S, which: Which, call: Call<'_, A>) {
    let Call {
        arithmetic: a,
        held,
        constants,
        inputs,
        outputs,
    } = call;
    match which {
        Which::Motion => system.motion(a, held, constants, inputs, outputs),
        Which::Report => system.report(a, held, constants, inputs, outputs),
    }
}
