//! Where pivoting from the nearest mode does not settle: the mode that holds at the instant itself, by Lemke's method.
//!
//! With the constraints always in force and what slides already acting through its normal force,
//!
//! ```text
//! g̈ = G λ + b,  0 ≤ λ ⟂ g̈ ≥ 0          per touching contact
//! ```
//!
//! and a friction at rest with one component adds two pairs (Pfeiffer & Glocker 1996, section 6.2), with its
//! acceleration ṡ = ṡ⁺ − ṡ⁻ and its force F = F⁺ − μ N
//!
//! ```text
//! 0 ≤ F⁺ ⟂ ṡ⁺ ≥ 0        0 ≤ ṡ⁻ ⟂ 2 μ N − F⁺ ≥ 0
//! ```
//!
//! Signs at the instant are not the last word (both members of a pair may vanish): the guess is where pivoting begins.

use super::Decider;
use super::candidates::{Choices, slide};
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::linear::{Equilibrated, Lemke, LemkeOutcome};
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::facts::{SwitchContext, SwitchFacts};
use crate::system::{Normal, ValueRef};

/// A contact or friction that may change, and the generalized force of its unit force.
struct Candidate {
    row: usize,
    force: Vec<f64>,
}

/// A friction at rest on a candidate contact.
struct Resting {
    friction: usize,
    /// Index of its contact's candidate, then of its own.
    contact: usize,
    own: usize,
    /// μs, times the factor from λ to N.
    coefficient: f64,
}

impl<T: Scalar> Decider<T> {
    /// Writes the guess into `mode`, in which all touching contacts are closed; leaves it if there is none.
    pub(super) fn guess(
        &mut self,
        dynamics: &mut Dynamics<T>,
        here: SwitchContext<'_, T>,
        mode: &mut Mode,
    ) {
        let SwitchContext { moment, facts, .. } = here;
        let d = dynamics.description();
        dynamics.set_mode(mode);
        dynamics.set_extra_needs(&self.everything);
        dynamics.tape(moment.t, moment.q, moment.v);
        let (candidates, resting) = list(dynamics, mode, facts);
        let contacts: Vec<usize> = (0..d.contacts.len())
            .filter(|&c| facts.touching[c])
            .collect();
        let Some((g, b)) = responses(dynamics, mode, &candidates) else {
            return;
        };
        let (m, q) = pairs(&g, &b, contacts.len(), &resting);
        let mut lemke = Lemke::default();
        if lemke.solve(&m, &q) != LemkeOutcome::Solved {
            return;
        }
        for (k, &c) in contacts.iter().enumerate() {
            mode.contacts[c] = lemke.is_active(k);
        }
        for f in 0..d.frictions.len() {
            Choices { dynamics, here }.set_first(mode, f);
        }
        let first = contacts.len();
        for (k, resting) in resting.iter().enumerate() {
            let state = &mut mode.frictions[resting.friction];
            if *state != FrictionMode::Stick {
                continue;
            }
            if lemke.is_active(first + 2 * k + 1) {
                *state = slide(-1.0, 1.0);
            } else if !lemke.is_active(first + 2 * k) {
                *state = slide(1.0, 1.0);
            }
        }
    }
}

/// The touching contacts, then the frictions that rest on them.
fn list<T: Scalar>(
    dynamics: &Dynamics<T>,
    mode: &Mode,
    facts: &SwitchFacts,
) -> (Vec<Candidate>, Vec<Resting>) {
    let d = dynamics.description();
    let number = |place: ValueRef| dynamics.motion(place).value();
    let factor = |c: usize| d.contacts[c].normal_factor.map_or(1.0, number);
    let touching: Vec<usize> = (0..d.contacts.len())
        .filter(|&c| facts.touching[c])
        .collect();
    let index = |c: usize| touching.binary_search(&c).ok();
    let mut candidates: Vec<Candidate> = touching
        .iter()
        .map(|&c| Candidate {
            row: d.contacts[c].row,
            force: force_of(dynamics, d.contacts[c].row),
        })
        .collect();
    let mut list = Vec::new();
    for (f, friction) in d.frictions.iter().enumerate() {
        let Normal::Contact(c) = friction.normal else {
            continue;
        };
        let Some(contact) = index(c) else {
            continue;
        };
        match mode.frictions[f] {
            FrictionMode::Stick if friction.components == 1 => {
                list.push(Resting {
                    friction: f,
                    contact,
                    own: candidates.len(),
                    coefficient: factor(c) * number(friction.static_coefficient),
                });
                candidates.push(Candidate {
                    row: friction.row,
                    force: force_of(dynamics, friction.row),
                });
            }
            FrictionMode::Slip(Sliding {
                direction: Direction::Fixed([sign, 0.0]),
                ..
            }) => {
                let strength = -sign * factor(c) * number(friction.kinetic_coefficient);
                let tangential = force_of(dynamics, friction.row);
                let normal = &mut candidates[contact].force;
                for (x, t) in normal.iter_mut().zip(tangential) {
                    *x += strength * t;
                }
            }
            _ => {}
        }
    }
    (candidates, list)
}

