//! Many runs of one system, several at a time.

use super::Runner;
use crate::dynamics::Packets;
use crate::error::Error;
use crate::precompiled::Runnable;
use crate::settings::{Goal, Settings};
use crate::system::System;
use crate::trajectory::{State, Trajectory};
use core::ops::Range;

/// Runs under way at a time: as many as a packet takes. More would find more company in their mode, but all that they work with would
/// no longer stay in the cache, which costs more.
const MAX_IN_FLIGHT: usize = 4;

/// Runs many motions of one system, with other parameters or from other states, several at a time. Where its equations are interpreted,
/// the Taylor series of those in the same mode share the instructions of the processor (SIMD), each in a lane of its own. A motion comes
/// out, bit for bit, as it would alone; which others run beside it does not matter.
///
/// Made by [`Simulation::ensemble`](crate::Simulation::ensemble).
///
/// ```
/// use lagrange_core::prelude::*;
///
/// #[derive(Lagrangian, Clone, Debug)]
/// #[lagrange(
///     coordinates(theta),
///     kinetic = length^2 * der(theta)^2 / 2,
///     potential = -gravity * length * cos(theta),
///     start(tilted: theta = 1),
/// )]
/// struct Pendulum<T = f64> {
///     length: T,
///     gravity: T,
/// }
///
/// let mut pendulum: Pendulum = Pendulum { length: 1.0, gravity: 9.81 };
/// let mut angles = vec![0.0; 100];
/// Simulation::new(&pendulum.clone()).ensemble().run(
///     angles.len(),
///     0.0..2.0,
///     |index, runner| {
///         pendulum.length = 1.0 + 0.01 * index as f64;
///         runner.set_scene(&pendulum);
///         Some(pendulum.at(<Pendulum>::TILTED))
///     },
///     |index, outcome, trajectory| {
///         outcome.expect("runs");
///         angles[index] = trajectory.final_state().q[0];
///     },
/// );
/// // Alone:
/// let end = Simulation::new(&pendulum).run(pendulum.at(<Pendulum>::TILTED), 0.0..2.0).expect("runs");
/// assert_eq!(angles[99], end.final_state().q[0]);
/// ```
#[derive(Debug)]
pub struct Ensemble<S: System> {
    scene: S,
    settings: Settings,
    runners: Vec<Runner<S>>,
    packets: Packets<S::Scalar>,
}

impl<S: System<Scalar: Runnable>> Ensemble<S> {
    pub(crate) fn new(scene: &S, settings: &Settings) -> Self {
        Self {
            scene: scene.copy(),
            settings: settings.clone(),
            runners: Vec::new(),
            packets: Packets::new(),
        }
    }

    /// Makes `count` runs over `span` (s). `prepare` makes a runner ready for run number `index` and tells its start, or `None`
    /// to leave it out; `take` is told how it ended, with its trajectory, in the order in which runs end.
    pub fn run(
        &mut self,
        count: usize,
        span: Range<f64>,
        mut prepare: impl FnMut(usize, &mut Runner<S>) -> Option<State<S::Scalar>>,
        mut take: impl FnMut(usize, Result<(), Error>, &Trajectory<S::Scalar>),
    ) {
        while self.runners.len() < count.min(MAX_IN_FLIGHT) {
            self.runners.push(Runner::new(&self.scene, &self.settings));
        }
        let mut coming = 0..count;
        // Which run each runner makes.
        let mut under_way: Vec<Option<usize>> = vec![None; self.runners.len()];
        loop {
            for (runner, under_way) in self.runners.iter_mut().zip(&mut under_way) {
                while under_way.is_none()
                    && let Some(index) = coming.next()
                {
                    let Some(start) = prepare(index, runner) else {
                        continue;
                    };
                    if self.settings.goal != Goal::Tolerance {
                        // A run is then several, one after the other.
                        let outcome = runner.run(&start, span.clone()).map(drop);
                        take(index, outcome, runner.trajectory());
                        continue;
                    }
                    match runner.launch(&start, span.clone()) {
                        Ok(()) if runner.goes_on() => *under_way = Some(index),
                        outcome => take(index, outcome, runner.land()),
                    }
                }
            }
            let runners = self.runners.iter_mut().zip(&under_way);
            let taken = runners.filter(|(_, under_way)| under_way.is_some());
            let mut members: Vec<_> = taken.map(|(runner, _)| runner.member()).collect();
            if members.is_empty() {
                return;
            }
            (S::Scalar::functions().go_on)(&mut self.packets, &mut members);
            let outcomes: Vec<_> = members.into_iter().map(|m| m.outcome).collect();
            let mut outcomes = outcomes.into_iter();
            for (runner, under_way) in self.runners.iter_mut().zip(&mut under_way) {
                if let Some(index) = *under_way
                    && let Some(outcome) = outcomes.next().flatten()
                {
                    *under_way = None;
                    take(index, outcome, runner.land());
                }
            }
        }
    }
}
