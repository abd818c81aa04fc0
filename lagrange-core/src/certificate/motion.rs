//! The whole run, step by step: what the polynomials of a step say against the accelerations and forces that are reported, and
//! how steps join.
//!
//! Dense output of Runge–Kutta methods is of lower order than their steps, so its derivative says little. What a step promises is
//! its end: v(end) − v(0) − ∫ a dt and q(end) − q(0) − ∫ v dt, with the reported accelerations a along the dense output, are the
//! error of the step and h·∂a/∂q times that of the dense output. The integrals are by Gauss–Legendre quadrature. In stiff systems h·∂a/∂v is
//! large: of the steps of Radau what counts is the part of the error that is not damped at once.
//!
//! Where the dense output is as good as the step, as a Taylor series is, its defects q̇ − v and v̇ − a are as small as its error. Then their
//! absolute values at three places, by Radau's quadrature, are more than the integral of a defect that grows towards the end, and
//! where that is below the tolerance nothing else is evaluated.

use super::equations::{Equations, Situation};
use super::instant::Energies;
use super::watch::{Step, Watches};
use super::{Certificate, FINEST, Findings, ROUNDINGS, Subject};
use crate::arithmetic::Scalar;
use crate::checks::state::signed;
use crate::declaration::Declaration;
use crate::dynamics::Dynamics;
use crate::dynamics::OutputMask;
use crate::error::Error;
use crate::integrate::{Acceleration, Method, Radau, least_size};
use crate::mode::{FrictionMode, Mode};
use crate::modes::guard::all_row_needs;
use crate::modes::redundant::RedundantForces;
use crate::system::Friction;
use crate::trajectory::{EventKind, Segment, State, Trajectory};
use nalgebra::{DMatrix, DVector};

/// Everything about a run that is being checked.
pub(super) struct Examination<'a, T: Scalar> {
    pub record: &'a Trajectory<T>,
    pub equations: Equations,
    pub findings: Findings,
    pub watches: Watches,
    /// Events that have been looked at.
    pub events: usize,
    /// State in which the motion is to go on.
    pub expected: State<f64>,
    /// What rounding may make of it: the part [`FINEST`] of how large it was in the step before, from where it may have come to rest.
    rounding: State<f64>,
    /// [`FINEST`] of the numbers of the run.
    finest: f64,
    /// Its time, s.
    pub time: f64,
    /// Steps within which something could not be evaluated.
    pub unevaluated: usize,
    dynamics: Dynamics<T>,
    redundant: RedundantForces<T>,
    /// What is read of all rows.
    rows: OutputMask,
    /// The modes of the run, once slips that begin in them have begun.
    modes: Vec<Mode>,
    scratch: State<T>,
    /// Derivatives of the polynomials of a step, and accelerations.
    rates: State<T>,
    acceleration: Vec<T>,
    /// What errors had left of slips as they began in the step.
    left: Vec<[T; 2]>,
    polynomials: Step,
    /// Ends of the step, errors, and what they are measured by.
    begin: State<f64>,
    last: State<f64>,
    errors: State<f64>,
    sizes: State<f64>,
    /// The first coordinate of each attitude.
    attitudes: Vec<usize>,
    /// Nodes and weights of the quadrature of the last step.
    nodes: Vec<(f64, f64)>,
}

/// So much before its end, as a share, a step is looked at for its end.
const SHORTLY: f64 = 1e-9;

/// Nodes and weights of Radau's quadrature with three places in [0, 1], the last of them the end (Hairer & Wanner 1996, section IV.5).
const RADAU: [(f64, f64); 3] = [
    (0.155_051_025_721_682_2, 0.376_403_062_700_467_3),
    (0.644_948_974_278_317_8, 0.512_485_826_188_421_6),
    (1.0, 1.0 / 9.0),
];

/// The balance of forces is looked at in this many steps after every change of the mode,
const FIRST: usize = 4;

/// and in this share of those that follow.
const SHARE: f64 = 0.25;

/// A step of fewer units of rounding of its time, as between two branches that change at one instant, has no inside: of an instant in it
/// rounding says on which side of them it is.
const NARROW: f64 = 4.0;

/// What is looked at in a step besides its motion and its guards.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// The part of it that is chosen.
    part: f64,
    /// Whether forces are looked at there.
    balances: bool,
}

