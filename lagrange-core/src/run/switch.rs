//! A switch: forces just before, impact if something is hit, the next mode, the log.

use super::accumulation::{Impacts, Train};
use super::hidden::Hidden;
use super::{Progress, Run};
use crate::arithmetic::{Scalar, epsilon};
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::decide::Decider;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard};
use crate::modes::held::HeldBranches;
use crate::modes::impact::Collider;
use crate::modes::redundant::RedundantForces;
use crate::modes::status::ConstraintStatus;
use crate::modes::table::Table;
use crate::pool::Pool;
use crate::system::{Description, Normal};
use crate::trajectory::State;

/// Sums of the terms of a step are off by no more than so many units of rounding.
const UNITS: f64 = 8.0;

/// What decides how the motion goes on.
#[derive(Debug)]
pub(super) struct Switcher<T> {
    pub(super) status: ConstraintStatus,
    pub(super) collider: Collider<T>,
    /// Branches that what touches holds at their border.
    pub(super) held: HeldBranches<T>,
    /// How a gap changes with the coordinates, here and beside, behind a basis of what constraints do not leave free.
    pub(super) gradients: [Vec<f64>; 2],
    /// Guards that the mode up to the switch watches.
    pub(super) watched: Vec<Guard>,
    /// The conditions of branches before an impact.
    pub(super) conditions: Vec<f64>,
    /// Values of guards after a flight through impacts that accumulate.
    pub(super) guards: Vec<f64>,
    /// Contacts whose gap vanishes at an impact.
    pub(super) near: Vec<usize>,
    /// Per contact: its impacts so far.
    pub(super) impacts: Vec<Impacts<T>>,
    /// All impacts so far.
    pub(super) train: Train,
    /// The state before contacts are closed whose impacts have died out, or what comes to rest is held.
    pub(super) before_holding: State<T>,
    /// Frictions whose slips may end with others.
    pub(super) ending: Vec<usize>,
    /// What is known where a flight through impacts that accumulate begins.
    pub(super) flying: SwitchFacts,
    /// The mode of a flight through impacts that accumulate.
    pub(super) scratch_mode: Mode,
    pub(super) decider: Decider<T>,
    pub(super) table: Table,
    /// Of undetermined forces at the present state.
    pub(super) redundant: RedundantForces<T>,
    /// Modes of the switches since time last advanced.
    pub(super) stuck: Pool<Mode>,
    /// Switches so far of which nothing was logged.
    pub(super) silent: usize,
    /// When the present mode began, s.
    pub(super) since: f64,
}

impl<T: Scalar> Switcher<T> {
    pub(super) fn new(d: &'static Description, state: &State<T>, mode: &Mode) -> Self {
        let contacts = d.contacts.len();
        Switcher {
            status: ConstraintStatus::new(d),
            collider: Collider::default(),
            held: HeldBranches::default(),
            gradients: [Vec::new(), Vec::new()],
            watched: Vec::new(),
            conditions: Vec::new(),
            guards: Vec::new(),
            near: Vec::with_capacity(contacts),
            impacts: vec![Impacts::default(); contacts],
            train: Train::default(),
            before_holding: state.clone(),
            ending: Vec::with_capacity(d.frictions.len()),
            flying: SwitchFacts::default(),
            scratch_mode: mode.clone(),
            decider: Decider::new(d),
            table: Table::default(),
            redundant: RedundantForces::default(),
            stuck: Pool::default(),
            silent: 0,
            since: 0.0,
        }
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        self.impacts.iter_mut().for_each(Impacts::restart);
        self.train.restart();
        self.redundant.restart();
        self.stuck.clear();
        self.silent = 0;
        self.decider.restart();
    }
}

