//! Guards: what must stay ≥ 0 for a mode to go on.
//!
//! | state | guard |
//! |---|---|
//! | contact open | gap g ≥ 0 |
//! | contact closed | normal multiplier λ ≥ 0 |
//! | contact limited to a region | region ≥ 0 while closed; where its gap closes while open |
//! | friction sticks | μs N − F ≥ 0 and μs N + F ≥ 0 |
//! | friction slips in direction d | d·s ≥ 0 (two components: d as at the start of the step; arrest where \|s\| vanishes with it) |
//! | branch of a piecewise function | ± its guard ≥ 0 |
//!
//! N = λ·|∂g/∂p|. A guard is read from a [`Reading`] as Taylor coefficients; a plain value is a series of length one.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, NeedSet};
use crate::effects::Item;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::reading::{Reading, Terms};
use crate::system::{Description, Friction, Normal, Place};

/// Longest series of a guard.
pub const LENGTH: usize = 48;

/// One guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// Gap of an open contact.
    Gap(usize),
    /// Multiplier of a closed contact.
    Normal(usize),
    /// Region of a contact that is limited to one.
    Region(usize),
    /// μs N − F of a sticking friction.
    StickUpper(usize),
    /// μs N + F of a sticking friction.
    StickLower(usize),
    /// (μs N)² − |F|² of a sticking friction whose N has no known sign, or that has two components.
    StickCone(usize),
    /// Slip of a sliding friction, along its direction (of two components, that at the start of the step).
    Slip(usize),
    /// Multiplier of the constraint that carries a friction, times its held sign.
    Bearing(usize),
    /// Guard of a branch, times its held side.
    Branch(usize),
    /// Term of a stop: becomes true when it rises through zero.
    Stop(usize, usize),
    /// Term of a mark.
    Mark(usize, usize),
    /// A sum of guards of undetermined forces: index into a list of [`Joint`](crate::modes::sharing::Joint)s.
    Joint(usize),
}

