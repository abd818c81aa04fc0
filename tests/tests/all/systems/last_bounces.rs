//! Impacts that accumulate while the body slides on: what is left of them acts on all coordinates.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, TOLERANCES, agree, all_agree, certified, event, methods_at, root, run_by, times,
};

/// A block dropped onto a rough incline, which lifts or not while the block bounces.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * gravity * (n * cos(slope) - s * sin(slope)),
    contact(plane: n >= lift * t^2 / 2, restitution = bounce),
    friction(grip on plane: slip = der(s), static = mu),
)]
struct Incline {
    mass: f64,
    gravity: f64,
    slope: f64,
    lift: f64,
    bounce: f64,
    mu: f64,
}

/// While it slides, friction is μ times the normal impulse, however that is distributed: with n = ½ a t² at the end,
/// ∫N dt = m (a t + g t cos β − ṅ₀). The motion down the incline at the end follows from the momentum.
#[test]
fn the_last_bounces_rub_as_the_others_do() {
    for (lift, bounce, mu) in [(0.0, 0.5, 0.2), (0.0, 0.8, 0.1), (3.0, 0.6, 0.3)] {
        let scene = Incline {
            mass: 2.0,
            gravity: 9.0,
            slope: 0.3,
            lift,
            bounce,
            mu,
        };
        for (method, tolerance) in methods_at(["taylor", "dop853"], TOLERANCES) {
            let until = 4.0;
            let start = state(&[0.0, 0.5], &[8.0, -1.0]);
            let motion = run_by(&scene, (method, tolerance), start, until);
            let closes = event(&motion, "plane", "accumulates").time;
            assert!(closes < until);
            let normal = (lift + 9.0 * scene.slope.cos()) * until + 1.0;
            let speed = 8.0 + 9.0 * scene.slope.sin() * until - mu * normal;
            assert!(speed > 0.0, "it slides all the time");
            let asked = format!("{method} {tolerance:e}, {bounce}: speed");
            agree(&asked, motion.final_state().v[0], speed, 10.0 * tolerance);
        }
    }
}

/// From each impact on, the last one that is followed included, the sampler has the velocity after it, and at all times that which follows from the
/// momentum: ∫N dt = m (ṅ − ṅ₀ + g t cos β).
#[test]
fn between_the_last_impact_and_the_rest_the_motion_goes_on() {
    for (lift, bounce, mu) in [(0.0, 0.3, 0.15), (0.0, 0.7, 0.1), (2.0, 0.5, 0.2)] {
        let scene = Incline {
            mass: 1.3,
            gravity: 9.81,
            slope: 0.4,
            lift,
            bounce,
            mu,
        };
        for (method, tolerance) in methods_at(["taylor", "radau5"], TOLERANCES) {
            let what = format!("{method} {tolerance:e}, {bounce}");
            let start = state(&[0.0, 0.7], &[9.0, -2.0]);
            let motion = run_by(&scene, (method, tolerance), start, 5.0);
            let mut sampler = motion.sampler();
            for impact in times(&motion, "plane", "impact") {
                let mut events = motion.events().iter();
                let event = events.find(|event| event.time == impact);
                let after = event.expect("it is that of an event").v_after(Incline::N);
                let now = sampler.at(impact).expect("recorded");
                agree(&what, now.v(Incline::N), after, 1e-14);
            }
            let ends = event(&motion, "plane", "accumulates");
            let last = times(&motion, "plane", "impact");
            let last = *last.last().expect("it bounces");
            for part in [0.0, 0.2, 0.5, 0.9, 0.999, 1.0] {
                let t = last + part * (ends.time - last);
                let now = sampler.at(t).expect("recorded");
                let normal = now.v(Incline::N) + 2.0 + 9.81 * scene.slope.cos() * t;
                let speed = 9.0 + 9.81 * scene.slope.sin() * t - mu * normal;
                agree(&what, now.v(Incline::S), speed, 10.0 * tolerance);
                let lifted = lift * t * t / 2.0;
                agree(&what, now.q(Incline::N), lifted, 10.0 * tolerance);
            }
        }
    }
}

