//! What a state is like: which contacts touch, which frictions rest, and what constraints leave.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, OutputMask};
use crate::effects::Item;
use crate::error::{Error, Level};
use crate::integrate::{Tolerance, least_size};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::facts::SwitchFacts;
use crate::modes::guard;
use crate::state::State;
use crate::system::{Description, ValueRef};

/// What is accepted as zero in a start, relative to the size of the state: a start is typed or computed by a user.
pub(super) fn slack(tolerance: f64) -> f64 {
    tolerance.clamp(1e-10, 1e-6)
}

/// What a state is like.
#[derive(Clone, Debug)]
pub struct ConstraintStatus {
    /// Every touching contact closed, every vanishing slip at rest.
    pub mode: Mode,
    /// What vanishes.
    pub facts: SwitchFacts,
    /// (row, level, residual, size) of every constraint.
    residuals: Vec<(usize, Level, f64, f64)>,
    /// (contact, gap, size) of every contact.
    gaps: Vec<(usize, f64, f64)>,
    /// Contacts whose gap is negative outside their region.
    pub below: Vec<usize>,
    /// Contacts that are open although their gap counts as zero: they cannot be closed together with others.
    pub apart: Vec<usize>,
    /// Needs of everything that is looked at.
    pub needs: OutputMask,
    /// Memory for the quadratic form of the kinetic energy.
    pub form: Vec<f64>,
}

impl ConstraintStatus {
    /// Memory for a system.
    pub fn new(description: &Description) -> Self {
        Self {
            mode: Mode::open(description),
            facts: SwitchFacts::default(),
            residuals: Vec::new(),
            gaps: Vec::new(),
            below: Vec::new(),
            apart: Vec::new(),
            needs: guard::all_row_needs(description, &OutputMask::new(description)),
            form: Vec::new(),
        }
    }

    /// Evaluates every gap, slip and residual of a state.
    pub fn look<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        t: T,
        state: &State<T>,
        tolerance: Tolerance<'_>,
    ) {
        let d = dynamics.description();
        self.mode.clear();
        self.facts.clear(d);
        self.residuals.clear();
        self.gaps.clear();
        self.below.clear();
        let Self {
            mode, facts, needs, ..
        } = self;
        take_sides(dynamics, t, state, needs, mode, |b, guard| {
            facts.balanced[b] = guard == 0.0;
            Some(guard >= 0.0)
        });
        let view = View {
            dynamics,
            state,
            near: slack(tolerance.strictness()),
            sizes: tolerance.sizes,
            least: tolerance.strictness() / slack(tolerance.strictness()),
        };
        let includes = |item: Item| dynamics.effects().includes(d, item);
        for c in (0..d.contacts.len()).filter(|&c| includes(Item::Contact(c))) {
            self.look_at_contact(c, &view);
        }
        for f in (0..d.frictions.len()).filter(|&f| includes(Item::Friction(f))) {
            self.look_at_friction(f, &view);
        }
        for i in (0..d.constraints.len()).filter(|&i| includes(Item::Constraint(i))) {
            self.look_at_constraint(i, &view);
        }
    }

    /// Whether constraints and contacts hold.
    ///
    /// # Errors
    /// [`Error::Penetrates`], [`Error::Start`]: the first that does not.
    pub fn refuse_violations(&self, d: &'static Description, tolerance: f64) -> Result<(), Error> {
        self.refuse_penetration(d, tolerance)?;
        let near = slack(tolerance);
        for &(row, level, residual, size) in &self.residuals {
            if residual.abs() > near * size {
                return Err(Error::Start {
                    item: crate::dynamics::row_name(d, row),
                    level,
                    residual,
                    tolerance: near * size,
                });
            }
        }
        Ok(())
    }

    /// Whether no contact is penetrated.
    ///
    /// # Errors
    /// [`Error::Penetrates`]: the first that is.
    pub fn refuse_penetration(&self, d: &'static Description, tolerance: f64) -> Result<(), Error> {
        let near = slack(tolerance);
        match self.gaps.iter().find(|(_, gap, size)| -gap > near * size) {
            None => Ok(()),
            Some(&(c, gap, size)) => Err(Error::Penetrates {
                item: d.contacts[c].name,
                gap,
                tolerance: near * size,
            }),
        }
    }

    /// The contacts that are penetrated.
    pub fn penetrated(&self, tolerance: f64) -> impl Iterator<Item = usize> {
        let near = slack(tolerance);
        let gaps = self.gaps.iter();
        gaps.filter_map(move |&(c, gap, size)| (-gap > near * size).then_some(c))
    }

    /// The closed contacts above their surface.
    pub fn above(&self) -> impl Iterator<Item = usize> {
        let gaps = self.gaps.iter();
        gaps.filter_map(|&(c, gap, _)| (gap > 0.0 && self.mode.contacts[c]).then_some(c))
    }

    fn look_at_contact<T: Scalar>(&mut self, c: usize, view: &View<T>) {
        let d = view.dynamics.description();
        let contact = &d.contacts[c];
        let (near, extent) = (view.near, view.extent(contact.row));
        let row = &d.rows[contact.row];
        let gap = view.number(row.position.unwrap_or(ValueRef::Zero));
        let region = contact.region.map_or(0.0, |place| view.number(place));
        if region < -near * extent {
            self.below.extend((gap < 0.0).then_some(c));
            return;
        }
        self.gaps.push((c, gap, extent));
        if gap.abs() > near * extent || self.apart.contains(&c) {
            return;
        }
        let rate = view.number(row.velocity);
        let size = view.speed(contact.row);
        if rate > near * size {
            self.facts.parting[c] = true;
        } else {
            self.facts.touching[c] = true;
            self.facts.arriving[c] = rate < -near * size;
            self.mode.contacts[c] = !self.facts.arriving[c];
        }
    }

    fn look_at_friction<T: Scalar>(&mut self, f: usize, view: &View<T>) {
        let d = view.dynamics.description();
        let friction = &d.frictions[f];
        if !friction.normal.presses(d, |c| self.mode.contacts[c]) {
            return;
        }
        let rows = friction.rows();
        let slip = |row: usize| view.number(d.rows[row].velocity);
        // In a dead centre the slip is small however fast the motion is: that is no rest.
        let rests = |row| slip(row).abs() <= view.near * view.speed(row);
        if rows.clone().all(rests) {
            self.facts.resting[f] = true;
            self.mode.frictions[f] = FrictionMode::Stick;
            return;
        }
        self.mode.frictions[f] = FrictionMode::Slip(Sliding {
            direction: Direction::of_slip(rows.map(slip)),
            normal_sign: 1.0,
        });
    }

    fn look_at_constraint<T: Scalar>(&mut self, i: usize, view: &View<T>) {
        let d = view.dynamics.description();
        let constraint = &d.constraints[i];
        if constraint
            .while_contact
            .is_some_and(|c| !self.mode.contacts[c])
        {
            return;
        }
        let index = constraint.row;
        let row = &d.rows[index];
        if let Some(place) = row.position {
            let residual = view.number(place);
            self.residuals
                .push((index, Level::Position, residual, view.extent(index)));
        }
        let rate = view.number(row.velocity);
        self.residuals
            .push((index, Level::Velocity, rate, view.speed(index)));
    }
}

