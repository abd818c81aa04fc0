//! Forces and impulses that are rounding errors → 0: two balls that touch and fall together press on each other by 1e-16 of their weights, and a picture
//! or a column of numbers would show that as large as any force.

use super::{Outcome, Sample};
use lagrange_core::prelude::Event;
use lagrange_core::system::Description;

/// What rounding leaves of a force, relative to the most that it ever holds in balance; of an impulse, relative to the largest of its
/// impact; of an angle, to 1 rad, for what depends on it does so by its sine and cosine.
pub(crate) const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// The impulse of a row in an impact, 0 if it is what rounding leaves of the others of its unit, with which it is solved for.
pub(crate) fn impulse(event: &Event<f64>, row: usize, description: &Description) -> f64 {
    let units = &description.units;
    let all = event.impulses.iter().enumerate();
    let alike = all.filter(|(other, _)| units.row(*other) == units.row(row));
    let largest = alike.fold(0.0, |a: f64, (_, impulse)| a.max(impulse.abs()));
    let impulse = event.impulses[row];
    if impulse.abs() < ROUNDING * largest {
        0.0
    } else {
        impulse
    }
}

/// A force that holds more than so many times the least that it ever holds, and more than it ever is, does so where its row vanishes, as that of a slider
/// in its dead centre: by such a row the largest load is held by an infinite force.
const USUAL: f64 = 1e6;

/// 0 for a force that is what rounding leaves of one that holds this.
pub(crate) fn force(force: f64, held: f64) -> f64 {
    match force.abs() < ROUNDING * held {
        true => 0.0,
        false => force,
    }
}

impl Outcome {
    /// Per row: the most that its force ever holds in balance, where the row does not vanish.
    pub(crate) fn held(&self) -> Vec<f64> {
        let mut rows = vec![(f64::INFINITY, 0.0_f64, 0.0_f64); self.description.rows.len()];
        for sample in self.all_samples() {
            let forces = sample.held.iter().zip(&sample.forces);
            for ((least, most, largest), (&held, force)) in rows.iter_mut().zip(forces) {
                let force = force.abs();
                if held > 0.0 || force > 0.0 {
                    *least = least.min(held.max(force));
                }
                *most = most.max(held);
                *largest = largest.max(force);
            }
        }
        let held = |(least, most, largest): (f64, f64, f64)| most.min((USUAL * least).max(largest));
        rows.into_iter().map(held).collect()
    }

    fn all_samples(&self) -> impl Iterator<Item = &Sample> {
        let around = self.around.iter().flatten().flatten();
        self.samples.iter().chain(&self.curve).chain(around)
    }

