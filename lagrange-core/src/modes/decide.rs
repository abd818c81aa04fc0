//! Which mode comes next: complementarity just after an instant.
//!
//! At the instant itself inequalities decide nothing: at a smooth lift-off λ = 0 and g̈ = 0 together. A candidate
//! mode is therefore solved as a Taylor series, and it is feasible only if each of its guards is positive *just
//! after* the instant: the first coefficient that does not vanish is positive (Brogliato 2016, section 5.4;
//! Lötstedt 1982). What is known to vanish (a gap that was closed, a located root) is never read.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, NeedSet};
use crate::effects::Item;
use crate::error::Error;
use crate::integrate::{Tolerance, taylor};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::scale::Sizes;
use crate::modes::table::Table;
use crate::pool::Pool;
use crate::system::{Description, Normal, System};

/// What is known exactly at the instant.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// Per contact: gap and gap rate vanish, so that it may be closed or open.
    pub touching: Vec<bool>,
    /// Per contact: the gap has just come to vanish, so that it may be hit.
    pub arriving: Vec<bool>,
    /// Per contact: the gap vanishes and grows.
    pub parting: Vec<bool>,
    /// Per friction: the slip vanishes, so that it may stick or slip either way.
    pub resting: Vec<bool>,
    /// Per branch: its guard vanishes.
    pub balanced: Vec<bool>,
    /// Velocities have just jumped.
    pub jumped: bool,
    /// Guards of the present mode that have just been located as roots: the present mode cannot go on.
    pub located: Vec<Guard>,
    /// What evaluation leaves of the forces that have been located as zero, relative to the terms that they are made of.
    pub residue: f64,
}

impl Known {
    /// Nothing is known.
    pub fn clear(&mut self, d: &Description) {
        for flags in [&mut self.touching, &mut self.arriving, &mut self.parting] {
            flags.clear();
            flags.resize(d.contacts.len(), false);
        }
        self.resting.clear();
        self.resting.resize(d.frictions.len(), false);
        self.balanced.clear();
        self.balanced.resize(d.branches.len(), false);
        self.jumped = false;
        self.located.clear();
        self.residue = 0.0;
    }
}

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

/// The instant at which a mode is looked for.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a, T> {
    /// Time, s.
    pub t: T,
    /// Positions.
    pub q: &'a [T],
    /// Velocities.
    pub v: &'a [T],
    /// Order of the series that decide what values do not.
    pub order: usize,
    /// Error that the state may have.
    pub tolerance: f64,
}

impl<T> Moment<'_, T> {
    /// How far forces located as zero, and what follows from them, are from it, relative to what they are made of.
    fn blur(&self, known: &Known) -> f64 {
        self.tolerance.max(1e-14).max(4.0 * known.residue)
    }
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
}

/// More candidates than this are not enumerated.
const MOST_CANDIDATES: usize = 20_000;

