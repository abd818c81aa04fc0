//! The whole run, step by step: what the polynomials of a step say against the accelerations and forces that are reported, and
//! how steps join.
//!
//! Dense output of Runge–Kutta methods is of lower order than their steps, so its derivative says little. What a step promises is
//! its end: v(end) − v(0) − ∫ a dt and q(end) − q(0) − ∫ v dt, with the reported accelerations a along the dense output, are the
//! error of the step and h·∂a/∂q times that of the dense output. The integrals are by Gauss–Legendre quadrature. In stiff systems h·∂a/∂v is
//! large: of the steps of Radau what counts is the part of the error that is not damped at once.

use super::equations::{Equations, Situation};
use super::instant::Reported;
use super::watch::Watches;
use super::{Certificate, FINEST, Findings, ROUNDINGS, Subject};
use crate::arithmetic::Scalar;
use crate::checks::state::signed;
use crate::declaration::Declaration;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::integrate::least_size;
use crate::integrate::{Method, Radau};
use crate::mode::Mode;
use crate::trajectory::{EventKind, Instant, Sampler, State, Trajectory};
use nalgebra::{DMatrix, DVector};

/// Everything about a run that is being checked.
pub(super) struct Examination<'a, T: Scalar> {
    pub record: &'a Trajectory<T>,
    pub equations: Equations,
    pub findings: Findings,
    pub watches: Watches,
    /// Per contact: whether the motion has passed beyond its surface outside its region.
    pub passed: Vec<bool>,
    /// Events that have been looked at.
    pub events: usize,
    /// State in which the motion is to go on.
    pub expected: State<f64>,
    /// Its time, s.
    pub time: f64,
    /// Steps within which something could not be evaluated.
    pub unevaluated: usize,
    dynamics: Dynamics<T>,
    scratch: State<T>,
    /// Nodes and weights of the quadrature of the last step.
    nodes: Vec<(f64, f64)>,
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
    let finest = FINEST * rounding / f64::EPSILON;
    let mut examination = Examination {
        record,
        equations: Equations::new(
            d,
            declaration,
            &record.effects,
            parameters.collect(),
            record.asked.sizes.clone(),
            ROUNDINGS * rounding,
        ),
        findings: Findings::new(tolerance.max(finest), rounding),
        watches: Watches::new(record, declaration),
        passed: vec![false; d.contacts.len()],
        events: 0,
        expected: numbers(&record.start),
        time: record.first_time(),
        unevaluated: 0,
        dynamics: record.dynamics(),
        scratch: record.start.clone(),
        nodes: Vec::new(),
    };
    let mut random = fastrand::Rng::with_seed(seed);
    let segments = record.segments.iter().enumerate();
    let chosen = segments.map(|(k, segment)| {
        let (looked, part) = (signed(&mut random), signed(&mut random));
        let looked = k == 0 || looked < 2.0 * share - 1.0;
        looked.then(|| segment.end.value() * (0.5 + 0.5 * part))
    });
    let chosen: Vec<Option<f64>> = chosen.collect();
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

