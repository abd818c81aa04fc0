//! The trajectory at any time: state, accelerations, forces, energies, outputs.

use super::owner::Owner;
use super::{Event, EventKind, Segment, State, Trajectory};
use crate::arithmetic::Scalar;
use crate::dynamics::{
    Dynamics, EvaluationError, OutputMask, add_branch_guards, add_guards, approach, dot,
};
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{Direction, Mode};
use crate::modes::exact::length;
use crate::modes::guard;
use crate::modes::redundant::RedundantForces;
use crate::modes::scale;
use crate::system::{Description, Friction, Normal, ValueRef};

/// Everything known at one time.
#[derive(Clone)]
pub struct Instant<T> {
    pub(super) owner: Owner,
    /// Time, s.
    pub time: T,
    /// The mode.
    pub mode: Mode,
    /// Positions and velocities.
    pub state: State<T>,
    /// Accelerations.
    pub acceleration: Vec<T>,
    /// λ of every row; 0 where it does not act; for frictions the force along +slip. Where the motion leaves forces open: the
    /// shares of least norm among those that contacts and friction allow.
    pub forces: Vec<T>,
    /// Per row: whether the motion leaves its force open. Empty where all forces are determined.
    pub undetermined: Vec<bool>,
    /// Per row: the size of what its force holds in balance; a force no larger than rounding of that counts as zero.
    pub held: Vec<T>,
    /// Gap of every contact.
    pub gaps: Vec<T>,
    /// Slip of every friction component, in the order of the rows.
    pub slips: Vec<T>,
    /// Largest force with which each friction can stick, μs N.
    pub limits: Vec<T>,
    /// Kinetic energy as declared, J.
    pub kinetic: T,
    /// Potential energy as declared, J.
    pub potential: T,
    /// v·∂L/∂v − L, J.
    pub jacobi: T,
    /// Value of every applied force; 0 where it is left out.
    pub loads: Vec<T>,
    /// Value of every declared output.
    pub observes: Vec<T>,
}

/// Evaluates a trajectory at any time; keeps the memory for it.
#[derive(Debug)]
pub struct Sampler<'a, T: Scalar> {
    trajectory: &'a Trajectory<T>,
    pub(super) dynamics: Dynamics<T>,
    redundant: RedundantForces<T>,
    /// What `dynamics` has been made ready for.
    mode: Option<Mode>,
    /// The segment whose dependent rows are held aside.
    segment: Option<usize>,
    /// Whether slips have been given directions for the present state.
    headed: bool,
    pub(super) state: State<T>,
}

impl<'a, T: Scalar> Sampler<'a, T> {
    pub(crate) fn new(trajectory: &'a Trajectory<T>) -> Self {
        let mut dynamics = trajectory.dynamics();
        report_everything(&mut dynamics);
        Self::with(trajectory, dynamics)
    }

    /// With equations that have been told what to report.
    pub(super) fn with(trajectory: &'a Trajectory<T>, dynamics: Dynamics<T>) -> Self {
        Self {
            trajectory,
            dynamics,
            redundant: RedundantForces::default(),
            mode: None,
            segment: None,
            headed: false,
            state: trajectory.start.clone(),
        }
    }

    pub(crate) fn evaluate_at(&mut self, t: f64) -> Result<Instant<T>, Error> {
        let trajectory = self.trajectory;
        let (first, last) = (trajectory.first_time(), trajectory.last_time());
        if !trajectory.recorded && t != first {
            return match t == last {
                true => self.evaluate_end(),
                false => Err(Error::NotRecorded),
            };
        }
        match self.locate(t)? {
            None => self.evaluate_end(),
            // A run that ends after an event ends in what that leads to.
            Some((index, _)) if t == last && !trajectory.ends_in_mode_of(index) => {
                self.evaluate_end()
            }
            Some((index, s)) => {
                let segment = &trajectory.segments[index];
                let mode = &trajectory.modes[segment.mode];
                let mut time = T::from_f64(t);
                let mut state = self.place(index, s)?;
                trajectory.spread_last_impacts(t, &mut state);
                if t == last {
                    // Beside it, the end of the last polynomial is off by rounding.
                    time = trajectory.last_time;
                    state.clone_from(&trajectory.last);
                }
                self.headed = self.head_into_rest(segment, s, time, &state);
                let instant = self.evaluate_entered(time, mode, &state);
                if core::mem::take(&mut self.headed) {
                    self.mode = None;
                }
                self.state = state;
                instant
            }
        }
    }

