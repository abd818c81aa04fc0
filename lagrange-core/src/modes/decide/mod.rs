//! Which mode comes next: complementarity just after an instant.
//!
//! At the instant itself inequalities decide nothing: at a smooth lift-off λ = 0 and g̈ = 0 together. A candidate
//! mode is therefore solved as a Taylor series, and it is feasible only if each of its guards is positive *just
//! after* the instant: the first coefficient that does not vanish is positive (Brogliato 2016, section 5.4;
//! Lötstedt 1982). What is known to vanish (a gap that was closed, a located root) is never read.

//!
//! [`candidates`] writes down the modes that what is known allows, [`examine`] says of one whether it is feasible.

mod candidates;
mod examine;
mod incipient;
mod known;

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, NeedSet};
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::scale::Sizes;
use crate::modes::table::Table;
use crate::pool::Pool;
use crate::system::{Description, System};
use candidates::list_candidates;
use incipient::Beginning;
pub use known::{Known, Moment};

/// The mode that goes on.
#[derive(Clone, Debug)]
pub struct Decision {
    /// The mode.
    pub mode: Mode,
    /// Guards with leading coefficients that vanish, and how many.
    pub zeros: Vec<(Guard, usize)>,
    /// Whether another mode with another motion was feasible too.
    pub ambiguous: bool,
    /// Whether the dynamics hold the series of this mode at the moment, for the needs of its guards.
    pub expanded: bool,
}
/// Memory of decisions, and the last one.
#[derive(Clone, Debug)]
pub struct Decider {
    /// What was found last.
    pub decision: Decision,
    candidates: Pool<Mode>,
    questions: Vec<(Guard, usize)>,
    zeros: Vec<(Guard, usize)>,
    motion: Vec<f64>,
    sizes: Sizes,
    /// Needs of everything about every row.
    rows: NeedSet,
    /// The candidate under examination, with the directions in which its slips begin.
    posed: Mode,
    /// The same of the best one.
    best: Mode,
    /// Whether its slip could begin in another direction.
    forks: bool,
    beginning: Beginning,
}

impl Decider {
    /// Memory for a system.
    pub fn new(description: &Description) -> Self {
        Self {
            decision: Decision {
                mode: Mode::open(description),
                zeros: Vec::new(),
                ambiguous: false,
                expanded: false,
            },
            candidates: Pool::default(),
            questions: Vec::new(),
            zeros: Vec::new(),
            motion: Vec::new(),
            sizes: Sizes::default(),
            rows: guard::all_row_needs(description, &NeedSet::new(description)),
            posed: Mode::open(description),
            best: Mode::open(description),
            forks: false,
            beginning: Beginning::default(),
        }
    }

