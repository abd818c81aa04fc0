//! The beginning of a run: states that satisfy the constraints.

use super::{domain, survey::Survey};
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::state::{Held, State};

/// Looks at a start: leaves `dynamics` in the mode with every touching contact closed and every vanishing slip at
/// rest, and says in `survey` what is known.
///
/// # Errors
/// [`Error::Domain`] for a number without meaning, [`Error::Start`] where a constraint is violated (unless `project`) or a contact is penetrated.
pub fn begin<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &mut State<T>,
    tolerance: f64,
    project: bool,
    survey: &mut Survey,
) -> Result<(), Error> {
    domain::check_parameters(dynamics, t.value())?;
    survey.look(dynamics, t, state, tolerance);
    domain::check(dynamics, t.value(), &mut survey.form)?;
    if !project {
        survey.refuse_violations(dynamics.description(), tolerance)?;
    }
    dynamics.set_mode(&survey.mode);
    let moved = dynamics.project(t, &mut state.q, &mut state.v, 0.0);
    let moved = moved
        .map_err(|e| Error::from_evaluation(e, t.value(), &survey.mode, dynamics.description()))?;
    if moved {
        survey.look(dynamics, t, state, tolerance);
        dynamics.set_mode(&survey.mode);
    }
    Ok(())
}

/// See [`crate::Simulation::consistent`].
pub fn consistent<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    time: f64,
    tolerance: f64,
    reference: &State<T>,
    wanted: &State<T>,
    held: &Held,
) -> Result<State<T>, Error> {
    domain::check_parameters(dynamics, time)?;
    let t = T::from_f64(time);
    let mut found = Survey::new(dynamics.description());
    found.look(dynamics, t, reference, tolerance);
    dynamics.set_mode(&found.mode);
    let mut state = wanted.clone();
    let outcome = dynamics.project_holding(
        t,
        &mut state.q,
        &mut state.v,
        &held.positions,
        &held.velocities,
    );
    outcome.map_err(|e| Error::from_evaluation(e, time, &found.mode, dynamics.description()))?;
    Ok(state)
}