/// Order of the series that are looked at first. Leading coefficients beyond it vanish rarely.
const LOW_ORDER: usize = 4;

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
                (Some(best), _) => {
                    self.decision.mode.clone_from(&candidates[best]);
                    dynamics.set_mode(&candidates[best]);
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
                    self.decision.ambiguous = false;
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

    /// Whether `mode` is feasible; if so, `zeros` says which guards begin with how many vanishing coefficients.
    fn examine<S: System>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        table: &mut Table,
        moment: Moment<'_, S::Scalar>,
        mode: &Mode,
        known: &Known,
        last: bool,
    ) -> Result<bool, EvaluationError> {
        let Moment { t, q, v, .. } = moment;
        dynamics.set_mode(mode);
        let watched = table.of(dynamics);
        dynamics.set_extra_needs(&watched.deciding);
        let serves = watched.deciding == watched.needs;
        list_questions::<S>(mode, known, &watched.deciding, &mut self.questions);
        // Most candidates are refused, and many accepted, by their values already.
        dynamics.value(t, q, v)?;
        self.sizes.take(dynamics);
        let mut refused = false;
        let Self {
            sizes,
            questions,
            zeros,
            ..
        } = self;
        zeros.clear();
        questions.retain(|&(guard, order_known)| {
            if matches!((guard, order_known), (Guard::Gap(_), 1)) {
                // It parts: that is known.
                zeros.push((guard, 1));
                return false;
            }
            let Some(value) = leading(guard, order_known, mode, dynamics) else {
                return true;
            };
            let noise = if concerns(guard, known) {
                1e3 * moment.blur(known)
            } else {
                1e-6
            };
            let clear = noise.max(1e-6) * sizes.of(guard, dynamics);
            refused |= value < -clear;
            let settled = clear > 0.0 && value > clear;
            if settled && order_known > 0 {
                zeros.push((guard, order_known));
            }
            !settled
        });
        if refused || questions.is_empty() {
            return Ok(!refused);
        }
        let settled = zeros.len();
        let low = if last {
            moment.order
        } else {
            LOW_ORDER.min(moment.order)
        };
        for order in [low, moment.order] {
            dynamics.series(t, q, v, order)?;
            self.decision.expanded = serves && order == moment.order;
            match self.judge(dynamics, moment, mode, known, order) {
                Some(feasible) => return Ok(feasible),
                None => self.zeros.truncate(settled),
            }
        }
        Ok(true)
    }

    /// Looks at the guards in question just after the moment. `None`: one of them vanishes to this order, and more is to
    /// be had.
    fn judge<S: System>(
        &mut self,
        dynamics: &Dynamics<S>,
        moment: Moment<'_, S::Scalar>,
        mode: &Mode,
        known: &Known,
        order: usize,
    ) -> Option<bool> {
        let Moment { tolerance, .. } = moment;
        let last = order == moment.order;
        // A low order's last coefficient is small enough at the same step for a loose tolerance only.
        let allowed = Tolerance::both(if last { tolerance } else { 1e-3 });
        let step = taylor::step_size(dynamics, order, allowed);
        let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
        let mut series = [0.0; guard::LENGTH];
        let series = &mut series[..=order];
        let mut unclear = false;
        for &(guard, order_known) in &self.questions {
            guard::series(guard, mode, &Reading::Series(dynamics), series);
            let mut power = 1.0;
            let mut size = 0.0_f64;
            for (k, c) in series.iter_mut().enumerate() {
                *c = if k < order_known { 0.0 } else { *c * power };
                power *= h;
                size = size.max(c.abs());
            }
            // The residue of a located root, and what follows from it, has the size of the integration error.
            let blurred = concerns(guard, known);
            let (relative, absolute) = if blurred {
                ((100.0 * tolerance).clamp(1e-11, 1e-3), moment.blur(known))
            } else {
                (1e-13, 1e-14)
            };
            let cancelling = self.sizes.of(guard, dynamics) * unit_of_order(guard, h);
            let noise = (relative * size).max(absolute * cancelling);
            match series.iter().position(|c| c.abs() > noise) {
                None if !last => unclear = true,
                // Identically zero: the boundary is not left.
                None => {
                    if order_known > 0 || series.iter().all(|c| *c <= 0.0) || blurred {
                        self.zeros.push((guard, guard::LENGTH));
                    }
                }
                Some(k) if series[k] < 0.0 => return Some(false),
                Some(0) => {}
                Some(k) => self.zeros.push((guard, k)),
            }
        }
        (!unclear).then_some(true)
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

/// All modes that the known facts allow, in order of preference.
fn list_candidates<S: System>(
    dynamics: &mut Dynamics<S>,
    moment: Moment<'_, S::Scalar>,
    present: &Mode,
    known: &Known,
    rows: &NeedSet,
    scratch: &mut Mode,
    out: &mut Pool<Mode>,
) -> Result<(), Error> {
    let d = S::DESCRIPTION;
    let slides_unknown = |f: usize| {
        let closes = match d.frictions[f].normal {
            Normal::Contact(c) => known.touching[c],
            Normal::Constraint(_) | Normal::Given(_) => true,
        };
        closes
            && !known.resting[f]
            && dynamics.effects().includes(d, Item::Friction(f))
            && slip_sign(f, present, known).is_none()
    };
    if (0..d.frictions.len()).any(slides_unknown) {
        dynamics.set_extra_needs(rows);
        dynamics.tape(moment.t, moment.q, moment.v);
    }
    out.clear();
    let mut listing = Listing {
        dynamics,
        present,
        known,
        out,
    };
    scratch.clone_from(present);
    listing.contacts(scratch, 0);
    if out.len() > MOST_CANDIDATES {
        return Err(Error::Limit {
            time: moment.t.value(),
            what: "candidate modes",
            limit: MOST_CANDIDATES,
        });
    }
    out.sort_by_key(|m| (slips(m), m != present, changes(m, present)));
    Ok(())
}

/// The way friction `f` has been sliding, if nothing has changed that.
fn slip_sign(f: usize, present: &Mode, known: &Known) -> Option<f64> {
    match present.frictions[f] {
        FrictionMode::Slip(Sliding {
            direction: Direction::Fixed([sign, 0.0]),
            ..
        }) if !known.jumped => Some(sign),
        _ => None,
    }
}

/// Writes down modes, choice after choice.
struct Listing<'a, S: System> {
    dynamics: &'a Dynamics<S>,
    present: &'a Mode,
    known: &'a Known,
    out: &'a mut Pool<Mode>,
}