    /// The segment with time `t`, s, and the part of it; `None` if the run made no step.
    ///
    /// # Errors
    /// [`Error::OutsideTrajectory`], and [`Error::Dimension`] if the run was refused because of its start.
    pub(super) fn locate(&self, t: f64) -> Result<Option<(usize, T)>, Error> {
        let trajectory = self.trajectory;
        trajectory.check_dimension()?;
        let (first, last) = (trajectory.first_time(), trajectory.last_time());
        if !(first..=last).contains(&t) {
            return Err(Error::OutsideTrajectory {
                time: t,
                first,
                last,
            });
        }
        let after = trajectory.segments.partition_point(|s| s.t.value() <= t);
        let index = after.saturating_sub(1);
        let Some(segment) = trajectory.segments.get(index) else {
            return Ok(None);
        };
        // A step that ended where it began has no length.
        let s = if segment.h.value() > 0.0 {
            (T::from_f64(t) - segment.t) / segment.h
        } else {
            T::zero()
        };
        // The last instant moves with the end of the last step, where an event ends the run.
        let ended = t == last || s.value() > segment.end.value();
        Ok(Some((index, if ended { segment.end } else { s })))
    }

    pub(crate) fn evaluate_before(&mut self, event: &Event<T>) -> Result<Instant<T>, Error> {
        let d = self.trajectory.description();
        event.state.check_dimension(d.coordinates.len())?;
        let mut mode = event.before.clone();
        let mut directions = Vec::new();
        for (f, _) in event.before.in_space() {
            // A slip that has just come to rest had the direction against which friction acted.
            let row = d.frictions[f].row;
            let against = [row, row + 1].map(|row| -event.forces[row]);
            let size = dot(against, against).sqrt();
            if size.value() > 0.0 {
                let along = against.map(|x| x / size);
                mode.turn(f, Direction::Incipient(along.map(T::value)));
                directions.push((f, along));
            }
        }
        self.enter(&mode);
        for (f, along) in directions {
            self.dynamics.set_slip_direction(f, along);
        }
        self.evaluate(event.time, &mode, &event.state)
    }

    pub(crate) fn evaluate_after(&mut self, event: &Event<T>) -> Result<Instant<T>, Error> {
        let n = self.trajectory.description().coordinates.len();
        event.state_after.check_dimension(n)?;
        self.evaluate_setting_out(event.time, &event.after, &event.state_after)
    }

    /// What is at the end of a run: of one without a step just after what has happened.
    fn evaluate_end(&mut self) -> Result<Instant<T>, Error> {
        let trajectory = self.trajectory;
        let time = trajectory.last_time;
        self.evaluate_setting_out(time, trajectory.final_mode(), &trajectory.last)
    }

    /// Everything about a state in a mode that begins there.
    fn evaluate_setting_out(
        &mut self,
        t: T,
        mode: &Mode,
        state: &State<T>,
    ) -> Result<Instant<T>, Error> {
        // Slips that begin have the directions of the mode: those of the state are rounding.
        self.headed = mode.has_incipient_slip();
        let instant = self.evaluate(t, mode, state);
        self.headed = false;
        instant
    }

    /// The equations of motion at the instant that was asked for last: [`Dynamics::mass_matrix`], [`Dynamics::constraint_jacobian`].
    pub fn dynamics(&self) -> &Dynamics<T> {
        &self.dynamics
    }

    /// The state at part `s` of a segment, which is entered; taken from `self.state`.
    pub(super) fn place(&mut self, index: usize, s: T) -> Result<State<T>, Error> {
        let trajectory = self.trajectory;
        let segment = &trajectory.segments[index];
        let mode = &trajectory.modes[segment.mode];
        self.enter(mode);
        let (dynamics, state) = (&mut self.dynamics, &mut self.state);
        if self.segment != Some(index) {
            self.segment = Some(index);
            trajectory.hold_rows_aside(segment, dynamics, state);
        }
        let placed = trajectory.place(segment, s, dynamics, state);
        let time = (segment.t + segment.h * s).value();
        let d = trajectory.description();
        placed.map_err(|e| Error::from_evaluation(e, time, mode, d))?;
        Ok(core::mem::take(&mut self.state))
    }

    /// Whether the mode is another one than before.
    pub(super) fn enter(&mut self, mode: &Mode) -> bool {
        let other = self.mode.as_ref() != Some(mode);
        if other {
            self.mode = Some(mode.clone());
            self.segment = None;
            self.dynamics.set_mode(mode);
            let d = self.trajectory.description();
            let needs = guard::all_row_needs(d, &OutputMask::new(d));
            self.dynamics.set_extra_needs(&needs);
        }
        other
    }

