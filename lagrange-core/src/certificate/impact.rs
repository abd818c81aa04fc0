//! Impacts: the balance of momenta, restitution, friction, constraints, and what becomes of the energy.

use super::Subject;
use super::equations::{Equations, Situation};
use super::instant::length;
use super::motion::{Examination, numbers};
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::error::Level;
use crate::system::{Impacts, Normal, Restitution};
use crate::trajectory::{Event, State};

/// Rates of everything that impulses act on, row by row, with how much the velocities can change them.
#[derive(Clone, Debug, Default)]
struct Rates {
    rate: Vec<f64>,
    reach: Vec<f64>,
}

impl<T: Scalar> Examination<'_, T> {
    /// Checks one impact. Where others follow at the same time, what is closed after it is not so before they have happened.
    pub fn impact(&mut self, event: &Event<T>, others_follow: bool) {
        let (time, before, after) = (
            event.time.value(),
            numbers(&event.state),
            numbers(&event.state_after),
        );
        let impulses: Vec<f64> = event.impulses.iter().map(|x| x.value()).collect();
        let d = self.equations.d;
        let (equations, findings) = (&mut self.equations, &mut self.findings);
        equations.size = equations.momentum_sizes(time, &after);
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
        equations.take(Situation::of_state(time, &after));
        let rates_after = equations.rates(time, &after);
        equations.take(Situation::of_state(time, &before));
        let rates = equations.rates(time, &before);
        for (i, coordinate) in d.coordinates.iter().enumerate() {
            let (error, size) = (equations.residual[i].abs(), equations.size[i]);
            findings.book(Subject::Impulses, error, size, time, coordinate.name);
        }
        // Impulses are measured by the momenta of this impact.
        core::mem::swap(&mut equations.largest, &mut equations.size);
        // Sizes of impulses along a row.
        let along = |equations: &mut Equations, row: usize| {
            let (value, level) = equations.row(row);
            equations.force_along(value, level)
        };
        let together = self.record.asked.impacts == Impacts::Together;
        let newton = d
            .contacts
            .iter()
            .all(|c| matches!(c.restitution, Restitution::Newton(_)));
        let exact = together && newton && !event.restitution_lowered;
        let touches: Vec<bool> = (0..d.contacts.len())
            .map(|c| {
                let row = d.contacts[c].row;
                equations.includes(Item::Contact(c))
                    && (impulses[row] != 0.0 || !others_follow && event.after.contacts[c])
            })
            .collect();
        for (c, contact) in d.contacts.iter().enumerate() {
            let (row, name) = (contact.row, contact.name);
            let impulse = impulses[row];
            if !touches[c] {
                continue;
            }
            let size = along(equations, row);
            findings.book(Subject::Impacts, -impulse, size, time, name);
            // A start is as near to a surface as somebody has written it.
            if impulse != 0.0 && time > self.record.first_time() {
                let gap = equations.declaration.contacts[c].gap;
                let reach = equations.reach(gap, 0, Situation::of_state(time, &before));
                let error = equations.values.coefficient(gap, 0).abs();
                findings.book(Subject::Closed, error, reach, time, name);
            }
            let (rate, reach) = (rates_after.rate[row], rates_after.reach[row]);
            findings.book(Subject::Impacts, -rate, reach, time, name);
            if exact {
                let e = equations
                    .values
                    .value(equations.declaration.contacts[c].restitution);
                let aim = e * (-rates.rate[row]).max(0.0);
                findings.book(Subject::Impacts, aim - rate, reach, time, name);
                // Λ ⟂ rate − aim, each beside its size.
                let (slack, push) = (
                    (rate - aim).abs() / reach,
                    impulse.abs() / size.max(f64::MIN_POSITIVE),
                );
                findings.book(Subject::Impacts, slack.min(push), 1.0, time, name);
            }
        }
        for (i, constraint) in d.constraints.iter().enumerate() {
            let touched = constraint.while_contact.is_none_or(|c| touches[c]);
            if equations.includes(Item::Constraint(i)) && touched {
                let (rate, reach) = (
                    rates_after.rate[constraint.row],
                    rates_after.reach[constraint.row],
                );
                findings.book(Subject::Impacts, rate.abs(), reach, time, constraint.name);
            }
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            let Normal::Contact(c) = friction.normal else {
                continue;
            };
            let rows = friction.rows();
            let tangential = &impulses[rows.clone()];
            if !(equations.includes(Item::Friction(f)) && touches[c]) {
                findings.book(Subject::Idle, length(tangential), 1.0, time, friction.name);
                continue;
            }
            let declared = equations.declaration.frictions[f];
            let mu_static = equations.values.value(declared.static_coefficient);
            let mu_kinetic = equations.values.value(declared.kinetic_coefficient);
            let (normal, size) = equations.normal(f, &impulses);
            let size = along(equations, friction.row) + mu_static * size;
            let excess = length(tangential) - mu_static.max(mu_kinetic) * normal;
            findings.book(Subject::Impacts, excess, size, time, friction.name);
            let slip = &rates_after.rate[rows.clone()];
            let reach = rates_after.reach[rows]
                .iter()
                .fold(0.0, |a: f64, b| a.max(*b));
            let speed = length(slip);
            if exact && speed > 1e3 * findings.tolerance * reach {
                let errors = tangential.iter().zip(slip);
                let error = errors.map(|(p, s)| (p + mu_kinetic * normal * s / speed).abs());
                findings.book(
                    Subject::Impacts,
                    error.fold(0.0, f64::max),
                    size,
                    time,
                    friction.name,
                );
            }
        }
        // ΔT without the work of moving surfaces is ½ Σ Λ (rate⁻ + rate⁺).
        let (mut gain, mut size) = (0.0, 0.0);
        for (row, impulse) in impulses.iter().enumerate() {
            gain += impulse * (rates.rate[row] + rates_after.rate[row]);
            size += impulse.abs() * (rates.rate[row].abs() + rates_after.rate[row].abs());
        }
        // Where hardly anything is struck, what rounding leaves of the other rates counts beside the whole motion.
        let speeds = before.v.iter().map(|v| v.abs());
        let whole = equations.largest.iter().zip(speeds).map(|(p, v)| p * v);
        let size = size + whole.sum::<f64>();
        findings.book(
            Subject::Dissipation,
            gain,
            size,
            time,
            event.subject.name(d),
        );
        core::mem::swap(&mut equations.largest, &mut equations.size);
    }
}

impl Equations {
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