/// A bar that falls flat, end after end, and slides on: the rest of its impacts must not turn its friction round.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * 9.81 * y,
    contact(left: y - reach * sin(theta) >= 0, restitution = bounce),
    contact(right: y + reach * sin(theta) >= 0, restitution = bounce),
    friction(left_grip on left: slip = der(x) + reach * sin(theta) * der(theta), static = mu),
    friction(right_grip on right: slip = der(x) - reach * sin(theta) * der(theta), static = mu),
)]
struct Bar {
    mass: f64,
    inertia: f64,
    reach: f64,
    bounce: f64,
    mu: f64,
}

#[test]
fn a_bar_that_has_fallen_flat_is_slowed_down() {
    let scene = Bar {
        mass: 1.5,
        inertia: 0.14,
        reach: 0.85,
        bounce: 0.07,
        mu: 0.15,
    };
    for (method, tolerance) in methods_at(["taylor", "dopri5"], TOLERANCES) {
        let start = state(&[0.0, 1.2, 0.25], &[2.7, -0.4, 0.5]);
        let motion = run_by(&scene, (method, tolerance), start, 0.9);
        let asked = format!("{method} {tolerance:e}");
        assert!(event(&motion, "left", "closed").time < 0.8, "{asked}");
        // Whatever the ends carry, ∫N dt = m (g t − ẏ₀).
        let speed = 2.7 - 0.15 * (9.81 * 0.9 + 0.4);
        agree(&asked, motion.final_state().v[0], speed, 10.0 * tolerance);
        assert!(motion.verify(0).expect("a certificate").holds(), "{asked}");
    }
}

/// A rod falls to the floor and bounces, with a sleeve clamped to it, which every impact pushes down by a little.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(rod, sleeve),
    kinetic = rod_mass/2 * der(rod)^2 + sleeve_mass/2 * der(sleeve)^2,
    potential = gravity * (rod_mass * rod + sleeve_mass * sleeve),
    contact(floor: rod >= 0, restitution = bounce),
    friction(clamp: slip = der(sleeve) - der(rod), limit = hold),
)]
struct Sleeve {
    rod_mass: f64,
    sleeve_mass: f64,
    gravity: f64,
    bounce: f64,
    hold: f64,
}

/// After every impact, the last one that is followed included, the sleeve slips on until it sticks to the flying rod; where the impacts end it sticks, and
/// nothing begins anew.
#[test]
fn what_sticks_between_bounces_sticks_where_they_end() {
    let scene = Sleeve {
        rod_mass: 1.0,
        sleeve_mass: 0.7,
        gravity: 9.81,
        bounce: 0.6,
        hold: 60.0,
    };
    for (method, tolerance) in methods_at(["taylor", "dop853", "verner98"], TOLERANCES) {
        let start = state(&[0.5, 1.0], &[0.0, 0.0]);
        let run = run_by(&scene, (method, tolerance), start, 5.0);
        let ends = |e: &Event<f64>| matches!(e.kind, EventKind::Accumulates { .. });
        let rest = run.events().iter().position(ends);
        let after = &run.events()[rest.expect("the bounces end")..];
        let kinds: Vec<&EventKind> = after.iter().map(|event| &event.kind).collect();
        assert!(
            matches!(kinds[..], [_, EventKind::Closed, EventKind::Sticks]),
            "{method} {tolerance:e}: {kinds:?}"
        );
        assert!(run.final_mode().sticks(Sleeve::CLAMP));
        let weight = after[1].force_after(Sleeve::FLOOR);
        agree("weight", weight, 1.7 * 9.81, 1e-9);
        let carried = after[1].force_after(Sleeve::CLAMP);
        agree("carried", carried, 0.7 * 9.81, 1e-9);
    }
}

/// Two balls that bounce beside each other, and a load that slides under the second one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(first, second, x),
    kinetic = (der(first)^2 + der(second)^2 + der(x)^2) / 2,
    potential = gravity * (first + second),
    contact(one: first >= 0, restitution = soft),
    contact(other: second >= 0, restitution = hard),
    friction(grip on other: slip = der(x), static = mu),
)]
struct TwoBalls {
    gravity: f64,
    soft: f64,
    hard: f64,
    mu: f64,
}