impl<S: System> Listing<'_, S> {
    fn contacts(&mut self, mode: &mut Mode, c: usize) {
        if c == mode.contacts.len() {
            return self.frictions(mode, 0);
        }
        if self.known.touching[c] {
            mode.contacts[c] = true;
            self.contacts(mode, c + 1);
        }
        mode.contacts[c] = false;
        self.contacts(mode, c + 1);
    }

    fn frictions(&mut self, mode: &mut Mode, f: usize) {
        let d = S::DESCRIPTION;
        let Some(friction) = d.frictions.get(f) else {
            return self.branches(mode, 0);
        };
        let idle = matches!(friction.normal, Normal::Contact(c) if !mode.contacts[c]);
        if idle || !self.dynamics.effects().includes(d, Item::Friction(f)) {
            return self.friction(mode, f, FrictionMode::Inactive);
        }
        let bearings: &[f64] = if let Normal::Constraint(_) = friction.normal {
            &[1.0, -1.0]
        } else {
            &[1.0]
        };
        if self.known.resting[f] {
            self.friction(mode, f, FrictionMode::Stick);
            for &bearing in bearings {
                self.friction(mode, f, slide(1.0, bearing));
                self.friction(mode, f, slide(-1.0, bearing));
            }
        } else {
            let sign = slip_sign(f, self.present, self.known).unwrap_or_else(|| {
                let slip = self.dynamics.motion(d.rows[friction.row].velocity);
                if slip.value() < 0.0 { -1.0 } else { 1.0 }
            });
            for &bearing in bearings {
                self.friction(mode, f, slide(sign, bearing));
            }
        }
    }

    fn friction(&mut self, mode: &mut Mode, f: usize, state: FrictionMode) {
        mode.frictions[f] = state;
        self.frictions(mode, f + 1);
    }

    fn branches(&mut self, mode: &mut Mode, b: usize) {
        if self.out.len() > MOST_CANDIDATES {
            return;
        }
        if b == S::DESCRIPTION.branches.len() {
            return self.out.push(mode);
        }
        self.branches(mode, b + 1);
        if self.known.balanced[b] {
            let side = mode.branch(b);
            mode.set_branch(b, !side);
            self.branches(mode, b + 1);
            mode.set_branch(b, side);
        }
    }
}

fn slide(sign: f64, normal_sign: f64) -> FrictionMode {
    FrictionMode::Slip(Sliding {
        normal_sign,
        ..Sliding::sign(sign)
    })
}