impl<T: Scalar> Run<T> {
    /// Leaves the present mode because the guards in `self.locator.fallen` fell through zero.
    pub(super) fn switch(&mut self) -> Result<(), Error> {
        let d = self.description();
        if !self.locator.rests.is_empty() {
            self.come_to_rest()?;
        }
        let roots = self.hidden.as_ref();
        let roots = roots.is_some_and(Hidden::has_roots_of_rates);
        let mut fallen = self.locator.fallen.iter();
        if roots && fallen.any(|guard| matches!(guard, Guard::Slip(_))) {
            self.drop_rounding_of_velocities();
        }
        if self.is_at_edge() {
            self.hold_rows();
        }
        if !self.now.valued {
            self.evaluate()?;
        }
        // What decides reads other numbers, and leaves them.
        let of_composites = self.residue_of_composites();
        let facts = &mut self.switcher.status.facts;
        facts.clear(d);
        facts.residue = self
            .switcher
            .decider
            .residue(&mut self.dynamics, &self.now.mode, &self.locator.fallen)
            .max(of_composites);
        facts.lasted = self
            .stepper
            .step
            .h
            .value()
            .max(self.now.t.value() - self.switcher.since);
        facts.touching.copy_from_slice(&self.now.mode.contacts);
        for (resting, friction) in facts.resting.iter_mut().zip(&self.now.mode.frictions) {
            *resting = friction.rests();
        }
        for &guard in &self.locator.fallen {
            match guard {
                Guard::Gap(c) => (facts.touching[c], facts.arriving[c]) = (true, true),
                Guard::Slip(f) => facts.resting[f] = true,
                Guard::Branch(b) => facts.balanced[b] = !guard.is_of_outputs(d),
                _ => {}
            }
        }
        // Slips that were zero at this very instant still are, and those that the mode has kept at zero since it began: a contact holds what they rub on.
        let decided = self.switcher.decider.decision.zeros.iter();
        let kept = decided.filter(|(_, order)| *order >= guard::LENGTH);
        for &(guard, _) in self.locator.zeros.iter().chain(kept) {
            if let Guard::Slip(f) = guard {
                facts.resting[f] = true;
            }
        }
        self.hand_over();
        let facts = &mut self.switcher.status.facts;
        let composites = &self.locator.polynomials.composites;
        // A force of several constraints that has turned ends no mode: its friction slips on, pressed in another direction.
        let goes_on = |guard: &Guard| match *guard {
            Guard::NormalForceSign(f) => matches!(d.frictions[f].normal, Normal::Resultant(_)),
            _ => false,
        };
        facts.again = self.switcher.stuck.len() > 1;
        // Nor does what only outputs depend on.
        let fallen = self.locator.fallen.iter();
        for guard in fallen.filter(|guard| !guard.is_of_outputs(d)) {
            let roots = match goes_on(guard) {
                true => &mut facts.touched,
                false => &mut facts.located,
            };
            roots.push(*guard);
            if let Guard::Composite(k) = *guard {
                roots.extend(composites[k].parts.iter().map(|part| part.guard));
            }
        }
        self.knowing(|run, facts| {
            run.strike_with_what_falls(facts);
            run.settle_knowing(facts)
        })
    }

    /// Where a slip has come to zero, what rounding leaves of the velocities in the step is zero too: along a curved path a drag by |v| would
    /// begin anew from it, at another angle.
    fn drop_rounding_of_velocities(&mut self) {
        let step = &self.stepper.step;
        for (j, v) in self.now.state.v.iter_mut().enumerate() {
            let row = step.velocity_row(j);
            let size = row[0].value().abs() + row[1].value().abs();
            let rest = v.value();
            if rest != 0.0 && rest.abs() <= UNITS * epsilon::<T>() * size {
                *v -= T::from_f64(rest);
                self.now.valued = false;
            }
        }
    }