/// The generalized force of a unit force of a row.
fn force_of<T: Scalar>(dynamics: &Dynamics<T>, row: usize) -> Vec<f64> {
    let d = dynamics.description();
    let mut force = vec![0.0; d.coordinates.len()];
    for &(j, place) in d.rows[row].jacobian {
        force[j] += dynamics.motion(place).value();
    }
    for coupling in d.couplings.iter().filter(|c| c.row == row) {
        let owner = d.forces.iter().position(|f| f.need == coupling.need);
        if owner.is_none_or(|i| dynamics.effects().includes(d, Item::Force(i))) {
            force[coupling.coordinate] += dynamics.motion(coupling.factor).value();
        }
    }
    force
}

/// G, row-major, and b: what accelerates the rows of the candidates.
fn responses<T: Scalar>(
    dynamics: &Dynamics<T>,
    mode: &Mode,
    candidates: &[Candidate],
) -> Option<(Vec<f64>, Vec<f64>)> {
    let d = dynamics.description();
    let number = |place: ValueRef| dynamics.motion(place).value();
    let n = d.coordinates.len();
    let holds = |i: &usize| {
        dynamics.effects().includes(d, Item::Constraint(*i))
            && d.constraints[*i]
                .while_contact
                .is_none_or(|c| mode.contacts[c])
    };
    let constraints: Vec<usize> = (0..d.constraints.len())
        .filter(holds)
        .map(|i| d.constraints[i].row)
        .collect();
    let size = n + constraints.len();
    let mut matrix = vec![0.0; size * size];
    for &(i, j, place) in d.mass {
        matrix[i * size + j] = number(place);
        matrix[j * size + i] = number(place);
    }
    let mut free = vec![0.0; size];
    for (x, &place) in free.iter_mut().zip(d.forcing) {
        *x = number(place);
    }
    for (k, &row) in constraints.iter().enumerate() {
        for &(j, place) in d.rows[row].jacobian {
            matrix[(n + k) * size + j] += number(place);
        }
        for (j, x) in force_of(dynamics, row).into_iter().enumerate() {
            matrix[j * size + n + k] -= x;
        }
        free[n + k] = -number(d.rows[row].bias);
    }
    let mut factors = Equilibrated::default();
    factors.factor(&mut matrix, size);
    let mut solve = |mut b: Vec<f64>| factors.solve(&mut b).then_some(b);
    let free = solve(free)?;
    let accelerate = |row: usize, motion: &[f64]| -> f64 {
        let terms = d.rows[row].jacobian.iter();
        terms.map(|&(j, place)| number(place) * motion[j]).sum()
    };
    let count = candidates.len();
    let mut g = vec![0.0; count * count];
    for (k, candidate) in candidates.iter().enumerate() {
        let mut side = candidate.force.clone();
        side.resize(size, 0.0);
        let motion = solve(side)?;
        for (i, other) in candidates.iter().enumerate() {
            g[i * count + k] = accelerate(other.row, &motion);
        }
    }
    let b = candidates
        .iter()
        .map(|candidate| accelerate(candidate.row, &free) + number(d.rows[candidate.row].bias));
    Some((g, b.collect()))
}

/// The problem for (λ of the contacts; F⁺, ṡ⁻ of each resting friction).
fn pairs(g: &[f64], b: &[f64], contacts: usize, resting: &[Resting]) -> (Vec<f64>, Vec<f64>) {
    let count = b.len();
    let size = contacts + 2 * resting.len();
    let mut m = vec![0.0; size * size];
    let mut q = vec![0.0; size];
    // Candidate of an accelerated row, and the sign of it.
    let rows = (0..contacts).chain(resting.iter().map(|r| r.own));
    for (k, row) in rows.enumerate() {
        let at = if k < contacts {
            k
        } else {
            contacts + 2 * (k - contacts)
        };
        q[at] = b[row];
        for c in 0..contacts {
            m[at * size + c] = g[row * count + c];
        }
        for (l, r) in resting.iter().enumerate() {
            let column = g[row * count + r.own];
            m[at * size + contacts + 2 * l] = column;
            m[at * size + r.contact] -= r.coefficient * column;
        }
    }
    for (l, r) in resting.iter().enumerate() {
        let at = contacts + 2 * l;
        m[at * size + at + 1] = 1.0;
        m[(at + 1) * size + r.contact] = 2.0 * r.coefficient;
        m[(at + 1) * size + at] = -1.0;
    }
    (m, q)
}
