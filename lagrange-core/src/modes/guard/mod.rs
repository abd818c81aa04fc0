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
use crate::arithmetic::quad::{Memory, Quad, values};
use crate::dynamics::{Dynamics, OutputMask};
use crate::effects::Item;
use crate::integrate::polynomial_sum;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::reading::{Reading, Terms};
use crate::system::{Description, Friction, Normal, ValueRef};

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
    /// (μs N)² − |F|² of a sticking friction whose N has no known sign, or that has two components, in units of [`cone_unit`].
    StickCone(usize),
    /// Slip of a sliding friction, along its direction (of two components, that at the start of the step).
    Slip(usize),
    /// Multiplier of the constraint that carries a friction, times its held sign; of several their part along the force at the start of the step.
    NormalForceSign(usize),
    /// Guard of a branch, times its held side.
    Branch(usize),
    /// Term of a stop: becomes true when it rises through zero.
    Stop(usize, usize),
    /// Term of a mark.
    Mark(usize, usize),
    /// A sum of guards of undetermined forces: index into a list of [`CompositeGuard`](crate::modes::composite::CompositeGuard)s.
    Composite(usize),
}

impl Guard {
    /// Whether it is made of forces.
    pub fn is_force(self) -> bool {
        matches!(
            self,
            Guard::Normal(_)
                | Guard::StickUpper(_)
                | Guard::StickLower(_)
                | Guard::StickCone(_)
                | Guard::NormalForceSign(_)
                | Guard::Composite(_)
        )
    }

    /// Whether it is made of the forces of one item, which the mode determines.
    pub fn is_single_force(self) -> bool {
        self.is_force() && !matches!(self, Guard::Composite(_))
    }

    /// The name of the item whose guard it is; a composite guard has several.
    pub fn name(self, d: &'static Description) -> Option<&'static str> {
        match self {
            Guard::Gap(c) | Guard::Normal(c) | Guard::Region(c) => Some(d.contacts[c].name),
            Guard::StickUpper(f)
            | Guard::StickLower(f)
            | Guard::StickCone(f)
            | Guard::Slip(f)
            | Guard::NormalForceSign(f) => Some(d.frictions[f].name),
            Guard::Branch(b) => Some(d.branches[b].then),
            Guard::Stop(i, _) => Some(d.stops[i].name),
            Guard::Mark(i, _) => Some(d.marks[i].name),
            Guard::Composite(_) => None,
        }
    }
}

/// Adds a number times a series.
fn add<T: Scalar>(out: &mut [f64], (factor, terms): (f64, Terms<T>)) {
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
    add(&mut out, (1.0, terms));
    out
}

/// Lists the guards of a mode (not those of stops and marks) into `out`; `needs` are held.
pub fn guards_of_mode<T: Scalar>(
    mode: &Mode,
    dynamics: &Dynamics<T>,
    needs: &OutputMask,
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
                if by_constraints(friction) {
                    out.push(Guard::NormalForceSign(f));
                }
            }
        }
    }
    for (b, branch) in d.branches.iter().enumerate() {
        if needs.contains(branch.need) {
            out.push(Guard::Branch(b));
        }
    }
}

/// Whether friction `f` cannot hold: its static coefficient is 0.
pub fn fades<T: Scalar>(f: usize, dynamics: &Dynamics<T>) -> bool {
    let place = dynamics.description().frictions[f].static_coefficient;
    !place.varies() && dynamics.motion(place).value() == 0.0
}

/// Whether constraints press a friction, whose N has no known sign.
pub fn by_constraints(friction: &Friction) -> bool {
    matches!(
        friction.normal,
        Normal::Constraint(_) | Normal::Resultant(_)
    )
}

/// The guards of friction `f` while it sticks.
pub fn stick_guards(f: usize, friction: &Friction) -> impl Iterator<Item = Guard> {
    let cone = friction.components > 1 || by_constraints(friction);
    let pair = [Guard::StickUpper(f), Guard::StickLower(f)];
    cone.then_some(Guard::StickCone(f))
        .into_iter()
        .chain(pair.into_iter().filter(move |_| !cone))
}

/// The plane μs N − u·F = 0 that touches the cone of a sticking friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConePlane {
    /// Its direction u.
    pub along: [f64; 2],
    /// N is the sum of the forces of the constraints that press times these, the sign of one or the direction of several; or that of a contact.
    pub pressing: [f64; 3],
}

/// What a guard is made of.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// A number of the motion tape.
    Motion(ValueRef),
    /// A number of the report tape.
    Report(ValueRef),
    /// The force of a row.
    Force(usize),
}

impl Source {
    #[inline]
    fn read<'a, T: Scalar>(self, reading: &Reading<'a, T>) -> Terms<'a, T> {
        match self {
            Source::Motion(place) => reading.motion(place),
            Source::Report(place) => reading.report(place),
            Source::Force(row) => reading.force(row),
        }
    }
}

