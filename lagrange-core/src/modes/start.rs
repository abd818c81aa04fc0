//! The beginning of a run: states that satisfy the constraints.

use super::{
    domain,
    status::{ConstraintStatus, slack},
};
use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::{Dynamics, EvaluationError, Residual, row_name};
use crate::error::{Error, Level};
use crate::integrate::Tolerance;
use crate::mode::{FrictionMode, Mode};
use crate::state::State;

/// Velocities are changed by no more than this, relative to their size, unless a start is to be moved.
const MOST_CHANGE: f64 = 1e-6;

/// Looks at the start `given`, of which `state` is a copy to be moved onto the constraints: leaves `dynamics` in the mode with every touching
/// contact closed and every vanishing slip at rest, and says in `status` what is known.
///
/// # Errors
/// [`Error::Domain`] for a number without meaning, [`Error::Start`] where a constraint is violated or quite another state alone satisfies it,
/// and [`Error::Penetrates`] where a contact is penetrated (unless `project`).
pub fn begin<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    given: &State<T>,
    state: &mut State<T>,
    tolerance: Tolerance<'_>,
    project: bool,
    status: &mut ConstraintStatus,
) -> Result<(), Error> {
    domain::check_parameters(dynamics, t.value())?;
    status.apart.clear();
    status.look(dynamics, t, state, tolerance);
    domain::check(dynamics, &status.mode, t.value(), &mut status.form)?;
    if project {
        leave_surfaces(dynamics, t, state, tolerance, status)?;
        // A slip that is zero in a state off its constraints may be so by what the state does not say: it is judged on them.
        let mut mode = status.mode.clone();
        if mode.release_sticking() {
            project_onto(&mode, dynamics, t, state)?;
            status.look(dynamics, t, state, tolerance);
        }
    } else {
        status.refuse_violations(dynamics.description(), tolerance.strictness())?;
    }
    dynamics.set_mode(&status.mode);
    let (position, rate) = dynamics.residuals(t, &state.q, &state.v);
    if !project {
        refuse_other_velocities(dynamics, rate)?;
    }
    let left = project.then(|| state.clone());
    let before = left.as_ref().unwrap_or(given);
    if settle(dynamics, t, before, state, tolerance, status)? {
        if !project {
            let positions = [&given.q[..], &state.q];
            refuse_other_positions(dynamics, position, positions, tolerance.strictness())?;
        }
        status.look(dynamics, t, state, tolerance);
        dynamics.set_mode(&status.mode);
    }
    Ok(())
}

/// Moves a state, which is as `before`, onto what holds in its mode; whether it had to. Both sides of a slot that is narrower than what counts
/// as zero cannot be closed at once: contacts above their surface stay open where they cannot be closed together with those before them.
fn settle<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    before: &State<T>,
    state: &mut State<T>,
    tolerance: Tolerance<'_>,
    status: &mut ConstraintStatus,
) -> Result<bool, Error> {
    let error = match project_onto(&status.mode, dynamics, t, state) {
        Err(error) if status.above().next().is_some() => error,
        outcome => return outcome,
    };
    let mut apart: Vec<usize> = status.above().collect();
    let mut without = |apart: &[usize]| {
        let mut moved = before.clone();
        status.apart.clear();
        status.apart.extend_from_slice(apart);
        status.look(dynamics, t, &moved, tolerance);
        project_onto(&status.mode, dynamics, t, &mut moved).map(|_| moved)
    };
    let mut moved = without(&apart).map_err(|_| error)?;
    for contact in apart.clone() {
        let others = apart.iter().copied().filter(|&c| c != contact);
        let others: Vec<usize> = others.collect();
        if let Ok(onto) = without(&others) {
            (apart, moved) = (others, onto);
        }
    }
    status.apart = apart;
    *state = moved;
    Ok(true)
}