/// A state whose tape has run, and what counts as zero there.
struct View<'a, T: Scalar> {
    dynamics: &'a Dynamics<T>,
    state: &'a State<T>,
    /// Relative to sizes.
    near: f64,
    /// Per coordinate, where they are given: the size below which its errors are absolute.
    sizes: &'a [f64],
    /// What makes their absolute tolerances of these.
    least: f64,
}

impl<T: Scalar> View<'_, T> {
    fn number(&self, place: ValueRef) -> f64 {
        self.dynamics.motion(place).value()
    }

    /// Size of the position of a row: what it changes by when each coordinate changes by its size.
    fn extent(&self, row: usize) -> f64 {
        self.sum(row, |j| self.state.q[j].value().abs())
    }

    /// Size of the rate of a row.
    fn speed(&self, row: usize) -> f64 {
        self.sum(row, |j| self.state.v[j].value().abs())
    }

    /// The sum of the terms of a row for coordinates or velocities of their size, or of that below which errors are absolute.
    fn sum(&self, row: usize, size: impl Fn(usize) -> f64) -> f64 {
        let least = |j: usize| match self.sizes {
            [] => 1.0,
            _ => self.least * least_size(self.sizes, j),
        };
        let size = |j: usize| size(j).max(least(j));
        self.dynamics.size_of_row(row, size)
    }
}

/// Puts every branch that the motion depends on where `side` says, of its number and the value of its guard, until none moves: the guard of one may depend
/// on the side of another. Whether any has moved; the numbers of these needs are left in `dynamics`.
pub fn take_sides<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    t: T,
    state: &State<T>,
    needs: &OutputMask,
    mode: &mut Mode,
    mut side: impl FnMut(usize, f64) -> Option<bool>,
) -> bool {
    let d = dynamics.description();
    let evaluate = |dynamics: &mut Dynamics<T>, mode: &Mode| {
        dynamics.set_mode(mode);
        dynamics.set_extra_needs(needs);
        dynamics.tape(t, &state.q, &state.v);
    };
    evaluate(dynamics, mode);
    let mut moved = false;
    for _ in 0..d.branches.len() {
        let mut changed = false;
        let branches = d.branches.iter().enumerate();
        for (b, branch) in branches.filter(|(_, branch)| !branch.after_solve) {
            let guard = dynamics.motion(branch.guard).value();
            if let Some(side) = side(b, guard).filter(|side| *side != mode.branch(b)) {
                mode.set_branch(b, side);
                changed = true;
            }
        }
        if !changed {
            break;
        }
        moved = true;
        evaluate(dynamics, mode);
    }
    moved
}