impl Guard {
    /// The name of the item whose guard it is; a joint guard has several.
    pub fn name(self, d: &'static Description) -> Option<&'static str> {
        match self {
            Guard::Gap(c) | Guard::Normal(c) | Guard::Region(c) => Some(d.contacts[c].name),
            Guard::StickUpper(f)
            | Guard::StickLower(f)
            | Guard::StickCone(f)
            | Guard::Slip(f)
            | Guard::Bearing(f) => Some(d.frictions[f].name),
            Guard::Branch(b) => Some(d.branches[b].text),
            Guard::Stop(i, _) => Some(d.stops[i].name),
            Guard::Mark(i, _) => Some(d.marks[i].name),
            Guard::Joint(_) => None,
        }
    }
}

/// Adds `factor` times a series.
fn add<T: Scalar>(out: &mut [f64], factor: f64, terms: Terms<T>) {
    for (c, x) in out.iter_mut().zip(terms.as_slice()) {
        *c += factor * x.value();
    }
}

/// Adds `factor` times the product of two series.
fn add_product(out: &mut [f64], factor: f64, x: &[f64], y: &[f64]) {
    for (k, c) in out.iter_mut().enumerate() {
        let products = x[..=k].iter().zip(y[..=k].iter().rev());
        *c += factor * products.map(|(x, y)| x * y).sum::<f64>();
    }
}

/// A series as numbers.
fn numbers<T: Scalar>(terms: Terms<T>) -> [f64; LENGTH] {
    let mut out = [0.0; LENGTH];
    add(&mut out, 1.0, terms);
    out
}

/// Lists the guards of a mode (not those of stops and marks) into `out`; `needs` are held.
pub fn guards_of_mode<T: Scalar>(
    mode: &Mode,
    dynamics: &Dynamics<T>,
    needs: &NeedSet,
    out: &mut Vec<Guard>,
) {
    let d = dynamics.description();
    out.clear();
    for c in 0..d.contacts.len() {
        if dynamics.effects().includes(d, Item::Contact(c)) {
            out.push(if mode.contacts[c] {
                Guard::Normal(c)
            } else {
                Guard::Gap(c)
            });
            if d.contacts[c].region.is_some() {
                out.push(Guard::Region(c));
            }
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

/// Coefficients of a guard in powers of the time since the start of the reading, at most [`LENGTH`]; what a reading does not
/// have is 0.
pub fn series<T: Scalar>(guard: Guard, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    out.fill(0.0);
    match guard {
        Guard::Gap(c) => {
            let row = &d.rows[d.contacts[c].row];
            add(
                out,
                1.0,
                reading.motion(row.position.unwrap_or(Place::Zero)),
            );
        }
        Guard::Normal(c) => add(out, 1.0, reading.force(d.contacts[c].row)),
        Guard::Region(c) => {
            let region = d.contacts[c].region;
            add(out, 1.0, reading.motion(region.unwrap_or(Place::Zero)));
        }
        Guard::StickUpper(f) => stick(f, -1.0, mode, reading, out),
        Guard::StickLower(f) => stick(f, 1.0, mode, reading, out),
        Guard::StickCone(f) => stick_cone(f, mode, reading, out),
        Guard::Slip(f) => {
            let friction = &d.frictions[f];
            let FrictionMode::Slip(Sliding { direction, .. }) = mode.frictions[f] else {
                return;
            };
            let along = match direction {
                Direction::Fixed(along) => along,
                Direction::AlongSlip | Direction::Incipient(_) => {
                    reading.heading(f).map(|x| x.value())
                }
            };
            for (k, &part) in along.iter().enumerate().take(friction.components) {
                add(out, part, reading.motion(d.rows[friction.row + k].velocity));
            }
        }
        Guard::Bearing(f) => normal_force(f, mode, reading, out),
        Guard::Branch(b) => {
            let branch = &d.branches[b];
            let sign = if mode.branch(b) { 1.0 } else { -1.0 };
            let series = if branch.after_solve {
                reading.report(branch.guard)
            } else {
                reading.motion(branch.guard)
            };
            add(out, sign, series);
        }
        Guard::Stop(i, k) => add(out, 1.0, reading.report(d.stops[i].terms[k])),
        Guard::Mark(i, k) => add(out, 1.0, reading.report(d.marks[i].terms[k])),
        // Its parts are known to `sharing` only.
        Guard::Joint(_) => {}
    }
}

/// The guard itself, at the start of the reading.
pub fn value<T: Scalar>(guard: Guard, mode: &Mode, reading: &Reading<'_, T>) -> f64 {
    let mut value = [0.0];
    series(guard, mode, reading, &mut value);
    value[0]
}

/// Adds μs N.
fn limit<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    let friction = &d.frictions[f];
    if let Terms::One(coefficient) = reading.motion(friction.static_coefficient)
        && let Normal::Contact(c) = friction.normal
        && d.contacts[c].normal_factor.is_none()
    {
        let multiplier = reading.force(d.contacts[c].row);
        return add(out, coefficient.value(), multiplier);
    }
    let mut normal = [0.0; LENGTH];
    let normal = &mut normal[..out.len()];
    normal_force(f, mode, reading, normal);
    match reading.motion(friction.static_coefficient) {
        Terms::One(coefficient) => {
            for (c, x) in out.iter_mut().zip(normal) {
                *c += coefficient.value() * *x;
            }
        }
        coefficient => add_product(out, 1.0, &numbers(coefficient), normal),
    }
}

/// μs N ± F.
fn stick<T: Scalar>(f: usize, sign: f64, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    limit(f, mode, reading, out);
    add(
        out,
        sign,
        reading.force(reading.description().frictions[f].row),
    );
}

/// (μs N)² − Σ F².
fn stick_cone<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let friction = &reading.description().frictions[f];
    let mut greatest = [0.0; LENGTH];
    limit(f, mode, reading, &mut greatest[..out.len()]);
    add_product(out, 1.0, &greatest, &greatest);
    for k in 0..friction.components {
        let force = numbers(reading.force(friction.row + k));
        add_product(out, -1.0, &force, &force);
    }
}

/// μs N − u·F: the side of the cone of a sticking friction in direction u.
pub fn cone_side<T: Scalar>(
    f: usize,
    along: [f64; 2],
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    let friction = &reading.description().frictions[f];
    out.fill(0.0);
    limit(f, mode, reading, out);
    for (k, &part) in along.iter().enumerate().take(friction.components) {
        add(out, -part, reading.force(friction.row + k));
    }
}

/// Adds the normal force N of friction `f`.
pub fn normal_force<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    match d.frictions[f].normal {
        Normal::Contact(c) => {
            let contact = &d.contacts[c];
            let multiplier = reading.force(contact.row);
            match contact.normal_factor.map(|factor| reading.motion(factor)) {
                None => add(out, 1.0, multiplier),
                Some(Terms::One(factor)) => add(out, factor.value(), multiplier),
                Some(factor) => add_product(out, 1.0, &numbers(factor), &numbers(multiplier)),
            }
        }
        Normal::Constraint(i) => {
            let sign = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => sliding.normal_sign,
                _ => 1.0,
            };
            add(out, sign, reading.force(d.constraints[i].row));
        }
        Normal::Given(place) => add(out, 1.0, reading.motion(place)),
    }
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