    /// Takes them out, and what frictions can hold by them.
    pub(super) fn take_out_rounding(&mut self) {
        let ever = self.held();
        let clean = |forces: &mut [f64], held: Option<&[f64]>| {
            for (row, (x, ever)) in forces.iter_mut().zip(&ever).enumerate() {
                *x = force(*x, held.map_or(*ever, |held| ever.max(held[row])));
            }
        };
        for (k, event) in self.events.iter_mut().enumerate() {
            let [before, after] = [0, 1].map(|side| {
                let sample = self.around.get(k)?[side].as_ref()?;
                Some(&*sample.held)
            });
            clean(&mut event.forces, before);
            clean(&mut event.forces_after, after);
            let impulses = 0..event.impulses.len();
            event.impulses = impulses
                .map(|row| impulse(event, row, self.description))
                .collect();
        }
        let samples = [&mut self.samples, &mut self.curve];
        let around = self.around.iter_mut().flatten().flatten();
        for sample in samples.into_iter().flatten().chain(around) {
            clean(&mut sample.forces, Some(&sample.held));
            let limits = sample.limits.iter_mut().zip(self.description.frictions);
            for (limit, friction) in limits {
                let held = ever[friction.row].max(sample.held[friction.row]);
                *limit = limit.map(|limit| force(limit, held));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::file;
    use crate::request::Request;
    use lagrange_core::mode::FrictionMode;

    /// A crank that a motor turns up to a stop at its dead centre; its slide, which there nothing moves, rubs with a force that is given.
    #[test]
    fn what_a_vanishing_row_holds_takes_no_other_force_for_rounding() {
        let declared = "parameters(j: \"kg m^2\" = 0.3, l: \"m\" = 0.7, T: \"N m\" = 4, F: \"N\" = 3), coordinates(a: \"rad\"),
            kinetic = j/2*der(a)^2, force(motor: a = T), friction(rub: slip = l*der(sin(a)), limit = F),
            contact(end: a <= pi/2), start(raised), until = 10";
        let scene = file::scene("toggle.lagrange", declared).expect("a declaration");
        let sampled = Request {
            samples: 400,
            ..Request::default()
        };
        let outcome = scene.run(&sampled).expect("a run");
        let slips = outcome.samples.iter();
        let slips =
            slips.filter(|sample| matches!(sample.mode.frictions[0], FrictionMode::Slip(_)));
        let mut forces = slips.map(|sample| sample.forces[1]);
        assert!(forces.clone().count() > 10);
        assert!(forces.all(|force| force == -3.0));
        // A story reads both ends of every phase only.
        let told = scene.run(&Request::default()).expect("a run");
        assert_eq!(told.events[0].forces_after[1], -3.0);
    }

    /// Balls of 2 kg and 1 kg that touch fall 1.1 m, where they press on each other by nothing, and then lie on one another.
    #[test]
    fn what_falls_together_does_not_press_on_each_other() {
        let declared = "parameters(m: \"kg\" = 2, n: \"kg\" = 1, g: \"m/s^2\" = 9.81, r: \"m\" = 0.1), coordinates(y: \"m\", z: \"m\"),
            kinetic = m/2*der(y)^2 + n/2*der(z)^2, potential = m*g*y + n*g*z, contact(floor: y >= r), contact(pair: z - y >= 2*r),
            start(above: y = 1.2, z = 1.4), until = 1";
        let scene = file::scene("pair.lagrange", declared).expect("a declaration");
        let outcome = scene
            .run(&Request {
                samples: 20,
                ..Request::default()
            })
            .expect("a run");
        for (lies, force) in [(false, 0.0), (true, 9.81)] {
            let samples = outcome.samples.iter();
            let mut samples = samples.filter(|sample| sample.mode.contacts[0] == lies);
            assert!(samples.all(|sample| (sample.forces[1] - force).abs() <= 1e-13 * force));
        }
    }

    /// A box falls flat on two feet, which have nothing to do across, and hardly turns.
    #[test]
    fn what_does_nothing_in_an_impact_has_no_impulse() {
        let declared = "parameters(m = 1.3, g = 9.81, a = 0.3, b = 0.7, mu = 0.4), coordinates(x, y, phi),
            define(foot[k in 0..2] = y + (2*k - 1)*a*sin(phi) - b*cos(phi), side[k in 0..2] = x + (2*k - 1)*a*cos(phi) + b*sin(phi)),
            kinetic = m/2*(der(x)^2 + der(y)^2) + m*(a^2 + b^2)/6*der(phi)^2, potential = m*g*y,
            contact(lands[k in 0..2]: foot[k] >= 0, restitution = 0.3),
            friction(rub[k in 0..2] on lands[k]: slip = der(side[k]), static = mu),
            start(drop: y = 1.2*b), until = 1";
        let scene = file::scene("box.lagrange", declared).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let impacts = outcome
            .events
            .iter()
            .filter(|event| !event.impulses.is_empty());
        let mut impulses = impacts.map(|event| &event.impulses);
        assert!(impulses.clone().count() > 10);
        assert!(impulses.all(|j| j[0] > 0.0 && j[1] > 0.0 && j[2..] == [0.0, 0.0]));
    }

    /// A yoke whose mass is at a place that is told twice: in its dead centres the joint has all of the force by a row that turns nothing.
    #[test]
    fn what_has_no_inertia_holds_what_it_is_tied_to() {
        let declared =
            "coordinates(a, x, u), constraint(red: u == x), constraint(joint: x == 0.1*cos(a)),
            kinetic = der(a)^2/2 + der(u)^2/2, friction(rub: slip = der(x), limit = 1),
            start(s: x = 0.1, u = 0.1, der(a) = 30), until = 0.105";
        let scene = file::scene("yoke.lagrange", declared).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        // u'' = -0.1 a'^2, which `red` pulls; `joint` pulls that and what rubs.
        let start = &outcome.samples[0].forces;
        assert!((start[0] + 90.0).abs() < 1e-9, "{start:?}");
        assert!((start[1] + 91.0).abs() < 1e-9, "{start:?}");
        assert!(outcome.events.iter().all(|event| event.forces[1] > 80.0));
    }
}
