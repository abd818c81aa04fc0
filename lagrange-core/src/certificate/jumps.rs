//! Energies that jump within a step where no branch of their declaration says so: at the cut of an `atan2`, where a square root vanishes that is divided by.
//!
//! A potential that jumps refracts what passes it, or reflects it, and a mass that jumps changes velocities; equations of motion that hold on both sides of
//! it say nothing of that. Between two instants T and V change by the integral of their rates along the step's polynomials, here by Gauss–Legendre
//! quadrature. Where that is off the time between them is cut in two: an error of the quadrature vanishes then, and a jump is left in one of the parts.

use super::equations::{Equations, change};
use super::quadrature::gauss;
use super::sizes::rounding_of;
use super::step::Step;
use super::{Findings, Subject, beyond};
use crate::arithmetic::Pack;
use crate::declaration::{AtState, Gradient, Operations, Seed};
use crate::integrate::{AtPlaces, PLACES};
use crate::system::Description;
use core::cmp::Ordering;

/// Two instants that are nearer than this share of a step are not taken apart any further.
const NARROW: f64 = 1e-13;

/// What is less than so many times its rounding lies at the border: the polynomials of a step are rounded as well.
const AT_BORDER: f64 = 8.0;

/// The share of the first part of what is cut in two: not a half, where symmetric motions have what is singular.
const FIRST: f64 = 0.48;

/// A step is cut into at most so many parts, for T and V each.
const PARTS: usize = 512;

/// The energies of a run that may jump, along its steps.
#[derive(Debug)]
pub(super) struct Energies {
    d: &'static Description,
    /// At an instant.
    instant: AtState,
    /// At the places of a quadrature.
    places: AtState<AtPlaces>,
    /// The terms of T and of V, of each if it may jump.
    terms: Vec<Vec<usize>>,
    /// What their choices depend on.
    guards: Vec<usize>,
    /// Places of the quadrature between −1 and 1, and their weights.
    nodes: [AtPlaces; 2],
    /// Per coordinate: the size below which its errors are absolute; empty: 1 for all.
    least: Vec<f64>,
    gradients: Vec<Gradient>,
    /// Parts that the step may still be cut into.
    parts: usize,
}

/// An energy at an instant.
#[derive(Clone, Copy, Debug)]
struct Value {
    value: f64,
    rate: f64,
}

/// What an energy is measured by at an instant.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    value: f64,
    reach: f64,
    rounding: f64,
}

impl Energies {
    /// Those of these equations, if any of them may jump.
    pub fn new(equations: &Equations) -> Option<Self> {
        let (d, declaration) = (equations.d, equations.declaration);
        // T has the sign 1 in L, and V −1.
        let terms = [1.0, -1.0].map(|which| -> Vec<usize> {
            let terms = equations.energies();
            let terms = terms.filter(|&(_, sign)| sign == which);
            terms.map(|(value, _)| value).collect()
        });
        let may_jump = |terms: &Vec<usize>| {
            let operations = Operations::of(declaration, terms.iter().copied());
            operations.may_jump()
        };
        let terms: Vec<Vec<usize>> = terms.into_iter().filter(may_jump).collect();
        if terms.is_empty() {
            return None;
        }
        let n = d.coordinates.len();
        let instant = AtState::new(declaration, &equations.parameters, terms.concat(), n);
        let nodes = gauss(PLACES);
        let of_nodes = |part: fn(&(f64, f64)) -> f64| {
            Pack(core::array::from_fn(|k| nodes.get(k).map_or(0.0, part)))
        };
        Some(Self {
            d,
            guards: instant.evaluator.guards(),
            instant,
            places: AtState::new(declaration, &equations.parameters, terms.concat(), n),
            terms,
            nodes: [of_nodes(|node| node.0), of_nodes(|node| node.1)],
            least: equations.sizes.clone(),
            gradients: vec![Gradient::default(); n],
            parts: 0,
        })
    }

    /// Books how far T and V jump within a step.
    pub fn follow(&mut self, step: &Step, findings: &mut Findings) {
        self.take_sides(step);
        for energy in 0..self.terms.len() {
            let [(first, begin), (last, end)] = [0.0, step.end].map(|s| {
                step.at(s, &mut self.instant);
                (self.value(energy), self.sizes(energy))
            });
            let size = begin.value.max(end.value) + begin.reach.max(end.reach);
            let rounding = begin.rounding + end.rounding;
            self.parts = PARTS;
            let negligible = findings.tolerance * size + rounding;
            let (jump, s) = self.jump(energy, step, [0.0, step.end], [first, last], negligible);
            let time = step.motion.time(s);
            let jump = beyond(jump, rounding);
            findings.book(Subject::Jumps, jump, size, time, self.d.name);
        }
    }