impl<T: Scalar> Examination<'_, T> {
    /// The sizes of forces in the run; what is reported at a chosen instant of each step that is looked at, if it can be evaluated.
    fn status(&mut self, chosen: &[Option<f64>]) -> Vec<Option<Numbers>> {
        let mut sampler = Sampler::new(self.record);
        let mut look = |(k, s): (usize, &Option<f64>)| {
            let now = sampler.inside(k, T::from_f64((*s)?)).ok()?;
            let now = Numbers::of(&now);
            self.equations.status(now.situation());
            Some(now)
        };
        chosen.iter().enumerate().map(&mut look).collect()
    }

    fn steps(&mut self, chosen: &[Option<f64>]) {
        let record = self.record;
        let reported = self.status(chosen);
        for (k, (segment, now)) in record.segments.iter().zip(&reported).enumerate() {
            let (t, h, end) = (segment.t.value(), segment.h.value(), segment.end.value());
            let begin = self.state_at(k, 0.0);
            self.events_until(t, &begin, k == 0, t + h * end > t);
            self.join(t, &begin);
            if h * end > 0.0 {
                let last = self.state_at(k, end);
                if chosen[k].is_some() {
                    let looked = now.as_ref().map(|now| self.step(k, now, &begin, &last));
                    // Where constraints lose rank within a step there are no forces.
                    self.unevaluated += usize::from(!matches!(looked, Some(Ok(()))));
                    self.watches.forget();
                    let at = situation(t + h * end, &last);
                    self.equations.take(at);
                    let mode = &record.modes[segment.mode];
                    let (passed, findings) = (&mut self.passed, &mut self.findings);
                    self.equations.examine_positions(at, mode, passed, findings);
                }
                (self.expected, self.time) = (last, t + h * end);
            }
        }
        let last = numbers(&record.last);
        self.events_until(f64::INFINITY, &last, false, true);
        self.join(record.last_time(), &last);
    }

    /// One step, with what is reported at an instant in it.
    fn step(
        &mut self,
        k: usize,
        reported: &Numbers,
        begin: &State<f64>,
        last: &State<f64>,
    ) -> Result<(), Error> {
        let segment = &self.record.segments[k];
        let (t, h, end) = (segment.t.value(), segment.h.value(), segment.end.value());
        let points = segment.degree / 2 + 2;
        if self.nodes.len() != points {
            self.nodes = gauss(points);
        }
        let (mut sums, mut sizes) = (begin.clone(), begin.clone());
        let (mut again, mut told) = (Vec::new(), false);
        for i in 0..points {
            let (x, w) = self.nodes[i];
            let (s, weight) = (0.5 * end * (1.0 + x), 0.5 * end * h * w);
            let now = self.bare(k, s)?;
            if !told && reported.time <= now.time {
                self.instant(reported, true, &mut again);
                told = true;
            }
            self.instant(&now, false, &mut again);
            let sums = sums
                .q
                .iter_mut()
                .zip(&now.v)
                .chain(sums.v.iter_mut().zip(&now.acceleration));
            sums.for_each(|(sum, rate)| *sum += weight * rate);
            let sizes = sizes
                .q
                .iter_mut()
                .zip(&now.q)
                .chain(sizes.v.iter_mut().zip(&now.v));
            sizes.for_each(|(size, x)| *size = size.abs().max(x.abs()));
        }
        if !told {
            self.instant(reported, true, &mut again);
        }
        for time in again {
            self.watches.forget();
            let now = self.bare(k, (time - t) / h)?;
            self.instant(&now, false, &mut Vec::new());
        }
        if segment.degree == Radau::<T>::DEGREE {
            self.damp(k, &mut sums, last)?;
        }
        // The error of a step is a mean over its components, one of which may have all of it.
        let components = (2.0 * begin.q.len() as f64).sqrt();
        self.compare(Subject::Motion, t, [&sums, last, &sizes], components);
        Ok(())
    }

    /// What is left of the difference of `sums` from the state at the end of a step, (1 − h J)⁻¹ of it, J the Jacobian there: an error of the
    /// dense output in a motion that is damped fast changes the accelerations by far more, but for a short time only.
    fn damp(&mut self, k: usize, sums: &mut State<f64>, last: &State<f64>) -> Result<(), Error> {
        let segment = &self.record.segments[k];
        let d = self.record.description();
        let (time, n) = (segment.t + segment.h * segment.end, last.q.len());
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
        let ends = last.q.iter().chain(&last.v);
        let sums = sums.q.iter_mut().chain(&mut sums.v);
        let (sums, ends): (Vec<&mut f64>, Vec<&f64>) = (sums.collect(), ends.collect());
        let error = DVector::from_fn(2 * n, |i, _| *sums[i] - ends[i]);
        if let Some(left) = matrix.lu().solve(&error) {
            for ((sum, end), left) in sums.into_iter().zip(ends).zip(left.iter()) {
                *sum = end + left;
            }
        }
        Ok(())
    }

    /// State at part `s` of a step.
    fn state_at(&self, k: usize, s: f64) -> State<f64> {
        let n = self.record.description().coordinates.len();
        let mut state = State::new(vec![T::zero(); n], vec![T::zero(); n]);
        let segment = &self.record.segments[k];
        self.record
            .state_at(segment, T::from_f64(s), &mut state.q, &mut state.v);
        numbers(&state)
    }

    /// Accelerations and forces at part `s` of a step, by the equations that the run itself evaluates.
    fn bare(&mut self, k: usize, s: f64) -> Result<Numbers, Error> {
        let segment = &self.record.segments[k];
        let (q, v) = (&mut self.scratch.q, &mut self.scratch.v);
        self.record.state_at(segment, T::from_f64(s), q, v);
        let time = segment.t + segment.h * T::from_f64(s);
        let mode = &self.record.modes[segment.mode];
        self.dynamics.set_mode(mode);
        let d = self.record.description();
        let outcome = self.dynamics.value_along(time, q, v);
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))?;
        let plain = |list: &[T]| list.iter().map(|x| x.value()).collect();
        Ok(Numbers {
            time: time.value(),
            mode: mode.under_way(),
            acceleration: plain(self.dynamics.acceleration()),
            forces: (0..d.rows.len())
                .map(|row| self.dynamics.force(row).value())
                .collect(),
            loads: Vec::new(),
            energies: Reported::default(),
            q: plain(q),
            v: plain(v),
        })
    }

    /// Looks at an instant, at a chosen one at everything.
    fn instant(&mut self, now: &Numbers, chosen: bool, again: &mut Vec<f64>) {
        let at = now.situation();
        let (equations, findings) = (&mut self.equations, &mut self.findings);
        if !chosen && self.watches.is_idle(&now.mode) {
            return;
        }
        equations.take(at);
        let seen = (at, &now.mode);
        self.watches
            .see(equations, findings, seen, &mut self.passed, again);
        if chosen {
            equations.examine(at, &now.mode, now.energies, &mut self.passed, findings);
        }
    }

    /// Goes through the events up to a time, when the motion goes on in the state `begin`: impacts change the state that is
    /// expected. Of those at that very time some may come after the next step, if it does not advance the time.
    fn events_until(&mut self, time: f64, begin: &State<f64>, first: bool, advances: bool) {
        let record = self.record;
        while let Some(event) = record.events().get(self.events) {
            let now = event.time.value();
            if now > time || now == time && !advances && self.is_near(begin) {
                break;
            }
            let repeats = self.events > 0 && {
                let before = &record.events()[self.events - 1];
                before.state == event.state && before.state_after == event.state_after
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
                        self.impact(event);
                    }
                    self.expected = numbers(&event.state_after);
                }
                _ => {}
            }
        }
    }

    /// Whether a state is the one that is expected.
    fn is_near(&self, state: &State<f64>) -> bool {
        let sizes = &self.record.asked.sizes;
        let near = |(i, (a, b)): (usize, (&f64, &f64))| {
            let size = least_size(sizes, i) + a.abs().max(b.abs());
            (a - b).abs() <= self.findings.tolerance * size
        };
        let expected = &self.expected;
        let mut positions = state.q.iter().zip(&expected.q).enumerate();
        let mut velocities = state.v.iter().zip(&expected.v).enumerate();
        positions.all(near) && velocities.all(near)
    }

    /// The motion goes on in the state where it was.
    fn join(&mut self, time: f64, found: &State<f64>) {
        let expected = core::mem::take(&mut self.expected);
        let components = (2.0 * found.q.len() as f64).sqrt();
        self.compare(Subject::Joins, time, [&expected, found, found], components);
        self.expected = expected;
    }

    /// Books the difference of two states beside the sizes of a third, times `factor`.
    fn compare(&mut self, subject: Subject, time: f64, states: [&State<f64>; 3], factor: f64) {
        let names = self.record.description().coordinates;
        let [a, b, sizes] = states;
        let lists = [[&a.q, &b.q, &sizes.q], [&a.v, &b.v, &sizes.v]];
        for [a, b, sizes] in lists {
            for (i, coordinate) in names.iter().enumerate() {
                let least = least_size(&self.record.asked.sizes, i);
                let size = factor * (least + sizes[i].abs());
                self.findings
                    .book(subject, (a[i] - b[i]).abs(), size, time, coordinate.name);
            }
        }
    }
}

