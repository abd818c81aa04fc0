//! One mode's functions with the memory that they work in.

use crate::arithmetic::{Scalar, epsilon};
use crate::effects::{Effects, Item};
use crate::equations::{
    Arguments, FrictionState, ModeEquations, ModeStructure, Refused, Row, STRIDE,
};
use crate::erased::ErasedSystem;
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Description, Held, Place};

/// A series that is always zero.
const NO_ROW: u32 = u32::MAX;

/// The emitted equations of a mode.
#[derive(Clone, Debug)]
pub(super) struct Emitted<T: Scalar> {
    index: usize,
    structure: &'static ModeStructure,
    equations: ModeEquations<T>,
    constants: Vec<T>,
    /// Per friction: sign of its slip, and of the multiplier that presses.
    signs: Vec<T>,
    /// Whether the parameters allow the pivots that were chosen at build time.
    admitted: bool,
    rows: Vec<Row<T>>,
    order: usize,
    /// By node: its row.
    motion_rows: Vec<u32>,
    report_rows: Vec<u32>,
}

/// The signs that a mode gives its slips, if its frictions are those of a structure.
fn signs<T: Scalar>(structure: &ModeStructure, mode: &Mode) -> Option<Vec<T>> {
    let mut signs = Vec::with_capacity(2 * mode.frictions.len());
    for (state, friction) in structure.frictions.iter().zip(&mode.frictions) {
        let pair = match (state, friction) {
            (FrictionState::Inactive, FrictionMode::Inactive)
            | (FrictionState::Stick, FrictionMode::Stick) => [1.0, 1.0],
            (FrictionState::Slip, FrictionMode::Slip(sliding)) => match sliding.direction {
                Direction::Fixed([sign, 0.0]) => [sign, sliding.normal_sign],
                _ => return None,
            },
            _ => return None,
        };
        signs.extend(pair.map(T::from_f64));
    }
    Some(signs)
}

fn rows_by_node(nodes: usize, rows: &[(usize, usize)]) -> Vec<u32> {
    let mut list = vec![NO_ROW; nodes];
    for &(node, row) in rows {
        list[node] = row as u32;
    }
    list
}

impl<T: Scalar> Emitted<T> {
    /// The equations of a mode, if they have been emitted. Without a constraint others hold.
    pub(super) fn of(system: &dyn ErasedSystem<T>, effects: &Effects, mode: &Mode) -> Option<Self> {
        let d = system.description();
        let other = |item| matches!(item, Item::Constraint(_));
        if effects.left_out().any(other) {
            return None;
        }
        let structures = system.structures().iter().enumerate();
        let mut matching = structures.filter(|(_, s)| s.contacts == mode.contacts);
        let (index, structure, signs) =
            matching.find_map(|(index, s)| Some((index, s, signs(s, mode)?)))?;
        let zero = T::default();
        Some(Self {
            index,
            structure,
            equations: *system.mode_equations().get(index)?,
            constants: vec![zero; structure.constants],
            signs,
            admitted: false,
            rows: vec![[zero; STRIDE]; structure.rows],
            order: 0,
            motion_rows: rows_by_node(d.motion.outputs, structure.motion),
            report_rows: rows_by_node(d.report.outputs, structure.report),
        })
    }

    /// Takes the numbers of a system's parameters.
    pub(super) fn renew(&mut self, system: &dyn ErasedSystem<T>, held: &Held) {
        self.admitted = system.mode_constants(self.index, held, &self.signs, &mut self.constants);
    }

    /// Whether the parameters allow the functions.
    #[inline]
    pub(super) fn is_admitted(&self) -> bool {
        self.admitted
    }

    /// Whether the functions hold at a state: what the mode pins is where it is pinned, and at rest.
    pub(super) fn holds_at(&self, q: &[T], v: &[T]) -> bool {
        let mut pins = self.structure.pins.iter();
        pins.all(|&(j, place)| {
            let at = match place {
                Place::Constant(i) => self.constants[i],
                Place::Zero | Place::Node(_) => T::default(),
            };
            let allowed = 16.0 * epsilon::<T>() * at.value().abs().max(1.0);
            v[j].is_zero() && (q[j] - at).value().abs() <= allowed
        })
    }

    /// Accelerations, and forces if asked for. False if a pivot is not safe.
    #[inline]
    pub(super) fn value(
        &self,
        held: &Held,
        state: Arguments<T>,
        accelerations: &mut [T],
        forces: Option<&mut [T]>,
    ) -> bool {
        (self.equations.value)(&self.constants, held, state, accelerations, forces)
    }

    /// Coefficients 0…`order` of all rows.
    #[inline]
    pub(super) fn series(
        &mut self,
        held: &Held,
        order: usize,
        state: Arguments<T>,
    ) -> Result<(), Refused> {
        self.order = order;
        (self.equations.series)(&self.constants, held, order, state, &mut self.rows)
    }

    fn row(&self, index: usize) -> &[T] {
        self.rows.get(index).map_or(&[], |row| &row[..=self.order])
    }

    /// Coefficients of t, q, v, v̇ (none) or λ, by their index in the inputs of the report tape.
    pub(super) fn input_series(&self, d: &Description, index: usize) -> &[T] {
        let n = d.coordinates.len();
        match index {
            i if (1..=2 * n).contains(&i) => self.row(i - 1),
            i if i > 3 * n => self.row(i - 1 - n),
            _ => &[],
        }
    }

    /// Coefficients of an output of the motion tape; zeros if they are not given.
    pub(super) fn motion_series(&self, d: &Description, node: usize) -> &[T] {
        self.series_of(d, self.motion_rows[node])
    }

    /// Coefficients of an output of the report tape; zeros if they are not given.
    pub(super) fn report_series(&self, d: &Description, node: usize) -> &[T] {
        self.series_of(d, self.report_rows[node])
    }

    fn series_of(&self, d: &Description, row: u32) -> &[T] {
        match row {
            NO_ROW => self.zero_series(d),
            row => self.row(row as usize),
        }
    }

    /// Coefficients of zero.
    pub(super) fn zero_series(&self, d: &Description) -> &[T] {
        self.row(2 * d.coordinates.len() + d.rows.len())
    }
}
