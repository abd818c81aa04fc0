//! The modes that the known facts allow: each choice of contacts, frictions and branches.

use super::parts::Parts;
use super::sticks;
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, OutputMask};
use crate::effects::Item;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::facts::SwitchContext;
use crate::modes::guard::{self, Guard};
use crate::pool::Pool;
use crate::system::{Description, Normal, ValueRef};

/// More candidates than this are not enumerated: some five contacts with friction, or eight without, that may change at
/// once. Beyond, [`pivot`](super::pivot) finds a mode without looking at all.
pub const MOST_CANDIDATES: usize = 256;

/// So many are where nothing else finds one: eight contacts with friction, which takes a second.
const MOST_OF_ALL: usize = 65_536;

/// States that one friction can be in: stick, and two directions of slip for each of two signs of the normal force.
const MOST_STATES: usize = 5;

/// Lists of candidates that are kept, for what a motion meets again and again.
const MOST_LISTS: usize = 8;

/// The candidates for situations met before.
#[derive(Clone, Debug, Default)]
pub struct Listings {
    /// What each follows from; nothing if from more than can be compared.
    kept: Vec<(Option<Facts>, Candidates)>,
    /// Index of the list to be written over next.
    oldest: usize,
    /// What is not kept: a part of a system, and more than can be compared.
    passing: Candidates,
    /// Per friction.
    grips: Vec<Grip>,
}

/// What a friction can do by the numbers at hand, which parameters change.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Grip {
    /// It has no force at all.
    Absent,
    /// It has slipped until it came to rest now, and cannot hold.
    Fades,
    /// It slips, and holds where it is at rest.
    Holds,
}

/// Modes in order of preference.
#[derive(Clone, Debug, Default)]
pub struct Candidates {
    modes: Pool<Mode>,
    /// Rank and place of each.
    order: Vec<(u128, usize)>,
}

impl Candidates {
    /// The modes, the preferred ones first.
    pub fn iter(&self) -> impl Iterator<Item = &Mode> {
        self.order.iter().map(|&(_, index)| &self.modes[index])
    }

    /// These in order, unless they are more than `most`.
    fn sorted(&mut self, here: SwitchContext<'_, impl Copy>, most: usize) -> Option<&Self> {
        if self.modes.len() > most {
            return None;
        }
        if self.order.is_empty() {
            let ranks = self.modes.iter().map(|mode| rank(mode, here));
            self.order.extend(ranks.zip(0..));
            self.order.sort_unstable();
        }
        Some(self)
    }
}

/// What decides on the candidates and their order: the mode up to the instant, and what vanishes there.
#[derive(Clone, Debug)]
struct Facts {
    present: Mode,
    /// As in [`SwitchFacts`](crate::modes::facts::SwitchFacts).
    touching: Vec<bool>,
    resting: Vec<bool>,
    balanced: Vec<bool>,
    /// The guards of frictions that have been overcome.
    overcome: Vec<Guard>,
    /// As in [`Listings`].
    grips: Vec<Grip>,
}

/// The guards of frictions that have been overcome.
fn overcome(here: SwitchContext<'_, impl Copy>) -> impl Iterator<Item = Guard> + Clone {
    let located = here.facts.located.iter().copied();
    located.filter(|guard| guard.holding().is_some())
}

impl Facts {
    fn of(here: SwitchContext<'_, impl Copy>, grips: &[Grip]) -> Self {
        let SwitchContext { present, facts, .. } = here;
        Self {
            present: present.clone(),
            touching: facts.touching.clone(),
            resting: facts.resting.clone(),
            balanced: facts.balanced.clone(),
            overcome: overcome(here).collect(),
            grips: grips.to_vec(),
        }
    }

    fn are(&self, here: SwitchContext<'_, impl Copy>, grips: &[Grip]) -> bool {
        let SwitchContext { present, facts, .. } = here;
        self.touching == facts.touching
            && self.resting == facts.resting
            && self.balanced == facts.balanced
            && self.grips == grips
            && overcome(here).eq(self.overcome.iter().copied())
            && self.present == *present
    }
}