/// A guard that is one reading times a number, or the sum of two, as long as mode and parameters are what they are.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    first: (f64, Source),
    second: Option<(f64, Source)>,
}

impl Linear {
    /// `None` for guards with products of readings in them, or with a direction that turns.
    pub fn of<T: Scalar>(guard: Guard, mode: &Mode, dynamics: &Dynamics<T>) -> Option<Self> {
        let d = dynamics.description();
        let motion =
            |place: Option<ValueRef>| (1.0, Source::Motion(place.unwrap_or(ValueRef::Zero)));
        let first = match guard {
            Guard::Gap(c) => motion(d.rows[d.contacts[c].row].position),
            Guard::Normal(c) => (1.0, Source::Force(d.contacts[c].row)),
            Guard::Region(c) => motion(d.contacts[c].region),
            Guard::StickUpper(f) | Guard::StickLower(f) => linear_limit(f, dynamics)?,
            Guard::Slip(f) => match mode.frictions[f] {
                FrictionMode::Slip(Sliding {
                    direction: Direction::Fixed([sign, 0.0]),
                    ..
                }) => (sign, Source::Motion(d.rows[d.frictions[f].row].velocity)),
                _ => return None,
            },
            Guard::Branch(b) => {
                let branch = &d.branches[b];
                let sign = if mode.branch(b) { 1.0 } else { -1.0 };
                let source = match branch.after_solve {
                    true => Source::Report(branch.guard),
                    false => Source::Motion(branch.guard),
                };
                (sign, source)
            }
            Guard::Stop(i, k) => (1.0, Source::Report(d.stops[i].terms[k])),
            Guard::Mark(i, k) => (1.0, Source::Report(d.marks[i].terms[k])),
            Guard::StickCone(_) | Guard::NormalForceSign(_) | Guard::Composite(_) => return None,
        };
        let second = match guard {
            Guard::StickUpper(f) => Some((-1.0, Source::Force(d.frictions[f].row))),
            Guard::StickLower(f) => Some((1.0, Source::Force(d.frictions[f].row))),
            _ => None,
        };
        Some(Self { first, second })
    }

    /// See [`series`].
    #[inline(always)]
    pub fn series<T: Scalar, Q: Quad>(
        &self,
        quad: Q,
        reading: &Reading<T>,
        powers: &[f64],
        out: &mut [f64],
    ) -> Sums {
        let (a, x) = self.first;
        let second = self.second.map(|(b, y)| (b, y.read(reading)));
        match (x.read(reading), second) {
            (Terms::Many(x), None) => combine::<T, Q, false>(quad, out, (a, x), (0.0, x), powers),
            (Terms::Many(x), Some((b, Terms::Many(y)))) => {
                combine::<T, Q, true>(quad, out, (a, x), (b, y), powers)
            }
            (x, second) => {
                out.fill(0.0);
                add(out, (a, x));
                second.into_iter().for_each(|part| add(out, part));
                scale(out, powers);
                Sums::of(out)
            }
        }
    }

    /// See [`value`].
    #[inline]
    pub fn value<T: Scalar>(&self, reading: &Reading<T>) -> f64 {
        let number = |(a, x): (f64, Source)| a * x.read(reading).first().value();
        number(self.first) + self.second.map_or(0.0, number)
    }
}

/// Sums of the coefficients of a guard.
#[derive(Clone, Copy, Debug)]
pub struct Sums {
    /// Σ cₖ: the guard at the end of the step.
    pub end: f64,
    /// Σ |cₖ| without the first two.
    pub rest: f64,
}

impl Sums {
    /// Of these coefficients.
    pub fn of(c: &[f64]) -> Self {
        Self {
            end: polynomial_sum(c),
            rest: c.iter().skip(2).map(|c| c.abs()).sum(),
        }
    }
}

/// (a xₖ + b yₖ) pₖ, the second term only if there are `TWO`.
#[inline(always)]
fn combine<T: Scalar, Q: Quad, const TWO: bool>(
    quad: Q,
    out: &mut [f64],
    (a, x): (f64, &[T]),
    (b, y): (f64, &[T]),
    powers: &[f64],
) -> Sums {
    let count = out.len();
    let (out, out_end) = out.as_chunks_mut::<4>();
    let (x, x_end) = x[..count].as_chunks::<4>();
    let (y, y_end) = y[..count].as_chunks::<4>();
    let (p, p_end) = powers[..count].as_chunks::<4>();
    let (mut sums, mut sizes) = (quad.splat(0.0), quad.splat(0.0));
    let mut i = out.len();
    while i > 0 {
        i -= 1;
        let mut c = quad.product(quad.splat(a), quad.four(values(x[i])));
        if TWO {
            c = quad.sum(c, quad.product(quad.splat(b), quad.four(values(y[i]))));
        }
        c = quad.product(c, quad.four(p[i]));
        out[i] = quad.numbers(c);
        if i > 0 {
            sums = quad.sum(sums, c);
            sizes = quad.sum(sizes, quad.magnitudes(c));
        }
    }
    let (mut end, mut rest) = (quad.total(sums), quad.total(sizes));
    let mut i = out_end.len();
    while i > 0 {
        i -= 1;
        let mut c = a * x_end[i].value();
        if TWO {
            c += b * y_end[i].value();
        }
        out_end[i] = c * p_end[i];
        end += out_end[i];
        if i > 1 || !out.is_empty() {
            rest += out_end[i].abs();
        }
    }
    if let Some(&[c0, c1, c2, c3]) = out.first() {
        end = end + (c2 + c3) + c1 + c0;
        rest += c2.abs() + c3.abs();
    }
    Sums { end, rest }
}

