//! Gaps, stops and marks over a whole step, in intervals.
//!
//! With the positions and velocities of the step's polynomials as intervals a guard g and its rate ġ are intervals too, and
//! g ∈ g(a) + ġ·(t − a) besides. Where g keeps its sign between two instants, or ġ does, the values at the two say all; where neither
//! is known the time between them is halved. A dip no deeper than the tolerance does not count.

use super::equations::{Situation, change};
use super::sizes::rounding_of;
use super::step::Step;
use super::{Findings, Subject, beyond};
use crate::arithmetic::Scalar;
use crate::declaration::{Declaration, Evaluator, Inputs, Interval, Real};
use crate::effects::Item;
use crate::mode::Mode;
use crate::system::Description;
use crate::trajectory::{self, State, Trajectory};

/// A step is cut into at most so many parts.
const PARTS: usize = 256;

/// An instant is known to this, relative to the time.
const ROUNDING_OF_TIME: f64 = 64.0 * f64::EPSILON;

/// What is followed along the motion.
#[derive(Debug)]
pub(super) struct Watches {
    d: &'static Description,
    guards: Vec<Guard>,
    /// Times of logged marks, by mark.
    marks: Vec<Vec<f64>>,
    values: Evaluator,
    ranges: Evaluator<Interval>,
    /// Per coordinate: the size below which its errors are absolute; empty: 1 for all.
    sizes: Vec<f64>,
    /// Per contact: whether the motion has passed beyond its surface outside its region.
    passed: Vec<bool>,
    zeros: Vec<f64>,
    unknown: Vec<Interval>,
    state: State<f64>,
    /// Positions, velocities and accelerations between two instants.
    between: [Vec<Interval>; 3],
    changes: Vec<[f64; 3]>,
    /// Parts that the step may still be cut into.
    parts: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Gap(usize),
    Stop(usize),
    Mark(usize),
}

/// A guard and its last value, with its time. A gap counts where its region is ≥ 0. Stops and marks are true where all terms are.
#[derive(Debug)]
struct Guard {
    kind: Kind,
    terms: Vec<usize>,
    region: Option<usize>,
    /// Whether it reads forces, which are known at single instants only.
    of_forces: bool,
    /// Whether a stop has been false.
    armed: bool,
    last: Option<(f64, f64)>,
}

/// Everything that a polynomial can be between two parts of a step.
fn range(c: impl DoubleEndedIterator<Item = f64>, [from, to]: [f64; 2]) -> Interval {
    let (low, high) = c.rev().fold((0.0, 0.0), |(low, high), c| {
        let down = if low < 0.0 { to } else { from };
        let up = if high < 0.0 { from } else { to };
        (low * down + c, high * up + c)
    });
    Interval::new(low, high)
}

impl Watches {
    pub fn new<T: Scalar>(
        record: &Trajectory<T>,
        declaration: &'static Declaration,
        parameters: &[f64],
    ) -> Self {
        let d = record.description();
        let mut guards = Vec::new();
        let mut follow = |kind, item, terms: &[usize], region| {
            if record.effects.includes(d, item) {
                guards.push(Guard {
                    kind,
                    terms: terms.to_vec(),
                    region,
                    of_forces: false,
                    armed: false,
                    last: None,
                });
            }
        };
        for (c, contact) in declaration.contacts.iter().enumerate() {
            follow(
                Kind::Gap(c),
                Item::Contact(c),
                &[contact.gap],
                contact.region,
            );
        }
        for (i, terms) in declaration.stops.iter().enumerate() {
            if let Some(terms) = terms {
                follow(Kind::Stop(i), Item::Stop(i), terms, None);
            }
        }
        for (i, terms) in declaration.marks.iter().enumerate() {
            if let Some(terms) = terms {
                follow(Kind::Mark(i), Item::Mark(i), terms, None);
            }
        }
        let wanted = guards.iter().flat_map(Guard::reads).collect::<Vec<_>>();
        let values = Evaluator::new(declaration, parameters, wanted.iter().copied());
        for guard in &mut guards {
            let of_forces = guard.reads().any(|value| values.is_of_forces(value));
            guard.of_forces = of_forces;
        }
        let times = |i: usize| {
            let events = record.events().iter();
            let own = events.filter(|e| e.subject == trajectory::Subject::Mark(i));
            own.map(|e| e.time.value()).collect()
        };
        let n = d.coordinates.len();
        let most = n.max(d.rows.len()).max(d.forces.len());
        Self {
            d,
            guards,
            marks: (0..d.marks.len()).map(times).collect(),
            values,
            ranges: Evaluator::new(declaration, parameters, wanted),
            sizes: record.asked.sizes.clone(),
            passed: vec![false; d.contacts.len()],
            zeros: vec![0.0; most],
            unknown: vec![Interval::ANYTHING; most],
            state: State::new(vec![0.0; n], vec![0.0; n]),
            between: [(); 3].map(|()| vec![Interval::default(); n]),
            changes: vec![[0.0; 3]; n],
            parts: 0,
        }
    }