/// A ball that falls for the time t comes to rest after t (1 + e)/(1 − e). The second one does so a little later than the first, when it is
/// closer to its table than the tolerance already.
#[test]
fn a_ball_bounces_on_although_another_one_has_come_to_rest() {
    let scene = TwoBalls {
        gravity: 7.0,
        soft: 0.4,
        hard: 0.65,
        mu: 0.3,
    };
    let lasts = |e: f64| (1.0 + e) / (1.0 - e);
    let fall = 0.45;
    let first = fall * lasts(scene.soft);
    for (later, tolerance) in [(2e-3, 1e-6), (3e-4, 1e-6), (4e-5, 1e-9), (1e-6, 1e-12)] {
        let end = first + later;
        let height = |t: f64| 0.5 * scene.gravity * t * t;
        let start = [height(fall), height(end / lasts(scene.hard)), 0.0];
        for method in ["taylor", "dop853", "radau5"] {
            let start = state(&start, &[0.0, 0.0, 6.0]);
            let motion = run_by(&scene, (method, tolerance), start, 2.0);
            let asked = format!("{method} {tolerance:e}, {later:e} later");
            let closes = |item: &str| event(&motion, item, "closed").time;
            agree(&asked, closes("one"), first, 10.0 * tolerance);
            agree(&asked, closes("other"), end, 10.0 * tolerance);
        }
    }
}

/// A block on a spring that presses it against a stop.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = (rate * (x + reach))^2 / 2,
    contact(stop: x >= 0, restitution = bounce),
    start(pulled: x = 1),
)]
struct PressedBlock {
    rate: f64,
    reach: f64,
    bounce: f64,
}

/// With the speed u it comes back after (2/ω) atan(u/(ω d)), and is thrown back with e u. Whatever the method, flights within a single step end as
/// exactly as steps do: between its stages Radau's step is of order 3 only.
#[test]
fn impacts_within_a_step_are_as_exact_as_its_end() {
    let block = PressedBlock {
        rate: 5.0,
        reach: 0.4,
        bounce: 0.7,
    };
    let amplitude: f64 = 1.0 + block.reach;
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let simulation = Simulation::new(&block).method(method).tolerance(tolerance);
        let motion = simulation
            .run(block.at(PressedBlock::PULLED), 0.0..3.0)
            .unwrap();
        let mut speed = block.rate * (amplitude.powi(2) - block.reach.powi(2)).sqrt();
        let mut time = (block.reach / amplitude).acos() / block.rate;
        let impacts = motion.events().iter();
        let impacts = impacts.filter(|event| event.kind == EventKind::Impact);
        for (k, impact) in impacts.enumerate() {
            let what = format!("impact {k} with {method} at {tolerance:e}");
            agree(&what, impact.time, time, 5.0 * tolerance);
            speed *= block.bounce;
            time += 2.0 / block.rate * (speed / (block.rate * block.reach)).atan();
        }
        let last = motion.events().last().unwrap();
        assert_eq!(last.kind, EventKind::Closed, "{method} {tolerance:e}");
    }
}

/// A tappet falls onto a disc that turns about a point off its centre and has turned many times: the gap has a root in it, whose
/// series converges less far than those of the motion.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, phi),
    kinetic = mass/2 * der(y)^2 + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    dissipation(bearing: drag/2 * der(phi)^2),
    contact(disc: y >= throw * cos(phi) + sqrt(radius^2 - (throw * sin(phi))^2), restitution = bounce),
    start(above: y = 1.5, phi = turned, der(phi) = 4),
)]
struct Tappet {
    mass: f64,
    inertia: f64,
    gravity: f64,
    drag: f64,
    throw: f64,
    radius: f64,
    bounce: f64,
    turned: f64,
}

