//! A scene: a system, and what the program knows of it beside. A new one is a struct with its derive and an [`Entry`].

use crate::accuracy::{self, Accuracy, Motion, Study};
use crate::closed_form::ClosedForm;
use crate::cost::{self, Costs};
use crate::feasible::{self, Feasible};
use crate::film::{self, Film, Reel};
use crate::outcome::{self, Outcome};
use crate::request::{Refusal, Request};
use crate::sweep::{self, Sweep, Worker};
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
}

/// A scene of type `S`.
pub struct Entry<S: 'static> {
    name: &'static str,
    prototype: Prototype<S>,
    until: f64,
    closed_form: Option<Solution<S>>,
    results: &'static [(&'static str, &'static str)],
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
        }
    }

    /// The same with names for what a sweep may read from a run: name and observation.
    pub const fn results(self, results: &'static [(&'static str, &'static str)]) -> Self {
        Self { results, ..self }
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
}

/// Bytes of a motion that are kept at a time.
const PIECE: usize = 32 << 20;

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

    /// Runs it. A run that fails half-way is an [`Outcome`] with a failure in it; only a request that makes no
    /// sense, or a start that does not exist, is refused.
    ///
    /// # Errors
    /// As said.
    pub fn run(&self, request: &Request) -> Result<Outcome, Refusal> {
        self.run_in_pieces(request, PIECE)
    }

    /// Runs it to be looked at: as [`Outcome`], with pictures. Of a long motion it keeps what is looked at, as a run does.
    ///
    /// # Errors
    /// As for a run.
    pub fn film(&self, request: &Request) -> Result<Film, Refusal> {
        self.film_in_pieces(request, PIECE)
    }

    fn film_in_pieces(&self, request: &Request, bytes: usize) -> Result<Film, Refusal> {
        let reel = |piece: &Trajectory, failure, request: &Request, times: &[f64]| {
            Reel::of(self.name(), piece, failure, request, times)
        };
        let reel = self.in_pieces(request, bytes, film::instants, reel, Reel::join)?;
        Ok(reel.film())
    }

    /// All modes in which the motion can go on at the start, or at a later time of the run.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, the run does not come so far, or there is no mode.
    pub fn modes(&self, request: &Request, at: Option<f64>) -> Result<Feasible, Refusal> {
        feasible::modes(self.name(), &self.requested(request)?, request, at)
    }

    /// Measures what each effect costs.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, or the run fails.
    pub fn costs(&self, request: &Request) -> Result<Costs, Refusal> {
        let system = self.requested(request)?;
        let simulation = request.simulation(&system)?;
        let start = request.start(&system, &simulation)?;
        let until = request.until.unwrap_or(self.until());
        let effects = request.effects(system.description())?;
        let progress = request.progress.clone().unwrap_or_default();
        let run = (&start, until);
        cost::measure(self.name(), &system, &simulation, &effects, run, &progress)
            .map_err(Refusal::Run)
    }

    /// What runs the points of a sweep.
    ///
    /// # Errors
    /// The sweep makes no sense.
    pub fn worker<'a>(&self, sweep: &'a Sweep) -> Result<Worker<'a>, Refusal> {
        sweep::worker(sweep, self.system(), self.until())
    }

    /// Measures what accuracy costs.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, or there is nothing to measure errors against.
    pub fn accuracy(&self, study: &Study) -> Result<Accuracy, Refusal> {
        let request = &study.request;
        let system = self.requested(request)?;
        let effects = request.effects(system.description())?;
        let simulation = request.simulation(&system)?;
        let start = request.start(&system, &simulation)?;
        let until = request.until.unwrap_or(self.until());
        // A closed form is that of the whole declaration.
        let whole = effects.left_out().next().is_none();
        let closed_form = match whole {
            true => self.closed_form(&system, &start, until),
            false => None,
        };
        let motion = Motion {
            system: &system,
            simulation,
            start,
            until,
            max_steps: 400_000,
        };
        accuracy::measure(self.name(), &motion, study, closed_form)
    }

    /// The system with the parameters of a request.
    fn requested(&self, request: &Request) -> Result<AnySystem<f64>, Refusal> {
        let mut system = self.system();
        request.set_parameters(&mut system)?;
        Ok(system)
    }

    fn run_in_pieces(&self, request: &Request, bytes: usize) -> Result<Outcome, Refusal> {
        let outcome = |piece: &Trajectory, failure, request: &Request, times: &[f64]| {
            Outcome::sampled(self.name(), piece, failure, request, times)
        };
        self.in_pieces(request, bytes, outcome::equal, outcome, Outcome::join)
    }

    /// What is `told` of the run as asked for. So many bytes of the motion are kept at a time: a longer one is told piece by piece, at
    /// equal intervals, and what is told is joined; one that fits is told at these `instants`.
    fn in_pieces<T>(
        &self,
        request: &Request,
        bytes: usize,
        instants: fn(&Trajectory, usize) -> Vec<f64>,
        told: impl Fn(&Trajectory, Option<Error>, &Request, &[f64]) -> T,
        join: impl Fn(&mut T, T),
    ) -> Result<T, Refusal> {
        let system = self.requested(request)?;
        let simulation = request.simulation(&system)?;
        let start = request.start(&system, &simulation)?;
        let until = request.until.unwrap_or(self.until());
        let told_piece = |piece: &Trajectory, failure, request: &Request| {
            let times = outcome::within(piece, until, request.samples);
            told(piece, failure, request, &times)
        };
        let unseen = Request {
            progress: None,
            ..request.clone()
        };
        let mut whole: Option<T> = None;
        let mut runner = simulation.runner();
        let run = || {
            runner.run_in_pieces(&start, 0.0..until, bytes, |piece| {
                let next = told_piece(piece, None, &unseen);
                match &mut whole {
                    Some(whole) => join(whole, next),
                    None => whole = Some(next),
                }
            })
        };
        let failure = request.stage(until, run).err();
        let last = runner.trajectory();
        Ok(match whole {
            None => told(last, failure, request, &instants(last, request.samples)),
            Some(mut whole) => {
                join(&mut whole, told_piece(last, failure, request));
                whole
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Film, Outcome, Request, Scene};
    use crate::file;

    /// A block on a moving belt, held by a spring: it sticks and slips in turn.
    fn belt() -> &'static dyn Scene {
        let declared = "
            parameters(mass = 1, gravity = 10, stiffness = 20, speed = 0.1, mu_static = 0.4, mu_kinetic = 0.2),
            coordinates(s, n),
            kinetic = mass/2 * (der(s)^2 + der(n)^2),
            potential(weight: mass * gravity * n),
            potential(spring: stiffness/2 * s^2),
            contact(belt: n >= 0),
            friction(grip on belt: slip = der(s) - speed, static = mu_static, kinetic = mu_kinetic),
            start(riding: der(s) = speed),
            draw(mass: (s, n)),
            until = 20,
        ";
        file::scene("belt.lagrange", declared).expect("a declaration")
    }

    #[test]
    fn pieces_make_the_same_run() {
        let belt = belt();
        let request = Request {
            samples: 50,
            ledger: true,
            ..Request::default()
        };
        let run = |bytes| belt.run_in_pieces(&request, bytes).expect("a run");
        let (whole, joined): (Outcome, Outcome) = (run(usize::MAX), run(3000));
        assert_eq!(joined.events.len(), whole.events.len());
        assert_eq!(joined.phases, whole.phases);
        assert_eq!(joined.work, whole.work);
        assert_eq!(joined.samples.len(), whole.samples.len());
        for (a, b) in joined.samples.iter().zip(&whole.samples) {
            assert!((a.time - b.time).abs() < 1e-12 && a.phase == b.phase);
            assert!((a.state.q[0] - b.state.q[0]).abs() < 1e-12);
        }
        let books = [&joined, &whole].map(|run| {
            let ledgers = run.ledgers.iter().chain(&run.event_ledgers);
            ledgers.chain(&run.ledger).collect::<Vec<_>>()
        });
        assert_eq!(books[0].len(), books[1].len());
        for (a, b) in books[0].iter().zip(&books[1]) {
            for (a, b) in a.work.iter().zip(&b.work) {
                assert_eq!((a.name, a.kind), (b.name, b.kind));
                assert!((a.work - b.work).abs() < 1e-9, "{a:?} {b:?}");
            }
        }
        let certificates = [&joined, &whole].map(|run| run.certificate.clone().expect("one"));
        assert_eq!(certificates[0].steps, certificates[1].steps);
        assert!(certificates.iter().all(|c| c.holds()));
    }

    #[test]
    fn a_film_of_pieces_shows_the_same() {
        let belt = belt();
        let request = Request {
            samples: 50,
            ..Request::default()
        };
        let film = |bytes| belt.film_in_pieces(&request, bytes).expect("a film");
        let films: [Film; 2] = [film(usize::MAX), film(3000)];
        let [whole, joined] = &films;
        assert_eq!(joined.outcome.phases, whole.outcome.phases);
        for film in &films {
            assert_eq!(film.drawings.len(), film.outcome.samples.len());
            assert!(film.drift.is_some_and(|drift| drift < 1e-9));
            assert!(film.books.len() <= 121, "{}", film.books.len());
        }
        let [a, b] = films
            .each_ref()
            .map(|film| film.books.last().expect("books"));
        assert_eq!(a.0, b.0);
        assert_eq!(a.1.work.len(), b.1.work.len());
        for (a, b) in a.1.work.iter().zip(&b.1.work) {
            assert_eq!((a.name, a.kind), (b.name, b.kind));
            assert!((a.work - b.work).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
}
