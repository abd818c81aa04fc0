//! Which combination it may be, by relaxation or by Lemke's method, and repairs of one that almost holds.

use super::Search;
use crate::arithmetic::Scalar;
use crate::linear::LemkeOutcome;
use crate::modes::impact::collision::{Collision, NormalSource};
use crate::modes::impact::complement::Ray;
use crate::modes::impact::pattern::{Pattern, Phase, Slide, Violation, length};

/// Shares of a correction that relaxation makes.
const PACES: [f64; 3] = [1.0, 0.5, 0.15];

/// Repetitions of Lemke's method with coefficients of sliding, or new bounds on constraints.
const MOST_PASSES: usize = 20;

impl<T: Scalar> Search<T> {
    /// Asks relaxation for the combination, more slowly where it swings.
    pub(super) fn relax(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
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
    pub(super) fn complement(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
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
            let lowered = self.lower_coefficients(c);
            if !lowered && (self.attempt_found(c, phase) || self.repair(c, phase)) {
                return true;
            }
            let links = c
                .rubs
                .iter()
                .any(|r| matches!(r.bearer, NormalSource::ConstraintRow(_)));
            if !lowered && !links {
                return false;
            }
        }
        false
    }

    /// What slides does so with the coefficient of sliding; that only lets more slide. Whether one has changed.
    fn lower_coefficients(&mut self, c: &Collision<T>) -> bool {
        let mut lowered = false;
        let coefficients = self.problem.coefficients.iter_mut().zip(&c.rubs);
        for ((coefficient, rub), slide) in coefficients.zip(&self.pattern.slides) {
            let slides = matches!(slide, Slide::Along(_) | Slide::Turning(_));
            if slides && *coefficient != rub.slide.value() {
                *coefficient = rub.slide.value();
                lowered = true;
            }
        }
        lowered
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
        if !self.holds(c, phase) {
            return false;
        }
        let tight = |p: &Pattern<T>, k: usize| {
            let row = c.touches[k].row;
            let over = p.after[row] - phase.aims[k];
            // With friction it would have to be decided what that does.
            let rough = c
                .rubs
                .iter()
                .any(|rub| rub.is_rough() && rub.bearer == NormalSource::ContactRow(k));
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
        if self.holds(c, phase) {
            return true;
        }
        self.pattern.pressed = fewer;
        self.pattern.undetermined = true;
        self.holds(c, phase)
    }

    /// Changes what is violated most, as often as there are rows.
    fn repair(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        for _ in 0..2 * c.size {
            self.tried += 1;
            let solved = self.pattern.solve(c, phase);
            match self.pattern.violation(c, phase) {
                None => return solved,
                // A contact that would have to pull turns its friction round, which then has no direction; it lets go all the same.
                Some(Violation::ContactRow(k)) if solved || self.pattern.pressed[k] => {
                    self.pattern.pressed[k] = !self.pattern.pressed[k]
                }
                Some(Violation::FrictionRow(r)) if solved => {
                    let rub = &c.rubs[r];
                    let impulse = &self.pattern.impulses[rub.rows()];
                    let size = length(impulse);
                    self.pattern.slides[r] = match (self.pattern.slides[r], impulse) {
                        (Slide::Stick, [x]) => Slide::Along(-x.value().signum()),
                        (Slide::Stick, [x, y]) => {
                            Slide::Turning([-x.value() / size, -y.value() / size])
                        }
                        _ => Slide::Stick,
                    };
                }
                Some(_) => return false,
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