/// The disc is pressed down only while the tappet touches; what the kinetic energy of both and the weight lose is the work of drag and blows.
#[test]
fn the_last_bounces_of_a_gap_with_a_short_series() {
    for turned in [0.0, 25.0, 400.0] {
        for bounce in [0.2, 0.5] {
            let scene = Tappet {
                mass: 0.3,
                inertia: 0.4,
                gravity: 9.81,
                drag: 0.5,
                throw: 0.2,
                radius: 0.6,
                bounce,
                turned,
            };
            for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
                let asked = format!("{method} {tolerance:e}, {bounce}, {turned}");
                let simulation = Simulation::new(&scene).method(method).tolerance(tolerance);
                let run = simulation.run(scene.at(Tappet::ABOVE), 0.0..6.0);
                let run = run.unwrap_or_else(|failure| panic!("{asked}: {failure}"));
                assert!(run.final_mode().closed(Tappet::DISC), "{asked}");
                let [y, phi] = run.final_state().q[..] else {
                    panic!("two coordinates");
                };
                let height = 0.2 * phi.cos() + (0.36 - (0.2 * phi.sin()).powi(2)).sqrt();
                agree(&asked, y, height, 100.0 * tolerance * turned.max(1.0));
            }
        }
    }
}

/// A mass in a bowl, whose gap is written without a root and times a factor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(bowl: factor * (x^2 + y^2) <= factor * radius^2, restitution = 3/5),
)]
struct Bowl {
    radius: f64,
    gravity: f64,
    factor: f64,
}

/// The same with its gap as a distance.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(bowl: sqrt(x^2 + y^2) <= radius, restitution = 3/5),
)]
struct RoundBowl {
    radius: f64,
    gravity: f64,
}

/// A gap of large numbers comes to rest as one that is a distance in metres does, in other units as well.
#[test]
fn the_last_bounces_of_a_gap_of_large_numbers() {
    let (radius, gravity, x) = (6.0, 9.81, 3.0);
    let round = RoundBowl { radius, gravity };
    let start = state(&[x, 0.0], &[0.0; 2]);
    let reference = run_by(&round, ("verner98", 1e-12), start, 4.0);
    let rests = event(&reference, "bowl", "accumulates").time;
    for (unit, factor) in [(1.0, 1.0), (1.0, 1e6), (1e3, 1.0), (1e5, 1.0), (1e3, 1e-6)] {
        let scene = Bowl {
            radius: radius * unit,
            gravity: gravity * unit,
            factor,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let start = state(&[x * unit, 0.0], &[0.0; 2]);
            let motion = run_by(&scene, (method, tolerance), start, 4.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let found = event(&motion, "bowl", "accumulates").time;
            agree(&what, found, rests, 100.0 * tolerance);
            for (found, expected) in motion
                .final_state()
                .q
                .iter()
                .zip(&reference.final_state().q)
            {
                agree(&what, found / unit, *expected, 1e3 * tolerance);
            }
        }
    }
}

/// A body that lies on a shaken table, one that slides on the ground, and a ball.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, a, c, d, b),
    define(place = shaken * sin(10 * t)),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + der(a)^2 + der(c)^2 + der(d)^2 + der(b)^2) / 2,
    potential = 9.81 * (z + d + b),
    contact(table: z >= 0),
    contact(ground: d >= 0),
    contact(floor: b >= 0, restitution = 1/2),
    friction(grip on table: slip = (der(x), der(y) - der(place)), static = 2/5, kinetic = 1/5),
    friction(rub on ground: slip = (der(a), der(c)), static = 2/5, kinetic = 1/5),
    start(go: b = height, der(y) = 10 * shaken, der(a) = 1),
)]
struct Apart {
    shaken: f64,
    height: f64,
}

/// The table holds its body by less than μₛ g: it goes with it, also while the bounces of the ball come to their end elsewhere.
#[test]
fn the_last_bounces_move_nothing_that_lies_elsewhere() {
    for (shaken, height) in [(0.03, 0.01), (0.035, 0.02), (0.025, 0.015)] {
        let scene = Apart { shaken, height };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Apart::GO), 0.5);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            event(&motion, "floor", "accumulates");
            let expected = shaken * 5.0_f64.sin();
            agree(&what, motion.final_state().q[1], expected, 10.0 * tolerance);
        }
    }
}

/// A hammer that a growing and falling force pushes against an anvil that dry friction holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, u),
    kinetic = anvil/2 * der(x)^2 + hammer/2 * der(u)^2,
    force(push: u = strength * (1 + sin(pulse * t) / 2)),
    contact(face: u <= x, restitution = bounce),
    friction(ground: slip = der(x), limit = (held, rubs)),
    start(back: x = place, u = place - stroke),
)]
struct Hammer {
    anvil: f64,
    hammer: f64,
    strength: f64,
    pulse: f64,
    bounce: f64,
    held: f64,
    rubs: f64,
    place: f64,
    stroke: f64,
}

