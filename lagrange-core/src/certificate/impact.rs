//! Impacts: the balance of momenta, restitution, friction, constraints, and what becomes of the energy.

use super::Subject;
use super::equations::{Equations, Situation};
use super::instant::length;
use super::motion::Examination;
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::error::Level;
use crate::system::{Contact, Impacts, Normal, Restitution};
use crate::trajectory::{Event, State};

/// Rates of everything that impulses act on, row by row, with how much the velocities can change them.
#[derive(Clone, Debug, Default)]
struct Rates {
    rate: Vec<f64>,
    reach: Vec<f64>,
}

/// An impact as numbers.
struct Jump {
    time: f64,
    before: State<f64>,
    impulses: Vec<f64>,
    rates_before: Rates,
    rates_after: Rates,
    /// Per contact: whether it takes part.
    touches: Vec<bool>,
    /// Whether the law of impact holds as declared: together, by Newton's restitution, which was not lowered.
    exact: bool,
}

impl<T: Scalar> Examination<'_, T> {
    /// Checks one impact. Where others follow at the same time, what is closed after it is not so before they have happened.
    pub fn impact(&mut self, event: &Event<T>, others_follow: bool) {
        let jump = self.jump(event, others_follow);
        let d = self.equations.d;
        for (i, coordinate) in d.coordinates.iter().enumerate() {
            let (error, size) = (self.equations.residual[i].abs(), self.equations.size[i]);
            self.findings
                .book(Subject::Impulses, error, size, jump.time, coordinate.name);
        }
        // Impulses are measured by the momenta of this impact.
        core::mem::swap(&mut self.equations.largest, &mut self.equations.size);
        self.examine_struck_contacts(&jump);
        self.examine_struck_constraints(&jump);
        self.examine_struck_frictions(&jump);
        self.examine_energy_of_impact(&jump, event.subject.name(d));
        core::mem::swap(&mut self.equations.largest, &mut self.equations.size);
    }

    /// The numbers of an impact; its balance of momenta is left in the equations, which have taken the state before.
    fn jump(&mut self, event: &Event<T>, others_follow: bool) -> Jump {
        let time = event.time.value();
        let (before, after) = (event.state.values(), event.state_after.values());
        let impulses: Vec<f64> = event.impulses.iter().map(|x| x.value()).collect();
        let equations = &mut self.equations;
        equations.take(Situation::of_state(time, &after));
        let rates_after = equations.rates(time, &after);
        equations.size = equations.momentum_sizes(time, &after, &event.after);
        equations.momenta(time, &after, &[]);
        for (i, gradient) in equations.gradients.iter().enumerate() {
            equations.residual[i] = gradient.velocity.sum;
            equations.size[i] += gradient.velocity.size;
        }
        equations.momenta(time, &before, &impulses);
        for (i, gradient) in equations.gradients.iter().enumerate() {
            equations.residual[i] -= gradient.velocity.sum + gradient.variation.sum;
            equations.size[i] += gradient.velocity.size + gradient.variation.size;
        }
        equations.take(Situation::of_state(time, &before));
        let rates_before = equations.rates(time, &before);
        let contacts = equations.d.contacts.iter();
        let newton = |c: &Contact| matches!(c.restitution, Restitution::Newton(_));
        let together = self.record.asked.impacts == Impacts::Together;
        let exact = together && contacts.clone().all(newton) && !event.restitution_lowered;
        let touches = contacts.enumerate().map(|(c, contact)| {
            equations.includes(Item::Contact(c))
                && (impulses[contact.row] != 0.0 || !others_follow && event.after.contacts[c])
        });
        Jump {
            touches: touches.collect(),
            time,
            before,
            impulses,
            rates_before,
            rates_after,
            exact,
        }
    }

    fn examine_struck_contacts(&mut self, jump: &Jump) {
        let (equations, findings) = (&mut self.equations, &mut self.findings);
        let Jump { time, exact, .. } = *jump;
        let contacts = equations.d.contacts.iter().enumerate();
        for (c, contact) in contacts.filter(|(c, _)| jump.touches[*c]) {
            let (row, name) = (contact.row, contact.name);
            let impulse = jump.impulses[row];
            let size = equations.impulse_along(row);
            findings.book(Subject::Impacts, -impulse, size, time, name);
            // A start is as near to a surface as somebody has written it.
            if impulse != 0.0 && time > self.record.first_time() {
                let gap = equations.declaration.contacts[c].gap;
                let reach = equations.reach(gap, 0, Situation::of_state(time, &jump.before));
                let error = equations.values.coefficient(gap, 0).abs();
                findings.book(Subject::Closed, error, reach, time, name);
            }
            let (rate, reach) = (jump.rates_after.rate[row], jump.rates_after.reach[row]);
            findings.book(Subject::Impacts, -rate, reach, time, name);
            if exact {
                let e = equations
                    .values
                    .value(equations.declaration.contacts[c].restitution);
                let aim = e * (-jump.rates_before.rate[row]).max(0.0);
                findings.book(Subject::Impacts, aim - rate, reach, time, name);
                // Λ ⟂ rate − aim, each beside its size.
                let (slack, push) = (
                    (rate - aim).abs() / reach,
                    impulse.abs() / size.max(f64::MIN_POSITIVE),
                );
                findings.book(Subject::Impacts, slack.min(push), 1.0, time, name);
            }
        }
    }

    fn examine_struck_constraints(&mut self, jump: &Jump) {
        let Jump { rates_after, .. } = jump;
        for (i, constraint) in self.equations.d.constraints.iter().enumerate() {
            let touched = constraint.while_contact.is_none_or(|c| jump.touches[c]);
            if self.equations.includes(Item::Constraint(i)) && touched {
                let rate = rates_after.rate[constraint.row].abs();
                let reach = rates_after.reach[constraint.row];
                self.findings
                    .book(Subject::Impacts, rate, reach, jump.time, constraint.name);
            }
        }
    }

    fn examine_struck_frictions(&mut self, jump: &Jump) {
        let (equations, findings) = (&mut self.equations, &mut self.findings);
        let (time, impulses) = (jump.time, &jump.impulses);
        for (f, friction) in equations.d.frictions.iter().enumerate() {
            // What follows one another, in turn or by Poisson's law, may push a constraint either way: of that the sum says nothing.
            let is_told = match friction.normal {
                Normal::Contact(_) => true,
                Normal::Constraint(_) | Normal::Resultant(_) => jump.exact,
                Normal::Given(_) => false,
            };
            if !is_told {
                continue;
            }
            let (rows, name) = (friction.rows(), friction.name);
            let tangential = &impulses[rows.clone()];
            let is_struck = friction.normal.presses(equations.d, |c| jump.touches[c]);
            if !(equations.includes(Item::Friction(f)) && is_struck) {
                findings.book(Subject::Idle, length(tangential), 1.0, time, name);
                continue;
            }
            let declared = equations.declaration.frictions[f];
            let mu_static = equations.values.value(declared.static_coefficient);
            let mu_kinetic = equations.values.value(declared.kinetic_coefficient);
            let (normal, size) = equations.normal(f, impulses);
            let size = equations.impulse_along(friction.row) + mu_static * size;
            let excess = length(tangential) - mu_static.max(mu_kinetic) * normal;
            findings.book(Subject::Impacts, excess, size, time, name);
            let slip = &jump.rates_after.rate[rows.clone()];
            let reaches = jump.rates_after.reach[rows].iter();
            let reach = reaches.fold(0.0, |a: f64, b| a.max(*b));
            let speed = length(slip);
            if jump.exact && speed > 1e3 * findings.tolerance * reach {
                let errors = tangential.iter().zip(slip);
                let errors = errors.map(|(p, s)| (p + mu_kinetic * normal * s / speed).abs());
                let error = errors.fold(0.0, f64::max);
                findings.book(Subject::Impacts, error, size, time, name);
            }
        }
    }

    /// ΔT without the work of moving surfaces is ½ Σ Λ (rate⁻ + rate⁺).
    fn examine_energy_of_impact(&mut self, jump: &Jump, name: &'static str) {
        let (mut gain, mut size) = (0.0, 0.0);
        let impulses = jump.impulses.iter().enumerate();
        // What is not struck need not have a rate: the slip of a friction whose contact is elsewhere, or left out, may be 0/0.
        for (row, impulse) in impulses.filter(|(_, impulse)| **impulse != 0.0) {
            let (before, after) = (jump.rates_before.rate[row], jump.rates_after.rate[row]);
            gain += impulse * (before + after);
            size += impulse.abs() * (before.abs() + after.abs());
        }
        // Where hardly anything is struck, what rounding leaves of the other rates counts beside the whole motion.
        let speeds = jump.before.v.iter().map(|v| v.abs());
        let momenta = self.equations.largest.iter();
        let whole = momenta.zip(speeds).map(|(p, v)| p * v);
        let size = size + whole.sum::<f64>();
        self.findings
            .book(Subject::Dissipation, gain, size, jump.time, name);
    }
}

impl Equations {
    /// Size of impulses along a row.
    fn impulse_along(&mut self, row: usize) -> f64 {
        let (value, level) = self.row(row);
        self.force_along(value, level)
    }

    /// Rates of all rows in the state taken.
    fn rates(&mut self, time: f64, state: &State<f64>) -> Rates {
        let mut rates = Rates::default();
        for row in 0..self.d.rows.len() {
            let (value, level) = self.row(row);
            let power = usize::from(level == Level::Position);
            rates.rate.push(self.values.coefficient(value, power));
            rates
                .reach
                .push(self.reach(value, power, Situation::of_state(time, state)));
        }
        rates
    }
}