    /// Finds the mode in which the motion goes on from a moment, into [`Self::decision`].
    ///
    /// On success `dynamics` is left in that mode. The order of preference among feasible modes is: stick before slip,
    /// then the present mode, then the fewest changes.
    ///
    /// # Errors
    /// [`Error::NoMode`] if no candidate is feasible (Painlevé's paradox).
    pub fn decide<S: System>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        table: &mut Table,
        moment: Moment<'_, S::Scalar>,
        present: &Mode,
        known: &Known,
    ) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        let mut candidates = core::mem::take(&mut self.candidates);
        let scratch = &mut self.decision.mode;
        let listed = list_candidates(
            dynamics,
            moment,
            present,
            known,
            &self.rows,
            scratch,
            &mut candidates,
        );
        let outcome = listed.and_then(|()| {
            let (best, failure) = self.best(dynamics, table, moment, present, known, &candidates);
            match (best, failure) {
                (Some(_), _) => {
                    self.decision.mode.clone_from(&self.best);
                    dynamics.set_mode(&self.best);
                    Ok(())
                }
                (None, Some((mode, error))) => {
                    let time = moment.t.value();
                    Err(Error::from_evaluation(error, time, &candidates[mode], d))
                }
                (None, None) => Err(Error::NoMode {
                    time: moment.t.value(),
                    mode: present.display(d).to_string(),
                    item: concerned::<S>(known),
                    tried: candidates.len(),
                }),
            }
        });
        self.candidates = candidates;
        outcome
    }

    /// See [`Known::residue`]; `dynamics` holds the values of the moment in the mode that ends.
    pub fn residue<S: System>(
        &mut self,
        dynamics: &Dynamics<S>,
        mode: &Mode,
        located: &[Guard],
    ) -> f64 {
        self.sizes.take(dynamics);
        let reading = Reading::Values(dynamics);
        let relative = |&guard: &Guard| match guard {
            Guard::Normal(_)
            | Guard::StickUpper(_)
            | Guard::StickLower(_)
            | Guard::StickCone(_)
            | Guard::Bearing(_) => {
                let size = self.sizes.of(guard, dynamics);
                guard::value(guard, mode, &reading).abs() / size.max(f64::MIN_POSITIVE)
            }
            _ => 0.0,
        };
        located.iter().map(relative).fold(0.0, f64::max)
    }

    /// The feasible candidate to be preferred, and the last that could not be evaluated.
    fn best<S: System>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        table: &mut Table,
        moment: Moment<'_, S::Scalar>,
        present: &Mode,
        known: &Known,
        candidates: &[Mode],
    ) -> (Option<usize>, Option<(usize, EvaluationError)>) {
        let (mut best, mut failure) = (None, None);
        // Without friction the accelerations are the only ones that Gauss's principle allows: no other mode has others.
        let idle = |mode: &Mode| mode.frictions.iter().all(|f| *f == FrictionMode::Inactive);
        let unique = S::DESCRIPTION.couplings.is_empty()
            && !known.balanced.contains(&true)
            && candidates.iter().all(idle);
        for (index, mode) in candidates.iter().enumerate() {
            // A root of the present mode falls through zero: that mode is over.
            if *mode == *present && !known.located.is_empty() {
                continue;
            }
            // Stick is preferred to slip without being ambiguous (μs > μk allows both).
            if best.is_some_and(|best: usize| unique || sticks(&candidates[best]) > sticks(mode)) {
                continue;
            }
            // What is found of the last one serves the coming step.
            let last = best.is_none() && index + 1 == candidates.len();
            self.decision.expanded = false;
            match self.examine(dynamics, table, moment, mode, known, last) {
                Ok(true) if best.is_none() => {
                    best = Some(index);
                    self.decision.ambiguous = self.forks;
                    core::mem::swap(&mut self.best, &mut self.posed);
                    core::mem::swap(&mut self.decision.zeros, &mut self.zeros);
                    self.motion.clear();
                    let motion = dynamics.acceleration().iter().map(|a| a.value());
                    self.motion.extend(motion);
                }
                Ok(true) => {
                    self.decision.ambiguous |= differ(&self.motion, dynamics.acceleration())
                }
                Ok(false) => {}
                Err(error) => failure = Some((index, error)),
            }
        }
        (best, failure)
    }
}

fn slips(mode: &Mode) -> usize {
    mode.frictions
        .iter()
        .filter(|f| matches!(f, FrictionMode::Slip(_)))
        .count()
}

fn sticks(mode: &Mode) -> usize {
    mode.frictions
        .iter()
        .filter(|f| matches!(f, FrictionMode::Stick))
        .count()
}

fn differ<T: Scalar>(a: &[f64], b: &[T]) -> bool {
    let sizes = a.iter().copied().chain(b.iter().map(|x| x.value()));
    let size = sizes.fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut pairs = a.iter().zip(b);
    pairs.any(|(x, y)| (x - y.value()).abs() > 1e-9 * size)
}

fn concerned<S: System>(known: &Known) -> &'static str {
    let d = S::DESCRIPTION;
    let located = known.located.iter().find_map(|g| match *g {
        Guard::Gap(c) | Guard::Normal(c) => Some(d.contacts[c].name),
        Guard::StickUpper(f)
        | Guard::StickLower(f)
        | Guard::StickCone(f)
        | Guard::Slip(f)
        | Guard::Bearing(f) => Some(d.frictions[f].name),
        Guard::Branch(b) => Some(d.branches[b].text),
        Guard::Stop(..) | Guard::Mark(..) => None,
    });
    let resting = known
        .resting
        .iter()
        .position(|r| *r)
        .map(|f| d.frictions[f].name);
    let touching = known
        .touching
        .iter()
        .position(|r| *r)
        .map(|c| d.contacts[c].name);
    located.or(resting).or(touching).unwrap_or(d.name)
}