impl Hammer {
    /// How far the hammer is driven from rest in a time after `t`, and how fast it is then.
    fn driven(&self, t: f64, time: f64) -> [f64; 2] {
        let (w, a) = (self.pulse, self.strength / self.hammer);
        let turned = w * (t + time);
        let far = time * (w * t).cos() / w - (turned.sin() - (w * t).sin()) / (w * w);
        let fast = ((w * t).cos() - turned.cos()) / w;
        [a * (time * time / 2.0 + far / 2.0), a * (time + fast / 2.0)]
    }

    /// Where the anvil comes to rest: from blow to blow, until the hammer is as good as at rest on it, and as far as both slide on.
    fn ends_at(&self) -> f64 {
        let (mut t, mut x) = (0.0, self.place);
        // Velocities just after a blow, and how far behind the anvil the hammer is.
        let (mut ahead, mut back, mut behind) = (0.0, 0.0, self.stroke);
        let braked = self.rubs / self.anvil;
        loop {
            let slides = |time: f64| {
                let time = time.min(ahead / braked);
                ahead * time - braked / 2.0 * time * time
            };
            let gap = |time: f64| behind + slides(time) - back * time - self.driven(t, time)[0];
            let mut late = 1e-9;
            while gap(late) > 0.0 || late < 1e-8 {
                late *= 1.5;
            }
            let time = root(gap, late / 1e4, late);
            let speed = back + self.driven(t, time)[1];
            let rest = (ahead - braked * time).max(0.0);
            (t, x, behind) = (t + time, x + slides(time), 0.0);
            let blow =
                (1.0 + self.bounce) * (speed - rest) / (1.0 / self.anvil + 1.0 / self.hammer);
            (ahead, back) = (rest + blow / self.anvil, speed - blow / self.hammer);
            if blow < 1e-6 {
                break;
            }
        }
        let both = self.anvil + self.hammer;
        let speed = (self.anvil * ahead + self.hammer * back) / both;
        let on = |time: f64| {
            let [far, fast] = self
                .driven(t, time)
                .map(|driven| driven * self.hammer / both);
            let braked = self.rubs / both * time;
            [far + (speed - braked / 2.0) * time, fast + speed - braked]
        };
        let slides = root(|time| on(time)[1], 0.0, 1.0);
        x + on(slides)[0]
    }
}

/// The anvil slides a little at every blow and rests before the next one. What it slides at the last of them is less than what rounds its place.
#[test]
fn blows_too_small_to_be_seen_in_positions_come_to_an_end() {
    for (place, hammer, bounce, rubs) in [
        (0.05, 1.2, 0.81, 3.5),
        (0.07, 1.1, 0.75, 3.9),
        (1.7, 1.3, 0.7, 4.4),
        (40.0, 1.2, 0.81, 3.7),
        (-3.0, 1.4, 0.6, 4.1),
    ] {
        let scene = Hammer {
            anvil: 1.0,
            hammer,
            strength: 2.24,
            pulse: 20.0,
            bounce,
            held: 4.5,
            rubs,
            place,
            stroke: 0.03,
        };
        let ends = scene.ends_at();
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Hammer::BACK), 1.5);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            event(&motion, "face", "accumulates");
            certified(&what, &motion);
            let [x, u] = motion.final_state().q[..] else {
                panic!("two coordinates")
            };
            agree(&what, x, ends, 100.0 * tolerance);
            agree(&what, x, u, tolerance);
        }
    }
}

/// A peg on a spring in a slot with play and rough sides; the slot rubs on its guide.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = peg/2 * der(x)^2 + slot/2 * der(y)^2,
    potential = stiffness/2 * (x - 1/5)^2 + load * y,
    contact(upper: 2*x - y >= -1/50, restitution = bounce),
    contact(lower: 2*x - y <= 1/50, restitution = bounce),
    friction(over on upper: slip = der(x) + der(y), static = mu, kinetic = rubs),
    friction(under on lower: slip = der(x) + der(y), static = mu, kinetic = rubs),
    friction(guide: slip = der(y), limit = held),
    start(go: der(x) = speed),
)]
struct Slot {
    peg: f64,
    slot: f64,
    stiffness: f64,
    load: f64,
    bounce: f64,
    mu: f64,
    rubs: f64,
    held: f64,
    speed: f64,
}

