//! Trajectory → samples: at given instants, at both ends of every phase, and on both sides of every event.

use super::Sample;
use core::iter;
use lagrange_core::__private::places::Normal;
use lagrange_core::dynamics::{Dynamics, OutputMask};
use lagrange_core::mode::{FrictionMode, Mode};
use lagrange_core::prelude::*;
use lagrange_core::system::Friction;
use lagrange_core::trajectory::Instant;

/// The instants between so many equal intervals of a motion.
pub(crate) fn equal(trajectory: &Trajectory, intervals: usize) -> Vec<f64> {
    let (first, last) = (trajectory.first_time(), trajectory.last_time());
    let step = (last - first) / intervals.max(1) as f64;
    (1..intervals).map(|k| first + k as f64 * step).collect()
}

/// The instants between so many equal intervals of the time up to `until` that a piece of a run has.
pub(crate) fn within(piece: &Trajectory, until: f64, intervals: usize) -> Vec<f64> {
    let step = until / intervals.max(1) as f64;
    let times = (1..intervals).map(|k| k as f64 * step);
    times
        .filter(|t| (piece.first_time()..piece.last_time()).contains(t))
        .collect()
}

/// Both ends of every phase, both sides of what makes velocities jump within one, and between them these times, which are in order.
pub(super) fn samples(trajectory: &Trajectory, times: &[f64]) -> Vec<Sample> {
    let (first, last) = (trajectory.first_time(), trajectory.last_time());
    let mut reader = Reader::new(trajectory);
    let mut samples = Vec::new();
    let at_once = || {
        vec![Phase {
            from: first,
            to: first,
            mode: trajectory.final_mode().under_way(),
        }]
    };
    let phases = Some(trajectory.phases())
        .filter(|phases| !phases.is_empty())
        .unwrap_or_else(at_once);
    let jumps = trajectory
        .events()
        .iter()
        .filter(|e| e.state_after != e.state);
    let mut jumps: Vec<f64> = jumps.map(|event| event.time).collect();
    jumps.dedup();
    for (phase, span) in phases.iter().enumerate() {
        let within = jumps.iter().filter(|t| span.from < **t && **t < span.to);
        let ends: Vec<f64> = iter::once(span.from)
            .chain(within.copied())
            .chain(iter::once(span.to))
            .collect();
        for part in ends.windows(2) {
            let (from, to) = (part[0], part[1]);
            let after = times.partition_point(|t| *t <= from);
            let before = times.partition_point(|t| *t < to).max(after);
            let inner = times[after..before].iter().copied();
            for time in iter::once(from).chain(inner).chain(iter::once(to)) {
                // At a switch a sampler gives what is just after it: what ends there is read a trifle before.
                let ends = time == to && (time < last || phase + 1 < phases.len());
                let read = if ends { just_before(time) } else { time };
                samples.extend(reader.sample(time, read, phase, &span.mode));
            }
        }
    }
    if samples.last().is_none_or(|end| end.time < last) {
        samples.extend(reader.before_the_end(trajectory, phases.len().saturating_sub(1)));
    }
    if let Some(end) = samples.last_mut().filter(|end| end.time == last) {
        end.state = trajectory.final_state().clone();
    }
    samples
}

/// Points of a curve over a step: a step follows an oscillation for a radian or some, and must not look like a slower one.
const PER_STEP: usize = 16;

/// Most points of a curve over a run: dozens in every column of a picture, which shows what they span.
const MOST_POINTS: f64 = 40_000.0;

