//! Which combination holds: all of them in order where they are few, else Lemke's method.
//!
//! Few: contacts pressed before free, frictions sticking before sliding, so that of several solutions the one with most
//! contacts and stick is taken. Many: the linear complementarity problem of Stewart & Trinkle (1996), with a cone of eight
//! sides where a slip has two components, says which combination it is; that one is then solved as equations. Several
//! frictions with two components: relaxation says which it is and where the slips are to be looked for.

use super::collision::{Bearer, Collision};
use super::complement::{Linear, Ray};
use super::pattern::{Pattern, Phase, Slide, Violation, length};
use super::relaxation::Relaxation;
use crate::arithmetic::Scalar;
use crate::linear::{Equilibrated, Lemke, LemkeOutcome};
use core::f64::consts::TAU;

/// So many combinations are tried one after the other before Lemke's method is asked.
const FEW: usize = 100;
/// So many are tried if that has failed.
const MOST: usize = 20_000;
/// Directions all round from which a slip is looked for.
const SIDES: usize = 8;
/// Steps that put each direction along the slip that it causes, before Newton's method.
const ALIGNMENTS: usize = 3;
/// Shares of a correction that relaxation makes.
const PACES: [f64; 3] = [1.0, 0.5, 0.15];
/// Marks of a circle between which a direction is looked for.
const MARKS: usize = 64;
/// Bisections between two marks.
const BISECTIONS: usize = 40;
/// Repetitions of Lemke's method with coefficients of sliding, or new bounds on constraints.
const MOST_PASSES: usize = 20;

/// A search for the combination that holds; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Search<T> {
    pub pattern: Pattern<T>,
    /// Combinations solved so far.
    pub tried: usize,
    lemke: Lemke,
    problem: Linear,
    relaxation: Relaxation,
    factors: Equilibrated<f64>,
    /// Touches that take part, and frictions that can act.
    taking: Vec<usize>,
    acting: Vec<usize>,
    choice: Vec<usize>,
}

impl<T: Scalar> Search<T> {
    /// Finds a combination that holds and leaves it in `pattern`; false if there is none.
    pub fn find(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.taking.clear();
        self.taking
            .extend((0..c.touches.len()).filter(|k| phase.within[*k]));
        let count = self.combinations(c);
        let several = c.rubs.iter().filter(|rub| rub.components > 1).count() > 1;
        if several {
            return self.relax(c, phase)
                || self.complement(c, phase)
                || count.is_some_and(|n| n <= FEW) && self.enumerate(c, phase);
        }
        if count.is_some_and(|n| n <= FEW) {
            return self.enumerate(c, phase) || self.complement(c, phase);
        }
        self.complement(c, phase) || count.is_some_and(|n| n <= MOST) && self.enumerate(c, phase)
    }

    /// Number of combinations, unless it is beyond counting.
    fn combinations(&self, c: &Collision<T>) -> Option<usize> {
        let contacts = 1_usize.checked_shl(self.taking.len() as u32)?;
        c.rubs.iter().try_fold(contacts, |n, rub| {
            n.checked_mul(if rub.components == 1 { 3 } else { 2 })
        })
    }

    fn enumerate(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        for open in 0..1_usize << self.taking.len() {
            self.pattern.pressed.clear();
            self.pattern.pressed.resize(c.touches.len(), false);
            for (bit, &k) in self.taking.iter().enumerate() {
                self.pattern.pressed[k] = open >> bit & 1 == 0;
            }
            self.list_acting(c, phase);
            self.choice.clear();
            self.choice.resize(self.acting.len(), 0);
            loop {
                if self.attempt_choice(c, phase) {
                    return true;
                }
                if !self.next_choice(c) {
                    break;
                }
            }
        }
        false
    }

    fn list_acting(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        self.acting.clear();
        for (r, rub) in c.rubs.iter().enumerate() {
            if self.pattern.bears(rub, phase) {
                self.acting.push(r);
            }
        }
    }

    /// The next combination of what the frictions do, the first one fastest.
    fn next_choice(&mut self, c: &Collision<T>) -> bool {
        for (choice, &r) in self.choice.iter_mut().zip(&self.acting) {
            *choice += 1;
            let states = if c.rubs[r].components == 1 { 3 } else { 2 };
            if *choice < states {
                return true;
            }
            *choice = 0;
        }
        false
    }

    fn attempt_choice(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let pattern = &mut self.pattern;
        pattern.slides.clear();
        pattern.slides.resize(c.rubs.len(), Slide::Idle);
        for (&choice, &r) in self.choice.iter().zip(&self.acting) {
            pattern.slides[r] = match (choice, c.rubs[r].components) {
                (0, _) => Slide::Stick,
                (1, 1) => Slide::Along(1.0),
                (_, 1) => Slide::Along(-1.0),
                _ => Slide::Turning([1.0, 0.0]),
            };
        }
        self.attempt(c, phase)
    }

