//! The whole run, step by step: what is reported in a step, the errors of its polynomials, and how steps join.

use super::equations::{Equations, Situation};
use super::instant::Energies;
use super::jumps;
use super::quadrature::gauss;
use super::step::Step;
use super::watch::Watches;
use super::{Certificate, FINEST, Findings, ROUNDINGS, Subject};
use crate::arithmetic::Scalar;
use crate::checks::state::signed;
use crate::declaration::Declaration;
use crate::dynamics::{Dynamics, OutputMask};
use crate::error::Error;
use crate::integrate::{Radau, StepPolynomial, least_size};
use crate::mode::Mode;
use crate::modes::guard::all_row_needs;
use crate::modes::redundant::RedundantForces;
use crate::trajectory::{Segment, State, Trajectory};

/// Everything about a run that is being checked.
pub(super) struct Examination<'a, T: Scalar> {
    pub record: &'a Trajectory<T>,
    pub equations: Equations,
    pub findings: Findings,
    pub watches: Watches,
    /// Energies, where they may jump.
    energies: Option<jumps::Energies>,
    /// Events that have been looked at.
    pub events: usize,
    /// State in which the motion is to go on.
    pub expected: State<f64>,
    /// How large it was in the step before, which was made to the tolerance beside that.
    pub reached: State<f64>,
    /// What rounding of the time leaves open of its positions.
    pub rounding: Vec<f64>,
    /// [`FINEST`] of the numbers of the run.
    pub finest: f64,
    /// Its time, s.
    pub time: f64,
    /// Steps within which something could not be evaluated.
    pub unevaluated: usize,
    pub dynamics: Dynamics<T>,
    redundant: RedundantForces<T>,
    /// What is read of all rows.
    rows: OutputMask,
    /// The modes of the run, once slips that begin in them have begun.
    pub modes: Vec<Mode>,
    pub scratch: State<T>,
    /// Derivatives of the polynomials of a step, and accelerations.
    pub rates: State<T>,
    pub acceleration: Vec<T>,
    /// What errors had left of slips as they began in the step.
    pub left: Vec<[T; 2]>,
    polynomials: Step,
    /// Ends of the step, errors, and what they are measured by.
    pub begin: State<f64>,
    pub last: State<f64>,
    pub errors: State<f64>,
    pub sizes: State<f64>,
    /// The first coordinate of each attitude.
    attitudes: Vec<usize>,
    /// Nodes and weights of the quadrature of the last step.
    pub nodes: Vec<(f64, f64)>,
}

/// So much before its end, as a share, a step is looked at for its end.
const SHORTLY: f64 = 1e-9;

/// Instants within a step at which shares of forces are looked at.
const WITHIN: usize = 7;

/// The balance of forces is looked at in this many steps after every change of the mode.
const FIRST: usize = 4;

/// The balance of forces is looked at in this share of the steps that follow these first ones.
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
    if !(0.0..=1.0).contains(&share) {
        return Err(Error::Argument {
            what: "share of the steps",
            value: share,
            expected: "between 0 and 1",
        });
    }
    Ok(against(record, record.system.declaration(), seed, share))
}