/// See [`Trajectory::verify`](crate::trajectory::Trajectory::verify).
pub(crate) fn verify<T: Scalar>(
    record: &Trajectory<T>,
    seed: u64,
    share: f64,
) -> Result<Certificate, Error> {
    record.check_recorded()?;
    Ok(against(record, record.system.declaration(), seed, share))
}

/// The run checked against a declaration.
pub(super) fn against<T: Scalar>(
    record: &Trajectory<T>,
    declaration: &'static Declaration,
    seed: u64,
    share: f64,
) -> Certificate {
    let d = record.description();
    let tolerance = record.asked.tolerance;
    let mut certificate = Certificate {
        checks: Vec::new(),
        tolerance,
        steps: record.segments.len(),
        looked: 0,
        unevaluated: 0,
    };
    if declaration.words.is_empty() {
        return certificate;
    }
    let rounding = match T::from_f64(1.0 + 1e-12).value() == 1.0 {
        true => f64::from(f32::EPSILON),
        false => f64::EPSILON,
    };
    let parameters = (0..d.parameters.len()).map(|i| record.parameter(i).value());
    let parameters: Vec<f64> = parameters.collect();
    let mut dynamics = record.dynamics();
    let mut needs = OutputMask::new(d);
    needs.insert(d.energy.need);
    let loads = d.forces.iter().map(|force| force.report_need);
    loads.for_each(|need| needs.insert(need));
    dynamics.set_report_needs(&needs);
    let start = numbers(&record.start);
    let finest = FINEST * rounding / f64::EPSILON;
    let mut examination = Examination {
        record,
        equations: Equations::new(
            d,
            declaration,
            &record.effects,
            &parameters,
            record.asked.sizes.clone(),
            ROUNDINGS * rounding,
        ),
        findings: Findings::new(tolerance.max(finest), rounding),
        watches: Watches::new(record, declaration, &parameters),
        events: 0,
        expected: start.clone(),
        rounding: State::new(vec![0.0; start.q.len()], vec![0.0; start.v.len()]),
        finest,
        time: record.first_time(),
        unevaluated: 0,
        dynamics,
        redundant: RedundantForces::default(),
        rows: all_row_needs(d, &OutputMask::new(d)),
        modes: record.modes.iter().map(Mode::under_way).collect(),
        scratch: record.start.clone(),
        rates: record.start.clone(),
        acceleration: record.start.v.clone(),
        left: Vec::new(),
        polynomials: Step::default(),
        begin: start.clone(),
        last: start.clone(),
        errors: start.clone(),
        sizes: start,
        attitudes: d.constraints.iter().filter_map(|c| c.attitude).collect(),
        nodes: Vec::new(),
    };
    let mut random = fastrand::Rng::with_seed(seed);
    let (mut mode, mut alike) = (usize::MAX, 0);
    let segments = record.segments.iter().enumerate();
    let chosen = segments.map(|(k, segment)| {
        let (looked, part) = (signed(&mut random), signed(&mut random));
        if segment.mode != mode {
            (mode, alike) = (segment.mode, 0);
        }
        alike += 1;
        let width = (segment.h * segment.end).value();
        let narrow = width <= NARROW * rounding * segment.t.value().abs();
        let last = k + 1 == record.segments.len();
        let looked = k == 0 || last || looked < 2.0 * share - 1.0;
        looked.then(|| {
            let balances = alike <= FIRST || signed(&mut random) < 2.0 * SHARE - 1.0 || last;
            Look {
                part: segment.end.value() * (0.5 + 0.5 * part),
                balances: balances && !narrow,
            }
        })
    });
    let chosen: Vec<Option<Look>> = chosen.collect();
    certificate.looked = chosen.iter().flatten().count();
    examination.steps(&chosen);
    certificate.unevaluated = examination.unevaluated;
    let promised = !matches!(
        record.asked.method,
        Method::RungeKutta4 { .. } | Method::Gauss6 { .. }
    );
    for mut check in examination.findings.checks {
        if !promised && matches!(check.subject, Subject::Motion | Subject::Joins) {
            check.bound = f64::INFINITY;
        }
        if check.count > 0 {
            certificate.checks.push(check);
        }
    }
    certificate
}

