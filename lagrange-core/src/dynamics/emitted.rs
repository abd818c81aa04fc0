//! One mode's functions with the memory that they work in.

use crate::arithmetic::{Scalar, epsilon};
use crate::effects::{Effects, Item};
use crate::equations::{
    Arguments, Factors, FrictionState, ModeStructure, ROW, Refused, Row, STRIDE, SeriesFn, Turn,
    ValueFn,
};
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Description, ErasedSystem, Selection, ValueRef};

/// A series that is always zero.
const NO_ROW: u32 = u32::MAX;

/// The emitted equations of a mode.
#[derive(Clone, Debug)]
pub(super) struct Emitted<T: Scalar> {
    index: usize,
    structure: &'static ModeStructure,
    value: ValueFn<T>,
    series: SeriesFn<T>,
    constants: Vec<T>,
    /// Per friction: sign of its slip, and of the multiplier that presses.
    signs: Vec<T>,
    /// Whether the parameters allow the pivots that were chosen at build time.
    admitted: bool,
    rows: Vec<Row<T>>,
    /// Factors of products of series.
    products: Vec<Factors<T>>,
    order: usize,
    /// What the last value that was asked for more than accelerations has given: see [`ModeStructure::values`].
    values: Vec<T>,
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
    /// The equations of a mode, if they have been emitted.
    pub(super) fn of(system: &dyn ErasedSystem<T>, effects: &Effects, mode: &Mode) -> Option<Self> {
        let d = system.description();
        let mut missing = effects.left_out().filter_map(|item| match item {
            Item::Constraint(i) => {
                let contact = d.constraints.get(i)?.while_contact;
                contact
                    .is_none_or(|contact| mode.contacts[contact])
                    .then_some(i)
            }
            _ => None,
        });
        let left_out = missing.next();
        if missing.next().is_some() {
            return None;
        }
        let structures = system.structures().iter().enumerate();
        let mut matching =
            structures.filter(|(_, s)| s.contacts == mode.contacts && s.left_out == left_out);
        let (index, structure, signs) =
            matching.find_map(|(index, s)| Some((index, s, signs(s, mode)?)))?;
        let zero = T::default();
        Some(Self {
            index,
            structure,
            value: *system.mode_values().get(index)?,
            series: *system.mode_series().get(index)?,
            constants: vec![zero; structure.constants],
            signs,
            admitted: false,
            rows: vec![[zero; ROW]; structure.rows],
            products: vec![Factors::none(); STRIDE * structure.products],
            order: 0,
            values: vec![zero; structure.values],
            motion_rows: rows_by_node(d.motion.outputs, structure.motion),
            report_rows: rows_by_node(d.report.outputs, structure.report),
        })
    }

    /// Takes the numbers of a system's parameters.
    pub(super) fn renew(&mut self, system: &dyn ErasedSystem<T>, held: &Selection) {
        self.admitted = system.mode_constants(self.index, held, &self.signs, &mut self.constants);
    }

    /// Whether the parameters allow the functions.
    #[inline]
    pub(super) fn is_admitted(&self) -> bool {
        self.admitted
    }

    /// Whether values give what a projection takes.
    #[inline]
    pub(super) fn gives_rows(&self) -> bool {
        self.structure.gives_rows
    }

    /// Whether the functions hold at a state: what the mode pins is where it is pinned, and at rest.
    pub(super) fn holds_at(&self, q: &[T], v: &[T]) -> bool {
        let mut pins = self.structure.pins.iter();
        pins.all(|&(j, place)| {
            let at = match place {
                ValueRef::Constant(i) => self.constants[i],
                ValueRef::Zero | ValueRef::Node(_) => T::default(),
            };
            let allowed = 16.0 * epsilon::<T>() * at.value().abs().max(1.0);
            v[j].is_zero() && (q[j] - at).value().abs() <= allowed
        })
    }

    /// Accelerations. False if a pivot is not safe.
    #[inline]
    pub(super) fn accelerations(
        &self,
        held: &Selection,
        state: Arguments<T>,
        out: &mut [T],
        turns: &mut [Turn<T>],
    ) -> bool {
        (self.value)(&self.constants, held, state, out, None, turns)
    }

    /// Accelerations, forces, and what `held` asks for. False if a pivot is not safe.
    #[inline]
    pub(super) fn value(
        &mut self,
        held: &Selection,
        state: Arguments<T>,
        accelerations: &mut [T],
        turns: &mut [Turn<T>],
    ) -> bool {
        let values = Some(&mut self.values[..]);
        (self.value)(&self.constants, held, state, accelerations, values, turns)
    }

    /// The forces of all rows at the last [value](Self::value).
    #[inline]
    pub(super) fn forces(&self, d: &Description) -> &[T] {
        &self.values[2 * d.coordinates.len()..][..d.rows.len()]
    }

    /// The change of the velocities that takes them onto the rows that act, at the last [value](Self::value); empty if it is not given.
    #[inline]
    pub(super) fn velocity_changes(&self) -> &[T] {
        &self.values[self.structure.rows..]
    }

    /// What guards read of the motion program and of the report at the last [value](Self::value).
    #[inline]
    pub(super) fn take_outputs(&self, motion: &mut [T], report: &mut [T]) {
        let lists = [
            (self.structure.motion, motion),
            (self.structure.report, report),
        ];
        for (list, nodes) in lists {
            for &(node, row) in list {
                nodes[node] = self.values[row];
            }
        }
    }

    /// Coefficients 0…`order` of all rows.
    #[inline]
    pub(super) fn series(
        &mut self,
        held: &Selection,
        order: usize,
        state: Arguments<T>,
        turns: &mut [Turn<T>],
    ) -> Result<(), Refused> {
        self.order = order;
        let memory = (&mut self.rows[..], &mut self.products[..], turns);
        (self.series)(&self.constants, held, order, state, memory)
    }

    #[inline(always)]
    fn row(&self, index: usize) -> &[T] {
        self.rows.get(index).map_or(&[], |row| &row[..=self.order])
    }

    /// Coefficients of the positions and velocities of `n` coordinates.
    #[inline(always)]
    pub(super) fn state_series(&self, n: usize) -> &[Row<T>] {
        self.rows.get(..2 * n).unwrap_or_default()
    }

    /// Coefficients of t, q, v, v̇ (none) or λ, by their index in the inputs of the report tape.
    #[inline(always)]
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

/// Whether all numbers are finite.
#[inline]
pub(super) fn is_finite<T: Scalar>(numbers: &[T]) -> bool {
    numbers.iter().all(|x| x.value().is_finite())
}
