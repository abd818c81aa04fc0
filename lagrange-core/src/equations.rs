//! The equations of one mode as functions: what the derive emits, and what everything above calls.
//!
//! ```text
//! constants    parameters → c                    what depends on parameters alone, once per run
//! value        c, (t, q, v) → v̇, λ               one right-hand side, and what guards read
//! series       c, (t, q, v) → coefficients       of q, v, λ and of everything that guards read
//! ```
//!
//! The linear system of the mode is solved on the way, by pivots chosen at build time. A pivot that is not safe for the numbers at
//! hand is refused; the core then looks for better ones.

use crate::arithmetic::Number;
pub use crate::arithmetic::products::{Factors, ROW, Row, STRIDE};
pub use crate::arithmetic::registers::Registers;
use crate::arithmetic::registers::{self, Body};
use crate::program::{Selection, ValueRef};
use core::marker::PhantomData;

/// 1/k; of 0, 0.
pub const INVERSES: [f64; ROW] = {
    let mut table = [0.0; ROW];
    let mut k = 1;
    while k < ROW {
        table[k] = 1.0 / k as f64;
        k += 1;
    }
    table
};

/// How a friction acts in a [`ModeStructure`]; the sign of a slip is an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionState {
    /// No force.
    Inactive,
    /// The slip is zero.
    Stick,
    /// The force is μₖ N against the slip, which has one component.
    Slip,
}

/// Which mode a set of functions is for, and where its numbers are.
#[derive(Debug)]
pub struct ModeStructure {
    /// Which contacts are closed.
    pub contacts: &'static [bool],
    /// How each friction acts.
    pub frictions: &'static [FrictionState],
    /// The constraint that is left out, of those that would act.
    pub left_out: Option<usize>,
    /// Number of constants.
    pub constants: usize,
    /// Coordinates that stand still, and where among the constants.
    pub pins: &'static [(usize, ValueRef)],
    /// Number of rows of a series: q, v, λ, zero, then others.
    pub rows: usize,
    /// Number of groups of products whose factors a series keeps.
    pub products: usize,
    /// Number of angles whose sine and cosine are kept.
    pub turns: usize,
    /// Outputs of the motion tape that are given, with their series but for those of inertia and Jacobians: (node, row).
    pub motion: &'static [(usize, usize)],
    /// Outputs of the report tape whose series are given: (node, row).
    pub report: &'static [(usize, usize)],
    /// Whether values also give inertia and the Jacobians of the rows that act, among the outputs of the motion tape.
    pub gives_rows: bool,
    /// How many numbers values give: the first coefficients of the rows, then, if there are more, per coordinate the change of its velocity
    /// that takes the velocities onto the rows that act, the least one in the mass metric.
    pub values: usize,
}

/// Time, positions and velocities.
pub type Arguments<'a, N> = (N, &'a [N], &'a [N]);

/// Accelerations from constants, needs that are held, and a state; if asked for, also the first coefficients of the rows of
/// [`ModeStructure::rows`] that are forces or that guards read. What nobody reads, and what the mode keeps at zero, is left as it
/// is. False if a pivot is not safe.
pub type ValueFn<N> =
    fn(&[N], &Selection, Arguments<'_, N>, &mut [N], Option<&mut [N]>, &mut [Turn<N>]) -> bool;

/// Coefficients 0…order, at most 28, of the rows of [`ModeStructure::rows`], from constants, needs that are held, the order and a
/// state.
pub type SeriesFn<N> =
    fn(&[N], &Selection, usize, Arguments<'_, N>, Memory<'_, N>) -> Result<(), Refused>;

/// What a series is written into: its rows, the factors of its products, and angles.
pub type Memory<'a, N> = (&'a mut [Row<N>], &'a mut [Factors<N>], &'a mut [Turn<N>]);