/// A state as numbers.
pub(super) fn numbers<T: Scalar>(state: &State<T>) -> State<f64> {
    let plain = |list: &[T]| list.iter().map(|x| x.value()).collect();
    State::new(plain(&state.q), plain(&state.v))
}

/// Copies a state as numbers.
fn copy<T: Scalar>(state: &State<T>, to: &mut State<f64>) {
    let lists = [(&state.q, &mut to.q), (&state.v, &mut to.v)];
    for (from, to) in lists {
        to.iter_mut().zip(from).for_each(|(to, x)| *to = x.value());
    }
}

impl<T: Scalar> Examination<'_, T> {
    /// What is reported at the chosen instants, if it can be evaluated; whether that balances, and how large forces are in the run.
    fn balances(&mut self, chosen: &[Option<Look>]) -> Vec<Option<Reported>> {
        let look = |(k, look): (usize, &Option<Look>)| {
            let look = look.filter(|look| look.balances)?;
            let reported = self.report(k, look.part).ok()?;
            let at = reported.situation(self.record.description().coordinates.len());
            let mode = &self.modes[self.record.segments[k].mode];
            let (equations, findings) = (&mut self.equations, &mut self.findings);
            equations.examine_balance(at, mode, reported.energies, findings);
            Some(reported)
        };
        chosen.iter().enumerate().map(look).collect()
    }

    fn steps(&mut self, chosen: &[Option<Look>]) {
        let record = self.record;
        let reported = self.balances(chosen);
        for (k, segment) in record.segments.iter().enumerate() {
            let (t, h, end) = (segment.t.value(), segment.h.value(), segment.end.value());
            self.place(k, 0.0);
            copy(&self.scratch, &mut self.begin);
            let begin = core::mem::take(&mut self.begin);
            self.bridge(k);
            self.events_until(t, &begin, k == 0, t + h * end > t);
            self.join(t, &begin);
            // Also where a mode ends as it begins.
            self.time = t;
            self.begin = begin;
            if h * end > 0.0 {
                self.place(k, end);
                copy(&self.scratch, &mut self.last);
                if let Some(look) = chosen[k] {
                    // Where constraints lose rank within a step there are no forces.
                    let known = reported[k].is_some() || !look.balances;
                    let looked = self.step(k, reported[k].as_ref());
                    self.unevaluated += usize::from(!known || looked.is_err());
                    let at = Situation::of_state(t + h * end, &self.last);
                    self.equations.take(at);
                    let mode = &self.modes[segment.mode];
                    self.equations
                        .examine_positions(at, mode, &mut self.findings);
                } else if self.watches.remembers(&self.modes[segment.mode]) {
                    // What cannot be evaluated counts where the step is looked at.
                    _ = self.watch(k);
                }
                self.take_rounding();
                core::mem::swap(&mut self.expected, &mut self.last);
                self.time = t + h * end;
            }
        }
        let last = numbers(&record.last);
        self.events_until(f64::INFINITY, &last, false, true);
        self.join(record.last_time(), &last);
    }

    /// A slip of two components comes to rest a moment after the step before: until then the motion goes on as that step ends, unless it ends
    /// with an impact, the last before infinitely many that take this time.
    fn bridge(&mut self, k: usize) {
        let record = self.record;
        let Some(before) = k.checked_sub(1).map(|k| &record.segments[k]) else {
            return;
        };
        let left = record.segments[k].t.value() - self.time;
        let d = record.description();
        let slips = |(state, friction): (&FrictionMode, &Friction)| {
            matches!(state, FrictionMode::Slip(_)) && friction.components > 1
        };
        let mut frictions = self.modes[before.mode].frictions.iter().zip(d.frictions);
        let next = record.events().get(self.events);
        let ends = next.is_some_and(|event| event.time.value() <= self.time);
        if ends || !(left > 0.0 && frictions.any(slips)) {
            return;
        }
        self.enter(before);
        if self.accelerate(before, before.end).is_err() {
            return;
        }
        let State { q, v, .. } = &mut self.expected;
        for ((q, v), a) in q.iter_mut().zip(v).zip(&self.acceleration) {
            let change = left * a.value();
            *q += left * (*v + 0.5 * change);
            *v += change;
        }
    }

    /// One step, with what is reported at an instant in it.
    fn step(&mut self, k: usize, reported: Option<&Reported>) -> Result<(), Error> {
        let segment = &self.record.segments[k];
        self.watch(k)?;
        if let Some(reported) = reported {
            let at = reported.situation(self.begin.q.len());
            self.equations.take(at);
            let mode = &self.modes[segment.mode];
            self.equations.examine(at, mode, &mut self.findings);
            // What a force has done wrong since some instant of a long step shows at its end; at that itself a condition may already be on its other side.
            let last = self.report(k, (1.0 - SHORTLY) * segment.end.value())?;
            let at = last.situation(self.begin.q.len());
            let mode = &self.modes[segment.mode];
            self.equations.take(at);
            self.equations.examine_bounds(at, mode, &mut self.findings);
        }
        self.enter(segment);
        if !self.has_small_defects(segment)? {
            self.integrate(segment)?;
        }
        // The error of a step is a mean over its components, one of which may have all of it.
        let components = (2.0 * self.begin.q.len() as f64).sqrt();
        self.book(Subject::Motion, segment.t.value(), components);
        Ok(())
    }

    /// Follows guards over a step.
    fn watch(&mut self, k: usize) -> Result<(), Error> {
        let segment = &self.record.segments[k];
        let mode = &self.modes[segment.mode];
        if self.watches.is_idle(mode) {
            return Ok(());
        }
        let of_forces = self.watches.needs_forces(mode);
        let step = &mut self.polynomials;
        (step.time, step.length) = (segment.t.value(), segment.h.value());
        (step.end, step.width) = (segment.end.value(), segment.degree + 1);
        let n = self.begin.q.len();
        let numbers = &self.record.coefficients[segment.offset..][..2 * n * step.width];
        step.coefficients.clear();
        step.coefficients.extend(numbers.iter().map(|x| x.value()));
        self.watches.follow(step, mode, &mut self.findings);
        if of_forces {
            for &(x, _) in &gauss(segment.degree + 2) {
                let now = self.report(k, 0.5 * segment.end.value() * (1.0 + x))?;
                let (at, mode) = (now.situation(n), &self.modes[segment.mode]);
                self.watches.see(at, mode, true, &mut self.findings);
            }
        }
        Ok(())
    }

    /// Finds the errors of a step, and what they are measured by, from the defects of its dense output. Whether they are below the tolerance.
    fn has_small_defects(&mut self, segment: &Segment<T>) -> Result<bool, Error> {
        let record = self.record;
        let span = (segment.h * segment.end).value();
        self.start_errors(0.0);
        for (part, weight) in RADAU {
            let s = segment.end * T::from_f64(part);
            self.accelerate(segment, s)?;
            for i in 0..self.begin.q.len() {
                let (dq, dv) = (self.rates.q[i] / segment.h, self.rates.v[i] / segment.h);
                let defects = [dq - self.scratch.v[i], dv - self.acceleration[i]];
                let [q, v] = defects.map(|defect| defect.value().abs());
                self.errors.q[i] += weight * span * q;
                self.errors.v[i] += weight * span * v;
            }
        }
        let pairs = |errors: &[f64], sizes: &[f64]| {
            let mut pairs = errors.iter().zip(sizes).enumerate();
            pairs.all(|(i, (error, size))| {
                let least = least_size(&record.asked.sizes, i);
                *error <= self.findings.tolerance * (least + size)
            })
        };
        Ok(pairs(&self.errors.q, &self.sizes.q) && pairs(&self.errors.v, &self.sizes.v))
    }

    /// Finds the errors of a step, and what they are measured by, from the integrals of velocities and accelerations.
    fn integrate(&mut self, segment: &Segment<T>) -> Result<(), Error> {
        let points = segment.degree / 2 + 2;
        if self.nodes.len() != points {
            self.nodes = gauss(points);
        }
        let (h, end) = (segment.h.value(), segment.end.value());
        self.start_errors(1.0);
        for i in 0..points {
            let (x, w) = self.nodes[i];
            self.accelerate(segment, T::from_f64(0.5 * end * (1.0 + x)))?;
            let weight = 0.5 * end * h * w;
            let rates = [
                (&mut self.errors.q, &self.scratch.v),
                (&mut self.errors.v, &self.acceleration),
            ];
            for (sums, rates) in rates {
                let pairs = sums.iter_mut().zip(rates);
                pairs.for_each(|(sum, rate)| *sum += weight * rate.value());
            }
        }
        if segment.degree == Radau::<T>::DEGREE {
            self.damp(segment)?;
        }
        Ok(())
    }

    /// Errors as they are before a step: the difference of its ends, or nothing.
    fn start_errors(&mut self, difference: f64) {
        let q = [&mut self.errors.q, &mut self.sizes.q];
        let v = [&mut self.errors.v, &mut self.sizes.v];
        let ends = [(&self.begin.q, &self.last.q), (&self.begin.v, &self.last.v)];
        for ([errors, sizes], (begin, last)) in [q, v].into_iter().zip(ends) {
            for i in 0..begin.len() {
                errors[i] = difference * (begin[i] - last[i]);
                sizes[i] = begin[i].abs().max(last[i].abs());
            }
        }
    }

    /// State, its derivatives and accelerations at part `s` of a step, by the equations that the run itself evaluates; remembers how large the state is.
    fn accelerate(&mut self, segment: &Segment<T>, s: T) -> Result<(), Error> {
        let State { q, v, .. } = &mut self.scratch;
        let lists = [(&mut *q, &mut self.rates.q), (&mut *v, &mut self.rates.v)];
        for (which, (values, rates)) in lists.into_iter().enumerate() {
            for (i, (x, rate)) in values.iter_mut().zip(rates).enumerate() {
                let c = self.record.polynomial(segment, which, i);
                (*x, *rate) = with_derivative(c, s);
            }
        }
        let time = segment.t + segment.h * s;
        let mode = &self.record.modes[segment.mode];
        let outcome = if !mode.has_incipient_slip() {
            Acceleration::acceleration(&mut self.dynamics, time, q, v, &mut self.acceleration)
        } else {
            let left = &self.left;
            let outcome = self.dynamics.value_along_from(time, q, v, left);
            self.acceleration
                .copy_from_slice(self.dynamics.acceleration());
            outcome
        };
        let d = self.record.description();
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))?;
        for (sizes, list) in [(&mut self.sizes.q, q), (&mut self.sizes.v, v)] {
            let pairs = sizes.iter_mut().zip(list);
            pairs.for_each(|(size, x)| *size = size.max(x.value().abs()));
        }
        Ok(())
    }

    /// What is left of the errors at the end of a step, (1 − h J)⁻¹ of them, J the Jacobian there: an error of the
    /// dense output in a motion that is damped fast changes the accelerations by far more, but for a short time only.
    fn damp(&mut self, segment: &Segment<T>) -> Result<(), Error> {
        let d = self.record.description();
        let (time, n) = (segment.t + segment.h * segment.end, self.last.q.len());
        let State { q, v, .. } = &mut self.scratch;
        self.record.state_at(segment, segment.end, q, v);
        let mut columns = vec![T::zero(); 2 * n * n];
        let outcome = self.dynamics.jacobian(time, q, v, &mut columns);
        let mode = &self.record.modes[segment.mode];
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))?;
        let h = (segment.h * segment.end).value();
        let rate = |i: usize, j: usize| match i.checked_sub(n) {
            Some(i) => columns[j * n + i].value(),
            None => f64::from(u8::from(j == i + n)),
        };
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let matrix = DMatrix::from_fn(2 * n, 2 * n, |i, j| unit(i, j) - h * rate(i, j));
        let State { q, v, .. } = &mut self.errors;
        let errors = DVector::from_iterator(2 * n, q.iter().chain(v.iter()).copied());
        if let Some(left) = matrix.lu().solve(&errors) {
            let errors = q.iter_mut().chain(v);
            errors
                .zip(left.iter())
                .for_each(|(error, left)| *error = *left);
        }
        Ok(())
    }

    /// Takes the state at part `s` of a step.
    fn place(&mut self, k: usize, s: f64) {
        let (segment, State { q, v, .. }) = (&self.record.segments[k], &mut self.scratch);
        self.record.state_at(segment, T::from_f64(s), q, v);
    }

    /// Makes the equations ready for a step; the state that was taken is lost.
    fn enter(&mut self, segment: &Segment<T>) {
        let (dynamics, scratch) = (&mut self.dynamics, &mut self.scratch);
        let mode = &self.record.modes[segment.mode];
        dynamics.set_mode(mode);
        self.record.hold_rows_aside(segment, dynamics, scratch);
        self.left.clear();
        if mode.has_incipient_slip() {
            let State { q, v, .. } = scratch;
            self.record.state_at(segment, T::zero(), q, v);
            dynamics.tape(segment.t, q, v);
            self.left.extend(dynamics.beginning_slips());
        }
    }

    /// What is reported at part `s` of a step.
    fn report(&mut self, k: usize, s: f64) -> Result<Reported, Error> {
        let segment = &self.record.segments[k];
        let time = segment.t + segment.h * T::from_f64(s);
        let mode = &self.record.modes[segment.mode];
        self.dynamics.set_extra_needs(&self.rows);
        self.enter(segment);
        let (d, dynamics) = (self.record.description(), &mut self.dynamics);
        let s = T::from_f64(s);
        let placed = self.record.place(segment, s, dynamics, &mut self.scratch);
        let State { q, v, .. } = &self.scratch;
        let outcome = placed.and_then(|()| dynamics.value_along(time, q, v));
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))?;
        let mut undetermined = Vec::new();
        let forces = self.redundant.report(dynamics, &mut undetermined);
        dynamics.replace_forces(&forces);
        dynamics.report_value();
        let loads = d
            .forces
            .iter()
            .map(|force| dynamics.report(force.value).value());
        let lists = [&q[..], v, Dynamics::acceleration(dynamics), &forces];
        let numbers = lists.into_iter().flatten().map(|x| x.value());
        Ok(Reported {
            time: time.value(),
            energies: Energies {
                kinetic: dynamics.report(d.energy.kinetic).value(),
                potential: dynamics.report(d.energy.potential).value(),
                jacobi: dynamics.report(d.energy.jacobi).value(),
            },
            rows: forces.len(),
            shared: undetermined.contains(&true),
            numbers: numbers.chain(loads).collect(),
        })
    }

    /// Goes through the events up to a time, when the motion goes on in the state `begin`: impacts change the state that is
    /// expected. Of those at that very time some come after the next step, if it does not advance the time: that begins nearer to the state
    /// expected than to what they leave.
    fn events_until(&mut self, time: f64, begin: &State<f64>, first: bool, advances: bool) {
        let record = self.record;
        while let Some(event) = record.events().get(self.events) {
            let now = event.time.value();
            if now > time || now == time && !advances && self.precedes_events(begin, now) {
                break;
            }
            let repeats = self.events > 0 && {
                let before = &record.events()[self.events - 1];
                before.time == event.time
                    && before.state == event.state
                    && before.state_after == event.state_after
            };
            self.events += 1;
            let when = event.time.value();
            match event.kind {
                EventKind::Mark => {}
                EventKind::Impact | EventKind::Accumulates { .. } if !repeats => {
                    let found = numbers(&event.state);
                    if let EventKind::Accumulates { .. } = event.kind {
                        // The impacts that are not followed take away the velocity that is left. Until they have ended the
                        // motion goes on with it.
                        let left = when - self.time;
                        for (q, v) in self.expected.q.iter_mut().zip(&self.expected.v) {
                            *q += v * left;
                        }
                        self.expected.v.clone_from(&found.v);
                    }
                    if !first {
                        self.join(when, &found);
                    }
                    if event.kind == EventKind::Impact {
                        let later = record.events()[self.events..].iter();
                        let mut others = later.take_while(|other| other.time == event.time);
                        let follows = others.any(|other| {
                            other.kind == EventKind::Impact && other.state != event.state
                        });
                        self.impact(event, follows);
                    }
                    self.expected = numbers(&event.state_after);
                }
                _ => {}
            }
        }
    }

    /// Whether a step that begins so is nearer to the state expected than to what any of the events at that time leaves.
    fn precedes_events(&self, begin: &State<f64>, now: f64) -> bool {
        let events = self.record.events()[self.events..].iter();
        let at_once = events.take_while(|event| event.time.value() == now);
        let jumps = |kind| matches!(kind, EventKind::Impact | EventKind::Accumulates { .. });
        let mut jumps = at_once.filter(|event| jumps(event.kind));
        let expected = self.distance(begin, &self.expected);
        jumps.all(|event| expected <= self.distance(begin, &numbers(&event.state_after)))
    }

    /// How far two states are from one another, in units of their sizes.
    fn distance(&self, a: &State<f64>, b: &State<f64>) -> f64 {
        let sizes = &self.record.asked.sizes;
        let square = |(i, (a, b)): (usize, (&f64, &f64))| {
            let size = least_size(sizes, i) + a.abs().max(b.abs());
            ((a - b) / size).powi(2)
        };
        let positions = a.q.iter().zip(&b.q).enumerate();
        let velocities = a.v.iter().zip(&b.v).enumerate();
        positions.chain(velocities).map(square).sum()
    }

    /// What rounding may leave of the state at the end of a step.
    fn take_rounding(&mut self) {
        let lists = [
            (&mut self.rounding.q, &self.begin.q, &self.last.q),
            (&mut self.rounding.v, &self.begin.v, &self.last.v),
        ];
        for (rounding, begin, last) in lists {
            for i in 0..begin.len() {
                rounding[i] = self.finest * begin[i].abs().max(last[i].abs());
            }
        }
    }

    /// The motion goes on in the state where it was.
    fn join(&mut self, time: f64, found: &State<f64>) {
        let (expected, rounding) = (&self.expected, &self.rounding);
        let q = (&expected.q, &rounding.q, &found.q);
        let v = (&expected.v, &rounding.v, &found.v);
        let q = (&mut self.errors.q, &mut self.sizes.q, q);
        let v = (&mut self.errors.v, &mut self.sizes.v, v);
        for (errors, sizes, (expected, rounding, found)) in [q, v] {
            for i in 0..found.len() {
                let jump = (found[i] - expected[i]).abs();
                // What is no number stays so.
                errors[i] = jump - rounding[i].min(jump);
                sizes[i] = found[i].abs();
            }
        }
        let components = (2.0 * found.q.len() as f64).sqrt();
        self.book(Subject::Joins, time, components);
    }

    /// Books the errors of a state beside its sizes, times `factor`. The four coordinates of an attitude have one size: that of a unit quaternion, and of
    /// its rate.
    fn book(&mut self, subject: Subject, time: f64, factor: f64) {
        for sizes in [&mut self.sizes.q, &mut self.sizes.v] {
            for first in self.attitudes.iter().copied() {
                let four = &mut sizes[first..first + 4];
                let size = four.iter().map(|x| x * x).sum::<f64>().sqrt();
                four.fill(size);
            }
        }
        let (errors, sizes) = (&self.errors, &self.sizes);
        for [errors, sizes] in [[&errors.q, &sizes.q], [&errors.v, &sizes.v]] {
            for (i, coordinate) in self.record.description().coordinates.iter().enumerate() {
                let size = factor * (least_size(&self.record.asked.sizes, i) + sizes[i]);
                self.findings
                    .book(subject, errors[i].abs(), size, time, coordinate.name);
            }
        }
    }
}