/// The samples, or as many as the steps need where those are too few; a piece of a run has its `share` of them.
pub(super) fn curve(
    trajectory: &Trajectory,
    times: &[f64],
    samples: &[Sample],
    share: f64,
) -> Vec<Sample> {
    let mut ends: Vec<f64> = trajectory.step_times().collect();
    if PER_STEP * ends.len() <= times.len() {
        return samples.to_vec();
    }
    ends.push(trajectory.last_time());
    let most = (MOST_POINTS * share).ceil() as usize;
    if PER_STEP * ends.len() > most {
        return self::samples(trajectory, &equal(trajectory, most));
    }
    let part = |k: usize| k as f64 / PER_STEP as f64;
    let points = ends.windows(2).flat_map(|step| {
        let (from, length) = (step[0], step[1] - step[0]);
        (0..PER_STEP).map(move |k| from + part(k) * length)
    });
    let points: Vec<f64> = points.collect();
    self::samples(trajectory, &points)
}

/// The instants just before and just after every event. Of events at one instant only what is before the first and after
/// the last can be read from the trajectory: nothing for other states between them. A mark has the same on both its sides.
pub(super) fn around(trajectory: &Trajectory) -> Vec<[Option<Sample>; 2]> {
    let mut reader = Reader::new(trajectory);
    let sizes = sizes(trajectory);
    let mut around = Vec::with_capacity(trajectory.events().len());
    for group in trajectory.events().chunk_by(|a, b| a.time == b.time) {
        let ([first, ..], [.., last]) = (group, group) else {
            continue;
        };
        let known = [
            (&first.before, &first.state, reader.before(first)),
            (&last.after, &last.state_after, reader.after(last)),
        ];
        let side = |[i, k]: [usize; 2], mode: &Mode, state: &State<f64>| {
            let mut sides = [&known[i], &known[k]].into_iter();
            let same =
                sides.find(|(other, there, _)| *other == mode && are_alike(state, there, sizes));
            same.and_then(|(.., sample)| sample.clone())
        };
        around.extend(group.iter().map(|event| {
            [
                side([0, 1], &event.before, &event.state),
                side([1, 0], &event.after, &event.state_after),
            ]
        }));
    }
    around
}

/// The largest position and velocity at the ends of a motion and at its events.
fn sizes(trajectory: &Trajectory) -> [f64; 2] {
    let events = trajectory.events().iter();
    let ends = [trajectory.first_state(), trajectory.final_state()];
    let states = events.map(|event| &event.state).chain(ends);
    let largest = |x: &[f64], size: f64| x.iter().fold(size, |size, x| size.max(x.abs()));
    states.fold([0.0; 2], |[q, v], state| {
        [largest(&state.q, q), largest(&state.v, v)]
    })
}

/// Whether two states are the same but for what rounding makes of them where constraints are kept, in a motion of these sizes.
fn are_alike(one: &State<f64>, other: &State<f64>, sizes: [f64; 2]) -> bool {
    const ALIKE: f64 = 1e-12;
    let lists = [(&*one.q, &*other.q), (&*one.v, &*other.v)];
    lists.into_iter().zip(sizes).all(|((one, other), size)| {
        let mut pairs = one.iter().zip(other);
        pairs.all(|(x, y)| (x - y).abs() <= ALIKE * size)
    })
}

/// Reads samples from a trajectory.
struct Reader<'a> {
    sampler: Sampler<'a, f64>,
    limits: Limits,
}

impl<'a> Reader<'a> {
    fn new(trajectory: &'a Trajectory) -> Self {
        Self {
            sampler: trajectory.sampler(),
            limits: Limits::new(trajectory.dynamics()),
        }
    }

    fn before(&mut self, event: &Event<f64>) -> Option<Sample> {
        let instant = self.sampler.before(event).ok()?;
        Some(self.of_instant(event.time, 0, instant)).filter(|sample| sample.mode == event.before)
    }

    fn after(&mut self, event: &Event<f64>) -> Option<Sample> {
        let instant = self.sampler.after(event).ok()?;
        // A slip in space that begins is under way at once.
        let mode = event.after.under_way();
        Some(self.of_instant(event.time, 0, instant)).filter(|sample| sample.mode == mode)
    }

