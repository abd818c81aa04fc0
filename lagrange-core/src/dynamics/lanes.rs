//! Taylor series by the functions of a mode, of several motions at once: each in a lane of its own, bit for bit as alone.

use super::Dynamics;
use super::emitted::Emitted;
use crate::arithmetic::{Pack, Scalar};
use crate::equations::{LANES, LaneSeriesFn, ModeStructure, Products, ROW, Row};
use crate::system::Selection;

/// A motion at the start of a step.
#[derive(Debug)]
pub(crate) struct Start<'a, T: Scalar> {
    pub(crate) dynamics: &'a mut Dynamics<T>,
    pub(crate) t: T,
    pub(crate) q: &'a [T],
    pub(crate) v: &'a [T],
    /// Whether its series is there.
    pub(crate) expanded: bool,
}

/// The series of all modes for numbers side by side, and memory for one call of them.
#[derive(Debug)]
pub(crate) struct Lanes<T: Scalar> {
    series: &'static [LaneSeriesFn<T>],
    constants: Vec<Pack<T, LANES>>,
    positions: Vec<Pack<T, LANES>>,
    velocities: Vec<Pack<T, LANES>>,
    /// Of each mode: what its functions do not write stays zero.
    rows: Vec<Vec<Row<Pack<T, LANES>>>>,
    products: Vec<Products<Pack<T, LANES>>>,
    /// (mode, motion)
    members: Vec<(usize, usize)>,
}

impl<T: Scalar> Lanes<T> {
    /// For a system with these series.
    pub(crate) fn new(series: &'static [LaneSeriesFn<T>]) -> Self {
        Self {
            series,
            constants: Vec::new(),
            positions: Vec::new(),
            velocities: Vec::new(),
            rows: vec![Vec::new(); series.len()],
            products: Vec::new(),
            members: Vec::new(),
        }
    }

    /// Expands up to `order` what can be expanded together: motions in the same mode, of which the same is asked.
    pub(crate) fn expand(&mut self, starts: &mut [Start<'_, T>], order: usize) {
        let mut members = core::mem::take(&mut self.members);
        members.clear();
        for (motion, start) in starts.iter_mut().enumerate() {
            if let Some(mode) = start.dynamics.mode_of_functions(start.q, start.v) {
                members.push((mode, motion));
            }
        }
        members.sort_unstable();
        for same in members.chunk_by(|a, b| a.0 == b.0) {
            for group in same.chunks(LANES).filter(|group| group.len() > 1) {
                self.run(group, starts, order);
            }
        }
        self.members = members;
    }

    /// Expands one group. Lanes that are left over repeat the last motion.
    fn run(&mut self, group: &[(usize, usize)], starts: &mut [Start<'_, T>], order: usize) {
        let lanes: [&Start<'_, T>; LANES] =
            core::array::from_fn(|lane| &starts[group[lane.min(group.len() - 1)].1]);
        let functions = lanes.map(|start| start.dynamics.functions_of_series());
        let Some((_, held)) = functions[0] else {
            return;
        };
        let alike = functions
            .iter()
            .flatten()
            .all(|(_, other)| *other.needs == *held.needs && other.branches == held.branches);
        if !alike {
            return;
        }
        let constants =
            functions.map(|one| one.map_or(&[][..], |(emitted, _)| emitted.constants()));
        side_by_side(&mut self.constants, constants);
        side_by_side(&mut self.positions, lanes.map(|start| start.q));
        side_by_side(&mut self.velocities, lanes.map(|start| start.v));
        let time = Pack(lanes.map(|start| start.t));
        let mode = group[0].0;
        let zero = Pack([T::default(); LANES]);
        let structure = lanes[0].dynamics.structure_of(mode);
        let (rows, products) = (&mut self.rows[mode], &mut self.products);
        rows.resize(structure.rows, [zero; ROW]);
        if products.len() < structure.products {
            products.resize(structure.products, Products::default());
        }
        let state = (time, &self.positions[..], &self.velocities[..]);
        let series = self.series[mode];
        // What one of them cannot do, each finds out alone.
        if series(&self.constants, &held, order, state, rows, products).is_err() {
            return;
        }
        for (lane, &(_, motion)) in group.iter().enumerate() {
            starts[motion].dynamics.take_lane(rows, lane, order);
            starts[motion].expanded = true;
        }
    }
}

/// Numbers of several motions as packs.
fn side_by_side<T: Scalar>(packs: &mut Vec<Pack<T, LANES>>, lanes: [&[T]; LANES]) {
    packs.clear();
    let count = lanes.iter().map(|lane| lane.len()).min().unwrap_or(0);
    packs.extend((0..count).map(|i| Pack(lanes.map(|lane| lane[i]))));
}

impl<T: Scalar> Dynamics<T> {
    /// The mode, among those whose functions have been emitted, whose functions hold at a state.
    fn mode_of_functions(&mut self, q: &[T], v: &[T]) -> Option<usize> {
        let chosen = self.choose(q, v);
        let functions = self.functions().filter(|_| chosen);
        functions.map(Emitted::index)
    }

    /// The functions of the mode, and what they are told for a series.
    fn functions_of_series(&self) -> Option<(&Emitted<T>, Selection<'_>)> {
        self.compiled().emitted(&self.series_held)
    }

    /// Where the numbers of a mode are whose functions have been emitted.
    fn structure_of(&self, mode: usize) -> &'static ModeStructure {
        &self.system.structures()[mode]
    }

    /// Takes a series that was expanded together with others.
    fn take_lane(&mut self, rows: &[Row<Pack<T, LANES>>], lane: usize, order: usize) {
        self.work.series += 1;
        self.work.coefficients += order + 1;
        self.series_by_functions = true;
        if let Some((emitted, _)) = self.modes[self.current].emitted_mut(&self.series_held) {
            emitted.take_lane(rows, lane, order);
        }
    }
}