/// Coefficients of a guard in powers of the time since the start of the reading, at most [`LENGTH`], each times its factor in
/// `powers`; what a reading does not have is 0.
pub fn series<T: Scalar>(
    guard: Guard,
    mode: &Mode,
    reading: &Reading<'_, T>,
    powers: &[f64],
    out: &mut [f64],
) {
    match Linear::of(guard, mode, reading.dynamics()) {
        Some(linear) => _ = linear.series(Memory, reading, powers, out),
        None => {
            out.fill(0.0);
            of_products(guard, mode, reading, out);
            scale(out, powers);
        }
    }
}

/// The guard itself, at the start of the reading.
pub fn value<T: Scalar>(guard: Guard, mode: &Mode, reading: &Reading<'_, T>) -> f64 {
    match Linear::of(guard, mode, reading.dynamics()) {
        Some(linear) => linear.value(reading),
        None => {
            let mut value = [0.0];
            of_products(guard, mode, reading, &mut value);
            value[0]
        }
    }
}

/// Multiplies each coefficient by its factor.
pub fn scale(series: &mut [f64], powers: &[f64]) {
    for (c, power) in series.iter_mut().zip(powers) {
        *c *= power;
    }
}

/// Adds a guard that is not [`Linear`].
fn of_products<T: Scalar>(guard: Guard, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    match guard {
        Guard::StickUpper(f) => {
            limit(f, mode, reading, out);
            add(out, (-1.0, reading.force(d.frictions[f].row)));
        }
        Guard::StickLower(f) => {
            limit(f, mode, reading, out);
            add(out, (1.0, reading.force(d.frictions[f].row)));
        }
        Guard::StickCone(f) => stick_cone(f, mode, reading, out),
        Guard::NormalForceSign(f) => match d.frictions[f].normal {
            Normal::Resultant(i) => {
                let along = reading.resultant_direction(i).map(|u| u.value());
                add_pressing(f, along, reading, out);
            }
            _ => normal_force(f, mode, reading, out),
        },
        Guard::Slip(f) => {
            let friction = &d.frictions[f];
            let rows = &d.rows[friction.rows()];
            let along = match mode.frictions[f] {
                FrictionMode::Slip(Sliding {
                    direction: Direction::Fixed(along),
                    ..
                }) => along,
                FrictionMode::Slip(_) => reading.slip_direction(f).map(|x| x.value()),
                _ => return,
            };
            for (row, along) in rows.iter().zip(along) {
                add(out, (along, reading.motion(row.velocity)));
            }
        }
        // The others are linear; the parts of a composite guard are known to `redundant` only.
        _ => {}
    }
}

/// μs N, if it is one reading times a number.
fn linear_limit<T: Scalar>(f: usize, dynamics: &Dynamics<T>) -> Option<(f64, Source)> {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    match (friction.normal, friction.static_coefficient) {
        (_, ValueRef::Node(_)) => None,
        (Normal::Contact(c), coefficient) if d.contacts[c].normal_factor.is_none() => {
            let coefficient = dynamics.motion(coefficient).value();
            Some((coefficient, Source::Force(d.contacts[c].row)))
        }
        _ => None,
    }
}

/// Adds μs N.
fn limit<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    if let Some((coefficient, normal)) = linear_limit(f, reading.dynamics()) {
        return add(out, (coefficient, normal.read(reading)));
    }
    let mut normal = [0.0; LENGTH];
    let normal = &mut normal[..out.len()];
    normal_force(f, mode, reading, normal);
    add_static_share(f, normal, reading, out);
}

/// Adds μs times the series `normal`.
fn add_static_share<T: Scalar>(f: usize, normal: &[f64], reading: &Reading<T>, out: &mut [f64]) {
    let friction = &reading.description().frictions[f];
    match reading.motion(friction.static_coefficient) {
        Terms::One(coefficient) => {
            for (c, x) in out.iter_mut().zip(normal) {
                *c += coefficient.value() * *x;
            }
        }
        coefficient => add_product(out, 1.0, &numbers(coefficient), normal),
    }
}

