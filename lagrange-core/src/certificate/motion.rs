//! The whole run, step by step: what the polynomials of a step say against the accelerations and forces that are reported, and
//! how steps join.
//!
//! Dense output of Runge–Kutta methods is of lower order than their steps, so its derivative says little. What a step promises is
//! its end: v(end) − v(0) − ∫ a dt and q(end) − q(0) − ∫ v dt, with the reported accelerations a along the dense output, are the
//! error of the step and h·∂a/∂q times that of the dense output. The integrals are by Gauss–Legendre quadrature.

use super::equations::{Equations, Situation};
use super::instant::Reported;
use super::watch::Watches;
use super::{Certificate, FINEST, Findings, Subject};
use crate::arithmetic::Scalar;
use crate::checks::state::Random;
use crate::error::Error;
use crate::integrate::Method;
use crate::trajectory::{EventKind, GAUSS, Instant, Record, Sampler, State};

/// Everything about a run that is being checked.
pub(super) struct Examination<'a, T: Scalar> {
    pub record: &'a Record<T>,
    pub equations: Equations,
    pub findings: Findings,
    pub watches: Watches,
    /// Per contact: whether the motion has passed beyond its surface outside its region.
    pub passed: Vec<bool>,
    /// Events that have been looked at.
    pub events: usize,
    /// State in which the motion is to go on.
    pub expected: State<f64>,
}

/// See [`Record::verify`].
pub(crate) fn verify<T: Scalar>(record: &Record<T>, seed: u64) -> Result<Certificate, Error> {
    record.check_recorded()?;
    let declaration = record.system.declaration();
    let d = record.description();
    let tolerance = record.asked.tolerance;
    let mut certificate = Certificate {
        checks: Vec::new(),
        tolerance,
    };
    if declaration.words.is_empty() {
        return Ok(certificate);
    }
    let rounding = match T::from_f64(1.0 + 1e-12).value() == 1.0 {
        true => f64::from(f32::EPSILON),
        false => f64::EPSILON,
    };
    let parameters = (0..d.parameters.len()).map(|i| record.parameter(i).value());
    let finest = FINEST * rounding / f64::EPSILON;
    let mut examination = Examination {
        record,
        equations: Equations::new(d, declaration, &record.effects, parameters.collect()),
        findings: Findings::new(tolerance.max(finest), rounding),
        watches: Watches::new(record),
        passed: vec![false; d.contacts.len()],
        events: 0,
        expected: numbers(&record.start),
    };
    examination.steps(Random::new(seed))?;
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
    Ok(certificate)
}

/// A state as numbers.
pub(super) fn numbers<T: Scalar>(state: &State<T>) -> State<f64> {
    let plain = |list: &[T]| list.iter().map(|x| x.value()).collect();
    State {
        q: plain(&state.q),
        v: plain(&state.v),
    }
}

impl<T: Scalar> Examination<'_, T> {
    fn steps(&mut self, mut random: Random) -> Result<(), Error> {
        let record = self.record;
        let mut sampler = Sampler::new(record);
        for (k, segment) in record.segments.iter().enumerate() {
            let (t, h, end) = (segment.t.value(), segment.h.value(), segment.end.value());
            self.events_until(t, k == 0);
            let begin = self.state_at(k, 0.0);
            self.join(t, &begin);
            let mode = &record.modes[segment.mode];
            if h * end > 0.0 {
                let chosen = end * (0.5 + 0.5 * random.signed());
                let mut nodes: Vec<(f64, f64)> = GAUSS
                    .into_iter()
                    .flat_map(|(x, w)| [(-x, w), (x, w)])
                    .map(|(x, w)| (0.5 * end * (1.0 + x), 0.5 * end * h * w))
                    .chain([(chosen, 0.0)])
                    .collect();
                nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
                let mut sums = begin.clone();
                let mut again = Vec::new();
                for (s, weight) in nodes {
                    let now = sampler.inside(k, T::from_f64(s))?;
                    self.instant(&now, s == chosen, &mut again);
                    for (i, a) in now.acceleration.iter().enumerate() {
                        sums.v[i] += weight * a.value();
                        sums.q[i] += weight * now.v[i].value();
                    }
                }
                self.watches.forget();
                for time in again {
                    let s = (time - t) / h;
                    let now = sampler.inside(k, T::from_f64(s))?;
                    self.instant(&now, false, &mut Vec::new());
                    self.watches.forget();
                }
                let last = self.state_at(k, end);
                self.integral(t, &sums, &last);
                let at = situation(t + h * end, &last);
                self.equations.take(at);
                let (passed, findings) = (&mut self.passed, &mut self.findings);
                self.equations.examine_positions(at, mode, passed, findings);
                self.expected = last;
            }
        }
        self.events_until(f64::INFINITY, false);
        self.join(record.last_time(), &numbers(&record.last));
        Ok(())
    }

    /// State at part `s` of a step.
    fn state_at(&self, k: usize, s: f64) -> State<f64> {
        let n = self.record.description().coordinates.len();
        let mut state = State {
            q: vec![T::zero(); n],
            v: vec![T::zero(); n],
        };
        let segment = &self.record.segments[k];
        self.record
            .state_at(segment, T::from_f64(s), &mut state.q, &mut state.v);
        numbers(&state)
    }

    /// Looks at an instant, at a chosen one at everything.
    fn instant(&mut self, now: &Instant<T>, chosen: bool, again: &mut Vec<f64>) {
        let plain = |list: &[T]| -> Vec<f64> { list.iter().map(|x| x.value()).collect() };
        let (q, v, acceleration) = (plain(&now.q), plain(&now.v), plain(&now.acceleration));
        let (forces, loads) = (plain(&now.forces), plain(&now.loads));
        let at = Situation {
            time: now.time.value(),
            q: &q,
            v: &v,
            acceleration: &acceleration,
            forces: &forces,
            loads: &loads,
        };
        let (equations, findings) = (&mut self.equations, &mut self.findings);
        equations.take(at);
        let seen = (at, &now.mode);
        self.watches
            .see(equations, findings, seen, &self.passed, again);
        if chosen {
            let reported = Reported {
                kinetic: now.kinetic.value(),
                potential: now.potential.value(),
            };
            equations.examine(at, &now.mode, reported, &mut self.passed, findings);
        }
    }

    /// Goes through the events up to a time: impacts change the state that is expected.
    fn events_until(&mut self, time: f64, first: bool) {
        let record = self.record;
        while let Some(event) = record.events().get(self.events) {
            if event.time.value() > time {
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
                    if !first {
                        self.join(when, &numbers(&event.state));
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

    /// The motion goes on in the state where it was.
    fn join(&mut self, time: f64, found: &State<f64>) {
        let expected = core::mem::take(&mut self.expected);
        self.compare(Subject::Joins, time, &expected, found);
        self.expected = expected;
    }

    fn integral(&mut self, time: f64, integrals: &State<f64>, last: &State<f64>) {
        self.compare(Subject::Motion, time, integrals, last);
    }

    fn compare(&mut self, subject: Subject, time: f64, a: &State<f64>, b: &State<f64>) {
        let names = self.record.description().coordinates;
        for (a, b) in [(&a.q, &b.q), (&a.v, &b.v)] {
            for ((a, b), coordinate) in a.iter().zip(b).zip(names) {
                let (error, size) = ((a - b).abs(), 1.0 + a.abs().max(b.abs()));
                self.findings
                    .book(subject, error, size, time, coordinate.name);
            }
        }
    }
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
