//! Which mode comes next: complementarity just after an instant.
//!
//! At the instant itself inequalities decide nothing: at a smooth lift-off λ = 0 and g̈ = 0 together. A candidate
//! mode is therefore solved as a Taylor series, and it is feasible only if each of its guards is positive *just
//! after* the instant: the first coefficient that does not vanish is positive (Brogliato 2016, section 5.4;
//! Lötstedt 1982). What is known to vanish (a gap that was closed, a located root) is never read.
//!
//! [`candidates`] writes down the modes that what is known allows, [`examine`] says of one whether it is feasible; where they are
//! many, [`pivot`] goes from one to the next.

mod candidates;
mod examine;
mod guess;
mod incipient;
mod just_after;
mod parts;
mod pivot;
mod questions;
mod together;

pub use just_after::terms;

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, OutputMask};
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::composite::CompositeGuard;
use crate::modes::facts::{SwitchContext, SwitchFacts};
use crate::modes::guard::{self, Guard};
use crate::modes::held::HeldBranches;
use crate::modes::reading::Reading;
use crate::modes::redundant::RedundantForces;
use crate::modes::scale::Sizes;
use crate::modes::table::Table;
use crate::system::{Constraint, Description};
use candidates::{Candidates, Listings, MOST_CANDIDATES};
use incipient::Beginning;
use parts::Parts;
use questions::Doubt;

/// Accelerations that differ by no more than this share of the largest are the same,
const SAME: f64 = 1e-9;

/// and so are those that differ by no more than this share of what drives them.
const STILL: f64 = 1e-12;

/// The mode that goes on.
#[derive(Clone, Debug)]
pub struct Decision {
    /// The mode.
    pub mode: Mode,
    /// Guards with leading coefficients that vanish, and how many.
    pub zeros: Vec<(Guard, usize)>,
    /// Forces that stay zero as far as their series go, with the size of what makes them.
    pub at_limit: Vec<(Guard, f64)>,
    /// Whether another mode with another motion was feasible too.
    pub ambiguous: bool,
    /// Per branch: whether the mode holds it at its border.
    pub held: Vec<bool>,
    /// Composite guards that are at their border, or near it.
    pub composites: Vec<CompositeGuard>,
    /// Whether the dynamics hold the series of this mode at the moment, for the needs of its guards.
    pub expanded: bool,
}
/// Memory of decisions, and the last one.
#[derive(Clone, Debug)]
pub struct Decider<T> {
    /// What was found last.
    pub decision: Decision,
    listings: Listings,
    /// Per contact: its part of the system is decided on later.
    undecided: Vec<bool>,
    questions: Vec<(Guard, usize)>,
    zeros: Vec<(Guard, usize)>,
    at_limit: Vec<(Guard, f64)>,
    /// Guards that may be rounding.
    doubtful: Vec<Doubt>,
    /// What forbids the candidate examined last.
    violated: Vec<Guard>,
    redundant: RedundantForces<T>,
    composites: Vec<CompositeGuard>,
    motion: Vec<f64>,
    /// Branches that the candidate examined last holds at their border.
    held: HeldBranches<T>,
    sizes: Sizes,
    /// Whether the sizes belong to the present state.
    sized: bool,
    /// Whether a friction that would slip and yet stay at rest must stick.
    sticks_first: bool,
    /// Whether a contact that others hold closed may carry nothing.
    lies_loosely: bool,
    /// Whether what others hold at rest may slip in no direction.
    slips_in_name: bool,
    /// Modes tried so far.
    tried: usize,
    /// Needs of everything about every row.
    rows: OutputMask,
    /// Needs of all rows and of the motion in any mode.
    everything: OutputMask,
    /// The candidate under examination, with the directions in which its slips begin.
    posed: Mode,
    /// The best candidate so far, with the directions in which its slips begin.
    best: Mode,
    /// Whether its slip could begin in another direction.
    forks: bool,
    beginning: Beginning,
}