/// The guide lets the slot slip at each blow and holds it again: what it moves by in the last ones is less than rounding, so that they would go on for ever.
#[test]
fn bounces_between_which_a_friction_turns_come_to_an_end() {
    let rattles = Slot {
        peg: 1.685,
        slot: 0.594,
        stiffness: 5.685,
        load: 0.659,
        bounce: 0.475,
        mu: 0.327,
        rubs: 0.271,
        held: 0.478,
        speed: 0.394,
    };
    let heavy = Slot {
        peg: 1.378,
        slot: 1.897,
        stiffness: 10.516,
        load: 0.984,
        bounce: 0.444,
        mu: 0.568,
        rubs: 0.224,
        held: 0.111,
        speed: 0.321,
    };
    for scene in [rattles, heavy] {
        let coarse = run_by(&scene, ("dopri5", 1e-7), scene.at(Slot::GO), 1.0);
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Slot::GO), 1.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            certified(&what, &motion);
            assert!(motion.events().len() < 80, "{what}");
            let states = [&motion, &coarse].map(|run| run.final_state());
            for (found, expected) in states[0].q.iter().zip(&states[1].q) {
                agree(&what, *found, *expected, 1e-5);
            }
        }
    }
}

/// A ball that bounces to rest beside a block that only a brake slows down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 10 * y,
    contact(floor: y >= 0, restitution = 0.5),
    friction(brake: slip = der(x), limit = limit),
)]
struct Beside {
    limit: f64,
}

/// The block stops shortly before the ball lies, at 0.6 s, in the time of the impacts that are not followed: it stays where it is.
#[test]
fn what_a_brake_stops_among_the_last_bounces_is_not_pushed_back() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        for (limit, before) in [
            (1.0, 1e-5),
            (1e3, 1e-5),
            (1e3, 1e-7),
            (1e5, 1e-6),
            (30.0, 3e-8),
        ] {
            let scene = Beside { limit };
            let stops = 0.6 - before;
            let start = state(&[0.0, 0.2], &[limit * stops, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 0.7);
            let what = format!("{scene:?}, {before:e} before, by {method} at {tolerance:e}");
            assert_eq!(motion.final_state().v[0], 0.0, "{what}");
            let rests = event(&motion, "brake", "sticks").time;
            agree(&what, rests, stops, 10.0 * tolerance);
            assert!(times(&motion, "brake", "reverses").is_empty(), "{what}");
            certified(&what, &motion);
        }
    }
}

/// A ball that bounces to rest on the floor, is kicked up, and bounces to rest again; beside that it runs into a smooth wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 10 * y,
    force(kick: y = if(t <= 3, 0, if(t <= 3.2, push, 0))),
    contact(floor: y >= 1, restitution = bounce),
    contact(side: x <= 5, restitution = 1),
    start(drop: y = 1 + height, der(x) = speed),
)]
struct Kicked {
    height: f64,
    bounce: f64,
    push: f64,
    speed: f64,
}

/// Each time the falls shrink geometrically. The impacts of both times and that with the wall are no train.
#[test]
fn a_ball_that_is_kicked_up_again_comes_to_rest_again() {
    let scenes = [
        (
            0.9233906194481636,
            0.5350311902650291,
            58.53766177594673,
            1.7436250635788708,
        ),
        (0.7, 0.55, 40.0, 2.3),
        (1.1, 0.45, 71.0, 1.3),
    ];
    for (height, bounce, push, speed) in scenes {
        let scene = Kicked {
            height,
            bounce,
            push,
            speed,
        };
        let shrinks = bounce / (1.0 - bounce);
        let fall = (2.0 * height / 10.0_f64).sqrt();
        let first = fall * (1.0 + 2.0 * shrinks);
        // The kick lifts the ball by so much, and leaves it this velocity.
        let (rate, lifted) = ((push - 10.0) * 0.2, (push - 10.0) * 0.02);
        let down = (rate * rate + 20.0 * lifted).sqrt();
        let second = 3.2 + (rate + down) / 10.0 + 2.0 * down / 10.0 * shrinks;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Kicked::DROP), 20.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rests = times(&motion, "floor", "closed");
            assert_eq!(rests.len(), 2, "{what}");
            agree(&what, rests[0], first, 10.0 * tolerance);
            agree(&what, rests[1], second, 10.0 * tolerance);
            certified(&what, &motion);
        }
    }
}