/// Moves positions that are below surfaces onto them. Velocities stay: a body may leave a surface, or arrive at it, where it begins.
fn leave_surfaces<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &mut State<T>,
    tolerance: Tolerance<'_>,
    status: &mut ConstraintStatus,
) -> Result<(), Error> {
    let mut closed = vec![false; status.mode.contacts.len()];
    // Whoever leaves one surface may end below another.
    for _ in 0..closed.len() {
        if status.penetrated(tolerance.strictness()).next().is_none() {
            return Ok(());
        }
        for contact in status.penetrated(tolerance.strictness()) {
            closed[contact] = true;
        }
        let mut mode = status.mode.clone();
        let contacts = mode.contacts.iter_mut().zip(&closed);
        contacts.for_each(|(contact, closed)| *contact |= closed);
        let velocities = state.v.clone();
        project_onto(&mode, dynamics, t, state)?;
        state.v = velocities;
        status.look(dynamics, t, state, tolerance);
    }
    status.refuse_penetration(dynamics.description(), tolerance.strictness())
}

/// A residual may be small because its row is, close to a position where constraints lose rank: to take it away there is to make another
/// motion of the start.
fn refuse_other_velocities<T: Scalar>(dynamics: &Dynamics<T>, rate: Residual) -> Result<(), Error> {
    let most = MOST_CHANGE.max(64.0 * epsilon::<T>());
    if !(rate.relative > most) {
        return Ok(());
    }
    Err(Error::Start {
        item: row_name(dynamics.description(), rate.row),
        level: Level::Velocity,
        residual: rate.value,
        tolerance: most * rate.value.abs() / rate.relative,
    })
}

/// What is small in a declaration's unit of length may be all that there is of a small system: a rod of 10⁻¹² m that is as far above the floor does
/// not touch it. And close to where a row loses rank, a residual δ is taken away by a move of √δ.
fn refuse_other_positions<T: Scalar>(
    dynamics: &Dynamics<T>,
    left: Residual,
    [given, moved]: [&[T]; 2],
    tolerance: f64,
) -> Result<(), Error> {
    let change = |(given, moved): (&T, &T)| {
        let (given, moved) = (given.value(), moved.value());
        (moved - given).abs() / given.abs().max(1.0)
    };
    let change = given.iter().zip(moved).map(change).fold(0.0, f64::max);
    let most = slack(tolerance).sqrt();
    if change <= most {
        return Ok(());
    }
    Err(Error::Start {
        item: row_name(dynamics.description(), left.row),
        level: Level::Position,
        residual: left.value,
        tolerance: left.value.abs() * (most / change),
    })
}

/// Moves a state onto what holds in `mode`, in which it leaves `dynamics`; whether it had to.
fn project_onto<T: Scalar>(
    mode: &Mode,
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &mut State<T>,
) -> Result<bool, Error> {
    dynamics.set_mode(mode);
    let moved = dynamics.project(t, &mut state.q, &mut state.v, 0.0);
    moved.map_err(|e| Error::from_evaluation(e, t.value(), mode, dynamics.description()))
}

/// See [`crate::Simulation::consistent`]. `state` is `reference` with the numbers that are `held`; `begun` is the mode in which the motion begins in `reference`, if it does.
pub fn consistent<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    time: f64,
    tolerance: Tolerance<'_>,
    reference: &State<T>,
    (state, held): (&State<T>, &[Vec<bool>; 2]),
    begun: Option<&Mode>,
) -> Result<State<T>, Error> {
    let d = dynamics.description();
    domain::check_parameters(dynamics, time)?;
    let t = T::from_f64(time);
    let mut status = ConstraintStatus::new(d);
    status.look(dynamics, t, reference, tolerance);
    let mut mode = status.mode;
    for (f, friction) in mode.frictions.iter_mut().enumerate() {
        // A slip may be zero for an instant, as that of a slider at its dead centre.
        if begun.is_some_and(|begun| begun.frictions[f] != FrictionMode::Stick) {
            *friction = FrictionMode::Inactive;
        }
    }
    let mut project = Holding {
        dynamics,
        t,
        reference,
        state,
        held,
    };
    let outcome = match project.onto(&mode) {
        Err(_) => {
            mode = project.let_go(&mode);
            project.onto(&mode)
        }
        outcome => outcome,
    };
    outcome.map_err(|e| Error::from_evaluation(e, time, &mode, d))
}