/// What is preferred has the lower rank: frictions that hold, closed contacts, the present mode, few changes, and that what has been overcome lets go, with
/// a force to the same side: where contacts keep what slips at rest either side would do.
/// What holds comes before what is closed: a cupboard that its friction holds tips over its edge, although it could stand on both feet if these slid, μk < μs.
fn rank(mode: &Mode, here: SwitchContext<'_, impl Copy>) -> u128 {
    /// Bits of each criterion.
    const BITS: u32 = 20;
    let SwitchContext { present, facts, .. } = here;
    let closed = mode.contacts.iter().filter(|c| **c).count();
    // Frictions that could together hold no longer go together, if they can.
    let composite = facts
        .located
        .iter()
        .any(|g| matches!(g, Guard::Composite(_)));
    let sticks_on = |f: usize| mode.frictions[f] == FrictionMode::Stick;
    let holds = |guard: &Guard| guard.holding().is_some_and(sticks_on);
    let overcome = overcome(here);
    let left_behind = overcome.clone().filter(holds).count();
    let turned = overcome.clone().filter(|&guard| turns(guard, mode)).count();
    // All together may hold by other bounds: of a load that does not grow on, or where what presses them turns.
    let may_hold = !facts.again && left_behind == overcome.count();
    let changes = changes(mode, present);
    let differs = changes > 0 || mode.branches != present.branches;
    let most = (1 << BITS) - 1;
    let criteria = [
        if composite && !may_hold {
            left_behind
        } else {
            0
        },
        most - sticks(mode),
        most - closed,
        usize::from(differs),
        changes,
        left_behind * (mode.frictions.len() + 1) + turned,
    ];
    let append = |rank, criterion| rank << BITS | criterion as u128;
    criteria.into_iter().fold(0, append)
}

/// Whether a friction that has been overcome slips with a force to the other side than it has held by.
fn turns(overcome: Guard, mode: &Mode) -> bool {
    let (f, held_by) = match overcome {
        Guard::StickUpper(f) => (f, 1.0),
        Guard::StickLower(f) => (f, -1.0),
        _ => return false,
    };
    match mode.frictions[f] {
        FrictionMode::Slip(Sliding {
            direction: Direction::Fixed([slip, _]),
            ..
        }) => slip * held_by > 0.0,
        _ => false,
    }
}

impl Listings {
    /// All modes that the known facts allow, in order of preference; `None` if they are more than [`MOST_CANDIDATES`].
    pub fn list<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        rows: &OutputMask,
        scratch: &mut Mode,
    ) -> Option<&Candidates> {
        let most = MOST_CANDIDATES;
        let looked = look_at_slips(dynamics, here, rows);
        let composite = |guard: &Guard| matches!(guard, Guard::Composite(_));
        let follows = !looked && !here.facts.located.iter().any(composite);
        let choices = Choices { dynamics, here };
        let frictions = 0..choices.description().frictions.len();
        self.grips.clear();
        self.grips.extend(frictions.map(|f| choices.grip(f)));
        let known = |facts: &Facts| facts.are(here, &self.grips);
        let same = |(facts, _): &(Option<Facts>, _)| facts.as_ref().is_some_and(known);
        let found = self.kept.iter().position(same).filter(|_| follows);
        let index = found.unwrap_or_else(|| {
            if self.kept.len() < MOST_LISTS {
                self.kept.push(Default::default());
            }
            self.oldest = (self.oldest + 1) % self.kept.len();
            let (facts, list) = &mut self.kept[self.oldest];
            *facts = None;
            list.modes.clear();
            list.order.clear();
            let mut listing = Listing {
                choices,
                part: None,
                most,
                out: &mut list.modes,
            };
            scratch.clone_from(here.present);
            listing.contacts(scratch, 0);
            if list.modes.len() <= most {
                *facts = follows.then(|| Facts::of(here, &self.grips));
            }
            self.oldest
        });
        self.kept[index].1.sorted(here, most)
    }

    /// The same with no more than what one part of the system may do, where the others are as they are in `mode`.
    pub fn list_part<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        rows: &OutputMask,
        mode: &mut Mode,
        part: (&Parts, usize),
    ) -> Option<&Candidates> {
        self.pass(dynamics, here, rows, mode, Some(part), MOST_CANDIDATES)
    }

    /// The same, also if they are many.
    pub fn list_all<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        rows: &OutputMask,
        scratch: &mut Mode,
    ) -> Option<&Candidates> {
        scratch.clone_from(here.present);
        self.pass(dynamics, here, rows, scratch, None, MOST_OF_ALL)
    }

    /// Lists modes that are not kept.
    fn pass<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        rows: &OutputMask,
        mode: &mut Mode,
        part: Option<(&Parts, usize)>,
        most: usize,
    ) -> Option<&Candidates> {
        look_at_slips(dynamics, here, rows);
        self.passing.modes.clear();
        self.passing.order.clear();
        let mut listing = Listing {
            choices: Choices { dynamics, here },
            part,
            most,
            out: &mut self.passing.modes,
        };
        listing.contacts(mode, 0);
        self.passing.sorted(here, most)
    }
}

