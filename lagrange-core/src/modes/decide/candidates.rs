//! The modes that the known facts allow: each choice of contacts, frictions and branches.

use super::{Known, Moment, slips};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, NeedSet};
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::pool::Pool;
use crate::system::{Normal, System};

/// More candidates than this are not enumerated.
const MOST_CANDIDATES: usize = 20_000;

/// All modes that the known facts allow, in order of preference.
pub fn list_candidates<S: System>(
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
            && d.frictions[f].components == 1
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
    /// Contact `c` closed and open, where both are possible.
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

    /// What friction `f` may do: not act, stick, or slip in each direction that its slip can take.
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
        if friction.components > 1 {
            let direction = if self.known.resting[f] {
                self.friction(mode, f, FrictionMode::Stick);
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
                self.friction(mode, f, FrictionMode::Slip(sliding));
            }
        } else if self.known.resting[f] {
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

    /// Branch `b` on both sides, where its guard vanishes.
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