/// What the forces of a cone are divided by before they are squared, of their values at an instant: 1, or where squares are soon no numbers, beyond 1e38 N
/// and below 1e-38 N, a power of two.
pub fn cone_unit(forces: impl Iterator<Item = f64>) -> f64 {
    const STEP: f64 = 256.0;
    let largest = forces.fold(0.0, |largest: f64, force| largest.max(force.abs()));
    if largest > 0.0 {
        (STEP * (largest.log2() / STEP).round().clamp(-3.0, 3.0)).exp2()
    } else {
        1.0
    }
}

/// (μs N)² − Σ F², in [units of their own](cone_unit).
fn stick_cone<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let friction = &reading.description().frictions[f];
    let rows = friction.rows();
    let mut greatest = [0.0; LENGTH];
    let first = |row: usize| reading.force(row).first().value();
    let values = rows.clone().map(first);
    let part = if let normal @ Normal::Resultant(_) = friction.normal {
        // The square has a series also where the root has none.
        let presses = normal.rows(reading.description()).map(first);
        let part = 1.0 / cone_unit(values.chain(presses));
        let coefficient = numbers(reading.motion(friction.static_coefficient));
        let [mut square, mut one] = [[0.0; LENGTH]; 2];
        add_squares(&mut square, part, normal, reading);
        add_product(&mut one, 1.0, &coefficient, &coefficient);
        add_product(out, 1.0, &one, &square);
        part
    } else {
        limit(f, mode, reading, &mut greatest[..out.len()]);
        let part = 1.0 / cone_unit(values.chain([greatest[0]]));
        greatest.iter_mut().for_each(|c| *c *= part);
        add_product(out, 1.0, &greatest, &greatest);
        part
    };
    for row in rows {
        let mut force = [0.0; LENGTH];
        add(&mut force, (part, reading.force(row)));
        add_product(out, -1.0, &force, &force);
    }
}

/// μs N − u·F: how far the force of a sticking friction is inside a plane that touches its cone.
pub fn cone_side<T: Scalar>(
    f: usize,
    plane: ConePlane,
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    let friction = &reading.description().frictions[f];
    out.fill(0.0);
    if by_constraints(friction) {
        let mut normal = [0.0; LENGTH];
        let normal = &mut normal[..out.len()];
        add_pressing(f, plane.pressing, reading, normal);
        add_static_share(f, normal, reading, out);
    } else {
        limit(f, mode, reading, out);
    }
    for (k, &part) in plane.along.iter().enumerate().take(friction.components) {
        add(out, (-part, reading.force(friction.row + k)));
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
                None => add(out, (1.0, multiplier)),
                Some(Terms::One(factor)) => add(out, (factor.value(), multiplier)),
                Some(factor) => add_product(out, 1.0, &numbers(factor), &numbers(multiplier)),
            }
        }
        Normal::Constraint(i) => {
            let sign = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => sliding.normal_sign,
                _ => 1.0,
            };
            add(out, (sign, reading.force(d.constraints[i].row)));
        }
        normal @ Normal::Resultant(_) => {
            let mut square = [0.0; LENGTH];
            let square = &mut square[..out.len()];
            add_squares(square, 1.0, normal, reading);
            add_root(out, square);
        }
        Normal::Given(place) => add(out, (1.0, reading.motion(place))),
    }
}

/// Adds Σ part λ of the rows that press friction `f`.
fn add_pressing<T: Scalar>(f: usize, parts: [f64; 3], reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    for (row, part) in d.frictions[f].normal.rows(d).zip(parts) {
        add(out, (part, reading.force(row)));
    }
}

/// Adds Σ (part λ)² of the rows that press.
fn add_squares<T: Scalar>(out: &mut [f64], part: f64, normal: Normal, reading: &Reading<'_, T>) {
    for row in normal.rows(reading.description()) {
        let mut force = [0.0; LENGTH];
        add(&mut force, (part, reading.force(row)));
        add_product(out, 1.0, &force, &force);
    }
}

/// Adds the root of a series, as far as it has one.
fn add_root(out: &mut [f64], square: &[f64]) {
    let mut root = [0.0; LENGTH];
    root[0] = square[0].sqrt();
    for k in (1..square.len()).take_while(|_| square[0] > 0.0) {
        let products = (1..k).map(|j| root[j] * root[k - j]).sum::<f64>();
        root[k] = (square[k] - products) / (root[0] + root[0]);
    }
    for (c, x) in out.iter_mut().zip(root) {
        *c += x;
    }
}

/// `needs` and everything about every row: Jacobian, residuals, coefficients, restitution, branch guards.
pub fn all_row_needs(d: &Description, needs: &OutputMask) -> OutputMask {
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