/// An angle with its sine and cosine: a step begins at the state that ended the one before, and what may follow a switch is tried at one state.
#[derive(Clone, Copy, Debug)]
pub struct Turn<N> {
    angle: N,
    pair: (N, N),
}

impl<N: Number> Turn<N> {
    /// That by 0.
    pub fn none() -> Self {
        Self {
            angle: N::of(0.0),
            pair: (N::of(0.0), N::of(1.0)),
        }
    }

    /// (sin, cos) of an angle, computed anew where it is not the one that was asked for last.
    #[inline(always)]
    pub fn sin_cos(&mut self, angle: N) -> (N, N) {
        if !angle.is_same(self.angle) {
            (self.angle, self.pair) = (angle, angle.sin_cos());
        }
        self.pair
    }
}

/// The series of a mode, for any kind of number: what a [`SeriesFn`] does.
pub trait ModeSeries<N: Number> {
    /// See [`SeriesFn`].
    ///
    /// # Errors
    /// Where there is no series, or where it cannot be had in this way.
    fn expand(
        registers: Registers,
        c: &[N],
        held: &Selection,
        order: usize,
        state: Arguments<'_, N>,
        memory: Memory<'_, N>,
    ) -> Result<(), Refused>;
}

/// A series, compiled for registers of four numbers.
///
/// # Errors
/// Those of the series; the processor may have no such registers.
pub fn across<S: ModeSeries<N>, N: Number>(
    c: &[N],
    held: &Selection,
    order: usize,
    state: Arguments<'_, N>,
    memory: Memory<'_, N>,
) -> Result<(), Refused> {
    let arguments = (c, held, order, state, memory);
    registers::across::<Expansion<S>, _>(arguments).unwrap_or(Err(Refused::NoRegisters))
}

/// The arguments of a [`SeriesFn`] as one.
type SeriesArguments<'a, N> = (
    &'a [N],
    &'a Selection<'a>,
    usize,
    Arguments<'a, N>,
    Memory<'a, N>,
);

/// A series as a function of one argument.
struct Expansion<S>(PhantomData<S>);

impl<N: Number, S: ModeSeries<N>> Body<SeriesArguments<'_, N>> for Expansion<S> {
    type Output = Result<(), Refused>;

    #[inline(always)]
    fn run(
        registers: Registers,
        (c, held, order, state, memory): SeriesArguments<'_, N>,
    ) -> Self::Output {
        S::expand(registers, c, held, order, state, memory)
    }
}

/// The first `L` of several: as many as the description tells, so that reading one of them needs no check.
#[inline(always)]
pub fn first<const L: usize, X>(all: &[X]) -> &[X; L] {
    match all.first_chunk() {
        Some(first) => first,
        None => shorter_than_described(),
    }
}

/// The same, to write.
#[inline(always)]
pub fn first_mut<const L: usize, X>(all: &mut [X]) -> &mut [X; L] {
    match all.first_chunk_mut() {
        Some(first) => first,
        None => shorter_than_described(),
    }
}

/// Keeps a coefficient of a series: rustc checks the types of a call faster than those of an assignment to an element.
#[inline(always)]
pub fn keep<N: Copy>(row: &mut Row<N>, at: usize, coefficient: N) {
    row[at] = coefficient;
}

#[cold]
fn shorter_than_described() -> ! {
    panic!("an argument is shorter than the description of the system says")
}

/// Why a series is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// A pivot is not safe.
    Pivot,
    /// An operation has no Taylor series there.
    NoSeries,
    /// The processor has no registers of four numbers.
    NoRegisters,
}

/// Whether a number of parameters alone may be divided by: constant rows are eliminated by pivots chosen at build time.
pub fn is_safe_divisor(pivot: f64, against: &[f64]) -> bool {
    /// A pivot smaller than this beside the largest element of its row loses more than three digits.
    const SMALLEST: f64 = 1e-3;
    pivot.is_finite() && pivot > against.iter().fold(0.0, |largest, x| x.max(largest)) * SMALLEST
}
