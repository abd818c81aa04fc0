//! Only the effects that a scene calls for: what is left out costs what it would cost if it had never been declared.

use lagrange_core::dynamics::{Dynamics, Operations, add_guards};
use lagrange_core::prelude::*;
use lagrange_tests::modes::all;
use lagrange_tests::pairs::{Pair, Visitor, visit};

/// A cart with everything.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    define(px = x + length * sin(theta), py = y - length * cos(theta)),
    kinetic = cart/2 * (der(x)^2 + der(y)^2) + bob/2 * (der(px)^2 + der(py)^2),
    potential(weight: gravity * (cart * y + bob * py)),
    potential(spring: stiffness/2 * x^2 * (1 + x^2)),
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = mu),
    force(motor: x = torque * sin(rate * t)),
    dissipation(drag: damping/2 * (der(px)^2 + der(py)^2)),
)]
struct Everything {
    cart: f64,
    bob: f64,
    length: f64,
    gravity: f64,
    stiffness: f64,
    mu: f64,
    torque: f64,
    rate: f64,
    damping: f64,
}

/// The same cart with the weights and the floor alone.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    define(px = x + length * sin(theta), py = y - length * cos(theta)),
    kinetic = cart/2 * (der(x)^2 + der(y)^2) + bob/2 * (der(px)^2 + der(py)^2),
    potential(weight: gravity * (cart * y + bob * py)),
    contact(floor: y >= 0),
)]
struct Plain {
    cart: f64,
    bob: f64,
    length: f64,
    gravity: f64,
}

const EVERYTHING: Everything = Everything {
    cart: 1.5,
    bob: 0.7,
    length: 0.9,
    gravity: 9.81,
    stiffness: 3.0,
    mu: 0.4,
    torque: 2.0,
    rate: 1.3,
    damping: 0.25,
};

const PLAIN: Plain = Plain {
    cart: 1.5,
    bob: 0.7,
    length: 0.9,
    gravity: 9.81,
};

/// Operations and accelerations, on the floor or above it, with all that a step watches.
fn cost<S: Derived<Scalar = f64>>(
    system: &S,
    effects: &Effects,
    closed: bool,
) -> (Operations, Vec<f64>) {
    let d = S::DESCRIPTION;
    let mut mode = Mode::open(d);
    mode.contacts[0] = closed;
    let mut dynamics = Dynamics::new(system, effects);
    dynamics.set_mode(&mode);
    let mut needs = dynamics.motion_needs().clone();
    add_guards(d, effects, &mode, &mut needs);
    dynamics.set_extra_needs(&needs);
    let y = if closed { 0.0 } else { 0.3 };
    dynamics
        .value(0.2, &[0.4, y, 0.7], &[0.5, 0.0, -1.1])
        .expect("a regular state");
    (dynamics.operations(), dynamics.acceleration().to_vec())
}

#[test]
fn what_is_left_out_costs_what_is_not_declared() {
    let without = Effects::all()
        .without(Everything::SPRING)
        .without(Everything::GRIP)
        .without(Everything::MOTOR)
        .without(Everything::DRAG);
    for closed in [true, false] {
        let left_out = cost(&EVERYTHING, &without, closed);
        let undeclared = cost(&PLAIN, &Effects::all(), closed);
        assert_eq!(left_out.0, undeclared.0, "closed: {closed}");
        for (a, b) in left_out.1.iter().zip(&undeclared.1) {
            assert!((a - b).abs() <= 1e-14 * b.abs().max(1.0), "{a}, not {b}");
        }
        let all = cost(&EVERYTHING, &Effects::all(), closed);
        assert!(all.0.accelerations > undeclared.0.accelerations + 10);
    }
}

#[test]
fn each_effect_adds_its_own_operations() {
    let all = cost(&EVERYTHING, &Effects::all(), false).0;
    for item in Item::all(Everything::DESCRIPTION) {
        let less = cost(&EVERYTHING, &Effects::all().without(item), false).0;
        let name = item.name(Everything::DESCRIPTION);
        match item {
            // In flight the floor is watched and does not act, and its friction is not even watched.
            Item::Contact(_) => {
                assert_eq!(less.accelerations, all.accelerations, "{name}");
            }
            Item::Friction(_) => assert_eq!(less, all, "{name}"),
            _ => assert!(less.accelerations < all.accelerations, "{name}"),
        }
    }
}

/// Operations and accelerations in a mode, with all that a step watches; nothing if the equations cannot be solved.
fn cost_in<S: Derived<Scalar = f64>>(
    system: &S,
    effects: &Effects,
    mode: &Mode,
) -> Option<(Operations, Vec<f64>)> {
    let d = S::DESCRIPTION;
    let mut dynamics = Dynamics::new(system, effects);
    dynamics.set_mode(mode);
    let mut needs = dynamics.motion_needs().clone();
    add_guards(d, effects, mode, &mut needs);
    dynamics.set_extra_needs(&needs);
    let place = |from: f64, step: f64| -> Vec<f64> {
        let numbers = (0..d.coordinates.len()).map(|i| from + step * i as f64);
        numbers.collect()
    };
    dynamics
        .value(0.2, &place(0.4, 0.17), &place(0.9, -0.23))
        .ok()?;
    Some((dynamics.operations(), dynamics.acceleration().to_vec()))
}