    /// Where slips of two components come to rest at the end of a segment, rounding leaves them no direction there: they get
    /// that in which they have been going. False if there is none.
    fn head_into_rest(&mut self, segment: &Segment<T>, s: T, time: T, state: &State<T>) -> bool {
        /// Beside what makes a slip, it has no direction below this.
        const VANISHING: f64 = 1e-10;
        let mode = &self.trajectory.modes[segment.mode];
        let mut rests = mode.clone();
        let mut directions = Vec::new();
        for (f, _) in mode.in_space() {
            let dynamics = &mut self.dynamics;
            dynamics.tape(time, &state.q, &state.v);
            let slip = dynamics.slip(f).map(|s| s.value());
            if slip[0].hypot(slip[1]) > VANISHING * dynamics.slip_size(f, &state.v) {
                continue;
            }
            let mut there = state.clone();
            let came = approach(|part| {
                let s = T::from_f64(part) * s;
                self.trajectory
                    .state_at(segment, s, &mut there.q, &mut there.v);
                dynamics.tape(segment.t + segment.h * s, &there.q, &there.v);
                dynamics.slip(f)
            });
            if let Some(along) = came {
                rests.turn(f, Direction::Incipient(along.map(T::value)));
                directions.push((f, along));
            }
        }
        if directions.is_empty() {
            return false;
        }
        self.dynamics.set_mode(&rests);
        for (f, along) in directions {
            self.dynamics.set_slip_direction(f, along);
        }
        true
    }

    /// Everything about a state in a mode.
    pub(super) fn evaluate(
        &mut self,
        t: T,
        mode: &Mode,
        state: &State<T>,
    ) -> Result<Instant<T>, Error> {
        self.enter(mode);
        self.segment = None;
        self.dynamics.hold_rows_aside(false);
        self.evaluate_entered(t, mode, state)
    }

    /// The same in the mode or segment that has been entered.
    pub(super) fn evaluate_entered(
        &mut self,
        t: T,
        mode: &Mode,
        state: &State<T>,
    ) -> Result<Instant<T>, Error> {
        let d = self.trajectory.description();
        let dynamics = &mut self.dynamics;
        // What is found at an instant does not depend on those that were looked at before.
        dynamics.forget_load_directions();
        self.redundant.restart();
        let outcome = if self.headed {
            dynamics.value(t, &state.q, &state.v)
        } else {
            dynamics.value_along(t, &state.q, &state.v)
        };
        let outcome = outcome.and_then(|()| instant(dynamics, &mut self.redundant, t, state));
        let mut instant = outcome.map_err(|e| Error::from_evaluation(e, t.value(), mode, d))?;
        // The mode is that of the phase.
        instant.mode.branches.clone_from(&mode.branches);
        Ok(instant)
    }
}

impl<T: Scalar> Trajectory<T> {
    /// Between the last impact that is followed and the time at which infinitely many more have accumulated there is no step: their impulses, and
    /// what acts meanwhile, are spread evenly over that time.
    pub(super) fn spread_last_impacts(&self, t: f64, state: &mut State<T>) {
        let happened = self.events.partition_point(|event| event.time.value() <= t);
        let (Some(last), Some(next)) = (
            happened.checked_sub(1).map(|k| &self.events[k]),
            self.events.get(happened),
        ) else {
            return;
        };
        if !matches!(next.kind, EventKind::Accumulates { .. }) {
            return;
        }
        let passed = T::from_f64(t) - last.time;
        let part = passed / (next.time - last.time);
        let (from, to) = (&last.state_after, &next.state_after);
        for i in 0..from.v.len() {
            state.v[i] = from.v[i] + part * (to.v[i] - from.v[i]);
            state.q[i] = from.q[i] + T::from_f64(0.5) * passed * (from.v[i] + state.v[i]);
        }
    }
}

/// Asks the report tape for all that an [`Instant`] holds.
pub(crate) fn report_everything<T: Scalar>(dynamics: &mut Dynamics<T>) {
    let d = dynamics.description();
    let mut needs = report_needs(d);
    let observed = d.observes.iter().map(|o| o.need);
    observed.for_each(|need| needs.insert(need));
    add_branch_guards(d, &mut needs);
    dynamics.set_report_needs(&needs);
}

/// What to hold for energies and powers.
pub(super) fn report_needs(d: &Description) -> OutputMask {
    let mut needs = OutputMask::new(d);
    needs.insert(d.energy.need);
    let loads = d.forces.iter().chain(d.dissipations).map(|l| l.report_need);
    loads.for_each(|need| needs.insert(need));
    // A run does not watch branches of these alone.
    add_branch_guards(d, &mut needs);
    needs
}