/// Evaluates the slips whose direction is not known, if there are any.
pub fn look_at_slips<T: Scalar>(
    dynamics: &mut Dynamics<T>,
    here: SwitchContext<'_, T>,
    rows: &OutputMask,
) -> bool {
    let d = dynamics.description();
    let SwitchContext { moment, facts, .. } = here;
    let slides_unknown = |f: usize| {
        d.frictions[f].components == 1
            && !facts.resting[f]
            && facts.may_act(f, d, dynamics.effects())
            && slip_sign(f, here).is_none()
    };
    let look = (0..d.frictions.len()).any(slides_unknown);
    if look {
        dynamics.set_extra_needs(rows);
        dynamics.tape(moment.t, moment.q, moment.v);
    }
    look
}

/// The way friction `f` has been sliding, if nothing has changed that.
fn slip_sign<T>(f: usize, here: SwitchContext<'_, T>) -> Option<f64> {
    match here.present.frictions[f] {
        FrictionMode::Slip(Sliding {
            direction: Direction::Fixed([sign, 0.0]),
            ..
        }) if !here.facts.jumped => Some(sign),
        _ => None,
    }
}

/// What the items of a mode may do at an instant.
#[derive(Clone, Copy)]
pub struct Choices<'a, T: Scalar> {
    pub dynamics: &'a Dynamics<T>,
    pub here: SwitchContext<'a, T>,
}

