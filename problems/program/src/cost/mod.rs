//! What each effect of a scene costs: operations and time of a right-hand side in every mode, and of a whole run.
//!
//! A right-hand side is what a stepper asks for again and again: the accelerations of all coordinates. It is evaluated in
//! the middle of the first phase of each mode that the run goes through, or of the part of that phase in the first piece of a
//! long run that has it. An effect's share is the difference to the same mode without it; where that is nothing, the effect
//! does not act there. All times are taken in turn, the shortest of the rounds counts.

mod right_side;

use crate::outcome::pieces::PIECE;
use crate::progress::Progress;
use crate::request::{Refusal, Request};
use crate::scene::{Beginning, Scene};
use core::hint::black_box;
use lagrange_core::mode::Mode;
use lagrange_core::prelude::*;
use lagrange_core::system::{AnySystem, Description};
pub use right_side::{MOVE, Place, RightSide, places};
use std::time::Instant;

/// Calls of a right-hand side in a round.
const CALLS: u64 = 500;
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
    /// What is closed, and what sticks.
    pub mode: Mode,
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
    /// Names of what is in a mode.
    pub description: &'static Description,
    /// Modes, in the order in which the run meets them.
    pub modes: Vec<ModeCost>,
    /// Effects, in the order of the declaration.
    pub effects: Vec<EffectCost>,
    /// Time of a whole run with everything, s.
    pub run: f64,
}

impl dyn Scene + '_ {
    /// Measures what each effect costs.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, or the run fails.
    pub fn costs(&self, request: &Request) -> Result<Costs, Refusal> {
        let Beginning {
            system,
            start,
            until,
        } = self.beginning(request)?;
        let simulation = request.simulation(&system)?;
        let effects = request.effects(system.description())?;
        let progress = request.progress.clone().unwrap_or_default();
        let run = (&start, until);
        let costs = measure(self.name(), &system, &simulation, &effects, run, &progress);
        costs.map_err(|error| Refusal::Run(error).or_of_start(&simulation, &start))
    }
}

/// Measures a run of `simulation`, with the effects given, from `start` until a time.
///
/// # Errors
/// The run fails.
fn measure(
    scene: &'static str,
    system: &AnySystem<f64>,
    simulation: &Simulation<'_, AnySystem<f64>>,
    effects: &Effects,
    (start, until): (&State<f64>, f64),
    progress: &Progress,
) -> Result<Costs, Error> {
    let d = system.description();
    let places = met(
        &simulation.clone().effects(effects.clone()),
        start,
        until,
        PIECE,
    )?;
    let items: Vec<Item> = Item::all(d)
        .filter(|item| !matches!(item, Item::Observe(_) | Item::Stop(_) | Item::Mark(_)))
        .filter(|item| effects.includes(d, *item))
        .collect();
    let without = items.iter().map(|item| effects.clone().without(*item));
    let choices: Vec<Effects> = core::iter::once(effects.clone()).chain(without).collect();
    let mut sides: Vec<Vec<Option<(RightSide, Cost)>>> = choices
        .iter()
        .map(|chosen| right_sides(system, chosen, &places))
        .collect();
    let mut runs: Vec<Result<WholeRun<'_>, Error>> = choices
        .into_iter()
        .map(|chosen| WholeRun::new(simulation.clone().effects(chosen), start, until))
        .collect();
    time(&mut sides, &mut runs, progress);
    let mut costs = sides.into_iter().map(|sides| -> Vec<Option<Cost>> {
        let cost = |side: Option<(RightSide, Cost)>| side.map(|(_, cost)| cost);
        sides.into_iter().map(cost).collect()
    });
    let mut runs = runs.into_iter().map(|run| run.map(|run| run.best));
    let whole = costs.next().unwrap_or_default();
    let run = runs.next().unwrap_or(Ok(0.0))?;
    let modes = places.iter().zip(whole).filter_map(|(place, cost)| {
        let mode = place.mode.clone();
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
        description: d,
        modes: modes.collect(),
        effects: items.into_iter().zip(costs.zip(runs)).map(effect).collect(),
        run,
    })
}

/// The places of all modes that a run meets, of which so many bytes are kept at a time.
fn met(
    simulation: &Simulation<'_, AnySystem<f64>>,
    start: &State<f64>,
    until: f64,
    bytes: usize,
) -> Result<Vec<Place>, Error> {
    let mut met: Vec<Place> = Vec::new();
    let mut meet = |piece: &Trajectory| {
        for place in places(piece) {
            if met.iter().all(|known| known.mode != place.mode) {
                met.push(place);
            }
        }
    };
    let mut runner = simulation.runner();
    runner.run_in_pieces(start, 0.0..until, bytes, &mut meet)?;
    meet(runner.trajectory());
    Ok(met)
}

/// The equations of motion with these effects, in the mode of each place; none where they cannot be evaluated.
fn right_sides(
    system: &AnySystem<f64>,
    chosen: &Effects,
    places: &[Place],
) -> Vec<Option<(RightSide, Cost)>> {
    let sides = places.iter().map(|place| {
        let mut side = RightSide::new(system, chosen, place)?;
        let cost = Cost {
            operations: side.operations(),
            nanoseconds: f64::INFINITY,
        };
        Some((side, cost))
    });
    sides.collect()
}

/// Times all of them in turn, round by round: the shortest time of each counts.
fn time(
    sides: &mut [Vec<Option<(RightSide, Cost)>>],
    runs: &mut [Result<WholeRun<'_>, Error>],
    progress: &Progress,
) {
    progress.expect(ROUNDS);
    for _ in 0..ROUNDS {
        for (side, cost) in sides.iter_mut().flatten().flatten() {
            let each = side.chain(CALLS).as_secs_f64() * 1e9 / CALLS as f64;
            cost.nanoseconds = cost.nanoseconds.min(each);
        }
        let runs = runs.iter_mut().flatten();
        runs.for_each(WholeRun::time);
        progress.advance(1);
    }
}

/// A run from start to end, again and again, without recording.
struct WholeRun<'a> {
    runner: Runner<AnySystem<f64>>,
    start: &'a State<f64>,
    until: f64,
    /// Shortest time so far, s.
    best: f64,
}

impl<'a> WholeRun<'a> {
    fn new(
        simulation: Simulation<'_, AnySystem<f64>>,
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball bounces on a floor and comes to rest: in flight, and at rest.
    #[test]
    fn pieces_meet_the_same_modes() {
        let declared = "coordinates(y), kinetic = der(y)^2/2, potential = 9.81*y, contact(floor: y >= 0, restitution = 1/2),
            potential(spring: sin(y)^2), start(up: y = 1), until = 5,";
        let scene = crate::file::scene("ball.lagrange", declared).expect("a declaration");
        let request = Request::default();
        let begun = scene.beginning(&request).expect("a beginning");
        let simulation = request.simulation(&begun.system).expect("a simulation");
        let modes = |bytes| {
            let met = met(&simulation, &begun.start, begun.until, bytes).expect("a run");
            met.into_iter()
                .map(|place| place.mode.contacts[0])
                .collect::<Vec<_>>()
        };
        assert_eq!(modes(usize::MAX), [false, true]);
        assert_eq!(modes(3000), [false, true]);
    }
}