/// A ball that a belt carries against a rounded kerb, over which the belt runs on. It bounces to rest on the one and on the other in turn, ever sooner.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    define(distance = sqrt(x^2 + (y - high)^2)),
    contact(belt: y >= radius, where x <= 0, restitution = throws),
    contact(kerb: distance >= radius, where x <= 0, restitution = throws),
    friction(carry on belt: slip = der(x) - 100, static = mu),
    friction(rub on kerb: slip = (der(x)*(y - high) - der(y)*x)/distance - 100, static = mu),
    start(carried: x = -radius - way, y = radius, der(x) = speed),
)]
struct Kerb {
    gravity: f64,
    radius: f64,
    high: f64,
    throws: f64,
    mu: f64,
    way: f64,
    speed: f64,
}

/// It rests in the corner, at the time that 50 digits give for the first of them, however rounding orders the last bounces.
#[test]
fn bounces_on_two_surfaces_in_turn_come_to_an_end() {
    let balls = [
        (
            [
                0.2475929254183783,
                0.11908240673427953,
                0.18909761080693444,
                0.41098654996442374,
                0.06638221480995328,
                0.7005762432864433,
            ],
            Some(0.713_657_793_938_891),
        ),
        (
            [
                0.23625297266664427,
                0.1330107505728358,
                0.07542308916550572,
                0.40036791095025,
                0.1735086697767938,
                0.5916122712384924,
            ],
            None,
        ),
    ];
    for ([radius, high, throws, mu, way, speed], known) in balls {
        let scene = Kerb {
            gravity: 9.81,
            radius,
            high,
            throws,
            mu,
            way,
            speed,
        };
        let corner = -(radius * radius - (radius - high).powi(2)).sqrt();
        let methods = METHODS.into_iter().chain([Method::Gauss6 { step: 1e-3 }]);
        for (method, tolerance) in methods.flat_map(|method| [1e-7, 1e-9].map(|t| (method, t))) {
            let run = run_by(&scene, (method, tolerance), scene.at(Kerb::CARRIED), 1.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            assert!(run.events().len() < 1000, "{what}: {}", run.events().len());
            let mode = run.final_mode();
            assert!(mode.closed(Kerb::BELT) && mode.closed(Kerb::KERB), "{what}");
            let rests = run.events().last().expect("events").time;
            agree(&what, rests, known.unwrap_or(rests), 200.0 * tolerance);
            all_agree(
                &what,
                &run.final_state().q,
                &[corner, radius],
                10.0 * tolerance,
            );
        }
    }
}

/// A ball on a post in soil, which holds it by a given friction; a damper joins the ball to a slide that rests.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(ball, post, slide),
    kinetic = light/2 * der(ball)^2 + heavy/2 * der(post)^2 + light/2 * der(slide)^2,
    potential = gravity * (light * ball + heavy * post),
    dissipation(damper: drag/2 * (der(slide) - der(ball))^2),
    contact(head: ball >= post, restitution = bounce),
    friction(soil: slip = der(post), limit = hold),
    friction(rail: slip = der(slide), limit = hold),
)]
struct Post {
    light: f64,
    heavy: f64,
    gravity: f64,
    drag: f64,
    bounce: f64,
    hold: f64,
}

