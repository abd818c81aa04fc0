//! A system whose type is forgotten: its tapes, as far as the core runs them.
//!
//! What integrates and switches modes works with this. It is compiled once per scalar, not once per system, and so a
//! program with many systems stays small and quick to compile. Steppers do not notice: they run what has been recorded.

use crate::arithmetic::{Arithmetic, Recorder, Scalar, Value};
use crate::dynamics::Seeded;
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

/// The tapes of a system, in every reading.
pub(crate) trait Tapes<T: Scalar>: Send + Sync {
    /// The table of names, places and needs.
    fn description(&self) -> &'static Description;

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> T;

    /// Everything that depends on parameters only.
    fn constants(&self, held: &Held, c: &mut [T]);

    /// The motion tape, written down.
    fn motion_recorded(&self, call: Call<'_, Recorder<'_, T>>);

    /// The report tape, written down.
    fn report_recorded(&self, call: Call<'_, Recorder<'_, T>>);

    /// The motion tape in numbers.
    fn motion_value(&self, call: Call<'_, Value<T>>);

    /// The report tape in numbers.
    fn report_value(&self, call: Call<'_, Value<T>>);

    /// The motion tape with derivatives.
    fn motion_seeded(&self, call: Call<'_, Seeded<T>>);
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

    fn parameter(&self, index: usize) -> S::Scalar {
        System::parameter(self, index)
    }

    fn constants(&self, held: &Held, c: &mut [S::Scalar]) {
        System::constants(self, held, c);
    }

    fn motion_recorded(&self, call: Call<'_, Recorder<'_, S::Scalar>>) {
        motion(self, call);
    }

    fn report_recorded(&self, call: Call<'_, Recorder<'_, S::Scalar>>) {
        report(self, call);
    }

    fn motion_value(&self, call: Call<'_, Value<S::Scalar>>) {
        motion(self, call);
    }

    fn report_value(&self, call: Call<'_, Value<S::Scalar>>) {
        report(self, call);
    }

    fn motion_seeded(&self, call: Call<'_, Seeded<S::Scalar>>) {
        motion(self, call);
    }
}

fn motion<S: System, A: Arithmetic<Scalar = S::Scalar>>(system: &S, call: Call<'_, A>) {
    let Call {
        arithmetic,
        held,
        constants,
        inputs,
        outputs,
    } = call;
    system.motion(arithmetic, held, constants, inputs, outputs);
}

fn report<S: System, A: Arithmetic<Scalar = S::Scalar>>(system: &S, call: Call<'_, A>) {
    let Call {
        arithmetic,
        held,
        constants,
        inputs,
        outputs,
    } = call;
    system.report(arithmetic, held, constants, inputs, outputs);
}
