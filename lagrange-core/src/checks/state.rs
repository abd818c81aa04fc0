//! Random states on the constraint surface of a mode, with accelerations and forces.

use crate::dynamics::{Dynamics, EvaluationError};
use crate::effects::Effects;
use crate::error::Error;
use crate::handle::{ContactId, FrictionId, named, named_mut};
use crate::mode::{FrictionMode, Mode, Sliding};
use crate::modes::guard;
use crate::modes::redundant::RedundantForces;
use crate::system::{Normal, System};
use crate::trajectory::{Instant, State, instant, report_everything};
use core::borrow::Borrow;
use core::ops::Range;

/// Where formulas are compared: a mode, and how its states and their times are drawn.
///
/// Contacts that are not closed are open, and frictions that are not said to stick or slip do not act. What is drawn depends on the
/// [seed](Self::seed) alone, so that a check that passes once passes always.
#[derive(Clone, Debug)]
pub struct Checks<'a, S: System<Scalar = f64>> {
    pub(super) scene: &'a S,
    pub(super) mode: Mode,
    slipping: Vec<usize>,
    around: State<f64>,
    spread: f64,
    times: Range<f64>,
    variation: f64,
    seed: u64,
    pub(super) states: usize,
    pub(super) tolerance: f64,
}

impl<'a, S: System<Scalar = f64>> Checks<'a, S> {
    /// 100 states around zero with a spread of 1, at times from 0 to 1 s, all contacts open, tolerance 1e-9.
    pub fn new(scene: &'a S) -> Self {
        let d = scene.description();
        let n = d.coordinates.len();
        Self {
            scene,
            mode: Mode::open(d),
            slipping: Vec::new(),
            around: State::new(vec![0.0; n], vec![0.0; n]),
            spread: 1.0,
            times: 0.0..1.0,
            variation: 0.0,
            seed: 1,
            states: 100,
            tolerance: 1e-9,
        }
    }

    /// In a mode where this contact is closed.
    #[must_use]
    #[track_caller]
    pub fn closed(mut self, contact: ContactId) -> Self {
        *named_mut(&mut self.mode.contacts, contact.0, "contact") = true;
        self
    }

    /// In a mode where this friction sticks (and its contact is closed).
    #[must_use]
    #[track_caller]
    pub fn sticks(mut self, friction: FrictionId) -> Self {
        *named_mut(&mut self.mode.frictions, friction.0, "friction") = FrictionMode::Stick;
        self.close_under(friction)
    }

    /// In modes where this friction slips, to the side that the state has (and its contact is closed).
    #[must_use]
    #[track_caller]
    pub fn slips(mut self, friction: FrictionId) -> Self {
        self.slipping.push(friction.0);
        self.close_under(friction)
    }

    #[track_caller]
    fn close_under(mut self, friction: FrictionId) -> Self {
        let d = self.scene.description();
        let friction = named(d.frictions, friction.0, "friction");
        if let Some(contact) = friction.normal.contact(d) {
            self.mode.contacts[contact] = true;
        }
        self
    }

    /// Draws states around this one (before they are moved onto the constraints).
    #[must_use]
    pub fn around(mut self, state: impl Borrow<State<f64>>) -> Self {
        self.around.clone_from(state.borrow());
        self
    }

    /// How far positions and velocities lie from the middle at most, in their own units.
    #[must_use]
    pub fn spread(mut self, spread: f64) -> Self {
        self.spread = spread;
        self
    }

    /// Draws the time of every state from this range, s; `2.0..2.0` is one instant. Where what drives the system changes later than
    /// in the first second, say so: a formula is only held against what it is there.
    #[must_use]
    pub fn times(mut self, times: Range<f64>) -> Self {
        self.times = times;
        self
    }

    /// Multiplies every parameter by a random factor between 1 − share and 1 + share.
    #[must_use]
    pub fn vary_parameters(mut self, share: f64) -> Self {
        self.variation = share;
        self
    }

    /// Seed of the random numbers.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Number of states.
    #[must_use]
    pub fn states(mut self, states: usize) -> Self {
        self.states = states;
        self
    }

    /// Largest difference that counts as rounding, relative to the larger side, or to 1 where both are smaller.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The state of a number, if there is one.
    pub(super) fn draw(&self, number: usize) -> Result<(S, Instant<f64>), Error> {
        let d = self.scene.description();
        // A sequence of its own for every state.
        let seed = self.seed ^ (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut random = fastrand::Rng::with_seed(seed);
        let mut scene = self.scene.copy();
        for index in 0..d.parameters.len() {
            let factor = 1.0 + self.variation * signed(&mut random);
            scene.set_parameter(index, self.scene.parameter(index) * factor);
        }
        let mut near = |center: &[f64]| -> Vec<f64> {
            let moved = center.iter();
            moved
                .map(|x| x + self.spread * signed(&mut random))
                .collect()
        };
        let (mut q, mut v) = (near(&self.around.q), near(&self.around.v));
        let Range { start, end } = self.times;
        let time = start + (end - start) * random.f64();
        let mut dynamics = Dynamics::new(&scene, &Effects::all());
        report_everything(&mut dynamics);
        dynamics.set_mode(&self.mode);
        let outcome = dynamics.project(time, &mut q, &mut v, 0.0);
        outcome.map_err(|e| Error::from_evaluation(e, time, &self.mode, d))?;
        let state = State::new(q, v);
        let mut mode = self.mode.clone();
        let outcome = self.settle(&mut dynamics, time, &state, &mut mode);
        outcome.map_err(|e| Error::from_evaluation(e, time, &mode, d))?;
        let now = instant(&mut dynamics, &mut RedundantForces::default(), time, &state);
        let now = now.map_err(|e| Error::from_evaluation(e, time, &mode, d))?;
        Ok((scene, now))
    }

    /// Lets slips and branches go with the state; the force of a constraint only shows when it has been solved for.
    fn settle(
        &self,
        dynamics: &mut Dynamics<f64>,
        time: f64,
        state: &State<f64>,
        mode: &mut Mode,
    ) -> Result<(), EvaluationError> {
        let d = dynamics.description();
        for round in 0..2 + d.branches.len() {
            let needs = guard::all_row_needs(d, dynamics.motion_needs());
            dynamics.set_extra_needs(&needs);
            dynamics.value(time, &state.q, &state.v)?;
            let before = mode.clone();
            for &f in &self.slipping {
                mode.frictions[f] = FrictionMode::Slip(sliding(dynamics, f));
            }
            for (b, branch) in d.branches.iter().enumerate() {
                if !branch.after_solve {
                    mode.set_branch(b, dynamics.motion(branch.guard) >= 0.0);
                }
            }
            if *mode == before && round > 0 {
                break;
            }
            dynamics.set_mode(mode);
        }
        dynamics.value_along(time, &state.q, &state.v)
    }
}

/// How friction `f` slides at the last value.
fn sliding(dynamics: &Dynamics<f64>, f: usize) -> Sliding {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    let mut sliding = match friction.components {
        1 => {
            let slip = dynamics.motion(d.rows[friction.row].velocity);
            Sliding::sign(if slip < 0.0 { -1.0 } else { 1.0 })
        }
        _ => Sliding::along_slip(),
    };
    if let Normal::Constraint(c) = friction.normal
        && dynamics.force(d.constraints[c].row) < 0.0
    {
        sliding.normal_sign = -1.0;
    }
    sliding
}

/// Between −1 and 1.
pub(crate) fn signed(random: &mut fastrand::Rng) -> f64 {
    2.0 * random.f64() - 1.0
}
