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
use crate::mode::{FrictionMode, Mode, Sliding};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::scale::scale;
use crate::system::{Normal, System};

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
    /// Guards of the present mode that have just been located as roots: the present mode cannot go on.
    pub located: Vec<Guard>,
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
}

/// More candidates than this are not enumerated.
const MOST_CANDIDATES: usize = 20_000;

/// Finds the mode in which the motion goes on from (t, q, v).
///
/// On success `dynamics` is left in that mode. The order of preference among feasible modes is: stick before slip,
/// then the present mode, then the fewest changes.
///
/// # Errors
/// [`Error::NoMode`] if no candidate is feasible (Painlevé's paradox).
#[allow(clippy::too_many_arguments)]
pub fn decide<S: System>(
    dynamics: &mut Dynamics<S>,
    t: S::Scalar,
    q: &[S::Scalar],
    v: &[S::Scalar],
    present: &Mode,
    known: &Known,
    order: usize,
    tolerance: f64,
) -> Result<Decision, Error> {
    let candidates = candidates::<S>(dynamics, q, v, t, present, known)?;
    let tried = candidates.len();
    let mut best: Option<Decision> = None;
    let mut best_motion: Vec<f64> = Vec::new();
    let mut failure = None;
    for mode in candidates {
        // A root of the present mode falls through zero: that mode is over.
        if mode == *present && !known.located.is_empty() {
            continue;
        }
        match examine(dynamics, t, q, v, &mode, known, order, tolerance) {
            Ok(Some(zeros)) => {
                let motion: Vec<f64> = dynamics.acceleration().iter().map(|a| a.value()).collect();
                match &mut best {
                    None => {
                        best = Some(Decision {
                            mode,
                            zeros,
                            ambiguous: false,
                        });
                        best_motion = motion;
                    }
                    // Stick is preferred to slip without being ambiguous (μs > μk allows both).
                    Some(first)
                        if sticks(&first.mode) <= sticks(&mode)
                            && differ(&best_motion, &motion) =>
                    {
                        first.ambiguous = true;
                    }
                    Some(_) => {}
                }
            }
            Ok(None) => {}
            Err(error) => failure = Some((mode, error)),
        }
    }
    match (best, failure) {
        (Some(decision), _) => {
            dynamics.set_mode(&decision.mode);
            Ok(decision)
        }
        (None, Some((mode, error))) => Err(Error::from_evaluation(
            error,
            t.value(),
            &mode,
            S::DESCRIPTION,
        )),
        (None, None) => Err(Error::NoMode {
            time: t.value(),
            mode: present.display(S::DESCRIPTION).to_string(),
            item: concerned::<S>(known),
            tried,
        }),
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

fn differ(a: &[f64], b: &[f64]) -> bool {
    let size = a.iter().chain(b).fold(0.0_f64, |m, x| m.max(x.abs()));
    a.iter().zip(b).any(|(x, y)| (x - y).abs() > 1e-9 * size)
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
fn candidates<S: System>(
    dynamics: &mut Dynamics<S>,
    q: &[S::Scalar],
    v: &[S::Scalar],
    t: S::Scalar,
    present: &Mode,
    known: &Known,
) -> Result<Vec<Mode>, Error> {
    let d = S::DESCRIPTION;
    let mut modes = vec![present.clone()];
    let multiply =
        |modes: &mut Vec<Mode>, change: &dyn Fn(&Mode) -> Vec<Mode>| -> Result<(), Error> {
            *modes = modes.iter().flat_map(change).collect();
            if modes.len() > MOST_CANDIDATES {
                return Err(Error::Limit {
                    time: t.value(),
                    what: "candidate modes",
                    limit: MOST_CANDIDATES,
                });
            }
            Ok(())
        };
    for c in 0..d.contacts.len() {
        let touching = known.touching[c];
        multiply(&mut modes, &|mode| {
            let mut closed = mode.clone();
            closed.contacts[c] = true;
            let mut open = mode.clone();
            open.contacts[c] = false;
            if touching {
                vec![closed, open]
            } else {
                vec![open]
            }
        })?;
    }
    let all = guard::all_row_needs(d, &NeedSet::new(d));
    dynamics.set_extra_needs(&all);
    dynamics.tape(t, q, v);
    for (f, friction) in d.frictions.iter().enumerate() {
        let rests = known.resting[f];
        let slip = dynamics.motion(d.rows[friction.row].velocity).value();
        let sign = if slip < 0.0 { -1.0 } else { 1.0 };
        let left_out = !dynamics.effects().includes(d, Item::Friction(f));
        multiply(&mut modes, &|mode| {
            let idle =
                left_out || matches!(friction.normal, Normal::Contact(c) if !mode.contacts[c]);
            let with = |state| {
                let mut m = mode.clone();
                m.frictions[f] = state;
                m
            };
            let bearings: &[f64] = if let Normal::Constraint(_) = friction.normal {
                &[1.0, -1.0]
            } else {
                &[1.0]
            };
            if idle {
                vec![with(FrictionMode::Inactive)]
            } else if rests {
                let slides = bearings
                    .iter()
                    .flat_map(|&b| [slide(1.0, b), slide(-1.0, b)]);
                core::iter::once(FrictionMode::Stick)
                    .chain(slides)
                    .map(with)
                    .collect()
            } else {
                bearings.iter().map(|&b| with(slide(sign, b))).collect()
            }
        })?;
    }
    for b in 0..d.branches.len() {
        if known.balanced[b] {
            multiply(&mut modes, &|mode| {
                let mut other = mode.clone();
                other.set_branch(b, !mode.branch(b));
                vec![mode.clone(), other]
            })?;
        }
    }
    modes.sort_by_key(|m| (slips(m), m != present, changes(m, present)));
    Ok(modes)
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

/// Whether `mode` is feasible; if so, which guards begin with how many vanishing coefficients.
#[allow(clippy::too_many_arguments)]
fn examine<S: System>(
    dynamics: &mut Dynamics<S>,
    t: S::Scalar,
    q: &[S::Scalar],
    v: &[S::Scalar],
    mode: &Mode,
    known: &Known,
    order: usize,
    tolerance: f64,
) -> Result<Option<Vec<(Guard, usize)>>, EvaluationError> {
    dynamics.set_mode(mode);
    let questions = questions::<S>(mode, known);
    // Most candidates are refused by their values already.
    dynamics.value(t, q, v)?;
    for &(guard, order_known) in &questions {
        if order_known == 0 {
            let series = guard::series(guard, mode, &Reading::Values(dynamics), 1.0);
            let value = series.as_slice().first().copied().unwrap_or(0.0);
            let scale = scale(guard, dynamics);
            if value < -1e-6 * scale && !known.located.contains(&guard) {
                return Ok(None);
            }
        }
    }
    dynamics.series(t, q, v, order)?;
    let step = taylor::step_size(dynamics, order, Tolerance::both(tolerance));
    let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
    let mut zeros = Vec::new();
    for &(guard, order_known) in &questions {
        let mut series = guard::series(guard, mode, &Reading::Series(dynamics), h);
        series.clear(order_known);
        let size = series
            .as_slice()
            .iter()
            .fold(0.0_f64, |m, c| m.max(c.abs()));
        // The residue of a located root, and what follows from it, has the size of the integration error.
        let blurred = concerns(guard, known);
        let (relative, absolute) = if blurred {
            ((100.0 * tolerance).clamp(1e-11, 1e-3), tolerance.max(1e-14))
        } else {
            (1e-13, 1e-14)
        };
        let cancelling = scale(guard, dynamics) * unit_of_order(guard, h);
        let noise = (relative * size).max(absolute * cancelling);
        match series.as_slice().iter().position(|c| c.abs() > noise) {
            // Identically zero: the boundary is not left.
            None => {
                if order_known > 0 || series.as_slice().iter().all(|c| *c <= 0.0) || blurred {
                    zeros.push((guard, guard::LENGTH));
                }
            }
            Some(k) if series.as_slice()[k] < 0.0 => return Ok(None),
            Some(k) => {
                if k > 0 {
                    zeros.push((guard, k));
                }
            }
        }
    }
    Ok(Some(zeros))
}

/// The guards that can be violated just after the instant, with the number of coefficients known to vanish.
fn questions<S: System>(mode: &Mode, known: &Known) -> Vec<(Guard, usize)> {
    let d = S::DESCRIPTION;
    let mut list = Vec::new();
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
        if known.balanced[b] {
            list.push((Guard::Branch(b), 1));
        }
    }
    list
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
