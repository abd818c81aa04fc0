//! Impacts: velocities jump, positions do not.
//!
//! ```text
//! M (v⁺ − v⁻) = Σ aᵢᵀ Λᵢ
//! contact   Λₙ ≥ 0 ⟂ ġ⁺ + e ġ⁻ ≥ 0            (Newton's restitution, contacts together)
//! friction  s⁺ = 0 with |Λₜ| ≤ μs Λₙ, else Λₜ = −sign(s⁺) μk Λₙ
//! bilateral ġ⁺ = 0
//! ```
//!
//! Moreau (1988); Glocker (2001), chapter 6; Brogliato (2016), chapter 4. Solved by enumeration of which contacts
//! take part and which frictions stick. Against fixed surfaces an impact never adds energy: where Newton's law with
//! friction would (Kane & Levinson 1985), the restitution is lowered to the largest value that does not.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::error::Error;
use crate::linear::solve_consistent;
use crate::system::{Normal, Place, Restitution, System};

/// What an impact does.
#[derive(Clone, Debug)]
pub struct Impact<T> {
    /// Velocities after it.
    pub v: Vec<T>,
    /// Impulse of every row.
    pub impulses: Vec<T>,
    /// Per contact: the gap rate vanishes afterwards, by the law and not by chance.
    pub stays: Vec<bool>,
    /// Per contact: takes part with an impulse.
    pub struck: Vec<bool>,
    /// Per friction: the slip vanishes afterwards.
    pub sticks: Vec<bool>,
    /// Whether the restitution was lowered.
    pub lowered: bool,
}

/// The data of an impact at one state.
struct Collision<'a, S: System> {
    dynamics: &'a Dynamics<S>,
    v: &'a [S::Scalar],
    /// Contacts whose gap vanishes.
    near: &'a [usize],
    /// Rows of bilateral constraints that always act.
    bilateral: Vec<usize>,
    /// `while` rows with their contact.
    conditional: Vec<(usize, usize)>,
    /// Frictions on near contacts: (friction, contact).
    frictions: Vec<(usize, usize)>,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Sliding {
    Stick,
    Along(f64),
}

/// Solves the impact of the contacts `near` (gap zero) at velocities `v`; `dynamics` holds the values of the state,
/// with the Jacobians of all rows.
///
/// # Errors
/// [`Error::NoMode`] if no combination satisfies the law.
pub fn impact<S: System>(
    dynamics: &Dynamics<S>,
    t: f64,
    v: &[S::Scalar],
    near: &[usize],
) -> Result<Impact<S::Scalar>, Error> {
    let d = S::DESCRIPTION;
    let effects = dynamics.effects();
    let constraints = d
        .constraints
        .iter()
        .enumerate()
        .filter(|(i, _)| effects.includes(d, Item::Constraint(*i)));
    let collision = Collision {
        dynamics,
        v,
        near,
        bilateral: constraints
            .clone()
            .filter(|(_, c)| c.while_contact.is_none())
            .map(|(_, c)| c.row)
            .collect(),
        conditional: constraints
            .filter_map(|(_, c)| c.while_contact.map(|w| (c.row, w)))
            .collect(),
        frictions: (0..d.frictions.len())
            .filter(|f| effects.includes(d, Item::Friction(*f)))
            .filter_map(|f| match d.frictions[f].normal {
                Normal::Contact(c) if near.contains(&c) => Some((f, c)),
                _ => None,
            })
            .collect(),
    };
    let error = || Error::NoMode {
        time: t,
        mode: dynamics.mode().display(d).to_string(),
        item: d.contacts[near[0]].name,
        tried: 1 << near.len(),
    };
    let full = collision.solve(1.0).ok_or_else(error)?;
    if !collision.gains(&full) {
        return Ok(full);
    }
    // Largest share of the restitution that does not add energy. Without any the impact is plastic, which never does.
    let (mut low, mut high) = (0.0, 1.0);
    let mut best = collision.solve(0.0).ok_or_else(error)?;
    for _ in 0..60 {
        let share = 0.5 * (low + high);
        match collision.solve(share) {
            Some(trial) if !collision.gains(&trial) => {
                low = share;
                best = trial;
            }
            _ => high = share,
        }
    }
    best.lowered = true;
    Ok(best)
}

