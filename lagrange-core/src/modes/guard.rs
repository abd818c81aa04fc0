//! Guards: what must stay ≥ 0 for a mode to go on.
//!
//! | state | guard |
//! |---|---|
//! | contact open | gap g ≥ 0 |
//! | contact closed | normal multiplier λ ≥ 0 |
//! | friction sticks | μs N − F ≥ 0 and μs N + F ≥ 0 |
//! | friction slips in direction d | d·s ≥ 0 |
//! | branch of a piecewise function | ± its guard ≥ 0 |
//!
//! N = λ·|∂g/∂p|. A guard is read from a [`Reading`] as Taylor coefficients; a plain value is a series of length one.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, NeedSet};
use crate::effects::Item;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::reading::{Reading, Terms};
use crate::system::{Description, Friction, Normal, Place, System};

/// Longest series of a guard.
pub const LENGTH: usize = 48;

/// One guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// Gap of an open contact.
    Gap(usize),
    /// Multiplier of a closed contact.
    Normal(usize),
    /// μs N − F of a sticking friction.
    StickUpper(usize),
    /// μs N + F of a sticking friction.
    StickLower(usize),
    /// (μs N)² − |F|² of a sticking friction whose N has no known sign, or that has two components.
    StickCone(usize),
    /// Slip of a sliding friction, along its direction.
    Slip(usize),
    /// Multiplier of the constraint that carries a friction, times its held sign.
    Bearing(usize),
    /// Guard of a branch, times its held side.
    Branch(usize),
    /// Term of a stop: becomes true when it rises through zero.
    Stop(usize, usize),
    /// Term of a mark.
    Mark(usize, usize),
}

/// Coefficients of a guard in powers of the scaled time s = τ/h.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    coefficients: [f64; LENGTH],
    length: usize,
}

impl Series {
    /// The zero series.
    pub const ZERO: Series = Series {
        coefficients: [0.0; LENGTH],
        length: 0,
    };

    /// The coefficients, lowest order first.
    pub fn as_slice(&self) -> &[f64] {
        &self.coefficients[..self.length]
    }

    /// Sets the first `order` coefficients, which are known to vanish, to zero.
    pub fn clear(&mut self, order: usize) {
        let order = order.min(self.length);
        self.coefficients[..order].fill(0.0);
    }

    /// Leaves out the coefficients above `degree`.
    pub fn truncate(&mut self, degree: usize) {
        self.length = self.length.min(degree + 1);
    }

    /// Adds `factor` times a series.
    fn add<T: Scalar>(&mut self, factor: f64, terms: Terms<T>) {
        let series = terms.as_slice();
        self.length = self.length.max(series.len().min(LENGTH));
        for (c, x) in self.coefficients.iter_mut().zip(series) {
            *c += factor * x.value();
        }
    }

    /// Adds `factor` times the product of two series, as long as both are known (a single coefficient is a constant).
    fn add_product(&mut self, factor: f64, x: &Series, y: &Series) {
        let length = match (x.length, y.length) {
            (0, _) | (_, 0) => return,
            (1, n) | (n, 1) => n,
            (m, n) => m.min(n),
        };
        self.length = self.length.max(length);
        for k in 0..length {
            let low = k.saturating_sub(y.length - 1);
            let high = k.min(x.length - 1);
            let mut sum = 0.0;
            for j in low..=high {
                sum += x.coefficients[j] * y.coefficients[k - j];
            }
            self.coefficients[k] += factor * sum;
        }
    }

    /// Adds `term(k)` to each of the first `length` coefficients.
    pub fn accumulate(&mut self, length: usize, term: impl Fn(usize) -> f64) {
        self.length = length.min(LENGTH);
        for (k, c) in self.coefficients[..self.length].iter_mut().enumerate() {
            *c += term(k);
        }
    }

    /// Multiplies the k-th coefficient by hᵏ.
    fn scale(&mut self, h: f64) {
        let mut power = 1.0;
        for c in &mut self.coefficients[..self.length] {
            *c *= power;
            power *= h;
        }
    }

    fn of<T: Scalar>(terms: Terms<T>) -> Series {
        let mut s = Series::ZERO;
        s.add(1.0, terms);
        s
    }
}

/// Lists the guards of a mode (not those of stops and marks) into `out`; `needs` are held.
pub fn guards_of_mode<S: System>(
    mode: &Mode,
    dynamics: &Dynamics<S>,
    needs: &NeedSet,
    out: &mut Vec<Guard>,
) {
    let d = S::DESCRIPTION;
    out.clear();
    for c in 0..d.contacts.len() {
        if dynamics.effects().includes(d, Item::Contact(c)) {
            out.push(if mode.contacts[c] {
                Guard::Normal(c)
            } else {
                Guard::Gap(c)
            });
        }
    }
    for (f, friction) in d.frictions.iter().enumerate() {
        match mode.frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => out.extend(stick_guards(f, friction)),
            FrictionMode::Slip(_) => {
                out.push(Guard::Slip(f));
                if let Normal::Constraint(_) = friction.normal {
                    out.push(Guard::Bearing(f));
                }
            }
        }
    }
    for (b, branch) in d.branches.iter().enumerate() {
        if branch.users.iter().any(|&user| needs.contains(user)) {
            out.push(Guard::Branch(b));
        }
    }
}