impl<T: Scalar> Choices<'_, T> {
    pub fn description(&self) -> &'static Description {
        self.dynamics.description()
    }

    fn grip(&self, f: usize) -> Grip {
        if self.is_smooth(f) {
            Grip::Absent
        } else if self.fades(f) {
            Grip::Fades
        } else {
            Grip::Holds
        }
    }

    /// Whether a friction other than `f` may stick in a mode.
    fn others_hold(&self, mode: &Mode, f: usize) -> bool {
        let d = self.description();
        let mut frictions = d.frictions.iter().enumerate();
        frictions.any(|(other, friction)| {
            other != f
                && self.here.facts.resting[other]
                && friction.normal.presses(d, |c| mode.contacts[c])
                && self.grip(other) == Grip::Holds
        })
    }

    fn fades(&self, f: usize) -> bool {
        self.here.facts.resting[f]
            && slip_sign(f, self.here).is_some()
            && guard::fades(f, self.dynamics)
    }

    /// Whether friction `f` has no force, whatever presses it, and two components: a slip that comes to zero and goes on has no direction there. Derivatives by
    /// its coefficient are those of one that acts.
    fn is_smooth(&self, f: usize) -> bool {
        let friction = &self.description().frictions[f];
        let vanishes = |place: ValueRef| {
            !place.varies() && T::DERIVATIVES == 0 && self.dynamics.motion(place).is_zero()
        };
        let unpressed = matches!(friction.normal, Normal::Given(place) if vanishes(place));
        let coefficients = [friction.static_coefficient, friction.kinetic_coefficient];
        friction.components > 1 && (unpressed || coefficients.into_iter().all(vanishes))
    }

    /// What friction `f` may do in a mode: not act, stick, or slip in each direction that its slip can take.
    pub fn of_friction(&self, mode: &Mode, f: usize, mut put: impl FnMut(FrictionMode)) {
        let d = self.description();
        let friction = &d.frictions[f];
        let idle = !friction.normal.presses(d, |c| mode.contacts[c]);
        let grip = self.grip(f);
        if idle || grip == Grip::Absent || !self.dynamics.effects().includes(d, Item::Friction(f)) {
            return put(FrictionMode::Inactive);
        }
        let bearings: &[f64] = if let Normal::Constraint(_) = friction.normal {
            &[1.0, -1.0]
        } else {
            &[1.0]
        };
        if friction.components > 1 {
            let direction = if self.here.facts.resting[f] {
                put(FrictionMode::Stick);
                // Where to is found when the candidate is examined.
                Direction::Incipient([0.0; 2])
            } else {
                Direction::AlongSlip
            };
            for &normal_sign in bearings {
                let sliding = Sliding {
                    direction,
                    normal_sign,
                };
                put(FrictionMode::Slip(sliding));
            }
        } else if self.here.facts.resting[f] {
            // What cannot hold does not bring a slip to rest, unless others do.
            if grip != Grip::Fades || self.others_hold(mode, f) {
                put(FrictionMode::Stick);
            }
            for &bearing in bearings {
                put(slide(1.0, bearing));
                put(slide(-1.0, bearing));
            }
        } else {
            let sign = slip_sign(f, self.here).unwrap_or_else(|| {
                let slip = self.dynamics.motion(d.rows[friction.row].velocity);
                if slip.value() < 0.0 { -1.0 } else { 1.0 }
            });
            for &bearing in bearings {
                put(slide(sign, bearing));
            }
        }
    }
}

/// Writes down modes, choice after choice.
struct Listing<'a, T: Scalar> {
    choices: Choices<'a, T>,
    /// The part that is free, if not everything is.
    part: Option<(&'a Parts, usize)>,
    /// More are not written down.
    most: usize,
    out: &'a mut Pool<Mode>,
}

impl<T: Scalar> Listing<'_, T> {
    /// Contact `c` closed and open, where both are possible.
    fn contacts(&mut self, mode: &mut Mode, c: usize) {
        if c == mode.contacts.len() {
            return self.frictions(mode, 0);
        }
        if self.out.len() > self.most {
            return;
        }
        if self
            .part
            .is_some_and(|(parts, part)| parts.contacts[c] != part)
        {
            return self.contacts(mode, c + 1);
        }
        if self.choices.here.facts.touching[c] {
            mode.contacts[c] = true;
            self.contacts(mode, c + 1);
        }
        mode.contacts[c] = false;
        self.contacts(mode, c + 1);
    }

    /// Friction `f` in each state.
    fn frictions(&mut self, mode: &mut Mode, f: usize) {
        if f == mode.frictions.len() {
            return self.branches(mode, 0);
        }
        if self
            .part
            .is_some_and(|(parts, part)| parts.frictions[f] != part)
        {
            return self.frictions(mode, f + 1);
        }
        let mut states = [FrictionMode::Inactive; MOST_STATES];
        let mut count = 0;
        self.choices.of_friction(mode, f, |state| {
            states[count] = state;
            count += 1;
        });
        for &state in &states[..count] {
            if self.out.len() > self.most {
                return;
            }
            mode.frictions[f] = state;
            self.frictions(mode, f + 1);
        }
    }

    /// Branch `b` on both sides, where its guard vanishes.
    fn branches(&mut self, mode: &mut Mode, b: usize) {
        if self.out.len() > self.most {
            return;
        }
        if b == self.choices.description().branches.len() {
            return self.out.push(mode);
        }
        self.branches(mode, b + 1);
        if self.choices.here.facts.balanced[b] {
            let side = mode.branch(b);
            mode.set_branch(b, !side);
            self.branches(mode, b + 1);
            mode.set_branch(b, side);
        }
    }
}

pub fn slide(sign: f64, normal_sign: f64) -> FrictionMode {
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