/// What is reported of an instant, as plain numbers.
struct Reported {
    time: f64,
    energies: Energies,
    /// Number of forces.
    rows: usize,
    /// Whether some of them are chosen among others that move the system in the same way.
    shared: bool,
    /// Positions, velocities, accelerations, forces and loads.
    numbers: Vec<f64>,
}

impl Reported {
    /// The same of a system with `n` coordinates.
    fn situation(&self, n: usize) -> Situation<'_> {
        let (q, rest) = self.numbers.split_at(n);
        let (v, rest) = rest.split_at(n);
        let (acceleration, rest) = rest.split_at(n);
        let (forces, loads) = rest.split_at(self.rows);
        Situation {
            time: self.time,
            q,
            v,
            acceleration,
            forces,
            loads,
            shared: self.shared,
        }
    }
}

/// Σ cₖ sᵏ and Σ k cₖ sᵏ⁻¹.
fn with_derivative<T: Scalar>(c: &[T], s: T) -> (T, T) {
    let coefficients = c.iter().rev();
    coefficients.fold((T::zero(), T::zero()), |(value, rate), &c| {
        (value * s + c, rate * s + value)
    })
}

/// Nodes and weights of Gauss–Legendre quadrature on [−1, 1], by Newton's method on the Legendre polynomial (Davis & Rabinowitz
/// 1984, section 2.7).
fn gauss(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let node = |k: usize| {
        let mut x = -(core::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut p) = (1.0, x);
            for j in 2..=points {
                let j = j as f64;
                (before, p) = (p, ((2.0 * j - 1.0) * x * p - (j - 1.0) * before) / j);
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..points).map(node).collect()
}