    /// Impact if needed, then the next mode; logs what changed. `self.switcher.status.facts` says what vanishes at this instant.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        self.knowing(Self::settle_knowing)
    }

    /// Does something with the facts of this instant, which are then put back, whatever came of it.
    pub(super) fn knowing<R>(&mut self, act: impl FnOnce(&mut Self, &mut SwitchFacts) -> R) -> R {
        let mut facts = core::mem::take(&mut self.switcher.status.facts);
        let outcome = act(self, &mut facts);
        self.switcher.status.facts = facts;
        outcome
    }

    fn settle_knowing(&mut self, facts: &mut SwitchFacts) -> Result<(), Error> {
        let hit = self.meet(facts)?;
        self.decide(facts)?;
        while self.leave_edges(facts) {
            self.decide(facts)?;
        }
        self.locator
            .zeros
            .clone_from(&self.switcher.decider.decision.zeros);
        let edges = self
            .locator
            .fallen
            .iter()
            .filter(|g| matches!(g, Guard::Region(_)));
        self.locator.zeros.extend(edges.map(|&edge| (edge, 1)));
        // A gap that has fallen and is not hit has no gradient.
        let passes = |guard: &&Guard| matches!(**guard, Guard::Gap(c) if !hit && !facts.touching[c] && !facts.parting[c]);
        let grazing = self.locator.fallen.iter().filter(passes);
        let grazing = grazing.map(|&gap| (gap, guard::LENGTH));
        self.locator.zeros.extend(grazing);
        self.switcher.since = self.now.t.value();
        self.set_mode_decided();
        self.refuse_derivatives_of_directions()?;
        self.let_lie();
        self.let_enter();
        if self.switcher.decider.decision.expanded {
            self.now.series = Progress::Complete;
        }
        if !hit && let Err(refused) = self.refuse_corners() {
            // No motion goes on in the mode that is refused: its energies are not those at the end.
            let before = &self.recorder.before.mode;
            self.recorder.trajectory.enter(before);
            return Err(refused);
        }
        if hit || self.rows_have_joined() {
            self.project(true)?;
        }
        self.begin_series().map_err(|e| self.error(e))?;
        self.take_sides_of_outputs()?;
        self.note_forces_that_begin();
        self.switcher.decider.decision.ambiguous |= self.slips_in_name();
        if self.dynamics.has_dependent_rows() {
            let valued = self.now.valued;
            self.evaluate_all_rows()?;
            self.switcher.decider.decision.ambiguous |= self.dynamics.leaves_motion_open();
            self.ask_for_guards();
            self.now.series = Progress::None;
            self.expand()?;
            self.evaluate()?;
            self.now.valued = valued;
            self.note_redundant_forces();
            self.refuse_watches_of_bounded_shares()?;
            // What sticks beside what slides holds by a load that it would not have on equal springs.
            let bent = (self.switcher.redundant).bend_loads_of_slips(&self.dynamics);
            self.switcher.decider.decision.ambiguous |= bent;
        } else {
            self.switcher.redundant.clear();
        }
        let impulses = core::mem::take(&mut self.switcher.collider.outcome.impulses);
        let told = if hit { &impulses[..] } else { &[] };
        self.log_changes(told, self.switcher.decider.decision.ambiguous);
        self.switcher.collider.outcome.impulses = impulses;
        self.stops_of_the_mode()
    }

    /// A slip of two components that begins has a direction that is found in plain numbers.
    fn refuse_derivatives_of_directions(&self) -> Result<(), Error> {
        match self.now.mode.incipient().next() {
            Some((f, _)) if T::DERIVATIVES > 0 => Err(Error::NoDerivatives {
                time: self.now.t.value(),
                item: self.description().frictions[f].name,
            }),
            _ => Ok(()),
        }
    }

    /// Whether a friction slips in name only: others hold what it rubs on, and its force need not be that of a slip.
    fn slips_in_name(&self) -> bool {
        let in_name = |&(guard, order): &(Guard, usize)| match guard {
            Guard::Slip(f) if order >= guard::LENGTH => {
                let coefficient = self.description().frictions[f].kinetic_coefficient;
                !self.dynamics.motion(coefficient).is_zero()
            }
            _ => false,
        };
        self.locator.zeros.iter().any(in_name)
    }

    /// Forces of several constraints that vanish at this instant begin in the direction in which their frictions are pressed.
    fn note_forces_that_begin(&mut self) {
        for (f, friction) in self.description().frictions.iter().enumerate() {
            if let Normal::Resultant(i) = friction.normal
                && let Some(order) = self.dynamics.resultant_order(i).filter(|&order| order > 0)
            {
                let guard = Guard::NormalForceSign(f);
                self.locator.zeros.push((guard, order));
            }
        }
    }

    /// A gap that stays zero because other contacts are closed is off by the error of positions, on either side.
    fn let_lie(&mut self) {
        let zeros = self.locator.zeros.iter();
        let lying = zeros
            .filter(|(guard, order)| matches!(guard, Guard::Gap(_)) && *order >= guard::LENGTH);
        self.locator.lies = false;
        for &(gap, _) in lying {
            self.locator.lies = true;
            self.locator.polynomials.lower(gap, self.settings.tolerance);
        }
    }

    /// The forces just before, and the impact if something is hit; whether one was.
    pub(super) fn meet(&mut self, facts: &mut SwitchFacts) -> Result<bool, Error> {
        let arrives = facts.arriving.contains(&true);
        if arrives && !self.is_undecided() {
            // Rows that depend on each other where constraints are satisfied, as those of two points of a body that an impact holds, are independent by what
            // is left of a residual, and no impulse satisfies them.
            self.project(true)?;
        }
        self.take_sides_not_watched();
        if !self.now.valued {
            self.evaluate()?;
        }
        self.remember_before();
        self.take_sides_that_jumped(facts);
        self.note_edges_held();
        let hit = arrives && self.hit(facts)?;
        if self.is_at_edge() {
            self.leave_regions(hit, facts);
        }
        if hit {
            self.take_what_impact_leaves(facts);
        }
        // What leaves an edge may be on another surface, and where a surface bends by a branch it may come to rest where a body is.
        let of_surfaces = |guard: &Guard| matches!(guard, Guard::Region(_) | Guard::Branch(_));
        // A gap that has just begun to open may still be as good as closed, where something else changes at once; and what lies on a surface without
        // a load may be loaded again.
        let near_surfaces = arrives || self.locator.opened || self.locator.lies;
        if near_surfaces || facts.located.iter().any(of_surfaces) {
            self.take_what_touches(facts);
        }
        if !hit {
            self.rest_where_slip_vanishes(facts);
            self.rest_with_what_comes_to_rest(facts);
            self.slips_begin_anew(facts);
        }
        self.balance_what_is_held(facts);
        Ok(hit)
    }

    /// What is at rest after an impact, and on which sides of conditions.
    pub(super) fn take_what_impact_leaves(&mut self, facts: &mut SwitchFacts) {
        self.rest_where_impact_leaves_nothing(facts);
        self.take_sides_after_impact(facts);
    }

    /// Whether the switch has brought rows that the state need not satisfy to rounding.
    fn rows_have_joined(&self) -> bool {
        let (before, after) = (&self.recorder.before.mode, &self.now.mode);
        let mut contacts = before.contacts.iter().zip(&after.contacts);
        let mut frictions = before.frictions.iter().zip(&after.frictions);
        contacts.any(|(before, after)| !before & after)
            || frictions.any(|(before, after)| before != after && *after == FrictionMode::Stick)
            || before.branches != after.branches
    }
}
