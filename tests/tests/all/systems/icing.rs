//! Bodies at rest on more supports than determine their forces, one of which holds less and less: they begin to slip when no forces balance the load.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified, event, methods_at, root, run_by};

/// A box on three feet in a row, pulled ever harder while the floor below the first one ices over.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(
        left = [x - 0.5*cos(turn) + 0.4*sin(turn), y - 0.5*sin(turn) - 0.4*cos(turn)],
        right = [x + 0.5*cos(turn) + 0.4*sin(turn), y + 0.5*sin(turn) - 0.4*cos(turn)],
        middle = [x + place*cos(turn) + 0.4*sin(turn), y + place*sin(turn) - 0.4*cos(turn)],
    ),
    kinetic = 2.4*(der(x)^2 + der(y)^2) + der(turn)^2/2,
    contact(first: left[1] >= 0),
    contact(last: right[1] >= 0),
    contact(inner: middle[1] >= 0),
    friction(ices on first: slip = der(left[0]), static = mu[0]*exp(-ice*t), kinetic = rub*mu[0]*exp(-ice*t)),
    friction(grips on last: slip = der(right[0]), static = mu[1], kinetic = rub*mu[1]),
    friction(holds on inner: slip = der(middle[0]), static = mu[2], kinetic = rub*mu[2]),
    force(weight: y = -48),
    force(pull: (-strength*t, 0) at (x + deep*sin(turn), y - deep*cos(turn))),
)]
struct Box3 {
    mu: [f64; 3],
    ice: f64,
    rub: f64,
    strength: f64,
    place: f64,
    deep: f64,
}

impl Box3 {
    /// How much more the feet can hold than the pull asks for: of all loads N ≥ 0 in balance the best is on two feet (linear programming).
    fn margin(&self, t: f64) -> f64 {
        let pull = self.strength * t;
        let feet = [-0.5, 0.5, self.place];
        let mu = [self.mu[0] * (-self.ice * t).exp(), self.mu[1], self.mu[2]];
        // Σ N = 48 and Σ N x = (deep − 0.4) pull.
        let arm = (self.deep - 0.4) * pull / 48.0;
        let held = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| {
            let share = (arm - feet[i]) / (feet[j] - feet[i]);
            match (0.0..=1.0).contains(&share) {
                true => 48.0 * (mu[i] * (1.0 - share) + mu[j] * share),
                false => 0.0,
            }
        });
        held.into_iter().fold(0.0, f64::max) - pull
    }
}

#[test]
fn a_box_slips_when_its_feet_can_no_longer_share_the_pull() {
    for (mu, ice, rub, strength, place, deep) in [
        ([0.143, 0.517, 0.2783], 2.027, 0.7, 23.09, -0.2319, 0.3643),
        ([0.3, 0.271, 0.4838], 1.9, 0.7, 20.0, 0.15, 0.04),
        ([0.5, 0.2, 0.3], 1.0, 0.8, 15.0, 0.1, 0.3),
        ([0.2, 0.6, 0.1], 3.0, 0.9, 30.0, -0.3, 0.2),
    ] {
        let scene = Box3 {
            mu,
            ice,
            rub,
            strength,
            place,
            deep,
        };
        let slips = root(|t| scene.margin(t), 0.0, 2.0);
        for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-6, 1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0, 0.4, 0.0], &[0.0; 3]);
            let run = run_by(&scene, (method, tolerance), rest, slips + 0.05);
            for foot in ["ices", "grips", "holds"] {
                agree(&what, event(&run, foot, "slips").time, slips, 1e-7);
            }
            certified(&what, &run);
        }
    }
}

/// A box in a corner that two brakes hold, under a force that grows and swings: contacts and frictions allow more modes than are tried one by one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(
        left = [x - 0.6655*cos(turn) + 0.6655*sin(turn), y - 0.6655*sin(turn) - 0.6655*cos(turn)],
        right = y + 0.6655*sin(turn) - 0.6655*cos(turn),
        upper = [x + 0.6655*cos(turn) - 0.6655*sin(turn), y + 0.6655*sin(turn) + 0.6655*cos(turn)],
        jaw = [x + 0.31045575*cos(turn) + 0.19965*sin(turn), y + 0.31045575*sin(turn) - 0.19965*cos(turn)],
        jow = [x + 0.5465086*cos(turn) + 0.55243155*sin(turn), y + 0.5465086*sin(turn) - 0.55243155*cos(turn)],
    ),
    kinetic = 1.789/2*(der(x)^2 + der(y)^2) + 0.2641102190833333/2*der(turn)^2,
    contact(heel: left[1] >= 0),
    contact(toe: right >= 0),
    contact(wall: 0.6655 - upper[0] >= 0),
    friction(drag on heel: slip = der(left[0]), static = 0.09946),
    friction(climb on wall: slip = der(upper[1]), static = 0.4238),
    friction(slide: slip = 0.6*der(jaw[0]) + 0.8*der(jaw[1]), limit = (3.349008, 1.674504)),
    friction(across: slip = 0.8*der(jow[0]) - 0.6*der(jow[1]), limit = 5.472551),
    force(pull: (129.93140029636004*t, 9.655233*sin(8.966*t) + 6.8965950000000005*exp(-((t - 0.3468289)/0.008778214814509492)^2))
        at (x + 0.065119175*sin(turn), y - 0.43290775*cos(turn))),
)]
struct Clamped {}

/// Of the 384 modes one is possible, with ẍ = 1.4446, ÿ = 2.3387, φ̈ = 2.1707, as a programme that tries them all without this project finds: the brakes slip and the
/// box comes off the floor.
#[test]
fn the_only_one_of_many_modes_is_found() {
    let rest = || state(&[0.0, 0.6655, 0.0], &[0.0; 3]);
    let first = run_by(&Clamped {}, ("auto", 1e-9), rest(), 0.07);
    let slips = event(&first, "slide", "slips").time;
    agree("time", slips, 0.061879, 1e-5);
    for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-9, 1e-12]) {
        let short = 1e-5;
        let run = run_by(&Clamped {}, (method, tolerance), rest(), slips + short);
        let what = format!("{method} at {tolerance:e}");
        for (v, acceleration) in run.final_state().v.iter().zip([1.4446, 2.3387, 2.1707]) {
            agree(&what, v / short, acceleration, 2e-3);
        }
        certified(&what, &run);
    }
}
