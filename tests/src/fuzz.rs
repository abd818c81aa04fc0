//! Random runs, each held to its certificate; all of a run follows from its number.

use crate::families::Family;
use crate::families::contacts::{Balls, Blocks, Chain, Rod};
use crate::families::linkages::{Bead, FourBar, RoughPins};
use crate::families::moving::{Feeder, Shaken};
use crate::families::space::{Body, Charge, Puck};
use crate::families::supports::{Beam, CartPole, Cranks};
use crate::{METHODS, Random, TOLERANCES};
use lagrange_core::certificate::Certificate;
use lagrange_core::effects::Item;
use lagrange_core::prelude::*;
use lagrange_program::request::Request;
use lagrange_program::scene::Scene;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Longest time that a run may take, s.
const PATIENCE: u64 = 20;

/// What a run came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Every check is within its bound.
    Certified,
    /// It ended with an error; what there is of it is within its bounds.
    Refused(String),
    /// A check is beyond its bound, it took too long, or it panicked.
    Short(String),
}

/// A run and what it came to.
#[derive(Clone, Debug)]
pub struct Report {
    /// Everything needed to repeat it.
    pub run: String,
    /// What it came to.
    pub verdict: Verdict,
}

/// A run, drawn at random.
#[derive(Clone, Debug)]
pub struct Trial<F> {
    /// The system.
    pub scene: F,
    /// Where it begins.
    pub start: State<f64>,
    /// Method.
    pub method: Method,
    /// Tolerance.
    pub tolerance: f64,
    /// What takes part.
    pub effects: Effects,
    /// Last time, s.
    pub until: f64,
}

/// What is asked of random runs.
pub trait Question {
    /// What is to be known.
    type Answer;

    /// The answer for one run.
    fn ask<F: Family>(trial: &Trial<F>) -> Self::Answer;
}

/// Draws a run of one family and asks; what it was, and the answer.
type Draw<A> = fn(Random) -> (String, A);

/// Draws run `number` and asks; with everything that is needed to repeat it.
pub fn ask<Q: Question>(number: u64) -> (String, Q::Answer) {
    let families: [Draw<Q::Answer>; 14] = [
        draw::<Q, Chain>,
        draw::<Q, Rod>,
        draw::<Q, Balls>,
        draw::<Q, Blocks>,
        draw::<Q, FourBar>,
        draw::<Q, Bead>,
        draw::<Q, Shaken>,
        draw::<Q, Feeder>,
        draw::<Q, Puck>,
        draw::<Q, Body>,
        draw::<Q, Charge>,
        draw::<Q, Beam>,
        draw::<Q, CartPole>,
        draw::<Q, Cranks>,
    ];
    let mut random = Random::new(number.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let bits = random.bits();
    // Numbers keep what they stand for when a family is added.
    let family = match bits >> 60 {
        1 => draw::<Q, RoughPins>,
        _ => families[bits as usize % families.len()],
    };
    let (run, answer) = family(random);
    (format!("{number}: {run}"), answer)
}

fn draw<Q: Question, F: Family>(mut random: Random) -> (String, Q::Answer) {
    let (scene, start) = F::draw(&mut random);
    let method = METHODS[random.bits() as usize % METHODS.len()];
    let tolerance = TOLERANCES[random.bits() as usize % TOLERANCES.len()];
    let mut effects = Effects::all();
    let items: Vec<Item> = Item::all(F::DESCRIPTION).collect();
    if random.between(0.0, 1.0) < 0.3 && !items.is_empty() {
        effects = effects.without(items[random.bits() as usize % items.len()]);
    }
    let left_out: Vec<&str> = effects
        .left_out()
        .map(|item| item.name(F::DESCRIPTION))
        .collect();
    let until = random.between(0.5, 3.0);
    let run = format!(
        "{}, {method} {tolerance:e}, until {until}, without {left_out:?}\n  {scene:?}\n  {start:?}",
        F::NAME
    );
    let trial = Trial {
        scene,
        start,
        method,
        tolerance,
        effects,
        until,
    };
    (run, Q::ask(&trial))
}

impl<F: Family> Trial<F> {
    /// How it is run.
    pub fn simulation(&self) -> Simulation<'_, F> {
        Simulation::new(&self.scene)
            .method(self.method)
            .tolerance(self.tolerance)
            .effects(self.effects.clone())
            .project_start(true)
            .max_steps(20_000)
    }
}

/// Whether a run holds what its declaration says.
struct Certified;

impl Question for Certified {
    type Answer = Verdict;

    fn ask<F: Family>(trial: &Trial<F>) -> Verdict {
        let (start, span) = (trial.start.clone(), 0.0..trial.until);
        patiently(|| match trial.simulation().run(start, span) {
            Ok(trajectory) => judge(&trajectory, None),
            Err(failure) => judge(&failure.trajectory, Some(&failure.error)),
        })
    }
}

/// Makes run `number`.
pub fn run(number: u64) -> Report {
    let (run, verdict) = ask::<Certified>(number);
    Report { run, verdict }
}

/// Runs a scene of the catalogue.
pub fn scene(scene: &dyn Scene, method: Method, tolerance: f64) -> Report {
    let until = scene.until().min(20.0);
    let request = Request {
        method,
        tolerance,
        until: Some(until),
        certified: 1.0,
        ..Request::default()
    };
    let verdict = patiently(|| match scene.run(&request) {
        Err(refusal) => Verdict::Refused(refusal.to_string()),
        Ok(outcome) => told(outcome.certificate.as_ref(), outcome.failure.as_ref()),
    });
    let run = format!(
        "{} --method {method} --tolerance {tolerance:e} --until {until}",
        scene.name()
    );
    Report { run, verdict }
}

fn patiently(run: impl FnOnce() -> Verdict) -> Verdict {
    let clock = Instant::now();
    let verdict = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or(panic.downcast_ref::<&str>().copied());
        Verdict::Short(format!("panics: {}", words.unwrap_or("without a word")))
    });
    match clock.elapsed().as_secs() {
        PATIENCE.. => Verdict::Short(format!("takes longer than {PATIENCE} s")),
        _ => verdict,
    }
}

/// The verdict on a run that may have ended early.
fn judge(run: &Trajectory, error: Option<&Error>) -> Verdict {
    told(run.verify(0).ok().as_ref(), error)
}

fn told(certificate: Option<&Certificate>, error: Option<&Error>) -> Verdict {
    match (certificate, error) {
        (Some(certificate), _) if !certificate.holds() => {
            let beyond = certificate.checks.iter().filter(|check| !check.holds());
            let words = beyond.map(|check| {
                format!(
                    "{} {:.1e} instead of {:.1e} at t = {} ({})",
                    check.subject.words(),
                    check.figure,
                    check.bound,
                    check.time,
                    check.item
                )
            });
            let error = error.map(|error| format!("ends: {error}"));
            Verdict::Short(words.chain(error).collect::<Vec<_>>().join("; "))
        }
        (_, Some(error)) => Verdict::Refused(error.to_string()),
        (None, None) => Verdict::Short("no certificate".to_owned()),
        (Some(_), None) => Verdict::Certified,
    }
}