/// The mode of the whole that is this mode of the part: what is left out, declared last, does not act.
fn widened<Whole: Derived>(mode: &Mode) -> Mode {
    let mut wide = Mode::open(Whole::DESCRIPTION);
    wide.contacts[..mode.contacts.len()].copy_from_slice(&mode.contacts);
    wide.frictions[..mode.frictions.len()].copy_from_slice(&mode.frictions);
    wide
}

/// Every kind of item, in every mode: left out, it costs as many operations as if it had never been declared.
struct Equal(usize);

impl Visitor for Equal {
    fn pair<Whole, Part>(&mut self, pair: &Pair, whole: &Whole, part: &Part)
    where
        Whole: Derived<Scalar = f64> + Starts,
        Part: Derived<Scalar = f64> + Starts,
    {
        for mode in all(Part::DESCRIPTION) {
            let what = format!("{}: {}", pair.name, mode.display(Part::DESCRIPTION));
            let left_out = cost_in(whole, &pair.without, &widened::<Whole>(&mode));
            let undeclared = cost_in(part, &Effects::all(), &mode);
            match (left_out, undeclared) {
                (Some(left_out), Some(undeclared)) => {
                    assert_eq!(left_out.0, undeclared.0, "{what}");
                    for (a, b) in left_out.1.iter().zip(&undeclared.1) {
                        let error = (a - b).abs() / b.abs().max(1.0);
                        assert!(error <= 1e-13, "{what}: {a}, not {b}");
                    }
                    self.0 += 1;
                }
                (a, b) => assert_eq!(a.is_some(), b.is_some(), "{what}"),
            }
        }
    }
}

/// A ball whose stop and mark wait for the floor to be left.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(z),
    kinetic = mass/2 * der(z)^2,
    contact(floor: z >= 0),
    force(pull: z = mass * (t - 1)),
    stop(off: open(floor)),
    mark(left: open(floor)),
)]
struct Pulled {
    mass: f64,
}

#[test]
fn stops_and_marks_that_are_left_out_do_not_act() {
    let ball = Pulled { mass: 1.0 };
    let run = |effects: Effects| {
        let rest = State::new(vec![0.0], vec![0.0]);
        let trajectory = Simulation::new(&ball).effects(effects).run(rest, 0.0..2.0);
        let trajectory = trajectory.expect("a run");
        let kinds: Vec<EventKind> = trajectory.events().iter().map(|event| event.kind).collect();
        (trajectory.last_time(), kinds)
    };
    let (end, kinds) = run(Effects::all().without(Pulled::LEFT));
    assert!((end - 1.0).abs() < 1e-9, "{end}");
    assert_eq!(kinds, [EventKind::Lost, EventKind::Stop]);
    let neither = Effects::all().without(Pulled::OFF).without(Pulled::LEFT);
    assert_eq!(run(neither), (2.0, vec![EventKind::Lost]));
}

#[test]
fn every_kind_of_item_costs_nothing_where_it_is_left_out() {
    let mut equal = Equal(0);
    visit(&mut equal);
    assert!(equal.0 >= 33, "only {} modes", equal.0);
}

/// Counts pairs whose runs make the same steps.
struct SameSteps(usize);

impl Visitor for SameSteps {
    fn pair<Whole, Part>(&mut self, pair: &Pair, whole: &Whole, part: &Part)
    where
        Whole: Derived<Scalar = f64> + Starts,
        Part: Derived<Scalar = f64> + Starts,
    {
        let start = part.at(StartId(0));
        let without = Simulation::new(whole).effects(pair.without.clone());
        let whole = without.run(&start, 0.0..2.0).expect("a run");
        let part = Simulation::new(part).run(&start, 0.0..2.0).expect("a run");
        let times = |run: &Trajectory<f64>| run.step_times().collect::<Vec<_>>();
        let (times, expected) = (times(&whole), times(&part));
        assert_eq!(times.len(), expected.len(), "{}", pair.name);
        for (time, expected) in times.iter().zip(expected) {
            assert!((time - expected).abs() < 1e-6, "{}", pair.name);
        }
        self.0 += 1;
    }
}

/// The order of a step is that of what takes part.
#[test]
fn runs_make_the_same_steps_where_an_item_is_left_out() {
    let mut same = SameSteps(0);
    visit(&mut same);
    assert!(same.0 >= 13, "only {} pairs", same.0);
}
