//! A scene: a system, and what the program knows of it beside. A new one is a struct with its derive and an [`Entry`].

use crate::closed_form::ClosedForm;
use crate::request::{Refusal, Request};
use lagrange_core::prelude::*;
use lagrange_core::system::{AnySystem, Description};

/// Stages of [`Progress`](crate::progress::Progress) that a run advances by: the run itself and the energy book; a film: one
/// book more.
pub const RUN_STAGES: usize = 2;
/// See [`RUN_STAGES`].
pub const FILM_STAGES: usize = 3;

/// A scene whose type has been forgotten: a system, and what the program knows of it beside. What the program does with scenes is
/// compiled once for all of them.
pub trait Scene: Sync {
    /// Name on the command line.
    fn name(&self) -> &'static str;

    /// Time at which a run ends if nothing ends it before, s.
    fn until(&self) -> f64;

    /// The system with its default parameters.
    fn system(&self) -> AnySystem<f64>;

    /// Where the motion of a system of this kind from a start at time 0 to a last time ends, if that is known in closed form.
    fn closed_form(
        &self,
        system: &AnySystem<f64>,
        start: &State<f64>,
        until: f64,
    ) -> Option<ClosedForm>;

    /// Named results: what they are called, and the observation that they stand for.
    fn results(&self) -> &'static [(&'static str, &'static str)];

    /// Remarks on what is declared in a file and is not wrong, each with its place.
    fn hints(&self) -> &'static [String];

    /// Where a parameter, coordinate or item of this name stands, `ball.lagrange:6:9`; nothing where that is not a file.
    fn place(&self, name: &str) -> Option<&str>;
}

/// A scene of type `S`.
pub struct Entry<S: 'static> {
    name: &'static str,
    prototype: Prototype<S>,
    until: f64,
    closed_form: Option<Solution<S>>,
    results: &'static [(&'static str, &'static str)],
    /// Names with their places.
    places: &'static [(String, String)],
    hints: &'static [String],
}

/// The system with its default parameters.
enum Prototype<S: 'static> {
    /// Of a type that knows them.
    Made(fn() -> S),
    /// Read from a file, and kept as long as the program runs.
    Kept(&'static S),
}

/// Where the motion from a start at time 0 to a last time ends, if that is known in closed form.
pub type Solution<S> = fn(&S, &State<f64>, f64) -> Option<ClosedForm>;

impl<S> Entry<S> {
    /// A scene called `name` that runs for `until` seconds unless asked otherwise.
    pub const fn new(name: &'static str, until: f64) -> Self
    where
        S: Default,
    {
        Self::of(name, until, Prototype::Made(S::default))
    }

    /// The scene of a system that is kept as long as the program runs, with its parameters as defaults.
    pub const fn kept(name: &'static str, until: f64, system: &'static S) -> Self {
        Self::of(name, until, Prototype::Kept(system))
    }

    const fn of(name: &'static str, until: f64, prototype: Prototype<S>) -> Self {
        Self {
            name,
            prototype,
            until,
            closed_form: None,
            results: &[],
            places: &[],
            hints: &[],
        }
    }

    /// The same with names for what a sweep may read from a run: name and observation.
    pub const fn results(self, results: &'static [(&'static str, &'static str)]) -> Self {
        Self { results, ..self }
    }

    /// The same with the places at which names stand in a file.
    pub(crate) const fn places(self, places: &'static [(String, String)]) -> Self {
        Self { places, ..self }
    }

    /// The same with remarks on its declaration in a file.
    pub(crate) const fn hints(self, hints: &'static [String]) -> Self {
        Self { hints, ..self }
    }

    /// The same with a closed form, for `lagrange accuracy` to measure errors against.
    pub const fn known(self, closed_form: Solution<S>) -> Self {
        Self {
            closed_form: Some(closed_form),
            ..self
        }
    }
}

impl<S: System<Scalar = f64>> Entry<S> {
    fn prototype(&self) -> S {
        match self.prototype {
            Prototype::Made(system) => system(),
            Prototype::Kept(system) => system.copy(),
        }
    }
}

impl<S: System<Scalar = f64>> Scene for Entry<S> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn until(&self) -> f64 {
        self.until
    }

    fn system(&self) -> AnySystem<f64> {
        AnySystem::new(self.prototype())
    }

    fn closed_form(
        &self,
        system: &AnySystem<f64>,
        start: &State<f64>,
        until: f64,
    ) -> Option<ClosedForm> {
        let closed_form = self.closed_form?;
        let mut typed = self.prototype();
        for index in 0..system.description().parameters.len() {
            typed.set_parameter(index, system.parameter(index));
        }
        closed_form(&typed, start, until)
    }

    fn results(&self) -> &'static [(&'static str, &'static str)] {
        self.results
    }

    fn hints(&self) -> &'static [String] {
        self.hints
    }

    fn place(&self, name: &str) -> Option<&str> {
        // All elements of an array stand at one place.
        let name = name.split('[').next().unwrap_or(name);
        let found = self.places.iter().find(|(known, _)| known == name);
        found.map(|(_, place)| place.as_str())
    }
}

impl dyn Scene + '_ {
    /// Names, documentation and structure.
    pub fn description(&self) -> &'static Description {
        self.system().description()
    }

    /// What was derived, to be read.
    pub fn derivation(&self) -> &'static Derivation {
        self.system().derivation()
    }

    /// First sentence of the documentation.
    pub fn summary(&self) -> &'static str {
        let text = self.description().documentation.trim();
        text.lines().next().unwrap_or_default().trim()
    }

    /// Default value of every parameter, in the order of the description.
    pub fn defaults(&self) -> Vec<f64> {
        let system = self.system();
        (0..system.description().parameters.len())
            .map(|i| system.parameter(i))
            .collect()
    }

    /// The observation that a named result stands for; any other text as it is.
    pub fn result<'a>(&self, text: &'a str) -> &'a str {
        let found = self.results().iter().find(|(name, _)| *name == text);
        found.map_or(text, |(_, observation)| *observation)
    }

    /// What a run as asked for begins with.
    ///
    /// # Errors
    /// The request makes no sense, or the start does not exist.
    pub(crate) fn beginning(&self, request: &Request) -> Result<Beginning, Refusal> {
        let mut system = self.system();
        request.set_parameters(&mut system)?;
        let start = request.start(&system, &request.simulation(&system)?)?;
        Ok(Beginning {
            system,
            start,
            until: request.until.unwrap_or(self.until()),
        })
    }
}

/// What a run begins with, names resolved.
pub(crate) struct Beginning {
    /// The system, with the parameters of the request.
    pub(crate) system: AnySystem<f64>,
    /// Where it starts, at time 0.
    pub(crate) start: State<f64>,
    /// When it ends, s.
    pub(crate) until: f64,
}
