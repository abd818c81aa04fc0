//! What each effect of a scene costs: operations and time of a right-hand side in every mode, and of a whole run.
//!
//! A right-hand side is what a stepper asks for again and again: the accelerations of all coordinates. It is evaluated in
//! the middle of the first phase of each mode that the run goes through. An effect's share is the difference to the
//! same mode without it; where that is nothing, the effect does not act there. All times are taken in turn, the shortest
//! of the rounds counts.

use crate::progress::Progress;
use core::hint::black_box;
use lagrange_core::dynamics::Dynamics;
use lagrange_core::integrate::Acceleration;
use lagrange_core::prelude::*;
use std::time::Instant;

/// Part of an acceleration that a call moves the state by: less than rounding, so that calls form a chain.
const MOVE: f64 = 1e-13;
/// Calls of a right-hand side in a round.
const CALLS: usize = 500;
/// Most events of a run: what has more without an effect goes in circles.
const MOST_EVENTS: usize = 10_000;
/// Rounds.
const ROUNDS: usize = 25;

/// What a right-hand side takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Arithmetic operations and function calls.
    pub operations: usize,
    /// Time, ns.
    pub nanoseconds: f64,
}

/// A mode of the run.
#[derive(Clone, Debug)]
pub struct ModeCost {
    /// In words.
    pub mode: String,
    /// With all effects.
    pub cost: Cost,
}

/// An effect.
#[derive(Clone, Debug)]
pub struct EffectCost {
    /// Its name in the declaration.
    pub name: &'static str,
    /// What it is.
    pub kind: &'static str,
    /// Right-hand side without it, mode by mode; `None` where the equations cannot be solved without it.
    pub without: Vec<Option<Cost>>,
    /// Time of a whole run without it, s, or why it fails.
    pub run: Result<f64, Error>,
}

/// What everything costs in a scene.
#[derive(Clone, Debug)]
pub struct Costs {
    /// Name of the scene.
    pub scene: &'static str,
    /// Modes, in the order in which the run meets them.
    pub modes: Vec<ModeCost>,
    /// Effects, in the order of the declaration.
    pub effects: Vec<EffectCost>,
    /// Time of a whole run with everything, s.
    pub run: f64,
}

/// A mode met at a state.
struct Place {
    mode: Mode,
    time: f64,
    state: State<f64>,
}

/// Measures a run of `simulation`, with the effects given, from `start` until a time.
///
/// # Errors
/// The run fails.
pub(crate) fn measure<S: System<Scalar = f64>>(
    scene: &'static str,
    system: &S,
    simulation: &Simulation<'_, S>,
    effects: &Effects,
    (start, until): (&State<f64>, f64),
    progress: &Progress,
) -> Result<Costs, Error> {
    let d = S::DESCRIPTION;
    let trajectory = simulation
        .clone()
        .effects(effects.clone())
        .run(start.clone(), 0.0..until)
        .map_err(|failure| failure.error)?;
    let places = places(&trajectory);
    let items: Vec<Item> = Item::all(d)
        .filter(|item| !matches!(item, Item::Observe(_) | Item::Stop(_) | Item::Mark(_)))
        .filter(|item| effects.includes(d, *item))
        .collect();
    let without = items.iter().map(|item| effects.clone().without(*item));
    let choices: Vec<Effects> = core::iter::once(effects.clone()).chain(without).collect();
    let mut sides: Vec<Vec<Option<RightSide>>> = choices
        .iter()
        .map(|chosen| {
            let sides = places
                .iter()
                .map(|place| RightSide::new(Dynamics::new(system, chosen), place));
            sides.collect()
        })
        .collect();
    let mut runs: Vec<Result<WholeRun<'_, S>, Error>> = choices
        .into_iter()
        .map(|chosen| WholeRun::new(simulation.clone().effects(chosen), start, until))
        .collect();
    progress.expect(ROUNDS);
    for _ in 0..ROUNDS {
        let sides = sides.iter_mut().flatten().flatten();
        sides.for_each(RightSide::time);
        let runs = runs.iter_mut().flatten();
        runs.for_each(WholeRun::time);
        progress.advance();
    }
    let mut costs = sides.into_iter().map(|sides| -> Vec<Option<Cost>> {
        let cost = |side: Option<RightSide>| side.map(|side| side.cost);
        sides.into_iter().map(cost).collect()
    });
    let mut runs = runs.into_iter().map(|run| run.map(|run| run.best));
    let whole = costs.next().unwrap_or_default();
    let run = runs.next().unwrap_or(Ok(0.0))?;
    let modes = places.iter().zip(whole).filter_map(|(place, cost)| {
        let mode = place.mode.display(d).to_string();
        cost.map(|cost| ModeCost { mode, cost })
    });
    let effect = |(item, (without, run)): (Item, _)| EffectCost {
        name: item.name(d),
        kind: item.kind(),
        without,
        run,
    };
    Ok(Costs {
        scene,
        modes: modes.collect(),
        effects: items.into_iter().zip(costs.zip(runs)).map(effect).collect(),
        run,
    })
}