impl<S: System> Collision<'_, S> {
    fn jacobian(&self, row: usize, out: &mut [S::Scalar]) {
        out.fill(<S::Scalar as num_traits::Zero>::zero());
        for &(j, place) in S::DESCRIPTION.rows[row].jacobian {
            out[j] = self.number(place);
        }
    }

    fn number(&self, place: Place) -> S::Scalar {
        self.dynamics.motion(place)
    }

    fn restitution(&self, contact: usize) -> S::Scalar {
        match S::DESCRIPTION.contacts[contact].restitution {
            Restitution::Newton(place) | Restitution::Poisson(place) => self.number(place),
        }
    }

    /// Velocity residual of a row before the impact.
    fn rate(&self, row: usize) -> S::Scalar {
        self.number(S::DESCRIPTION.rows[row].velocity)
    }

    /// All combinations: all contacts active and all frictions sticking first.
    fn solve(&self, share: f64) -> Option<Impact<S::Scalar>> {
        let contacts = self.near.len();
        for open in 0..1_u64 << contacts {
            let active: Vec<usize> = (0..contacts)
                .filter(|k| open >> k & 1 == 0)
                .map(|k| self.near[k])
                .collect();
            let frictions: Vec<(usize, usize)> = self
                .frictions
                .iter()
                .copied()
                .filter(|(_, c)| active.contains(c))
                .collect();
            for code in 0..3_usize.pow(frictions.len() as u32) {
                let sliding: Vec<Sliding> = (0..frictions.len())
                    .map(|k| match code / 3_usize.pow(k as u32) % 3 {
                        0 => Sliding::Stick,
                        1 => Sliding::Along(1.0),
                        _ => Sliding::Along(-1.0),
                    })
                    .collect();
                if let Some(impact) = self.attempt(&active, &frictions, &sliding, share) {
                    return Some(impact);
                }
            }
        }
        None
    }

    /// Solves one combination and checks it.
    fn attempt(
        &self,
        active: &[usize],
        frictions: &[(usize, usize)],
        sliding: &[Sliding],
        share: f64,
    ) -> Option<Impact<S::Scalar>> {
        let d = S::DESCRIPTION;
        let zero = S::Scalar::default();
        let n = d.coordinates.len();
        let mut rows: Vec<(usize, S::Scalar)> = Vec::new();
        let keep = |row: usize| (row, -self.rate(row));
        rows.extend(self.bilateral.iter().map(|&row| keep(row)));
        rows.extend(
            self.conditional
                .iter()
                .filter(|(_, c)| active.contains(c))
                .map(|&(row, _)| keep(row)),
        );
        for &c in active {
            let row = d.contacts[c].row;
            let bounce = S::Scalar::from_f64(share) * self.restitution(c);
            rows.push((
                row,
                -(num_traits::one::<S::Scalar>() + bounce) * self.rate(row),
            ));
        }
        for (&(f, _), state) in frictions.iter().zip(sliding) {
            if *state == Sliding::Stick {
                rows.push(keep(d.frictions[f].row));
            }
        }
        // [M −Bᵀ; A 0] (Δv, Λ) = (0, Δrate)
        let size = n + rows.len();
        let mut matrix = vec![zero; size * size];
        let mut right = vec![zero; size];
        for &(i, j, place) in d.mass {
            matrix[i * size + j] = self.number(place);
            matrix[j * size + i] = self.number(place);
        }
        let mut a = vec![zero; n];
        for (k, &(row, change)) in rows.iter().enumerate() {
            self.jacobian(row, &mut a);
            for j in 0..n {
                matrix[(n + k) * size + j] = a[j];
                matrix[j * size + n + k] -= a[j];
            }
            right[n + k] = change;
        }
        for (&(f, c), state) in frictions.iter().zip(sliding) {
            if let Sliding::Along(sign) = *state {
                let column = n + rows.iter().position(|(row, _)| *row == d.contacts[c].row)?;
                let factor = S::Scalar::from_f64(sign) * self.kinetic(f, c);
                self.jacobian(d.frictions[f].row, &mut a);
                for j in 0..n {
                    matrix[j * size + column] += factor * a[j];
                }
            }
        }
        if !solve_consistent(&mut matrix, &mut right, size) {
            return None;
        }
        let v: Vec<S::Scalar> = (0..n).map(|j| self.v[j] + right[j]).collect();
        let mut impulses = vec![zero; d.rows.len()];
        for (k, &(row, _)) in rows.iter().enumerate() {
            impulses[row] = right[n + k];
        }
        for (&(f, c), state) in frictions.iter().zip(sliding) {
            if let Sliding::Along(sign) = *state {
                impulses[d.frictions[f].row] =
                    -S::Scalar::from_f64(sign) * self.kinetic(f, c) * impulses[d.contacts[c].row];
            }
        }
        self.check(active, frictions, sliding, share, v, impulses, &right[..n])
    }

    /// μk times the factor from multiplier to normal force.
    fn kinetic(&self, f: usize, contact: usize) -> S::Scalar {
        self.number(S::DESCRIPTION.frictions[f].kinetic_coefficient) * self.factor(contact)
    }

    fn factor(&self, contact: usize) -> S::Scalar {
        S::DESCRIPTION.contacts[contact]
            .normal_factor
            .map_or(num_traits::one(), |p| self.number(p))
    }

    /// The inequalities, with rounding judged against the speeds and impulses of this impact.
    #[allow(clippy::too_many_arguments)]
    fn check(
        &self,
        active: &[usize],
        frictions: &[(usize, usize)],
        sliding: &[Sliding],
        share: f64,
        v: Vec<S::Scalar>,
        impulses: Vec<S::Scalar>,
        change: &[S::Scalar],
    ) -> Option<Impact<S::Scalar>> {
        let d = S::DESCRIPTION;
        let speed = self
            .near
            .iter()
            .map(|c| self.rate(d.contacts[*c].row).value().abs())
            .chain(
                frictions
                    .iter()
                    .map(|(f, _)| self.rate(d.frictions[*f].row).value().abs()),
            )
            .fold(0.0, f64::max);
        let impulse = impulses.iter().map(|x| x.value().abs()).fold(0.0, f64::max);
        let (tiny_speed, tiny_impulse) = (1e-13 * speed, 1e-13 * impulse);
        let mut a = vec![S::Scalar::default(); change.len()];
        let mut rate_after = |row: usize| {
            self.jacobian(row, &mut a);
            let jump: f64 = a
                .iter()
                .zip(change)
                .map(|(x, y)| x.value() * y.value())
                .sum();
            self.rate(row).value() + jump
        };
        let mut stays = vec![false; d.contacts.len()];
        let mut struck = vec![false; d.contacts.len()];
        for &c in self.near {
            let row = d.contacts[c].row;
            let bounce = share * self.restitution(c).value() * self.rate(row).value();
            if active.contains(&c) {
                if impulses[row].value() < -tiny_impulse {
                    return None;
                }
                stays[c] = bounce == 0.0 || bounce.abs() <= tiny_speed;
                struck[c] = impulses[row].value() > tiny_impulse;
            } else {
                let rate = rate_after(row);
                if rate + bounce < -tiny_speed {
                    return None;
                }
                stays[c] = rate.abs() <= tiny_speed;
            }
        }
        let mut sticks = vec![false; d.frictions.len()];
        for (&(f, c), state) in frictions.iter().zip(sliding) {
            let normal = self.factor(c).value() * impulses[d.contacts[c].row].value();
            let tangential = impulses[d.frictions[f].row].value();
            match *state {
                Sliding::Stick => {
                    let limit = self.number(d.frictions[f].static_coefficient).value() * normal;
                    if tangential.abs() > limit + tiny_impulse {
                        return None;
                    }
                    sticks[f] = true;
                }
                Sliding::Along(sign) => {
                    let slip = sign * rate_after(d.frictions[f].row);
                    if slip < -tiny_speed {
                        return None;
                    }
                    // Other contacts may have stopped the slip that this friction allows.
                    sticks[f] = slip <= tiny_speed;
                }
            }
        }
        Some(Impact {
            v,
            impulses,
            stays,
            struck,
            sticks,
            lowered: false,
        })
    }

    /// Whether the impact adds kinetic energy although no surface moves.
    fn gains(&self, impact: &Impact<S::Scalar>) -> bool {
        let d = S::DESCRIPTION;
        let (mut gain, mut size) = (0.0, 0.0);
        for &(i, j, place) in d.mass {
            let m = self.number(place).value() * if i == j { 0.5 } else { 1.0 };
            let after = m * impact.v[i].value() * impact.v[j].value();
            let before = m * self.v[i].value() * self.v[j].value();
            gain += after - before;
            size += after.abs() + before.abs();
        }
        gain > 1e-13 * size && !self.moves()
    }

    /// Whether a row that takes part has a rate of its own (a v + b with b ≠ 0).
    fn moves(&self) -> bool {
        let d = S::DESCRIPTION;
        let mut a = vec![S::Scalar::default(); self.v.len()];
        let rows = self
            .near
            .iter()
            .map(|c| d.contacts[*c].row)
            .chain(self.bilateral.iter().copied());
        rows.chain(self.frictions.iter().map(|(f, _)| d.frictions[*f].row))
            .any(|row| {
                self.jacobian(row, &mut a);
                let own: f64 = a
                    .iter()
                    .zip(self.v)
                    .map(|(x, y)| x.value() * y.value())
                    .sum();
                let size: f64 = a
                    .iter()
                    .zip(self.v)
                    .map(|(x, y)| (x.value() * y.value()).abs())
                    .sum();
                (self.rate(row).value() - own).abs() > 1e-12 * size.max(f64::MIN_POSITIVE)
            })
    }
}