/// What is reported of an instant, as plain numbers.
struct Numbers {
    time: f64,
    mode: Mode,
    q: Vec<f64>,
    v: Vec<f64>,
    acceleration: Vec<f64>,
    forces: Vec<f64>,
    loads: Vec<f64>,
    energies: Reported,
}

impl Numbers {
    fn of<T: Scalar>(now: &Instant<T>) -> Self {
        let plain = |list: &[T]| list.iter().map(|x| x.value()).collect();
        Self {
            time: now.time.value(),
            mode: now.mode.clone(),
            q: plain(&now.q),
            v: plain(&now.v),
            acceleration: plain(&now.acceleration),
            forces: plain(&now.forces),
            loads: plain(&now.loads),
            energies: Reported {
                kinetic: now.kinetic.value(),
                potential: now.potential.value(),
                jacobi: now.jacobi.value(),
            },
        }
    }

    fn situation(&self) -> Situation<'_> {
        Situation {
            time: self.time,
            q: &self.q,
            v: &self.v,
            acceleration: &self.acceleration,
            forces: &self.forces,
            loads: &self.loads,
        }
    }
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

/// A state without accelerations and forces.
pub(super) fn situation(time: f64, state: &State<f64>) -> Situation<'_> {
    Situation {
        time,
        q: &state.q,
        v: &state.v,
        acceleration: &[],
        forces: &[],
        loads: &[],
    }
}