fn changes(a: &Mode, b: &Mode) -> usize {
    let contacts = a
        .contacts
        .iter()
        .zip(&b.contacts)
        .filter(|(x, y)| x != y)
        .count();
    let frictions = a
        .frictions
        .iter()
        .zip(&b.frictions)
        .filter(|(x, y)| x != y)
        .count();
    contacts + frictions
}

/// The first coefficient of a guard that is not known to vanish, times its factorial, as far as values tell.
fn leading<S: System>(
    guard: Guard,
    order_known: usize,
    mode: &Mode,
    dynamics: &Dynamics<S>,
) -> Option<f64> {
    let d = S::DESCRIPTION;
    let acceleration = |row: usize| {
        let row = &d.rows[row];
        let products = row.jacobian.iter().map(|&(j, place)| {
            let a = dynamics.motion(place) * dynamics.acceleration()[j];
            a.value()
        });
        dynamics.motion(row.bias).value() + products.sum::<f64>()
    };
    match (guard, order_known) {
        (_, 0) => Some(guard::value(guard, mode, &Reading::Values(dynamics))),
        (Guard::Gap(c), 2) => Some(acceleration(d.contacts[c].row)),
        (Guard::Slip(f), 1) => match mode.frictions[f] {
            FrictionMode::Slip(Sliding {
                direction: Direction::Fixed([sign, 0.0]),
                ..
            }) => Some(sign * acceleration(d.frictions[f].row)),
            _ => None,
        },
        _ => None,
    }
}

/// The guards that can be violated just after the instant, with the number of coefficients known to vanish; `held` are
/// the needs that are evaluated.
fn list_questions<S: System>(
    mode: &Mode,
    known: &Known,
    held: &NeedSet,
    list: &mut Vec<(Guard, usize)>,
) {
    let d = S::DESCRIPTION;
    list.clear();
    for c in 0..d.contacts.len() {
        if mode.contacts[c] {
            list.push((Guard::Normal(c), 0));
        } else if known.touching[c] {
            list.push((Guard::Gap(c), 2));
        } else if known.parting[c] {
            list.push((Guard::Gap(c), 1));
        }
    }
    for f in 0..d.frictions.len() {
        match mode.frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => {
                list.extend(guard::stick_guards(f, &d.frictions[f]).map(|g| (g, 0)));
            }
            FrictionMode::Slip(_) => {
                if known.resting[f] {
                    list.push((Guard::Slip(f), 1));
                }
                if let Normal::Constraint(_) = d.frictions[f].normal {
                    list.push((Guard::Bearing(f), 0));
                }
            }
        }
    }
    for b in 0..d.branches.len() {
        // What nothing in this mode uses decides nothing.
        if known.balanced[b] && held.contains(d.branches[b].need) {
            list.push((Guard::Branch(b), 1));
        }
    }
}

/// Whether a guard's leading coefficients carry the error of a located root: it is that root, or belongs to the
/// same contact (in the mode after, gap and slip accelerations vanish with the force that was located).
fn concerns(guard: Guard, known: &Known) -> bool {
    known.located.iter().any(|root| {
        *root == guard
            || match (*root, guard) {
                (Guard::Normal(c), Guard::Gap(g)) | (Guard::Gap(c), Guard::Normal(g)) => c == g,
                (
                    Guard::StickUpper(f)
                    | Guard::StickLower(f)
                    | Guard::StickCone(f)
                    | Guard::Slip(f),
                    Guard::Slip(g)
                    | Guard::StickUpper(g)
                    | Guard::StickLower(g)
                    | Guard::StickCone(g),
                ) => f == g,
                _ => false,
            }
    })
}

/// Powers of h that turn an acceleration or force scale into the unit of the guard.
fn unit_of_order(guard: Guard, h: f64) -> f64 {
    match guard {
        Guard::Gap(_) => h * h,
        Guard::Slip(_) => h,
        _ => 1.0,
    }
}