/// The guards of friction `f` while it sticks.
pub fn stick_guards(f: usize, friction: &Friction) -> impl Iterator<Item = Guard> {
    let cone = friction.components > 1 || matches!(friction.normal, Normal::Constraint(_));
    let pair = [Guard::StickUpper(f), Guard::StickLower(f)];
    cone.then_some(Guard::StickCone(f))
        .into_iter()
        .chain(pair.into_iter().filter(move |_| !cone))
}

/// Coefficients of a guard over a step of length h.
pub fn series<S: System>(guard: Guard, mode: &Mode, reading: &Reading<'_, S>, h: f64) -> Series {
    let d = S::DESCRIPTION;
    let mut out = Series::ZERO;
    match guard {
        Guard::Gap(c) => {
            let row = &d.rows[d.contacts[c].row];
            out.add(1.0, reading.motion(row.position.unwrap_or(Place::Zero)));
        }
        Guard::Normal(c) => out.add(1.0, reading.force(d.contacts[c].row)),
        Guard::StickUpper(f) => stick(f, -1.0, mode, reading, &mut out),
        Guard::StickLower(f) => stick(f, 1.0, mode, reading, &mut out),
        Guard::StickCone(f) => stick_cone(f, mode, reading, &mut out),
        Guard::Slip(f) => {
            let friction = &d.frictions[f];
            if let FrictionMode::Slip(Sliding {
                direction: Direction::Fixed(along),
                ..
            }) = mode.frictions[f]
            {
                for (k, &part) in along.iter().enumerate().take(friction.components) {
                    out.add(part, reading.motion(d.rows[friction.row + k].velocity));
                }
            }
        }
        Guard::Bearing(f) => normal_force(f, mode, reading, &mut out),
        Guard::Branch(b) => {
            let branch = &d.branches[b];
            let sign = if mode.branch(b) { 1.0 } else { -1.0 };
            let series = if branch.after_solve {
                reading.report(branch.guard)
            } else {
                reading.motion(branch.guard)
            };
            out.add(sign, series);
        }
        Guard::Stop(i, k) => out.add(1.0, reading.report(d.stops[i].terms[k])),
        Guard::Mark(i, k) => out.add(1.0, reading.report(d.marks[i].terms[k])),
    }
    out.scale(h);
    out
}

/// μs N ± F.
fn stick<S: System>(f: usize, sign: f64, mode: &Mode, reading: &Reading<'_, S>, out: &mut Series) {
    let friction = &S::DESCRIPTION.frictions[f];
    let mut normal = Series::ZERO;
    normal_force(f, mode, reading, &mut normal);
    let coefficient = Series::of(reading.motion(friction.static_coefficient));
    out.add_product(1.0, &coefficient, &normal);
    out.add(sign, reading.force(friction.row));
}

/// (μs N)² − Σ F².
fn stick_cone<S: System>(f: usize, mode: &Mode, reading: &Reading<'_, S>, out: &mut Series) {
    let friction = &S::DESCRIPTION.frictions[f];
    let mut normal = Series::ZERO;
    normal_force(f, mode, reading, &mut normal);
    let coefficient = Series::of(reading.motion(friction.static_coefficient));
    let mut limit = Series::ZERO;
    limit.add_product(1.0, &coefficient, &normal);
    out.add_product(1.0, &limit, &limit);
    for k in 0..friction.components {
        let force = Series::of(reading.force(friction.row + k));
        out.add_product(-1.0, &force, &force);
    }
}

/// The normal force N of friction `f`.
pub fn normal_force<S: System>(f: usize, mode: &Mode, reading: &Reading<'_, S>, out: &mut Series) {
    let d = S::DESCRIPTION;
    match d.frictions[f].normal {
        Normal::Contact(c) => {
            let contact = &d.contacts[c];
            let multiplier = reading.force(contact.row);
            match contact.normal_factor {
                None => out.add(1.0, multiplier),
                Some(factor) => {
                    out.add_product(
                        1.0,
                        &Series::of(reading.motion(factor)),
                        &Series::of(multiplier),
                    );
                }
            }
        }
        Normal::Constraint(i) => {
            let sign = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => sliding.normal_sign,
                _ => 1.0,
            };
            out.add(sign, reading.force(d.constraints[i].row));
        }
        Normal::Given(place) => out.add(1.0, reading.motion(place)),
    }
}

/// First coefficient of each guard, at the start of the series that `dynamics` holds.
pub fn first_values<S: System>(
    dynamics: &Dynamics<S>,
    mode: &Mode,
    guards: impl Iterator<Item = Guard>,
) -> Vec<f64> {
    let reading = Reading::Series(dynamics);
    guards
        .map(|g| {
            series(g, mode, &reading, 1.0)
                .as_slice()
                .first()
                .copied()
                .unwrap_or(0.0)
        })
        .collect()
}

/// `needs` and everything about every row: Jacobian, residuals, coefficients, restitution, branch guards.
pub fn all_row_needs(d: &Description, needs: &NeedSet) -> NeedSet {
    let mut all = needs.clone();
    for row in d.rows {
        for need in [row.needs.jacobian, row.needs.position, row.needs.velocity] {
            all.insert(need);
        }
    }
    d.contacts
        .iter()
        .for_each(|c| all.insert(c.restitution_need));
    d.frictions
        .iter()
        .for_each(|f| all.insert(f.coefficients_need));
    d.branches
        .iter()
        .filter(|b| !b.after_solve)
        .for_each(|b| all.insert(b.need));
    all
}
