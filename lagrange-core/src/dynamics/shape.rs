//! What the interpreted equations of a mode consist of: programs without their numbers, and what they are loaded for.
//!
//! Registers: zero | t q v v̇ λ | numbers | results. The parts of the program follow one another:
//!
//! ```text
//! motion     t, q, v → masses, forces, rows
//! system     → right-hand sides of K w = b, which the solver takes, w = (u̇, −λ of the rows kept)
//! forces     w → v̇, λ of all rows
//! report     t, q, v, v̇, λ → outputs
//! ```

use super::output_mask::OutputMask;
use crate::arithmetic::Number;
use crate::linear::KktPattern;
use crate::mode::Mode;
use crate::program::{Program, Register, Series};
use crate::system::Description;
use core::ops::Range;

/// Parts of the program.
pub(super) const MOTION: usize = 0;
pub(super) const SYSTEM: usize = 1;
pub(super) const FORCES: usize = 2;
pub(super) const REPORT: usize = 3;

/// How much of the program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// All outputs that are held.
    Everything,
    /// What has a series.
    Series,
    /// What the accelerations need.
    Accelerations,
}

/// What equations are loaded for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<'a> {
    /// Outputs of the motion that are held.
    pub held: &'a OutputMask,
    /// Those of them that are asked for beside the motion.
    pub extra: &'a OutputMask,
    /// Outputs of the report that are held; none if nothing is asked of it.
    pub report: Option<&'a OutputMask>,
    /// Which part of the equations is loaded.
    pub part: Part,
    /// Whether outputs of the forcing are held. With rows they are not: the forces that they consist of are not asked for.
    pub forcing: bool,
}

/// Which part of the equations is loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// All: the equations of motion are solved.
    Solution,
    /// Outputs.
    Outputs,
}

/// What the equations of a mode are loaded from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planned<'a, T> {
    pub mode: &'a Mode,
    /// Constants of the system, then those of the plan.
    pub constants: &'a [T],
    /// How the linear system is solved.
    pub pattern: &'a KktPattern<T>,
}

impl<'a, T> Planned<'a, T> {
    /// The constants that equations loaded for outputs or for a solution read.
    pub(super) fn constants(self, d: &Description, part: Part) -> &'a [T] {
        match part {
            Part::Solution => self.constants,
            Part::Outputs => &self.constants[..d.constants.outputs],
        }
    }
}

/// The program of a mode without its numbers.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Shape {
    pub everything: Program,
    pub series: Program,
    pub accelerations: Program,
    /// Numbers that may change, with their rates.
    pub integrals: Vec<(Register, Register)>,
    /// Right-hand sides of the equations.
    pub right: Vec<Register>,
    /// Where the unknowns go.
    pub unknowns: Vec<Register>,
    /// Elements of the matrix that change with the state: (equation, element, unknown).
    pub elements: Vec<(usize, Register, Register)>,
    /// Outputs of the motion program, zero for those that are not held, then those of the plan.
    pub nodes: Vec<Register>,
    pub report_nodes: Vec<Register>,
    /// Outputs of the motion program that are held: (node, register).
    pub held_nodes: Vec<(usize, Register)>,
    /// Directions given from outside: (friction, components, their rates).
    pub slip_directions: Vec<(usize, [Register; 2], [Register; 2])>,
    /// What presses frictions, given from outside.
    pub resultants: Vec<ResultantRegisters>,
    /// Registers whose series are kept.
    pub wanted: Vec<Register>,
    /// Where the numbers are.
    pub numbers: Range<usize>,
    /// How many registers are used, and the room for them.
    pub used: usize,
    pub registers: usize,
}

/// Where N = Σ uᵢ λᵢ + ρ is given.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ResultantRegisters {
    /// Index into the description.
    pub resultant: usize,
    /// u
    pub along: [Register; 3],
    /// ρ and its rate.
    pub rest: (Register, Register),
    /// Per constraint: the unknown that is −λ; none where the force follows from others.
    pub forces: Vec<Option<usize>>,
}

impl Shape {
    /// The program of this extent.
    pub(super) fn program(&self, extent: Extent) -> &Program {
        match extent {
            Extent::Everything => &self.everything,
            Extent::Series => &self.series,
            Extent::Accelerations => &self.accelerations,
        }
    }

    /// Memory for Taylor coefficients.
    pub(super) fn series<C: Number>(&self) -> Series<C> {
        let elements = self.elements.iter();
        Series::new(
            &self.series,
            self.registers,
            &self.wanted,
            elements.map(|&(_, element, unknown)| (element, unknown)),
            FORCES,
        )
    }

    /// Right-hand sides of one order, from the coefficients `now`, the values `first`, and what `earlier` coefficients of the elements
    /// and unknowns give.
    #[inline(always)]
    pub(super) fn right_hand_sides<C: Number>(
        &self,
        now: &[C],
        first: &[C],
        earlier: &[C],
        right: &mut Vec<C>,
    ) {
        right.clear();
        right.extend(self.right.iter().map(|register| now[register.index()]));
        let elements = self.elements.iter().zip(earlier);
        for (&(equation, element, unknown), &earlier) in elements {
            let product = now[element.index()] * first[unknown.index()];
            right[equation] = right[equation] - (product + earlier);
        }
    }
}