    /// The end of a run in a state that leaves forces undetermined, as aligned bars do: those a little before, told as such.
    fn before_the_end(&mut self, trajectory: &Trajectory, phase: usize) -> Option<Sample> {
        let last = trajectory.last_time();
        let begun = trajectory.step_times().last()?;
        let mut parts = [0.99, 0.9, 0.7, 0.4].into_iter();
        let mode = trajectory.final_mode().under_way();
        let mut end = parts.find_map(|part| {
            let read = begun + part * (last - begun);
            self.sample(last, read, phase, &mode)
        })?;
        end.undetermined.fill(true);
        Some(end)
    }

    /// What is at `read`, as a sample at `time`; nothing if another mode is there.
    fn sample(&mut self, time: f64, read: f64, phase: usize, mode: &Mode) -> Option<Sample> {
        let instant = self.sampler.at(read).ok()?;
        Some(self.of_instant(time, phase, instant)).filter(|sample| sample.mode == *mode)
    }

    /// An instant as a sample at `time`.
    fn of_instant(&mut self, time: f64, phase: usize, instant: Instant<f64>) -> Sample {
        Sample {
            time,
            phase,
            limits: self.limits.at(time, &instant),
            energies: instant.energies(),
            mode: instant.mode,
            state: instant.state,
            forces: instant.forces,
            held: instant.held,
            undetermined: instant.undetermined,
            observes: instant.observes,
        }
    }
}

/// When the books of these samples are read: of two at one instant the first is just before it.
pub(crate) fn book_times(samples: &[Sample]) -> Vec<f64> {
    let next = samples.iter().skip(1).map(|sample| Some(sample.time));
    let next = next.chain([None]);
    let times = samples.iter().zip(next);
    let read = times.map(|(sample, next)| match next == Some(sample.time) {
        true => just_before(sample.time),
        false => sample.time,
    });
    read.collect()
}

fn just_before(time: f64) -> f64 {
    time - 4.0 * f64::EPSILON * time.abs().max(1.0)
}

/// What frictions can hold: coefficient × normal force.
struct Limits {
    dynamics: Dynamics<f64>,
}

impl Limits {
    fn new(mut dynamics: Dynamics<f64>) -> Self {
        let description = dynamics.description();
        let mut needs = OutputMask::new(description);
        for friction in description.frictions {
            needs.insert(friction.coefficients_need);
        }
        dynamics.set_extra_needs(&needs);
        Self { dynamics }
    }

    fn at(&mut self, time: f64, instant: &Instant<f64>) -> Vec<Option<f64>> {
        if *self.dynamics.mode() != instant.mode {
            self.dynamics.set_mode(&instant.mode);
        }
        let description = self.dynamics.description();
        self.dynamics.tape(time, &instant.state.q, &instant.state.v);
        let dynamics = &self.dynamics;
        let limit = |(friction, mode): (&Friction, &FrictionMode)| {
            let coefficient = match mode {
                FrictionMode::Inactive => return None,
                FrictionMode::Stick => friction.static_coefficient,
                FrictionMode::Slip(_) => friction.kinetic_coefficient,
            };
            let normal = match friction.normal {
                Normal::Contact(i) => {
                    let contact = &description.contacts[i];
                    let factor = contact
                        .normal_factor
                        .map_or(1.0, |place| dynamics.motion(place));
                    factor * instant.forces[contact.row]
                }
                Normal::Constraint(i) => instant.forces[description.constraints[i].row].abs(),
                Normal::Resultant(i) => {
                    let constraints = description.resultants[i].iter();
                    let force = |&i: &usize| instant.forces[description.constraints[i].row];
                    constraints.map(force).fold(0.0, f64::hypot)
                }
                Normal::Given(place) => dynamics.motion(place),
            };
            Some(dynamics.motion(coefficient) * normal)
        };
        description
            .frictions
            .iter()
            .zip(&dynamics.mode().frictions)
            .map(limit)
            .collect()
    }
}