/// A projection that leaves some numbers of a state as they are.
struct Holding<'a, T: Scalar> {
    dynamics: &'a mut Dynamics<T>,
    t: T,
    /// The state before they were put in.
    reference: &'a State<T>,
    state: &'a State<T>,
    held: &'a [Vec<bool>; 2],
}

impl<T: Scalar> Holding<'_, T> {
    /// The state on what holds in `mode`.
    fn onto(&mut self, mode: &Mode) -> Result<State<T>, EvaluationError> {
        self.dynamics.set_mode(mode);
        let outcome = self.moved_onto(self.state.clone());
        outcome.or_else(|error| match self.with_others_aside() {
            Some(aside) => self.moved_onto(aside).map_err(|_| error),
            None => Err(error),
        })
    }

    /// The state with the coordinates that are not held moved aside; none if those that are held have not moved.
    ///
    /// Newton's method does not leave a position where constraints lose rank, a dead centre, as one that is held asks: the other coordinates are
    /// moved aside for it, each by half of what has the same kinetic energy as what one of those has moved.
    fn with_others_aside(&mut self) -> Option<State<T>> {
        let mut aside = self.state.clone();
        let mass = self.dynamics.mass_matrix();
        let inertia = |j: usize| mass[(j, j)].value();
        let moved = aside.q.iter().zip(&self.reference.q).enumerate();
        let moved = moved.map(|(j, (&q, &before))| inertia(j).sqrt() * (q - before).value());
        // Rather to the side to which those are moved: of a parallelogram this is not the crossed one.
        let larger = |most: f64, by: f64| if by.abs() > most.abs() { by } else { most };
        let most = moved.fold(0.0, larger);
        for (j, q) in aside.q.iter_mut().enumerate() {
            if !self.held[0][j] && inertia(j) > 0.0 {
                *q += T::from_f64(0.5 * most / inertia(j).sqrt());
            }
        }
        (most != 0.0).then_some(aside)
    }

    fn moved_onto(&mut self, mut state: State<T>) -> Result<State<T>, EvaluationError> {
        let [positions, velocities] = self.held;
        let (q, v) = (&mut state.q, &mut state.v);
        self.dynamics
            .project_holding(self.t, q, v, positions, velocities)?;
        Ok(state)
    }

    /// The mode without the contacts that what is held lifts, and the frictions that it moves.
    fn let_go(&mut self, mode: &Mode) -> Mode {
        let mut kept = mode.clone();
        kept.contacts.fill(false);
        kept.frictions.fill(FrictionMode::Inactive);
        for c in 0..mode.contacts.len() {
            kept.contacts[c] = mode.contacts[c];
            kept.contacts[c] &= !self.takes_part(c) || self.onto(&kept).is_ok();
        }
        for f in 0..mode.frictions.len() {
            let d = self.dynamics.description();
            let pressed = d.frictions[f].normal.presses(d, |c| kept.contacts[c]);
            if mode.frictions[f] == FrictionMode::Stick && pressed {
                kept.frictions[f] = FrictionMode::Stick;
                if self.onto(&kept).is_err() {
                    kept.frictions[f] = FrictionMode::Inactive;
                }
            }
        }
        kept
    }

    /// Whether what is held has a part in the gap of a contact, or in its rate.
    fn takes_part(&self, contact: usize) -> bool {
        let d = self.dynamics.description();
        let gap = d.rows[d.contacts[contact].row].jacobian;
        let mut held = self.held.iter();
        held.any(|held| gap.iter().any(|&(j, _)| held[j]))
    }
}