    /// Solves and judges the present combination, from several directions of slip if there are any to be found.
    fn attempt(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.tried += 1;
        if !self.turns() {
            return self.holds(c, phase);
        }
        let turning = self
            .pattern
            .slides
            .iter()
            .filter(|s| matches!(s, Slide::Turning(_)));
        let single = turning.count() == 1;
        for k in 0..=SIDES {
            self.direct(c, phase, k);
            for _ in 0..ALIGNMENTS {
                if self.pattern.solve_held(c, phase) {
                    self.pattern.align(c);
                }
            }
            if self.holds(c, phase) {
                return true;
            }
        }
        single && self.turn_round(c, phase) && self.holds(c, phase)
    }

    /// Solves and judges the present combination.
    fn holds(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.pattern.solve(c, phase) && self.pattern.violation(c, phase).is_none()
    }

    /// The direction of the only turning friction along which its slip is: bisection between the marks of a circle.
    fn turn_round(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let mut slides = self.pattern.slides.iter();
        let Some(r) = slides.position(|s| matches!(s, Slide::Turning(_))) else {
            return false;
        };
        let mut deviation = |turns: f64| {
            let (sin, cos) = (TAU * turns).sin_cos();
            self.pattern.slides[r] = Slide::Turning([cos, sin]);
            let solved = self.pattern.solve_held(c, phase);
            solved.then(|| self.pattern.deviation(c, r))
        };
        let mut before = deviation(0.0);
        for mark in 1..=MARKS {
            let here = deviation(mark as f64 / MARKS as f64);
            if let (Some((a, along)), Some((b, also))) = (before, here)
                && (a < 0.0) != (b < 0.0)
                && (along > 0.0 || also > 0.0)
            {
                let (mut low, mut high) = ((mark - 1) as f64, mark as f64);
                let mut last = 0.0;
                for _ in 0..BISECTIONS {
                    let middle = 0.5 * (low + high);
                    let Some((across, along)) = deviation(middle / MARKS as f64) else {
                        break;
                    };
                    last = along;
                    if (across < 0.0) == (a < 0.0) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                if last > 0.0 {
                    return true;
                }
            }
            before = here;
        }
        false
    }

    fn turns(&self) -> bool {
        let mut slides = self.pattern.slides.iter();
        slides.any(|slide| matches!(slide, Slide::Turning(_)))
    }

    /// Where slips are looked for: along those before, then all round.
    fn direct(&mut self, c: &Collision<T>, phase: &Phase<T>, k: usize) {
        for (rub, slide) in c.rubs.iter().zip(&mut self.pattern.slides) {
            if let Slide::Turning(direction) = slide {
                let s = [0, 1].map(|k| phase.rates[rub.row + k].value());
                let speed = s[0].hypot(s[1]);
                let angle = TAU * k as f64 / SIDES as f64;
                *direction = if k == 0 && speed > 0.0 {
                    s.map(|x| x / speed)
                } else {
                    [angle.cos(), angle.sin()]
                };
            }
        }
    }

    /// Asks relaxation for the combination, more slowly where it swings.
    fn relax(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        for pace in PACES {
            self.relaxation.begin(c, phase, pace);
            for _ in 0..MOST_PASSES {
                self.relaxation.sweep(c, phase);
                if !self.relaxation.read(c, phase, &mut self.pattern) {
                    break;
                }
            }
            if self.attempt_found(c, phase) || self.repair(c, phase) {
                return true;
            }
        }
        false
    }

    /// Asks Lemke's method for the combination.
    fn complement(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.problem.reduce(c, phase, &mut self.factors);
        self.problem.coefficients.clear();
        let sticking = c.rubs.iter().map(|rub| rub.stick.value());
        self.problem.coefficients.extend(sticking);
        // Bounds of frictions on constraints follow from the pass before.
        self.pattern.impulses.clear();
        self.pattern.impulses.resize(c.size, T::zero());
        for _ in 0..MOST_PASSES {
            self.problem.write(c, phase, &self.pattern.impulses);
            let outcome = self.lemke.solve(&self.problem.matrix, &self.problem.q);
            if outcome != LemkeOutcome::Solved {
                return false;
            }
            self.read(c, phase);
            // What slides does so with the coefficient of sliding; that only lets more slide.
            let mut lowered = false;
            for ((coefficient, rub), slide) in self
                .problem
                .coefficients
                .iter_mut()
                .zip(&c.rubs)
                .zip(&self.pattern.slides)
            {
                let slides = matches!(slide, Slide::Along(_) | Slide::Turning(_));
                if slides && *coefficient != rub.slide.value() {
                    *coefficient = rub.slide.value();
                    lowered = true;
                }
            }
            if !lowered && (self.attempt_found(c, phase) || self.repair(c, phase)) {
                return true;
            }
            let links = c.rubs.iter().any(|r| matches!(r.bearer, Bearer::Link(_)));
            if !lowered && !links {
                return false;
            }
        }
        false
    }

    /// The combination that Lemke's method has found.
    fn read(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        let Self {
            problem,
            lemke,
            pattern,
            ..
        } = self;
        pattern.pressed.clear();
        pattern.pressed.resize(c.touches.len(), false);
        pattern.slides.clear();
        pattern.slides.resize(c.rubs.len(), Slide::Idle);
        for (at, ray) in problem.rays.iter().enumerate() {
            if let Ray::Press(k) = *ray {
                pattern.pressed[k] = lemke.is_active(at);
            }
        }
        for (r, rub) in c.rubs.iter().enumerate() {
            if pattern.bears(rub, phase) {
                pattern.slides[r] = Slide::Stick;
            }
        }
        let z = lemke.z();
        for (at, ray) in problem.rays.iter().enumerate() {
            if let Ray::Slip(r) = *ray
                && pattern.slides[r] == Slide::Stick
                && z[at] > 0.0
                && lemke.is_active(at)
            {
                let rub = &c.rubs[r];
                let mut s = [0.0; 2];
                for (k, s) in s.iter_mut().enumerate().take(rub.components) {
                    *s = problem.rate(rub.row + k, c, phase, z);
                }
                let speed = s[0].hypot(s[1]);
                let sizes = problem.rates[rub.row].abs() + c.terms[rub.row];
                if speed > 1e-11 * sizes {
                    pattern.slides[r] = if rub.components == 1 {
                        Slide::Along(s[0].signum())
                    } else {
                        Slide::Turning(s.map(|x| x / speed))
                    };
                }
            }
        }
    }

    /// The combination found, first with every contact pressed whose rate ends at its aim: their impulses are then shared.
    fn attempt_found(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.tried += 1;
        if !self.pattern.solve(c, phase) || self.pattern.violation(c, phase).is_some() {
            return false;
        }
        let tight = |p: &Pattern<T>, k: usize| {
            let row = c.touches[k].row;
            let over = p.after[row] - phase.aims[k];
            // With friction it would have to be decided what that does.
            let rough = c.rubs.iter().any(|rub| rub.bearer == Bearer::Touch(k));
            phase.within[k] && !p.pressed[k] && !rough && over.value() <= p.noise[row]
        };
        if !self.taking.iter().any(|&k| tight(&self.pattern, k)) {
            return true;
        }
        let fewer = self.pattern.pressed.clone();
        for &k in &self.taking {
            if tight(&self.pattern, k) {
                self.pattern.pressed[k] = true;
            }
        }
        if self.pattern.solve(c, phase) && self.pattern.violation(c, phase).is_none() {
            return true;
        }
        self.pattern.pressed = fewer;
        self.pattern.undetermined = true;
        self.pattern.solve(c, phase) && self.pattern.violation(c, phase).is_none()
    }

    /// Changes what is violated most, as often as there are rows.
    fn repair(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        for _ in 0..2 * c.size {
            self.tried += 1;
            if !self.pattern.solve(c, phase) {
                return false;
            }
            match self.pattern.violation(c, phase) {
                None => return true,
                Some(Violation::Touch(k)) => self.pattern.pressed[k] = !self.pattern.pressed[k],
                Some(Violation::Rub(r)) => {
                    let rub = &c.rubs[r];
                    let impulse = &self.pattern.impulses[rub.row..rub.row + rub.components];
                    let size = length(impulse);
                    self.pattern.slides[r] = match (self.pattern.slides[r], impulse) {
                        (Slide::Stick, [x]) => Slide::Along(-x.value().signum()),
                        (Slide::Stick, [x, y]) => {
                            Slide::Turning([-x.value() / size, -y.value() / size])
                        }
                        _ => Slide::Stick,
                    };
                }
            }
            for (r, rub) in c.rubs.iter().enumerate() {
                let bears = self.pattern.bears(rub, phase);
                let slide = &mut self.pattern.slides[r];
                match (bears, *slide) {
                    (false, _) => *slide = Slide::Idle,
                    (true, Slide::Idle) => *slide = Slide::Stick,
                    _ => {}
                }
            }
        }
        false
    }
}
