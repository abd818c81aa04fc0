//! Taylor series of several motions at once.
//!
//! Motions in the same mode run the same list of operations on other numbers. A packet takes some of them through the list side by
//! side, with one instruction of the processor for all, so that each gets, bit for bit, what it would get alone. Where the processor has no registers of
//! four numbers, or the scalar is another one than `f64`, each goes alone.

use super::Dynamics;
use super::shape::{Extent, Shape};
use crate::arithmetic::registers::{self, Body, Registers};
use crate::arithmetic::{Pack, Scalar};
use crate::program::Series;
use std::sync::Arc;

/// Motions in a packet.
const LANES: usize = 4;

type Lanes<T> = Pack<T, LANES>;

/// The motions of a mode side by side.
#[derive(Debug)]
struct Packet<T> {
    shape: Arc<Shape>,
    registers: Vec<Lanes<T>>,
    series: Series<Lanes<T>>,
    /// Right-hand sides of the equations, and those of one motion.
    right: Vec<Lanes<T>>,
    side: Vec<T>,
}

/// Packets by what runs in them.
#[derive(Debug)]
pub(crate) struct Packets<T> {
    known: Vec<Packet<T>>,
    /// (packet, motion)
    members: Vec<(usize, usize)>,
}

impl<T: Scalar> Packets<T> {
    /// None yet.
    pub(crate) fn new() -> Self {
        Self {
            known: Vec::new(),
            members: Vec::new(),
        }
    }

    /// Completes the series, up to `order`, of motions that have [begun](Dynamics::begin_series) one.
    pub(crate) fn expand(&mut self, waiting: &mut [&mut Dynamics<T>], order: usize) {
        let mut members = core::mem::take(&mut self.members);
        members.clear();
        for (motion, dynamics) in waiting.iter_mut().enumerate() {
            members.push((self.packet_of(dynamics.shape_mut()), motion));
        }
        members.sort_unstable();
        for same in members.chunk_by(|a, b| a.0 == b.0) {
            for group in same.chunks(LANES) {
                let together = group.len() > 1 && self.run(group, waiting, order);
                if !together {
                    let alone = group.iter();
                    alone.for_each(|&(_, motion)| waiting[motion].end_series(order));
                }
            }
        }
        self.members = members;
    }

    /// The packet in which a motion with this shape runs. Equal shapes become the same one.
    fn packet_of(&mut self, shape: &mut Arc<Shape>) -> usize {
        let same = |packet: &Packet<T>| Arc::ptr_eq(&packet.shape, shape);
        if let Some(found) = self.known.iter().position(same) {
            return found;
        }
        if let Some(found) = self.known.iter().position(|p| p.shape == *shape) {
            shape.clone_from(&self.known[found].shape);
            return found;
        }
        self.known.push(Packet {
            registers: vec![Pack([T::zero(); LANES]); shape.registers],
            series: shape.series(),
            right: Vec::new(),
            side: Vec::new(),
            shape: shape.clone(),
        });
        self.known.len() - 1
    }

    /// Expands one group, unless the processor cannot. Places that are left over repeat the last motion.
    fn run(
        &mut self,
        group: &[(usize, usize)],
        waiting: &mut [&mut Dynamics<T>],
        order: usize,
    ) -> bool {
        // It is a constant, and so nothing of this is compiled for numbers with derivatives: it would be most of what they cost the compiler.
        if const { size_of::<T>() != size_of::<f64>() } {
            return false;
        }
        let motions: [usize; LANES] =
            core::array::from_fn(|lane| group[lane.min(group.len() - 1)].1);
        let Packet {
            shape,
            registers,
            series,
            right,
            side,
        } = &mut self.known[group[0].0];
        let lanes = motions.map(|motion| waiting[motion].registers());
        for (index, pack) in registers[..shape.used].iter_mut().enumerate() {
            *pack = Pack(lanes.map(|lane| lane[index]));
        }
        let solve = |_: usize, now: &mut [Lanes<T>], first: &[Lanes<T>], earlier: &[Lanes<T>]| {
            shape.right_hand_sides(now, first, earlier, right);
            for (lane, &motion) in motions.iter().enumerate() {
                side.clear();
                side.extend(right.iter().map(|pack| pack.0[lane]));
                waiting[motion].solve(side);
                for (register, &x) in shape.unknowns.iter().zip(&*side) {
                    now[register.index()].0[lane] = x;
                }
            }
        };
        let side_by_side = SideBySide {
            series: &mut *series,
            shape,
            registers,
            order,
            solve,
        };
        if registers::across::<Expansion, _>(side_by_side).is_err() {
            return false;
        }
        for (lane, &(_, motion)) in group.iter().enumerate() {
            waiting[motion].take_series(series, lane, order);
        }
        true
    }
}

/// The series of some motions, which are solved by `F`.
struct SideBySide<'a, T, F> {
    series: &'a mut Series<Lanes<T>>,
    shape: &'a Shape,
    registers: &'a mut [Lanes<T>],
    order: usize,
    solve: F,
}

/// Their expansion.
struct Expansion;

impl<T, F> Body<SideBySide<'_, T, F>> for Expansion
where
    T: Scalar,
    F: FnMut(usize, &mut [Lanes<T>], &[Lanes<T>], &[Lanes<T>]),
{
    type Output = ();

    #[inline(always)]
    fn run(_: Registers, motions: SideBySide<'_, T, F>) {
        motions.series.run(
            motions.shape.program(Extent::Series),
            motions.registers,
            motions.order,
            &motions.shape.integrals,
            motions.solve,
        );
    }
}