/// The run checked against a declaration.
pub(super) fn against<T: Scalar>(
    record: &Trajectory<T>,
    declaration: &'static Declaration,
    seed: u64,
    share: f64,
) -> Certificate {
    let mut certificate = Certificate {
        checks: Vec::new(),
        tolerance: record.asked.tolerance,
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
    let mut examination = Examination::new(record, declaration, rounding);
    let chosen = chosen(record, seed, share, rounding);
    certificate.looked = chosen.iter().flatten().count();
    examination.steps(&chosen);
    certificate.unevaluated = examination.unevaluated;
    let promised = !record.asked.method.has_fixed_steps();
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

/// Per step: where it is looked at, if it is: a `share` of all, the first and the last one among them.
fn chosen<T: Scalar>(
    record: &Trajectory<T>,
    seed: u64,
    share: f64,
    rounding: f64,
) -> Vec<Option<Look>> {
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
    chosen.collect()
}

/// Copies a state as numbers.
fn copy<T: Scalar>(state: &State<T>, to: &mut State<f64>) {
    let lists = [(&state.q, &mut to.q), (&state.v, &mut to.v)];
    for (from, to) in lists {
        to.iter_mut().zip(from).for_each(|(to, x)| *to = x.value());
    }
}

/// Takes the polynomials of step `k`.
fn take_polynomials<T: Scalar>(record: &Trajectory<T>, k: usize, step: &mut Step) {
    let segment = &record.segments[k];
    let Step { motion, end } = step;
    *end = segment.end.value();
    (motion.t, motion.h) = (segment.t.value(), segment.h.value());
    motion.set_degree(segment.degree);
    let coefficients = motion.q.iter_mut().chain(&mut motion.v);
    let numbers = &record.coefficients[segment.offset..];
    (coefficients.zip(numbers)).for_each(|(c, x)| *c = x.value());
}

impl<'a, T: Scalar> Examination<'a, T> {
    /// Makes everything ready; `rounding` is that of the numbers of the run.
    fn new(record: &'a Trajectory<T>, declaration: &'static Declaration, rounding: f64) -> Self {
        let d = record.description();
        let parameters = record.system.parameters();
        let mut dynamics = record.dynamics();
        let mut needs = OutputMask::new(d);
        needs.insert(d.energy.need);
        let loads = d.forces.iter().map(|force| force.report_need);
        loads.for_each(|need| needs.insert(need));
        dynamics.set_report_needs(&needs);
        let start = record.start.values();
        let finest = FINEST * rounding / f64::EPSILON;
        let equations = Equations::new(
            d,
            declaration,
            &record.effects,
            &parameters,
            record.asked.sizes.clone(),
            ROUNDINGS * rounding,
        );
        Self {
            record,
            energies: jumps::Energies::new(&equations),
            equations,
            findings: Findings::new(record.asked.tolerance.max(finest), rounding),
            watches: Watches::new(record, declaration, &parameters),
            events: 0,
            expected: start.clone(),
            reached: start.clone(),
            rounding: vec![0.0; start.q.len()],
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
            polynomials: Step {
                motion: StepPolynomial::new(start.q.len(), 0),
                end: 0.0,
            },
            begin: start.clone(),
            last: start.clone(),
            errors: start.clone(),
            sizes: start,
            attitudes: d.constraints.iter().filter_map(|c| c.attitude).collect(),
            nodes: Vec::new(),
        }
    }

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
                if let Some(energies) = &mut self.energies {
                    take_polynomials(record, k, &mut self.polynomials);
                    energies.follow(&self.polynomials, &mut self.findings);
                }
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
                self.take_reach();
                core::mem::swap(&mut self.expected, &mut self.last);
                self.time = t + h * end;
            }
        }
        let last = record.last.values();
        self.events_until(f64::INFINITY, &last, false, true);
        self.join(record.last_time(), &last);
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
            // How forces can be shared out may be wrong for a while within.
            let count = if reported.shared { WITHIN } else { 0 };
            let within = gauss(count).into_iter().map(|(x, _)| 0.5 * (1.0 + x));
            // The time of the event that ends it is known to the tolerance.
            let (t, h) = (segment.t.value(), segment.h.value());
            let known = self.findings.tolerance * t.abs().max(1.0) / (h * segment.end.value());
            let last = 1.0 - known.clamp(SHORTLY, 1.0);
            for part in within.chain([last]) {
                let now = self.report(k, part * segment.end.value())?;
                let at = now.situation(self.begin.q.len());
                let mode = &self.modes[segment.mode];
                self.equations.take(at);
                self.equations.examine_bounds(at, mode, &mut self.findings);
            }
        }
        self.enter(segment);
        if !self.has_small_defects(segment)? {
            let turns = self.record.modes[segment.mode].has_turning_slip();
            match turns && segment.degree != Radau::<T>::DEGREE {
                true => self.follow(segment)?,
                false => {
                    self.integrate(segment)?;
                    if !self.errors_are_small() && segment.degree != Radau::<T>::DEGREE {
                        self.discount_rounding(segment)?;
                    }
                }
            }
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
        take_polynomials(self.record, k, &mut self.polynomials);
        self.watches
            .follow(&self.polynomials, mode, &mut self.findings);
        if of_forces {
            let n = self.begin.q.len();
            for &(x, _) in &gauss(segment.degree + 2) {
                let now = self.report(k, 0.5 * segment.end.value() * (1.0 + x))?;
                let (at, mode) = (now.situation(n), &self.modes[segment.mode]);
                self.watches.see(at, mode, true, &mut self.findings);
            }
        }
        Ok(())
    }

    /// Takes the state at part `s` of a step.
    fn place(&mut self, k: usize, s: f64) {
        let (segment, State { q, v, .. }) = (&self.record.segments[k], &mut self.scratch);
        self.record.state_at(segment, T::from_f64(s), q, v);
    }

    /// Makes the equations ready for a step; the state that was taken is lost.
    pub(super) fn enter(&mut self, segment: &Segment<T>) {
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

    /// Books the errors of a state beside its sizes, times `factor`. The four coordinates of an attitude have one size: that of a unit quaternion, and of
    /// its rate.
    pub(super) fn book(&mut self, subject: Subject, time: f64, factor: f64) {
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
