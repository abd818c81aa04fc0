//! Smooth scenes: one mode, no events; compared is the state at the end.

use crate::crates::Peer;
use crate::hand;
use crate::references as exact;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::{
    CartesianPendulum, DoublePendulum, FiveLinkChain, Kepler, StiffSpringPendulum,
};
use std::f64::consts::PI;

/// A scene that both sides can run.
pub trait Scene: 'static {
    /// Its name in the table.
    const NAME: &'static str;
    /// What is compared, exactly.
    const REFERENCE: &'static [f64];

    /// Longest run, s.
    const UNTIL: f64;
    /// What declares it.
    type Declared: System<Scalar = f64> + Default + 'static;

    /// What is compared, in a run of the declaration: positions, then velocities, at the end of a run without events.
    fn seen(trajectory: &Trajectory) -> Option<Vec<f64>> {
        let end = trajectory.final_state();
        trajectory
            .events()
            .is_empty()
            .then(|| [&end.q[..], &end.v].concat())
    }

    /// By hand-reduced equations in another integrator.
    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>>;
}

/// The double pendulum.
pub struct Double;

impl Scene for Double {
    const NAME: &'static str = "double pendulum, 5 s";
    const REFERENCE: &'static [f64] = &exact::DOUBLE_PENDULUM;
    const UNTIL: f64 = 5.0;
    type Declared = DoublePendulum;

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let start = [2.0, 2.5, 0.0, 0.0];
        let end = peer.until(hand::double_pendulum, start, 0.0..5.0, tolerance)?;
        Some(end.into())
    }
}

/// The chain of five links.
pub struct FiveLinks;

impl Scene for FiveLinks {
    const NAME: &'static str = "chain of 5 links, 2 s";
    const REFERENCE: &'static [f64] = &exact::CHAIN;
    const UNTIL: f64 = 2.0;
    type Declared = FiveLinkChain;

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let start = [0.5, 0.7, 0.9, 1.1, 1.3, 0.0, 0.0, 0.0, 0.0, 0.0];
        let end = peer.until(hand::chain, start, 0.0..2.0, tolerance)?;
        Some(end.into())
    }
}

/// The pendulum in Cartesian coordinates; by hand, its constraint differentiated twice and never projected onto.
pub struct Rod;

impl Scene for Rod {
    const NAME: &'static str = "Cartesian pendulum, 100 s";
    const REFERENCE: &'static [f64] = &exact::CARTESIAN_PENDULUM;
    const UNTIL: f64 = 100.0;
    type Declared = CartesianPendulum;

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let start = [1.0, 0.0, 0.0, 0.0];
        let end = peer.until(hand::cartesian_pendulum, start, 0.0..100.0, tolerance)?;
        Some(end.into())
    }
}

/// Kepler's problem.
pub struct Orbit;

impl Scene for Orbit {
    const NAME: &'static str = "Kepler e = 0.9, 100 orbits";
    const REFERENCE: &'static [f64] = &exact::KEPLER;
    const UNTIL: f64 = 200.0 * PI;
    type Declared = Kepler;

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let start = [0.1, 0.0, 0.0, 19f64.sqrt()];
        let end = peer.until(hand::kepler, start, 0.0..200.0 * PI, tolerance)?;
        Some(end.into())
    }
}

/// The stiff spring pendulum.
pub struct Spring;

impl Scene for Spring {
    const NAME: &'static str = "stiff spring pendulum, 10 s";
    const REFERENCE: &'static [f64] = &exact::SPRING_PENDULUM;
    const UNTIL: f64 = 10.0;
    type Declared = StiffSpringPendulum;

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let start = [1.0, 1.0, 0.0, 0.0];
        let end = peer.until(hand::spring_pendulum, start, 0.0..10.0, tolerance)?;
        Some(end.into())
    }
}