impl<T: Scalar> Decider<T> {
    /// Memory for a system.
    pub fn new(description: &Description) -> Self {
        let rows = guard::all_row_needs(description, &OutputMask::new(description));
        let mut everything = rows.clone();
        for row in description.rows {
            everything.insert(row.needs.bias);
        }
        Self {
            decision: Decision {
                mode: Mode::open(description),
                zeros: Vec::new(),
                at_limit: Vec::new(),
                ambiguous: false,
                held: Vec::new(),
                composites: Vec::new(),
                expanded: false,
            },
            listings: Listings::default(),
            undecided: vec![false; description.contacts.len()],
            questions: Vec::new(),
            zeros: Vec::new(),
            at_limit: Vec::new(),
            doubtful: Vec::new(),
            violated: Vec::new(),
            redundant: RedundantForces::default(),
            composites: Vec::new(),
            motion: Vec::new(),
            held: HeldBranches::default(),
            sizes: Sizes::default(),
            sized: false,
            sticks_first: false,
            lies_loosely: false,
            slips_in_name: false,
            tried: 0,
            rows,
            everything,
            posed: Mode::open(description),
            best: Mode::open(description),
            forks: false,
            beginning: Beginning::default(),
        }
    }

    /// Forgets what belongs to another motion.
    pub fn restart(&mut self) {
        self.sized = false;
        self.redundant.restart();
    }