    /// Whether there is nothing to follow in a mode.
    pub fn is_idle(&self, mode: &Mode) -> bool {
        !self.guards.iter().any(|guard| guard.acts(self.d, mode))
    }

    /// Whether a guard that acts in a mode depends on where the motion has been: below a surface that it has passed at its edge. Every
    /// step of such a mode has to be followed.
    pub fn remembers(&self, mode: &Mode) -> bool {
        let mut guards = self.guards.iter();
        guards.any(|guard| guard.region.is_some() && guard.acts(self.d, mode))
    }

    /// Whether a guard that acts in a mode reads forces.
    pub fn needs_forces(&self, mode: &Mode) -> bool {
        let mut guards = self.guards.iter();
        guards.any(|guard| guard.of_forces && guard.acts(self.d, mode))
    }

    /// Follows all guards over a step.
    pub fn follow(&mut self, step: &Step, mode: &Mode, findings: &mut Findings) {
        self.guards.iter_mut().for_each(|guard| guard.last = None);
        self.parts = PARTS;
        self.look(step, 0.0, mode, findings);
        // What jumps at the end is false just before it.
        let blur = ROUNDING_OF_TIME * step.motion.time(step.end).abs() / step.motion.h;
        let before = (step.end - blur).max(0.0);
        self.between(step, [0.0, before], mode, findings);
        self.look(step, step.end, mode, findings);
    }

    /// Looks at everything between two parts of a step, the first of which has been looked at, and at the second.
    fn between(&mut self, step: &Step, [a, b]: [f64; 2], mode: &Mode, findings: &mut Findings) {
        let middle = 0.5 * (a + b);
        if self.parts > 0
            && a < middle
            && middle < b
            && !self.is_plain(step, [a, b], mode, findings)
        {
            self.parts -= 1;
            self.between(step, [a, middle], mode, findings);
            self.between(step, [middle, b], mode, findings);
        } else {
            self.look(step, b, mode, findings);
        }
    }

    /// Whether all guards are between two instants as their values at the two say.
    fn is_plain(
        &mut self,
        step: &Step,
        [a, b]: [f64; 2],
        mode: &Mode,
        findings: &Findings,
    ) -> bool {
        let motion = &step.motion;
        let (h, time) = (motion.h, motion.t);
        let [q, v, acceleration] = &mut self.between;
        let n = q.len();
        for i in 0..n {
            q[i] = range(motion.position_row(i).iter().copied(), [a, b]);
            v[i] = range(motion.velocity_row(i).iter().copied(), [a, b]);
        }
        if self.ranges.needs_accelerations() {
            for (i, x) in acceleration.iter_mut().enumerate() {
                let rates = motion.velocity_row(i).iter().enumerate().skip(1);
                *x = range(rates.map(|(k, c)| k as f64 * c / h), [a, b]);
            }
        }
        self.ranges.evaluate(Inputs {
            time: Interval::new(time + h * a, time + h * b),
            q,
            v,
            acceleration: &acceleration[..n],
            forces: &self.unknown,
            loads: &self.unknown,
        });
        let State { q, v, .. } = &self.state;
        for guard in &self.guards {
            if guard.of_forces || !guard.acts(self.d, mode) {
                continue;
            }
            let (value, rate) = guard.range(&self.ranges);
            let (_, before) = guard.last.unwrap_or_default();
            let gone = rate * Interval::new(0.0, h * (b - a));
            let value = value.within(Interval::number(before) + gone);
            let is_plain = |depth: f64| match guard.kind {
                Kind::Gap(c) => self.passed[c] || value.low >= -depth,
                Kind::Stop(_) => value.high <= depth || value.low >= 0.0,
                Kind::Mark(_) => value.low >= -depth || value.high <= depth,
            };
            let turns = rate.low < 0.0 && rate.high > 0.0;
            let may_pass = matches!(guard.kind, Kind::Gap(c) if !self.passed[c])
                && guard.may_pass_edge(&self.ranges);
            if !(turns || may_pass) || is_plain(0.0) {
                continue;
            }
            let (_, term) = guard.value(&self.values);
            self.values.gradient_size(term, 0, &mut self.changes);
            let reach = change(&self.changes, &self.sizes, [q, v]);
            if !is_plain(findings.tolerance * reach) {
                return false;
            }
        }
        true
    }

    /// Looks at an instant of a step.
    fn look(&mut self, step: &Step, s: f64, mode: &Mode, findings: &mut Findings) {
        let mut state = core::mem::take(&mut self.state);
        step.state(s, &mut state.q, &mut state.v);
        let at = Situation::of_state(step.motion.time(s), &state);
        self.see(at, mode, false, findings);
        self.state = state;
    }

