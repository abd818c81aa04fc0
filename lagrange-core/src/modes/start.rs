//! The beginning of a run: which contacts touch, which frictions rest, and states that satisfy the constraints.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, NeedSet};
use crate::effects::Item;
use crate::error::{Error, Level};
use crate::mode::{FrictionMode, Mode, Sliding};
use crate::modes::decide::Known;
use crate::modes::guard;
use crate::simulation::Held;
use crate::system::{Description, Normal, Place};
use crate::trajectory::State;

/// What is accepted as zero in a start, relative to the size of the state: a start is typed or computed by a user.
fn slack(tolerance: f64) -> f64 {
    tolerance.clamp(1e-10, 1e-6)
}

/// Looks at a start: leaves `dynamics` in the mode with every touching contact closed and every vanishing slip at
/// rest, and says in `survey` what is known.
///
/// # Errors
/// [`Error::Start`] where a constraint is violated (unless `project`) or a contact is penetrated.
pub fn begin<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &mut State<T>,
    tolerance: f64,
    project: bool,
    survey: &mut Survey,
) -> Result<(), Error> {
    survey.look(dynamics, t, state, tolerance);
    if !project {
        refuse_violations(dynamics, survey, slack(tolerance))?;
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

/// What a state is like.
#[derive(Clone, Debug)]
pub struct Survey {
    /// Every touching contact closed, every vanishing slip at rest.
    pub mode: Mode,
    /// What vanishes.
    pub known: Known,
    /// (row, level, residual, size) of every constraint.
    residuals: Vec<(usize, Level, f64, f64)>,
    /// (contact, gap, size) of every contact.
    gaps: Vec<(usize, f64, f64)>,
    /// Contacts whose gap is negative outside their region.
    pub below: Vec<usize>,
    /// Needs of everything that is looked at.
    pub needs: NeedSet,
}

impl Survey {
    /// Memory for a system.
    pub fn new(description: &Description) -> Self {
        Self {
            mode: Mode::open(description),
            known: Known::default(),
            residuals: Vec::new(),
            gaps: Vec::new(),
            below: Vec::new(),
            needs: guard::all_row_needs(description, &NeedSet::new(description)),
        }
    }

    /// Evaluates every gap, slip and residual of a state.
    fn look<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        t: T,
        state: &State<T>,
        tolerance: f64,
    ) {
        let d = dynamics.description();
        let near = slack(tolerance);
        self.mode.clear();
        self.known.clear(d);
        self.residuals.clear();
        self.gaps.clear();
        self.below.clear();
        branches(
            dynamics,
            t,
            state,
            &self.needs,
            &mut self.mode,
            &mut self.known,
        );
        let Self { mode, known, .. } = self;
        let number = |dynamics: &Dynamics<T>, place: Place| dynamics.motion(place).value();
        let extent = state.q.iter().fold(1.0_f64, |m, x| m.max(x.value().abs()));
        let speed = |dynamics: &Dynamics<T>, row: usize| {
            let terms = d.rows[row].jacobian.iter();
            terms
                .map(|&(j, p)| (number(dynamics, p) * state.v[j].value()).abs())
                .fold(1.0_f64, f64::max)
        };
        for (c, contact) in d.contacts.iter().enumerate() {
            if !dynamics.effects().includes(d, Item::Contact(c)) {
                continue;
            }
            let row = &d.rows[contact.row];
            let gap = number(dynamics, row.position.unwrap_or(Place::Zero));
            let region = contact.region.map_or(0.0, |place| number(dynamics, place));
            if region < -near * extent {
                self.below.extend((gap < 0.0).then_some(c));
                continue;
            }
            self.gaps.push((c, gap, extent));
            if gap.abs() <= near * extent {
                let rate = number(dynamics, row.velocity);
                let size = speed(dynamics, contact.row);
                if rate > near * size {
                    known.parting[c] = true;
                } else {
                    known.touching[c] = true;
                    known.arriving[c] = rate < -near * size;
                    mode.contacts[c] = !known.arriving[c];
                }
            }
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            if !dynamics.effects().includes(d, Item::Friction(f)) {
                continue;
            }
            if let Normal::Contact(c) = friction.normal
                && !mode.contacts[c]
            {
                continue;
            }
            let rows = friction.row..friction.row + friction.components;
            let slip = |row: usize| number(dynamics, d.rows[row].velocity);
            let rests = |row: usize| slip(row).abs() <= near * speed(dynamics, row);
            if rows.clone().all(rests) {
                known.resting[f] = true;
                mode.frictions[f] = FrictionMode::Stick;
            } else {
                mode.frictions[f] = FrictionMode::Slip(if friction.components > 1 {
                    Sliding::along_slip()
                } else {
                    Sliding::sign(slip(friction.row).signum())
                });
            }
        }
        for (i, constraint) in d.constraints.iter().enumerate() {
            let waits = constraint.while_contact.is_some_and(|c| !mode.contacts[c]);
            if waits || !dynamics.effects().includes(d, Item::Constraint(i)) {
                continue;
            }
            let row = &d.rows[constraint.row];
            if let Some(place) = row.position {
                self.residuals.push((
                    constraint.row,
                    Level::Position,
                    number(dynamics, place),
                    extent,
                ));
            }
            let rate = number(dynamics, row.velocity);
            self.residuals.push((
                constraint.row,
                Level::Velocity,
                rate,
                speed(dynamics, constraint.row),
            ));
        }
    }
}

/// Puts every branch on its side; the guard of one may depend on the side of another.
fn branches<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &State<T>,
    needs: &NeedSet,
    mode: &mut Mode,
    known: &mut Known,
) {
    let d = dynamics.description();
    let evaluate = |dynamics: &mut Dynamics<T>, mode: &Mode| {
        dynamics.set_mode(mode);
        dynamics.set_extra_needs(needs);
        dynamics.tape(t, &state.q, &state.v);
    };
    evaluate(dynamics, mode);
    for _ in 0..d.branches.len() {
        let mut changed = false;
        for (b, branch) in d
            .branches
            .iter()
            .enumerate()
            .filter(|(_, b)| !b.after_solve)
        {
            let guard = dynamics.motion(branch.guard).value();
            known.balanced[b] = guard == 0.0;
            if mode.branch(b) != (guard >= 0.0) {
                mode.set_branch(b, guard >= 0.0);
                changed = true;
            }
        }
        if !changed {
            break;
        }
        evaluate(dynamics, mode);
    }
}

fn refuse_violations<T: Scalar>(
    dynamics: &Dynamics<T>,
    found: &Survey,
    near: f64,
) -> Result<(), Error> {
    let d = dynamics.description();
    for &(c, gap, size) in &found.gaps {
        if gap < -near * size {
            let item = d.contacts[c].name;
            return Err(Error::Start {
                item,
                level: Level::Position,
                residual: gap,
                tolerance: near * size,
            });
        }
    }
    for &(row, level, residual, size) in &found.residuals {
        if residual.abs() > near * size {
            let item = crate::dynamics::row_name(d, row);
            return Err(Error::Start {
                item,
                level,
                residual,
                tolerance: near * size,
            });
        }
    }
    Ok(())
}
