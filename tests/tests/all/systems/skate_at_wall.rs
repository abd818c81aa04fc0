//! A hold by more forces than it needs ends where no shares of them keep all bounds: at that instant what is open in them lies along the edge of a cone.

use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, event, first_start, methods_at, run_by};

/// A skate whose point lies at a rough wall, and that turns evenly while it is pushed along its blade.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, heading),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(heading)^2,
    constraint(blade: der(y) * cos(heading) == der(x) * sin(heading)),
    contact(wall: x <= 0),
    friction(grip on wall: slip = der(y), static = mu),
    force(push: (strength * cos(heading), strength * sin(heading)) at (x, y)),
    start(turning: heading = from, der(heading) = rate),
)]
struct Skate {
    mass: f64,
    inertia: f64,
    strength: f64,
    mu: f64,
    from: f64,
    rate: f64,
}

/// The wall pushes with −N and holds with T, |T| ≤ μN, the blade with any force across: along it, where F + T sin ψ = N cos ψ, that can be so
/// as long as the heading ψ is less than π/2 + atan μ, and then the smallest N grows beyond all bounds.
#[test]
fn a_skate_is_held_until_no_forces_can_hold_it() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let skate = Skate {
            mass: random.between(0.5, 3.0),
            inertia: random.between(0.1, 1.0),
            strength: random.between(0.5, 4.0),
            mu: random.between(0.1, 2.0),
            from: random.between(-0.8, 0.9),
            rate: random.between(0.5, 2.0),
        };
        let ends = (core::f64::consts::FRAC_PI_2 + skate.mu.atan() - skate.from) / skate.rate;
        for (method, tolerance) in methods_at([Method::Auto], [1e-6, 1e-9, 1e-12]) {
            let until = ends + 0.3 / skate.rate;
            let run = run_by(&skate, (method, tolerance), first_start(&skate), until);
            let what = format!("{skate:?} by {method} at {tolerance}");
            let lost = event(&run, "wall", "lost");
            assert_eq!(run.events()[0].time, lost.time, "{what}");
            // Bounds are compared to a billionth of their sizes.
            agree(&what, lost.time, ends, 1e-8);
        }
    }
}