    /// Keeps choices on the sides that they have in the middle of a step.
    fn take_sides(&mut self, step: &Step) {
        if self.guards.is_empty() {
            return;
        }
        self.instant.evaluator.take_for([]);
        step.at(0.5 * step.end, &mut self.instant);
        // Within a step choices stay as they are, but for those that lie at their border all the time, as where two bodies fall side by side: the power of a
        // depth of −1e-17 is no number.
        let mut changes = vec![[0.0; 3]; self.gradients.len()];
        let mut sides = Vec::new();
        let AtState { evaluator, .. } = &mut self.instant;
        for &guard in &self.guards {
            let value = evaluator.value(guard);
            let terms = evaluator.gradient_size(guard, 0, &mut changes);
            let side = match value < 0.0 {
                true => Ordering::Less,
                false => Ordering::Equal,
            };
            sides.extend((value.abs() > AT_BORDER * rounding_of(terms)).then_some((guard, side)));
        }
        self.places.evaluator.take_for(sides.iter().copied());
        self.instant.evaluator.take_for(sides);
    }

    /// How far an energy jumps between two parts of a step, at which it has these values, and where; nothing where that is negligible.
    fn jump(
        &mut self,
        energy: usize,
        step: &Step,
        [a, b]: [f64; 2],
        [first, last]: [Value; 2],
        negligible: f64,
    ) -> (f64, f64) {
        let [places, weights] = self.nodes;
        let places = places.0.map(|x| a + 0.5 * (b - a) * (1.0 + x));
        step.motion.at_places(Pack(places), &mut self.places);
        let terms = self.terms[energy].iter();
        let rates = terms.map(|&term| self.places.evaluator.rate(term));
        let rates = rates.fold(AtPlaces::default(), |sum, rate| sum + rate);
        let gained = rates.0.into_iter().zip(weights.0);
        let gained: f64 = gained.map(|(rate, weight)| weight * rate).sum();
        let gained = 0.5 * (b - a) * step.motion.h * gained;
        // The rate of a root has no value where that vanishes.
        let gained = if gained.is_finite() { gained } else { 0.0 };
        let error = (last.value - first.value - gained).abs();
        let middle = a + FIRST * (b - a);
        if error <= negligible {
            return (0.0, b);
        }
        if self.parts == 0 || b - a <= NARROW * step.end || !(a < middle && middle < b) {
            return (error, b);
        }
        self.parts -= 1;
        step.at(middle, &mut self.instant);
        let between = self.value(energy);
        if !between.value.is_finite() {
            return (error, b);
        }
        let parts = [
            ([a, middle], [first, between]),
            ([middle, b], [between, last]),
        ];
        let parts = parts.map(|(ends, values)| self.jump(energy, step, ends, values, negligible));
        // What is no number is worse than any number.
        match parts[0].0.total_cmp(&parts[1].0) {
            Ordering::Less => parts[1],
            _ => parts[0],
        }
    }

    /// T or V in the state taken.
    fn value(&self, energy: usize) -> Value {
        let terms = self.terms[energy].iter();
        let start = Value {
            value: 0.0,
            rate: 0.0,
        };
        terms.fold(start, |sum, &term| Value {
            value: sum.value + self.instant.evaluator.value(term),
            rate: sum.rate + self.instant.evaluator.rate(term),
        })
    }

    /// How large it is in the state taken, how much it changes when every position and velocity does so on the scale of the tolerance, and what rounding
    /// makes of it.
    fn sizes(&mut self, energy: usize) -> Sizes {
        let seed = |&value: &usize| Seed {
            value,
            variation: [0.0; 2],
            gradient: 1.0,
        };
        let seeds: Vec<Seed> = self.terms[energy].iter().map(seed).collect();
        let AtState {
            evaluator, q, v, ..
        } = &mut self.instant;
        evaluator.sweep(&seeds, &mut self.gradients);
        let changes = self.gradients.iter();
        let changes = changes.map(|g| [g.position.sum.abs(), g.velocity.sum.abs(), 0.0]);
        let mut changes: Vec<[f64; 3]> = changes.collect();
        let reach = change(&changes, &self.least, [q, v]);
        let (mut value, mut rounding) = (0.0, 0.0);
        for &term in &self.terms[energy] {
            value += evaluator.value(term).abs();
            rounding += rounding_of(evaluator.gradient_size(term, 0, &mut changes));
        }
        Sizes {
            value,
            reach,
            rounding,
        }
    }
}