/// Everything about a state in the present mode; all numbers of the rows and the report must have been asked for.
///
/// # Errors
/// The same as [`Dynamics::value`].
pub(crate) fn instant<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    redundant: &mut RedundantForces<T>,
    t: T,
    state: &State<T>,
) -> Result<Instant<T>, EvaluationError> {
    let d = dynamics.description();
    let mut undetermined = Vec::new();
    let mut forces = redundant.report(dynamics, &mut undetermined);
    dynamics.replace_forces(&forces);
    dynamics.report_value();
    let reported = branches_of_outputs(dynamics);
    // The guard of one may depend on the side of another.
    for _ in &reported {
        if !take_sides(&reported, dynamics) {
            break;
        }
        dynamics.value(t, &state.q, &state.v)?;
        undetermined.clear();
        forces = redundant.report(dynamics, &mut undetermined);
        dynamics.replace_forces(&forces);
        dynamics.report_value();
    }
    let contacts = d
        .contacts
        .iter()
        .map(|c| d.rows[c.row].position.unwrap_or(ValueRef::Zero));
    let frictions = d.frictions.iter().flat_map(Friction::rows);
    let limits = (0..d.frictions.len()).map(|f| limit(dynamics, f, &forces));
    let limits = limits.collect();
    Ok(Instant {
        owner: Owner(d),
        time: t,
        mode: dynamics.mode().under_way(),
        state: state.clone(),
        acceleration: dynamics.acceleration().to_vec(),
        forces,
        undetermined,
        held: scale::held(dynamics).into_iter().map(T::from_f64).collect(),
        gaps: contacts.map(|place| dynamics.motion(place)).collect(),
        slips: frictions
            .map(|row| dynamics.motion(d.rows[row].velocity))
            .collect(),
        limits,
        kinetic: dynamics.report(d.energy.kinetic),
        potential: dynamics.report(d.energy.potential),
        jacobi: dynamics.report(d.energy.jacobi),
        loads: (d.forces.iter().enumerate())
            .map(|(i, force)| unless_left_out(dynamics, Item::Force(i), force.value))
            .collect(),
        observes: d
            .observes
            .iter()
            .map(|o| dynamics.report(o.place))
            .collect(),
    })
}

/// A reported number of a force or dissipation: the tape has that of the declaration, whatever is left out.
pub(super) fn unless_left_out<T: Scalar>(dynamics: &Dynamics<T>, item: Item, place: ValueRef) -> T {
    match dynamics.effects().includes(dynamics.description(), item) {
        true => dynamics.report(place),
        false => T::zero(),
    }
}

/// The branches that only outputs use: a run does not watch them, so that the mode does not tell on which side they are.
pub(super) fn branches_of_outputs<T: Scalar>(dynamics: &Dynamics<T>) -> Vec<usize> {
    let (d, effects) = (dynamics.description(), dynamics.effects());
    if d.branches.is_empty() {
        return Vec::new();
    }
    let mut watched = dynamics.motion_needs().clone();
    let stops = d.stops.iter().enumerate();
    let marks = d.marks.iter().enumerate();
    stops
        .map(|(i, stop)| (Item::Stop(i), stop.need))
        .chain(marks.map(|(i, mark)| (Item::Mark(i), mark.need)))
        .filter(|(item, _)| effects.includes(d, *item))
        .for_each(|(_, need)| watched.insert(need));
    add_guards(d, effects, dynamics.mode(), &mut watched);
    (0..d.branches.len())
        .filter(|&b| !watched.contains(d.branches[b].need))
        .collect()
}

/// Puts these branches on the sides that their guards have at the last value; whether one was on the other.
fn take_sides<T: Scalar>(branches: &[usize], dynamics: &mut Dynamics<T>) -> bool {
    let d = dynamics.description();
    let mut mode = dynamics.mode().clone();
    for &b in branches {
        let branch = &d.branches[b];
        let guard = match branch.after_solve {
            true => dynamics.report(branch.guard),
            false => dynamics.motion(branch.guard),
        };
        mode.set_branch(b, guard.value() >= 0.0);
    }
    let changed = mode != *dynamics.mode();
    if changed {
        dynamics.set_mode(&mode);
    }
    changed
}

/// μs N of friction `f`.
fn limit<T: Scalar>(dynamics: &Dynamics<T>, f: usize, forces: &[T]) -> T {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    let normal = match friction.normal {
        Normal::Contact(c) => {
            let factor = d.contacts[c].normal_factor;
            let force = forces[d.contacts[c].row];
            factor.map_or(force, |place| dynamics.motion(place) * force)
        }
        Normal::Constraint(i) => {
            let force = forces[d.constraints[i].row];
            if force.value() < 0.0 { -force } else { force }
        }
        normal @ Normal::Resultant(_) => length(normal.rows(d).map(|row| forces[row])),
        Normal::Given(place) => dynamics.motion(place),
    };
    dynamics.motion(friction.static_coefficient) * normal
}
