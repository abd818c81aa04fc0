//! A run of a scene, told piece by piece, so that a long motion needs no more memory than a short one.

use super::{Outcome, equal, within};
use crate::request::{Refusal, Request};
use crate::scene::{Beginning, Scene};
use lagrange_core::prelude::*;

/// Bytes of a motion that are kept at a time.
pub(crate) const PIECE: usize = 32 << 20;

impl dyn Scene + '_ {
    /// Runs it. A run that fails half-way is an [`Outcome`] with a failure in it; only a request that makes no
    /// sense, or a start that does not exist, is refused.
    ///
    /// # Errors
    /// As said.
    pub fn run(&self, request: &Request) -> Result<Outcome, Refusal> {
        self.run_in_pieces(request, PIECE)
    }

    fn run_in_pieces(&self, request: &Request, bytes: usize) -> Result<Outcome, Refusal> {
        let outcome = |piece: &Trajectory, failure, request: &Request, times: &[f64]| {
            Outcome::sampled(self.name(), piece, failure, request, times)
        };
        let beginning = self.beginning(request)?;
        let asked = request.project.then(|| beginning.start.clone());
        let told = self.in_pieces(beginning, request, bytes, equal, outcome, Outcome::join)?;
        Ok(Outcome { asked, ..told })
    }

    /// What is `told` of the run as asked for, which begins so. So many bytes of the motion are kept at a time: a longer one is told piece by piece, at
    /// equal intervals, and what is told is joined; one that fits is told at these `instants`.
    pub(crate) fn in_pieces<T>(
        &self,
        Beginning {
            system,
            start,
            until,
        }: Beginning,
        request: &Request,
        bytes: usize,
        instants: fn(&Trajectory, usize) -> Vec<f64>,
        told: impl Fn(&Trajectory, Option<Error>, &Request, &[f64]) -> T,
        join: impl Fn(&mut T, T),
    ) -> Result<T, Refusal> {
        let simulation = request.simulation(&system)?;
        let told_piece = |piece: &Trajectory, failure, request: &Request| {
            let times = within(piece, until, request.samples);
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
    use super::{Outcome, Request, Scene};
    use crate::file;
    use crate::film::Film;

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

    /// The second run is compared with the events of all pieces, not with those of the last one.
    #[test]
    fn pieces_have_the_estimate_of_the_whole_run() {
        let belt = belt();
        let request = Request {
            tolerance: 1e-6,
            estimate: true,
            ..Request::default()
        };
        let run = |bytes| belt.run_in_pieces(&request, bytes).expect("a run");
        let [whole, joined] = [usize::MAX, 3000].map(run);
        let told = |run: &Outcome| run.estimate.clone().expect("an estimate").difference;
        assert_eq!(told(&joined).events.len(), whole.events.len());
        let [whole, joined] = [&whole, &joined].map(|run| told(run).error());
        assert!((1e-9..1e-3).contains(&whole), "{whole:e}");
        assert!(
            (joined - whole).abs() < 1e-6 * whole,
            "{joined:e} {whole:e}"
        );
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