/// The middle of the first phase in each mode.
fn places(trajectory: &Record<f64>) -> Vec<Place> {
    let mut sampler = trajectory.sampler();
    let mut places: Vec<Place> = Vec::new();
    for phase in trajectory.phases() {
        let time = 0.5 * (phase.from + phase.to);
        if places.iter().any(|place| place.mode == phase.mode) {
            continue;
        }
        let Ok(instant) = sampler.at(time) else {
            continue;
        };
        let state = State {
            q: instant.q.clone(),
            v: instant.v.clone(),
        };
        places.push(Place {
            mode: phase.mode,
            time,
            state,
        });
    }
    places
}

/// The equations in one mode, again and again.
struct RightSide {
    dynamics: Dynamics<f64>,
    time: f64,
    start: State<f64>,
    rates: Vec<f64>,
    cost: Cost,
}

impl RightSide {
    /// The mode of a place, as far as these effects have it; `None` if it has no accelerations there.
    fn new(mut dynamics: Dynamics<f64>, place: &Place) -> Option<Self> {
        let effects = dynamics.effects().clone();
        dynamics.set_mode(&remaining(dynamics.description(), &effects, &place.mode));
        let State { q, v } = &place.state;
        dynamics.value(place.time, q, v).ok()?;
        let cost = Cost {
            operations: dynamics.operations().accelerations,
            nanoseconds: f64::INFINITY,
        };
        Some(Self {
            dynamics,
            time: place.time,
            start: place.state.clone(),
            rates: vec![0.0; v.len()],
            cost,
        })
    }

    fn time(&mut self) {
        let State { mut q, mut v } = black_box(self.start.clone());
        let begin = Instant::now();
        for _ in 0..CALLS {
            let rates = &mut self.rates;
            // An error would leave the last accelerations; none occurred at the start.
            let done = Acceleration::acceleration(&mut self.dynamics, self.time, &q, &v, rates);
            let _ = black_box(done.is_ok());
            for (q, v) in q.iter_mut().zip(&v) {
                *q += MOVE * v;
            }
            for (v, a) in v.iter_mut().zip(&self.rates) {
                *v += MOVE * a;
            }
        }
        black_box((&q, &v));
        let each = begin.elapsed().as_secs_f64() * 1e9 / CALLS as f64;
        self.cost.nanoseconds = self.cost.nanoseconds.min(each);
    }
}

/// The mode without the contacts and frictions that are left out.
fn remaining(description: &Description, effects: &Effects, mode: &Mode) -> Mode {
    let mut mode = mode.clone();
    for (i, contact) in mode.contacts.iter_mut().enumerate() {
        *contact &= effects.includes(description, Item::Contact(i));
    }
    for (i, friction) in mode.frictions.iter_mut().enumerate() {
        if !effects.includes(description, Item::Friction(i)) {
            *friction = FrictionMode::Inactive;
        }
    }
    mode
}

/// A run from start to end, again and again, without recording.
struct WholeRun<'a, S: System> {
    runner: Runner<S>,
    start: &'a State<f64>,
    until: f64,
    /// Shortest time so far, s.
    best: f64,
}

impl<'a, S: System<Scalar = f64>> WholeRun<'a, S> {
    fn new(
        simulation: Simulation<'_, S>,
        start: &'a State<f64>,
        until: f64,
    ) -> Result<Self, Error> {
        let mut runner = simulation.record(false).max_events(MOST_EVENTS).runner();
        runner.run(start, 0.0..until)?;
        Ok(Self {
            runner,
            start,
            until,
            best: f64::INFINITY,
        })
    }

    fn time(&mut self) {
        let begin = Instant::now();
        let done = self.runner.run(black_box(self.start), 0.0..self.until);
        let _ = black_box(done.is_ok());
        self.best = self.best.min(begin.elapsed().as_secs_f64());
    }
}