    /// Looks at an instant: at the guards that read forces, or at the others.
    pub fn see(
        &mut self,
        at: Situation<'_>,
        mode: &Mode,
        of_forces: bool,
        findings: &mut Findings,
    ) {
        self.values.evaluate(at.inputs(&self.zeros));
        for guard in &mut self.guards {
            if guard.of_forces != of_forces {
                continue;
            }
            if !guard.acts(self.d, mode) {
                guard.last = None;
                continue;
            }
            let (value, term) = guard.value(&self.values);
            let (subject, error, name) = match guard.kind {
                Kind::Gap(c) => {
                    let gap = self.values.value(term);
                    self.passed[c] = gap < 0.0 && (self.passed[c] || value > gap);
                    let error = if self.passed[c] { 0.0 } else { -value };
                    (Subject::Gaps, error, self.d.contacts[c].name)
                }
                Kind::Stop(i) => {
                    let late = guard.armed && !guard.has_just_changed(at.time);
                    let error = if late { value } else { 0.0 };
                    if value < 0.0 && !guard.armed {
                        // One that begins to be true is false before by its rounding error, if at all.
                        self.values.gradient_size(term, 0, &mut self.changes);
                        let reach = change(&self.changes, &self.sizes, [at.q, at.v]);
                        guard.armed = value < -findings.tolerance * reach;
                    }
                    (Subject::Stops, error, self.d.stops[i].name)
                }
                Kind::Mark(i) => {
                    let zeros = self.d.marks[i].zeros;
                    let blur = findings.tolerance * at.time.abs();
                    let missed = guard.misses(at.time, value, zeros, &self.marks[i], blur);
                    (Subject::Marks, missed, self.d.marks[i].name)
                }
            };
            guard.last = Some((at.time, value));
            // What is as it should be is not measured, and forces do not follow from the state alone.
            let (mut reach, mut rounding) = (0.0, 0.0);
            if error > 0.0 {
                rounding = rounding_of(self.values.gradient_size(term, 0, &mut self.changes));
                reach = change(&self.changes, &self.sizes, [at.q, at.v]);
            }
            let reach = if reach > 0.0 { reach } else { 1.0 };
            findings.book(subject, beyond(error, rounding), reach, at.time, name);
        }
    }
}

impl Guard {
    /// All values that it reads.
    fn reads(&self) -> impl Iterator<Item = usize> {
        self.terms.iter().chain(&self.region).copied()
    }

    /// Whether it is followed in a mode: gaps while their contacts are open.
    fn acts(&self, d: &Description, mode: &Mode) -> bool {
        match self.kind {
            Kind::Gap(c) => !mode.contacts[c],
            Kind::Stop(i) => mode.satisfies(d.stops[i].conditions),
            Kind::Mark(i) => mode.satisfies(d.marks[i].conditions),
        }
    }

    /// Its value, and the term that has it.
    fn value(&self, values: &Evaluator) -> (f64, usize) {
        let terms = self.terms.iter().map(|&term| (values.value(term), term));
        let least = terms.min_by(|a, b| a.0.total_cmp(&b.0));
        let (value, term) = least.unwrap_or((f64::NAN, 0));
        match self.region {
            Some(region) => (value.max(-values.value(region)), term),
            None => (value, term),
        }
    }

    /// Its value and its rate.
    fn range(&self, values: &Evaluator<Interval>) -> (Interval, Interval) {
        let terms = self.terms.iter();
        let both = terms.map(|&term| (values.value(term), values.rate(term)));
        let least = both.reduce(|a, b| (a.0.min(b.0), a.1.hull(b.1)));
        let (value, rate) = least.unwrap_or((Interval::ANYTHING, Interval::ANYTHING));
        match self.region {
            Some(region) => {
                let minus = Interval::number(-1.0);
                let outside = (minus * values.value(region), minus * values.rate(region));
                (value.max(outside.0), rate.hull(outside.1))
            }
            None => (value, rate),
        }
    }

    /// Whether a gap may vanish outside its region, and the motion come into the region beyond the surface.
    fn may_pass_edge(&self, values: &Evaluator<Interval>) -> bool {
        let contains_zero = |value: Interval| value.low < 0.0 && value.high > 0.0;
        let region = self.region.map(|region| values.value(region));
        region.is_some_and(contains_zero)
            && (self.terms.iter()).any(|&gap| contains_zero(values.value(gap)))
    }

    /// Whether a stop that is true now was false an instant ago.
    fn has_just_changed(&self, time: f64) -> bool {
        let just = 2.0 * ROUNDING_OF_TIME * time.abs();
        let last = self.last;
        last.is_some_and(|(before, earlier)| earlier < 0.0 && time - before <= just)
    }

    /// How far a mark has gone through zero since it was looked at last without having been logged, to within a `blur` of the time.
    fn misses(&self, time: f64, value: f64, zeros: bool, logged: &[f64], blur: f64) -> f64 {
        let Some((before, earlier)) = self.last else {
            return 0.0;
        };
        let crossed = earlier < 0.0 && value > 0.0 || zeros && earlier > 0.0 && value < 0.0;
        // Where it jumps, the time alone tells before from after.
        let blur = blur.max(1e-9 * (time - before));
        let near = before - blur..=time + blur;
        if crossed && !logged.iter().any(|t| near.contains(t)) {
            earlier.abs().min(value.abs())
        } else {
            0.0
        }
    }
}