/// After each impact, the last one that is followed included, the post moves down against all that holds it, until it sticks, and the rail holds the slide
/// against the damper by the velocity after it: its force is −c ẏ.
#[test]
fn the_forces_after_the_last_impact_are_those_of_what_it_has_moved() {
    for (bounce, hold) in [(0.4, 40.0), (0.6, 25.0)] {
        let scene = Post {
            light: 0.3,
            heavy: 1.4,
            gravity: 9.0,
            drag: 0.2,
            bounce,
            hold,
        };
        for (method, tolerance) in methods_at(["taylor", "dop853"], TOLERANCES) {
            let what = format!("{method} {tolerance:e}, {bounce}");
            let start = state(&[0.7, 0.0, 0.0], &[0.0; 3]);
            let run = run_by(&scene, (method, tolerance), start, 3.0);
            certified(&what, &run);
            let mut impacts = 0;
            for hit in run.events().iter().filter(|e| e.kind == EventKind::Impact) {
                impacts += 1;
                let sliding = lagrange_core::mode::Sliding::sign(-1.0);
                assert_eq!(
                    hit.after.frictions[0],
                    FrictionMode::Slip(sliding),
                    "{what}"
                );
                assert_eq!(hit.force_after(Post::SOIL), hold, "{what}");
                let damped = -scene.drag * hit.state_after.v[0];
                agree(&what, hit.force_after(Post::RAIL), damped, 1e-12);
            }
            assert!(impacts > 5, "{what}");
            let sticks = run.events().iter().rev();
            let mut sticks = sticks.filter(|e| e.kind == EventKind::Sticks);
            let rests = event(&run, "head", "accumulates").time;
            assert_eq!(sticks.next().map(|e| e.time), Some(rests), "{what}");
        }
    }
}

/// A ball rolls down against a sledge on a bed of clay; it turns wheels where it moves to one side, and has mud in front.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(ball, x, y, z),
    kinetic = light/2 * der(ball)^2 + heavy/2 * (der(x)^2 + der(y)^2 + der(z)^2) + wheels/2 * der(y)^2,
    potential = gravity * (light * ball * sin(slope) + heavy * z),
    force(mud: x = if(der(x) >= 0, -drag * der(x), 0)),
    constraint(bed: z == 0),
    contact(buffer: ball >= x * cos(angle) + y * sin(angle), restitution = bounce),
    friction(runners on bed: slip = [der(x), der(y)], static = mu),
    friction(clay: slip = [der(x), der(y)], limit = hold),
)]
struct Sledge {
    light: f64,
    heavy: f64,
    wheels: f64,
    gravity: f64,
    slope: f64,
    angle: f64,
    drag: f64,
    bounce: f64,
    mu: f64,
    hold: f64,
}

/// Each impact, the last one that is followed included, sets the sledge sliding along M⁻¹n, n = (cos α, sin α); all that holds it acts against that, with μ m g
/// and with what the clay holds, and so does the mud if it slides that way.
#[test]
fn the_last_impact_that_is_followed_sets_a_sledge_sliding_in_the_plane() {
    for (angle, bounce, mu, hold) in [
        (0.4_f64, 0.6, 0.9, 8.0),
        (2.2, 0.5, 0.6, 12.0),
        (-1.1, 0.7, 0.2, 20.0),
    ] {
        let scene = Sledge {
            light: 0.15,
            heavy: 1.1,
            wheels: 0.7,
            gravity: 9.4,
            slope: 0.35,
            angle,
            drag: 0.3,
            bounce,
            mu,
            hold,
        };
        let [x, y] = [angle.cos() / 1.1, angle.sin() / 1.8];
        let along = [x / x.hypot(y), y / x.hypot(y)];
        for (method, tolerance) in methods_at(["taylor", "dop853"], TOLERANCES) {
            let what = format!("{method} {tolerance:e}, {angle}");
            let start = state(&[0.6, 0.0, 0.0, 0.0], &[0.0; 4]);
            let run = run_by(&scene, (method, tolerance), start, 4.0);
            certified(&what, &run);
            let rests = event(&run, "buffer", "accumulates").time;
            let mut impacts = 0;
            for hit in run.events().iter().filter(|e| e.kind == EventKind::Impact) {
                impacts += 1;
                assert_eq!(hit.after.branch(0), x < 0.0, "{what}: through the mud");
                let held = [(Sledge::RUNNERS, mu * 1.1 * 9.4), (Sledge::CLAY, hold)];
                for (friction, held) in held {
                    let force = along.map(|along| held * along);
                    all_agree(&what, hit.friction_after(friction), &force, 1e-12);
                }
            }
            assert!(impacts > 5, "{what}");
            for grip in ["runners", "clay"] {
                let sticks = times(&run, grip, "sticks");
                assert_eq!(sticks.last(), Some(&rests), "{what}: {grip}");
            }
        }
    }
}
