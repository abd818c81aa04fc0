//! What a program calls of the core, as a table of functions per scalar.
//!
//! Everything here is generic over the scalar, so that a program would compile all of it once more for itself. The tables of
//! machine numbers are made in this crate: programs that run on them call what is compiled already.

use crate::arithmetic::Scalar;
use crate::certificate::{self, Certificate};
use crate::dynamics::{Dynamics, Packets};
use crate::effects::Effects;
use crate::error::Error;
use crate::run::Run;
use crate::run::round::{Member, go_on};
use crate::simulation::{Held, Settings};
use crate::tapes::Erased;
use crate::trajectory::{Instant, Ledger, Record, Sampler, State};
use core::fmt;
use core::ops::Range;

/// The functions for one scalar.
pub struct Entries<T: Scalar> {
    pub(crate) run: fn(Erased<T>, &Settings) -> Run<T>,
    pub(crate) execute: Execute<T>,
    pub(crate) launch: Execute<T>,
    pub(crate) go_on: fn(&mut Packets<T>, &mut [Member<'_, T>]),
    pub(crate) land: fn(&mut Run<T>, &mut Record<T>),
    pub(crate) set_system: fn(&mut Run<T>, Erased<T>),
    pub(crate) consistent: Consistent<T>,
    pub(crate) sampler: fn(&Record<T>) -> Sampler<'_, T>,
    pub(crate) at: fn(&mut Sampler<'_, T>, f64) -> Result<Instant<T>, Error>,
    pub(crate) ledgers: Book<T>,
    pub(crate) verify: fn(&Record<T>, u64, f64) -> Result<Certificate, Error>,
    pub(crate) dynamics: fn(Erased<T>, &Effects) -> Dynamics<T>,
}

type Execute<T> = fn(&mut Run<T>, &State<T>, Range<f64>, &mut Record<T>) -> Result<(), Error>;
type Book<T> = fn(&Record<T>, Option<&[f64]>) -> Result<Vec<Ledger>, Error>;
type Consistent<T> = fn(&mut Run<T>, f64, &State<T>, &State<T>, &Held) -> Result<State<T>, Error>;

impl<T: Scalar> Entries<T> {
    /// The functions themselves.
    pub(crate) const OWN: Self = Self {
        run: Run::new,
        execute: Run::execute,
        launch: Run::launch,
        go_on,
        land: Run::land,
        set_system: Run::set_system,
        consistent: Run::consistent,
        sampler: |record| Sampler::new(record),
        at: |sampler, t| sampler.evaluate_at(t),
        ledgers: Record::book,
        verify: certificate::verify,
        dynamics: Dynamics::of,
    };
}

impl<T: Scalar> fmt::Debug for Entries<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entries").finish_non_exhaustive()
    }
}