    /// Finds the mode in which the motion goes on, into [`Self::decision`].
    ///
    /// On success `dynamics` is left in that mode. Where a few modes are possible all are looked at; the order of preference among
    /// feasible ones is: none before those with contacts that are open and yet lie, stick before slip, closed before open, then the present mode, then
    /// the fewest changes, then that what has been overcome lets go. Where they are many, see [`pivot`], and where there is none, [`together`].
    ///
    /// # Errors
    /// [`Error::NoMode`] if no candidate is feasible (Painlevé's paradox).
    pub fn decide(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<(), Error> {
        let d = dynamics.description();
        let time = here.moment.t.value();
        // Those of the mode that ends, taken for the residue, serve if the state is the same.
        self.sized &= !here.facts.jumped;
        let refused = match self.decide_with(dynamics, table, here) {
            Ok(true) => None,
            Ok(false) => Some(None),
            Err(error) => {
                let mode = dynamics.mode();
                Some(Some(Error::from_evaluation(error, time, mode, d)))
            }
        };
        let tried = self.tried;
        if let Some(error) = refused
            && !self.goes_on(dynamics, table, here, false)
            && !self.decide_together(dynamics, table, here)
            && !self.goes_on(dynamics, table, here, true)
        {
            return Err(error.unwrap_or_else(|| self.no_mode(dynamics, table, here, tried)));
        }
        core::mem::swap(&mut self.decision.mode, &mut self.best);
        dynamics.set_mode(&self.decision.mode);
        Ok(())
    }

    /// Looks for a feasible mode, into `self.best`. False: there is none.
    ///
    /// # Errors
    /// None was found, and one could not be evaluated.
    fn decide_with(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<bool, EvaluationError> {
        let mut listings = core::mem::take(&mut self.listings);
        let scratch = &mut self.decision.mode;
        self.tried = 0;
        let outcome = match listings.list(dynamics, here, &self.rows, scratch) {
            Some(few) => self.search(dynamics, table, here, few),
            None => self.decide_among_many(dynamics, table, here, &mut listings),
        };
        self.listings = listings;
        outcome
    }

    /// The same where more modes are possible than are all looked at.
    fn decide_among_many(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        listings: &mut Listings,
    ) -> Result<bool, EvaluationError> {
        if let Ok(true) = self.part_by_part(dynamics, table, here, listings) {
            return Ok(true);
        }
        let outcome = self.pivot(dynamics, table, here);
        let found = matches!(outcome, Ok(true));
        if found && !is_loose(&self.decision.zeros, &self.best, dynamics.description()) {
            return Ok(true);
        }
        // What pivoting does not find is among all of them.
        let scratch = &mut self.decision.mode;
        if let Some(all) = listings.list_all(dynamics, here, &self.rows, scratch)
            && let Ok(true) = self.search(dynamics, table, here, all)
        {
            return Ok(true);
        }
        self.decision.ambiguous |= found;
        if found {
            return Ok(true);
        }
        let loosely = self.loosely(|decider| decider.pivot(dynamics, table, here));
        if let Ok(true) = loosely {
            loosely
        } else {
            outcome
        }
    }

    /// Looks for a mode in which a contact that others hold closed carries nothing, as of a block that slides on three supports in a row, one of which is
    /// rough; and then for one in which what others hold at rest slips in no direction.
    fn loosely<E>(
        &mut self,
        mut find: impl FnMut(&mut Self) -> Result<bool, E>,
    ) -> Result<bool, E> {
        let mut outcome = Ok(false);
        for slips_in_name in [false, true] {
            (self.lies_loosely, self.slips_in_name) = (true, slips_in_name);
            outcome = find(self);
            if let Ok(true) = outcome {
                break;
            }
        }
        (self.lies_loosely, self.slips_in_name) = (false, false);
        outcome
    }

    /// The same with everything that vanishes at the instant as far as can be told; whether a mode was found.
    fn decide_together(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> bool {
        self.together(dynamics, table, here).is_some_and(|facts| {
            let joined = SwitchContext {
                facts: &facts,
                ..here
            };
            matches!(self.decide_with(dynamics, table, joined), Ok(true))
        })
    }

    /// Looks for a feasible mode of each part of the system that is concerned, one after the other, and looks at all together.
    fn part_by_part(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        listings: &mut Listings,
    ) -> Result<bool, EvaluationError> {
        let outcome = self.parts_in_turn(dynamics, table, here, listings, |_, _| ());
        self.undecided.fill(false);
        outcome
    }

    /// The part that has no mode, among several.
    fn part_without_mode(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Option<(Parts, usize)> {
        let mut listings = core::mem::take(&mut self.listings);
        let mut found = None;
        let note = |parts, part| found = Some((parts, part));
        // What cannot be evaluated is no answer.
        _ = self.parts_in_turn(dynamics, table, here, &mut listings, note);
        self.undecided.fill(false);
        self.listings = listings;
        found
    }

    fn parts_in_turn(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        listings: &mut Listings,
        without_mode: impl FnOnce(Parts, usize),
    ) -> Result<bool, EvaluationError> {
        let d = dynamics.description();
        let parts = Parts::of(d, dynamics.effects(), here.facts);
        // Branches act on everything.
        if parts.count < 2 || here.facts.balanced.contains(&true) {
            return Ok(false);
        }
        let mut whole = here.present.clone();
        let concerned = (0..parts.count).filter(|&part| parts.is_concerned(part, here, d));
        for part in concerned.clone() {
            parts.release(part, &mut whole);
            let contacts = self.undecided.iter_mut().zip(&parts.contacts);
            contacts.for_each(|(undecided, of)| *undecided |= *of == part);
        }
        let mut ambiguous = false;
        for part in concerned {
            let contacts = self.undecided.iter_mut().zip(&parts.contacts);
            contacts.for_each(|(undecided, of)| *undecided &= *of != part);
            let Some(candidates) =
                listings.list_part(dynamics, here, &self.rows, &mut whole, (&parts, part))
            else {
                return Ok(false);
            };
            if !self.search(dynamics, table, here, candidates)? {
                without_mode(parts, part);
                return Ok(false);
            }
            ambiguous |= self.decision.ambiguous;
            whole.clone_from(&self.best);
        }
        let feasible = !here.ends(&whole) && self.examine(dynamics, table, here, &whole)?;
        if feasible {
            self.decision.ambiguous = ambiguous;
            self.keep(dynamics);
        }
        Ok(feasible)
    }

    /// Looks for a feasible mode among these.
    fn search(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        candidates: &Candidates,
    ) -> Result<bool, EvaluationError> {
        let outcome = self.search_strictly(dynamics, table, here, candidates);
        let found = matches!(outcome, Ok(true));
        if found && !self.lets_go(here.facts) {
            return outcome;
        }
        let sticking = found.then(|| sticks(&self.best));
        let loosely =
            self.loosely(|decider| decider.search_strictly(dynamics, table, here, candidates));
        let more = |sticking| sticks(&self.best) > sticking;
        if matches!(loosely, Ok(true)) && sticking.is_none_or(more) {
            return loosely;
        }
        if found {
            return self.search_strictly(dynamics, table, here, candidates);
        }
        outcome
    }

    /// Whether a friction begins to slip in the best mode while a contact opens, or is open, that touches: it may be that the contact carries nothing and the
    /// friction holds, which is looked for loosely.
    fn lets_go(&self, facts: &SwitchFacts) -> bool {
        let mut frictions = self.best.frictions.iter().zip(&facts.resting);
        let mut contacts = self.best.contacts.iter().zip(&facts.touching);
        frictions.any(|(mode, &resting)| resting && matches!(mode, FrictionMode::Slip(_)))
            && contacts.any(|(&closed, &touching)| touching && !closed)
    }

    fn search_strictly(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        candidates: &Candidates,
    ) -> Result<bool, EvaluationError> {
        match self.best(dynamics, table, here, candidates) {
            Ok(true) => Ok(true),
            refused => match self.best_exactly(dynamics, table, here, candidates) {
                Ok(true) => Ok(true),
                _ => refused,
            },
        }
    }

    /// All modes in which the motion can go on, the preferred ones first; without those that accelerate as one before them.
    ///
    /// # Errors
    /// [`Error::NoMode`] if there is none, [`Error::Limit`] if there are too many candidates.
    pub fn feasible(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
    ) -> Result<Vec<Mode>, Error> {
        let d = dynamics.description();
        let time = here.moment.t.value();
        let mut listings = core::mem::take(&mut self.listings);
        self.sized = false;
        let scratch = &mut self.decision.mode;
        let listed = listings.list(dynamics, here, &self.rows, scratch);
        let Some(candidates) = listed else {
            self.listings = listings;
            return Err(Error::Limit {
                time,
                what: "modes to be tried",
                limit: MOST_CANDIDATES,
            });
        };
        let (mut feasible, mut failure) = (Vec::new(), None);
        let mut motions: Vec<Vec<f64>> = Vec::new();
        self.tried = candidates.iter().count();
        for mode in candidates.iter() {
            match self.examine(dynamics, table, here, mode) {
                Ok(true) => {
                    let motion = dynamics.acceleration().iter().map(|a| a.value());
                    let motion: Vec<f64> = motion.collect();
                    self.measure(dynamics, here.facts);
                    if motions.iter().all(|other| self.differ(other, &motion)) {
                        motions.push(motion);
                        feasible.push(self.posed.clone());
                    }
                }
                Ok(false) => {}
                Err(error) => failure = Some(Error::from_evaluation(error, time, mode, d)),
            }
        }
        // What a run takes may be one in which a contact carries nothing of what others hold.
        if let Ok(true) = self.search(dynamics, table, here, candidates)
            && motions.iter().all(|other| self.differ(other, &self.motion))
        {
            feasible.insert(0, self.best.clone());
        }
        self.listings = listings;
        match (feasible.is_empty(), failure) {
            (true, Some(error)) => Err(error),
            (true, None) => Err(self.no_mode(dynamics, table, here, self.tried)),
            (false, _) => Ok(feasible),
        }
    }

    fn no_mode(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        tried: usize,
    ) -> Error {
        let d = dynamics.description();
        let part = self.part_without_mode(dynamics, table, here);
        let within = |guard: Guard| {
            part.as_ref()
                .is_none_or(|(parts, part)| parts.has(*part, guard))
        };
        let item = concerned(d, here.facts, here.present, within);
        let holds = |(i, constraint): (usize, &Constraint)| {
            let contact = &d.contacts[constraint.while_contact?];
            let included = dynamics.effects().includes(d, Item::Constraint(i));
            (contact.name == item && included).then_some(constraint.name)
        };
        Error::NoMode {
            time: here.moment.t.value(),
            mode: here.present.display(d).to_string(),
            item,
            tried,
            friction: dynamics.has_frictions(),
            branches: !d.branches.is_empty(),
            held: d.constraints.iter().enumerate().find_map(holds),
        }
    }

    /// Takes the sizes of what guards are made of from the outputs that `dynamics` hold of the present state.
    pub fn take_sizes(&mut self, dynamics: &Dynamics<T>) {
        self.sizes.take(dynamics);
        self.sized = true;
    }

    /// The size of the forces of the mode that was looked at last where they do not cancel, the largest of all rows that act.
    pub fn size_of_forces(&self) -> f64 {
        self.sizes.of_forces()
    }

    /// The momentum of all coordinates with these speeds.
    pub fn momentum(&self, speeds: impl Iterator<Item = f64>) -> f64 {
        self.sizes.momentum(speeds)
    }

    /// The size of accelerations where forces do not cancel, the largest of all coordinates; `dynamics` holds the numbers of all rows at the present state.
    pub fn size_of_accelerations(&mut self, dynamics: &Dynamics<T>) -> f64 {
        self.take_sizes(dynamics);
        let coordinates = 0..dynamics.description().coordinates.len();
        let sizes = coordinates.map(|j| self.sizes.of_coordinate(j));
        sizes.fold(0.0, f64::max)
    }

    /// See [`SwitchFacts::residue`]; `dynamics` holds the values of the moment in the mode that ends.
    pub fn residue(&mut self, dynamics: &mut Dynamics<T>, mode: &Mode, located: &[Guard]) -> f64 {
        let forces = located.iter().filter(|guard| guard.is_single_force());
        let mut forces = forces.peekable();
        self.sized = false;
        if forces.peek().is_some() {
            dynamics.complete_outputs();
            self.take_sizes(dynamics);
        }
        let reading = Reading::Values(dynamics);
        let relative = |&guard: &Guard| {
            let value = guard::value(guard, mode, &reading);
            let size = self.sizes.of(guard, dynamics);
            value.abs() / size.max(f64::MIN_POSITIVE)
        };
        forces.map(relative).fold(0.0, f64::max)
    }

    /// The guard of a force in the mode given, and the size of the terms that it is made of; `dynamics` holds values.
    pub fn force(&mut self, dynamics: &mut Dynamics<T>, mode: &Mode, guard: Guard) -> (f64, f64) {
        dynamics.complete_outputs();
        self.sizes.take(dynamics);
        self.sized = false;
        let reading = Reading::Values(dynamics);
        let value = guard::value(guard, mode, &reading);
        (value, self.sizes.of(guard, dynamics))
    }

    /// Looks for the feasible candidate to be preferred, into `self.best`. False: there is none.
    ///
    /// # Errors
    /// None is feasible, and one could not be evaluated. That what one holds contradicts itself there is no error where others hold less.
    fn best(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        candidates: &Candidates,
    ) -> Result<bool, EvaluationError> {
        self.tried = 0;
        let (mut best, mut failure, mut evaluated) = (None::<Found>, None, false);
        // Without friction the accelerations are the only ones that Gauss's principle allows: no other mode has others.
        let idle = |mode: &Mode| mode.frictions.iter().all(|f| *f == FrictionMode::Inactive);
        let unique = dynamics.description().couplings.is_empty()
            && !here.facts.balanced.contains(&true)
            && candidates.iter().all(idle);
        for mode in candidates.iter() {
            self.tried += 1;
            if here.ends(mode) {
                continue;
            }
            // Stick is preferred to slip without being ambiguous (μs > μk allows both).
            let holds = |found: Found| !found.loose || self.lies_loosely;
            let passes = |found: Found| unique || holds(found) && found.sticks > sticks(mode);
            if best.is_some_and(passes) {
                continue;
            }
            self.decision.expanded = false;
            let outcome = self.examine(dynamics, table, here, mode);
            // Another than the best leaves its own series behind.
            self.decision.expanded &= best.is_none();
            let loose = is_loose(&self.zeros, &self.posed, dynamics.description());
            match outcome {
                Ok(true) if best.is_none_or(|found| found.loose && !loose) => {
                    let sticks = sticks(mode);
                    best = Some(Found { sticks, loose });
                    self.decision.ambiguous = self.forks;
                    self.keep(dynamics);
                }
                Ok(true) if best.is_some_and(|found| found.loose == loose) => {
                    self.measure(dynamics, here.facts);
                    self.decision.ambiguous |= self.differ(&self.motion, dynamics.acceleration());
                }
                Ok(true) => {}
                Ok(false) => evaluated = true,
                Err(error) => failure = Some((mode, error)),
            }
        }
        match (best, failure) {
            (None, Some((_, EvaluationError::Inconsistent { .. }))) if evaluated => Ok(false),
            (None, Some((mode, error))) => {
                dynamics.set_mode(mode);
                Err(error)
            }
            _ => Ok(best.is_some()),
        }
    }

    /// The same with all numbers taken for what they are: what decides may be smaller than errors are allowed to be, and in the end
    /// smaller than what evaluation leaves of the forces located.
    fn best_exactly(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        candidates: &Candidates,
    ) -> Result<bool, EvaluationError> {
        let exactly = here.exactly();
        let outcome = self.best(dynamics, table, exactly, candidates);
        if here.facts.residue == 0.0 || matches!(outcome, Ok(true)) {
            return outcome;
        }
        let facts = SwitchFacts {
            residue: 0.0,
            ..here.facts.clone()
        };
        let exactly = SwitchContext {
            facts: &facts,
            ..exactly
        };
        self.best(dynamics, table, exactly, candidates)
    }

    /// Whether the present mode goes on, although guards of it were located as zero: a force is still clearly positive or only touches
    /// zero, or a slip or branch rises from it, or a gap that has been touched only, where `touched` ones may be among them. The root has an error larger than what decides, and from here it will be located anew.
    /// If so, the mode is left in `self.best`.
    fn goes_on(
        &mut self,
        dynamics: &mut Dynamics<T>,
        table: &mut Table,
        here: SwitchContext<'_, T>,
        touched: bool,
    ) -> bool {
        let located = &here.facts.located;
        let can = |guard: &Guard| match guard {
            Guard::Slip(_) | Guard::Branch(_) => true,
            Guard::Gap(_) => touched,
            guard => guard.is_force(),
        };
        // A slip that rises again has been put below zero by what moved the state onto its constraints, however often that is seen.
        let for_ever = here.facts.again && located.iter().any(|guard| guard.is_force());
        if for_ever || !here.ends(here.present) || !located.iter().all(can) {
            return false;
        }
        self.decision.expanded = false;
        let feasible = matches!(
            self.examine(dynamics, table, here.exactly(), here.present),
            Ok(true)
        );
        // A force that stays zero does not go on; one that only touches zero does.
        let stays_zero = |&(guard, order): &(Guard, usize)| {
            guard.is_force() && order >= guard::LENGTH && located.contains(&guard)
        };
        let goes_on = feasible && !self.zeros.iter().any(stays_zero);
        if goes_on {
            self.decision.ambiguous = false;
            self.keep(dynamics);
        }
        goes_on
    }

    /// Whether two motions have other accelerations, by more than a share of the largest, and than rounding leaves of what drives each coordinate: bodies at
    /// rest have none.
    fn differ<S: Scalar>(&self, one: &[f64], other: &[S]) -> bool {
        let pairs = || {
            one.iter()
                .zip(other)
                .map(|(x, y)| (x.abs(), y.value().abs(), (x - y.value()).abs()))
        };
        let largest = pairs().fold(0.0_f64, |m, (x, y, _)| m.max(x).max(y));
        // What has no inertia of its own moves with the others.
        let driven = (0..one.len()).map(|j| self.sizes.of_coordinate(j));
        let most = driven.clone().fold(0.0, f64::max);
        let driven = driven.map(|size| if size > 0.0 { size } else { most });
        let mut distances = pairs().zip(driven);
        distances
            .any(|((.., distance), driven)| distance > SAME * largest && distance > STILL * driven)
    }

    /// Keeps the candidate examined last, which is feasible.
    fn keep(&mut self, dynamics: &Dynamics<T>) {
        core::mem::swap(&mut self.best, &mut self.posed);
        core::mem::swap(&mut self.decision.zeros, &mut self.zeros);
        core::mem::swap(&mut self.decision.at_limit, &mut self.at_limit);
        self.decision.composites.clone_from(&self.composites);
        self.decision.held.clear();
        self.decision.held.extend_from_slice(self.held.held());
        self.motion.clear();
        let motion = dynamics.acceleration().iter().map(|a| a.value());
        self.motion.extend(motion);
    }
}

/// The best mode so far.
#[derive(Clone, Copy)]
struct Found {
    /// How many frictions stick.
    sticks: usize,
    /// See [`is_loose`].
    loose: bool,
}

/// Whether, by what stays zero in a mode, a contact is open that nothing lifts: others carry its share of the load, as they need not; or a friction slips
/// in no direction, because others hold what it rubs on; or a condition stays at its border without what is declared for equality.
fn is_loose(zeros: &[(Guard, usize)], mode: &Mode, d: &Description) -> bool {
    let stays = |guard| match guard {
        Guard::Gap(_) => true,
        Guard::Slip(f) => d.frictions[f].components > 1,
        Guard::Branch(b) => !mode.branch(b),
        _ => false,
    };
    let mut zeros = zeros.iter();
    zeros.any(|&(guard, order)| order >= guard::LENGTH && stays(guard))
}

fn sticks(mode: &Mode) -> usize {
    mode.frictions
        .iter()
        .filter(|f| matches!(f, FrictionMode::Stick))
        .count()
}

/// The name of what is concerned at an instant, among the guards that are `within` what has no mode.
fn concerned(
    d: &'static Description,
    facts: &SwitchFacts,
    present: &Mode,
    within: impl Fn(Guard) -> bool,
) -> &'static str {
    let located = facts.located.iter().copied();
    let [frictions, contacts] = [d.frictions.len(), d.contacts.len()];
    let resting = (0..frictions)
        .filter(|&f| facts.resting[f])
        .map(Guard::Slip);
    let touching = (0..contacts).filter(|&c| facts.touching[c]).map(Guard::Gap);
    let slides = |f: &usize| matches!(present.frictions[*f], FrictionMode::Slip(_));
    let sliding = (0..frictions).filter(slides).map(Guard::Slip);
    let mut guards = located.chain(resting).chain(touching).chain(sliding);
    let found = guards.find_map(|guard| guard.name(d).filter(|_| within(guard)));
    let balanced = facts.balanced.iter().position(|b| *b);
    let condition = balanced.map(|b| d.branches[b].then);
    found.or(condition).unwrap_or(d.name)
}
