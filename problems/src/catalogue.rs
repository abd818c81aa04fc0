//! All scenes that the program knows. A new scene is one line in [`SCENES`].

use crate::outcome::Outcome;
use crate::request::{Refusal, Request};
use crate::scenes::*;
use core::f64::consts::PI;
use core::marker::PhantomData;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// Every scene, in the order of `lagrange list`.
pub static SCENES: &[&dyn Scene] = &[
    &Entry::<MassOnShell>::new("mass-on-shell", 20.0),
    &Entry::<RollingSphere>::new("rolling-sphere", 20.0),
    &Entry::<RollingSlippingSphere>::new("rolling-slipping-sphere", 20.0),
    &Entry::<MassOnWheel>::new("mass-on-wheel", 20.0),
    &Entry::<SphereInBowl>::new("sphere-in-bowl", 10.0),
    &Entry::<DoublePendulum>::new("double-pendulum", 5.0),
    &Entry::<FiveLinkChain>::new("five-link-chain", 2.0),
    &Entry::<CartesianPendulum>::new("cartesian-pendulum", 100.0),
    &Entry::<Kepler>::new("kepler", 200.0 * PI),
    &Entry::<StiffSpringPendulum>::new("stiff-spring-pendulum", 10.0),
];

/// A scene whose type has been forgotten: what the program can do with it.
pub trait Scene: Sync {
    /// Name on the command line.
    fn name(&self) -> &'static str;

    /// Time at which a run ends if nothing ends it before, s.
    fn until(&self) -> f64;

    /// Names, documentation and structure.
    fn description(&self) -> &'static Description;

    /// Default value of every parameter, in the order of the description.
    fn defaults(&self) -> Vec<f64>;

    /// Runs it. A run that fails half-way is an [`Outcome`] with a failure in it; only a request that makes no
    /// sense, or a start that does not exist, is refused.
    fn run(&self, request: &Request) -> Result<Outcome, Refusal>;

    /// First sentence of the documentation.
    fn summary(&self) -> &'static str {
        let text = self.description().documentation.trim();
        text.lines().next().unwrap_or_default().trim()
    }
}

/// A scene of type `S`.
pub struct Entry<S> {
    name: &'static str,
    until: f64,
    system: PhantomData<fn() -> S>,
}

impl<S> Entry<S> {
    /// A scene called `name` that runs for `until` seconds unless asked otherwise.
    pub const fn new(name: &'static str, until: f64) -> Self {
        Self {
            name,
            until,
            system: PhantomData,
        }
    }
}

impl<S: System<Scalar = f64> + Default> Scene for Entry<S> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn until(&self) -> f64 {
        self.until
    }

    fn description(&self) -> &'static Description {
        S::DESCRIPTION
    }

    fn defaults(&self) -> Vec<f64> {
        let system = S::default();
        (0..S::DESCRIPTION.parameters.len())
            .map(|i| system.parameter(i))
            .collect()
    }

    fn run(&self, request: &Request) -> Result<Outcome, Refusal> {
        let mut system = S::default();
        for (name, value) in &request.parameters {
            system.set_parameter(request.parameter(S::DESCRIPTION, name)?, *value);
        }
        let simulation = Simulation::new(&system)
            .tolerance(request.tolerance)
            .method(request.method)
            .project_start(request.project);
        let start = request.start(&system, &simulation)?;
        let until = request.until.unwrap_or(self.until);
        let (trajectory, failure) = match simulation.run(start, 0.0..until) {
            Ok(trajectory) => (trajectory, None),
            Err(stopped) => (*stopped.trajectory, Some(stopped.error)),
        };
        Ok(Outcome::new(
            self.name,
            &system,
            &trajectory,
            failure,
            request.samples,
        ))
    }
}

/// The scene called `name`, or a refusal that names the nearest one.
pub fn find(name: &str) -> Result<&'static dyn Scene, Refusal> {
    SCENES
        .iter()
        .copied()
        .find(|scene| scene.name() == name)
        .ok_or_else(|| Refusal::unknown("scene", name, SCENES.iter().map(|scene| scene.name())))
}
